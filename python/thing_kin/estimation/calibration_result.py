"""What the calibration of an arm found: numbers with deviations, and what stays unknown."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thing_kin.estimation import calibration_hints, calibration_words
from thing_kin.estimation.calibrated_arm import CalibratedArm
from thing_kin.estimation.calibration_base import check_folds

__all__ = ["Calibration"]

Array = NDArray[np.float64]
EVERYWHERE = 100  # random postures that stand for all


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Calibration(CalibratedArm):
    """The arm as calibrated, and how sure that is.

    Returned by `calibrate`. "Nominal" is the chain as it came, with base and tool (or points) as
    they fit it best. What is not said here is as `CalibrationResult` has it.

    Parameters
    ----------
    status : str
        "converged", "not converged" or "underdetermined": too little data to judge the noise.
    chain : Chain
        With all that is geometry: joint offsets, links. Scales and sag are not in it: `readings`.
    base, tool : (4, 4)
        base @ chain.fk(q) @ tool is the tool in the world.
    points : (k, 3), m
        Measured points on the tool.
    nominal : (p,)
        Their values before: a row's own numbers, points as given, 1 for scales, 0 for differences.
    values : (p,)
        Of the parameters, as differences from nominal, m and rad. Base: x, y, z and a rotation
        vector in the root's nominal axes; tool: the same in the last frame's.
    covariance : (p, p)
        With what is not told held within plausible bounds (20 mm, 50 mrad, 5 % for an arm's own).
    combinations : tuple of str
        Motions of parameters (m, rad) that change nothing which was measured.
    rank : int
        How many combinations of parameters the data tell.
    noise_position, noise_rotation : float
        Standard deviations, m and rad, of one coordinate of a measurement; NaN where covariances
        were given.
    noise_is_estimated : bool
        From the residuals; else 1 mm and 1 mrad, or the covariances.
    variance_factor : float
        Squared residuals in deviations, for each degree of freedom: 1 where the noise is right.
    dof : float
        Degrees of freedom: numbers measured less what the parameters take of them.
    errors : (N, 6), (N, k, 3) or (N, 2)
        Measured less predicted: of a pose, position and rotation vector in world axes. NaN where
        nothing was measured.
    distances : (N,) or (N, k)
        Of the measurements, in deviations of their residuals.
    outliers : tuple of int or of (int, int)
        Postures, or postures and points, beyond the gate.
    iterations : int
        Of Ceres, in all.

    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import estimation as est
    >>> arm = tk.robots.ur5()
    >>> q = arm.random(30, rng=0)
    >>> est.calibrate(arm, q, arm.fk(q), parameters=("base", "tool")).success
    True
    """

    rank: int
    noise_position: float
    noise_rotation: float
    noise_is_estimated: bool
    variance_factor: float
    dof: float
    iterations: int

    @property
    def errors_nominal(self) -> Array:
        """As `errors`, of the nominal chain with base and tool (or points) that fit it best."""
        return self._errors_nominal

    @property
    def hints(self) -> tuple[str, ...]:
        """What looks like a mistake in the data, or too few parameters; () where all looks well.

        Other units, another order of joints, postures or points; or `links`, where they would
        explain much of what is left.
        """
        return self._hints

    @property
    def never_identifiable(self) -> tuple[str, ...]:
        """Parameters that postures all over the joints' range would not tell either."""
        return self._never_identifiable

    @property
    def degenerate(self) -> bool:
        """Whether these postures leave unknown what others would tell."""
        return not set(self.unidentifiable) <= set(self.never_identifiable)

    def propose_postures(
        self,
        count: int = 5,
        candidates: ArrayLike | int = 500,
        rng: int | np.random.Generator = 0,
    ) -> Array:
        """Find the postures that would tell most: D-optimal, one after the other.

        Parameters
        ----------
        count : int
        candidates : (M, n) or int
            Postures to choose from (free of collisions, in sight), or how many to draw within the
            joints' limits.
        rng : int or Generator
            Draws them.

        Returns
        -------
        (count, n)

        Examples
        --------
        >>> import thing_kin as tk
        >>> from thing_kin import estimation as est
        >>> arm = tk.robots.ur5()
        >>> q = arm.random(30, rng=0)
        >>> result = est.calibrate(arm, q, arm.fk(q))
        >>> result.propose_postures(2).shape
        (2, 6)
        """
        if count < 1:
            raise ValueError(f"count: got {count}, expected at least 1")
        if isinstance(candidates, int):
            if candidates < 1:
                raise ValueError(f"candidates: got {candidates}, expected at least 1")
            candidates = self._run.chain.random(candidates, rng=rng)
        return self._run.most_telling(candidates, count)

    def __repr__(self) -> str:
        return (
            f"Calibration({self._run.chain.name}, {self.status}, {len(self.names)} parameters, "
            f"rank {self.rank}, rms_position={self.rms_position:.3g})"
        )

    def cross_validated(self, folds: int, rng: np.random.Generator) -> Calibration:
        """Return the same with the rms of held-out postures; see `calibrate`.

        Parameters
        ----------
        folds : int
        rng : Generator
            Deals the postures out; equal ones (to 1e-6) stay together.

        Returns
        -------
        Calibration

        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> from thing_kin import estimation as est
        >>> arm = tk.robots.ur5()
        >>> q = arm.random(30, rng=0)
        >>> result = est.calibrate(arm, q, arm.fk(q))
        >>> result = result.cross_validated(3, np.random.default_rng(0))
        >>> len(result.fold_rms), result.cross_validated_rms_position < 1e-5
        (3, True)
        """
        check_folds(folds)
        return self._judged_by_folds(self._run.held_out_errors(folds, rng))

    @cached_property
    def _errors_nominal(self) -> Array:
        return self._run.errors_nominal(self.names)

    @cached_property
    def _hints(self) -> tuple[str, ...]:
        return calibration_hints.hints_of(self)

    @cached_property
    def _never_identifiable(self) -> tuple[str, ...]:
        told = self._run.told_at(self._run.chain.random(EVERYWHERE, rng=0))
        return tuple(n for n, is_told in zip(self.names, told, strict=True) if not is_told)

    def _title(self) -> str:
        measured = int(np.isfinite(self.distances).sum())
        return (
            f"Calibration of {self._run.chain.name}: {self.status}, {measured} measurements at "
            f"{len(self.errors)} postures"
        )

    def _details(self) -> list[str]:
        return calibration_words.details_of_arm(self)
