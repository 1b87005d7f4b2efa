"""thing_kin's plan_path, as its users call it."""

from typing import Any

import thing_kin as tk
from path import RADIUS, Course


def solve(course: Course) -> tuple[Any, bool, int]:
    """Joint values, claim, iterations."""
    plan = tk.plan_path(
        course.robot,
        course.poses,
        seed=course.seed,
        base_path=course.base_path,
        base_radius=RADIUS,
        obstacles=[course.obstacle],
        max_joint_step=course.max_step,
    )
    return plan.q, plan.success, plan.iterations
