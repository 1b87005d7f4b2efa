"""Problem (4.34) of [M17], head to head: the least sqrt(kappa/M) of the Thing with its hand there.

Solvers share one process and take turns at each instance; only `solve` is timed.
"""

import importlib
import pkgutil
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

import thing_kin as tk

REGISTRY: dict[str, type["Solver"]] = {}


@dataclass(frozen=True)
class Instance:
    """Minimize sqrt(kappa/M) with the hand at T, the base in one disc and out of another."""

    robot: tk.Chain  # its limits are the instance's
    T: Any  # (4, 4)
    goal: tuple[float, float]  # of the base, m
    radius: float  # about it, m
    obstacle: tk.Disc  # the base keeps out
    heading: tuple[float, float]  # rad
    seed: Any  # (9,)

    @property
    def lower(self) -> Any:
        lower = np.array(self.robot.lower)
        lower[-1] = max(lower[-1], self.heading[0])
        return lower

    @property
    def upper(self) -> Any:
        upper = np.array(self.robot.upper)
        upper[-1] = min(upper[-1], self.heading[1])
        return upper


class Solver:
    """An adapter: a new solver is a new file in `solvers` with a subclass under @register."""

    name: ClassVar[str]
    title: ClassVar[str]
    note: ClassVar[str]  # how it is set up, and by whom its functions are computed
    packages: ClassVar[tuple[str, ...]] = ()  # whose versions are reported

    def __init__(self, instances: list[Instance]) -> None:
        """Raise ImportError where it is not installed."""
        self.instances = instances

    def prepare(self, i: int) -> Any:
        """Instance i in the solver's own terms."""
        return self.instances[i]

    def solve(self, x: Any) -> Any:
        """The answer in the solver's own terms."""
        raise NotImplementedError

    def answer(self, result: Any) -> tuple[Any, bool]:
        """Joint values, and whether the solver says that they are a solution."""
        q, success = result
        return np.asarray(q), bool(success)


class Outside(Solver):
    """A program of its own: it solves and times all instances at once."""

    def all(self) -> list[tuple[Any, bool, float]]:
        """Joint values, claim and CPU seconds of each."""
        raise NotImplementedError


def register(solver: type[Solver]) -> type[Solver]:
    REGISTRY[solver.name] = solver
    return solver


def gather() -> dict[str, type[Solver]]:
    """All solvers by name, thing_kin's first."""
    package = importlib.import_module("pose.solvers")
    for module in pkgutil.iter_modules(package.__path__):
        importlib.import_module(f"pose.solvers.{module.name}")
    return dict(sorted(REGISTRY.items(), key=lambda item: ("thing_kin" not in item[0], item[0])))


def entered(names: list[str], instances: list[Instance]) -> Iterator[Solver]:
    """Those that are installed."""
    for name, solver in gather().items():
        if not names or name in names:
            try:
                yield solver(instances)
            except (ImportError, FileNotFoundError) as reason:
                print(f"  {solver.title}: absent: {reason}", flush=True)
