"""The process of one solver: asked over a pipe, it solves targets and times each.

    python -m inverse.worker SOLVER PIPE

Requests are tuples (method, arguments...), answers what the method returns.
"""

import gc
import os
import platform
import sys
import time
from collections.abc import Iterable
from importlib.metadata import PackageNotFoundError, version
from multiprocessing.connection import Connection
from typing import Any

import numpy as np

from inverse import Arm, Solver, gather

Answer = tuple[list[float] | None, bool, float, float]  # q, claim; CPU (all threads), wall, s

MOST_AT_ONCE = 256
BATCH_SECONDS = 0.05


def empty_call() -> int:
    """CPU time that reading the clocks takes, ns."""

    def once() -> int:
        cpu = time.process_time_ns()
        time.perf_counter_ns()
        time.perf_counter_ns()
        return time.process_time_ns() - cpu

    return min(once() for _ in range(1000))


class Worker:
    def __init__(self, name: str) -> None:
        self.solver_class = {**gather("solvers"), **gather("steps")}[name]
        self.clock = empty_call()

    def about(self) -> dict[str, str] | None:
        """Versions, or None where the solver is not installed."""
        if not self.solver_class.available():
            return None
        found = {"python": platform.python_version()}
        for package in self.solver_class.packages:
            try:
                found[package] = version(package)
            except PackageNotFoundError:
                module = sys.modules.get(package)  # a build that is not installed
                found[package] = str(getattr(module, "__version__", "?"))
        return found

    def enter(self, arm: dict[str, Any], targets: str) -> None:
        """Take an arm and the file of its targets; the last few of them warm up."""
        self.solver: Solver = self.solver_class(Arm(**arm))
        with np.load(targets) as data:
            self.targets, self.seeds = data["targets"], data["seeds"]
        self.size = 1
        self.solve(range(-3, 0))

    def solve(self, indices: Iterable[int]) -> list[Answer]:
        """Targets one right after the other, prepared before and read after all of them."""
        inputs = [self.prepared(index) for index in indices]
        results, times = [], []
        for x in inputs:
            cpu = time.process_time_ns()
            wall = time.perf_counter_ns()
            result = self.solver.solve(x)
            wall = time.perf_counter_ns() - wall
            cpu = time.process_time_ns() - cpu - self.clock
            results.append(result)
            times.append((max(cpu, 0) * 1e-9, wall * 1e-9))
        return [
            (*self.read(result, index), *taken)
            for index, result, taken in zip(indices, results, times, strict=True)
        ]

    def prepared(self, index: int) -> Any:
        rng = np.random.default_rng([2, index % len(self.targets)])
        return self.solver.prepare(self.targets[index], self.seeds[index], rng)

    def read(self, result: Any, index: int) -> tuple[list[float] | None, bool]:
        q, claim = self.solver.answer(result, self.seeds[index])
        return (None if q is None else np.asarray(q).tolist()), claim

    def run(self, first: int, last: int, seconds: float) -> list[Answer]:
        """Answers to the targets from `first` on, until `last` or about as long as said."""
        gc.collect()
        gc.disable()
        results: list[Answer] = []
        end = time.perf_counter() + seconds
        while first < last and time.perf_counter() < end:
            batch = self.solve(range(first, min(first + self.size, last)))
            results += batch
            first += len(batch)
            mean = sum(wall for *_, wall in batch) / len(batch)
            self.size = max(1, min(MOST_AT_ONCE, int(BATCH_SECONDS / mean)))
        gc.enable()
        return results


def main() -> None:
    pipe = Connection(int(sys.argv[2]))
    os.dup2(2, 1)  # peers print
    worker = Worker(sys.argv[1])
    while True:
        try:
            method, *arguments = pipe.recv()
        except EOFError:
            return
        pipe.send(getattr(worker, method)(*arguments))


if __name__ == "__main__":
    main()
