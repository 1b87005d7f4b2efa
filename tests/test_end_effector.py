"""The hand on an estimated base: against finite differences, and against Monte Carlo."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import thing_kin as tk
from oracles import derivative, vee
from thing_kin import estimation as est

UR5 = tk.robots.ur5()
MOUNT = tk.transform(xyz=(0.1, -0.2, 0.5), rpy=(0.2, -0.1, 0.7))
ROBOTS = {
    "thing": (tk.robots.thing(), None),
    "thing, base first": (tk.robots.thing(order="base_first"), None),
    "pioneer": (tk.robots.pioneer_lx_ur5(), None),
    "tilted": (tk.on_omni_base(UR5, MOUNT), None),
    "an arm alone": (UR5, MOUNT),
    "two joints": (tk.Chain.from_dh([tk.DH(a=0.4), tk.DH(d=0.1, joint="prismatic")]), MOUNT),
}
robots = pytest.mark.parametrize(("robot", "mount"), ROBOTS.values(), ids=ROBOTS)
P_BASE = np.array([[4.0, -1.0, 0.5], [-1.0, 2.0, 0.3], [0.5, 0.3, 1.0]])
P_MOUNT = np.diag([1.0, 2.0, 0.5, 0.3, 0.6, 1.0]) + 0.1


def arm_joints(robot: tk.Chain) -> int:
    return robot.n - (3 if "theta" in robot.names else 0)


def truth(robot, mount, q_arm, base, shift=None):
    """Pose of the hand, written out; `shift` moves the arm's root in the axes of the base."""
    c, s = np.cos(base[2]), np.sin(base[2])
    T_base = np.array([[c, -s, 0, base[0]], [s, c, 0, base[1]], [0, 0, 1, 0], [0, 0, 0, 1]])
    if mount is None:
        names = list(robot.names)
        zero = np.zeros(robot.n)
        mount = robot.fk(zero, frame="mount")
        q = zero.copy()
        q[[i for i, name in enumerate(names) if name not in ("x", "y", "theta")]] = q_arm
        T_mount_hand = np.linalg.inv(mount) @ robot.fk(q)
    else:
        T_mount_hand = robot.fk(q_arm)
    if shift is not None:
        mount = mount.copy()
        mount[:3, 3] += shift[:3]
        mount[:3, :3] = tk.lie.so3_exp(shift[3:]) @ mount[:3, :3]
    return T_base @ mount @ T_mount_hand


def slopes(f, n: int, T):
    """Of the hand, [position, rotation on the left], by n small numbers."""
    D = derivative(f, np.zeros(n))
    rotation = [vee(D[:3, :3, i] @ T[:3, :3].T) for i in range(n)]
    return np.vstack([D[:3, 3], np.transpose(rotation)])


def draw(robot, seed: int):
    rng = np.random.default_rng(seed)
    return rng, rng.uniform(-2.0, 2.0, arm_joints(robot)), rng.uniform(-3.0, 3.0, 3)


@robots
@given(seed=st.integers(0, 10_000))
def test_the_covariance_is_that_of_differences(robot, mount, seed) -> None:
    rng, q, base = draw(robot, seed)
    n = len(q)
    root = rng.normal(size=(n, n))
    P_joints = root @ root.T
    hand = est.end_effector(
        robot,
        q,
        (base, P_BASE),
        joint_covariance=P_joints,
        mount=mount,
        mount_covariance=P_MOUNT,
    )
    T = truth(robot, mount, q, base)
    np.testing.assert_allclose(hand.pose, T, atol=1e-12)
    J_arm = slopes(lambda d: truth(robot, mount, q + d, base), n, T)
    J_base = slopes(lambda d: truth(robot, mount, q, base + d), 3, T)
    J_mount = slopes(lambda d: truth(robot, mount, q, base, d), 6, T)
    expected = J_arm @ P_joints @ J_arm.T + J_base @ P_BASE @ J_base.T
    expected += J_mount @ P_MOUNT @ J_mount.T
    np.testing.assert_allclose(hand.covariance, expected, atol=1e-8 * np.trace(expected))


@robots
@given(seed=st.integers(0, 10_000))
def test_the_task_vector_and_its_covariance(robot, mount, seed) -> None:
    _, q, base = draw(robot, seed)
    hand = est.end_effector(robot, q, (base, P_BASE), 0.1, mount=mount)
    s, S = hand.task_vector, hand.task_covariance
    np.testing.assert_array_equal(s[:3], hand.pose[:3, 3])
    quaternion = tk.lie.quaternion_from_rotation(hand.pose[:3, :3])
    np.testing.assert_allclose(s[3:7], quaternion, atol=1e-15)
    np.testing.assert_array_equal(s[7:], base)
    np.testing.assert_allclose(S[:3, :3], hand.covariance[:3, :3], rtol=1e-13, atol=1e-13)
    np.testing.assert_array_equal(S[7:, 7:], P_BASE)
    np.testing.assert_array_equal(S, S.T)
    size = np.trace(S)
    np.testing.assert_allclose(S[:, 3:7] @ quaternion, 0.0, atol=1e-15 * size)  # of norm one
    assert np.linalg.eigvalsh(S).min() > -1e-14 * size
    if mount is not None:
        return
    full = np.zeros(robot.n)
    moving = [name not in ("x", "y", "theta") for name in robot.names]
    full[moving], full[[robot.names.index(n) for n in ("x", "y", "theta")]] = q, base
    np.testing.assert_allclose(s, robot.task_vector(full), atol=1e-12)
    J = robot.task_jacobian(full)
    P = np.zeros((robot.n, robot.n))
    P[moving, moving] = 0.01
    at = [robot.names.index(n) for n in ("x", "y", "theta")]
    P[np.ix_(at, at)] = P_BASE
    np.testing.assert_allclose(S, J @ P @ J.T, atol=1e-13 * size)


