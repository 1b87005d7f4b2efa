"""Calibration: what was put in comes out, deviations are honest, what can't be seen is said."""

import functools

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

import thing_kin as tk
from calibration_cases import Array, noisy, perturbed, simulated
from soak_calibration import soak
from thing_kin import estimation as est

ARM = tk.robots.ur10()
BASE = tk.transform(xyz=(0.3, 0.1, 0.7), rpy=(0.01, -0.02, 1.6))
TOOL = tk.transform(xyz=(0.01, -0.02, 0.12), rpy=(0.0, 0.0, 0.26))
OFFSETS = np.array([1e-3, -4e-3, 2e-3, 3e-3, -2e-3, 5e-3])
Q = ARM.random(60, rng=1)
EXACT = BASE @ ARM.fk(Q + OFFSETS) @ TOOL
# Noise is taken to be 1e-7 m at least: what weak knowledge pulls by then is far below this.
TIGHT = 1e-8


@functools.cache
def noisy_result() -> est.Calibration:
    measured = noisy(EXACT, np.random.default_rng(0), 2e-4, 2e-4)
    return est.calibrate(ARM, Q, measured, folds=5)


# --- what was put in comes out


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


# --- points and hits


def test_three_reflectors_at_unknown_places() -> None:
    """A laser tracker: three places for each posture, and one of them hidden at times."""
    places = np.array([[0.05, 0.0, 0.1], [-0.03, 0.06, 0.12], [0.0, -0.05, 0.08]])
    flange = BASE @ ARM.fk(Q + OFFSETS)
    measured = np.stack([(flange @ [*p, 1.0])[:, :3] for p in places], axis=1)
    measured[::7, 1] = np.nan
    result = est.calibrate(ARM, Q, measured, parameters=("base", "tool", "joint_offsets"))
    assert result.errors.shape == (60, 3, 3)
    assert np.isnan(result.errors[7, 1]).all()
    assert result.rms_position < 1e-7
    assert_allclose(result.joint_offsets[1:5], OFFSETS[1:5], atol=1e-7)
    assert not any(name.startswith("tool") for name in result.names)
    c, s = np.cos(OFFSETS[5]), np.sin(OFFSETS[5])
    turned = places @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])  # the offset nobody can see
    assert_allclose(result.points, turned, atol=1e-6)
    assert {"joint_offsets[5]", "points[0].y"} <= set(result.unidentifiable)


def test_reflectors_at_known_places() -> None:
    places = np.array([[0.05, 0.0, 0.1], [-0.03, 0.06, 0.12], [0.0, -0.05, 0.08]])
    measured = np.stack([(EXACT @ [*p, 1.0])[:, :3] for p in places], axis=1)
    result = est.calibrate(ARM, Q, measured, points=places)
    assert_allclose(result.predict(Q), EXACT, atol=1e-7)


def test_one_point_sees_no_rotation_of_the_tool() -> None:
    result = est.calibrate(ARM, Q, EXACT[:, :3, 3])
    assert {"tool.rx", "tool.ry", "tool.rz"} <= set(result.unidentifiable)
    assert_allclose(result.predict(Q)[:, :3, 3], EXACT[:, :3, 3], atol=1e-7)
    assert np.isnan(result.rms_rotation)
    assert result.points.shape == (1, 3)


def test_a_laser_s_line_through_fiducials() -> None:
    rng = np.random.default_rng(0)
    along = np.column_stack([np.zeros((60, 2)), rng.uniform(0.3, 3, 60), np.ones(60)])
    fiducials = np.einsum("nij,nj->ni", EXACT, along)[:, :3]
    near = tk.transform(xyz=(0.31, 0.1, 0.69), rpy=(0, 0, 1.6))
    result = est.calibrate(
        ARM, Q, fiducials, kind="hits", base=near,
        tool=tk.transform(xyz=(0.0, 0.0, 0.1), rpy=(0.02, 0.0, 0.0)),
    )  # fmt: skip
    assert result.rms_position < 1e-7
    assert_allclose(result.joint_offsets[1:4], OFFSETS[1:4], atol=1e-6)
    assert {"tool.z", "tool.rz"} <= set(result.unidentifiable)


