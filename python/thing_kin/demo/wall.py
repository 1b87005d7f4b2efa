"""The job: a wall panel to be wiped in vertical strokes, and where the base drives meanwhile."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from thing_kin import Chain

WALL = 1.05  # m, x of the wall; the base drives along y
WIDTH, BOTTOM, TOP = 3.0, 0.55, 1.75  # m, of the panel
STROKES = 13
# Half-way along, the base stands this much further from the wall, m: there the upper ends of the
# strokes need a stretched arm, and some lie a few millimetres beyond its reach.
STEP_BACK = 0.155
BODY = (0.96, 0.793, 0.296)  # m, of the Ridgeback (Clearpath's data sheet)

# Tool axes when the hand faces the wall: z into the wall (x of the world), y down.
FACING_WALL = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
HOME = np.array([1.3, -0.4, 1.8, 1.7, -1.3, 0.0])  # rad, arm over the base, elbow up


@dataclass(frozen=True)
class WallPath:
    """Targets of the two tasks, pose by pose."""

    hand: NDArray[np.float64]  #: (N, 4, 4)
    base: NDArray[np.float64]  #: (N, 3)
    length: float  #: of the hand's path, m

    def __len__(self) -> int:
        return len(self.hand)


def wall_path(poses: int) -> WallPath:
    """Poses evenly spaced along the strokes, the base going steadily alongside."""
    y = np.repeat(np.linspace(WIDTH / 2, -WIDTH / 2, STROKES), 2)
    z = np.tile([BOTTOM, TOP, TOP, BOTTOM], STROKES)[: 2 * STROKES]
    corner = np.r_[0.0, np.hypot(np.diff(y), np.diff(z)).cumsum()]
    s = np.linspace(0.0, corner[-1], poses)
    hand = np.tile(np.eye(4), (poses, 1, 1))
    hand[:, :3, :3] = FACING_WALL
    hand[:, 0, 3] = WALL
    hand[:, 1, 3] = np.interp(s, corner, y)
    hand[:, 2, 3] = np.interp(s, corner, z)
    u = s / s[-1]
    x_base = -STEP_BACK * np.sin(np.pi * u) ** 2
    base = np.stack([x_base, WIDTH * (0.5 - u), np.zeros(poses)], axis=1)
    return WallPath(hand, base, float(s[-1]))


def beyond_reach(robot: Chain, path: WallPath) -> NDArray[np.float64]:
    """How far the hand's pose is from the reach of an arm on the base's pose, (N,), m.

    Negative: within. By the arm's geometry alone: with z of the tool level, wrist_2 stands d5 above
    or below wrist_1, which is d4 to the side of the plane of upper arm and forearm; these span no
    more than both their lengths.
    """
    at_zero = np.diff(robot.fk_all(np.zeros(robot.n))[:, :3, 3], axis=0)
    link = dict(zip(robot.frames[1:], np.linalg.norm(at_zero, axis=1), strict=True))
    base = np.c_[np.zeros((len(path), robot.n - 3)), path.base]
    shoulder = robot.fk(base, frame="shoulder")[:, :3, 3]
    to_wrist = path.hand[:, :3, 3] - link["tool"] * path.hand[:, :3, 2] - shoulder
    across = np.hypot(to_wrist[:, 0], to_wrist[:, 1])
    in_plane = np.sqrt(np.maximum(across**2 - link["wrist_1"] ** 2, 0.0))
    height = np.abs(np.abs(to_wrist[:, 2]) - link["wrist_2"])  # the nearer of the two wrists
    reach = np.hypot(in_plane, height)
    shortage: NDArray[np.float64] = reach - link["upper_arm"] - link["forearm"]
    return shortage
