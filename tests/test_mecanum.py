"""Wheel odometry: [M17] (3.20) both ways, orders of wheels, records, encoders."""

from itertools import permutations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thing_kin import estimation as est

NAMES = ("fl", "rl", "rr", "fr")
lengths = st.floats(0.02, 2.0)
speeds = st.tuples(*[st.floats(-20.0, 20.0)] * 4).map(np.array)
twists = st.tuples(*[st.floats(-2.0, 2.0)] * 3).map(np.array)
orders = st.sampled_from(list(permutations(NAMES)))


def equation_3_20(radius: float, k: float):
    """As it is printed."""
    rows = [[1, 1, 1, 1], [-1, 1, -1, 1], [-1 / k, -1 / k, 1 / k, 1 / k]]
    return radius / 4 * np.array(rows)


@given(lengths, lengths, speeds)
def test_it_is_the_equation(radius, k, w) -> None:
    expected = equation_3_20(radius, k) @ w
    np.testing.assert_allclose(est.MecanumOdometry(radius, k).twist(w), expected, atol=1e-12)


@given(lengths, lengths, twists, orders)
def test_both_ways(radius, k, twist, order) -> None:
    wheels = est.MecanumOdometry(radius, k, order)
    w = wheels.wheel_speeds(twist)
    np.testing.assert_allclose(wheels.twist(w), twist, atol=1e-13)
    assert abs(wheels.slip(w)) < 1e-13
    pinv = np.linalg.pinv(equation_3_20(radius, k))  # of all inverses the one without slip
    np.testing.assert_allclose([w[order.index(n)] for n in NAMES], pinv @ twist, atol=1e-10)


@given(speeds, orders)
def test_the_order_is_a_renaming(w, order) -> None:
    plain, other = est.MecanumOdometry(0.07, 0.4), est.MecanumOdometry(0.07, 0.4, order=order)
    listed = np.array([w[NAMES.index(name)] for name in order])
    np.testing.assert_array_equal(other.twist(listed), plain.twist(w))
    assert other.slip(listed) == plain.slip(w)
    assert other.order == order


@given(speeds)
def test_the_residual_of_the_wheels_is_the_slip(w) -> None:
    wheels = est.MecanumOdometry(0.1, 0.5)
    rest = 0.1 * (w - wheels.wheel_speeds(wheels.twist(w)))
    np.testing.assert_allclose(rest, wheels.slip(w) * np.array([1, -1, -1, 1]), atol=1e-12)


def test_directions_by_eye() -> None:
    wheels = est.MecanumOdometry(0.1, 0.5)
    forwards, left, turn = wheels.wheel_speeds(np.eye(3))
    np.testing.assert_allclose(forwards, [10, 10, 10, 10])
    np.testing.assert_allclose(left, [-10, 10, -10, 10])
    np.testing.assert_allclose(turn, [-5, -5, 5, 5])


def record(seed: int = 0, count: int = 200):
    rng = np.random.default_rng(seed)
    t = 1.6e9 + np.cumsum(rng.uniform(0.01, 0.05, count))
    twists = np.cumsum(rng.normal(size=(count, 3)), axis=0) * 0.05
    return t, twists


def test_a_record_of_speeds_and_one_of_angles_are_one() -> None:
    t, twists = record()
    wheels = est.MecanumOdometry(0.07, 0.37, order=("fl", "fr", "rl", "rr"))
    w = wheels.wheel_speeds(twists)
    angles = np.vstack([np.zeros(4), np.cumsum(w[1:] * np.diff(t)[:, None], axis=0)]) + 100.0
    P0 = np.diag([1e-4, 2e-4, 3e-4])
    by_speed = wheels.integrate(t, w, [1.0, 2.0, 3.0], P0)
    by_angle = wheels.integrate_angles(t, angles, [1.0, 2.0, 3.0], P0)
    np.testing.assert_allclose(by_angle.poses, by_speed.poses, atol=1e-9)
    np.testing.assert_allclose(by_angle.covariances, by_speed.covariances, atol=1e-9)
    path = est.dead_reckon([1.0, 2.0, 3.0], twists[1:], np.diff(t), P0)
    np.testing.assert_allclose(by_speed.poses, path.poses, atol=1e-12)
    np.testing.assert_allclose(by_speed.covariances, path.covariances, atol=1e-14)


