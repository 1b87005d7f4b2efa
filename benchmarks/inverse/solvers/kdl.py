"""Orocos KDL: its Levenberg-Marquardt solver, which knows no limits, with restarts around it."""

import importlib
import importlib.util
from typing import Any

import numpy as np

from inverse import POSITION_TOLERANCE, Arm, Solver, register
from inverse.urdf import joints

STARTS = 100  # as many as Robotics Toolbox takes
STEPS = 100
EPS = 0.01 * POSITION_TOLERANCE  # it weighs rotations with 0.01


@register
class PyKdl(Solver):
    name = "pykdl"
    title = "KDL LMA"
    note = "PyKDL, 100 steps; wrapped by whole turns into the limits, else another of 100 starts"

    @staticmethod
    def available() -> bool:
        return importlib.util.find_spec("PyKDL") is not None

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        self.kdl = kdl = importlib.import_module("PyKDL")
        moving, tool = joints(arm)
        after = [joint.before for joint in moving[1:]] + [tool]
        fixed = kdl.Joint(kdl.Joint.Fixed)
        self.chain = kdl.Chain()  # the solvers keep a reference only
        self.chain.addSegment(kdl.Segment(fixed, self._frame(moving[0].before)))
        for joint, tip in zip(moving, after, strict=True):
            axis = kdl.Joint.TransZ if joint.slides else kdl.Joint.RotZ
            self.chain.addSegment(kdl.Segment(kdl.Joint(axis), self._frame(tip)))
        self.solver = kdl.ChainIkSolverPos_LMA(self.chain, EPS, STEPS)
        huge = np.finfo(float).max / 4.0
        self.lower, self.upper = np.maximum(arm.lower, -huge), np.minimum(arm.upper, huge)
        turns = np.array([not joint.slides for joint in moving])
        self.turn = np.where(turns & np.isfinite(arm.lower), 2.0 * np.pi, np.inf)

    def _frame(self, T: Any) -> Any:
        return self.kdl.Frame(
            self.kdl.Rotation(*T[:3, :3].ravel().tolist()), self.kdl.Vector(*T[:3, 3].tolist())
        )

    def prepare(self, T: Any, q0: Any, rng: np.random.Generator) -> Any:
        return self._frame(T), q0, rng

    def _joints(self, q: Any) -> Any:
        result = self.kdl.JntArray(len(q))
        for i, value in enumerate(q.tolist()):
            result[i] = value
        return result

    def solve(self, x: Any) -> Any:
        frame, q0, rng = x
        q, found = q0, self.kdl.JntArray(len(q0))
        for _ in range(STARTS):
            if self.solver.CartToJnt(self._joints(q), frame, found) >= 0:
                q = np.array([found[i] for i in range(len(q0))])
                q += self.turn_back(q)
                if np.all((q >= self.lower) & (q <= self.upper)):
                    return q, True
            q = self.arm.random(rng)
        return None, False

    def turn_back(self, q: Any) -> Any:
        """Whole turns that bring a joint between its limits if any do."""
        turns = np.where(
            q < self.lower,
            np.ceil((self.lower - q) / self.turn),
            -np.ceil(np.maximum(q - self.upper, 0.0) / self.turn),
        )
        return turns * np.where(turns, self.turn, 0.0)
