"""Which search when: rate and time against the laser's radius and the base's drift."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from thing_kin.viz.rmma import METHOD_COLORS
from thing_kin.viz.style import RED, new_figure, tidy

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from thing_kin.rmma.practices import Practice

COLORS = {**METHOD_COLORS, "spiral, gap = radius": RED}
STANDARD_RADIUS, STANDARD_DRIFT = 0.012, 1.0


def plot_rmma_practice(practice: Practice) -> Figure:
    """Rate and time of every method against radius and drift, and a map of what to take.

    The map has the method that needs least of those that reach 99 %; where none does, the best
    one, hatched.

    Parameters
    ----------
    practice : rmma.Practice

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> from thing_kin import rmma, viz
    >>> with ThreadPoolExecutor() as pool:
    ...     practice = rmma.practice((0.006, 0.012), (1.0, 2.0), runs=1, executor=pool)
    >>> len(viz.plot_rmma_practice(practice).axes)
    5
    """
    figure = new_figure(figsize=(14, 7.4))
    grid = figure.add_gridspec(2, 3, width_ratios=[1.0, 1.0, 1.5])
    i = int(np.argmin(np.abs(practice.radii - STANDARD_RADIUS)))
    j = int(np.argmin(np.abs(practice.drifts - STANDARD_DRIFT)))
    for row, (values, label) in enumerate(
        ((100 * practice.rates, "interception rate [%]"), (practice.times, "search time [s]"))
    ):
        axes = figure.add_subplot(grid[row, 0])
        _lines(axes, practice, 1e3 * practice.radii, values[:, :, j])
        tidy(axes, xlabel="detection radius [mm]", ylabel=label)
        if row == 0:
            axes.set_title(f"drift x{practice.drifts[j]:g}")
        axes = figure.add_subplot(grid[row, 1])
        _lines(axes, practice, practice.drifts, values[:, i])
        tidy(axes, xlabel="drift, times the standard world's")
        if row == 0:
            axes.set_title(f"detection radius {1e3 * practice.radii[i]:g} mm")
    _map(figure.add_subplot(grid[:, 2]), practice)
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=6, frameon=False)
    return figure


def _lines(axes: Axes, practice: Practice, x: np.ndarray, values: np.ndarray) -> None:
    for label, line in zip(practice.methods, values, strict=True):
        axes.plot(x, line, color=COLORS[label], marker="o", markersize=4, label=label)
    axes.set_ylim(min(0.0, float(values.min())), None)
    if values.max() > 50:
        axes.set_ylim(max(0.0, float(values.min()) - 4.0), 101.0)


def _map(axes: Axes, practice: Practice) -> None:
    from matplotlib.patches import Rectangle

    for i, j in np.ndindex(len(practice.radii), len(practice.drifts)):
        chosen, enough = practice.choice(i, j)
        label = practice.methods[chosen]
        axes.add_patch(
            Rectangle(
                (i - 0.5, j - 0.5),
                1.0,
                1.0,
                facecolor=COLORS[label],
                alpha=0.45,
                hatch="" if enough else "//",
                edgecolor="white",
                linewidth=2,
            )
        )
        told = f"{100 * practice.rates[chosen, i, j]:.1f} %\n{practice.times[chosen, i, j]:.2f} s"
        words = label.replace(", ", ",\n").replace(" on ", "\non ")
        axes.text(i, j, f"{words}\n{told}", ha="center", va="center", fontsize=8)
    axes.set_xlim(-0.5, len(practice.radii) - 0.5)
    axes.set_ylim(-0.5, len(practice.drifts) - 0.5)
    axes.set_xticks(range(len(practice.radii)), [f"{1e3 * r:g}" for r in practice.radii])
    axes.set_yticks(range(len(practice.drifts)), [f"x{d:g}" for d in practice.drifts])
    axes.set(xlabel="detection radius [mm]", ylabel="drift")
    axes.set_title("the least demanding search with 99 % (hatched: none has)", fontsize=11)
    axes.spines[:].set_visible(False)
