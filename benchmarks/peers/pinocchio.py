"""Pinocchio through its Python bindings; its task-priority step is numpy on top of it."""

import importlib
import importlib.util
from typing import Any

import numpy as np

from peers import Peer, register
from problem import BATCH, Problem
from thing_dh import folded


def in_order(H: Any) -> Any:
    """Pinocchio's column-major Hessian, which the bindings label row-major."""
    return H.reshape(H.shape[::-1]).transpose()


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
        self.poses = np.empty((BATCH, 4, 4))
        self.axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED

    def fk(self, q: Any) -> Any:
        self.pin.forwardKinematics(self.model, self.data, q)
        return self.pin.updateFramePlacement(self.model, self.data, self.tool).homogeneous

    def jacobian(self, q: Any) -> Any:
        return self.pin.computeFrameJacobian(self.model, self.data, q, self.tool, self.axes)

    def fk_and_jacobian(self, q: Any) -> Any:
        self.pin.computeJointJacobians(self.model, self.data, q)
        T = self.pin.updateFramePlacement(self.model, self.data, self.tool).homogeneous
        return T, self.pin.getFrameJacobian(self.model, self.data, self.tool, self.axes)

    def hessian(self, q: Any) -> Any:
        self.pin.computeJointJacobians(self.model, self.data, q)
        self.pin.computeJointKinematicHessians(self.model, self.data)
        return self.pin.getFrameKinematicHessian(self.model, self.data, self.tool, self.axes)

    def jacobian_dot(self, x: Any) -> Any:
        self.pin.computeJointJacobiansTimeVariation(self.model, self.data, *x)
        self.pin.updateFramePlacement(self.model, self.data, self.tool)
        return self.pin.getFrameJacobianTimeVariation(self.model, self.data, self.tool, self.axes)

    def acceleration(self, x: Any) -> Any:
        self.pin.forwardKinematics(self.model, self.data, *x)
        return self.pin.getFrameClassicalAcceleration(
            self.model, self.data, self.tool, self.axes
        ).vector

    def fk_batch(self, Q: Any) -> Any:
        return self.fk_batch_out(Q, np.empty((len(Q), 4, 4)))

    def fk_batch_out(self, Q: Any, out: Any = None) -> Any:
        poses = self.poses if out is None else out
        for pose, q in zip(poses, Q, strict=True):
            pose[:] = self.fk(q)
        return poses

    def fk_quaternion_batch(self, Q: Any) -> Any:
        """SE3ToXYZQUAT, whose order is x, y, z, w."""
        out = np.empty((len(Q), 7))
        for row, q in zip(out, Q, strict=True):
            self.pin.forwardKinematics(self.model, self.data, q)
            T = self.pin.updateFramePlacement(self.model, self.data, self.tool)
            row[:] = self.pin.SE3ToXYZQUAT(T)
        return out

    def jacobian_batch(self, Q: Any) -> Any:
        jacobians = np.empty((len(Q), 6, self.model.nv))
        for J, q in zip(jacobians, Q, strict=True):
            J[:] = self.jacobian(q)
        return jacobians

    def fk_and_jacobian_batch(self, Q: Any) -> Any:
        poses, jacobians = np.empty((len(Q), 4, 4)), np.empty((len(Q), 6, self.model.nv))
        for T, J, q in zip(poses, jacobians, Q, strict=True):
            T[:], J[:] = self.fk_and_jacobian(q)
        return poses, jacobians

    def hessian_batch(self, Q: Any) -> Any:
        hessians = np.empty((len(Q), 6, self.model.nv, self.model.nv))
        for H, q in zip(hessians, Q, strict=True):
            H[:] = in_order(self.hessian(q))
        return hessians

    def answer(self, work: str, result: Any) -> Any:
        if work == "hessian":
            return in_order(result)
        if work == "fk_quaternion_batch":
            w_first = result[:, [0, 1, 2, 6, 3, 4, 5]]
            w_first[w_first[:, 3] < 0.0, 3:] *= -1.0
            return w_first
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
