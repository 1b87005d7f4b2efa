"""Following a path pose by pose, each iterated until the hand is there."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

import thing_kin as tk

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from thing_kin.demo.wall import WallPath

TOLERANCE = 1e-9  # m and rad: far below what is claimed, far above rounding
MAX_ITERATIONS = 1000
FILTER = (0.05, 10.0)  # sigma0, nu


@dataclass(frozen=True)
class Run:
    """What a scheme did, pose by pose."""

    q: NDArray[np.float64]  #: (N, n), where it ended at each pose
    iterations: NDArray[np.int64]  #: (N,)
    largest_step: NDArray[np.float64]  #: (N,), largest |dq_j| of one iteration
    sigma: NDArray[np.float64]  #: (N,), smallest singular value inverted, before any filter
    step_us: float  #: median time of one step, microseconds


def robust_solver(robot: tk.Chain) -> tk.TaskPriority:
    """Motion scheme (4.18): hand first, base second, singularity-robust."""
    return tk.TaskPriority(
        robot,
        tasks=[tk.PoseTask(), tk.BaseTask()],
        scheme="chiaverini",
        inverse=tk.SelectivelyDamped(),
        singular_value_filter=tk.SingularValueFilter(*FILTER),
    )


def plain_solver(robot: tk.Chain) -> tk.TaskPriority:
    """Build the same tasks by (4.16) with the plain pseudoinverse."""
    return tk.TaskPriority(
        robot, tasks=[tk.PoseTask(), tk.BaseTask()], scheme="nakamura", inverse=tk.Exact()
    )


def follow(
    solver: tk.TaskPriority,
    q: NDArray[np.float64],
    path: WallPath,
    advance: Callable[[], object] = lambda: None,
) -> Run:
    """Follow the path from q; `advance` is called after each pose."""
    ends, logs = [], []
    for hand, base in zip(path.hand, path.base, strict=True):
        q, log = _settle(solver, q, hand, base)
        ends.append(q)
        logs.append(log)
        advance()
    return Run(
        q=np.array(ends),
        iterations=np.array([len(log) for log in logs]),
        largest_step=np.array([log[:, 0].max() for log in logs]),
        sigma=np.array([log[:, 1].min() for log in logs]),
        step_us=float(np.median(np.concatenate(logs)[:, 2])),
    )


def _settle(
    solver: tk.TaskPriority,
    q: NDArray[np.float64],
    hand: NDArray[np.float64],
    base: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Iterate at one pose; returns q and a row an iteration: step, singular value, time."""
    log = []
    for _ in range(MAX_ITERATIONS):
        start = time.perf_counter_ns()
        dq = solver.step(q, [hand, base])
        microseconds = (time.perf_counter_ns() - start) / 1e3
        log.append((np.abs(dq).max(), inverted(solver, q, hand, base).min(), microseconds))
        if not np.isfinite(q + dq).all():  # the plain scheme may go that far: keep the last q
            break
        q = q + dq
        if max(hand_errors(solver.robot, q, hand)) < TOLERANCE:
            break
    return q, np.array(log)


def inverted(
    solver: tk.TaskPriority,
    q: NDArray[np.float64],
    hand: NDArray[np.float64],
    base: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Smallest singular value of the matrix that each level inverts, before any filter."""
    step = solver.solve(q, [hand, base])
    assert isinstance(step, tk.TaskPriorityStep)  # the solver has no limits
    return np.array([sigma[-1] for sigma in step.singular_values])


def hand_errors(
    robot: tk.Chain, q: NDArray[np.float64], hand: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Distance, m, and angle, rad, from the hand to its target; for one pose or for all."""
    error = tk.pose_error(robot.fk(q), hand)
    return np.linalg.norm(error[..., :3], axis=-1), np.linalg.norm(error[..., 3:], axis=-1)