def test_a_variance_for_each_metre() -> None:
    t = np.linspace(0.0, 10.0, 101)
    wheels = est.MecanumOdometry(0.1, 0.5)
    w = np.tile(wheels.wheel_speeds([0.3, 0.0, 0.0]), (101, 1))
    path = wheels.integrate(t, w, slip_variance=[1e-4, 2e-4, 0.0])
    np.testing.assert_allclose(path.covariances[-1], np.diag([3e-4, 6e-4, 0.0]), atol=1e-15)
    still = wheels.integrate(t, 0 * w, slip_variance=[1e-4, 2e-4, 0.0])
    np.testing.assert_array_equal(still.covariances[-1], 0.0)
    with pytest.raises(ValueError, match=r"^slip_variance: got twist_covariance"):
        wheels.integrate(t, w, slip_variance=[1, 1, 1], twist_covariance=np.eye(3))
    with pytest.raises(ValueError, match=r"^slip_variance: got -1"):
        wheels.integrate(t, w, slip_variance=[1, -1, 1])


@given(st.integers(8, 20), st.integers(0, 1000))
def test_counters_overflow(bits: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    half = 2 ** (bits - 1)
    ticks = np.cumsum(rng.integers(-half + 1, half, size=(50, 4)), axis=0) + 12345
    expected = ticks * 2 * np.pi / 210
    angles = est.angles_from_ticks(ticks % 2**bits, 210, counter_range=2**bits)
    np.testing.assert_allclose(
        np.diff(angles, axis=0), np.diff(expected, axis=0), atol=1e-9 * 2**bits
    )
    np.testing.assert_allclose(est.angles_from_ticks(ticks, 210), expected, rtol=1e-14)


def test_differential_drive() -> None:
    drive = est.DifferentialDriveOdometry((0.1, 0.11), track=0.4)
    for twist in ([0.5, 0.0, 0.0], [0.0, 0.0, 1.0], [0.3, 0.0, -0.7]):
        np.testing.assert_allclose(drive.twist(drive.wheel_speeds(twist)), twist, atol=1e-15)
    # By hand: the left wheel stands, the base turns about it.
    np.testing.assert_allclose(drive.twist([0.0, 2.0]), [0.11, 0.0, 0.55])
    end = drive.integrate_angles([0.0, 1.0], [[0, 0], [0.0, np.pi * 0.4 / 0.11]]).poses[-1]
    np.testing.assert_allclose(end, [0.0, 0.4, np.pi], atol=1e-15)
    with pytest.raises(ValueError, match=r"^twist: got vy = 0.1"):
        drive.wheel_speeds([0.5, 0.1, 0.0])
    assert drive == est.DifferentialDriveOdometry((0.1, 0.11), 0.4)
    t = np.linspace(0, 1, 11)
    np.testing.assert_allclose(
        drive.integrate(t, np.full((11, 2), 3.0)).poses,
        drive.integrate_angles(t, 3.0 * np.stack([t, t], axis=1)).poses,
        atol=1e-14,
    )


@pytest.mark.parametrize(
    ("order", "said"),
    [
        (("fl", "fl", "rr", "fr"), "each of 'fl', 'rl', 'rr', 'fr' once"),
        (("fl", "rl", "rr"), "in any order"),
        ("flrl", "in any order"),
        (None, "in any order"),
        ((1, 2, 3, 4), "in any order"),
    ],
)
def test_an_order_is_checked(order, said: str) -> None:
    with pytest.raises(ValueError, match=rf"^order: got .*{said}"):
        est.MecanumOdometry(0.1, 0.5, order=order)


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf])
def test_lengths_are_positive(bad: float) -> None:
    with pytest.raises(ValueError, match=r"^wheel_radius: got"):
        est.MecanumOdometry(bad, 0.5)
    with pytest.raises(ValueError, match=r"^k: got"):
        est.MecanumOdometry(0.1, bad)
    with pytest.raises(ValueError, match=r"^track: got"):
        est.DifferentialDriveOdometry(0.1, bad)
    with pytest.raises(ValueError, match=r"^ticks_per_turn: got"):
        est.angles_from_ticks([[0]], bad)


def test_records_are_checked() -> None:
    wheels = est.MecanumOdometry(0.1, 0.5)
    with pytest.raises(ValueError, match=r"^t: got a stamp before the last one, at index 2"):
        wheels.integrate([0.0, 1.0, 0.5], np.zeros((3, 4)))
    with pytest.raises(ValueError, match=r"^t: got shape \(2,\)"):
        wheels.integrate([0.0, 1.0], np.zeros((3, 4)))
    with pytest.raises(ValueError, match=r"^wheel_angles: got shape \(0, 4\)"):
        wheels.integrate_angles([], np.zeros((0, 4)))
