"""The whole-body path of user script 05, in N waypoints: what plan_path and its peer minimize.

    sum_k |q[k+1] - q[k]|^2 / 2 + 1/N^2 sum_k log sqrt(kappa/M)(q[k])

subject to every pose, the base within 0.3 m of its path and outside a disc, joint limits and steps
of at most 20/N a joint. plan_path also keeps the straight lines between waypoints out of the disc,
the peer seven points of each.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

import thing_kin as tk

SEED = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
LENGTH, RADIUS = 3.0, 0.3  # m


@dataclass(frozen=True)
class Course:
    robot: tk.Chain
    poses: Any  # (N, 4, 4)
    base_path: Any  # (N, 3)
    obstacle: tk.Disc
    seed: Any
    max_step: float
    dexterity_weight: float

    def objective(self, q: Any) -> float:
        steps = 0.5 * float((np.diff(q, axis=0) ** 2).sum())
        return steps + self.dexterity_weight * float(np.log(self.robot.dexterity(q)).sum())

    def violation(self, q: Any) -> float:
        """The largest of all, m and rad, at waypoints and on 20 points of the lines between."""
        u = np.linspace(0.0, 1.0, 20)[:, None, None]
        between = ((1.0 - u) * q[:-1] + u * q[1:])[..., 6:8]
        outside = np.hypot(*np.moveaxis(between - self.obstacle.center, -1, 0))
        error = tk.pose_error(self.robot.fk(q), self.poses)
        return max(
            float(np.abs(error).max()),
            float((self.robot.lower - q).max()),
            float((q - self.robot.upper).max()),
            float(np.abs(np.diff(q, axis=0)).max() - self.max_step),
            float(np.hypot(*(q[:, 6:8] - self.base_path[:, :2]).T).max() - RADIUS),
            float(self.obstacle.radius - outside.min()),
        )


def course(count: int) -> Course:
    robot = tk.robots.thing()
    s = np.linspace(0.0, 1.0, count)
    poses = np.repeat(robot.fk(SEED)[None], count, axis=0)
    poses[:, 0, 3] += LENGTH * s
    poses[:, 2, 3] += 0.2 * np.sin(4 * np.pi * s)
    base = np.column_stack([LENGTH * s, 0.2 * np.sin(np.pi * s), np.zeros_like(s)])
    disc = tk.Disc(center=(1.5, 0.45), radius=0.5)
    return Course(robot, poses, base, disc, SEED, 20.0 / count, 1.0 / count**2)
