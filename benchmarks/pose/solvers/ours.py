"""thing_kin's own, as its users call it."""

from typing import Any, ClassVar

import numpy as np

import thing_kin as tk
from pose import Instance, Solver, register


@register
class Local(Solver):
    name = "thing_kin"
    title = "thing_kin.plan_pose"
    note = "its defaults; the problem is made anew in every call"
    packages = ("thing_kin",)
    options: ClassVar[dict[str, Any]] = {}

    def solve(self, x: Instance) -> Any:
        return tk.plan_pose(
            x.robot,
            x.T,
            seed=x.seed,
            base_goal=x.goal,
            base_radius=x.radius,
            heading=x.heading,
            obstacles=[x.obstacle],
            **self.options,
        )

    def answer(self, result: Any) -> tuple[Any, bool]:
        return np.array(result.q), result.success


@register
class Global(Local):
    name = "thing_kin_global"
    title = "the same, global"
    note = 'search="global"'
    options: ClassVar[dict[str, Any]] = {"search": "global"}
