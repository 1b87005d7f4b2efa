"""The whole of [X21] chapter 5 once more, with the thesis's figures beside this library's."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from thing_kin.rmma import discussion, tables
from thing_kin.rmma.practices import Practice, practice
from thing_kin.rmma.result import Result
from thing_kin.rmma.sweeps import Sweep, spawned_processes, sweep
from thing_kin.rmma.world_table import table_of_worlds
from thing_kin.rmma.worlds import named_worlds

Key = tuple[int, str, int | None]  # arrangement, method, configuration

LEAST_RUNS = 20  # so that their scatter is known

COVERING: Mapping[str, Mapping[str, Any]] = {
    "covering, no odometry": {"method": "covering", "odometry": "none"},
    "covering, odometry on failure": {"method": "covering", "odometry": "failure"},
    "covering": {"method": "covering"},
}
IN_WORLDS: Mapping[str, Mapping[str, Any]] = {
    "spiral": {},
    "ukf": {},
    "covering, odometry on failure": COVERING["covering, odometry on failure"],
    "covering": {},
}


@dataclass(frozen=True)
class Extent:
    """Numbers of runs at each velocity, and what is left out of a brief reproduction."""

    runs: int
    covering: int
    worlds: int
    practice: int
    named: tuple[str, ...]
    radii: tuple[float, ...]
    drifts: tuple[float, ...]


WHOLE = Extent(
    runs=1000,
    covering=200,
    worlds=40,
    practice=20,
    named=tuple(named_worlds()),
    radii=(0.003, 0.006, 0.009, 0.012, 0.018),
    drifts=(0.5, 1.0, 2.0, 3.0),
)
BRIEF = Extent(
    runs=60,
    covering=6,
    worlds=4,
    practice=1,
    named=("standard", "drift x2", "creep 0.4 mm/s", "map error 5 mm"),
    radii=(0.006, 0.012),
    drifts=(1.0, 2.0),
)


@dataclass(frozen=True, eq=False)
class Reproduction:
    """All results, and what can be said of them.

    Parameters
    ----------
    results : mapping from (arrangement, method, configuration) to Result
        In the standard world; methods of "covering" by their labels.
    grid : Sweep
        The same as a table.
    worlds : Sweep
        In other worlds.
    practice : Practice
    seed : int

    Examples
    --------
    >>> from thing_kin import rmma
    >>> done = rmma.reproduce(brief=True)  # doctest: +SKIP
    """

    results: Mapping[Key, Result]
    grid: Sweep
    worlds: Sweep
    practice: Practice
    seed: int

    @property
    def checks(self) -> dict[str, bool]:
        """What must hold, and whether it does, given what so many runs can tell.

        Examples
        --------
        >>> from thing_kin import rmma
        >>> rmma.reproduce(brief=True).checks  # doctest: +SKIP
        """
        return discussion.checks(self.results, self.worlds)

    def tables(self) -> list[str]:
        """Return all tables as text, each with its title above.

        Examples
        --------
        >>> from thing_kin import rmma
        >>> print(rmma.reproduce(brief=True).tables()[0])  # doctest: +SKIP
        """
        results = self.results
        return [
            tables.table_5_1(results),
            tables.table_5_2(results),
            *(tables.table_of_configurations(results, k) for k in (1, 2, 3)),
            *(tables.table_of_distances(results, k) for k in (1, 2, 3)),
            tables.table_of_methods(results),
            tables.table_of_velocities(results),
            tables.table_of_reference(results),
            table_of_worlds(self.worlds),
            "Which search when: rate [%] / time [s]\n\n" + self.practice.table(),
        ]

    def report(self) -> str:
        """Return everything as text in Markdown: what matches, what does not, all tables.

        Examples
        --------
        >>> from thing_kin import rmma
        >>> print(rmma.reproduce(brief=True).report())  # doctest: +SKIP
        """
        from thing_kin.rmma.report import report

        return report(self)

    def write(self, out: str | Path, *, plots: bool = True, animation: bool = True) -> list[str]:
        """Write report.md, tables as CSV and figures; returns the files' names.

        Parameters
        ----------
        out : str or Path
            Directory; made if it does not exist.
        plots, animation : bool
            Whether to draw (needs the extra `viz`), and whether the movie too.

        Examples
        --------
        >>> from thing_kin import rmma
        >>> rmma.reproduce(brief=True).write("rmma")  # doctest: +SKIP
        """
        from thing_kin.rmma.report import write

        return write(self, Path(out), plots=plots, animation=animation)


def reproduce(
    runs: int | None = None,
    *,
    rng: int = 0,
    brief: bool = False,
    executor: Executor | None = None,
    progress: bool = False,
) -> Reproduction:
    """Run all of [X21]'s experiments, the better method, other worlds, and which search when.

    Minutes, or with `brief` seconds, on as many processes as there are cores; in a script it
    belongs below ``if __name__ == "__main__":``.

    Parameters
    ----------
    runs : int, optional
        Of the thesis's methods at each velocity; default 1000, or 60 if brief. The covering search,
        which needs more time and varies less, has a fifth, or a tenth.
    rng : int
        Seed.
    brief : bool
        Fewer runs and fewer worlds.
    executor, progress
        As `sweep` takes them.

    Returns
    -------
    Reproduction

    Raises
    ------
    ValueError
        If there are fewer than 20 runs.

    Examples
    --------
    >>> from thing_kin import rmma
    >>> rmma.reproduce(brief=True).results[1, "ukf", 6].runs  # doctest: +SKIP
    60
    """
    extent = BRIEF if brief else WHOLE
    runs = extent.runs if runs is None else runs
    if runs < LEAST_RUNS:
        raise ValueError(f"runs: got {runs}, expected at least {LEAST_RUNS}")
    with contextlib.ExitStack() as stack:
        executor = executor or stack.enter_context(spawned_processes())
        common: dict[str, Any] = {"rng": rng, "executor": executor, "progress": progress}
        grid = _standard(extent, runs, common)
        worlds = {name: named_worlds()[name] for name in extent.named}
        elsewhere = _elsewhere(worlds, extent, runs, common)
        which = practice(extent.radii, extent.drifts, runs=extent.practice, **common)
    results = {(int(e.arrangement[1:]), e.method, e.config): e.result for e in grid}
    return Reproduction(results, grid, elsewhere, which, rng)


def _standard(extent: Extent, runs: int, common: Mapping[str, Any]) -> Sweep:
    """Everything in the standard world."""
    covering = max(1, runs * extent.covering // extent.runs)
    parts = [
        sweep((1, 2, 3), ["spiral"], runs=runs, **common),
        sweep((1, 2, 3), ["linear_kf"], configs=(6,), runs=runs, **common),
        sweep((1, 2, 3), ["ukf"], configs=range(1, 7), runs=runs, **common),
        sweep((1,), ["ukf"], configs=(7,), runs=runs, **common),
        sweep((1, 2, 3), COVERING, runs=covering, **common),
    ]
    entries = [entry for part in parts for entry in part]
    order = list(dict.fromkeys(entry.method for entry in entries))
    entries.sort(key=lambda e: (order.index(e.method), e.arrangement, e.config or 0))
    return Sweep(tuple(entries))


def _elsewhere(
    worlds: Mapping[str, Any], extent: Extent, runs: int, common: Mapping[str, Any]
) -> Sweep:
    """Methods in other worlds; and the linear filter where the base creeps, for its trend."""
    creeping = {name: worlds[name] for name in (discussion.CREEP,)}
    parts = [
        sweep((1, 2, 3), IN_WORLDS, worlds=worlds, runs=extent.worlds, **common),
        sweep((1,), ["linear_kf"], configs=(6,), worlds=creeping, runs=runs, **common),
    ]
    return Sweep(tuple(entry for part in parts for entry in part))
