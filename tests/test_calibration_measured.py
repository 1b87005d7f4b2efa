"""Calibration by points, hits and what is missing; a mobile base; exports."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import thing_kin as tk
from calibration_cases import ARM, BASE, EXACT, OFFSETS, TOOL, Q, noisy, perturbed, simulated
from thing_kin import estimation as est

# Noise is taken to be 1e-7 m at least: what weak knowledge pulls by then is far below this.
TIGHT = 1e-8


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


def test_points_are_nothing_to_a_laser_s_line() -> None:
    places = EXACT[:, :3, 3]
    results = [
        est.calibrate(ARM, Q, places, kind="hits", base=BASE, tool=TOOL, points=points)
        for points in (None, np.zeros((5000, 3)))
    ]
    np.testing.assert_array_equal(results[0].values, results[1].values)


def test_poses_may_be_missing() -> None:
    gaps = EXACT.copy()
    gaps[[3, 40]] = np.nan
    result = est.calibrate(ARM, Q, gaps)
    assert np.isnan(result.errors[3]).all()
    assert np.isnan(result.distances[40])
    assert_allclose(result.joint_offsets[1:5], OFFSETS[1:5], atol=TIGHT)


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
    assert result.noise_position == pytest.approx(2e-4, rel=0.3)  # the tracker's own
    at = [result.names.index(f"mount.{axis}") for axis in ("x", "y", "z", "rx", "ry")]
    assert (np.abs(result.values[at] - mount[:5]) < 3.5 * result.std[at]).all()
    assert np.isfinite(result.std[at]).all()


def test_each_posture_has_the_base_s_covariance() -> None:
    """Half of them localized a thousand times as badly: they spoil nothing."""
    rng = np.random.default_rng(0)
    robot = tk.robots.thing()
    q = robot.random(60, rng=1)
    sd = np.where(np.arange(60) % 2 == 0, 1e-4, 1e-1)
    localized = q.copy()
    localized[:, 6:] += rng.normal(size=(60, 3)) * sd[:, None]
    result = est.calibrate(
        robot,
        localized,
        robot.fk(q)[:, :3, 3] + rng.normal(0, 1e-4, (60, 3)),
        parameters=("tool",),
        loss="linear",
        covariance=1e-8 * np.eye(3),
        base_covariance=sd[:, None, None] ** 2 * np.eye(3),
    )
    assert np.linalg.norm(result.tool[:3, 3]) < 1e-4
    assert result.variance_factor == pytest.approx(1.0, abs=0.4)


@pytest.mark.parametrize(
    ("name", "size", "other"),
    [
        ("base", 3, {}),
        ("base", 3, {"q_covariance": np.eye(9)}),
        ("q", 9, {"base_covariance": np.tile(np.eye(3), (5, 1, 1))}),
    ],
)
def test_covariances_of_a_wrong_number_are_named(
    name: str, size: int, other: dict[str, object]
) -> None:
    robot = tk.robots.thing()
    q = robot.random(5, rng=0)
    given = {f"{name}_covariance": np.tile(np.eye(size), (4, 1, 1)), **other}
    with pytest.raises(ValueError, match=f"^{name}_covariance: got 4 .* expected one, or 5"):
        est.calibrate(robot, q, robot.fk(q), parameters=("mount",), **given)


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
