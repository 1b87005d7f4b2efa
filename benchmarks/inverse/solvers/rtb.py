"""Robotics Toolbox for Python: its compiled Levenberg-Marquardt solver with random restarts."""

import importlib
import importlib.util
from typing import Any

import numpy as np

from inverse import POSITION_TOLERANCE, Arm, Solver, register
from inverse.urdf import joints


@register
class RoboticsToolbox(Solver):
    name = "rtb"
    title = "RTB LM"
    note = "ETS.ik_LM: Chan, its 30 steps and 100 starts, tol 5e-11, half of 1e-5 squared"
    packages = ("roboticstoolbox-python",)

    @staticmethod
    def available() -> bool:
        return importlib.util.find_spec("roboticstoolbox") is not None

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        rtb = importlib.import_module("roboticstoolbox")
        moving, tool = joints(arm)
        finite = np.isfinite(arm.lower)
        lower, upper = np.where(finite, arm.lower, -np.pi), np.where(finite, arm.upper, np.pi)
        terms = []
        for joint, limits in zip(moving, zip(lower, upper, strict=True), strict=True):
            terms.append(rtb.ET.SE3(joint.before))
            terms.append((rtb.ET.tz if joint.slides else rtb.ET.Rz)(qlim=np.array(limits)))
        self.ets = rtb.ETS([*terms, rtb.ET.SE3(tool)])

    def solve(self, x: Any) -> Any:
        T, q0, _ = x
        return self.ets.ik_LM(T, q0=q0, tol=0.5 * POSITION_TOLERANCE**2)

    def answer(self, result: Any, q0: Any) -> tuple[Any, bool]:
        return np.asarray(result.q), bool(result.success)
