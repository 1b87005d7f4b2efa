"""The Thing as numbers alone, so that every peer builds its own model of it: [M17] Table A.1."""

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

Joint = Literal["revolute", "prismatic"]
Pose = NDArray[np.float64]
HALF_PI = np.pi / 2


class Row(NamedTuple):
    """One standard Denavit-Hartenberg row; the joint variable adds to theta or to d."""

    d: float
    theta: float
    a: float
    alpha: float
    joint: Joint | None


THING = (
    Row(0.0, HALF_PI, 0.0, HALF_PI, None),
    Row(0.0, HALF_PI, 0.0, HALF_PI, "prismatic"),
    Row(0.0, HALF_PI, 0.0, HALF_PI, "prismatic"),
    Row(0.0, 0.0, 0.0, 0.0, "revolute"),
    Row(0.653, 0.0, 0.27, 0.0, None),
    Row(0.0, HALF_PI, 0.01, 0.0, None),
    Row(0.1273, 0.0, 0.0, HALF_PI, "revolute"),
    Row(0.0, 0.0, -0.612, 0.0, "revolute"),
    Row(0.0, 0.0, -0.5723, 0.0, "revolute"),
    Row(0.163941, 0.0, 0.0, HALF_PI, "revolute"),
    Row(0.1157, 0.0, 0.0, -HALF_PI, "revolute"),
    Row(0.0922, 0.0, 0.0, 0.0, "revolute"),
)


def constant_part(row: Row) -> Pose:
    """[M17] (3.7) at joint value zero; right angles give exact zeros and ones."""
    c, s = np.round([np.cos(row.theta), np.sin(row.theta)], 15)
    ca, sa = np.round([np.cos(row.alpha), np.sin(row.alpha)], 15)
    return np.array(
        [
            [c, -ca * s, sa * s, row.a * c],
            [s, ca * c, -sa * c, row.a * s],
            [0.0, sa, ca, row.d],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


def folded(rows: tuple[Row, ...] = THING) -> tuple[list[tuple[Pose, Joint]], Pose]:
    """Constant rows folded away, so that no peer pays for them.

    Each joint with the constant pose before it, from the root outwards, and the tool's pose in the
    last joint's frame. Joints turn about or slide along z.
    """
    joints: list[tuple[Pose, Joint]] = []
    before = np.eye(4)
    for row in rows:
        if row.joint is not None:
            joints.append((before, row.joint))
            before = np.eye(4)
        before = before @ constant_part(row)
    return joints, before
