"""thing_kin itself, as its users call it; batches on one thread, as CPU time is measured."""

from functools import partial
from typing import Any

import numpy as np

import thing_kin as tk
from peers import Peer, register
from problem import BATCH, Problem


@register
class ThingKin(Peer):
    name = "thing_kin"
    note = "numpy arrays in and out, batches with threads=1"

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem)
        robot = self.robot
        self.fk, self.jacobian, self.hessian = robot.fk, robot.jacobian, robot.hessian
        self.fk_and_jacobian = robot.fk_and_jacobian
        self.fk_batch = partial(robot.fk, threads=1)
        self.fk_batch_out = partial(robot.fk, out=np.empty((BATCH, 4, 4)), threads=1)
        self.fk_quaternion_batch = partial(robot.fk_quaternion, threads=1)
        self.jacobian_batch = partial(robot.jacobian, threads=1)
        self.fk_and_jacobian_batch = partial(robot.fk_and_jacobian, threads=1)
        self.hessian_batch = partial(robot.hessian, threads=1)
        self.pinv = tk.pinv
        self.solver = tk.TaskPriority(
            robot, [tk.PoseTask(), tk.BaseTask()], scheme="chiaverini", inverse=tk.Exact()
        )

    def jacobian_dot(self, x: Any) -> Any:
        return self.robot.jacobian_dot(*x)

    def acceleration(self, x: Any) -> Any:
        return self.robot.acceleration(*x)

    def step(self, x: Any) -> Any:
        q, T_goal, base_goal = x
        return self.solver.step(q, (T_goal, base_goal))
