"""Calibration: what was put in comes out, as another least squares finds it."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

import thing_kin as tk
from calibration_cases import ARM, BASE, EXACT, OFFSETS, TOOL, Array, Q, noisy, simulated
from thing_kin import estimation as est

# Noise is taken to be 1e-7 m at least: what weak knowledge pulls by then is far below this.
TIGHT = 1e-8


def test_offsets_base_and_tool() -> None:
    result = est.calibrate(ARM, Q, EXACT)
    assert result.success
    assert_allclose(result.joint_offsets[1:5], OFFSETS[1:5], atol=TIGHT)
    assert result.joint_offsets[0] == pytest.approx(0.0, abs=1e-3)
    assert_allclose(result.base @ result.chain.fk(Q) @ result.tool, EXACT, atol=1e-8)
    assert_allclose(result.predict(Q), EXACT, atol=1e-8)


@pytest.mark.parametrize("yaw", [0.0, np.pi / 2, np.pi, -3.0])
def test_the_base_may_be_anywhere(yaw: float) -> None:
    far = tk.transform(xyz=(40.0, -25.0, 3.0), rpy=(np.pi, 0.4, yaw)) @ EXACT
    result = est.calibrate(ARM, Q, far)
    assert result.rms_position < 1e-7
    assert_allclose(result.joint_offsets[1:5], OFFSETS[1:5], atol=1e-7)


def test_every_row() -> None:
    arm = simulated(3)
    result = est.calibrate(arm.nominal, arm.q, arm.base @ arm.true_chain.fk(arm.q) @ arm.tool,
                           parameters="all")  # fmt: skip
    assert result.rms_position < 1e-6
    elsewhere = arm.nominal.random(20, rng=5)
    assert arm.tool_error(result.predict(elsewhere), elsewhere).max() < 1e-6
    for name in set(result.names) - set(result.unidentifiable) - {"base", "tool"}:
        if name in arm.truth:
            assert result.parameters[name] == pytest.approx(arm.truth[name], abs=1e-6), name


def test_a_tilt_of_parallel_axes() -> None:
    """What Denavit and Hartenberg's four numbers can't say without jumping: beta."""
    tilted = ARM.fk_all(np.zeros(6))
    tilt = tk.transform(rpy=(0.0, 2e-3, 0.0))

    def true_fk(q: Array) -> Array:
        T = np.eye(4)
        for i in range(6):
            row = np.linalg.solve(tilted[i], tilted[i + 1])
            T = T @ tk.transform(rpy=(0, 0, q[i])) @ row @ (tilt if i == 1 else np.eye(4))
        return T

    result = est.calibrate(ARM, Q, np.stack([true_fk(q) for q in Q]), parameters="all")
    assert result.parameters["dh[1].beta"] == pytest.approx(2e-3, abs=1e-6)
    assert result.rms_position < 1e-6
    assert_allclose(result.chain.fk(Q[0]), np.linalg.inv(result.base) @ true_fk(Q[0])
                    @ np.linalg.inv(result.tool), atol=1e-6)  # fmt: skip


def test_origins_of_a_urdf() -> None:
    urdf = tk.Chain.from_urdf(ARM.to_urdf())
    result = est.calibrate(urdf, Q, EXACT, parameters="all")
    assert any(name.startswith("origins[2]") for name in result.names)
    assert result.rms_position < 1e-6
    elsewhere = ARM.random(20, rng=5)
    assert_allclose(result.predict(elsewhere), BASE @ ARM.fk(elsewhere + OFFSETS) @ TOOL, atol=1e-6)
    again = tk.Chain.from_urdf(result.to_urdf())
    assert_allclose(again.fk(elsewhere), result.chain.fk(elsewhere), atol=1e-12)


def test_scales_and_sag() -> None:
    J = ARM.jacobian(Q)
    torque = J[:, 2, :] * -9.81
    true = Q * [1, 1.002, 1, 0.999, 1, 1] + OFFSETS + torque * [0, 2e-4, 1e-4, 0, 0, 0]
    result = est.calibrate(
        ARM, Q, BASE @ ARM.fk(true) @ TOOL,
        parameters=("base", "tool", "joint_offsets", "joint_scales"), sag=("q1", 2),
    )  # fmt: skip
    assert_allclose(result.joint_scales, [1, 1.002, 1, 0.999, 1, 1], atol=1e-7)
    assert_allclose(result.compliances, [0, 2e-4, 1e-4, 0, 0, 0], atol=1e-7)
    assert_allclose(result.predict(Q), BASE @ ARM.fk(true) @ TOOL, atol=1e-7)
    assert result.predict(Q[0]).shape == (4, 4)


def test_loads_add_up() -> None:
    loads = ((None, (0.0, 0.0, 0.1), 2.0), (3, (0.2, 0.0, 0.0), 5.0))
    J = 2.0 * ARM.jacobian(Q, point=(0.0, 0.0, 0.1)) + 5.0 * ARM.jacobian(
        Q, of=3, point=(0.2, 0.0, 0.0)
    )
    true = Q + J[:, 2, :] * -9.81 * [0, 2e-5, 1e-5, 0, 0, 0]
    result = est.calibrate(ARM, Q, ARM.fk(true), sag=(1, 2), loads=loads)
    assert_allclose(result.compliances[1:3], [2e-5, 1e-5], atol=1e-8)


def test_a_sliding_joint() -> None:
    rows = [tk.DH(alpha=np.pi / 2, joint="revolute", lower=-3, upper=3),
            tk.DH(alpha=-np.pi / 2, joint="revolute", lower=-3, upper=3),
            tk.DH(d=0.3, joint="prismatic", lower=0, upper=1),
            tk.DH(alpha=np.pi / 2, a=0.1, joint="revolute", lower=-3, upper=3)]  # fmt: skip
    arm = tk.Chain.from_dh(rows)
    q = arm.random(40, rng=0)
    offsets = np.array([0.0, 4e-3, 6e-3, -2e-3])
    result = est.calibrate(arm, q, arm.fk(q + offsets), parameters=("base", "joint_offsets"))
    assert_allclose(result.joint_offsets[1:], offsets[1:], atol=1e-7)
    with_rows = est.calibrate(arm, q, arm.fk(q + offsets), parameters=("joint_offsets", "dh"))
    assert "dh[2].theta" in with_rows.names
    assert "dh[2].d" not in with_rows.names


def test_a_sliding_joint_that_gives_way() -> None:
    rows = [tk.DH(alpha=np.pi / 2, joint="revolute", lower=-3, upper=3),
            tk.DH(joint="prismatic", lower=0.2, upper=1),
            tk.DH(a=0.1, alpha=np.pi / 2, joint="revolute", lower=-3, upper=3)]  # fmt: skip
    arm = tk.Chain.from_dh(rows)
    q = arm.random(40, rng=0)
    gravity = (0.0, 3.0, -9.0)
    force = np.einsum("nij,i->nj", arm.jacobian(q)[:, :3], gravity)
    true = q + force * [0.0, 2e-4, 0.0]
    result = est.calibrate(arm, q, arm.fk(true), sag=(1,), gravity=gravity)
    assert result.compliances[1] == pytest.approx(2e-4, abs=1e-7)
    assert result.table[-1].unit == "m/N"
    assert "mm/N" in result.report()


def test_it_is_the_least_squares_that_scipy_finds() -> None:
    """Written out from scratch: rotation vectors by SciPy, differences for derivatives."""
    rng = np.random.default_rng(4)
    measured = noisy(EXACT, rng, 1e-3, 2e-3)
    covariance = np.diag([1e-6] * 3 + [4e-6] * 3)
    ours = est.calibrate(ARM, Q, measured, loss="linear", covariance=covariance)

    def residuals(x: Array) -> Array:
        base = tk.transform(xyz=x[:3]) @ BASE
        base[:3, :3] = Rotation.from_rotvec(x[3:6]).as_matrix() @ BASE[:3, :3]
        tool = tk.transform(xyz=x[6:9]) @ TOOL
        tool[:3, :3] = Rotation.from_rotvec(x[9:12]).as_matrix() @ TOOL[:3, :3]
        T = base @ ARM.fk(Q + np.array([0, *x[12:16], 0])) @ tool
        turn = Rotation.from_matrix(measured[:, :3, :3] @ T[:, :3, :3].transpose(0, 2, 1))
        return np.hstack([(measured - T)[:, :3, 3] / 1e-3, turn.as_rotvec() / 2e-3]).ravel()

    theirs = least_squares(residuals, np.zeros(16), x_scale="jac", xtol=1e-14, ftol=1e-14)
    # Ours know that an offset is 50 mrad or so: that pulls by (1.5e-4 / 5e-2)^2 of it, twice or so.
    assert_allclose(ours.joint_offsets[1:5], theirs.x[12:], atol=5e-7)
    sd = np.sqrt(np.diag(np.linalg.inv(theirs.jac.T @ theirs.jac)))[12:]
    at = [ours.names.index(f"joint_offsets[{i}]") for i in range(1, 5)]
    assert_allclose(ours.std[at], sd, rtol=1e-3)
    assert 2 * theirs.cost / (360 - 16) == pytest.approx(ours.variance_factor, rel=1e-3)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"parameters": ("wings",)}, "parameters: got 'wings'"),
        ({"parameters": ()}, "parameters: got none"),
        ({"parameters": ("mount",)}, "parameters: got 'mount'"),
        ({"loss": "l7"}, "loss: got 'l7'"),
        ({"loss_scale": 0.0}, "loss_scale: got 0"),
        ({"gate": 1.0}, "gate: got 1"),
        ({"kind": "song"}, "kind: got 'song'"),
        ({"folds": 1}, "folds: got 1"),
        ({"sag": ("nose",)}, "sag: got 'nose'"),
        ({"priors": {"nose": 1.0}}, "priors: got 'nose'"),
        ({"priors": {"dh": -1.0}}, "priors: got dh: -1"),
        ({"max_iterations": 0}, "max_iterations: got 0"),
        ({"covariance": np.zeros((6, 6))}, "covariance: got a covariance that is not positive"),
        ({"base_covariance": np.eye(3)}, "base_covariance: got one for ur10"),
        ({"base": np.ones((4, 4))}, "base: got a (4, 4) matrix that is no rigid"),
    ],
)
def test_misuse(options: dict[str, object], said: str) -> None:
    with pytest.raises(ValueError) as error:  # noqa: PT011 - the text is compared below
        est.calibrate(ARM, Q, EXACT, **options)
    assert str(error.value).startswith(said)


def test_measurements_that_do_not_fit() -> None:
    broken = EXACT.copy()
    broken[3, 0, 3] = np.nan
    for q, measured, said in (
        (Q, EXACT[:-1], "measured: got shape"),
        (Q, broken, "measured: got NaN or inf at posture 3"),
        (Q[0], EXACT, "q: got shape"),
        (Q[:0], EXACT[:0], "q: got no posture"),
        (Q[:, :5], EXACT, "q: got shape"),
    ):
        with pytest.raises(ValueError) as error:  # noqa: PT011
            est.calibrate(ARM, q, measured)
        assert str(error.value).startswith(said), error.value


@pytest.mark.parametrize("kind", [None, "poses", "points", "hits"])
def test_lists_of_several_lengths_are_named(kind: str | None) -> None:
    with pytest.raises(ValueError, match=r"^measured: got list, expected an array"):
        est.calibrate(ARM, Q[:2], [[1.0, 2.0, 3.0], [1.0]], kind=kind)
    with pytest.raises(ValueError, match=r"^q: got list, expected an array"):
        est.calibrate(ARM, [[1.0], [1.0, 2.0]], EXACT[:2], kind=kind)


def test_values_are_motions_from_nominal() -> None:
    base, tool = tk.transform(xyz=(0.2, 0.2, 0.6), rpy=(0, 0.1, 1.5)), tk.transform(rpy=(0, 0, 0.3))
    result = est.calibrate(ARM, Q, EXACT, base=base, tool=tool)
    motions = []
    for group in ("base", "tool"):
        x = np.array(
            [result.parameters[f"{group}.{axis}"] for axis in ("x", "y", "z", "rx", "ry", "rz")]
        )
        E = tk.transform(xyz=x[:3])
        E[:3, :3] = tk.lie.so3_exp(x[3:])
        motions.append(E)
    assert_allclose(base @ motions[0], result.base, atol=1e-12)
    assert_allclose(motions[1] @ tool, result.tool, atol=1e-12)


def test_the_table_has_the_data_sheet_s_numbers() -> None:
    result = est.calibrate(ARM, Q, EXACT, parameters=("base", "dh", "joint_scales"))
    rows = {row.name: row for row in result.table}
    assert rows["dh[1].a"].nominal == pytest.approx(-0.612, abs=2e-3)
    assert rows["dh[0].alpha"].nominal == pytest.approx(np.pi / 2, abs=1e-9)
    assert rows["joint_scales[2]"].nominal == 1.0
    assert rows["base.x"].nominal == 0.0
    for row, value, std in zip(result.table, result.values, result.std, strict=True):
        assert row.change == pytest.approx(value, abs=1e-12)
        assert row.std == std
    assert [rows[n].unit for n in ("base.x", "base.rx", "dh[1].a", "joint_scales[2]")] == [
        "m", "rad", "m", "1",
    ]  # fmt: skip