def test_poses_may_be_missing() -> None:
    gaps = EXACT.copy()
    gaps[[3, 40]] = np.nan
    result = est.calibrate(ARM, Q, gaps)
    assert np.isnan(result.errors[3]).all()
    assert np.isnan(result.distances[40])
    assert_allclose(result.joint_offsets[1:5], OFFSETS[1:5], atol=TIGHT)


# --- against another least squares


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


@pytest.mark.parametrize("loss", ["linear", "huber", "soft_l1", "cauchy", "tukey"])
def test_deviations_are_honest(loss: str) -> None:
    """Share of identifiable parameters in their own 95 % bands, 40 arms."""
    inside = []
    for seed in range(40):
        rng = np.random.default_rng([seed, 1])
        offsets = rng.normal(0, 3e-3, 6)
        q = ARM.random(30, rng=rng)
        measured = noisy(ARM.fk(q + offsets), rng, 3e-4, 5e-4)
        result = est.calibrate(ARM, q, measured, loss=loss)
        at = [result.names.index(f"joint_offsets[{i}]") for i in range(1, 5)]
        inside.append(np.abs(result.values[at] - offsets[1:5]) < 1.96 * result.std[at])
    share = np.mean(inside)  # of 160, not all independent: four deviations of 0.017 and more
    assert 0.88 < share < 0.995, share


# --- outliers, folds, report


@pytest.mark.parametrize("share", [0.0, 0.1])
def test_a_short_soak(share: float) -> None:
    """See soak_calibration.py: 25 of its arms."""
    judged = soak(25, share)
    inside = np.concatenate([j.inside for j in judged])
    assert inside.size > 200
    assert 0.9 < inside.mean() < 0.99  # parameters of an arm are correlated: 0.02 or so
    assert max(j.calibrated for j in judged) < 4e-4
    assert min(j.nominal for j in judged) > 1e-3
    assert min(j.found for j in judged) == 1.0 or share == 0.0


@pytest.mark.parametrize("loss", ["cauchy", "tukey", "huber"])
def test_outliers_are_found_and_harmless(loss: str) -> None:
    arm = simulated(1, outliers=0.1)
    result = est.calibrate(arm.nominal, arm.q, arm.measured, parameters="all", loss=loss)
    assert set(arm.spoiled) <= set(result.outliers)
    assert len(result.outliers) <= len(arm.spoiled) + 2
    assert result.noise_position == pytest.approx(2e-4, rel=0.25)
    elsewhere = arm.nominal.random(200, rng=8)
    assert np.sqrt(np.mean(arm.tool_error(result.predict(elsewhere), elsewhere) ** 2)) < 4e-4


def test_noise_is_told_apart() -> None:
    result = noisy_result()
    assert result.noise_is_estimated
    # 180 numbers each: a deviation of 5 %, taken thrice.
    assert result.noise_position == pytest.approx(2e-4, rel=0.15)
    assert result.noise_rotation == pytest.approx(2e-4, rel=0.15)
    assert result.dof == pytest.approx(360 - 16, abs=0.1)


def test_folds() -> None:
    result = noisy_result()
    assert len(result.fold_rms) == 5
    assert result.rms_position < result.cross_validated_rms_position < 1.3 * result.rms_position
    assert result.rms_position_nominal > 3 * result.rms_position
    with pytest.raises(ValueError, match="folds: got 7, expected at most the 6 distinct"):
        est.calibrate(ARM, np.repeat(Q[:6], 3, axis=0), np.repeat(EXACT[:6], 3, axis=0), folds=7)


def test_the_report_says_it_all() -> None:
    text = str(noisy_result())
    assert "base.rz +1, joint_offsets[0] -1" in text
    assert "rank 16 of 18" in text
    assert "held out" in text
    for name in noisy_result().names:
        assert name in text


def test_equal_input_equal_output() -> None:
    a, b = (est.calibrate(ARM, Q, EXACT, folds=3, rng=2) for _ in range(2))
    np.testing.assert_array_equal(a.values, b.values)
    assert a.fold_rms == b.fold_rms


