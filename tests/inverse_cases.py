"""The Thing's tasks, postures and solvers that the task-priority tests share."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

import thing_kin as tk
from inverse_oracles import Level

Vector = NDArray[np.float64]

ROBOT = tk.robots.thing()
SCHEMES = ("nakamura", "siciliano", "chiaverini")
INVERSES = {
    "exact": tk.Exact(),
    "damped": tk.Damped(1e-3),
    "selective": tk.SelectivelyDamped(0.5),
}
FILTERS = {"plain": None, "filtered": tk.SingularValueFilter(0.01, 10.0)}

HOME = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.3, -0.2, 0.4])
RANDOM_POSTURES = ROBOT.random(12, rng=5)


def posture(**joints: float) -> Vector:
    q = HOME.copy()
    for name, value in joints.items():
        q[ROBOT.names.index(name)] = value
    return q


# The arm is singular with the wrist (q4) or the elbow (q2) straight; `zero` has both.
SINGULAR_POSTURES = {
    **{f"wrist {x:g}": posture(q4=x) for x in (0.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15)},
    **{f"elbow {x:g}": posture(q2=x) for x in (0.0, 1e-3, 1e-6, 1e-9, 1e-12)},
    "both nearly": posture(q2=1e-5, q4=1e-7),
    "both": posture(q2=0.0, q4=0.0),
    "zero": np.zeros(9),
}

TWO_TASKS = (tk.PoseTask(gain=0.8), tk.BaseTask(gain=0.5))
THREE_TASKS = (tk.PositionTask(), tk.BaseTask(gain=0.5), tk.OrientationTask(gain=0.7))
OVERFULL_TASKS = (tk.PoseTask(), tk.BaseTask(), tk.PostureTask(gain=0.1))


def target_of(task: tk.Task, q: Vector) -> Vector:
    """Where q puts the task."""
    T = ROBOT.fk(q, frame=task.of)
    if isinstance(task, tk.PostureTask):
        return q
    if isinstance(task, tk.BaseTask):
        return q[6:]
    if isinstance(task, tk.PositionTask):
        return T[:3, 3]
    return T[:3, :3] if isinstance(task, tk.OrientationTask) else T


def targets(tasks: Sequence[tk.Task], q: Vector, seed: int = 0, distance: float = 0.4) -> list:
    """Targets that contradict each other: each task's is met by a posture of its own."""
    rng = np.random.default_rng(seed)
    return [target_of(task, q + distance * rng.uniform(-1, 1, 9)) for task in tasks]


def jacobian_of(task: tk.Task, q: Vector) -> NDArray[np.float64]:
    J = ROBOT.jacobian(q, of=task.of)
    if isinstance(task, tk.PostureTask):
        return np.eye(9)
    if isinstance(task, tk.BaseTask):
        return np.eye(9)[6:]
    if isinstance(task, tk.PositionTask):
        return J[:3]
    return J[3:] if isinstance(task, tk.OrientationTask) else J


def error_of(task: tk.Task, q: Vector, target: Vector) -> Vector:
    if isinstance(task, tk.PostureTask | tk.BaseTask):
        return target - target_of(task, q)  # no case here is half a turn away
    T = ROBOT.fk(q, frame=task.of)
    T_goal = T.copy()
    part = {tk.PositionTask: np.s_[:3, 3], tk.OrientationTask: np.s_[:3, :3]}
    T_goal[part.get(type(task), np.s_[:, :])] = target
    rows = {tk.PositionTask: np.s_[:3], tk.OrientationTask: np.s_[3:]}
    return tk.pose_error(T, T_goal)[rows.get(type(task), np.s_[:])]


def level_of(task: tk.Task, q: Vector, target: Vector) -> Level:
    J = jacobian_of(task, q)
    blocks = [3, 3] if isinstance(task, tk.PoseTask) else [len(J)]
    return Level(J, task.gain * error_of(task, q, target), blocks)
