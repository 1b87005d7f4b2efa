"""A moving stick figure."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from thing_kin.viz.geometry import box_corners, stick_figure
from thing_kin.viz.style import BLUE, GRAY, ORANGE, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike, NDArray
    from PIL import Image

    from thing_kin import Chain

BOX_EDGES = [0, 1, 2, 3, 0, 4, 5, 1, 5, 6, 2, 6, 7, 3, 7, 4]  # one line along all edges


def animate(
    robot: Chain,
    Q: ArrayLike,
    path: str | Path,
    *,
    body: tuple[float, float, float] | None = None,
    frames: int = 60,
    fps: int = 12,
) -> Path:
    """Write an animated GIF of the robot going through configurations, its hand drawing a line.

    Parameters
    ----------
    robot : Chain
    Q : (N, n), rad and m
    path : str or Path
        The file to write, `name.gif`.
    body : (length, width, height), m, optional
        Box of the base.
    frames, fps : int
        Number of pictures, evenly spaced in Q, and how many of them are shown a second.

    Returns
    -------
    Path

    Examples
    --------
    >>> import tempfile, numpy as np, thing_kin as tk
    >>> from pathlib import Path
    >>> from thing_kin import viz
    >>> robot = tk.robots.ur5()
    >>> Q = np.linspace(np.zeros(6), np.full(6, 0.5), 10)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     viz.animate(robot, Q, Path(folder) / "ur5.gif", frames=2).stat().st_size > 0
    True
    """
    figure = new_figure(figsize=(6.0, 4.2), dpi=80)
    from PIL import Image  # comes with matplotlib: new_figure says if that is missing

    figure.set_layout_engine("none")  # the axes fill the picture
    Q = np.asarray(Q, dtype=float)
    scene = _Scene(figure, robot, Q, body)
    shown = np.unique(np.linspace(0, len(Q) - 1, frames).round().astype(int))
    pictures = [scene.picture(k) for k in shown]
    # One palette for all: the last picture has every color, and this method keeps rare ones.
    palette = pictures[-1].quantize(256, method=Image.Quantize.FASTOCTREE)
    first, *others = (
        picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures
    )
    first.save(path, save_all=True, append_images=others, duration=1000 // fps, loop=0)
    return Path(path)


class _Scene:
    """The lines of the animation, and where they are at each configuration."""

    def __init__(
        self,
        figure: Figure,
        robot: Chain,
        Q: NDArray[np.float64],
        body: tuple[float, float, float] | None,
    ) -> None:
        from matplotlib.backends.backend_agg import FigureCanvasAgg

        self.sticks = stick_figure(robot, Q)
        self.base = np.zeros((len(Q), 0, 3))
        if body is not None and robot.base_joints is not None:
            corners = [box_corners(robot, q, body) for q in Q]
            self.base = np.array(corners)[:, BOX_EDGES]
        axes: Any = figure.add_axes((0.0, 0.02, 1.0, 0.98), projection="3d")
        _frame(axes, np.concatenate([self.sticks, self.base], axis=1).reshape(-1, 3))
        axes.plot(*self.sticks[:, -1].T, color="0.85", linewidth=0.8)
        self.canvas = cast("Any", FigureCanvasAgg(figure))  # matplotlib leaves it untyped
        self.canvas.draw()
        self.background = self.canvas.copy_from_bbox(figure.bbox)
        styles: tuple[dict[str, Any], ...] = (
            {"color": BLUE, "linewidth": 1.8},
            {"color": GRAY, "linewidth": 1.4},
            {"color": "0.2", "linewidth": 2.4, "marker": "o", "markersize": 3.5},
            {"color": ORANGE, "marker": "o", "markersize": 6},
        )
        self.axes = axes
        self.lines = [axes.plot([], [], [], clip_on=False, **style)[0] for style in styles]

    def picture(self, k: int) -> Image.Image:
        """Draw the robot at the k-th configuration over the axes, which are drawn only once."""
        sticks = self.sticks
        self.canvas.restore_region(self.background)
        for line, points in zip(
            self.lines, (sticks[: k + 1, -1], self.base[k], sticks[k], sticks[k, -1:]), strict=True
        ):
            line.set_data_3d(*points.T)
            self.axes.draw_artist(line)
        from PIL import Image

        return Image.fromarray(np.array(self.canvas.buffer_rgba())).convert("RGB")


def _frame(axes: Any, points: NDArray[np.float64]) -> None:
    """Axes that hold all points, with one scale for all three directions."""
    low, high = points.min(axis=0), points.max(axis=0)
    low[2] = min(low[2], 0.0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")
    axes.set_box_aspect(high - low, zoom=1.25)
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.get_major_locator().set_params(nbins=4)
    axes.view_init(elev=22, azim=-150)
