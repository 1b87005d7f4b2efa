"""Pinocchio through its Python bindings; its task-priority step is numpy on top of it."""

import importlib
import importlib.util
from typing import Any

import numpy as np

from peers import Peer, register
from problem import Problem
from thing_dh import folded


@register
class Pinocchio(Peer):
    name = "pinocchio"
    note = "pin; the step: its poses and Jacobians, numpy.linalg.pinv and (4.18) in numpy"

    @staticmethod
    def available() -> bool:
        return importlib.util.find_spec("pinocchio") is not None

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem)
        self.pin = pin = importlib.import_module("pinocchio")
        joints, tool = folded()
        self.model = model = pin.Model()
        joint = 0
        for i, (before, kind) in enumerate(joints):
            moving = pin.JointModelRZ() if kind == "revolute" else pin.JointModelPZ()
            joint = model.addJoint(joint, moving, pin.SE3(before), f"joint{i}")
        frame = pin.Frame("tool", joint, 0, pin.SE3(tool), pin.FrameType.OP_FRAME)
        self.tool = model.addFrame(frame)
        self.data = model.createData()
        self.axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED

    def fk(self, q: Any) -> Any:
        self.pin.forwardKinematics(self.model, self.data, q)
        return self.pin.updateFramePlacement(self.model, self.data, self.tool).homogeneous

    def fk_batch(self, Q: Any) -> Any:
        poses = np.empty((len(Q), 4, 4))
        for pose, q in zip(poses, Q, strict=True):
            pose[:] = self.fk(q)
        return poses

    def jacobian(self, q: Any) -> Any:
        return self.pin.computeFrameJacobian(self.model, self.data, q, self.tool, self.axes)

    def jacobian_batch(self, Q: Any) -> Any:
        jacobians = np.empty((len(Q), 6, self.model.nv))
        for J, q in zip(jacobians, Q, strict=True):
            J[:] = self.jacobian(q)
        return jacobians

    def hessian(self, q: Any) -> Any:
        self.pin.computeJointJacobians(self.model, self.data, q)
        self.pin.computeJointKinematicHessians(self.model, self.data)
        return self.pin.getFrameKinematicHessian(self.model, self.data, self.tool, self.axes)

    def answer(self, work: str, result: Any) -> Any:
        if work == "hessian":  # column-major data, which the bindings label row-major
            return result.reshape(result.shape[::-1]).transpose()
        return result

    def step(self, x: Any) -> Any:
        q, T_goal, base_goal = x
        self.pin.computeJointJacobians(self.model, self.data, q)
        T = self.pin.updateFramePlacement(self.model, self.data, self.tool)
        J = self.pin.getFrameJacobian(self.model, self.data, self.tool, self.axes)
        error = np.empty(6)
        error[:3] = T_goal[:3, 3] - T.translation
        error[3:] = self.pin.log3(T_goal[:3, :3] @ T.rotation.T)
        inverse = np.linalg.pinv(J)
        base = np.zeros(self.model.nv)
        base[:3] = base_goal - q[:3]
        base[2] -= 2 * np.pi * round(base[2] / (2 * np.pi))
        return inverse @ (error - J @ base) + base
