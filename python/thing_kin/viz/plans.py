"""Plans from above with what they keep to, their dexterity, and motions beside their limits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import cycle
from typing import TYPE_CHECKING, Any

import numpy as np

from thing_kin.viz.geometry import stick_figure
from thing_kin.viz.style import (
    BLACK,
    BLUE,
    CYCLE,
    GRAY,
    GREEN,
    ORANGE,
    RED,
    axes_or_new,
    figure_of,
    new_figure,
    tidy,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike, NDArray

    from thing_kin import Chain, Trajectory

PALE = "#D5EEE5"  # of GREEN
ARROW = 0.25  # m: how long the robot's heading is drawn
MOST_FIGURES = 7
WIDE = 5.0  # from where values are drawn on a log scale


def plot_plan(
    robot: Chain,
    q: ArrayLike,
    *,
    poses: ArrayLike | None = None,
    base_goal: ArrayLike | None = None,
    base_radius: float | None = None,
    heading: Sequence[float] | None = None,
    obstacles: Sequence[Any] = (),
    axes: Axes | None = None,
) -> Figure:
    """Draw a whole-body pose or path from above, with what it was to keep to.

    Parameters
    ----------
    robot : Chain
        With an omnidirectional base.
    q : (n,) or (N, n), rad and m
        Of a PosePlan or a PathPlan.
    poses : (4, 4) or (N, 4, 4), optional
        Where the hand was to be.
    base_goal : (2,), (N, 2) or (N, 3), optional
        Middle of the base's disc, or the path of it.
    base_radius : float, m, optional
    heading : (2,), rad, optional
        The window of the base's heading.
    obstacles : sequence of Disc
        Others are not drawn.
    axes : matplotlib Axes, optional
        Where to draw; default: a new figure.

    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> from thing_kin import viz
    >>> robot = tk.robots.thing()
    >>> disc = tk.Disc(center=(0.6, 0.6), radius=0.4)
    >>> q = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
    >>> figure = viz.plot_plan(robot, q, base_goal=(0.1, 0.0), base_radius=0.3, obstacles=[disc])
    >>> figure.axes[0].get_xlabel()
    'x [m]'
    """
    axes = axes_or_new(axes, figsize=(9, 6))
    Q = np.atleast_2d(np.asarray(q, dtype=float))
    _draw_discs(axes, obstacles)
    if base_goal is not None:
        _draw_base_goal(axes, np.atleast_2d(np.asarray(base_goal, dtype=float)), base_radius)
    base = np.atleast_2d(robot.base_pose(Q))
    if heading is not None:
        _draw_heading(axes, base[-1], heading)
    if poses is not None:
        goal = np.asarray(poses, dtype=float).reshape(-1, 4, 4)[:, :2, 3]
        style = "x" if len(goal) == 1 else ":"
        axes.plot(*goal.T, style, color=BLACK, markersize=9, label="hand, as asked", zorder=4)
    _draw_robot(axes, robot, Q, base)
    tidy(axes, xlabel="x [m]", ylabel="y [m]")
    axes.set_aspect("equal", adjustable="datalim")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    return figure_of(axes)


def plot_dexterity(
    robot: Chain, runs: Mapping[str, ArrayLike], *, axes: Axes | None = None
) -> Figure:
    """Compare sqrt(kappa/M), [M17] (4.33), along paths; small is good.

    Parameters
    ----------
    robot : Chain
    runs : mapping of names to (N, n), rad and m
    axes : matplotlib Axes, optional
        Where to draw; default: a new figure.

    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import viz
    >>> robot = tk.robots.thing()
    >>> figure = viz.plot_dexterity(robot, {"some": robot.random(20, rng=0)})
    >>> figure.axes[0].get_xlabel()
    'waypoint'
    """
    axes = axes_or_new(axes, figsize=(9, 4))
    values = [np.atleast_1d(robot.dexterity(np.asarray(Q, dtype=float))) for Q in runs.values()]
    for name, value, color in zip(runs, values, cycle(CYCLE), strict=False):
        axes.plot(value, color=color, linewidth=1.6, label=f"{name}, mean {value.mean():.2f}")
    if max(value.max() for value in values) > WIDE * min(value.min() for value in values):
        axes.set_yscale("log")
    tidy(axes, xlabel="waypoint", ylabel=r"$\sqrt{\kappa/M}$")
    axes.legend(frameon=False)
    return figure_of(axes)


def plot_trajectory(
    robot: Chain,
    trajectory: Trajectory,
    *,
    velocity_limits: ArrayLike | None = None,
    acceleration_limits: ArrayLike | None = None,
) -> Figure:
    """Draw a motion over time: positions, and rates as shares of their limits.

    Parameters
    ----------
    robot : Chain
    trajectory : Trajectory
    velocity_limits, acceleration_limits : (n,), optional
        Per s and s^2; default: the robot's. Joints without a limit have no share.

    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import viz
    >>> robot = tk.robots.ur5()
    >>> figure = viz.plot_trajectory(robot, tk.move_to(robot, [0.0] * 6, [1.0] * 6))
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['position [rad]', 'velocity / limit', 'acceleration / limit']
    """
    t = np.linspace(0.0, trajectory.duration, 2000)
    q, qd, qdd = trajectory.sample(t)
    rates = (
        (qd, robot.velocity_limits if velocity_limits is None else velocity_limits),
        (qdd, robot.acceleration_limits if acceleration_limits is None else acceleration_limits),
    )
    figure = new_figure(figsize=(9, 8))
    panels = figure.subplots(3, 1, sharex=True)
    slides = "prismatic" in robot.joint_types
    names = ("position [rad, m]" if slides else "position [rad]", "velocity", "acceleration")
    shares = [value / np.asarray(limit, dtype=float) for value, limit in rates]
    for axes, values, name in zip(panels, (q, *shares), names, strict=True):
        for joint, color in zip(range(robot.n), cycle(CYCLE), strict=False):
            dash = "-" if joint < len(CYCLE) else "--"
            label = robot.names[joint]
            axes.plot(t, values[:, joint], dash, color=color, linewidth=1.2, label=label)
        tidy(axes, ylabel=name)
    for axes, name in zip(panels[1:], names[1:], strict=True):
        axes.set_ylabel(f"{name} / limit")
        axes.set_ylim(-1.15, 1.15)
        for bound in (-1.0, 1.0):
            axes.axhline(bound, color=BLACK, linestyle=":", linewidth=1.2)
    panels[0].legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    panels[-1].set_xlabel("time [s]")
    return figure


def _draw_discs(axes: Axes, obstacles: Sequence[Any]) -> None:
    from matplotlib.patches import Circle

    label: str | None = "keep out"
    for disc in obstacles:
        if hasattr(disc, "center") and len(disc.center) == 2:
            style: dict[str, Any] = {"facecolor": RED, "alpha": 0.25, "hatch": "//", "label": label}
            axes.add_patch(Circle(tuple(disc.center), disc.radius, edgecolor=RED, **style))
            axes.update_datalim([np.array(disc.center) + s * disc.radius for s in (-1.0, 1.0)])
            label = None


def _draw_base_goal(axes: Axes, goal: NDArray[np.float64], radius: float | None) -> None:
    from matplotlib.patches import Circle

    if len(goal) > 1:
        axes.plot(*goal[:, :2].T, "--", color=GREEN, linewidth=1.4, label="base, as asked")
    else:
        axes.plot(*goal[:, :2].T, "+", color=GREEN, markersize=10)
    if radius is None:
        return
    for k, (x, y) in enumerate(goal[:, :2]):  # opaque: many of them look like one band
        label = "base's disc" if k == 0 else None
        axes.add_patch(Circle((x, y), radius, color=PALE, linewidth=0, label=label, zorder=0.6))
        axes.update_datalim([(x - radius, y - radius), (x + radius, y + radius)])


def _draw_heading(axes: Axes, base: NDArray[np.float64], heading: Sequence[float]) -> None:
    from matplotlib.patches import Wedge

    low, high = np.degrees(heading[0]), np.degrees(heading[1])
    wedge = Wedge(tuple(base[:2]), 1.5 * ARROW, low, high, color=BLUE, alpha=0.2, linewidth=0)
    wedge.set_label("heading's window")
    axes.add_patch(wedge)


def _draw_robot(
    axes: Axes, robot: Chain, Q: NDArray[np.float64], base: NDArray[np.float64]
) -> None:
    points = stick_figure(robot, Q)
    if len(Q) > 1:
        axes.plot(*base[:, :2].T, color=ORANGE, linewidth=2.2, label="base", zorder=3)
        axes.plot(*points[:, -1, :2].T, color=BLUE, linewidth=1.8, label="hand", zorder=3)
    for k in np.unique(np.linspace(0, len(Q) - 1, MOST_FIGURES).astype(int)):
        label = "arm" if k == 0 else None
        axes.plot(*points[k, :, :2].T, "-o", color=GRAY, markersize=3, linewidth=1.2, label=label)
        x, y, theta = base[k]
        tip = (x + ARROW * np.cos(theta), y + ARROW * np.sin(theta))
        arrow = {"arrowstyle": "-|>", "color": ORANGE, "linewidth": 1.6}
        axes.annotate("", xy=tip, xytext=(x, y), arrowprops=arrow, zorder=4)
        axes.plot(*points[k, -1, :2], "o", color=BLUE, markersize=5, zorder=4)
        axes.plot(x, y, "s", color=ORANGE, markersize=6, zorder=4)
