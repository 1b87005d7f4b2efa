"""The lines of the scaling plot: who computes what, with which instructions and threads."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

import thing_kin as tk
from peers import Peer

Run = Callable[[Any], Any]

WORKS = ("fk", "fk_quaternion", "fk_and_jacobian")
WITH_OUT = ("fk", "fk_quaternion")
LEVELS = ("avx512", "avx2", "baseline")
PEERS = ("numpy_vectorized", "pinocchio")
LARGE = 10_000  # about where a second thread and the caller's array begin to matter
LOOPS_UP_TO = 100_000  # a Python loop's time does not change any more


@dataclass(frozen=True)
class Line:
    """One line of a panel. `make(size)` gives what is timed, a function of (size, n) rows."""

    work: str
    who: str
    level: str  # in use while it runs
    threads: int | None  # None: all processors
    out: bool
    make: Callable[[int], Run] = field(compare=False, repr=False)

    def fits(self, size: int) -> bool:
        """Whether this size tells something new."""
        if self.who == "pinocchio":
            return size <= LOOPS_UP_TO
        return size >= LARGE or not (self.out or self.threads is None)

    def about(self) -> dict[str, str | int | bool | None]:
        return {key: getattr(self, key) for key in ("work", "who", "level", "threads", "out")}

    @property
    def label(self) -> str:
        if self.who != "thing_kin":
            return self.who
        threads = "all threads" if self.threads is None else "1 thread"
        return f"{self.level}, {threads}{', out=' if self.out else ''}"


def available_levels() -> list[str]:
    """Of this processor, the best first."""
    best = tk.simd_level()
    return list(LEVELS[LEVELS.index(best) :])


def ours(robot: Any, work: str, level: str, threads: int | None, out: bool) -> Line:
    method = getattr(robot, work)

    def make(size: int) -> Run:
        if not out:
            return partial(method, threads=threads)
        item = method(np.zeros(robot.n)).shape
        return partial(method, out=np.empty((size, *item)), threads=threads)

    return Line(work, "thing_kin", level, threads, out, make)


def any_size(run: Run, size: int) -> Run:
    return run


def lines_of(robot: Any, work: str, peers: list[Peer]) -> Iterator[Line]:
    """thing_kin in all ways, then the peers that can do the work."""
    levels = available_levels()
    for level in levels:
        for threads in (1, None):
            yield ours(robot, work, level, threads, out=False)
    if work in WITH_OUT:
        for threads in (1, None):
            yield ours(robot, work, levels[0], threads, out=True)
    for peer in peers:
        run = peer.works().get(f"{work}_batch")
        if peer.name in PEERS and run:
            yield Line(work, peer.name, levels[0], 1, False, partial(any_size, run))
