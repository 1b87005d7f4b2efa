"""The functions of an instance for solvers that want them in Python, computed by thing_kin in C++.

The objective is log sqrt(kappa/M): the same minimizers, and peers do better with it.
"""

from typing import Any

import numpy as np

import thing_kin as tk
from pose import Instance


class Functions:
    """Values and derivatives; the last q is remembered, since solvers ask for one at a time."""

    def __init__(self, instance: Instance) -> None:
        self.instance = instance
        self.robot = instance.robot
        self.goal = np.array(instance.goal)
        self.center = np.array(instance.obstacle.center)

    def objective(self, q: Any) -> float:
        return float(np.log(self.robot.dexterity(q)))

    def gradient(self, q: Any) -> Any:
        try:
            return self.robot.dexterity_gradient(q) / self.robot.dexterity(q)
        except ValueError:  # a repeated singular value
            return np.zeros(9)

    def pose(self, q: Any) -> Any:
        """(6,): zero at the goal."""
        return tk.pose_error(self.robot.fk(q), self.instance.T)

    def pose_jacobian(self, q: Any) -> Any:
        """Exact: log(exp(e) exp(-w)) is e - J_r^-1(e) w to first order."""
        T, J = self.robot.fk_and_jacobian(q)
        e = tk.pose_error(T, self.instance.T)
        J[3:] = tk.lie.so3_right_jacobian_inverse(e[3:]) @ J[3:]
        return -J

    def room(self, q: Any) -> Any:
        """(2,): of the base within its disc and outside the obstacle, squared; at least 0."""
        to_goal, to_center = q[6:8] - self.goal, q[6:8] - self.center
        return np.array(
            [
                self.instance.radius**2 - to_goal @ to_goal,
                to_center @ to_center - self.instance.obstacle.radius**2,
            ]
        )

    def room_jacobian(self, q: Any) -> Any:
        J = np.zeros((2, 9))
        J[0, 6:8], J[1, 6:8] = -2.0 * (q[6:8] - self.goal), 2.0 * (q[6:8] - self.center)
        return J
