"""Simulated localization: the drive is what it claims, and the fused estimate earns its band."""

import itertools

import numpy as np
import pytest

from localizer_oracle import moved, seen
from thing_kin import estimation as est


def test_the_drive_is_what_its_twists_say() -> None:
    drive = est.simulate_drive(30.0, rng=3)
    pose = np.zeros(3)
    for twist, dt, truth in zip(drive.twist, np.diff(drive.t), drive.truth[1:], strict=True):
        pose = moved(pose, twist * dt)
        np.testing.assert_allclose(pose[:2], truth[:2], atol=1e-9)
    scans = drive.truth[::5]
    exact = np.array([seen(a, b) for a, b in itertools.pairwise(scans)])
    error = drive.motions - exact
    assert 0.5 < error.std(axis=0)[0] / 0.003 < 1.5
    assert abs(drive.length - 30.0) < 0.1
    np.testing.assert_array_equal(drive.wheels, est.simulate_drive(30.0, rng=3).wheels)


@pytest.mark.parametrize("filter", ["ekf", "ukf"])
def test_fused_is_better_than_either_and_knows_it(filter: str) -> None:
    """Twenty drives of 60 m; their ends are independent."""
    ends = {"wheels": [], "lidar": [], "fused": []}
    nees = {name: [] for name in ends}
    sigma = {name: [] for name in ends}
    for seed in range(20):
        for name, run in est.localization_experiment(60.0, rng=seed, filter=filter).runs.items():
            ends[name].append(run.position_error[-1])
            nees[name].append(run.nees[-1])
            sigma[name].append(run.sigma[-1])
    rms = {name: np.sqrt(np.mean(np.square(e))) for name, e in ends.items()}
    assert rms["fused"] < min(rms["wheels"], rms["lidar"])
    assert (np.mean(sigma["fused"], axis=0) < np.mean(sigma["wheels"], axis=0)).all()
    assert (np.mean(sigma["fused"], axis=0) < np.mean(sigma["lidar"], axis=0)).all()
    # 3 where all errors were white; bias and lasting errors are not, and stay within a factor.
    assert 1.0 < np.mean(nees["fused"]) < 6.0


def test_the_table_and_the_figure() -> None:
    experiment = est.localization_experiment(40.0, rng=1)
    lines = experiment.table().splitlines()
    assert [line.split()[0] for line in lines] == ["run", "wheels", "lidar", "fused"]
    pytest.importorskip("matplotlib")
    from thing_kin import viz

    figure = viz.plot_localization(experiment)
    band, *_ = figure.axes[1].collections
    run = experiment.runs["fused"]
    top = band.get_paths()[0].get_extents().y1
    np.testing.assert_allclose(top, 2 * run.sigma[:, 0].max())


@pytest.mark.parametrize(("name", "value"), [("length", 0.0), ("length", np.nan), ("every", -1.0)])
def test_misuse(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=f"^{name}: got .*, expected"):
        est.localization_experiment(**{"length": 10.0, name: value})
