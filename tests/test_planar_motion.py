"""Planar motion: exact integration, its derivatives, and covariances against Monte Carlo."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from oracles import derivative
from thing_kin import estimation as est

numbers = st.floats(-3.0, 3.0)
triples = st.tuples(numbers, numbers, numbers).map(np.array)
turning = st.sampled_from([0.0, 1e-12, -1e-8, 1e-4, np.pi, -np.pi, 2 * np.pi]) | numbers
twists = st.tuples(numbers, numbers, turning).map(np.array)
R = np.array([[2e-4, 1e-5, 3e-5], [1e-5, 1e-4, -2e-5], [3e-5, -2e-5, 4e-4]])
P0 = np.array([[3e-4, -5e-5, 2e-5], [-5e-5, 2e-4, 1e-5], [2e-5, 1e-5, 1e-4]])


def same_pose(a, b, atol):
    np.testing.assert_allclose(est.pose_difference(a, b), np.zeros_like(np.asarray(a)), atol=atol)


@given(triples, twists, st.floats(-2.0, 2.0))
def test_it_is_the_solution_of_the_differential_equation(pose, twist, dt) -> None:
    def rate(_, x):
        c, s = np.cos(x[2]), np.sin(x[2])
        return [c * twist[0] - s * twist[1], s * twist[0] + c * twist[1], twist[2]]

    end = solve_ivp(rate, (0.0, dt), pose, rtol=1e-11, atol=1e-12).y[:, -1]
    same_pose(est.integrate_twist(pose, twist, dt), end, atol=1e-8)


@given(triples, twists, st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_times_add(pose, twist, s, t) -> None:
    halfway = est.integrate_twist(pose, twist, s)
    same_pose(
        est.integrate_twist(halfway, twist, t), est.integrate_twist(pose, twist, s + t), 1e-13
    )
    assert -np.pi < halfway[2] <= np.pi


@given(triples, triples, twists)
def test_the_world_may_be_moved(world, pose, twist) -> None:
    c, s = np.cos(world[2]), np.sin(world[2])

    def moved(p):
        return np.array(
            [world[0] + c * p[0] - s * p[1], world[1] + s * p[0] + c * p[1], world[2] + p[2]]
        )

    same_pose(
        est.integrate_twist(moved(pose), twist, 0.7),
        moved(est.integrate_twist(pose, twist, 0.7)),
        1e-13,
    )


@given(triples, twists, st.floats(-2.0, 2.0))
def test_derivatives_are_those_of_differences(pose, twist, dt) -> None:
    """Half a turn from the wrap, where differences of theta are no differences."""
    pose = np.append(pose[:2], -twist[2] * dt + 0.1)  # the end's theta is 0.1
    by_pose, by_twist = est.integrate_twist_jacobians(pose, twist, dt)
    numeric = derivative(lambda x: est.integrate_twist(x, twist, dt), pose)
    np.testing.assert_allclose(by_pose, numeric, atol=1e-9)
    numeric = derivative(lambda x: est.integrate_twist(pose, x, dt), twist)
    np.testing.assert_allclose(by_twist, numeric, atol=1e-9)


@given(triples, triples)
def test_the_difference_is_in_world_axes(a, b) -> None:
    difference = est.pose_difference(2 * a, b)
    np.testing.assert_array_equal(difference[:2], (2 * a - b)[:2])
    assert -np.pi < difference[2] <= np.pi
    turns = (2 * a[2] - b[2] - difference[2]) / (2 * np.pi)
    assert abs(turns - round(turns)) < 1e-15 * 10


@pytest.mark.parametrize("angle", [np.pi, -np.pi, 3 * np.pi])
def test_half_a_turn_is_positive(angle: float) -> None:
    assert est.pose_difference([0, 0, angle], [0, 0, 0])[2] == np.pi


def test_batches_are_loops() -> None:
    rng = np.random.default_rng(0)
    poses, twists, dts = rng.normal(size=(5, 3)), rng.normal(size=(5, 3)), rng.uniform(size=5)
    together = est.integrate_twist(poses, twists, dts)
    single = [est.integrate_twist(*row) for row in zip(poses, twists, dts, strict=True)]
    np.testing.assert_array_equal(together, single)
    np.testing.assert_array_equal(
        est.integrate_twist(poses[0], twists, 0.1),
        [est.integrate_twist(poses[0], twist, 0.1) for twist in twists],
    )
    differences = est.pose_difference(poses, poses[0])
    np.testing.assert_array_equal(differences[0], 0.0)
    assert est.integrate_twist(poses[:0], twists[0], 0.1).shape == (0, 3)


def test_a_record_is_its_steps() -> None:
    rng = np.random.default_rng(1)
    twists, dts = rng.normal(size=(50, 3)), rng.uniform(0.01, 0.2, 50)
    path = est.dead_reckon([1.0, 2.0, 3.0], twists, dts, P0, R)
    pose, P = np.array([1.0, 2.0, 3.0]), P0
    for i, (twist, dt) in enumerate(zip(twists, dts, strict=True)):
        F, G = est.integrate_twist_jacobians(pose, twist, dt)
        pose, P = est.integrate_twist(pose, twist, dt), F @ P @ F.T + G @ R @ G.T
        same_pose(path.poses[i + 1], pose, 1e-14)
        np.testing.assert_allclose(path.covariances[i + 1], P, rtol=1e-11, atol=1e-18)
    np.testing.assert_array_equal(path.covariances, np.swapaxes(path.covariances, 1, 2))


def test_covariance_against_monte_carlo() -> None:
    """30 000 noisy runs: variances within 3 %, seven of their standard deviations (sqrt(2/N))."""
    rng = np.random.default_rng(2)
    count, steps, dt = 30_000, 40, 0.1
    twist = np.array([0.4, 0.2, 0.5])
    samples = rng.multivariate_normal([0.3, -0.2, 0.1], P0, count)
    for _ in range(steps):
        samples = est.integrate_twist(samples, rng.multivariate_normal(twist, R, count), dt)
    path = est.dead_reckon([0.3, -0.2, 0.1], np.tile(twist, (steps, 1)), dt, P0, R)
    errors = est.pose_difference(samples, path.poses[-1])
    P = path.covariances[-1]
    whitened = np.linalg.solve(np.linalg.cholesky(P), errors.T)
    np.testing.assert_allclose(np.cov(whitened), np.eye(3), atol=0.03)


def test_the_covariance_of_a_difference_is_the_sum() -> None:
    rng = np.random.default_rng(3)
    a = rng.multivariate_normal([1.0, 2.0, 3.1], P0, 20_000)
    b = rng.multivariate_normal([0.5, 1.0, -3.1], R, 20_000)
    errors = est.pose_difference(a, b)
    whitened = np.linalg.solve(np.linalg.cholesky(P0 + R), (errors - errors.mean(axis=0)).T)
    np.testing.assert_allclose(np.cov(whitened), np.eye(3), atol=0.04)


def test_the_default_is_that_of_3_22() -> None:
    path = est.dead_reckon([0, 0, 0], np.zeros((4, 3)), 0.5)
    expected = np.diag([0.001, 0.001, 0.03])
    np.testing.assert_allclose(path.covariances[-1], 4 * 0.25 * expected, rtol=1e-15)


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        (([0, 0], [0, 0, 0], 1.0), "pose"),
        (([0, 0, 0], [0, np.nan, 0], 1.0), "twist"),
        (([0, 0, 0], [0, 0, 0], np.inf), "dt"),
        ((np.zeros((2, 3)), np.zeros((3, 3)), 1.0), "twist"),
        ((np.zeros((2, 3)), np.zeros(3), np.ones(3)), "dt"),
    ],
)
def test_misuse(arguments, name: str) -> None:
    with pytest.raises(ValueError, match=f"^{name}: got"):
        est.integrate_twist(*arguments)


@pytest.mark.parametrize("bad", [-np.eye(3), np.array([[1.0, 2, 0], [0, 1, 0], [0, 0, 1]])])
def test_a_covariance_is_checked(bad) -> None:
    with pytest.raises(ValueError, match=r"^covariance: got"):
        est.dead_reckon([0, 0, 0], np.zeros((2, 3)), 0.1, bad)
    with pytest.raises(ValueError, match=r"^twist_covariance: got"):
        est.dead_reckon([0, 0, 0], np.zeros((2, 3)), 0.1, None, bad)
