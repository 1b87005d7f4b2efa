"""What calibrations of arms and of wheels have in common: numbers, residuals, a report, a plot."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from thing_kin.estimation import calibration_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from typing_extensions import Self

__all__ = ["CalibratedNumber", "CalibrationResult"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class CalibratedNumber:
    """A row of a calibration's table.

    Parameters
    ----------
    name : str
    nominal, value : float
        In `unit`.
    std : float
        Of the value, in `unit`; inf: the data do not tell it.
    unit : str
        "m", "rad", "s", "1", "rad/(N m)" or "m/N".

    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> est.CalibratedNumber("k", 0.37, 0.4, 1e-3, "m").change
    0.030000000000000027
    """

    name: str
    nominal: float
    value: float
    std: float
    unit: str

    @property
    def change(self) -> float:
        """Value less nominal."""
        return self.value - self.nominal


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class CalibrationResult:
    """What is known after a calibration: of an arm or, as `MecanumCalibration`, of wheels.

    Parameters
    ----------
    status : str
        "converged" or why not.
    names : tuple of str
        Of all parameters.
    nominal : (p,)
        Their values before.
    values : (p,)
        Differences from nominal.
    std : (p,)
        Standard deviations by the data and by the priors that were given; inf: the data don't tell.
    covariance : (p, p)
        With what is not told held near its nominal value.
    unidentifiable : tuple of str
        Parameters that are part of a combination which the data don't tell.
    combinations : tuple of str
        These combinations: motions of parameters that change nothing which was measured.
    errors : (N, ...)
        Measured less predicted, position first; NaN where nothing was measured.
    distances : (N, ...)
        Of the measurements, in deviations of their residuals.
    outliers : tuple
        Measurements beyond the gate.
    cross_validated_rms_position, cross_validated_rms_rotation : float
        Of all measurements, each predicted by those of other folds; NaN: not done.
    fold_rms : tuple of float
        The first for each fold.

    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import estimation as est
    >>> arm = tk.robots.ur5()
    >>> q = arm.random(30, rng=0)
    >>> isinstance(est.calibrate(arm, q, arm.fk(q)), est.CalibrationResult)
    True
    """

    status: str
    names: tuple[str, ...]
    nominal: Array
    values: Array
    std: Array
    covariance: Array
    unidentifiable: tuple[str, ...]
    combinations: tuple[str, ...]
    errors: Array
    distances: Array
    outliers: tuple[Any, ...]
    cross_validated_rms_position: float = float("nan")
    cross_validated_rms_rotation: float = float("nan")
    fold_rms: tuple[float, ...] = ()

    _position_numbers: ClassVar[int] = 3  # of a measurement's errors
    _measurement: ClassVar[str] = "posture"

    @property
    def success(self) -> bool:
        """Whether the least squares have converged on data that exceed the parameters."""
        return self.status == "converged"

    @property
    def parameters(self) -> dict[str, float]:
        """Values by name."""
        return dict(zip(self.names, self.values.tolist(), strict=True))

    @property
    def errors_nominal(self) -> Array:
        """As `errors`, by nominal numbers."""
        raise NotImplementedError

    @property
    def rms_position(self) -> float:
        """Root mean square distance of measured from predicted places, m."""
        return rms(self.errors[..., : self._position_numbers])

    @property
    def rms_rotation(self) -> float:
        """Root mean square angle, rad; NaN where no rotation was measured."""
        return rms(self.errors[..., self._position_numbers :])

    @property
    def rms_position_nominal(self) -> float:
        """As `rms_position`, by nominal numbers, m."""
        return rms(self.errors_nominal[..., : self._position_numbers])

    @property
    def rms_rotation_nominal(self) -> float:
        """As `rms_rotation`, by nominal numbers, rad."""
        return rms(self.errors_nominal[..., self._position_numbers :])

    @property
    def hints(self) -> tuple[str, ...]:
        """What looks like a mistake in the data, or too few parameters; () where all looks well."""
        return ()

    @property
    def table(self) -> tuple[CalibratedNumber, ...]:
        """All parameters: name, nominal, value, standard deviation, unit."""
        return tuple(
            CalibratedNumber(name, nominal, nominal + change, std, self._unit(name))
            for name, nominal, change, std in zip(
                self.names,
                self.nominal.tolist(),
                self.values.tolist(),
                self.std.tolist(),
                strict=True,
            )
        )

    def _judged_by_folds(self, errors: list[Array]) -> Self:
        """Return the same with the rms of errors that other folds leave, an array for each fold."""
        m = self._position_numbers
        everything = np.concatenate(errors)
        return replace(
            self,
            cross_validated_rms_position=rms(everything[:, :m]),
            cross_validated_rms_rotation=rms(everything[:, m:]),
            fold_rms=tuple(rms(e[:, :m]) for e in errors),
        )

    def _unit(self, name: str) -> str:
        raise NotImplementedError

    def _title(self) -> str:
        raise NotImplementedError

    def _details(self) -> list[str]:
        """Lines of the report that are its own."""
        return []

    def report(self) -> str:
        """Return all of it in words.

        Returns
        -------
        str

        Examples
        --------
        >>> import thing_kin as tk
        >>> from thing_kin import estimation as est
        >>> arm = tk.robots.ur5()
        >>> q = arm.random(30, rng=0)
        >>> print(est.calibrate(arm, q, arm.fk(q)).report().splitlines()[0])
        Calibration of ur5: converged, 30 measurements at 30 postures
        """
        return calibration_words.report(self)

    def __str__(self) -> str:
        return self.report()

    def plot(self) -> Figure:
        """Draw the residuals before and after, and the parameters with their deviations.

        Returns
        -------
        matplotlib Figure

        Examples
        --------
        >>> import thing_kin as tk
        >>> from thing_kin import estimation as est
        >>> arm = tk.robots.ur5()
        >>> q = arm.random(30, rng=0)
        >>> len(est.calibrate(arm, q, arm.fk(q)).plot().axes)
        3
        """
        from thing_kin import viz

        return viz.plot_calibration(self)


def rms(errors: Array) -> float:
    """Root mean square length of rows; rows of NaN are left out, NaN for none."""
    squares = np.sum(errors * errors, axis=-1)
    seen = squares[np.isfinite(squares)]
    return float(np.sqrt(seen.mean())) if seen.size and errors.shape[-1] else float("nan")


def check_folds(folds: int, or_none: bool = False) -> None:
    """One alone would leave nothing to estimate from."""
    if folds < 2 and not (or_none and folds == 0):
        expected = "0 or at least 2" if or_none else "at least 2"
        raise ValueError(f"folds: got {folds}, expected {expected}")
