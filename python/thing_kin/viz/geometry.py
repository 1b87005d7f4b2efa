"""The robot and its paths, from above, from the side and from the front."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from thing_kin.viz.style import BLUE, GRAY, ORANGE, axes_or_new, figure_of, tidy

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike, NDArray

    from thing_kin import Chain

VIEWS = {"above": (0, 1), "side": (0, 2), "front": (1, 2)}  # the two coordinates that are seen


def stick_figure(robot: Chain, q: ArrayLike) -> NDArray[np.float64]:
    """Points to join for a stick figure: the origins of the frames, from the base to the tool.

    Parameters
    ----------
    robot : Chain
    q : (n,) or (N, n), rad and m

    Returns
    -------
    (F, 3) or (N, F, 3), m

    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> from thing_kin import viz
    >>> robot = tk.robots.thing()
    >>> points = viz.stick_figure(robot, np.zeros(9))
    >>> points[-1].round(4)  # the tool
    array([ 0.5261, -1.1743,  0.6646])
    """
    first = 0 if robot.base_joints is None else robot.frames.index("base")
    points: NDArray[np.float64] = robot.fk_all(q)[..., first:, :3, 3]
    return points


def plot_path(
    hand: ArrayLike, base: ArrayLike | None = None, *, view: str = "above", axes: Axes | None = None
) -> Figure:
    """Paths of the hand and of the base.

    Parameters
    ----------
    hand : (N, 3) or (N, 4, 4), m
        Positions or poses.
    base : (N, 3), optional
        Planar poses (x, y, theta).
    view : 'above', 'side' or 'front'
        Plane xy, xz or yz; seen from the front, y points to the left.
    axes : matplotlib Axes, optional
        Where to draw; default: a new figure.

    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import viz
    >>> hand = np.linspace((1.0, -1.0, 0.5), (1.0, 1.0, 1.5), 50)
    >>> figure = viz.plot_path(hand, view="side")
    >>> figure.axes[0].get_ylabel()
    'z [m]'
    """
    axes = _axes_of_view(view, axes)
    i, j = _plane(view)
    points = np.asarray(hand, dtype=float)
    points = points[:, :3, 3] if points.ndim == 3 else points
    axes.plot(points[:, i], points[:, j], color=BLUE, linewidth=1.6, label="hand", zorder=2.5)
    if base is not None:
        ground = np.asarray(base, dtype=float) * (1.0, 1.0, 0.0)
        axes.plot(*ground[:, [i, j]].T, color=ORANGE, linewidth=2.2, label="base", zorder=2.5)
    return figure_of(axes)


def plot_stick_figures(
    robot: Chain,
    Q: ArrayLike,
    *,
    view: str = "above",
    body: tuple[float, float, float] | None = None,
    axes: Axes | None = None,
) -> Figure:
    """Stick figures of the robot at one or some configurations.

    Parameters
    ----------
    robot : Chain
    Q : (n,) or (N, n), rad and m
    view : 'above', 'side' or 'front'
    body : (length, width, height), m, optional
        Box of the base, centered on its frame and standing on the ground.
    axes : matplotlib Axes, optional
        Where to draw; default: a new figure.

    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import viz
    >>> robot = tk.robots.thing()
    >>> figure = viz.plot_stick_figures(robot, robot.random(3, rng=0), body=(0.96, 0.793, 0.3))
    >>> figure.axes[0].get_xlabel()
    'x [m]'
    """
    axes = _axes_of_view(view, axes)
    i, j = _plane(view)
    for k, q in enumerate(np.atleast_2d(np.asarray(Q, dtype=float))):
        label = "robot" if k == 0 else None
        if body is not None and robot.base_joints is not None:
            outline = _outline(box_corners(robot, q, body)[:, [i, j]], view)
            axes.fill(*outline.T, facecolor="0.93", edgecolor=GRAY, linewidth=0.8, zorder=2)
        points = stick_figure(robot, q)
        axes.plot(points[:, i], points[:, j], color="0.25", linewidth=1.4, label=label, zorder=3)
        axes.plot(points[:, i], points[:, j], "o", color="0.25", markersize=2.6, zorder=3)
    return figure_of(axes)


def box_corners(
    robot: Chain, q: NDArray[np.float64], body: tuple[float, float, float]
) -> NDArray[np.float64]:
    """Corners of the base's box, (8, 3), m: round the ground, then round the top."""
    length, width, height = body
    ground = np.array([(1, 1), (1, -1), (-1, -1), (-1, 1)]) * (length / 2, width / 2)
    corners = np.c_[np.tile(ground, (2, 1)), np.repeat([0.0, height], 4)]
    T = robot.fk(q, frame="base")
    placed: NDArray[np.float64] = corners @ T[:3, :3].T + T[:3, 3]
    return placed


def _outline(corners: NDArray[np.float64], view: str) -> NDArray[np.float64]:
    """Outline of a box as it is seen: from above its rectangle, otherwise its corners' span."""
    if view == "above":
        return corners[:4]
    (left, low), (right, high) = corners.min(axis=0), corners.max(axis=0)
    return np.array([(left, low), (right, low), (right, high), (left, high)])


def _plane(view: str) -> tuple[int, int]:
    if view not in VIEWS:
        raise ValueError(f"view: got {view!r}, expected 'above', 'side' or 'front'")
    return VIEWS[view]


def _axes_of_view(view: str, axes: Axes | None) -> Axes:
    i, j = _plane(view)
    axes = axes_or_new(axes, figsize=(6, 6))
    tidy(axes, title=f"from {'the ' * (view != 'above')}{view}", xlabel=f"{'xyz'[i]} [m]")
    axes.set_ylabel(f"{'xyz'[j]} [m]")
    axes.set_aspect("equal")
    axes.xaxis.set_inverted(view == "front")
    return axes
