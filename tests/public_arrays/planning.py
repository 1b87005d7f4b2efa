"""Paths and trajectories."""

from collections.abc import Callable
from typing import Any

import numpy as np

import thing_kin as tk
from public_arrays.argument import ARM, ROBOT, XI, Argument, Q

TRAJECTORY = tk.Trajectory(
    ["a", "b"], [0.0, 0.5, 2.0], np.arange(6.0).reshape(3, 2), np.zeros((3, 2)), np.zeros((3, 2))
)


def move_with(name: str) -> Callable[[Any], Any]:
    known = {"q0": Q[:6], "q1": Q[:6] + 0.3}
    return lambda value: tk.move_to(ARM, **{**known, name: value}).positions


TIMING = [
    Argument("Trajectory.sample", "t", XI, lambda t: TRAJECTORY.sample(t)[0], moderate=True),
    Argument("move_to", "q0", Q[:6], move_with("q0"), moderate=True),
    Argument("move_to", "q1", Q[:6], move_with("q1"), moderate=True),
    *(
        Argument("move_to", name, np.full(6, 2.0), move_with(name), infinite=True)
        for name in ("velocity_limits", "acceleration_limits", "jerk_limits")
    ),
]
POSES = np.stack([ROBOT.fk(Q), ROBOT.fk(Q)])
BASE_PATH = np.stack([Q[6:], Q[6:]])


def path_with(name: str) -> Callable[[Any], Any]:
    known: dict[str, Any] = {"poses": POSES, "seed": Q, "base_path": BASE_PATH}
    return lambda value: tk.plan_path(ROBOT, **{**known, "max_iterations": 2, name: value}).q


def follower_with(name: str) -> Callable[[Any], Any]:
    def call(value: Any) -> Any:
        known: dict[str, Any] = {"seed": Q, "max_joint_step": 1.0, name: value}
        if name in ("pose", "base"):
            known.pop(name)
        follower = tk.PathFollower(ROBOT, base="xytheta", **known)
        pushed = {"pose": POSES[0], "base": Q[6:]}
        return follower.push(**(pushed | ({name: value} if name in pushed else {})))

    return call


PATH = [
    Argument("plan_path", "poses", POSES, path_with("poses"), moderate=True),
    Argument("Path seed", "seed", Q, path_with("seed"), moderate=True),
    Argument("plan_path", "base_path", BASE_PATH, path_with("base_path"), moderate=True),
    Argument("plan_path", "heading", np.array([-1.0, 1.0]), path_with("heading"), moderate=True),
    Argument("plan_path", "max_joint_step", np.ones(9), path_with("max_joint_step"), infinite=True),
    Argument("plan_path", "joint_weights", np.ones(9), path_with("joint_weights"), moderate=True),
    Argument("plan_path", "jacobian", np.ones(9), path_with("jacobian"), moderate=True),
    Argument("plan_path", "warm_start", np.stack([Q, Q]), path_with("warm_start"), moderate=True),
    Argument("PathFollower", "seed", Q, follower_with("seed"), moderate=True),
    Argument("PathFollower.push", "pose", POSES[0], follower_with("pose"), moderate=True),
    Argument("PathFollower.push", "base", Q[6:], follower_with("base"), moderate=True),
]
