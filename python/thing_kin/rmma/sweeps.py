"""The experiment over a grid of parameters, on any executor."""

from __future__ import annotations

import contextlib
import hashlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from itertools import product
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any

from thing_kin.rmma.arrangement import ARRANGEMENTS, Arrangement
from thing_kin.rmma.experiment import VELOCITIES, run
from thing_kin.rmma.layout import columns, millimeters, number, percent
from thing_kin.rmma.result import Result

if TYPE_CHECKING:
    import pandas as pd

CONFIGURED = ("linear_kf", "ukf")  # methods that Tables 5.3 to 5.5 configure
Methods = Sequence[str] | Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True, eq=False)
class SweepEntry:
    """One point of the grid and what came out of it.

    Parameters
    ----------
    arrangement, method, world : str
        Their names.
    config : int or None
    seed : int
        What the entry's random numbers were drawn with.
    result : Result

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> from thing_kin import rmma
    >>> with ThreadPoolExecutor() as pool:
    ...     grid = rmma.sweep([2], ["spiral"], runs=2, executor=pool, progress=False)
    >>> grid[0].method, grid[0].world
    ('spiral', 'standard')
    """

    arrangement: str
    method: str
    config: int | None
    world: str
    seed: int
    result: Result


@dataclass(frozen=True, eq=False)
class Sweep:
    """Results of a grid, in the order of the grid whatever was finished first.

    Parameters
    ----------
    entries : tuple of SweepEntry

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> from thing_kin import rmma
    >>> with ThreadPoolExecutor() as pool:
    ...     grid = rmma.sweep([1, 2], ["spiral"], runs=2, executor=pool, progress=False)
    >>> [entry.arrangement for entry in grid]
    ['#1', '#2']
    """

    entries: tuple[SweepEntry, ...]

    def __len__(self) -> int:
        return len(self.entries)

    def __iter__(self) -> Iterator[SweepEntry]:
        return iter(self.entries)

    def __getitem__(self, index: int) -> SweepEntry:
        return self.entries[index]

    def __repr__(self) -> str:
        return f"<Sweep: {len(self)} entries>"

    def select(self, **names: Any) -> Sweep:
        """Return the entries with the given arrangement, method, config or world.

        Examples
        --------
        >>> from concurrent.futures import ThreadPoolExecutor
        >>> from thing_kin import rmma
        >>> with ThreadPoolExecutor() as pool:
        ...     grid = rmma.sweep([1, 2], ["spiral"], runs=2, executor=pool, progress=False)
        >>> len(grid.select(arrangement="#2"))
        1
        """
        known = {"arrangement", "method", "config", "world"}
        if not names.keys() <= known:
            unknown = sorted(names.keys() - known)[0]
            raise ValueError(f"{unknown}: expected one of {', '.join(sorted(known))}")
        found = [e for e in self if all(getattr(e, key) == names[key] for key in names)]
        return Sweep(tuple(found))

    def table(self) -> str:
        """Lay out a line for each entry as text.

        Examples
        --------
        >>> from concurrent.futures import ThreadPoolExecutor
        >>> from thing_kin import rmma
        >>> with ThreadPoolExecutor() as pool:
        ...     grid = rmma.sweep([2], ["spiral"], runs=2, executor=pool, progress=False)
        >>> "standard" in grid.table()
        True
        """
        header = ["arrangement", "method", "config", "world"]
        header += ["rate [%]", "95 % by run", "time [s]", "error [mm]", "first stop [%]"]
        return columns(header, [_cells(entry) for entry in self], left=4)

    def to_csv(self, path: str | Path) -> Path:
        """Write a row for each entry, SI units.

        Examples
        --------
        >>> import tempfile
        >>> from concurrent.futures import ThreadPoolExecutor
        >>> from thing_kin import rmma
        >>> with ThreadPoolExecutor() as pool, tempfile.TemporaryDirectory() as folder:
        ...     grid = rmma.sweep([2], ["spiral"], runs=2, executor=pool, progress=False)
        ...     len(grid.to_csv(folder + "/sweep.csv").read_text().splitlines())
        2
        """
        from thing_kin.rmma.records import write_csv

        return write_csv(path, self._columns())

    def to_pandas(self) -> pd.DataFrame:
        """Return what `to_csv` writes as a DataFrame; needs pandas.

        Examples
        --------
        >>> from thing_kin import rmma
        >>> frame = rmma.sweep([1, 2], ["spiral"]).to_pandas()  # doctest: +SKIP
        """
        from thing_kin.rmma.records import data_frame

        return data_frame(self._columns())

    def _columns(self) -> dict[str, list[Any]]:
        rows = [_row(entry) for entry in self]
        return {name: [row[name] for row in rows] for name in (rows[0] if rows else ())}


