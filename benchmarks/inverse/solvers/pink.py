"""pink: quadratic programs over Pinocchio."""

import importlib
import importlib.util
from typing import Any

import numpy as np

from inverse import Arm, register
from inverse.descent import Descent


@register
class Pink(Descent):
    name = "pink"
    title = "pink"
    note = "FrameTask with equal costs, lm_damping 0.01, full steps within the limits, DAQP"
    packages = ("pin-pink", "pin", "daqp")

    @staticmethod
    def available() -> bool:
        return all(importlib.util.find_spec(name) for name in ("pink", "qpsolvers", "daqp"))

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        self.pin, self.pink = importlib.import_module("pinocchio"), importlib.import_module("pink")
        limits = importlib.import_module("pink.limits")
        self.model = self.pin.buildModelFromUrdf(arm.urdf)
        self.state = self.pink.Configuration(
            self.model, self.model.createData(), self.pin.neutral(self.model)
        )
        self.task = self.pink.tasks.FrameTask(
            arm.tip, position_cost=1.0, orientation_cost=1.0, lm_damping=0.01
        )
        self.limits = [limits.ConfigurationLimit(self.model, config_limit_gain=1.0)]
        self.places = [self.model.joints[self.model.getJointId(j)].idx_q for j in arm.joints]
        self.turning = np.array([kind == "continuous" for kind in arm.types])

    def prepare(self, T: Any, q0: Any, rng: np.random.Generator) -> Any:
        return self.pin.SE3(T), q0, rng

    def go(self, q: Any, T: Any) -> None:
        self.task.set_target(T)
        full = np.zeros(self.model.nq)
        for place, value, turning in zip(self.places, q, self.turning, strict=True):
            if turning:
                full[place : place + 2] = np.cos(value), np.sin(value)
            else:
                full[place] = value
        self.state.update(full)

    def error(self) -> Any:
        return self.task.compute_error(self.state)

    def step(self) -> bool:
        try:
            velocity = self.pink.solve_ik(
                self.state, [self.task], 1.0, "daqp", limits=self.limits, safety_break=False
            )
        except self.pink.exceptions.NoSolutionFound:
            return False
        self.state.integrate_inplace(velocity, 1.0)
        return True

    def configuration(self) -> Any:
        q = self.state.q
        return np.array(
            [
                np.arctan2(q[i + 1], q[i]) if turning else q[i]
                for i, turning in zip(self.places, self.turning, strict=True)
            ]
        )
