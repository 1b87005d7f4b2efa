"""thing_kin's own solvers, as its users call them."""

import importlib
import importlib.util
from pathlib import Path
from typing import Any

from inverse import POSITION_TOLERANCE, ROTATION_TOLERANCE, Arm, Solver, register


def offers(name: str, module: str = "thing_kin") -> bool:
    """Whether it is there; a build without KDL has no thing_kin.kdl."""
    try:
        return hasattr(importlib.import_module(module), name)
    except ImportError:
        return False


class Ours(Solver):
    packages = ("thing_kin",)
    environment = ""

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        self.tk = importlib.import_module("thing_kin")
        self.chain = self.tk.Chain.from_urdf(Path(arm.urdf).read_text(), base=arm.base, tip=arm.tip)

    def answer(self, result: Any, q0: Any) -> tuple[Any, bool]:
        return result.q, bool(result.success)


@register
class Numerical(Ours):
    name = "thing_kin"
    title = "thing_kin.NumericIk"
    note = "its defaults, a tolerance of 1e-5 m and rad; a UR restarts from its closed form"
    closed_form = True

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        self.solver = self.tk.NumericIk(
            self.chain,
            position_tolerance=POSITION_TOLERANCE,
            rotation_tolerance=ROTATION_TOLERANCE,
            closed_form=self.closed_form,
        )

    @staticmethod
    def available() -> bool:
        return offers("NumericIk")

    def solve(self, x: Any) -> Any:
        T, q0, _ = x
        return self.solver.solve(T, q0)


@register
class NumericalAlone(Numerical):
    name = "thing_kin_alone"
    title = "the same, alone"
    note = "the same with closed_form=False, for arms that have one"
    closed_form = False

    @staticmethod
    def can(arm: Arm) -> bool:
        return arm.n == 6


@register
class ClosedForm(Ours):
    name = "thing_kin_all"
    title = "thing_kin.ik_all"
    note = "closed form, all branches within the limits, the nearest to the seed first"

    @staticmethod
    def available() -> bool:
        return offers("ik_all")

    @staticmethod
    def can(arm: Arm) -> bool:
        return arm.n == 6

    def solve(self, x: Any) -> Any:
        T, q0, _ = x
        return self.tk.ik_all(self.chain, T, seed=q0)

    def answer(self, result: Any, q0: Any) -> tuple[Any, bool]:
        exact = result.q[result.exact]
        return (exact[0], True) if len(exact) else (None, False)


@register
class KdlBackEnd(Ours):
    name = "thing_kin_kdl"
    title = "thing_kin.kdl.ik"
    note = "KDL's LMA in C++ with restarts within the limits"

    @staticmethod
    def available() -> bool:
        return offers("ik", "thing_kin.kdl")

    def solve(self, x: Any) -> Any:
        T, q0, _ = x
        return self.kdl.ik(
            self.chain,
            T,
            seed=q0,
            position_tolerance=POSITION_TOLERANCE,
            rotation_tolerance=ROTATION_TOLERANCE,
        )

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        self.kdl = importlib.import_module("thing_kin.kdl")
