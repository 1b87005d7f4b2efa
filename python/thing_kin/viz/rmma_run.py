"""The artifact's arrangements, and one run of the experiment, from above."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle
from typing import TYPE_CHECKING, Any

import numpy as np

from thing_kin.viz.style import (
    BLACK,
    BLUE,
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
    from numpy.typing import NDArray

    from thing_kin.rmma import Arrangement
    from thing_kin.rmma.traces import SearchTrace, SideTrace, Trace

    Array = NDArray[np.float64]

BODY = (0.70, 0.50)  # m: length and width of the Pioneer LX, rounded
SIDE_COLORS = (BLUE, ORANGE, GREEN, RED)
PANELS_IN_A_ROW = 7


def plot_rmma_arrangements(arrangements: Sequence[Arrangement] | None = None) -> Figure:
    """Fiducials of arrangements from above, side by side, [X21] figures 4.9 to 4.11.

    Parameters
    ----------
    arrangements : sequence of rmma.Arrangement, optional
        Default: the thesis's three.

    Examples
    --------
    >>> from thing_kin import viz
    >>> len(viz.plot_rmma_arrangements().axes)
    3
    """
    from thing_kin.rmma.arrangement import ARRANGEMENTS  # not with the module: brings the core

    shown = list(ARRANGEMENTS.values()) if arrangements is None else list(arrangements)
    figure = new_figure(figsize=(4.6 * len(shown), 3.6))
    for axes, arrangement in zip(
        figure.subplots(1, len(shown), squeeze=False)[0], shown, strict=True
    ):
        for k, (side, color) in enumerate(zip(arrangement.sides, cycle(SIDE_COLORS), strict=False)):
            _draw_side(axes, np.asarray(side), color, first=_count_before(arrangement, k))
        axes.set_aspect("equal", adjustable="datalim")
        axes.margins(0.12)
        name = str(arrangement.name)
        title = name if "arrangement" in name else f"arrangement {name}"
        tidy(axes, title=title, xlabel="x [m]", ylabel="y [m]")
    figure.suptitle("squares are registered with the base at rest; arrows: the base's way")
    return figure


def plot_rmma_run(trace: Trace, *, detection_radius: float | None = None) -> Figure:
    """One run from above: the base's way, the arm at each search; below, each search enlarged.

    The lower panels show where the laser was read, relative to the fiducial, lighter the later;
    dashed: two standard deviations of the predicted position, about the first stop.

    Parameters
    ----------
    trace : rmma.Trace
    detection_radius : float, m, optional
        Drawn around the fiducials in the lower panels.

    Examples
    --------
    >>> from thing_kin import rmma, viz
    >>> trace = rmma.trace(arrangement=1, method="ukf", velocity=0.02, rng=0)
    >>> figure = viz.plot_rmma_run(trace, detection_radius=0.012)
    >>> figure.axes[0].get_xlabel()
    'x [m]'
    """
    searches = [(side, s) for side in trace.sides for s in side.searches if len(s.stops)]
    rows = -(-len(searches) // PANELS_IN_A_ROW)
    figure = new_figure(figsize=(14, 6.4 + 2.3 * rows))
    grid = figure.add_gridspec(1 + rows, PANELS_IN_A_ROW, height_ratios=[6.2, *([2.3] * rows)])
    above = figure.add_subplot(grid[0, :])
    plot_rmma_run_from_above(trace, axes=above)
    number = _numbers(trace)
    for k, (side, search) in enumerate(searches):
        axes = figure.add_subplot(grid[1 + k // PANELS_IN_A_ROW, k % PANELS_IN_A_ROW])
        _draw_search(axes, side, search, detection_radius)
        name = number[id(side)] + search.fiducial + 1
        stops = "1 stop" if len(search.stops) == 1 else f"{len(search.stops)} stops"
        told = f"{stops}, {search.end - search.start:.1f} s"
        axes.set_title(f"fiducial {name}\n{told}", fontsize=8)
        if k % PANELS_IN_A_ROW == 0:
            axes.set_ylabel("mm")
    return figure


def plot_rmma_run_from_above(trace: Trace, *, axes: Axes | None = None) -> Figure:
    """One run from above, without its searches enlarged.

    Parameters
    ----------
    trace : rmma.Trace
    axes : matplotlib Axes, optional
        Where to draw; default: a new figure.

    Examples
    --------
    >>> from thing_kin import rmma, viz
    >>> trace = rmma.trace(arrangement=2, method="spiral", velocity=0.01, rng=0)
    >>> len(viz.plot_rmma_run_from_above(trace).axes)
    1
    """
    axes = axes_or_new(axes, figsize=(11, 6))
    for side, color in zip(trace.sides, cycle(SIDE_COLORS), strict=False):
        path = side.to_map(side.base[:, :2])
        axes.plot(*path.T, color=color, linewidth=1.6)
        axes.annotate("", path[-1], path[0], arrowprops={"arrowstyle": "->", "color": color})
        for search in (search for search in side.searches if len(search.stops)):
            _draw_pose(axes, side, search, color)
        _draw_fiducials(axes, side)
    axes.set_aspect("equal", adjustable="datalim")
    tidy(axes, title=trace.title, xlabel="x [m]", ylabel="y [m]")
    _legend(axes)
    return figure_of(axes)


def body_corners(pose: Array) -> Array:
    """(5, 2), outline of the base at a pose."""
    half = 0.5 * np.array(BODY)
    corners = half * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1], [1, 1]])
    c, s = np.cos(pose[2]), np.sin(pose[2])
    outline: Array = corners @ np.array([[c, s], [-s, c]]) + pose[:2]
    return outline


def _draw_side(axes: Axes, side: Array, color: str, first: int) -> None:
    axes.plot(*side[1:].T, "o", color=color, markersize=6)
    axes.plot(*side[0], "s", color=color, markersize=8)
    for k, point in enumerate(side):
        axes.annotate(str(first + k + 1), point, xytext=(5, 5), textcoords="offset points")
    toward = float(np.sign(side[-1, 0] - side[0, 0])) if len(side) > 1 else 1.0
    low = side[:, 1].mean() - 0.3 * toward  # the base passes below (+x) or above (-x)
    ends = (side[0, 0], low), (side[-1, 0], low)
    axes.annotate(
        "", ends[1], ends[0], arrowprops={"arrowstyle": "->", "color": color, "linewidth": 1.5}
    )
    axes.plot(*np.array(ends).T, alpha=0.0)  # so that the limits hold the arrow


def _count_before(arrangement: Arrangement, side: int) -> int:
    return sum(len(np.asarray(before)) for before in arrangement.sides[:side])


def _numbers(trace: Trace) -> dict[int, int]:
    """How many fiducials stand on the sides before each side."""
    counts = np.cumsum([0, *(len(side.fiducials) for side in trace.sides)])
    return {id(side): int(count) for side, count in zip(trace.sides, counts, strict=False)}


def _draw_pose(axes: Axes, side: SideTrace, search: SearchTrace, color: str) -> None:
    """Draw base and arm at the end of a search, and all its stops."""
    pose, stops = search.base_at_stops[-1], side.to_map(search.stops)
    axes.plot(*side.to_map(body_corners(pose)).T, color=color, linewidth=0.6, alpha=0.5)
    arm = np.vstack([side.to_map(pose[:2]), stops[-1]])
    axes.plot(*arm.T, color=GRAY, linewidth=1.2, marker="o", markersize=2.5, markevery=[0])
    axes.plot(*stops.T, ".", color=BLACK, markersize=1.5)


def _draw_fiducials(axes: Axes, side: SideTrace) -> None:
    points = side.to_map(side.fiducials)
    found = {search.fiducial for search in side.searches if search.hit}
    tried = {search.fiducial for search in side.searches}
    for k, point in enumerate(points):
        style: dict[str, Any] = {"marker": "o", "color": GREEN}
        if k == 0:
            style = {"marker": "s", "color": GREEN}
        elif k not in found:
            style = {"marker": "X", "color": RED if k in tried else GRAY}
        axes.plot(*point, markersize=9, markeredgecolor="white", linestyle="none", **style)


def _legend(axes: Axes) -> None:
    kinds = (
        ("registered", "s", GREEN),
        ("intercepted", "o", GREEN),
        ("missed", "X", RED),
        ("skipped", "X", GRAY),
        ("stops of the laser", ".", BLACK),
    )
    for label, marker, color in kinds:
        axes.plot([], [], marker=marker, color=color, linestyle="none", label=label)
    axes.plot([], [], color=GRAY, label="arm at the end of a search")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)


def _draw_search(axes: Axes, side: SideTrace, search: SearchTrace, radius: float | None) -> None:
    from matplotlib.patches import Circle, Ellipse

    stops = 1e3 * (search.stops - side.fiducials[search.fiducial])  # mm, in the side's axes
    axes.plot(*stops.T, color="0.8", linewidth=0.7)
    axes.scatter(
        stops[:, 0], stops[:, 1], c=np.arange(len(stops)), cmap="viridis", s=10, vmin=0, vmax=45
    )
    color = GREEN if search.hit else RED
    axes.plot(0, 0, marker="o" if search.hit else "X", color=color, markersize=6)
    if radius is not None:
        axes.add_patch(Circle((0, 0), 1e3 * radius, fill=False, edgecolor=color, linewidth=1.0))
    if search.covariance is not None:
        variance, directions = np.linalg.eigh(search.covariance)
        width, height = 4e3 * np.sqrt(np.maximum(variance, 0.0))  # two sigma to each side, mm
        axes.add_patch(
            Ellipse(
                (stops[0, 0], stops[0, 1]),
                width=width,
                height=height,
                angle=float(np.degrees(np.arctan2(directions[1, 0], directions[0, 0]))),
                fill=False,
                edgecolor=BLUE,
                linestyle="--",
                linewidth=1.0,
            )
        )
    half = 1.15 * max(np.abs(stops).max(), 1e3 * (radius or 0.0), 5.0)
    axes.set(xlim=(-half, half), ylim=(-half, half))
    axes.set_aspect("equal")
    tidy(axes)
    axes.tick_params(labelsize=7)