def sweep(
    arrangements: Sequence[int | Arrangement] = (1, 2, 3),
    methods: Methods = ("spiral", "linear_kf", "ukf", "covering"),
    *,
    configs: Sequence[int | None] = (None,),
    worlds: Mapping[str, Any] | None = None,
    velocities: Sequence[float] = VELOCITIES,
    runs: int = 10,
    rng: int = 0,
    executor: Executor | None = None,
    progress: bool = True,
) -> Sweep:
    """Run the experiment for every combination of arrangement, method, configuration and world.

    Entries are computed side by side and returned in the order of the grid: arrangements outermost,
    then methods, configurations, worlds. What comes out depends neither on the executor nor on the
    number of workers nor on what else is in the grid: each entry draws its random numbers with a
    seed made of `rng` and the names of its arrangement and its world (of their SHA-256). Methods
    and configurations so meet the same drives and can be compared run by run.

    Parameters
    ----------
    arrangements : sequence of 1, 2, 3 or Arrangement
        Arrangements of one's own are told apart by their names.
    methods : sequence of str, or mapping
        Names as `run` takes them; or a mapping from a label of one's own to keyword arguments of
        `run`, such as ``{"blind": {"method": "covering", "odometry": "none"}}``.
    configs : sequence of int or None
        Of Tables 5.3 to 5.5, for "linear_kf" and "ukf"; None is `run`'s own choice.
    worlds : mapping from names to World or a world of one's own, optional
        Default: the standard world. For processes it has to be picklable.
    velocities : sequence of float, m/s
    runs : int
        At each velocity.
    rng : int
        Seed of the whole.
    executor : concurrent.futures.Executor, optional
        Default: a process for each core, started afresh ("spawn"), so that a script calls this
        below ``if __name__ == "__main__":``. A thread pool does as well, and the executor of a Dask
        client (``client.get_executor()``) for a cluster. It is not shut down.
    progress : bool
        Whether to show a bar on stderr; needs tqdm (in the extra `viz`), without it there is none.

    Returns
    -------
    Sweep

    Raises
    ------
    ValueError
        If two entries have the same names, or as `run` does; what has not begun is cancelled.

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> from thing_kin import rmma
    >>> with ThreadPoolExecutor() as pool:
    ...     grid = rmma.sweep([2], ["spiral", "ukf"], runs=5, executor=pool, progress=False)
    >>> [entry.method for entry in grid]
    ['spiral', 'ukf']
    """
    worlds = {"standard": None} if worlds is None else worlds
    jobs = [
        _job(arrangement, label, options, config, world, rng)
        for arrangement, (label, options) in product(arrangements, _labeled(methods).items())
        for config in (configs if options["method"] in CONFIGURED else (None,))
        for world in worlds.items()
    ]
    _check_names(jobs)
    common = {"velocities": tuple(velocities), "runs": runs, "workers": 1}
    calls = [{**job.call, **common} for job in jobs]
    with contextlib.ExitStack() as stack:
        if executor is None:
            executor = stack.enter_context(spawned_processes())
        results = _compute(executor, calls, stack.enter_context(progress_bar(len(calls), progress)))
    return Sweep(
        tuple(SweepEntry(*job.names, job.seed, r) for job, r in zip(jobs, results, strict=True))
    )


def entry_seed(rng: int, arrangement: str, world: str) -> int:
    """Return the seed of an entry: 63 bits of the SHA-256 of `rng` and these names, a line each."""
    text = f"{int(rng)}\n{arrangement}\n{world}"
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:8], "little") >> 1


