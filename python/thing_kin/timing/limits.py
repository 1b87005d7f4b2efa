"""What a motion may not exceed, and by how much a given one does: proved, not only sampled."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from thing_kin.timing.quintic import Quintic

if TYPE_CHECKING:
    from thing_kin import WheelLimits

Array = NDArray[np.float64]

STEPS = 8  # samples per piece: the remainder of a bound falls with the square


@dataclass(frozen=True)
class RateLimits:
    """Limits of each joint, (n,), inf where there is none; of the wheels of the base, if any."""

    velocity: Array
    acceleration: Array
    jerk: Array
    wheels: WheelLimits | None = None
    base_joints: tuple[int, ...] = ()

    def wheel_rows(self, theta: Array) -> Array:
        """(M, 4, 3): wheel speeds over the largest, from (x, y, theta)'; inverse of (3.20)."""
        if self.wheels is None:
            raise AssertionError("asked without wheels")
        c, s = np.cos(theta), np.sin(theta)
        k = np.full_like(theta, self.wheels.k)
        along, across = np.stack([c, s], axis=-1), np.stack([-s, c], axis=-1)
        signs = ((-1, -1), (1, -1), (-1, 1), (1, 1))  # of v_y and k omega: fl, rl, rr, fr
        rows = [np.concatenate([along + a * across, (b * k)[..., None]], axis=-1) for a, b in signs]
        return np.stack(rows, axis=-2) / (self.wheels.radius * self.wheels.speed)

    def ratios(self, motion: Quintic) -> tuple[Array, Array, Array]:
        """How far velocity (with wheels), acceleration and jerk come: at most 1 is within.

        One number for each piece, (K - 1,).
        """
        velocity, acceleration, jerk = (motion.tops(d) for d in (1, 2, 3))
        wheels = self._wheel_ratio(motion, velocity, acceleration, jerk)
        return (
            np.maximum(over(velocity, self.velocity), wheels),
            over(acceleration, self.acceleration),
            over(jerk, self.jerk),
        )

    def _wheel_ratio(self, motion: Quintic, *tops: Array) -> Array:
        """Upper bounds, (K - 1,).

        Between samples a function exceeds the larger of its neighbors by no more than (step^2 / 8)
        times the largest second derivative there.
        """
        if self.wheels is None:
            return np.zeros(len(motion.x) - 1)
        base = list(self.base_joints)
        q, v = motion.grid(STEPS, 1)
        room = (np.diff(motion.x) / STEPS) ** 2 / 8.0
        rows = self.wheel_rows(q[..., base[2]])
        speed = np.abs(np.einsum("pmij,pmj->pmi", rows, v[..., base])).max(axis=(1, 2))
        velocity, acceleration, jerk = (np.hypot(x[:, base[0]], x[:, base[1]]) for x in tops)
        turn, spin, spin_rate = (x[:, base[2]] for x in tops)
        # Second derivative of R(theta)' v, and of k omega; a row of [1, 1] has length sqrt 2.
        curve = jerk + 2.0 * turn * acceleration + (turn**2 + spin) * velocity
        bound = np.sqrt(2.0) * curve + self.wheels.k * spin_rate
        return np.asarray(speed + room * bound / (self.wheels.radius * self.wheels.speed))


def over(rate: Array, limit: Array) -> Array:
    """(M,): the largest share of its limit that a joint takes; rate (M, n), limit (n,)."""
    limited = np.isfinite(limit) & (limit > 0)
    return np.asarray((np.abs(rate[:, limited]) / limit[limited]).max(axis=1, initial=0.0))
