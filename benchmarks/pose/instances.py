"""Random instances of (4.34) that have a solution: the one that each is drawn around."""

from dataclasses import replace
from typing import Any

import numpy as np

import thing_kin as tk
from pose import Instance

ARM_LIMITS = {"2pi": 2 * np.pi, "pi": np.pi}
STARTS = ("near", "far")
NEAR = 0.1  # rad and m, standard deviation of a near start from the drawn solution


def robot_with(arm_limit: float) -> tk.Chain:
    robot = tk.robots.thing()
    lower, upper = np.array(robot.lower), np.array(robot.upper)
    lower[:6], upper[:6] = -arm_limit, arm_limit
    return robot.with_limits(lower=lower, upper=upper)


def around(robot: tk.Chain, q: Any, rng: np.random.Generator) -> Instance:
    """Discs and heading window that q keeps, by at least 5 cm and 0.1 rad."""
    radius = rng.uniform(0.2, 0.6)
    angle, far = rng.uniform(-np.pi, np.pi), radius * np.sqrt(rng.uniform(0.0, 0.8))
    goal = q[6:8] - far * np.array([np.cos(angle), np.sin(angle)])
    keep_out = rng.uniform(0.1, 0.4)
    direction, gap = rng.uniform(-np.pi, np.pi), rng.uniform(0.05, 0.3)
    center = q[6:8] + (keep_out + gap) * np.array([np.cos(direction), np.sin(direction)])
    window = rng.uniform([-0.8, 0.1], [-0.1, 0.8]) + q[8]
    return Instance(
        robot=robot,
        T=robot.fk(q),
        goal=(float(goal[0]), float(goal[1])),
        radius=float(radius),
        obstacle=tk.Disc(center=(float(center[0]), float(center[1])), radius=float(keep_out)),
        heading=(float(window[0]), float(window[1])),
        seed=q,
    )


def draw(count: int, arm_limits: str, start: str, seed: int) -> list[Instance]:
    """The same poses and constraints for both starts."""
    robot = robot_with(ARM_LIMITS[arm_limits])
    rng = np.random.default_rng(seed)
    starts = np.random.default_rng([seed, STARTS.index(start)])
    found = []
    for _ in range(count):
        arm = rng.uniform(-ARM_LIMITS[arm_limits], ARM_LIMITS[arm_limits], 6)
        q = np.concatenate([arm, rng.uniform(-1.0, 1.0, 2), rng.uniform(-2.0, 2.0, 1)])
        instance = around(robot, q, rng)
        found.append(replace(instance, seed=begin(instance, q, start, starts)))
    return found


def begin(instance: Instance, q: Any, start: str, rng: np.random.Generator) -> Any:
    """Near the drawn solution; or any arm, the base in its disc and the heading in its window."""
    if start == "near":
        q = q + rng.normal(0.0, NEAR, 9)
    else:
        angle, far = rng.uniform(-np.pi, np.pi), instance.radius * np.sqrt(rng.uniform())
        base = np.array(instance.goal) + far * np.array([np.cos(angle), np.sin(angle)])
        q = np.concatenate([rng.uniform(instance.lower[:6], instance.upper[:6]), base, q[8:]])
        q[8] = rng.uniform(*instance.heading)
    return np.clip(q, instance.lower, instance.upper)
