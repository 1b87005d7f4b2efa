"""mink: one weighted quadratic program."""

import importlib
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from inverse import Arm, register
from inverse.solvers.mink import COMPILER, Mink
from inverse.steps import BASE, BASE_FRAME, DT, HAND, HAND_FRAME, POSTURE, Step, middle, planar


@register
class MinkStep(Step):
    name = "step_mink"
    title = "mink"
    note = "FrameTask, FrameTask, PostureTask; configuration and velocity limits; DAQP"
    packages = Mink.packages
    available = staticmethod(Mink.available)

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        self.mink, mujoco = importlib.import_module("mink"), importlib.import_module("mujoco")
        text = Path(arm.urdf).read_text()
        model = mujoco.MjModel.from_xml_string(text.replace("</robot>", COMPILER))
        mink = self.mink
        self.state = mink.Configuration(model)
        self.hand = mink.FrameTask(HAND_FRAME, "body", position_cost=HAND, orientation_cost=HAND)
        self.base = mink.FrameTask(BASE_FRAME, "body", position_cost=BASE, orientation_cost=BASE)
        self.posture = mink.PostureTask(model, cost=POSTURE)
        self.posture.set_target(middle(arm))
        speeds = {
            joint.get("name"): float(joint.find("limit").get("velocity"))  # type: ignore
            for joint in ElementTree.fromstring(text).findall("joint")
            if joint.get("type") != "fixed"
        }
        self.limits = [mink.ConfigurationLimit(model, 1.0), mink.VelocityLimit(model, speeds)]

    def ready(self, q: Any, hand: Any, base: Any) -> Any:
        return q, self.mink.SE3.from_matrix(hand), self.mink.SE3.from_matrix(planar(*base))

    def solve(self, x: Any) -> Any:
        q, hand, base = x
        self.state.update(q)
        self.hand.set_target(hand)
        self.base.set_target(base)
        tasks = [self.hand, self.base, self.posture]
        limits = self.limits
        return self.mink.solve_ik(self.state, tasks, DT, "daqp", limits=limits, safety_break=False)

    def answer(self, result: Any, q0: Any) -> tuple[Any, bool]:
        return q0 + DT * result, True
