"""Curve and speed profile together: the motion, and the stretch that keeps its limits."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from thing_kin.timing.fastest import fastest
from thing_kin.timing.geometry import Curve
from thing_kin.timing.limits import RateLimits, over
from thing_kin.timing.quintic import Quintic
from thing_kin.timing.smooth import Profile

Array = NDArray[np.float64]

GRID = 240  # steps along the path, shared by its pieces in proportion to their length
PER_PIECE = 3  # at least
WINDOWS = np.geomspace(4e-3, 0.3, 10)  # of the smoothing, in durations: the best is taken
POSITION_ERROR, RATE_ERROR = 1e-8, 1e-2  # of quintics in time: rad or m; share of the limit
ROUNDING_JERK = 60 * 2e-16 / 1e-3  # see _shortest_piece
FINER, FAR_OFF = 30.0, 30.0  # pieces; position errors
MAX_KNOTS = 20_000
NARROWER, SOFTER = (0.6, 1.0, 1.7), (0.4, 0.6, 1.0, 1.7, 3.0)  # times the best one so far
ROUNDS, GOOD_ENOUGH = 7, 1.005  # of lowering the speed where needed
FITS, GOOD_FIT = 3, 1.02  # of quintics
OUTSIDE = 1e-12  # rad or m: rounding of a hull that touches a limit
MARGIN = 1e-9  # of the limits, for the rounding of whoever checks


def retimed(curve: Curve, limits: RateLimits) -> tuple[Quintic, float]:
    """Motion over time along the curve, rest to rest, within all limits; how far it is off it.

    Smoothed, the fastest profile breaks limits here and there; asked to be slower there, it needs
    no slowing down of the whole. The best of a few rounds is tried in earnest, as quintics.
    """
    grid = _grid(curve.shape.x)
    slower, cap = np.ones_like(grid), np.full_like(grid, np.inf)
    best: tuple[Quintic, float] | None = None
    for _ in range(FITS):
        profile, window, total = _slowed(curve, limits, grid, slower, cap)
        fit = _quintics(curve, profile, window, limits)
        stretch = _stretch(limits.ratios(fit))
        motion = fit.stretched(float(stretch.max()) * (1.0 + MARGIN))
        if best is None or motion.x[-1] < best[0].x[-1]:
            pairs = _beside(curve, profile, window, fit)
            best = motion, max(float(np.abs(true.y - q).max()) for true, (q, _, _) in pairs)
        if fit.x[-1] * stretch.max() < GOOD_FIT * total:
            break
        here = _while_in(fit.x[:-1], fit.x[1:], stretch, profile, window)
        _slow_down(here, profile, slower, cap)
    if best is None:
        raise AssertionError("no round")
    return best


def _slowed(
    curve: Curve, limits: RateLimits, grid: Array, slower: Array, cap: Array
) -> tuple[Profile, float, float]:
    """Profile and window of the shortest duration, and that; slower and cap go on being lowered."""
    best: tuple[Profile, float, float] | None = None
    for _ in range(ROUNDS):
        profile = Profile.of(grid, fastest(curve.shape, limits, grid, slower, cap))
        window, total = _best_window(curve, profile, limits, best and best[1])
        if best is None or total < best[2]:
            best = profile, window, total
        t = _samples(profile, window)
        stretch = _stretch(_ratios(curve, profile, window, limits, t))
        if stretch.max() < GOOD_ENOUGH:
            break
        _slow_down(_while_in(t, t, stretch, profile, window), profile, slower, cap)
    if best is None:
        raise AssertionError("no round")
    return best


def _while_in(begin: Array, end: Array, stretch: Array, profile: Profile, window: float) -> Array:
    """(N,): the largest stretch of what happens while each point of the grid is in the window."""
    first = np.searchsorted(end, np.append(profile.t[0], profile.t[:-1]))
    last = np.searchsorted(begin, np.append(profile.t[1:], profile.t[-1]) + window, side="right")
    return np.array([stretch[a:b].max(initial=0.0) for a, b in zip(first, last, strict=True)])


def _slow_down(here: Array, profile: Profile, slower: Array, cap: Array) -> None:
    slower *= np.clip(here, 1.0, 3.0)
    inside = here > 1.0
    inside[[0, -1]] = False  # at rest anyway
    cap[inside] = np.minimum(cap, profile.speed / here)[inside]


def within_limits(motion: Quintic, limits: RateLimits) -> Quintic:
    """Stretch (or shorten) time by one factor, so that the tightest limit is just kept."""
    return motion.stretched(float(_stretch(limits.ratios(motion)).max()) * (1.0 + MARGIN))


def _grid(knots: Array) -> Array:
    step = np.diff(knots)
    count = np.maximum(np.ceil(GRID * step / (knots[-1] - knots[0])).astype(int), PER_PIECE)
    inner = [a + h * np.arange(m) / m for a, h, m in zip(knots[:-1], step, count, strict=True)]
    return np.concatenate([*inner, knots[-1:]])


def _best_window(
    curve: Curve, profile: Profile, limits: RateLimits, near: float | None
) -> tuple[float, float]:
    """Choose the window; return it and the duration with it.

    Narrow: hardly slower, but a jerk. Wide: soft, but out of step with the curve's bends.
    """
    soft = np.isfinite(limits.jerk) & np.isfinite(limits.acceleration) & (limits.jerk > 0)
    if near is None:
        ramps = np.unique(limits.acceleration[soft] / limits.jerk[soft])
        windows = [*(WINDOWS * profile.duration), *ramps]
    else:
        windows = [x * near for x in (SOFTER if soft.any() else NARROWER)]
    totals = []
    for window in windows:
        rates = _ratios(curve, profile, window, limits, _samples(profile, window))
        totals.append((profile.duration + window) * float(_stretch(rates).max()))
    best = int(np.argmin(totals))
    return float(windows[best]), totals[best]


def _samples(profile: Profile, window: float) -> Array:
    breaks = profile.breaks(window)
    step = np.diff(breaks)
    fractions = [breaks[:-1] + x * step for x in (1e-3, 0.25, 0.5, 0.75, 1.0 - 1e-3)]
    return np.stack(fractions, axis=1).reshape(-1)


def _stretch(ratios: tuple[Any, Any, Any]) -> Array:
    """Slower by this, what has these ratios of velocity, acceleration and jerk is within."""
    velocity, acceleration, jerk = ratios
    return np.asarray(np.maximum(np.maximum(velocity, np.sqrt(acceleration)), np.cbrt(jerk)))


def _ratios(
    curve: Curve, profile: Profile, window: float, limits: RateLimits, t: Array
) -> tuple[Array, Array, Array]:
    """Of the exact motion at the times t, (M,) each."""
    s, ds, dds, ddds = (x[:, None] for x in profile.smoothed(t, window))
    q, a, b, c = curve.shape(s[:, 0], 3)
    velocity = over(a * ds, limits.velocity)
    if limits.wheels is not None:
        base = list(limits.base_joints)
        wheels = np.einsum("mij,mj->mi", limits.wheel_rows(q[:, base[2]]), (a * ds)[:, base])
        velocity = np.maximum(velocity, np.abs(wheels).max(axis=1))
    return (
        velocity,
        over(b * ds**2 + a * dds, limits.acceleration),
        over(c * ds**3 + 3.0 * b * ds * dds + a * ddds, limits.jerk),
    )


def _motion(curve: Curve, profile: Profile, window: float, t: Array) -> Quintic:
    s, ds, dds, _ = (x[:, None] for x in profile.smoothed(t, window))
    q, a, b = curve.shape(s[:, 0], 2)
    return Quintic(t, q, a * ds, b * ds**2 + a * dds)


def _quintics(curve: Curve, profile: Profile, window: float, limits: RateLimits) -> Quintic:
    """Knots in time between which quintics are the motion: halved until they are."""
    end = profile.duration + window
    t = np.union1d(_passing_times(curve, profile, window), np.linspace(0.0, end, 33))
    if np.isfinite(limits.jerk).any():
        t = np.union1d(t, profile.breaks(window))
    rough = _motion(curve, profile, window, _samples(profile, window))
    shortest = _shortest_piece(rough, window)
    t = _apart(t, shortest / FINER)
    while len(t) < MAX_KNOTS:
        motion = _motion(curve, profile, window, t)
        worst = _off(curve, profile, window, limits, motion)
        # Where the path itself is missed, pieces may be so short that some jerk is rounding.
        least = np.where(worst > FAR_OFF, shortest / FINER, shortest)
        bad = (worst > 1.0) & (np.diff(t) > 2.0 * least)
        if not bad.any():
            break
        t = np.sort(np.concatenate([t, 0.5 * (t[:-1] + t[1:])[bad]]))
    return _resting(_motion(curve, profile, window, t), curve)


def _shortest_piece(motion: Quintic, window: float) -> float:
    """Below this, rounding of positions would be jerk: 60 eps |q| / h^3 of acceleration/window."""
    top = np.abs(motion.ddy).max(initial=1e-12)
    return float(np.cbrt(ROUNDING_JERK * np.abs(motion.y).max(initial=1e-3) * window / top))


def _apart(t: Array, least: float) -> Array:
    """Leave out times that are too near to the one before; the last stays."""
    kept = [0]
    for i in range(1, len(t)):
        if t[i] - t[kept[-1]] >= least:
            kept.append(i)
    kept[-1] = len(t) - 1 if len(kept) > 1 else 0
    return t[kept] if len(kept) > 1 else t[[0, -1]]


def _resting(motion: Quintic, curve: Curve) -> Quintic:
    """Begin and end exactly at the path's ends, at rest."""
    y, dy, ddy = motion.y.copy(), motion.dy.copy(), motion.ddy.copy()
    y[0], y[-1] = curve.corners[0], curve.corners[-1]
    dy[[0, -1]] = ddy[[0, -1]] = 0.0
    return Quintic(motion.x, y, dy, ddy)


