"""A run of the experiment as a movie."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from thing_kin.viz.rmma_run import SIDE_COLORS, body_corners
from thing_kin.viz.style import BLACK, GRAY, GREEN, RED, new_figure, tidy

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from PIL import Image

    from thing_kin.rmma.traces import SearchTrace, SideTrace, Trace

    Array = NDArray[np.float64]


def animate_rmma_run(trace: Trace, path: str | Path, *, frames: int = 120, fps: int = 15) -> Path:
    """Write an animated GIF of a run from above: base, arm, stops of the laser, hits and misses.

    Sides follow each other. Time runs evenly, much faster than in truth: a side takes minutes.

    Parameters
    ----------
    trace : rmma.Trace
    path : str or Path
        The file to write, `name.gif`.
    frames, fps : int
        Number of pictures, and how many of them are shown a second.

    Returns
    -------
    Path

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from thing_kin import rmma, viz
    >>> trace = rmma.trace(arrangement=2, method="spiral", velocity=0.03, rng=0)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = viz.animate_rmma_run(trace, Path(folder) / "run.gif", frames=2)
    ...     file.stat().st_size > 0
    True
    """
    scene = _Scene(trace)
    from PIL import Image  # comes with matplotlib: new_figure says if that is missing

    ends = np.cumsum([0.0, *(side.times[-1] - side.times[0] for side in trace.sides)])
    moments = np.linspace(0.0, ends[-1], frames)
    pictures = []
    for moment in moments:
        k = min(int(np.searchsorted(ends, moment, side="right")) - 1, len(trace.sides) - 1)
        pictures.append(scene.picture(k, trace.sides[k].times[0] + moment - ends[k], moment))
    palette = pictures[-1].quantize(256, method=Image.Quantize.FASTOCTREE)
    first, *others = (p.quantize(palette=palette, dither=Image.Dither.NONE) for p in pictures)
    first.save(path, save_all=True, append_images=others, duration=1000 // fps, loop=0)
    return Path(path)


def tool_at(side: SideTrace, t: float) -> Array:
    """Tool in the side's frame at a time: at a search's last stop, or between two searches.

    Between them, and from the registered fiducial to the first, the arm moves evenly, seen from the
    base.
    """
    searches = [search for search in side.searches if len(search.stops)]
    begun = [search for search in searches if search.stop_times[0] <= t]
    if not begun:
        registered = _relative(side.base[0], side.fiducials[0])
        if not searches:
            return _from_base(_pose_at(side, t), registered)
        start = searches[0].stop_times[0]
        share = (t - side.times[0]) / max(start - side.times[0], 1e-9)
        moved = registered + share * (_in_base(searches[0], 0) - registered)
        return _from_base(_pose_at(side, t), moved)
    last = begun[-1]
    stop = int(np.searchsorted(last.stop_times, t, side="right")) - 1
    if t <= last.end or len(begun) == len(searches):
        return _carried(side, last, stop, t)
    following = searches[len(begun)]
    share = (t - last.end) / max(following.stop_times[0] - last.end, 1e-9)
    before, after = _in_base(last, -1), _in_base(following, 0)
    return _from_base(_pose_at(side, t), before + min(share, 1.0) * (after - before))


def _carried(side: SideTrace, search: SearchTrace, stop: int, t: float) -> Array:
    """At a stop, and carried along by the base after it."""
    if search.hit and stop == len(search.stops) - 1 and t <= search.end:
        hit: Array = search.stops[-1]
        return hit
    return _from_base(_pose_at(side, t), _in_base(search, stop))


def _in_base(search: SearchTrace, stop: int) -> Array:
    return _relative(search.base_at_stops[stop], search.stops[stop])


def _relative(pose: Array, point: Array) -> Array:
    c, s = np.cos(pose[2]), np.sin(pose[2])
    u: Array = np.array([[c, s], [-s, c]]) @ (point - pose[:2])
    return u


def _from_base(pose: Array, u: Array) -> Array:
    c, s = np.cos(pose[2]), np.sin(pose[2])
    point: Array = pose[:2] + np.array([[c, -s], [s, c]]) @ u
    return point


def _pose_at(side: SideTrace, t: float) -> Array:
    return np.array([np.interp(t, side.times, column) for column in side.base.T])


class _Scene:
    """What stands still, drawn once, and the lines that move."""

    def __init__(self, trace: Trace) -> None:
        figure = new_figure(figsize=(7.6, 4.6), dpi=80)
        from matplotlib.backends.backend_agg import FigureCanvasAgg

        self.trace = trace
        axes: Any = figure.add_subplot()
        for side in trace.sides:
            axes.plot(*side.to_map(side.fiducials).T, "o", color="0.75", markersize=7)
            ends = side.to_map(np.vstack([body_corners(p) for p in side.base[[0, -1]]]))
            axes.plot(*ends.T, alpha=0.0)
        axes.set_aspect("equal", adjustable="datalim")
        tidy(axes, title=trace.title, xlabel="x [m]", ylabel="y [m]")
        self.canvas = cast("Any", FigureCanvasAgg(figure))  # matplotlib leaves it untyped
        self.canvas.draw()
        axes.set(xlim=axes.get_xlim(), ylim=axes.get_ylim())  # as they are: nothing shifts now
        figure.set_layout_engine("none")
        self.canvas.draw()
        self.background = self.canvas.copy_from_bbox(figure.bbox)
        styles: dict[str, dict[str, Any]] = {
            "way": {"color": SIDE_COLORS[0], "linewidth": 1.4},
            "body": {"color": GRAY, "linewidth": 1.4},
            "arm": {"color": "0.2", "linewidth": 2.0, "marker": "o", "markersize": 3},
            "stops": {"color": BLACK, "marker": ".", "markersize": 2, "linestyle": "none"},
            "hit": {"color": GREEN, "marker": "o", "markersize": 8, "linestyle": "none"},
            "missed": {"color": RED, "marker": "X", "markersize": 8, "linestyle": "none"},
        }
        self.axes = axes
        self.lines = {name: axes.plot([], [], **style)[0] for name, style in styles.items()}
        self.clock = axes.text(0.01, 0.02, "", transform=axes.transAxes, color="0.3")

    def picture(self, k: int, t: float, moment: float) -> Image.Image:
        """Draw the k-th side at its time t over what stands still."""
        from PIL import Image

        self.canvas.restore_region(self.background)
        for name, points in self._points(k, t).items():
            self.lines[name].set_data(*np.reshape(points, (-1, 2)).T)
            self.lines[name].set_color(
                SIDE_COLORS[k % len(SIDE_COLORS)] if name == "way" else self.lines[name].get_color()
            )
            self.axes.draw_artist(self.lines[name])
        self.clock.set_text(f"{moment:.0f} s")
        self.axes.draw_artist(self.clock)
        return Image.fromarray(np.array(self.canvas.buffer_rgba())).convert("RGB")

    def _points(self, k: int, t: float) -> dict[str, Any]:
        side = self.trace.sides[k]
        pose, tool = _pose_at(side, t), tool_at(side, t)
        way = side.to_map(side.base[side.times <= t, :2])
        arm = side.to_map(np.vstack([pose[:2], tool]))
        return {
            "way": way,
            "body": side.to_map(body_corners(pose)),
            "arm": arm,
            "stops": self._stops(k, t),
            "hit": self._ended(k, t, True),
            "missed": self._ended(k, t, False),
        }

    def _stops(self, k: int, t: float) -> Array:
        stops = [
            side.to_map(search.stops[search.stop_times <= (t if j == k else np.inf)])
            for j, side in enumerate(self.trace.sides[: k + 1])
            for search in side.searches
        ]
        return np.vstack([np.empty((0, 2)), *stops])

    def _ended(self, k: int, t: float, hit: bool) -> Array:
        """Fiducials whose search is over; the first of a side was hit before it began to move."""
        points = [np.empty((0, 2))]
        for j, side in enumerate(self.trace.sides[: k + 1]):
            fiducials = side.to_map(side.fiducials)
            until = t if j == k else np.inf
            found = [s.fiducial for s in side.searches if s.hit == hit and s.end <= until]
            points.append(fiducials[[0] * hit + found])
        return np.vstack(points)
