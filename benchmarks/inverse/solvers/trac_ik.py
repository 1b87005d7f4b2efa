"""TRAC-IK: KDL's Newton descent with restarts beside an SQP, two threads; who is first, wins.

Its restarts are drawn from the clock: two runs differ.
"""

import importlib
import importlib.util
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from inverse import POSITION_TOLERANCE, Arm, Solver, register


def quaternion(R: Any) -> Any:
    """x, y, z, w; the largest row of 4 q q^T."""
    d = np.diag(R)
    rows = np.empty((4, 4))
    off = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    rows[:3, :3] = R + R.T
    rows[range(3), range(3)] = 1.0 + 2.0 * d - d.sum()
    rows[:3, 3] = rows[3, :3] = off
    rows[3, 3] = 1.0 + d.sum()
    row = rows[np.argmax(np.diag(rows))]
    return row / np.linalg.norm(row)


class TracIk(Solver):
    packages = ("pytracik",)
    milliseconds: ClassVar[int]

    @staticmethod
    def available() -> bool:
        return importlib.util.find_spec("pytracik") is not None

    def __init__(self, arm: Arm) -> None:
        super().__init__(arm)
        self.tracik = module = importlib.import_module("pytracik")
        self.solver = module.TRAC_IK(
            arm.base,
            arm.tip,
            Path(arm.urdf).read_text(),
            self.milliseconds * 1e-3,
            POSITION_TOLERANCE / np.sqrt(3.0),  # it bounds each component
            module.SolveType.Speed,
        )

    def prepare(self, T: Any, q0: Any, rng: np.random.Generator) -> Any:
        return q0, *T[:3, 3].tolist(), *quaternion(T[:3, :3]).tolist()

    def solve(self, x: Any) -> Any:
        return self.tracik.ik(self.solver, *x)

    def answer(self, result: Any, q0: Any) -> tuple[Any, bool]:
        """The first number is KDL's status."""
        return (result[1:], True) if result[0] >= 0 else (None, False)


@register
class TracIk5(TracIk):
    name, title, milliseconds = "trac_ik_5", "TRAC-IK, 5 ms", 5
    note = "Speed, its default timeout of 5 ms, 1e-5 / sqrt(3) a component"


@register
class TracIk50(TracIk):
    name, title, milliseconds = "trac_ik_50", "TRAC-IK, 50 ms", 50
    note = "the same with a timeout of 50 ms"
