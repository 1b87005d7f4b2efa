"""Pinocchio on a model of its own: neither thing_kin's kinematics nor a solver's word."""

from typing import Any

import numpy as np
import pinocchio as pin

from pose import Instance
from thing_dh import folded

TOLERANCE = 1e-5  # m and rad, of the pose and of every other constraint
# Pinocchio's order is the chain's from the root: x, y, theta, q0 ... q5.
FROM_ROOT = [6, 7, 8, 0, 1, 2, 3, 4, 5]


class Judge:
    def __init__(self) -> None:
        self.model = pin.Model()
        joints, tool = folded()
        parent = 0
        for i, (before, kind) in enumerate(joints):
            joint = pin.JointModelPZ() if kind == "prismatic" else pin.JointModelRZ()
            parent = self.model.addJoint(parent, joint, pin.SE3(before), f"j{i}")
        frame = pin.Frame("tool", parent, 0, pin.SE3(tool), pin.FrameType.OP_FRAME)
        self.tool = self.model.addFrame(frame)
        self.data = self.model.createData()

    def fk(self, q: Any) -> Any:
        pin.forwardKinematics(self.model, self.data, np.asarray(q)[FROM_ROOT])
        return pin.updateFramePlacement(self.model, self.data, self.tool)

    def violation(self, instance: Instance, q: Any) -> float:
        """The largest of all, m and rad; infinite for what is not finite."""
        if q is None or not np.isfinite(q).all():
            return np.inf
        hand, goal = self.fk(q), pin.SE3(instance.T)
        to_goal = np.hypot(*(q[6:8] - np.array(instance.goal)))
        to_obstacle = np.hypot(*(q[6:8] - np.array(instance.obstacle.center)))
        return max(
            float(np.linalg.norm(hand.translation - goal.translation)),
            float(np.linalg.norm(pin.log3(hand.rotation.T @ goal.rotation))),
            float(np.max(instance.lower - q)),
            float(np.max(q - instance.upper)),
            float(to_goal - instance.radius),
            float(instance.obstacle.radius - to_obstacle),
        )

    def is_feasible(self, instance: Instance, q: Any) -> bool:
        return self.violation(instance, q) <= TOLERANCE

    def objective(self, q: Any) -> float:
        """sqrt(kappa/M), (4.33), from the singular values of Pinocchio's Jacobian."""
        frame = pin.LOCAL_WORLD_ALIGNED
        q = np.asarray(q)[FROM_ROOT]
        J = pin.computeFrameJacobian(self.model, self.data, q, self.tool, frame)
        sigma = np.linalg.svd(J, compute_uv=False)
        return float(np.sqrt(sigma[0] / sigma[-1] / np.prod(sigma)))
