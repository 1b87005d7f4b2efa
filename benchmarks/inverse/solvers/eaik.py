"""EAIK: closed form by subproblem decomposition, all branches of a six-joint arm."""

import importlib
import importlib.util
from typing import Any

import numpy as np

from inverse import Arm, Solver, register
from inverse.urdf import joints


@register
class Eaik(Solver):
    name = "eaik"
    title = "EAIK"
    note = "UrdfRobot.IK, all branches; the nearest within the limits is chosen untimed"
    packages = ("eaik",)

    @staticmethod
    def available() -> bool:
        return importlib.util.find_spec("eaik") is not None

    @staticmethod
    def can(arm: Arm) -> bool:
        return arm.n == 6

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        self.robot = importlib.import_module("eaik.IK_URDF").UrdfRobot(arm.urdf)
        moving, tool = joints(arm)
        zero = np.linalg.multi_dot([joint.before for joint in moving])
        # Its own tool: at the origin of the last joint, turned as the root when all joints are 0.
        frame = np.eye(4)
        frame[:3, :3] = zero[:3, :3].T
        self.offset = np.linalg.inv(tool) @ frame

    def prepare(self, T: Any, q0: Any, rng: np.random.Generator) -> Any:
        return T @ self.offset

    def solve(self, x: Any) -> Any:
        return self.robot.IK(x)

    def answer(self, result: Any, q0: Any) -> tuple[Any, bool]:
        """Its angles are within a turn: two turns either way of UR arms add nothing."""
        exact = [q for q, ls in zip(np.array(result.Q), result.is_LS, strict=True) if not ls]
        able = [q for q in exact if np.all((q >= self.arm.lower) & (q <= self.arm.upper))]
        if not able:
            return (exact[0] if exact else None), False
        return min(able, key=lambda q: float(np.abs(q - q0).max())), True
