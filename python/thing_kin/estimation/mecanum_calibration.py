"""Wheels in the same frame of results as arms: what identification found, judged on motions."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thing_kin import _estimation
from thing_kin.estimation.calibration_base import CalibrationResult, check_folds
from thing_kin.estimation.mecanum_run import MecanumRun

if TYPE_CHECKING:
    from thing_kin._estimation import MecanumIdentification, MecanumOdometry

__all__ = ["MecanumCalibration", "calibrate_mecanum"]

Array = NDArray[np.float64]
NO_RADIUS, NO_K = 0.1, 0.4  # m: what identify_mecanum assumes
UNITS = {"mount_yaw": "rad", "clock_offset": "s"}


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class MecanumCalibration(CalibrationResult):
    """The wheels as calibrated, and how sure that is.

    Returned by `calibrate_mecanum`. A measurement is a motion from one window of time to the next:
    what the reference saw, less what the wheels say.

    Parameters
    ----------
    identification : MecanumIdentification
        All that `identify_mecanum` returns: slip, where the robot began, NEES.
    times : (N,)
        Of the motions' beginnings, s.
    errors : (N, 3)
        x, y (m) and theta (rad), in the axes of the reference's body.
    outliers : tuple of int
        Motions beyond the gate.

    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> wheels, t = est.MecanumOdometry(0.07, k=0.4), np.linspace(0.0, 20.0, 401)
    >>> angles = np.cumsum(wheels.wheel_speeds(np.tile([0.3, 0.2, 0.0], (401, 1))) * 0.05, axis=0)
    >>> poses = wheels.integrate_angles(t, angles).poses
    >>> found = est.calibrate_mecanum(t, angles, t, poses, wheel_radius=0.08, k=0.5)
    >>> found.unidentifiable  # the robot has never turned
    ('k', 'mount_x', 'mount_y')
    """

    identification: MecanumIdentification
    times: Array
    _run: MecanumRun

    _position_numbers: ClassVar[int] = 2
    _measurement: ClassVar[str] = "motion"

    @property
    def wheel_radius(self) -> float:
        """Wheel radius, m."""
        return self.identification.wheel_radius

    @property
    def k(self) -> float:
        """Half the wheel base plus half the track, m; nominal if not told."""
        return self.identification.k

    @property
    def odometry(self) -> MecanumOdometry:
        """`MecanumOdometry` with these numbers."""
        return self.identification.odometry

    @property
    def errors_nominal(self) -> Array:
        """As `errors`, by nominal numbers, the body's place on the robot as estimated."""
        return self._errors_nominal

    def cross_validated(self, folds: int) -> MecanumCalibration:
        """Return the same with the rms of held-out stretches of time; see `calibrate_mecanum`.

        Parameters
        ----------
        folds : int

        Returns
        -------
        MecanumCalibration

        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> wheels, t = est.MecanumOdometry(0.07, k=0.4), np.linspace(0.0, 30.0, 601)
        >>> twists = np.stack([0.3 * np.cos(t), 0.2 * np.sin(2 * t), 0.5 * np.sin(t)], axis=1)
        >>> angles = np.cumsum(wheels.wheel_speeds(twists) * 0.05, axis=0)
        >>> poses = wheels.integrate_angles(t, angles).poses
        >>> found = est.calibrate_mecanum(t, angles, t, poses, wheel_radius=0.08, k=0.5)
        >>> len(found.cross_validated(3).fold_rms)
        3
        """
        check_folds(folds)
        return self._judged_by_folds(self._run.held_out_errors(folds))

    @cached_property
    def _errors_nominal(self) -> Array:
        return self._run.errors_nominal(self.identification)

    def __repr__(self) -> str:
        return (
            f"MecanumCalibration({self.status}, wheel_radius={self.wheel_radius:.5g}, "
            f"k={self.k:.5g}, rms_position={self.rms_position:.3g})"
        )

    def _unit(self, name: str) -> str:
        return UNITS.get(name, "m")

    def _title(self) -> str:
        return f"Calibration of mecanum wheels: {self.status}, {len(self.times)} motions"

    def _details(self) -> list[str]:
        found = self.identification
        slip = np.sqrt(found.slip_variance) * 1e3
        lines = [
            f"slip in a meter: {slip[0]:.3g}, {slip[1]:.3g} mm, {slip[2]:.3g} mrad",
            f"dead reckoning over all of it: rms {1e3 * found.rms_aligned:.4g} mm "
            f"(nominal numbers {1e3 * found.rms_nominal:.4g})",
        ]
        if found.status == "too little motion":
            lines.append("TOO LITTLE MOTION: nothing is told")
        elif "k" in self.unidentifiable:
            lines.append("k, and where the reference is on the robot, are told by turning")
        return lines


