"""A loop for peers that offer a differential step and leave the rest to their users.

As their examples do it: full steps until the error is small enough. What the examples lack is
added in the peers' favor: a start that makes no progress is given up, and another one is drawn.
"""

from typing import Any

import numpy as np

from inverse import POSITION_TOLERANCE, ROTATION_TOLERANCE, Solver

STARTS = 20
STEPS = 200  # of a start at most
PATIENCE = 15  # steps in which the error has to shrink
PROGRESS = 0.9  # to this part of the best before


class Descent(Solver):
    """Subclasses go to a configuration, tell the error there, and take a step."""

    def go(self, q: Any, T: Any) -> None:
        raise NotImplementedError

    def error(self) -> Any:
        """(6,): position in m, rotation in rad."""
        raise NotImplementedError

    def step(self) -> bool:
        """False where the peer finds none."""
        raise NotImplementedError

    def configuration(self) -> Any:
        """Joint values in the order of the arm."""
        raise NotImplementedError

    def descend(self) -> bool:
        best, patience = np.inf, PATIENCE
        for _ in range(STEPS):
            error = self.error()
            position, rotation = np.linalg.norm(error[:3]), np.linalg.norm(error[3:])
            if position <= POSITION_TOLERANCE and rotation <= ROTATION_TOLERANCE:
                return True
            if position + rotation < PROGRESS * best:
                best, patience = position + rotation, PATIENCE
            patience -= 1
            if patience == 0 or not self.step():
                return False
        return False

    def solve(self, x: Any) -> Any:
        T, q, rng = x
        for _ in range(STARTS):
            self.go(q, T)
            if self.descend():
                return self.configuration(), True
            q = self.arm.random(rng)
        return self.configuration(), False
