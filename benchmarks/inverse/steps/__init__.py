"""One differential step: hand pose, base pose and posture within joint and velocity limits.

A file a solver, which registers itself. Its targets are the hand's; the base's come of the step's
own generator, and the posture is the middle of the joint ranges.
"""

from typing import Any

import numpy as np

from inverse import Arm, Solver

DT = 0.05  # s
BASE_REACH = 0.05  # m, rad: how far the base's target is
# What weighs the tasks where there are no strict priorities.
HAND, BASE, POSTURE = 1.0, 0.1, 1e-3
BASE_FRAME = "base"
HAND_FRAME = "tool"
BASE_JOINTS = slice(0, 3)  # x, y, theta


def planar(x: float, y: float, theta: float) -> Any:
    T = np.eye(4)
    T[:2, :2] = [[np.cos(theta), -np.sin(theta)], [np.sin(theta), np.cos(theta)]]
    T[:2, 3] = x, y
    return T


def middle(arm: Arm) -> Any:
    return 0.5 * (np.array(arm.lower) + np.array(arm.upper))


class Step(Solver):
    """`solve` takes what `ready` made, and answers with a new configuration."""

    @staticmethod
    def can(arm: Arm) -> bool:
        return arm.joints[BASE_JOINTS] == ["x", "y", "theta"]

    def prepare(self, T: Any, q0: Any, rng: np.random.Generator) -> Any:
        return self.ready(q0, T, q0[BASE_JOINTS] + rng.uniform(-BASE_REACH, BASE_REACH, 3))

    def ready(self, q: Any, hand: Any, base: Any) -> Any:
        """The three in the solver's own types."""
        raise NotImplementedError

    def answer(self, result: Any, q0: Any) -> tuple[Any, bool]:
        """From the step's dq."""
        return q0 + result, True
