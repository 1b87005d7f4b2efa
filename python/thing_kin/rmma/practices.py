"""Which search when: every method against the laser's radius and the base's drift."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from thing_kin.rmma.experiment import VELOCITIES
from thing_kin.rmma.layout import columns, number, percent
from thing_kin.rmma.records import write_csv
from thing_kin.rmma.sweeps import progress_bar, spawned_processes, sweep
from thing_kin.rmma.world import World
from thing_kin.rmma.worlds import DRIFT, scaled

FloatArray = NDArray[np.float64]

RADII = (0.003, 0.006, 0.009, 0.012, 0.018)  # m
DRIFTS = (0.5, 1.0, 2.0, 3.0)  # times the standard world's
WANTED = 0.99  # rate from which a search is good enough

#: Methods in the order of what they need, by label; a callable is given the radius.
METHODS: Mapping[str, Mapping[str, Any] | Callable[[float], Mapping[str, Any]]] = {
    "spiral": {"method": "spiral"},
    "spiral, gap = radius": lambda radius: {"method": "spiral", "spiral_gap": radius},
    "ukf": {"method": "ukf"},
    "covering, no odometry": {"method": "covering", "odometry": "none"},
    "covering, odometry on failure": {"method": "covering", "odometry": "failure"},
    "covering": {"method": "covering"},
}


@dataclass(frozen=True, eq=False)
class Practice:
    """Rates and times by method, radius and drift, mean over arrangements and velocities.

    Parameters
    ----------
    methods : tuple of str
        From what needs least to what needs most.
    radii : (R,), m
    drifts : (D,)
        Times the standard world's.
    rates : (M, R, D)
        0 to 1, with the registered fiducials.
    times : (M, R, D), s
    runs : int
        At each of the velocities, on each arrangement.

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> from thing_kin import rmma
    >>> with ThreadPoolExecutor() as pool:
    ...     practice = rmma.practice((0.012,), (1.0,), runs=2, arrangements=(2,), executor=pool)
    >>> practice.rates.shape
    (6, 1, 1)
    """

    methods: tuple[str, ...]
    radii: FloatArray
    drifts: FloatArray
    rates: FloatArray
    times: FloatArray
    runs: int

    def choice(self, radius: int, drift: int, wanted: float = WANTED) -> tuple[int, bool]:
        """Return which method to take, and whether its rate is what is wanted.

        It is the one that needs least of those that reach it, or else the one of highest rate.

        Parameters
        ----------
        radius, drift : int
            Indices.
        wanted : float
            Rate, 0 to 1.

        Examples
        --------
        >>> from concurrent.futures import ThreadPoolExecutor
        >>> from thing_kin import rmma
        >>> with ThreadPoolExecutor() as pool:
        ...     practice = rmma.practice((0.012,), (1.0,), runs=2, arrangements=(2,), executor=pool)
        >>> method, enough = practice.choice(0, 0)
        >>> enough
        True
        """
        rates = self.rates[:, radius, drift]
        (enough,) = np.nonzero(rates >= wanted)
        return (int(enough[0]), True) if len(enough) else (int(np.argmax(rates)), False)

    def table(self) -> str:
        """Lay out rate and time of each method as text, and what to take.

        Examples
        --------
        >>> from concurrent.futures import ThreadPoolExecutor
        >>> from thing_kin import rmma
        >>> with ThreadPoolExecutor() as pool:
        ...     practice = rmma.practice((0.012,), (1.0,), runs=2, arrangements=(2,), executor=pool)
        >>> "12 mm" in practice.table()
        True
        """
        rows = []
        for i, j in np.ndindex(len(self.radii), len(self.drifts)):
            cells = [
                f"{percent(self.rates[m, i, j])} / {number(self.times[m, i, j])}"
                for m in range(len(self.methods))
            ]
            chosen, enough = self.choice(i, j)
            best = self.methods[chosen] + ("" if enough else " (below 99 %)")
            rows.append([f"{1e3 * self.radii[i]:g} mm", f"x{self.drifts[j]:g}", *cells, best])
        return columns(["radius", "drift", *self.methods, "to take"], rows)

    def to_csv(self, path: str | Path) -> Path:
        """Write a row for each method, radius and drift, SI units.

        Examples
        --------
        >>> import tempfile
        >>> from concurrent.futures import ThreadPoolExecutor
        >>> from thing_kin import rmma
        >>> with ThreadPoolExecutor() as pool, tempfile.TemporaryDirectory() as folder:
        ...     practice = rmma.practice((0.012,), (1.0,), runs=2, arrangements=(2,), executor=pool)
        ...     len(practice.to_csv(folder + "/practice.csv").read_text().splitlines())
        7
        """
        m, i, j = (index.ravel() for index in np.indices(self.rates.shape))
        rows = {
            "method": [self.methods[k] for k in m],
            "detection_radius_m": self.radii[i].tolist(),
            "drift": self.drifts[j].tolist(),
            "interception_rate": self.rates.ravel().tolist(),
            "search_time_s": self.times.ravel().tolist(),
        }
        return write_csv(path, rows)


def practice(
    radii: Sequence[float] = RADII,
    drifts: Sequence[float] = DRIFTS,
    *,
    runs: int = 40,
    rng: int = 0,
    arrangements: Sequence[int] = (1, 2, 3),
    velocities: Sequence[float] = VELOCITIES,
    executor: Executor | None = None,
    progress: bool = False,
) -> Practice:
    """Run every method for every radius of the laser and every drift of the base.

    Parameters
    ----------
    radii : sequence of float, m
        How near the tool has to come for the laser to see a fiducial.
    drifts : sequence of float
        Times the standard world's slip, speed noise, heading error and curvature.
    runs : int
        At each velocity, on each arrangement.
    rng : int
    arrangements, velocities, executor, progress
        As `sweep` takes them.

    Returns
    -------
    Practice

    Raises
    ------
    ValueError
        If a radius or a drift is not positive and finite, or told twice.

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> from thing_kin import rmma
    >>> with ThreadPoolExecutor() as pool:
    ...     practice = rmma.practice((0.006, 0.012), (1.0,), runs=1, executor=pool)
    >>> practice.times.shape
    (6, 2, 1)
    """
    radii, drifts = _positive(radii, "radii"), _positive(drifts, "drifts")
    shape = (len(METHODS), len(radii), len(drifts))
    rates, times = np.zeros(shape), np.zeros(shape)
    with contextlib.ExitStack() as stack:
        executor = executor or stack.enter_context(spawned_processes())
        advance = stack.enter_context(progress_bar(len(radii), progress))
        for i, radius in enumerate(radii):
            world = replace(World(), detection_radius=radius)
            worlds = {f"{drift:g}": scaled(world, DRIFT, drift) for drift in drifts}
            methods = {
                label: options(radius) if callable(options) else options
                for label, options in METHODS.items()
            }
            grid = sweep(
                arrangements,
                methods,
                worlds=worlds,
                velocities=velocities,
                runs=runs,
                rng=rng,
                executor=executor,
                progress=False,
            )
            for (m, label), (j, name) in product(enumerate(methods), enumerate(worlds)):
                entries = grid.select(method=label, world=name)
                rates[m, i, j] = np.mean([entry.result.interception_rate for entry in entries])
                times[m, i, j] = np.mean([entry.result.search_time for entry in entries])
            advance()
    return Practice(tuple(METHODS), np.array(radii), np.array(drifts), rates, times, runs)


def _positive(values: Sequence[float], name: str) -> list[float]:
    numbers = np.array(values, dtype=float)
    good = (
        numbers.ndim == 1
        and len(numbers) > 0
        and bool((np.isfinite(numbers) & (numbers > 0)).all())
    )
    if not good or len(set(numbers.tolist())) < len(numbers):
        raise ValueError(f"{name}: got {values}, expected different positive numbers")
    return list(numbers.tolist())
