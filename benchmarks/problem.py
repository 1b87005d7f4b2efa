"""What is timed: one robot, the same configurations and the same questions for every peer."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

import thing_kin as tk

ONE_CALL = 1024  # different inputs for the works of one call, taken in turn
BATCH = 10_000  # rows of a batch; its figures are per row


@dataclass(frozen=True)
class Work:
    """A question that peers can be asked; `items` answers come from one call."""

    name: str
    title: str
    items: int = 1


WORKS = (
    Work("fk", "forward kinematics, one call, new 4x4"),
    Work("jacobian", "Jacobian, one call"),
    Work("fk_and_jacobian", "pose and Jacobian, one call"),
    Work("hessian", "Hessian, one call"),
    Work("jacobian_dot", "time derivative of the Jacobian, one call"),
    Work("acceleration", "classical acceleration, one call"),
    Work("fk_batch", "forward kinematics, batch", BATCH),
    Work("fk_batch_out", "forward kinematics, batch, out=", BATCH),
    Work("fk_quaternion_batch", "position and quaternion, batch", BATCH),
    Work("jacobian_batch", "Jacobian, batch", BATCH),
    Work("fk_and_jacobian_batch", "pose and Jacobian, batch", BATCH),
    Work("hessian_batch", "Hessian, batch", BATCH),
    Work("pinv", "pseudoinverse of a 6x9 Jacobian, one call"),
    Work("step", "task-priority step (4.18), exact, one call"),
)
IMPORT = Work("import", "import, beyond numpy")


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
        qd, qdd = np.random.default_rng(2).uniform(-1.0, 1.0, (2, ONE_CALL, self.robot.n))
        special: dict[str, list[Any]] = {
            "jacobian_dot": list(zip(q, qd, strict=True)),
            "acceleration": list(zip(q, qd, qdd, strict=True)),
            "pinv": [self.robot.jacobian(x) for x in q],
            "step": [self._step_input(x, np.random.default_rng(i)) for i, x in enumerate(q)],
        }
        many = [self.robot.random(BATCH, rng=1)]
        plain = {w.name: many if w.items > 1 else q for w in WORKS if w.name not in special}
        return plain | special

    def _step_input(self, q: Any, rng: np.random.Generator) -> tuple[Any, Any, Any]:
        """A configuration, and goals a centimeter or a degree or so away."""
        T_goal = self.robot.fk(q + rng.uniform(-0.02, 0.02, self.robot.n))
        return q, T_goal, self.robot.base_pose(q) + rng.uniform(-0.02, 0.02, 3)


def agree(expected: Any, got: Any) -> bool:
    """The checker that every peer has to pass before it is timed."""
    if isinstance(expected, tuple):
        return len(expected) == len(got) and all(map(agree, expected, got))
    return np.shape(got) == np.shape(expected) and bool(
        np.allclose(got, expected, rtol=1e-9, atol=1e-9)
    )
