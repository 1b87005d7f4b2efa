"""Instances of problem (4.34) that have a solution, and what a solution must be."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import thing_kin as tk
from oracles import dh_fk_all
from test_robots import TABLE_A_1

Array = NDArray[np.float64]


@dataclass(frozen=True)
class PoseCase:
    """A configuration was drawn first: its hand is the target, and it keeps all constraints."""

    robot: tk.Chain
    T_goal: Array
    drawn: Array
    near: Array
    far: Array
    options: dict[str, Any]

    def solve(self, seed: Array, **extra: Any) -> tk.PosePlan:
        return tk.plan_pose(self.robot, self.T_goal, seed=seed, **{**self.options, **extra})


def with_arm_limits(robot: tk.Chain, limit: float) -> tk.Chain:
    lower, upper = robot.lower.copy(), robot.upper.copy()
    lower[:6], upper[:6] = -limit, limit
    lower[6:], upper[6:] = -20.0, 20.0  # the world may be moved
    return robot.with_limits(lower=lower, upper=upper)


def draw(rng: np.random.Generator, limit: float = 2 * np.pi) -> PoseCase:
    robot = with_arm_limits(tk.robots.thing(), limit)
    q = np.concatenate(
        [rng.uniform(-limit, limit, 6), rng.uniform(-2, 2, 2), rng.uniform(-3, 3, 1)]
    )

    def beside(most: float, least: float = 0.0) -> Array:
        angle, distance = rng.uniform(-np.pi, np.pi), rng.uniform(least, most)
        return q[6:8] + distance * np.array([np.cos(angle), np.sin(angle)])

    radius, keep_out, width = rng.uniform(0.2, 0.6), rng.uniform(0.1, 0.5), rng.uniform(0.2, 1.2)
    middle = q[8] + rng.uniform(-width, width)
    options = {
        "base_goal": beside(radius),
        "base_radius": radius,
        "heading": (middle - width, middle + width),
        "obstacles": [tk.Disc(center=beside(keep_out + 0.5, keep_out), radius=keep_out)],
    }
    far = np.concatenate([rng.uniform(-limit, limit, 6), options["base_goal"], [0.0]])
    far[6:] += rng.uniform(-1, 1, 3)
    return PoseCase(robot, robot.fk(q), q, q + rng.uniform(-0.1, 0.1, 9), far, options)


def violation(case: PoseCase, q: Array) -> float:
    """The largest of all, m or rad, without the library's kinematics."""
    T = dh_fk_all(TABLE_A_1, q[[6, 7, 8, 0, 1, 2, 3, 4, 5]])[-1]
    turned = (T[:3, :3].T @ case.T_goal[:3, :3] - np.eye(3)) / np.sqrt(2.0)
    (disc,) = case.options["obstacles"]
    low, high = case.options["heading"]
    return max(
        float(np.linalg.norm(T[:3, 3] - case.T_goal[:3, 3])),
        float(np.linalg.norm(turned)),
        float(np.linalg.norm(q[6:8] - case.options["base_goal"])) - case.options["base_radius"],
        disc.radius - float(np.linalg.norm(q[6:8] - disc.center)),
        low - float(q[8]),
        float(q[8]) - high,
        float(np.max(case.robot.lower - q)),
        float(np.max(q - case.robot.upper)),
    )


def objective(robot: tk.Chain, q: Array) -> float:
    """sqrt(kappa/M) by numpy's singular values."""
    s = np.linalg.svd(robot.jacobian(q), compute_uv=False)
    return float(np.sqrt(s[0] / s[-1] / np.prod(s)))
