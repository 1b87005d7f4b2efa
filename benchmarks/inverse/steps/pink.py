"""pink: one weighted quadratic program."""

import importlib
from typing import Any

from inverse import Arm, register
from inverse.solvers.pink import Pink
from inverse.steps import BASE, BASE_FRAME, DT, HAND, HAND_FRAME, POSTURE, Step, middle, planar


@register
class PinkStep(Step):
    name = "step_pink"
    title = "pink"
    note = "FrameTask, FrameTask, PostureTask; configuration and velocity limits; DAQP"
    packages = Pink.packages
    available = staticmethod(Pink.available)

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        self.pin, self.pink = importlib.import_module("pinocchio"), importlib.import_module("pink")
        limits, tasks = importlib.import_module("pink.limits"), self.pink.tasks
        model = self.pin.buildModelFromUrdf(arm.urdf)
        self.state = self.pink.Configuration(model, model.createData(), middle(arm))
        self.hand = tasks.FrameTask(HAND_FRAME, position_cost=HAND, orientation_cost=HAND)
        self.base = tasks.FrameTask(BASE_FRAME, position_cost=BASE, orientation_cost=BASE)
        self.posture = tasks.PostureTask(cost=POSTURE)
        self.posture.set_target(middle(arm))
        self.limits = [limits.ConfigurationLimit(model, 1.0), limits.VelocityLimit(model)]

    def ready(self, q: Any, hand: Any, base: Any) -> Any:
        return q, self.pin.SE3(hand), self.pin.SE3(planar(*base))

    def solve(self, x: Any) -> Any:
        q, hand, base = x
        self.state.update(q)
        self.hand.set_target(hand)
        self.base.set_target(base)
        tasks = [self.hand, self.base, self.posture]
        limits = self.limits
        return self.pink.solve_ik(self.state, tasks, DT, "daqp", limits=limits, safety_break=False)

    def answer(self, result: Any, q0: Any) -> tuple[Any, bool]:
        return q0 + DT * result, True
