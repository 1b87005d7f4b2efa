"""Numbers of a run, worked out anew from its configurations and not taken from the solver."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from thing_kin.demo.follow import TOLERANCE, Run, hand_errors

if TYPE_CHECKING:
    from numpy.typing import NDArray

    import thing_kin as tk
    from thing_kin.demo.wall import WallPath


@dataclass(frozen=True)
class Measures:
    """Of one run, pose by pose."""

    position_error: NDArray[np.float64]  #: (N,), m
    rotation_error: NDArray[np.float64]  #: (N,), rad
    tilt: NDArray[np.float64]  #: (N,), rad, between the hand's z axis and the wall's normal
    base_error: NDArray[np.float64]  #: (N,), m, the base's distance from its path
    joint_step: NDArray[np.float64]  #: (N - 1,), largest joint step to the next pose, rad or m
    margin: NDArray[np.float64]  #: (n,), least distance to a joint limit; negative: crossed
    sigma_arm: NDArray[np.float64]  #: (N,), smallest singular value of the arm's columns of J
    sigma_robot: NDArray[np.float64]  #: (N,), of the whole J

    @property
    def arrived(self) -> NDArray[np.bool_]:
        """At which poses the hand was brought within the tolerance."""
        return (self.position_error < TOLERANCE) & (self.rotation_error < TOLERANCE)


def measure(solver: tk.TaskPriority, run: Run, path: WallPath) -> Measures:
    """Measure a run."""
    robot, q = solver.robot, run.q
    position_error, rotation_error = hand_errors(robot, q, path.hand)
    J = robot.jacobian(q)
    arm = [j for j in range(robot.n) if j not in (robot.base_joints or ())]
    hand_z = robot.fk(q)[:, :3, 2]
    return Measures(
        position_error=position_error,
        rotation_error=rotation_error,
        tilt=np.arctan2(np.hypot(hand_z[:, 1], hand_z[:, 2]), hand_z[:, 0]),
        base_error=np.hypot(*(robot.base_pose(q) - path.base)[:, :2].T),
        joint_step=np.abs(np.diff(q, axis=0)).max(axis=1),
        margin=np.minimum(q - robot.lower, robot.upper - q).min(axis=0),
        sigma_arm=_smallest_singular_value(J[:, :, arm]),
        sigma_robot=_smallest_singular_value(J),
    )


def _smallest_singular_value(J: NDArray[np.float64]) -> NDArray[np.float64]:
    sigma: NDArray[np.float64] = np.linalg.svd(J, compute_uv=False)[:, -1].astype(np.float64)
    return sigma
