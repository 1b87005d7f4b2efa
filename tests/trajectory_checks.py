"""What a trajectory must be, checked by means that thing_kin.timing does not use."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

import thing_kin as tk

Array = NDArray[np.float64]


def distance_to_polyline(points: Array, q: Array) -> Array:
    """(M,): largest joint difference to the nearest point of the straight lines through q."""
    best = np.abs(points[:, None] - q[None]).max(axis=2).min(axis=1)
    for a, b in pairwise(q):
        low, high = np.zeros(len(points)), np.ones(len(points))
        for _ in range(60):  # a maximum of absolute values is convex: golden section would do, too
            left, right = low + (high - low) / 3, high - (high - low) / 3
            far = [np.abs(points - (a + u[:, None] * (b - a))).max(axis=1) for u in (left, right)]
            low, high = np.where(far[0] > far[1], left, low), np.where(far[0] > far[1], high, right)
        best = np.minimum(best, np.minimum(*far))
    return best


def assert_rest_to_rest(trajectory: tk.Trajectory, q: Array) -> None:
    t = np.array([-1.0, 0.0, trajectory.duration, trajectory.duration + 1.0])
    at, qd, qdd = trajectory.sample(t)
    np.testing.assert_array_equal(at, q[[0, 0, -1, -1]])
    np.testing.assert_array_equal(qd, np.zeros_like(qd))
    # To rounding: the last acceleration is a sum of coefficients, 1e-16 |q| / h^2 each.
    np.testing.assert_allclose(qdd, 0.0, atol=1e-6)


def assert_consistent(trajectory: tk.Trajectory, n_samples: int = 3001) -> None:
    """Each rate is the central difference of the one before; acceleration has no jump."""
    h = 1e-5 * trajectory.duration
    t = np.linspace(2 * h, trajectory.duration - 2 * h, n_samples)
    center = trajectory.sample(t, 3)
    after, before = trajectory.sample(t + h, 3), trajectory.sample(t - h, 3)
    for order in range(2):
        slope = (after[order] - before[order]) / (2 * h)
        # What the next derivative changes over the step bounds the error, knots inside or not.
        near = np.stack([before[order + 1], center[order + 1], after[order + 1]])
        change = np.ptp(near, axis=0) + 1e-3 * np.abs(near).max() * h + 1e-10
        assert (np.abs(slope - center[order + 1]) <= 1.5 * change + 1e-14 / h).all()
    knots = trajectory.times[1:-1]
    eps = 1e-9 * trajectory.duration
    jump = np.abs(trajectory.sample(knots + eps)[2] - trajectory.sample(knots - eps)[2])
    jerk = np.abs(trajectory.sample(np.concatenate([knots - eps, knots + eps]), 3)[3]).max(
        initial=0
    )
    assert jump.max(initial=0.0) <= 4 * eps * jerk + 1e-7


def assert_within(
    trajectory: tk.Trajectory,
    velocity: Array | float = np.inf,
    acceleration: Array | float = np.inf,
    jerk: Array | float = np.inf,
    n_samples: int = 20_001,
) -> None:
    t = np.linspace(0.0, trajectory.duration, n_samples)
    _, qd, qdd, qddd = trajectory.sample(t, 3)
    for rate, limit in ((qd, velocity), (qdd, acceleration), (qddd, jerk)):
        assert (np.abs(rate) <= np.asarray(limit) * (1 + 1e-9) + 1e-12).all()


def wheel_speeds(wheels: tk.WheelLimits, base: Array, rate: Array) -> Array:
    """(M, 4) of the base's poses and their rates (M, 3): [M17] (3.20), solved for the wheels."""
    forward = wheels.radius / 4 * np.array(
        [[1, 1, 1, 1], [-1, 1, -1, 1], np.array([-1, -1, 1, 1]) / wheels.k]
    )  # fmt: skip
    speeds = []
    for (_, _, theta), (vx, vy, omega) in zip(base, rate, strict=True):
        c, s = np.cos(theta), np.sin(theta)
        twist = np.array([c * vx + s * vy, -s * vx + c * vy, omega])
        speeds.append(np.linalg.pinv(forward) @ twist)
    return np.array(speeds)
