"""thing_kin itself, as its users call it."""

from typing import Any

import thing_kin as tk
from peers import Peer, register
from problem import Problem


@register
class ThingKin(Peer):
    name = "thing_kin"
    note = "numpy arrays in and out"

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem)
        self.fk = self.fk_batch = self.robot.fk
        self.jacobian = self.jacobian_batch = self.robot.jacobian
        self.hessian = self.robot.hessian
        self.pinv = tk.pinv
        self.solver = tk.TaskPriority(
            self.robot, [tk.PoseTask(), tk.BaseTask()], scheme="chiaverini", inverse=tk.Exact()
        )

    def step(self, x: Any) -> Any:
        q, T_goal, base_goal = x
        return self.solver.step(q, (T_goal, base_goal))
