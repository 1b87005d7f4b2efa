"""A speed profile made smooth: its mean over a sliding window of time.

s(t) with a piecewise constant second derivative becomes one whose second derivative is continuous
and whose third is at most (change of the second) / window. It ends `window` later, begins and ends
at rest without acceleration, and visits the same s.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Profile:
    """Position s, speed and acceleration at the times t, (N,) each; acceleration of intervals."""

    t: Array
    s: Array
    speed: Array
    acceleration: Array  # (N - 1,)
    integral: Array  # of s from the beginning

    @classmethod
    def of(cls, s: Array, speed: Array) -> Profile:
        """Make it from speeds at the grid s, with constant acceleration between."""
        step = np.diff(s)
        dt = 2.0 * step / (speed[:-1] + speed[1:])
        u = np.diff(speed) / dt
        area = dt * (s[:-1] + dt * (speed[:-1] / 2.0 + dt * u / 6.0))
        t, integral = (np.concatenate([[0.0], np.cumsum(x)]) for x in (dt, area))
        return cls(t, s, speed, u, integral)

    @property
    def duration(self) -> float:
        """In s."""
        return float(self.t[-1])

    def _at(self, t: Array) -> tuple[Array, Array, Array, Array]:
        """Integral, position, speed, acceleration; at rest before and after."""
        k = np.clip(np.searchsorted(self.t, t, side="right") - 1, 0, len(self.t) - 2)
        inside = np.clip(t, 0.0, self.t[-1])
        d, u = inside - self.t[k], self.acceleration[k]
        moving = (t >= 0.0) & (t < self.t[-1])
        s = self.s[k] + d * (self.speed[k] + 0.5 * d * u)
        area = self.integral[k] + d * (self.s[k] + d * (0.5 * self.speed[k] + d * u / 6.0))
        area = area + np.maximum(t - self.t[-1], 0.0) * self.s[-1] + np.minimum(t, 0.0) * self.s[0]
        speed = np.where(moving, self.speed[k] + d * u, 0.0)
        return area, s, speed, np.where(moving, u, 0.0)

    def smoothed(self, t: Array, window: float) -> tuple[Array, Array, Array, Array]:
        """Position, speed, acceleration and jerk of s at times 0 ... duration + window."""
        new, old = self._at(t), self._at(t - window)
        s, speed, acceleration, jerk = ((a - b) / window for a, b in zip(new, old, strict=True))
        return np.clip(s, self.s[0], self.s[-1]), np.maximum(speed, 0.0), acceleration, jerk

    def breaks(self, window: float) -> Array:
        """List the times between which the smoothed acceleration is linear."""
        return np.unique(np.concatenate([self.t, self.t + window]))
