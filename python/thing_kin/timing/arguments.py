"""Checked arguments: arrays of finite numbers, limits that may be infinite."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SMALLEST_LIMIT = 1e-6  # rad/s, m/s, ...: slower than any robot, and squares are far from underflow
LARGEST_LIMIT = 1e9  # of rates: from here on unlimited
LARGEST = 1e9  # of positions, rad or m


def read_array(value: Any, name: str, shapes: str) -> Array:
    """Real numbers as a new float64 array; ValueError naming the argument."""
    try:
        array = np.asarray(value)
    except (ValueError, TypeError, OverflowError):  # rows of unequal length
        array = np.array(None)
    if array.dtype.kind not in "fiu":
        got = f"{type(value).__name__} of dtype {array.dtype}"
        raise ValueError(f"{name}: got {got}, expected real numbers, {shapes}")
    with np.errstate(over="ignore"):  # of a long double
        return array.astype(np.float64)


def read_path(value: Any, n: int) -> Array:
    """(N, n) waypoints, N >= 1."""
    q = read_array(value, "q", f"(N, {n})")
    if q.ndim != 2 or q.shape[1] != n or len(q) == 0:
        raise ValueError(f"q: got shape {q.shape}, expected (N, {n}) with N >= 1")
    return finite(q, "q")


def read_configuration(value: Any, name: str, n: int) -> Array:
    """(n,)."""
    q = read_array(value, name, f"({n},)")
    if q.shape != (n,):
        raise ValueError(f"{name}: got shape {q.shape}, expected ({n},)")
    return finite(q, name)


def finite(array: Array, name: str) -> Array:
    """Refuse NaN, infinity and what is beyond any workspace."""
    if not np.isfinite(array).all():
        raise ValueError(f"{name}: got NaN or inf, expected finite numbers")
    if np.abs(array).max(initial=0.0) > LARGEST:
        raise ValueError(f"{name}: got {np.abs(array).max():g}, expected at most {LARGEST:g}")
    return array


def within(q: Array, name: str, lower: Array, upper: Array) -> Array:
    """Refuse what is outside the joints' limits by more than a solver's tolerance."""
    excess = np.maximum(lower - q, q - upper).reshape(-1, q.shape[-1]).max(axis=0)
    worst = int(excess.argmax())
    if excess[worst] > 1e-6:
        raise ValueError(
            f"{name}: got a joint {worst} that is {excess[worst]:g} outside its limits, expected "
            f"it from {lower[worst]:g} to {upper[worst]:g}"
        )
    return q


def read_limits(value: Any, name: str, n: int, default: Array | None = None) -> Array:
    """(n,) of limits of a rate, one number for all or the default; inf is unlimited."""
    if value is None:
        return np.full(n, np.inf) if default is None else np.array(default, dtype=float)
    limits = read_array(value, name, f"({n},) or one for all")
    if limits.shape not in ((), (n,)):
        raise ValueError(f"{name}: got shape {limits.shape}, expected ({n},) or one for all")
    limits = np.array(np.broadcast_to(limits, n))
    wrong = ~((limits == 0.0) | (limits >= SMALLEST_LIMIT))
    if wrong.any():
        got = limits[wrong.argmax()]
        raise ValueError(f"{name}: got {got:g}, expected 0 or at least {SMALLEST_LIMIT:g}")
    limits[limits >= LARGEST_LIMIT] = np.inf
    return limits


def read_tolerance(value: Any, name: str = "tolerance") -> float:
    """Take a positive number."""
    number = read_array(value, name, "one number > 0")
    if number.shape != () or not 1e-5 <= float(number) <= 1e3:
        got = number if number.ndim == 0 else f"shape {number.shape}"
        raise ValueError(f"{name}: got {got}, expected one number from 1e-5 to 1e3")
    return float(number)
