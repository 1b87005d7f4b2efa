"""The demo's pictures."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import thing_kin as tk
from thing_kin import viz
from thing_kin.demo import wall
from thing_kin.demo.follow import FILTER, inverted, plain_solver, robust_solver
from thing_kin.demo.report import NEAR_SINGULAR, Outcome
from thing_kin.viz.style import GRAY, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def write_figures(
    outcome: Outcome, out: Path, *, animation: bool, advance: Callable[[], object] = lambda: None
) -> list[str]:
    """Write all pictures into a directory; returns their names."""
    makers: dict[str, Callable[[Outcome], Figure]] = {
        "path.png": path_figure,
        "joints.png": joints_figure,
        "singular_values.png": singular_values_figure,
        "joint_steps.png": joint_steps_figure,
    }
    for name, make in makers.items():
        make(outcome).savefig(out / name, dpi=130)
        advance()
    if not animation:
        return list(makers)
    viz.animate(outcome.robot, outcome.robust.q, out / "wipe.gif", body=wall.BODY)
    advance()
    return [*makers, "wipe.gif"]


def path_figure(outcome: Outcome) -> Figure:
    """Hand, base, wall and some stick figures, from above, from the front and from the side."""
    figure = new_figure(figsize=(11, 7.2))
    grid: dict[str, Any] = figure.subplot_mosaic(
        [["above", "front"], ["above", "side"]], width_ratios=[1.0, 1.35]
    )
    robot, q = outcome.robot, outcome.robust.q
    stretched = int(outcome.robust_measures.sigma_arm.argmin())
    some = q[[len(q) // 12, stretched, -len(q) // 12]]
    for view, axes in grid.items():
        shown = some[[1]] if view == "side" else some
        _wall(axes, view)
        viz.plot_path(robot.fk(q), robot.base_pose(q), view=view, axes=axes)
        viz.plot_stick_figures(robot, shown, view=view, body=wall.BODY, axes=axes)
    grid["side"].set_title("from the side, the arm at its most stretched")
    handles, labels = grid["above"].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, frameon=False)
    return figure


def joints_figure(outcome: Outcome) -> Figure:
    """Joints along the path, with their limits."""
    figure = viz.plot_joints(outcome.robot, outcome.robust.q)
    figure.suptitle("joints along the path, robust scheme (4.18)")
    return figure


def singular_values_figure(outcome: Outcome) -> Figure:
    """Along the robust scheme's path: of the robot, and of what the schemes invert."""
    q, measures = outcome.robust.q, outcome.robust_measures
    figure = new_figure(figsize=(10.5, 7))
    upper, lower = figure.subplots(2, 1, sharex=True)
    robot = {"whole body J": measures.sigma_robot, "arm alone": measures.sigma_arm}
    viz.plot_singular_values(robot, axes=upper)
    upper.axhline(NEAR_SINGULAR, color=GRAY, linestyle=":", label="near singular below")
    upper.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    upper.set(title="smallest singular value of the robot", xlabel="")
    along = list(zip(q, outcome.path.hand, outcome.path.base, strict=True))
    robust, plain = (
        np.array([inverted(make(outcome.robot), *pose) for pose in along])
        for make in (robust_solver, plain_solver)
    )
    matrices = {
        "B, robust (4.18)": robust[:, 1],
        "J, both": robust[:, 0],
        "B N, plain (4.16)": plain[:, 1],
    }
    viz.plot_singular_values(
        matrices, singular_value_filter=tk.SingularValueFilter(*FILTER), axes=lower
    )
    lower.set(title="smallest singular value to be inverted there, without and with the filter")
    return figure


def joint_steps_figure(outcome: Outcome) -> Figure:
    """Show the two schemes' joint steps side by side."""
    near = outcome.robust_measures.sigma_arm < NEAR_SINGULAR
    runs = {
        "robust: (4.18), filtered, selectively damped": outcome.robust.q,
        "plain pseudoinverse: (4.16), exact": outcome.plain.q,
    }
    return viz.plot_joint_steps(
        runs, shade=np.asarray(near), shade_label=f"arm near singular (below {NEAR_SINGULAR})"
    )


def _wall(axes: Axes, view: str) -> None:
    half, low, high = wall.WIDTH / 2, wall.BOTTOM, wall.TOP
    style: dict[str, Any] = {"color": "0.75", "linewidth": 5, "solid_capstyle": "butt"}
    if view == "above":
        axes.plot([wall.WALL + 0.03] * 2, [-half, half], label="wall", **style)
    elif view == "side":
        axes.plot([wall.WALL + 0.03] * 2, [low, high], **style)
    else:
        axes.fill([-half, half, half, -half], [low, low, high, high], color="0.92", zorder=0)