def test_moving_the_world_changes_the_base_alone() -> None:
    measured = noisy(EXACT, np.random.default_rng(0), 2e-4, 2e-4)
    moved = tk.transform(xyz=(1, 2, 3), rpy=(0.3, -0.2, 1.0))
    a, b = (est.calibrate(ARM, Q, m, loss="linear") for m in (measured, moved @ measured))
    assert_allclose(b.base, moved @ a.base, atol=1e-6)  # noise is estimated to a part in 100
    assert_allclose(b.joint_offsets, a.joint_offsets, atol=1e-6)
    assert_allclose(b.std[12:], a.std[12:], rtol=0.02)


# --- what can't be seen


def test_what_no_posture_tells() -> None:
    result = est.calibrate(ARM, Q, EXACT, parameters="all")
    assert not result.degenerate
    for name in ("base.rz", "joint_offsets[0]", "joint_offsets[5]", "dh[1].d", "dh[2].d"):
        assert name in result.unidentifiable
        assert np.isinf(result.std[result.names.index(name)])
    for name in ("joint_offsets[4]", "dh[1].a", "dh[3].alpha", "dh[4].a"):
        assert name not in result.unidentifiable
    # Three parallel axes: where along them the links are can't be told, but for the sum.
    assert any("dh[1].d" in line and "dh[2].d" in line for line in result.combinations)
    motions = len(result.names) - result.rank
    assert len(result.combinations) == motions


def test_one_posture_many_times() -> None:
    rng = np.random.default_rng(0)
    q = np.repeat(Q[:1], 50, axis=0)
    measured = noisy(np.repeat(EXACT[:1], 50, axis=0), rng, 2e-4, 2e-4)
    result = est.calibrate(ARM, q, measured, parameters="all")
    assert result.degenerate
    assert result.rank <= 6
    assert set(result.unidentifiable) >= {f"joint_offsets[{i}]" for i in range(6)}
    assert_allclose(result.joint_offsets, 0.0, atol=0.05)
    assert "DEGENERATE" in result.report()


def test_encoder_noise_does_not_hide_that() -> None:
    rng = np.random.default_rng(0)
    q = Q[0] + rng.normal(0, 1e-4, (50, 6))
    result = est.calibrate(ARM, q, noisy(BASE @ ARM.fk(q) @ TOOL, rng, 2e-4, 2e-4))
    assert result.degenerate
    assert set(result.unidentifiable) >= {f"joint_offsets[{i}]" for i in range(6)}
    assert np.abs(result.joint_offsets).max() < 0.05  # kept near nominal


def test_postures_in_a_plane() -> None:
    q = np.tile([0.3, 0, 0, 0, -np.pi / 2, 0], (40, 1))
    q[:, 1:4] = ARM.random(40, rng=2)[:, 1:4]
    result = est.calibrate(ARM, q, BASE @ ARM.fk(q + OFFSETS) @ TOOL)
    assert result.degenerate
    assert {"joint_offsets[0]", "joint_offsets[4]", "joint_offsets[5]"} <= set(
        result.unidentifiable
    )
    assert result.rms_position < 1e-6


@pytest.mark.parametrize("postures", [1, 2, 3])
def test_fewer_than_the_parameters(postures: int) -> None:
    result = est.calibrate(ARM, Q[:postures], EXACT[:postures], parameters="all")
    assert result.degenerate
    assert result.status == "underdetermined"
    assert not result.success
    assert not result.noise_is_estimated
    assert np.isfinite(result.values).all()


def test_nothing_measured_at_all() -> None:
    nothing = np.full((3, 4, 4), np.nan)
    result = est.calibrate(ARM, Q[:3], nothing)
    assert result.status == "underdetermined"
    assert result.unidentifiable == result.names
    assert_allclose(result.values, 0.0)