@robots
@pytest.mark.parametrize(("size", "tolerance"), [(1e-4, 0.04), (1e-2, 0.04), (0.1, 0.2)])
def test_against_monte_carlo(robot, mount, size, tolerance) -> None:
    """20 000 samples: a covariance's entries are within 4 %; at 0.1 rad first order ends."""
    rng, q, base = draw(robot, 3)
    count, n = 20_000, len(q)
    hand = est.end_effector(
        robot, q, (base, size**2 * P_BASE / 4), size, mount=mount, mount_covariance=None
    )
    bases = rng.multivariate_normal(base, size**2 * P_BASE / 4, count)
    samples = est.end_effector(robot, q + size * rng.normal(size=(count, n)), bases, mount=mount)
    errors = np.concatenate(
        [
            samples.pose[:, :3, 3] - hand.pose[:3, 3],
            tk.lie.so3_log(samples.pose[:, :3, :3] @ hand.pose[:3, :3].T),
        ],
        axis=1,
    )
    # In coordinates where the covariance is the identity; directions without variance left out.
    values, vectors = np.linalg.eigh(hand.covariance)
    kept = values > 1e-6 * values.max()
    whitened = errors @ vectors[:, kept] / np.sqrt(values[kept])
    second = whitened.T @ whitened / count
    np.testing.assert_allclose(second, np.eye(kept.sum()), atol=tolerance)
    if size < 0.1:
        null = errors @ vectors[:, ~kept]
        assert np.abs(null).max(initial=0.0) < 20 * size**2  # of second order


@robots
def test_batches_are_loops(robot, mount) -> None:
    rng, _, _ = draw(robot, 0)
    q, bases = rng.normal(size=(4, arm_joints(robot))), rng.normal(size=(4, 3))
    covariances = np.stack([P_BASE * i for i in range(4)])
    together = est.end_effector(robot, q, (bases, covariances), 0.01, mount=mount)
    for i in range(4):
        one = est.end_effector(robot, q[i], (bases[i], covariances[i]), 0.01, mount=mount)
        for name in ("pose", "covariance", "task_vector", "task_covariance"):
            np.testing.assert_array_equal(getattr(together, name)[i], getattr(one, name))
    for few in (
        est.end_effector(robot, q[0], (bases, P_BASE), mount=mount),
        est.end_effector(robot, q, bases[0], mount=mount),
        est.end_effector(robot, q[0], (bases[0], covariances), mount=mount),
    ):
        assert few.pose.shape == (4, 4, 4)


def test_any_estimate_will_do() -> None:
    robot, q = ROBOTS["thing"][0], np.full(6, 0.3)
    estimate = SimpleNamespace(pose=np.array([1.0, 2.0, 0.5]), covariance=P_BASE, twist=None)
    by_object = est.end_effector(robot, q, estimate)
    by_pair = est.end_effector(robot, q, (estimate.pose, estimate.covariance))
    np.testing.assert_array_equal(by_object.covariance, by_pair.covariance)
    known = est.end_effector(robot, q, estimate.pose)
    np.testing.assert_array_equal(known.covariance, 0.0)
    np.testing.assert_array_equal(known.pose, by_object.pose)


def test_a_frame_of_the_arm() -> None:
    robot, q = ROBOTS["thing"][0], np.full(6, 0.3)
    elbow = est.end_effector(robot, q, [0.0, 0.0, 0.0], 0.1, frame="forearm")
    np.testing.assert_array_equal(
        elbow.pose, robot.fk(np.append(q, [0.0, 0.0, 0.0]), frame="forearm")
    )
    mount = est.end_effector(robot, q, [0.0, 0.0, 0.0], 0.1, frame="mount")
    np.testing.assert_array_equal(mount.covariance, 0.0)
    for frame in ("base", "world"):
        with pytest.raises(ValueError, match=rf"^frame: got '{frame}', expected a frame of the"):
            est.end_effector(robot, q, [0.0, 0.0, 0.0], frame=frame)


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("q_arm", {"q_arm": np.zeros(9)}),
        ("q_arm", {"q_arm": np.full(6, np.nan)}),
        ("estimate", {"estimate": [0.0, 0.0]}),
        ("estimate", {"estimate": ([0.0, 0.0, 0.0], -np.eye(3))}),
        ("estimate", {"estimate": ([0.0, 0.0, 0.0], np.full((3, 3), np.nan))}),
        ("estimate", {"estimate": (np.zeros((2, 3)), np.zeros((3, 3, 3)))}),
        ("estimate", {"estimate": None}),
        ("joint_std", {"joint_std": -1.0}),
        ("joint_std", {"joint_std": np.zeros(5)}),
        ("joint_covariance", {"joint_covariance": -np.eye(6)}),
        ("joint_covariance", {"joint_covariance": np.eye(6), "joint_std": 0.1}),
        ("mount", {"mount": np.eye(4)}),
        ("mount_covariance", {"mount_covariance": np.eye(3)}),
        ("mount_covariance", {"mount_covariance": -np.eye(6)}),
        ("frame", {"frame": "nose"}),
    ],
)
def test_misuse(name: str, arguments) -> None:
    good = {"robot": ROBOTS["thing"][0], "q_arm": np.zeros(6), "estimate": [0.0, 0.0, 0.0]}
    with pytest.raises(ValueError, match=f"^{name}: got"):
        est.end_effector(**{**good, **arguments})
