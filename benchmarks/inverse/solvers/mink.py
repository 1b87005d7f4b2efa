"""mink: quadratic programs over MuJoCo."""

import importlib
import importlib.util
from pathlib import Path
from typing import Any

import numpy as np

from inverse import Arm, register
from inverse.descent import Descent

# MuJoCo's own element in a URDF: no link vanishes, and links without mass get some.
COMPILER = (
    '<mujoco><compiler fusestatic="false" boundmass="0.01" boundinertia="0.01"/></mujoco></robot>'
)


@register
class Mink(Descent):
    name = "mink"
    title = "mink"
    note = "FrameTask with equal costs, lm_damping 0.01, full steps within the limits, DAQP"
    packages = ("mink", "mujoco", "daqp")

    @staticmethod
    def available() -> bool:
        return all(importlib.util.find_spec(name) for name in ("mink", "mujoco", "daqp"))

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        self.mink, mujoco = importlib.import_module("mink"), importlib.import_module("mujoco")
        text = Path(arm.urdf).read_text().replace("</robot>", COMPILER)
        self.model = mujoco.MjModel.from_xml_string(text)
        self.state = self.mink.Configuration(self.model)
        self.task = self.mink.FrameTask(
            arm.tip, "body", position_cost=1.0, orientation_cost=1.0, lm_damping=0.01
        )
        self.limits = [self.mink.ConfigurationLimit(self.model, gain=1.0)]
        self.places = [self.model.joint(name).qposadr[0] for name in arm.joints]

    def prepare(self, T: Any, q0: Any, rng: np.random.Generator) -> Any:
        return self.mink.SE3.from_matrix(T), q0, rng

    def go(self, q: Any, T: Any) -> None:
        self.task.set_target(T)
        full = np.zeros(self.model.nq)
        full[self.places] = q
        self.state.update(full)

    def error(self) -> Any:
        return self.task.compute_error(self.state)

    def step(self) -> bool:
        try:
            velocity = self.mink.solve_ik(
                self.state, [self.task], 1.0, "daqp", limits=self.limits, safety_break=False
            )
        except self.mink.exceptions.NoSolutionFound:
            return False
        self.state.integrate_inplace(velocity, 1.0)
        return True

    def configuration(self) -> Any:
        return self.state.q[self.places]
