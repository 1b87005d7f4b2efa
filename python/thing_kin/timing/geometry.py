"""A smooth curve through waypoints that stays beside the straight lines between them.

A natural cubic spline in C2 is bent least, but swings out at corners. Where it leaves the tube
around the polyline, points of the polyline are added beside the corner and the spline is made
anew; the wider the angle, the closer they stand. What is then left is proved, not sampled: a
quintic lies in the hull of its Bernstein coefficients, so a bound on these bounds the curve.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thing_kin.timing.quintic import Quintic

Array = NDArray[np.float64]

SAME_POINT = 1e-9  # rad or m: waypoints closer than this are one
UNCLIPPED_ROUNDS = 8  # of adding points, before slopes are also forced into the tube
MAX_ROUNDS = 60  # each halves a piece at least: enough for any tolerance above rounding


@dataclass(frozen=True)
class Curve:
    """The curve over its parameter s, and the bound of its deviation from the polyline."""

    shape: Quintic
    deviation_bound: float
    corners: Array  # (M, n): the polyline, without repetitions
    corner_s: Array  # (M,)
    lower: Array  # (n,): the box that it stays in
    upper: Array


def without_repetitions(q: Array) -> Array:
    """Leave out waypoints that stand where the one before stands; the last always stays."""
    kept = [0]
    for i in range(1, len(q)):
        if np.abs(q[i] - q[kept[-1]]).max() > SAME_POINT:
            kept.append(i)
    points = q[kept]
    points[-1] = q[-1] if len(kept) > 1 else points[-1]
    return points


def smooth_curve(q: Array, speed: Array, tolerance: float, lower: Array, upper: Array) -> Curve:
    """Curve through the waypoints q (M, n), M >= 2, no two neighbors equal.

    s measures time at the joints' top speeds, `speed` (n,). Each joint stays within `tolerance` of
    the polyline at the same s, and within its limits.
    """
    corner_s = np.concatenate([[0.0], np.cumsum((np.abs(np.diff(q, axis=0)) / speed).max(axis=1))])
    s, y = corner_s, q
    for rounds in range(MAX_ROUNDS):
        shape = _spline(s, y)
        if rounds >= UNCLIPPED_ROUNDS:
            shape = _clipped_to_tube(shape, tolerance)
        shape = _clipped_to_box(shape, lower, upper)
        deviation = _deviation_bounds(shape)
        # The last round can only be reached by pieces of the size of rounding errors.
        wide = deviation > tolerance
        if not wide.any():
            break
        s, y = _with_more_points(s, y, wide, tolerance)
    return Curve(shape, float(deviation.max()), q, corner_s, lower, upper)


def _spline(s: Array, y: Array) -> Quintic:
    from scipy.interpolate import CubicSpline

    spline = CubicSpline(s, y, bc_type="natural")
    return Quintic(s, y, np.asarray(spline(s, 1)), np.asarray(spline(s, 2)))


def _inner_bernstein(shape: Quintic) -> tuple[Array, Array, Array, Array]:
    """Bernstein coefficients 1 to 4, less the nearer knot's value."""
    h = np.diff(shape.x)[:, None]
    v, a = shape.dy, shape.ddy
    one = h * v[:-1] / 5.0
    four = -h * v[1:] / 5.0
    two = 2.0 * one + h * h * a[:-1] / 20.0
    three = 2.0 * four + h * h * a[1:] / 20.0
    return one, two, three, four


def _deviation_bounds(shape: Quintic) -> Array:
    """(K - 1,): no joint is farther than this from the chord at the same s."""
    fifth = np.diff(shape.y, axis=0) / 5.0
    one, two, three, four = _inner_bernstein(shape)
    ends = np.stack([one - fifth, two - 2 * fifth, three + 2 * fifth, four + fifth])
    return np.asarray(np.abs(ends).max(axis=(0, 2)))