def calibrate_mecanum(
    t: ArrayLike,
    wheel_angles: ArrayLike,
    t_reference: ArrayLike,
    poses: ArrayLike,
    order: tuple[str, ...] = ("fl", "rl", "rr", "fr"),
    *,
    wheel_radius: float | None = None,
    k: float | None = None,
    gate: float = 0.999,
    folds: int = 0,
    **options: Any,
) -> MecanumCalibration:
    """Calibrate mecanum wheels: `identify_mecanum`, with the result of `calibrate`.

    Parameters
    ----------
    t, wheel_angles, t_reference, poses, order
        See `identify_mecanum`.
    wheel_radius, k : float, m, optional
        Nominal values; default: some 0.1 m, some 0.4 m.
    gate : float
        A motion beyond this quantile of chi-square is listed as an outlier.
    folds : int
        Cross-validation: so many times all is estimated without a stretch of time and judged there;
        0: not done. Stretches, for neighbors in time share their errors.
    **options
        Of `identify_mecanum`: wheel_radius_std, k_std, mount, mount_std, clock_offset_std, window,
        longest_gap.

    Returns
    -------
    MecanumCalibration

    Raises
    ------
    ValueError
        As `identify_mecanum`; or if there are more folds than the record has motions for.

    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> wheels, t = est.MecanumOdometry(0.07, k=0.4), np.linspace(0.0, 20.0, 401)
    >>> twists = np.stack([0.3 * np.cos(t), 0.2 * np.sin(2 * t), 0.5 * np.sin(t)], axis=1)
    >>> angles = np.cumsum(wheels.wheel_speeds(twists) * 0.05, axis=0)
    >>> poses = wheels.integrate_angles(t, angles).poses
    >>> found = est.calibrate_mecanum(t, angles, t, poses, wheel_radius=0.08, k=0.5)
    >>> [(row.name, round(row.nominal, 3), round(row.value, 3)) for row in found.table[:2]]
    [('wheel_radius', 0.08, 0.07), ('k', 0.5, 0.4)]
    """
    check_folds(folds, or_none=True)
    if not 0.0 < gate < 1.0:
        raise ValueError(f"gate: got {gate}, expected a probability between 0 and 1")
    known = {"wheel_radius": wheel_radius, "k": k, **options}
    found = _estimation.identify_mecanum(t, wheel_angles, t_reference, poses, order, **known)
    nominal = np.array([
        NO_RADIUS if wheel_radius is None else wheel_radius, NO_K if k is None else k,
        *np.asarray(options.get("mount", (0.0, 0.0, 0.0)), dtype=float), 0.0,
    ])  # fmt: skip
    at, angles, at_reference, seen = (
        np.array(x, dtype=float) for x in (t, wheel_angles, t_reference, poses)
    )
    run = MecanumRun(at, angles, at_reference, seen, order, nominal, known)
    result = _result(found, run, gate)
    return result.cross_validated(folds) if folds else result


def _result(found: MecanumIdentification, run: MecanumRun, gate: float) -> MecanumCalibration:
    times, errors, covariances = run.motion_errors(found)
    white = np.linalg.solve(covariances, errors[..., None])[..., 0]
    squares = np.sum(errors * white, axis=1)
    bound = _estimation.chi_square_quantile(gate, 3)
    variances = np.diag(found.covariance)
    told = np.array([found.identifiable[name] for name in found.names])
    asked = np.flatnonzero(told | (variances > 0.0))  # what is neither was given as known
    values = np.array([found.wheel_radius, found.k, *found.mount, found.clock_offset]) - run.nominal
    values[2:5] = _estimation.pose_difference(found.mount, run.nominal[2:5])  # yaw within a turn
    names = tuple(found.names[i] for i in asked)
    untold = tuple(found.names[i] for i in asked if not told[i])
    return MecanumCalibration(
        status=found.status,
        names=names,
        nominal=run.nominal[asked],
        values=values[asked],
        std=np.where(told, np.sqrt(variances), np.inf)[asked],
        covariance=found.covariance[np.ix_(asked, asked)],
        unidentifiable=untold,
        combinations=untold,
        errors=errors,
        distances=np.sqrt(squares),
        outliers=tuple(np.flatnonzero(squares > bound).tolist()),
        identification=found,
        times=times,
        _run=run,
    )