@dataclass(frozen=True)
class _Job:
    names: tuple[str, str, int | None, str]
    seed: int
    call: dict[str, Any]


def _job(
    arrangement: int | Arrangement,
    label: str,
    options: Mapping[str, Any],
    config: int | None,
    world: tuple[str, Any],
    rng: int,
) -> _Job:
    layout = arrangement if isinstance(arrangement, Arrangement) else _known(arrangement)
    name = str(layout.name)
    seed = entry_seed(rng, name, world[0])
    call: dict[str, Any] = {**options, "arrangement": arrangement, "rng": seed}
    if config is not None:
        call["config"] = config
    if world[1] is not None:
        call["world"] = world[1]
    return _Job((name, label, call.get("config"), world[0]), seed, call)


def _known(arrangement: int) -> Arrangement:
    if arrangement not in ARRANGEMENTS:
        raise ValueError(f"arrangements: got {arrangement!r}, expected 1, 2, 3 or an Arrangement")
    return ARRANGEMENTS[arrangement]


def _labeled(methods: Methods) -> dict[str, Mapping[str, Any]]:
    if isinstance(methods, str):
        raise ValueError(f"methods: got {methods!r}, expected a sequence of names or a mapping")
    if isinstance(methods, Mapping):
        return {label: {"method": label, **options} for label, options in methods.items()}
    return {name: {"method": name} for name in methods}


def _check_names(jobs: Sequence[_Job]) -> None:
    seen = set()
    for job in jobs:
        if job.names in seen:
            raise ValueError(f"arrangements: got {job.names} twice, expected names that differ")
        seen.add(job.names)


def _compute(
    executor: Executor, calls: Sequence[Mapping[str, Any]], advance: Callable[[], object]
) -> list[Result]:
    futures: list[Future[Result]] = [executor.submit(run_entry, dict(call)) for call in calls]
    try:
        for done in as_completed(futures):
            done.result()
            advance()
    except BaseException:
        for future in futures:
            future.cancel()
        raise
    return [future.result() for future in futures]


def spawned_processes() -> ProcessPoolExecutor:
    """Return a process for each core, started afresh: a fork would copy locks that threads hold."""
    return ProcessPoolExecutor(mp_context=get_context("spawn"))


def run_entry(call: Mapping[str, Any]) -> Result:
    """Run one entry, in whatever process this is."""
    return run(**call)


@contextlib.contextmanager
def progress_bar(total: int, wanted: bool) -> Iterator[Callable[[], object]]:
    """Show a bar on stderr if tqdm is there; yields what moves it on by one."""
    try:
        from tqdm import tqdm
    except ImportError:
        wanted = False
    if not wanted:
        yield lambda: None
        return
    with tqdm(total=total, desc="searching", unit="entry", leave=False) as bar:
        yield bar.update


def _row(entry: SweepEntry) -> dict[str, Any]:
    result = entry.result
    low, high = result.interception_interval(unit="run")
    return {
        "arrangement": entry.arrangement,
        "method": entry.method,
        "config": entry.config,
        "world": entry.world,
        "runs": result.runs,
        "seed": entry.seed,
        "interception_rate": result.interception_rate,
        "interception_rate_low": low,
        "interception_rate_high": high,
        "interception_rate_searched": result.interception_rate_searched,
        "search_time_s": result.search_time,
        "position_error_m": result.position_error,
        "first_stop_rate": result.first_stop_rate,
    }


def _cells(entry: SweepEntry) -> list[str]:
    row = _row(entry)
    low, high = row["interception_rate_low"], row["interception_rate_high"]
    names = [str(row[name]) for name in ("arrangement", "method", "config", "world")]
    names[2] = "" if entry.config is None else names[2]
    return [
        *names,
        percent(row["interception_rate"]),
        f"{percent(low)} .. {percent(high)}",
        number(row["search_time_s"]),
        millimeters(row["position_error_m"]),
        percent(row["first_stop_rate"]),
    ]
