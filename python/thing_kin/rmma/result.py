"""What came out of runs of the experiment."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from thing_kin.rmma.intervals import Interval, mean_of_runs, sd_of_mean, wilson

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

    from thing_kin.rmma.arrangement import Arrangement

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.int64]

PER_SEARCH = ("intercepted", "searched", "search_times", "position_errors", "samples")


@dataclass(frozen=True)
class Spread:
    """Standard deviations of what a short protocol, such as the thesis's ten runs, comes to.

    Parameters
    ----------
    runs : int
        Of the protocol, at each velocity.
    interception_rate : float
        Of the rate with the registered fiducials, 0 to 1.
    search_time : float
        s
    position_error : float
        m

    Examples
    --------
    >>> from thing_kin import rmma
    >>> spread = rmma.run(arrangement=2, method="spiral", runs=40, rng=0).spread(10)
    >>> 0.0 < spread.interception_rate < 0.05
    True
    """

    runs: int
    interception_rate: float
    search_time: float
    position_error: float


@dataclass(frozen=True, eq=False, repr=False)
class Result:
    """Every search of an experiment, [X21] chapter 5, and the measures of its section 5.1.

    Rates and times of `interception_rate…` and `search_time…` include the first fiducial of each
    side, which is registered with the base at rest: an interception in no time, as in [X21]'s
    tables. A fiducial that was skipped is missed, in no time.

    Parameters
    ----------
    arrangement : Arrangement
    method : str
        "spiral", "linear_kf", "ukf" or "covering".
    velocities : (V,), m/s
    registered : (N,) of bool
        Which fiducials are the first of a side.
    intercepted : (V, R, N) of bool
        By velocity, run and fiducial; True for the registered.
    searched : (V, R, N) of bool
        Neither registered nor skipped.
    search_times : (V, R, N), s
        0 for the registered and the skipped.
    position_errors : (V, R, N), m
        Observed minus predicted position of the base, failures included; NaN where not searched.
    samples : (V, R, N) of int
        Stops of the laser: 1 is a hit at the first; 0 where not searched.
    options : mapping
        What else the experiment was given: configuration, odometry, world and so on.

    Examples
    --------
    >>> from thing_kin import rmma
    >>> result = rmma.run(arrangement=1, method="ukf", velocities=(0.01, 0.03), runs=10, rng=0)
    >>> result.intercepted.shape
    (2, 10, 9)
    >>> result.interception_rate > result.interception_rate_searched
    True
    """

    arrangement: Arrangement
    method: str
    velocities: FloatArray
    registered: BoolArray
    intercepted: BoolArray
    searched: BoolArray
    search_times: FloatArray
    position_errors: FloatArray
    samples: IntArray
    options: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Shapes that fit; options that can go to another process."""
        object.__setattr__(self, "options", dict(self.options))
        expected = (len(self.velocities), *self.intercepted.shape[1:2], len(self.registered))
        for name in PER_SEARCH:
            shape = getattr(self, name).shape
            if shape != expected or 0 in shape:
                raise ValueError(
                    f"{name}: got shape {shape}, expected (velocities, runs, fiducials) with "
                    f"{expected[0]} velocities and {expected[-1]} fiducials"
                )

    def __repr__(self) -> str:
        return f"<Result: {self.title}, {100 * self.interception_rate:.1f} % in {self.runs} runs>"

    @property
    def title(self) -> str:
        """Arrangement, method and configuration in words."""
        name = str(self.arrangement.name)
        words = [name if "arrangement" in name else f"arrangement {name}", self.method]
        if "config" in self.options:
            words.append(f"configuration {self.config or 'of its own'}")
        if self.method == "covering" and self.options.get("odometry") is not None:
            words.append(f"odometry {self.options['odometry']}")
        return ", ".join(words)

    @property
    def config(self) -> int | None:
        """Number of the filter's configuration in [X21] Tables 5.3 to 5.5, if it is one of them."""
        from thing_kin.rmma.experiment import CONFIGS

        told = self.options.get("config")
        return next((number for number, config in CONFIGS.items() if config == told), None)

    @property
    def runs(self) -> int:
        """At each velocity."""
        return int(self.intercepted.shape[1])

    @property
    def interception_rate(self) -> float:
        """0 to 1, with the registered fiducials, [X21] 5.1."""
        return float(self.intercepted.mean())

    @property
    def interception_rate_searched(self) -> float:
        """0 to 1, without the registered fiducials; skipped ones are missed."""
        return float(self.intercepted[:, :, ~self.registered].mean()) if self._any_left else np.nan

    @property
    def search_time(self) -> float:
        """Mean in s, the registered and the skipped with 0 s, [X21] 5.1."""
        return float(self.search_times.mean())

    @property
    def position_error(self) -> float:
        """Mean over what was searched in m, failures included; NaN if nothing was."""
        return float(_mean_searched(self.position_errors, self.searched, (0, 1, 2)))

    @property
    def first_stop_rate(self) -> float:
        """Share of the fiducials, without the registered, hit at the laser's first stop."""
        first = self.intercepted & self.searched & (self.samples == 1)
        return float(first[:, :, ~self.registered].mean()) if self._any_left else np.nan

    @property
    def interception_rate_by_velocity(self) -> FloatArray:
        """(V,), with the registered fiducials."""
        return np.asarray(self.intercepted.mean(axis=(1, 2)))

    @property
    def search_time_by_velocity(self) -> FloatArray:
        """(V,), s."""
        return np.asarray(self.search_times.mean(axis=(1, 2)))

    @property
    def position_error_by_velocity(self) -> FloatArray:
        """(V,), m; NaN where nothing was searched."""
        return _mean_searched(self.position_errors, self.searched, (1, 2))

    @property
    def interception_rate_by_fiducial(self) -> FloatArray:
        """(N,), 1 for the registered, [X21] Tables 5.6 to 5.8."""
        return np.asarray(self.intercepted.mean(axis=(0, 1)))

    @property
    def search_time_by_fiducial(self) -> FloatArray:
        """(N,), s."""
        return np.asarray(self.search_times.mean(axis=(0, 1)))

    @property
    def position_error_by_fiducial(self) -> FloatArray:
        """(N,), m; NaN for the registered."""
        return _mean_searched(self.position_errors, self.searched, (0, 1))

    def interception_interval(self, level: float = 0.95, *, unit: str = "fiducial") -> Interval:
        """Confidence interval of `interception_rate`.

        Parameters
        ----------
        level : float
        unit : {"fiducial", "run"}
            What is taken for independent: each search (Wilson's interval, which has some width at
            100 % too), or only each run, whose searches go wrong together (Student's t).

        Returns
        -------
        tuple of two floats

        Examples
        --------
        >>> from thing_kin import rmma
        >>> result = rmma.run(arrangement=2, method="spiral", runs=20, rng=0)
        >>> low, high = result.interception_interval(unit="run")
        >>> low < result.interception_rate < high
        True
        """
        if unit == "run":
            low, high = mean_of_runs(self.intercepted.mean(axis=2), level)
            return max(0.0, low), min(1.0, high)
        if unit != "fiducial":
            raise ValueError(f"unit: got {unit!r}, expected 'fiducial' or 'run'")
        trials = self.intercepted[:, :, ~self.registered]
        bounds = wilson(int(trials.sum()), trials.size, level)
        given = float(self.registered.mean())  # these are never missed
        return given + (1 - given) * bounds[0], given + (1 - given) * bounds[1]

    def search_time_interval(self, level: float = 0.95) -> Interval:
        """Confidence interval of `search_time` in s, runs independent, their searches not.

        Examples
        --------
        >>> from thing_kin import rmma
        >>> result = rmma.run(arrangement=2, method="spiral", runs=20, rng=0)
        >>> low, high = result.search_time_interval()
        >>> low < result.search_time < high
        True
        """
        return mean_of_runs(self.search_times.mean(axis=2), level)

    def position_error_interval(self, level: float = 0.95) -> Interval:
        """Confidence interval of the mean over runs of their position errors, in m.

        Each run counts the same, so its middle differs from `position_error` by a little where
        runs skip fiducials.

        Examples
        --------
        >>> from thing_kin import rmma
        >>> result = rmma.run(arrangement=2, method="spiral", runs=20, rng=0)
        >>> low, high = result.position_error_interval()
        >>> 0 < low < high
        True
        """
        return mean_of_runs(_mean_searched(self.position_errors, self.searched, (2,)), level)

    def spread(self, runs: int = 10) -> Spread:
        """How much a protocol of so few runs scatters when it is repeated.

        Worked out from the scatter of these runs at each velocity, runs being independent: sharper
        than to cut them into blocks of so many, and the same with many blocks.

        Parameters
        ----------
        runs : int
            Of the protocol at each velocity; [X21] has ten, of five velocities.

        Raises
        ------
        ValueError
            If `runs` is below 1, or there is only one run here.

        Examples
        --------
        >>> from thing_kin import rmma
        >>> result = rmma.run(arrangement=2, method="ukf", runs=60, rng=0)
        >>> result.spread(10).interception_rate > result.spread(40).interception_rate
        True
        """
        if runs < 1 or self.runs < 2:
            raise ValueError(f"runs: got {runs} of {self.runs}, expected at least 1 of at least 2")
        error = _mean_searched(self.position_errors, self.searched, (2,))
        by_run = (self.intercepted.mean(axis=2), self.search_times.mean(axis=2), error)
        return Spread(runs, *(sd_of_mean(values, runs) for values in by_run))

    def at_velocity(self, velocity: float) -> Result:
        """Return the part that was driven with one velocity, in m/s.

        Examples
        --------
        >>> from thing_kin import rmma
        >>> result = rmma.run(arrangement=2, method="spiral", runs=5, rng=0)
        >>> result.at_velocity(0.02).intercepted.shape
        (1, 5, 6)
        """
        (found,) = np.nonzero(np.isclose(self.velocities, velocity, rtol=1e-9))
        if not len(found):
            raise ValueError(f"velocity: got {velocity}, expected one of {self.velocities}")
        return self._part(slice(None), slice(int(found[0]), int(found[0]) + 1))

    def table(self) -> str:
        """Lay out the measures by velocity and by fiducial as text.

        Examples
        --------
        >>> from thing_kin import rmma
        >>> result = rmma.run(arrangement=2, method="spiral", runs=10, rng=0)
        >>> "by velocity" in result.table()
        True
        """
        from thing_kin.rmma.result_text import table

        return table(self)

    def to_csv(self, path: str | Path) -> Path:
        """Write a row for each velocity, run and fiducial, SI units, numbers counted from 1.

        Examples
        --------
        >>> import tempfile
        >>> from pathlib import Path
        >>> from thing_kin import rmma
        >>> result = rmma.run(arrangement=2, method="spiral", velocities=(0.02,), runs=1, rng=0)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     rows = result.to_csv(Path(folder) / "runs.csv").read_text().splitlines()
        >>> len(rows)  # a header, six fiducials
        7
        """
        from thing_kin.rmma.records import search_columns, write_csv

        return write_csv(path, search_columns(self))

    def to_pandas(self) -> pd.DataFrame:
        """Return what `to_csv` writes as a DataFrame; needs pandas.

        Examples
        --------
        >>> from thing_kin import rmma
        >>> result = rmma.run(arrangement=2, method="spiral", velocities=(0.02,), runs=1, rng=0)
        >>> frame = result.to_pandas()  # doctest: +SKIP
        """
        from thing_kin.rmma.records import data_frame, search_columns

        return data_frame(search_columns(self))

    def plot(self) -> Figure:
        """Draw rate, search time and position error by velocity and by fiducial.

        Needs the extra `viz`. Bars of 95 %, by run.

        Examples
        --------
        >>> from thing_kin import rmma
        >>> figure = rmma.run(arrangement=2, method="spiral", runs=5, rng=0).plot()
        >>> len(figure.axes)
        6
        """
        from thing_kin.viz.rmma import plot_rmma_result

        return plot_rmma_result(self)

    @property
    def _any_left(self) -> bool:
        return not bool(self.registered.all())

    def _part(self, runs: slice, velocities: slice = slice(None)) -> Result:
        cut: dict[str, Any] = {name: getattr(self, name)[velocities, runs] for name in PER_SEARCH}
        return replace(self, velocities=self.velocities[velocities], **cut)


def _mean_searched(values: FloatArray, searched: BoolArray, axis: tuple[int, ...]) -> FloatArray:
    """Mean where searched; NaN where nothing was."""
    count = searched.sum(axis=axis)
    total = np.where(searched, values, 0.0).sum(axis=axis)
    mean: FloatArray = np.where(count > 0, total / np.maximum(count, 1), np.nan)
    return mean
