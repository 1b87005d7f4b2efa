"""A record of wheels beside a reference, kept to judge what was identified of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from thing_kin import _estimation, lie

if TYPE_CHECKING:
    from thing_kin._estimation import MecanumIdentification, MecanumOdometry

Array = NDArray[np.float64]
WINDOW, LONGEST_GAP = 1.0, 0.3  # s: as identify_mecanum has them


@dataclass(frozen=True)
class MecanumRun:
    """The record, and what identification was told."""

    t: Array
    wheel_angles: Array
    t_reference: Array
    poses: Array
    order: tuple[str, ...]
    nominal: Array  # wheel radius, k, mount, clock offset
    known: dict[str, Any]

    def motion_errors(self, found: MecanumIdentification) -> tuple[Array, Array, Array]:
        """Return times of motions between windows, their errors (N, 3) and covariances."""
        return self._errors_by(found.odometry, found)

    def errors_nominal(self, found: MecanumIdentification) -> Array:
        """By nominal wheels; where the body is on the robot, and the clocks, as found."""
        nominal = _estimation.MecanumOdometry(self.nominal[0], self.nominal[1], self.order)
        return self._errors_by(nominal, found)[1]

    def _errors_by(
        self, wheels: MecanumOdometry, found: MecanumIdentification
    ) -> tuple[Array, Array, Array]:
        """Return what the reference saw between windows, less what these wheels say."""
        t = self.t - found.clock_offset
        path = lie.se2_compose(wheels.integrate_angles(t, self.wheel_angles).poses, found.mount)
        middles, seen = self._windows(t, path)
        along = _at(middles, t, path)
        errors = lie.se2_log(lie.se2_between(_steps(along), _steps(seen)))
        rolled = np.abs(np.diff(self.wheel_angles, axis=0)).mean(axis=1) * wheels.wheel_radius
        travel = np.diff(np.interp(middles, t, np.concatenate([[0.0], np.cumsum(rolled)])))
        of_reference = np.diag(2.0 * found.reference_std**2 + 1e-12)  # at both ends
        seen_from = lie.se2_adjoint(lie.se2_inverse(found.mount))  # slip is in the robot's axes
        of_slip = (seen_from * found.slip_variance) @ seen_from.T
        covariances = of_reference + travel[:, None, None] * of_slip
        whole = self._whole(t, middles)
        return middles[:-1][whole], errors[whole], covariances[whole]

    def held_out_errors(self, folds: int) -> list[Array]:
        """Errors in each of so many stretches of time, by what the others tell."""
        first, last = (f(self.t[i], self.t_reference[i]) for f, i in ((max, 0), (min, -1)))
        edges = np.linspace(first, last, folds + 1)
        errors = []
        for begin, end in pairwise(edges.tolist()):
            train = self._cut(lambda t, b=begin, e=end: (t < b) | (t > e))
            test = self._cut(lambda t, b=begin, e=end: (t >= b) & (t <= e))
            if min(len(test.t), len(test.t_reference)) < 2:
                raise ValueError(f"folds: got {folds}, expected a record in each of them")
            found = _estimation.identify_mecanum(
                train.t,
                train.wheel_angles,
                train.t_reference,
                train.poses,
                self.order,
                **self.known,
            )
            errors.append(test.motion_errors(found)[1])
        if not all(len(e) for e in errors):
            raise ValueError(
                f"folds: got {folds}, expected motions between windows in each of them"
            )
        return errors

    def _cut(self, kept: Any) -> MecanumRun:
        wheels, reference = kept(self.t), kept(self.t_reference)
        return replace(
            self, t=self.t[wheels], wheel_angles=self.wheel_angles[wheels],
            t_reference=self.t_reference[reference], poses=self.poses[reference],
        )  # fmt: skip

    def _windows(self, t: Array, path: Array) -> tuple[Array, Array]:
        """Middles of windows, and the reference there: the median of all its poses in a window.

        Each is carried to the middle by the wheels, as identification does it.
        """
        covered = (self.t_reference >= t[0]) & (self.t_reference <= t[-1])
        stamps, poses = self.t_reference[covered], self.poses[covered]
        window = self.known.get("window", WINDOW)
        number = np.floor((stamps - stamps[:1]) / window).astype(int)
        middles = stamps[:1] + (number + 0.5) * window
        inside = middles <= t[-1]
        stamps, poses, number, middles = (x[inside] for x in (stamps, poses, number, middles))
        way = lie.se2_between(_at(stamps, t, path), _at(middles, t, path))
        carried = lie.se2_compose(poses, way)
        windows, starts = np.unique(number, return_index=True)
        seen = np.empty((len(windows), 3))
        for i, mine in enumerate(np.split(np.arange(len(number)), starts)[1:]):
            yaw = carried[mine[0], 2]
            near = carried[mine]
            near[:, 2] = yaw + np.angle(np.exp(1j * (near[:, 2] - yaw)))
            seen[i] = np.median(near, axis=0)
        return middles[starts], seen

    def _whole(self, t: Array, middles: Array) -> NDArray[np.bool_]:
        """Of motions: no long gap of the wheels in them."""
        longest = self.known.get("longest_gap", LONGEST_GAP)
        gaps = np.flatnonzero(
            (np.diff(t) > longest) & np.diff(self.wheel_angles, axis=0).any(axis=1)
        )
        whole = np.ones(max(len(middles) - 1, 0), dtype=bool)
        for gap in gaps:
            whole &= (middles[1:] <= t[gap]) | (middles[:-1] >= t[gap + 1])
        return whole


def _steps(poses: Array) -> Array:
    """From each pose to the next, (N - 1, 3)."""
    return np.asarray(lie.se2_between(poses[:-1], poses[1:]))


def _at(stamps: Array, t: Array, path: Array) -> Array:
    """On the arcs from each pose to the next; the first and last pose beyond them."""
    step = np.clip(np.searchsorted(t, stamps, side="right") - 1, 0, len(t) - 2)
    duration = np.diff(t)[step]
    lasts = duration > 0.0
    part = np.where(lasts, (stamps - t[step]) / np.where(lasts, duration, 1.0), 1.0).clip(0.0, 1.0)
    arcs = lie.se2_log(_steps(path))[step]
    return np.asarray(lie.se2_compose(path[step], lie.se2_exp(part[:, None] * arcs)))
