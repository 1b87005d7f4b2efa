"""Whether a filter is as sure as it may be: NEES and NIS against their chi-square bands."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thing_kin._estimation import chi_square_quantile

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ConsistencyReport:
    """The mean over runs of NEES or NIS, step by step, against the band of a consistent filter.

    Prints as text. Above the band the filter is too sure of itself, below it too little.

    Parameters
    ----------
    dof : int
        Degrees of freedom of one sample: n for NEES, m for NIS.
    runs : int
    probability : float
        Of the band.
    per_step : (N,)
        Mean over the runs.
    lower, upper : float
        The band of such a mean.
    mean : float
        Over runs and steps.
    inside : float
        The fraction of steps in the band; a consistent filter has about `probability`.
    above : float
        The fraction of steps above it.
    independent : float
        So many independent steps tell as much as those of a run, which depend on each other; by
        how the runs scatter. Of a single run: all its steps.

    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> squares = np.random.default_rng(0).chisquare(4, size=(500, 100))
    >>> report = est.consistency_report(squares, dof=4)
    >>> report.consistent
    True
    """

    dof: int
    runs: int
    probability: float
    per_step: Array
    lower: float
    upper: float
    mean: float
    inside: float
    above: float
    independent: float

    @property
    def consistent(self) -> bool:
        """Whether the mean is in the band, and as many steps are as should be but for chance.

        Samples of one run depend on each other, so that the band of the mean over all is taken as
        wide as that of one step; the steps inside may be short of `probability` by 0.05, and by
        two standard deviations of such a share of `independent` steps.
        """
        p = self.probability
        chance = max(0.05, 2.0 * np.sqrt(p * (1.0 - p) / self.independent))
        return bool(self.lower <= self.mean <= self.upper and self.inside >= p - chance)

    def __str__(self) -> str:
        verdict = "consistent"
        if not self.consistent:
            verdict = "too sure of itself" if self.mean > self.dof else "not sure enough"
        return (
            f"{len(self.per_step)} steps, mean of {self.runs} runs {self.mean:.3f}, "
            f"expected {self.dof}\n"
            f"{100 * self.probability:g} % band {self.lower:.3f} to {self.upper:.3f}: "
            f"{100 * self.inside:.1f} % of the steps inside, {100 * self.above:.1f} % above\n"
            f"{verdict}"
        )


def consistency_report(
    squares: ArrayLike, dof: int, *, probability: float = 0.95
) -> ConsistencyReport:
    """Compare NEES or NIS of a filter with what a consistent one would have.

    Parameters
    ----------
    squares : (runs, N) or (N,)
        See nees and FilterRun.nis; NaN where nothing was measured.
    dof : int
        Degrees of freedom: n for NEES, m for NIS.
    probability : float
        Of the band, above 0 and below 1.

    Returns
    -------
    ConsistencyReport

    Raises
    ------
    ValueError
        If squares has another shape, a negative or infinite number or none at all.

    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> squares = np.random.default_rng(0).chisquare(2, size=(500, 40))
    >>> print(est.consistency_report(squares, dof=2))
    40 steps, mean of 500 runs 1.986, expected 2
    95 % band 1.829 to 2.179: 95.0 % of the steps inside, 0.0 % above
    consistent
    """
    samples = np.atleast_2d(np.asarray(squares, dtype=np.float64))
    counted = ~np.isnan(samples)
    if samples.ndim != 2 or not counted.any() or not (samples[counted] >= 0.0).all():
        raise ValueError(
            "squares: got another shape, a negative number or nothing, expected (runs, N) from 0"
        )
    if not np.isfinite(samples[counted]).all():
        raise ValueError("squares: got an infinite number, expected finite ones or NaN")
    if not 0.0 < probability < 1.0:
        raise ValueError(f"probability: got {probability}, expected a number between 0 and 1")
    steps = counted.any(axis=0)
    taken = counted.sum(axis=0)[steps]
    per_step = np.nansum(samples, axis=0)[steps] / taken
    tails = 0.5 * (1.0 - probability), 0.5 * (1.0 + probability)
    # Where measurements are missing, a step's mean has fewer samples and a wider band.
    low, high = (np.array([chi_square_quantile(p, dof * int(k)) / k for k in taken]) for p in tails)
    runs = int(taken.max())
    return ConsistencyReport(
        dof=dof,
        runs=runs,
        probability=float(probability),
        per_step=per_step,
        lower=float(low.min() if np.ptp(taken) else low[0]),
        upper=float(high.max() if np.ptp(taken) else high[0]),
        mean=float(samples[counted].mean()),
        inside=float(((low <= per_step) & (per_step <= high)).mean()),
        above=float((per_step > high).mean()),
        independent=_independent(samples[counted.any(axis=1)][:, steps]),
    )


def _independent(samples: Array) -> float:
    """How many steps the means of single runs scatter like those of, were they independent."""
    runs, steps = samples.shape
    if runs < 2:
        return float(steps)
    of_step = np.nanstd(samples, axis=0)
    scatter = np.where(of_step > 0.0, of_step, 1.0)
    means = np.nanmean((samples - np.nanmean(samples, axis=0)) / scatter, axis=1)
    return float(steps / np.clip(steps * np.nanvar(means), 1.0, steps))
