"""Robots and targets for the tests of inverse kinematics, and the check of what comes out."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

import arms
import thing_kin as tk

Vector = NDArray[np.float64]

ROBOTS: dict[str, Callable[[], tk.Chain]] = {
    "ur10": tk.robots.ur10,
    "ur5": tk.robots.ur5,
    "panda": arms.panda,
    "iiwa14": arms.iiwa14,
    "gen3": arms.gen3,
    "thing": tk.robots.thing,
}


def wide_thing(margin: float) -> tk.Chain:
    """The Thing with so much more room for its base on every side, m."""
    robot = tk.robots.thing()
    room = np.zeros(9)
    room[[robot.names.index("x"), robot.names.index("y")]] = margin
    return robot.with_limits(lower=robot.lower - room, upper=robot.upper + room)


def finite_limits(robot: tk.Chain) -> tuple[Vector, Vector]:
    """A joint without limits within half a turn."""
    lower = np.where(np.isfinite(robot.lower), robot.lower, -np.pi)
    return lower, np.where(np.isfinite(robot.upper), robot.upper, np.pi)


def beside_limits(robot: tk.Chain, q: Vector) -> Vector:
    """Two of five joints within 1e-6 of a limit."""
    rng = np.random.default_rng(1)
    lower, upper = finite_limits(robot)
    gap = rng.uniform(0.0, 1e-6, q.shape)
    side = np.where(rng.random(q.shape) < 0.5, lower + gap, upper - gap)
    return np.where(rng.random(q.shape) < 0.4, side, q)


def beside_singularities(robot: tk.Chain, q: Vector) -> Vector:
    """Elbow or wrist within 1e-6 of zero, where it is stretched, or of the limit nearest to it."""
    rng = np.random.default_rng(2)
    elbow, wrist = {6: (2, 4), 9: (2, 4), 7: (3, 5)}[len(robot.names)]
    lower, upper = finite_limits(robot)
    q = q.copy()
    half = len(q) // 2
    for rows, joint in ((slice(None, half), elbow), (slice(half, None), wrist)):
        q[rows, joint] = np.clip(0.0, lower[joint], upper[joint])
    return np.clip(q + rng.uniform(-1e-6, 1e-6, q.shape), lower, upper)


def check(
    robot: tk.Chain,
    target: Vector,
    result: tk.IkResult | tk.IkBatchResult,
    tolerance: float = 1e-7,
) -> None:
    """Within tolerance and limits, errors and limits as reported."""
    T = robot.fk(result.q)
    position = np.linalg.norm(T[..., :3, 3] - target[..., :3, 3], axis=-1)
    turn = np.swapaxes(T[..., :3, :3], -1, -2) @ target[..., :3, :3]
    skew = (turn - np.swapaxes(turn, -1, -2)) / 2  # a small turn's sine
    sine = np.linalg.norm(skew[..., [2, 0, 1], [1, 2, 0]], axis=-1)
    assert np.all(np.trace(turn, axis1=-2, axis2=-1) > 2.9)
    assert np.max(position) <= tolerance * (1 + 1e-6)
    assert np.max(sine) <= tolerance * (1 + 1e-6)
    rounding = 1e-13 * (1 + np.abs(target[..., :3, 3]).max())
    np.testing.assert_allclose(result.position_error, position, atol=rounding)
    np.testing.assert_allclose(result.rotation_error, sine, atol=1e-13)
    assert np.all((result.q >= robot.lower) & (result.q <= robot.upper))
    at = np.where(result.q == robot.lower, -1, np.where(result.q == robot.upper, 1, 0))
    np.testing.assert_array_equal(result.active_limits, at)
