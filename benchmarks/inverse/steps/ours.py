"""thing_kin: strict priorities, a bounded least-squares problem."""

import importlib
from pathlib import Path
from typing import Any

from inverse import Arm, register
from inverse.steps import DT, Step, middle


@register
class OurStep(Step):
    name = "step_thing_kin"
    title = "thing_kin"
    note = "TaskPriority with limits=True: PoseTask, BaseTask, PostureTask in strict order"
    packages = ("thing_kin",)
    environment = ""

    @staticmethod
    def available() -> bool:
        try:
            text = importlib.import_module("thing_kin").TaskPriority.__doc__ or ""
        except ImportError:
            return False
        return "limits : bool" in text

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        tk = importlib.import_module("thing_kin")
        chain = tk.robots.thing(order="base_first")  # as a URDF it would have no base to speak of
        assert list(chain.names) == arm.joints, Path(arm.urdf)
        tasks = [tk.PoseTask(), tk.BaseTask(), tk.PostureTask()]
        self.step = tk.TaskPriority(chain, tasks, limits=True, dt=DT).step
        self.posture = middle(arm)

    def ready(self, q: Any, hand: Any, base: Any) -> Any:
        return q, (hand, base, self.posture)

    def solve(self, x: Any) -> Any:
        return self.step(*x)