def _with_more_points(
    s: Array, y: Array, wide: NDArray[np.bool_], tolerance: float
) -> tuple[Array, Array]:
    """Points of the chords of the wide pieces: beside a corner where that helps, else halfway."""
    h = np.diff(s)
    turn = np.zeros(len(s))  # change of slope at each knot, of the joint that turns most
    slope = np.diff(y, axis=0) / h[:, None]
    turn[1:-1] = np.abs(np.diff(slope, axis=0)).max(axis=1)
    beside = np.where(turn > 0, 5.0 * tolerance / np.maximum(turn, 1e-300), np.inf)
    new = []
    for k in np.flatnonzero(wide):
        near = [s[k] + d for d in [beside[k]] if d < 0.45 * h[k]]
        near += [s[k + 1] - d for d in [beside[k + 1]] if d < 0.45 * h[k]]
        new += near or [s[k] + 0.5 * h[k]]
    added = np.array(new)
    at = np.searchsorted(s, added) - 1
    points = y[at] + ((added - s[at]) / h[at])[:, None] * (y[at + 1] - y[at])
    order = np.argsort(np.concatenate([s, added]), kind="stable")
    return np.concatenate([s, added])[order], np.concatenate([y, points])[order]


def _clipped_to_tube(shape: Quintic, tolerance: float) -> Quintic:
    """Slopes and second derivatives that no Bernstein coefficient leaves the tube with, if any."""
    h = np.diff(shape.x)[:, None]
    slope = np.diff(shape.y, axis=0) / h
    room = 1.25 * tolerance / h  # half of the tube for the slope, half for the second derivative
    low, high = _both_sides(slope - room, slope + room)
    middle = 0.5 * (low + high)
    v = np.where(low <= high, np.clip(shape.dy, low, high), middle)
    # 2/5 (h v - step) + h^2 a / 20 within the tolerance, on the left with -v.
    right = -8.0 * (v[:-1] - slope) / h
    left = 8.0 * (v[1:] - slope) / h
    reach = 20.0 * tolerance / h**2
    low, high = _both_sides(left - reach, left + reach, right - reach, right + reach)
    return Quintic(shape.x, shape.y, v, _clip(shape.ddy, low, high))


def _clipped_to_box(shape: Quintic, lower: Array, upper: Array) -> Quintic:
    """No Bernstein coefficient outside the joints' limits, so no overshoot beyond them."""
    h = np.diff(shape.x)[:, None]
    above, below = upper - shape.y, shape.y - lower
    # 2/5 h |v| stays in the room on that side: with v >= 0 above on the right, below on the left.
    least, most = np.full_like(shape.y, -np.inf), np.full_like(shape.y, np.inf)
    most[:-1] = np.minimum(most[:-1], 2.5 * above[:-1] / h)
    most[1:] = np.minimum(most[1:], 2.5 * below[1:] / h)
    least[:-1] = np.maximum(least[:-1], -2.5 * below[:-1] / h)
    least[1:] = np.maximum(least[1:], -2.5 * above[1:] / h)
    v = np.clip(shape.dy, np.minimum(least, 0.0), np.maximum(most, 0.0))
    scale = 20.0 / h**2
    right_low = -scale * (below[:-1] + 0.4 * h * v[:-1])
    right_high = scale * (above[:-1] - 0.4 * h * v[:-1])
    left_low = -scale * (below[1:] - 0.4 * h * v[1:])
    left_high = scale * (above[1:] + 0.4 * h * v[1:])
    low, high = _both_sides(left_low, left_high, right_low, right_high)
    return Quintic(shape.x, shape.y, v, _clip(shape.ddy, low, high))


def _both_sides(
    left_low: Array,
    left_high: Array,
    right_low: Array | None = None,
    right_high: Array | None = None,
) -> tuple[Array, Array]:
    """Bounds at each knot from those of the pieces left and right of it."""
    right_low = left_low if right_low is None else right_low
    right_high = left_high if right_high is None else right_high
    edge = np.full((1, left_low.shape[1]), np.inf)
    low = np.maximum(np.concatenate([-edge, left_low]), np.concatenate([right_low, -edge]))
    high = np.minimum(np.concatenate([edge, left_high]), np.concatenate([right_high, edge]))
    return low, high


def _clip(values: Array, low: Array, high: Array) -> Array:
    """Clip; bounds that cross by rounding meet in the middle."""
    crossed = low > high
    middle = 0.5 * (np.where(crossed, low, 0.0) + np.where(crossed, high, 0.0))
    return np.where(crossed, middle, np.clip(values, np.minimum(low, high), np.maximum(low, high)))
