"""What is timed: one robot, the same configurations and the same questions for every peer."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

import thing_kin as tk

ONE_CALL = 1024  # different inputs for the works of one call, taken in turn
BATCH = 10_000


@dataclass(frozen=True)
class Work:
    """A question that peers can be asked; `items` answers come from one call."""

    name: str
    title: str
    items: int = 1


WORKS = (
    Work("fk", "forward kinematics, one call, new 4x4"),
    Work("jacobian", "Jacobian, one call"),
    Work("hessian", "Hessian, one call"),
    Work("fk_batch", f"forward kinematics, batch of {BATCH}, per pose", BATCH),
    Work("jacobian_batch", f"Jacobian, batch of {BATCH}, per posture", BATCH),
    Work("pinv", "pseudoinverse of a 6x9 Jacobian, one call"),
    Work("step", "task-priority step (4.18), exact inverse, one call"),
)


class Problem:
    """Inputs of every work, drawn once.

    The Thing with its base first: that is the order in which every peer counts joints from the
    root, so that none has to permute.
    """

    def __init__(self) -> None:
        self.robot = tk.robots.thing(order="base_first")

    @cached_property
    def inputs(self) -> dict[str, list[Any]]:
        q = list(self.robot.random(ONE_CALL, rng=0))
        many = [self.robot.random(BATCH, rng=1)]
        return {
            "fk": q,
            "jacobian": q,
            "hessian": q,
            "fk_batch": many,
            "jacobian_batch": many,
            "pinv": [self.robot.jacobian(x) for x in q],
            "step": [self._step_input(x, np.random.default_rng(i)) for i, x in enumerate(q)],
        }

    def _step_input(self, q: Any, rng: np.random.Generator) -> tuple[Any, Any, Any]:
        """A configuration, and goals a centimeter or a degree or so away."""
        T_goal = self.robot.fk(q + rng.uniform(-0.02, 0.02, self.robot.n))
        return q, T_goal, self.robot.base_pose(q) + rng.uniform(-0.02, 0.02, 3)


def agree(expected: Any, got: Any) -> bool:
    """The checker that every peer has to pass before it is timed."""
    return np.shape(got) == np.shape(expected) and bool(
        np.allclose(got, expected, rtol=1e-9, atol=1e-9)
    )
