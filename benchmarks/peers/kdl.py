"""Orocos KDL: PyKDL where it can be imported, else KDL's solvers behind thing_kin.kdl."""

import importlib
import importlib.util
from typing import Any

import numpy as np

from peers import Peer, register
from problem import Problem
from thing_dh import Pose, folded


@register
class PyKdl(Peer):
    name = "pykdl"
    note = "KDL's own types in and out: JntArray, Frame, Jacobian"

    @staticmethod
    def available() -> bool:
        return importlib.util.find_spec("PyKDL") is not None

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem)
        self.kdl = kdl = importlib.import_module("PyKDL")
        joints, tool = folded()
        after = [before for before, _ in joints[1:]] + [tool]
        chain = kdl.Chain()
        chain.addSegment(kdl.Segment(kdl.Joint(kdl.Joint.Fixed), self._frame(joints[0][0])))
        for (_, kind), tip in zip(joints, after, strict=True):
            axis = kdl.Joint.RotZ if kind == "revolute" else kdl.Joint.TransZ
            chain.addSegment(kdl.Segment(kdl.Joint(axis), self._frame(tip)))
        self.chain = chain  # the solvers keep a reference only
        self.fk_solver = kdl.ChainFkSolverPos_recursive(chain)
        self.jacobian_solver = kdl.ChainJntToJacSolver(chain)

    def _frame(self, T: Pose) -> Any:
        return self.kdl.Frame(
            self.kdl.Rotation(*T[:3, :3].ravel().tolist()), self.kdl.Vector(*T[:3, 3].tolist())
        )

    def prepare(self, work: str, x: Any) -> Any:
        q = self.kdl.JntArray(len(x))
        for i, value in enumerate(x.tolist()):
            q[i] = value
        return q

    def fk(self, q: Any) -> Any:
        frame = self.kdl.Frame()
        self.fk_solver.JntToCart(q, frame)
        return frame

    def jacobian(self, q: Any) -> Any:
        J = self.kdl.Jacobian(q.rows())
        self.jacobian_solver.JntToJac(q, J)
        return J

    def answer(self, work: str, result: Any) -> Any:
        rows, cols = (4, 4) if work == "fk" else (6, result.columns())
        array = np.eye(rows, cols)
        for row in range(3 if work == "fk" else 6):
            for col in range(cols):
                array[row, col] = result[row, col]
        return array


@register
class KdlBackEnd(Peer):
    name = "kdl"
    note = "thing_kin.kdl.KdlChain: KDL's solvers, arrays in and out"

    @staticmethod
    def available() -> bool:
        if PyKdl.available():
            return False  # the real thing is there
        return importlib.util.find_spec("thing_kin._kdl") is not None

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem)
        chain = importlib.import_module("thing_kin.kdl").KdlChain(self.robot)
        self.fk = self.fk_batch = chain.fk
        self.jacobian = self.jacobian_batch = chain.jacobian
