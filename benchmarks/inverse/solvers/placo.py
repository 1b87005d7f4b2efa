"""placo: quadratic programs in C++ over its own Pinocchio, hence its own environment."""

import importlib
import importlib.util
from typing import Any

import numpy as np

from inverse import Arm, register
from inverse.descent import Descent


@register
class Placo(Descent):
    name = "placo"
    title = "placo"
    note = "soft frame task with equal weights, regularization 1e-6, full steps within the limits"
    packages = ("placo", "pin")
    environment = "placo"

    @staticmethod
    def available() -> bool:
        return importlib.util.find_spec("placo") is not None

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        placo = importlib.import_module("placo")
        self.robot = placo.RobotWrapper(arm.urdf, placo.Flags.ignore_collisions)
        self.solver = placo.KinematicsSolver(self.robot)
        self.solver.mask_fbase(True)
        self.solver.enable_joint_limits(True)
        self.solver.enable_velocity_limits(False)
        self.task = self.solver.add_frame_task(arm.tip, np.eye(4))
        self.task.configure("tip", "soft", 1.0, 1.0)
        self.position, self.orientation = self.task.position(), self.task.orientation()
        self.solver.add_regularization_task(1e-6)

    def go(self, q: Any, T: Any) -> None:
        self.task.T_world_frame = T
        for name, value in zip(self.arm.joints, q, strict=True):
            self.robot.set_joint(name, value)
        self.see()

    def see(self) -> None:
        """Bring kinematics and errors up to date, which `solve` does before its step only."""
        self.robot.update_kinematics()
        self.position.update()
        self.orientation.update()

    def error(self) -> Any:
        return np.concatenate([self.position.error(), self.orientation.error()])

    def step(self) -> bool:
        try:
            self.solver.solve(True)
        except RuntimeError:  # its QPError
            return False
        self.see()
        return True

    def configuration(self) -> Any:
        return np.array([self.robot.get_joint(name) for name in self.arm.joints])
