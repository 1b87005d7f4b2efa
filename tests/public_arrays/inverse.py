"""Task priority with and without limits, inverse kinematics."""

from collections.abc import Callable
from typing import Any

import numpy as np

import thing_kin as tk
from public_arrays.argument import ARM, ROBOT, XI, Argument, Q, T

SOLVER = tk.TaskPriority(
    ROBOT,
    [
        tk.PoseTask(),
        tk.BaseTask(),
        tk.PositionTask(of="wrist_1"),
        tk.OrientationTask(),
        tk.PostureTask(),
    ],
)
TARGETS = [T, Q[6:], T[:3, 3], T[:3, :3], Q]
WITHIN = tk.TaskPriority(
    ROBOT,
    [
        tk.BaseObstacleTask(0.5),
        tk.DistanceTask(0.1, 2.0),
        tk.FieldOfViewTask(0.5),
        tk.JointRangeTask(np.full(9, -2.0), np.full(9, 2.0)),
        tk.PoseTask(),
    ],
    limits=True,
    dt=0.01,
)
WITHIN_TARGETS = [Q[6:8], T[:3, 3], T[:3, 3], None, T]


def with_target(i: int) -> Callable[[Any], Any]:
    def call(value: Any) -> Any:
        return SOLVER.step(Q, [value if k == i else target for k, target in enumerate(TARGETS)])

    return call


def within_target(i: int) -> Callable[[Any], Any]:
    def call(value: Any) -> Any:
        goals = [value if k == i else goal for k, goal in enumerate(WITHIN_TARGETS)]
        return WITHIN.step(Q, goals)

    return call


def ranged(name: str) -> Callable[[Any], Any]:
    bounds = {"lower": np.full(9, -np.inf), "upper": np.full(9, np.inf)}
    return lambda value: getattr(tk.JointRangeTask(**{**bounds, name: value}), name)


TASK_PRIORITY = [
    Argument("step", "q", Q, lambda v: SOLVER.step(v, TARGETS), moderate=True),
    Argument("solve", "q", Q, lambda v: SOLVER.solve(v, TARGETS).dq, moderate=True),
    Argument("step", "null_motion", Q, lambda v: SOLVER.step(Q, TARGETS, v)),
    *(
        Argument("step", f"targets[{i}]", good, with_target(i), moderate=True)
        for i, good in enumerate(TARGETS)
    ),
    Argument(
        "TaskPriority",
        "step_limit",
        np.full(9, 0.1),
        lambda v: tk.TaskPriority(ROBOT, [tk.PoseTask()], step_limit=v).step(Q, [T]),
        infinite=True,
    ),
]
LIMITS = [
    Argument("limited step", "q", Q, lambda v: WITHIN.step(v, WITHIN_TARGETS), moderate=True),
    Argument("limited solve", "q", Q, lambda v: WITHIN.solve(v, WITHIN_TARGETS).dq, moderate=True),
    Argument("limited step", "null_motion", Q, lambda v: WITHIN.step(Q, WITHIN_TARGETS, v)),
    Argument(
        "limited step",
        "previous",
        0.001 * Q,
        lambda v: WITHIN.step(Q, WITHIN_TARGETS, previous=v),
    ),
    *(
        Argument("limited step", f"targets[{i}]", good, within_target(i), moderate=True)
        for i, good in enumerate(WITHIN_TARGETS)
        if good is not None
    ),
    *(
        Argument("JointRangeTask", name, Q, ranged(name), infinite=True)
        for name in ("lower", "upper")
    ),
    Argument("FieldOfViewTask", "axis", XI[:3], lambda v: tk.FieldOfViewTask(0.3, v).axis),
]


def ik_with(name: str, **others: Any) -> Callable[[Any], Any]:
    return lambda value: tk.ik(ARM, **{"target": T, **others, name: value}).q


def ik_target(task: str) -> Callable[[Any], Any]:
    return lambda value: tk.ik(ARM, value, task=task).q


IK = [
    Argument("ik", "target", T, ik_target("pose")),
    Argument("ik position", "target", T[:3, 3], ik_target("position")),
    Argument("ik orientation", "target", T[:3, :3], ik_target("orientation")),
    Argument("ik", "seed", Q[:6], ik_with("seed"), moderate=True),
    Argument("ik", "weights", np.ones(6), ik_with("weights")),
    Argument("ik", "joint_weights", np.full(6, 2.0), ik_with("joint_weights")),
    Argument("ik", "max_step", np.full(6, 0.5), ik_with("max_step", seed=Q[:6]), infinite=True),
]
CLOSED_FORM = [
    Argument("ik_all", "target", T, lambda v: tk.ik_all(ARM, v).q, moderate=True),
    Argument("ik_all", "seed", Q[:6], lambda v: tk.ik_all(ARM, T, seed=v).q, moderate=True),
    Argument(
        "ik_all",
        "weights",
        np.ones(6),
        lambda v: tk.ik_all(ARM, T, seed=Q[:6], weights=v).q,
        moderate=True,
    ),
    Argument(
        "ik_all",
        "base",
        Q[6:],
        lambda v: tk.ik_all(ROBOT, T, base=v, respect_limits=False).q,
        moderate=True,
    ),
]
