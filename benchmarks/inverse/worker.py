"""The process of one solver: asked over a pipe, it solves targets and times each.

    python -m inverse.worker SOLVER PIPE

Requests are tuples (method, arguments...), answers what the method returns.
"""

import gc
import os
import platform
import sys
import time
from importlib.metadata import PackageNotFoundError, version
from multiprocessing.connection import Connection
from typing import Any

import numpy as np

from inverse import Arm, Solver, gather


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
        for index in range(-3, 0):
            self.one(index)

    def one(self, index: int) -> tuple[list[float] | None, bool, float, float]:
        """Answer, claim, CPU and wall seconds. CPU is the process's, so of all its threads."""
        rng = np.random.default_rng([2, index % len(self.targets)])
        x = self.solver.prepare(self.targets[index], self.seeds[index], rng)
        cpu = time.process_time_ns()
        wall = time.perf_counter_ns()
        result = self.solver.solve(x)
        wall = time.perf_counter_ns() - wall
        cpu = max(time.process_time_ns() - cpu - self.clock, 0)
        q, claim = self.solver.answer(result)
        return (None if q is None else np.asarray(q).tolist()), claim, cpu * 1e-9, wall * 1e-9

    def run(self, first: int, last: int, seconds: float) -> list[Any]:
        """Answers to the targets from `first` on, until `last` or about as long as said."""
        gc.collect()
        gc.disable()
        results: list[Any] = []
        end = time.perf_counter() + seconds
        while first + len(results) < last and time.perf_counter() < end:
            results.append(self.one(first + len(results)))
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
