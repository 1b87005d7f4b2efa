"""`thing-kin calibrate`, and the figure."""

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import thing_kin as tk
from thing_kin import cli, viz
from thing_kin import estimation as est
from thing_kin.estimation import calibration_table

ARM = tk.robots.ur5()
OFFSETS = np.array([0.0, 2e-3, -3e-3, 1e-3, 4e-3, 0.0])
Q = ARM.random(25, rng=3)
TRUE = tk.transform(xyz=(1, 2, 0.5), rpy=(0, 0, 2.0)) @ ARM.fk(Q + OFFSETS)
RPY = np.stack([tk.lie.rpy_from_rotation(T[:3, :3]) for T in TRUE])
POSES = ["x", "y", "z", "roll", "pitch", "yaw"]


def write(path: Path, names: list[str], *columns: np.ndarray) -> Path:
    lines = [",".join(names)]
    for row in np.column_stack(columns):
        lines.append(",".join("" if np.isnan(x) else repr(float(x)) for x in row))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_a_table_of_poses(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = write(tmp_path / "d.csv", [*ARM.names, *POSES], Q, TRUE[:, :3, 3], RPY)
    urdf, yaml, plot = (tmp_path / name for name in ("a.urdf", "a.yaml", "a.png"))
    options = ["--robot", "ur5", "--urdf", urdf, "--yaml", yaml, "--plot", plot]
    assert cli.main(["calibrate", str(table), *map(str, options)]) == 0
    said = capsys.readouterr().out
    assert "Calibration of ur5: converged, 25 measurements" in said
    assert "held out" in said
    found = tk.Chain.from_urdf(urdf)
    expected = ARM.fk(Q + OFFSETS)
    ours = found.fk(Q)
    between = np.linalg.norm(ours[1:, :3, 3] - ours[:-1, :3, 3], axis=1)
    assert_allclose(between, np.linalg.norm(np.diff(expected[:, :3, 3], axis=0), axis=1), atol=1e-4)
    assert yaml.read_text().startswith("kinematics:\n  shoulder:\n")
    assert plot.stat().st_size > 10_000


@pytest.mark.parametrize("rows", [[0], [0, 0, 0], [0, 1, 1]])
def test_a_table_of_few_postures(
    rows: list[int], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As many folds as there can be."""
    table = write(tmp_path / "d.csv", [*ARM.names, *POSES], Q[rows], TRUE[rows, :3, 3], RPY[rows])
    assert cli.main(["calibrate", str(table), "--robot", "ur5"]) != cli.USAGE
    said = capsys.readouterr().out
    assert "Calibration of ur5" in said
    assert ("held out" in said) == (1 in rows)


def test_columns_in_any_order_and_gaps(tmp_path: Path) -> None:
    places = TRUE[:, :3, 3].copy()
    places[4] = np.nan
    table = write(tmp_path / "d.csv", ["x1", "y1", "z1", "q5", "q0", "q1", "q2", "q3", "q4"],
                  places, Q[:, [5, 0, 1, 2, 3, 4]])  # fmt: skip
    q, measured = calibration_table.read(table, ARM, points=True)
    assert_allclose(q, Q)
    assert measured.shape == (25, 1, 3)
    assert np.isnan(measured[4]).all()
    other = write(tmp_path / "e.csv", [*POSES, *"abcdef"], TRUE[:, :3, 3], RPY, Q)
    q, poses = calibration_table.read(other, ARM, points=False)
    assert_allclose(q, Q)
    assert_allclose(poses, TRUE, atol=1e-12)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "got 0 lines"),
        ("x,y\n1,2\n", "got 2 columns"),
        ("x,y,q0,q1,q2,q3,q4,q5\n1,2,0,0,0,0,0,0\n", "got 2 columns of measurements"),
        ("x,y,q0,q1,q2,q3,q4,q5\n1,2,0,0,0,0,0\n", "got 7 cells in line 2"),
        ("x,y,q0,q1,q2,q3,q4,q5\n1,dog,0,0,0,0,0,0\n", "in line 2, expected numbers"),
        ("x,y,z,q0,q1,q2,q3,q4,q5\n1,2,3,0,0,0,,0,0\n", "joint reading that is not finite"),
    ],
)
def test_tables_that_are_none(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, said: str
) -> None:
    table = tmp_path / "d.csv"
    table.write_text(text)
    assert cli.main(["calibrate", str(table), "--robot", "ur5"]) == 2
    assert said in capsys.readouterr().err
    assert cli.main(["calibrate", str(tmp_path / "none.csv")]) == 2


def test_the_figure_shows_what_was_found() -> None:
    result = est.calibrate(ARM, Q, TRUE)
    figure = viz.plot_calibration(result)
    errors, share, values = figure.axes
    nominal, calibrated = errors.lines
    expected = 1e3 * np.linalg.norm(result.errors_nominal[:, :3], axis=1)
    assert_allclose(nominal.get_ydata(), expected)
    assert np.max(calibrated.get_ydata()) < 1e-3
    assert len(share.lines) == 2
    assert [bar.get_height() for bar in values.patches] == pytest.approx(
        1e3 * result.values[12:], abs=1e-9
    )
