"""placo: one weighted quadratic program in C++."""

import importlib
from typing import Any

import numpy as np

from inverse import Arm, register
from inverse.solvers.placo import Placo
from inverse.steps import BASE, BASE_FRAME, DT, HAND, HAND_FRAME, POSTURE, Step, middle, planar


@register
class PlacoStep(Step):
    name = "step_placo"
    title = "placo"
    note = "frame, frame and joints task, all soft; joint and velocity limits"
    packages = Placo.packages
    environment = Placo.environment
    available = staticmethod(Placo.available)

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        placo = importlib.import_module("placo")
        self.robot = placo.RobotWrapper(arm.urdf, placo.Flags.ignore_collisions)
        self.solver = placo.KinematicsSolver(self.robot)
        self.solver.mask_fbase(True)
        self.solver.dt = DT
        self.solver.enable_joint_limits(True)
        self.solver.enable_velocity_limits(True)
        self.hand = self.solver.add_frame_task(HAND_FRAME, np.eye(4))
        self.hand.configure("hand", "soft", HAND**2, HAND**2)  # the others square them
        self.base = self.solver.add_frame_task(BASE_FRAME, np.eye(4))
        self.base.configure("base", "soft", BASE**2, BASE**2)
        posture = self.solver.add_joints_task()
        posture.set_joints(dict(zip(arm.joints, middle(arm), strict=True)))
        posture.configure("posture", "soft", POSTURE**2)
        self.places = [self.robot.get_joint_offset(name) for name in arm.joints]
        self.speeds = [self.robot.get_joint_v_offset(name) for name in arm.joints]

    def ready(self, q: Any, hand: Any, base: Any) -> Any:
        return q, hand, planar(*base)

    def solve(self, x: Any) -> Any:
        q, self.hand.T_world_frame, self.base.T_world_frame = x
        state = self.robot.state.q
        state[self.places] = q
        self.robot.state.q = state
        self.robot.update_kinematics()
        return self.solver.solve(False)

    def answer(self, result: Any, q0: Any) -> tuple[Any, bool]:
        return q0 + result[self.speeds], True