def test_priors_tell_what_data_do_not() -> None:
    free = est.calibrate(ARM, Q, EXACT)
    told = est.calibrate(ARM, Q, EXACT, priors={"joint_offsets[0]": 1e-4, "joint_offsets[5]": 0.0})
    at = told.names.index("joint_offsets[0]")
    assert np.isinf(free.std[free.names.index("joint_offsets[0]")])
    assert told.std[at] == pytest.approx(1e-4, rel=1e-3)
    assert "joint_offsets[5]" not in told.names
    assert "tool.rz" not in told.unidentifiable


def test_proposed_postures_tell_more() -> None:
    few, true = Q[:8], ARM.random(300, rng=7)
    measured = noisy(BASE @ ARM.fk(few + OFFSETS) @ TOOL, np.random.default_rng(1), 2e-4, 2e-4)
    result = est.calibrate(ARM, few, measured, parameters="all")
    chosen = result.propose_postures(6, candidates=true)
    assert chosen.shape == (6, 6)
    assert all(any((row == c).all() for c in true) for row in chosen)

    def volume(more: Array) -> float:
        q = np.vstack([few, more])
        covariance = np.diag([4e-8] * 6)
        P = est.calibrate(
            ARM, q, BASE @ ARM.fk(q + OFFSETS) @ TOOL, parameters="all", loss="linear",
            covariance=covariance,
        ).covariance  # fmt: skip
        return float(np.linalg.slogdet(P)[1])

    random = [volume(ARM.random(6, rng=seed)) for seed in range(8)]
    assert volume(chosen) < min(random) - 1.0


# --- a mobile base, exports


def test_mount_and_hand_eye_on_a_mobile_base() -> None:
    """Where the arm stands on the base, and the camera on the hand, with an uncertain base."""
    rng = np.random.default_rng(0)
    robot = tk.robots.thing()
    mount = np.array([0.004, -0.006, 0.003, 0.002, -0.003, 0.005])
    true = tk.on_omni_base(
        tk.robots.ur10(),
        tk.transform(xyz=(0.27, 0.01, 0.653), rpy=(0, 0, np.pi / 2)) @ tk.lie.se3_exp(mount),
    )
    q = robot.random(80, rng=1)
    base_sd = np.array([2e-3, 2e-3, 1e-3])
    localized = q.copy()
    localized[:, 6:] += rng.normal(0, base_sd, (80, 3))
    measured = noisy(true.fk(q) @ TOOL, rng, 2e-4, 2e-4)
    result = est.calibrate(
        robot, localized, measured, parameters=("mount", "tool"),
        base_covariance=np.diag(base_sd**2),
    )  # fmt: skip
    assert not any("joint_offsets[6]" in name for name in result.names)
    spread = 1e3 * np.linalg.norm(result.errors[:, :3], axis=1).mean()
    assert spread > 1.0  # mm: most of it is the localizer's
    assert result.variance_factor == pytest.approx(1.0, abs=0.25)
    at = [result.names.index(f"mount.{axis}") for axis in ("x", "y", "z", "rx", "ry")]
    assert (np.abs(result.values[at] - mount[:5]) < 3.5 * result.std[at]).all()
    assert np.isfinite(result.std[at]).all()


def test_it_writes_what_the_driver_reads() -> None:
    yaml = pytest.importorskip("yaml")
    last = {f"dh[5].{name}": 0.0 for name in ("a", "alpha")}
    arm = simulated(2)
    result = est.calibrate(arm.nominal, arm.q, arm.measured, parameters="all", priors=last)
    mapping = result.to_ur_calibration()
    assert_allclose(tk.robots.ur10(mapping).fk(Q), result.chain.fk(Q), atol=1e-12)
    assert yaml.safe_load(result.to_yaml())["kinematics"] == mapping["kinematics"]
    assert yaml.safe_load(result.to_yaml("calib_1"))["kinematics"]["hash"] == "calib_1"
    whole = est.calibrate(ARM, Q, EXACT, parameters=("dh[5]",))
    object.__setattr__(whole, "chain", perturbed(ARM, {"dh[5].a": 1e-3}))
    with pytest.raises(ValueError, match="chain: got a last frame off"):
        whole.to_ur_calibration()


# --- misuse


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
