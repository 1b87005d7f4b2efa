"""Poses, rotations and vectors of whatever kind, as checked arrays of their own."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from thing_kin import lie

Array = NDArray[np.float64]


def read_pose(value: Any, name: str = "T") -> Array:
    """(4, 4) or (N, 4, 4), a copy; ValueError naming the argument if it is no rigid transform."""
    return _checked_by(lie.se3_adjoint, value, name)


def read_rotation(value: Any, name: str = "R") -> Array:
    """(3, 3) or (N, 3, 3), a copy; ValueError naming the argument if it is no rotation."""
    return _checked_by(lie.quaternion_from_rotation, value, name)


def read_either(value: Any, name: str = "T") -> Array:
    """(4, 4) or (3, 3), or a batch: a pose or a rotation, told apart by shape."""
    try:
        shape = np.shape(lie.as_matrix(value))
    except (ValueError, TypeError, AttributeError):  # rows of unequal length; no norm
        shape = ()
    if shape[-2:] == (3, 3):
        return read_rotation(value, name)
    if shape[-2:] == (4, 4):
        return read_pose(value, name)
    got = f"shape {shape}" if shape else type(value).__name__
    expected = "a pose (4, 4) or (N, 4, 4), or a rotation (3, 3) or (N, 3, 3)"
    raise ValueError(f"{name}: got {got}, expected {expected}")


def read_vectors(value: Any, name: str, n: int) -> Array:
    """(n,) or (N, n), a copy; ValueError naming the argument."""
    try:
        array = np.asarray(value)
    except (ValueError, TypeError):  # rows of unequal length
        array = np.array(None)
    if array.dtype.kind not in "fiu":
        got = f"{type(value).__name__} of dtype {array.dtype}"
        raise ValueError(f"{name}: got {got}, expected real numbers")
    if array.ndim not in (1, 2) or array.shape[-1] != n:
        raise ValueError(f"{name}: got shape {array.shape}, expected ({n},) or (N, {n})")
    with np.errstate(over="ignore"):  # of a long double
        vectors = array.astype(np.float64)
    if not np.isfinite(vectors).all():
        raise ValueError(f"{name}: got NaN or inf, expected finite numbers")
    return vectors


def _checked_by(check: Callable[[Any], object], value: Any, name: str) -> Array:
    """One truth of what is accepted: that of the core, which names the argument its own way."""
    try:
        check(value)
    except ValueError as error:
        raise ValueError(name + ":" + str(error).partition(":")[2]) from None
    return np.array(lie.as_matrix(value), dtype=np.float64)
