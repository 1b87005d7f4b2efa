"""The planners' pictures: the best pose among obstacles, a path around one, and its motion."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import thing_kin as tk
from thing_kin import viz

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SEED = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
WAYPOINTS = 100


def write_plans(out: Path) -> list[str]:
    """Write all pictures into a directory; returns their names. Without toppra one less."""
    makers = {"pose_plan.png": pose_figure, **path_figures()}
    written = []
    for name, make in makers.items():
        try:
            figure = make()
        except ImportError:
            continue
        figure.savefig(out / name, dpi=130)
        written.append(name)
    return written


def pose_figure() -> Figure:
    """Draw the best of all poses with the hand there, [M17] (4.34)."""
    robot = tk.robots.thing()
    T_goal = tk.transform(xyz=(1.2, -0.9, 0.9), rpy=(0.0, np.pi / 2, 0.0))
    given: dict[str, Any] = {
        "base_goal": (0.6, 0.0),
        "base_radius": 0.3,
        "heading": (-np.pi / 4, np.pi / 4),
        "obstacles": [tk.Disc(center=(0.6, 0.6), radius=0.4)],
    }
    plan = tk.plan_pose(robot, T_goal, seed=SEED, search="global", **given)
    figure = viz.plot_plan(robot, plan.q, poses=T_goal, **given)
    figure.suptitle(rf"the best pose, $\sqrt{{\kappa/M}}$ = {plan.objective:.3f}")
    return figure


def path_figures() -> dict[str, Any]:
    """Makers of the pictures of a path of three meters around a disc, and of its motion."""
    robot = tk.robots.thing()
    s = np.linspace(0.0, 1.0, WAYPOINTS)
    poses = np.repeat(robot.fk(SEED)[None], WAYPOINTS, axis=0)
    poses[:, 0, 3] += 3.0 * s
    poses[:, 2, 3] += 0.2 * np.sin(4.0 * np.pi * s)
    base = np.column_stack([3.0 * s, 0.2 * np.sin(np.pi * s), np.zeros_like(s)])
    given: dict[str, Any] = {"base_path": base, "base_radius": 0.3, "max_joint_step": 0.2}
    discs = [tk.Disc(center=(1.5, 0.45), radius=0.5)]
    plan = tk.plan_path(robot, poses, seed=SEED, obstacles=discs, **given)
    plain = tk.plan_path(robot, poses, seed=SEED, method="task_priority", **given)
    runs = {"whole path at once, around the disc": plan.q, "task priority, through it": plain.q}

    def path() -> Figure:
        return viz.plot_plan(
            robot, plan.q, poses=poses, base_goal=base, base_radius=0.3, obstacles=discs
        )

    return {
        "path_plan.png": path,
        "dexterity.png": lambda: viz.plot_dexterity(robot, runs),
        "trajectory.png": lambda: viz.plot_trajectory(robot, plan.timed()),
    }
