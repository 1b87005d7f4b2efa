"""Inverse kinematics, head to head. What a solver sees of the race: an arm, targets, seeds.

Neither this file nor `solvers` and `worker` import thing_kin or a peer: each solver runs in a
process of its own, in the environment where it is installed.
"""

import importlib
import pkgutil
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

POSITION_TOLERANCE = 1e-5  # m
ROTATION_TOLERANCE = 1e-5  # rad

REGISTRY: dict[str, type["Solver"]] = {}


@dataclass(frozen=True)
class Arm:
    """A robot as all solvers get it: its URDF. Joints are in order from the root."""

    name: str
    title: str
    urdf: str  # path of the file
    base: str
    tip: str
    joints: list[str]
    types: list[str]
    lower: list[float]  # -inf of a continuous joint
    upper: list[float]

    @property
    def n(self) -> int:
        return len(self.joints)

    def random(self, rng: np.random.Generator) -> Any:
        """A fresh start within the limits; continuous joints within a turn."""
        finite = np.isfinite(self.lower)
        return rng.uniform(
            np.where(finite, self.lower, -np.pi), np.where(finite, self.upper, np.pi)
        )


class Solver:
    """An adapter: a new solver is a new file in `solvers` with a subclass under @register.

    Only `solve` is timed. A solver that needs random numbers takes them from the generator that it
    gets with each target, or says that it can't.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    note: ClassVar[str]  # how it is set up
    packages: ClassVar[tuple[str, ...]] = ()  # whose versions are reported
    environment: ClassVar[str] = "main"  # the virtual environment it lives in; "": thing_kin's

    def __init__(self, arm: Arm) -> None:
        self.arm = arm

    @staticmethod
    def available() -> bool:
        """Whether it can be imported in this process."""
        raise NotImplementedError

    @staticmethod
    def can(arm: Arm) -> bool:
        """Whether it is made for such an arm."""
        return True

    def prepare(self, T: Any, q0: Any, rng: np.random.Generator) -> Any:
        """Target, seed and generator in the solver's own types."""
        return T, q0, rng

    def solve(self, x: Any) -> Any:
        """The answer in the solver's own types."""
        raise NotImplementedError

    def answer(self, result: Any, q0: Any) -> tuple[Any, bool]:
        """Joint values, or None; and whether the solver says that they are a solution.

        q0: the seed.
        """
        q, success = result
        return q, bool(success)


def register(solver: type[Solver]) -> type[Solver]:
    REGISTRY[solver.name] = solver
    return solver


def gather(package: str = "solvers") -> dict[str, type[Solver]]:
    """All solvers of a package by name, thing_kin's first."""
    name = f"inverse.{package}"
    for module in pkgutil.iter_modules(importlib.import_module(name).__path__):
        importlib.import_module(f"{name}.{module.name}")
    found = {k: solver for k, solver in REGISTRY.items() if solver.__module__.startswith(name)}
    return dict(sorted(found.items(), key=lambda item: (item[1].environment != "", item[0])))
