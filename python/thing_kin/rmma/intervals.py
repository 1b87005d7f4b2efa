"""Confidence intervals of rates and means."""

from __future__ import annotations

import math
from functools import lru_cache
from statistics import NormalDist

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Interval = tuple[float, float]


def wilson(hits: float, trials: int, level: float = 0.95) -> Interval:
    """Interval of a rate by Wilson (1927): within [0, 1], and of some width even at 0 and 1.

    It takes trials for independent.
    """
    z = NormalDist().inv_cdf(0.5 + 0.5 * checked_level(level))
    if trials == 0:
        return 0.0, 1.0
    rate, share = hits / trials, z * z / trials
    middle = (rate + 0.5 * share) / (1.0 + share)
    half = z * math.sqrt((rate * (1.0 - rate) + 0.25 * share) / trials) / (1.0 + share)
    return max(0.0, middle - half), min(1.0, middle + half)


def mean_of_runs(values: FloatArray, level: float = 0.95) -> Interval:
    """Interval of the mean of (velocities, runs), runs being independent within each velocity.

    The mean is that of the velocities' means, Student's t with the runs' degrees of freedom. NaN
    (a run without a value) is left out; with one run the interval is unbounded.
    """
    checked_level(level)
    means, variances, runs = _by_velocity(values)
    freedom = int((runs - 1).sum())
    if freedom == 0 or (runs < 2).any():
        return -math.inf, math.inf
    half = student(freedom, level) * math.sqrt(float((variances / runs).sum())) / len(runs)
    return float(means.mean()) - half, float(means.mean()) + half


def sd_of_mean(values: FloatArray, runs: int) -> float:
    """Return the standard deviation of a mean over velocities, of so many runs at each."""
    _, variances, _ = _by_velocity(values)
    return math.sqrt(float(variances.sum()) / runs) / max(len(variances), 1)


def _by_velocity(values: FloatArray) -> tuple[FloatArray, FloatArray, NDArray[np.int64]]:
    """Mean, variance and number of the values of each velocity, NaN left out."""
    counted = np.isfinite(values)
    runs = counted.sum(axis=1)
    values, counted, runs = values[runs > 0], counted[runs > 0], runs[runs > 0]
    means = np.where(counted, values, 0.0).sum(axis=1) / runs
    squares = (np.where(counted, values - means[:, None], 0.0) ** 2).sum(axis=1)
    return means, squares / np.maximum(runs - 1, 1), runs


@lru_cache(maxsize=64)
def student(freedom: int, level: float = 0.95) -> float:
    """Two-sided quantile of Student's t, by bisection on Abramowitz and Stegun 26.7.3, 26.7.4."""
    low, high = 0.0, math.pi / 2  # of atan(t / sqrt(freedom))
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _within(middle, freedom) < level else (low, middle)
    return math.tan(0.5 * (low + high)) * math.sqrt(freedom)


def _within(angle: float, freedom: int) -> float:
    """Share of Student's t within +-tan(angle) sqrt(freedom)."""
    sine, cosine = math.sin(angle), math.cos(angle)
    odd = freedom % 2
    term = total = (cosine if odd else 1.0) if freedom > 1 else 0.0
    for k in range(2 + odd, freedom - 1, 2):
        term *= cosine**2 * (k - 1) / k
        total += term
    return 2.0 / math.pi * (angle + sine * total) if odd else sine * total


def checked_level(level: float) -> float:
    """Return the level of confidence, which is between 0 and 1."""
    if not 0.0 < level < 1.0:
        raise ValueError(f"level: got {level}, expected a number between 0 and 1")
    return level
