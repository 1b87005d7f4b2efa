"""Robotics Toolbox for Python: its elementary transform sequence, which is compiled."""

import importlib
import importlib.util
from typing import Any

from peers import Peer, register
from problem import Problem
from thing_dh import folded


@register
class RoboticsToolbox(Peer):
    name = "rtb"
    note = "roboticstoolbox.ETS: eval, jacob0, hessian0"

    @staticmethod
    def available() -> bool:
        return importlib.util.find_spec("roboticstoolbox") is not None

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem)
        rtb = importlib.import_module("roboticstoolbox")
        joints, tool = folded()
        terms = []
        for before, kind in joints:
            terms += [rtb.ET.SE3(before), rtb.ET.Rz() if kind == "revolute" else rtb.ET.tz()]
        ets = rtb.ETS([*terms, rtb.ET.SE3(tool)])
        self.fk = self.fk_batch = ets.eval
        self.jacobian, self.hessian = ets.jacob0, ets.hessian0

    def answer(self, work: str, result: Any) -> Any:
        return result.transpose(1, 2, 0) if work == "hessian" else result