def _passing_times(curve: Curve, profile: Profile, window: float) -> Array:
    """When s passes the knots of the curve."""
    low = np.zeros(len(curve.shape.x))
    high = low + profile.duration + window
    for _ in range(50):
        middle = 0.5 * (low + high)
        before = profile.smoothed(middle, window)[0] < curve.shape.x
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return np.asarray(np.unique(np.concatenate([[0.0], high[1:-1], [profile.duration + window]])))


def _off(
    curve: Curve, profile: Profile, window: float, limits: RateLimits, motion: Quintic
) -> Array:
    """(K - 1,): above 1 for pieces that differ from the motion they stand for.

    Above FAR_OFF for those that are far from it, or may leave the joints' limits.
    """
    worst = np.zeros(len(motion.x) - 1)
    for true, (q, v, a) in _beside(curve, profile, window, motion):
        rates = np.maximum(
            over(v - true.dy, limits.velocity), over(a - true.ddy, limits.acceleration)
        )
        worst = np.maximum(worst, np.minimum(rates / RATE_ERROR, FAR_OFF))
        worst = np.maximum(worst, np.abs(q - true.y).max(axis=1) / POSITION_ERROR)
    low, high = motion.reach()
    outside = np.maximum(curve.lower - low, high - curve.upper).max(axis=1)
    return np.where(outside > OUTSIDE, np.inf, worst)


def _beside(
    curve: Curve, profile: Profile, window: float, motion: Quintic
) -> Iterator[tuple[Quintic, list[Array]]]:
    """Truth and quintics at a quarter, half and three quarters of each piece."""
    for part in (0.25, 0.5, 0.75):
        t = motion.x[:-1] + part * np.diff(motion.x)
        yield _motion(curve, profile, window, t), motion(t, 2)
