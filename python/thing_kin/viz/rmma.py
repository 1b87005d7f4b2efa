"""The RMMA experiment: what came out, by velocity and by fiducial."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from thing_kin.viz.style import (
    BLACK,
    BLUE,
    GRAY,
    GREEN,
    ORANGE,
    PURPLE,
    RED,
    SKY,
    new_figure,
    tidy,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from thing_kin.rmma import Result

METHOD_COLORS = {
    "spiral": ORANGE,
    "linear_kf": GRAY,
    "ukf": BLUE,
    "covering": GREEN,
    "covering, odometry on failure": SKY,
    "covering, no odometry": PURPLE,
}
LABELS = {"rate": "interception rate [%]", "time": "search time [s]", "error": "error [mm]"}
UNITS = {"rate": 100.0, "time": 1.0, "error": 1e3}
ATTRIBUTES = {"rate": "interception_rate", "time": "search_time", "error": "position_error"}


def plot_rmma_result(result: Result) -> Figure:
    """Rate, search time and position error of one experiment, by velocity and by fiducial.

    Bars are 95 % intervals with the run as the unit. The first fiducial of each side is
    registered: intercepted in no time.

    Parameters
    ----------
    result : rmma.Result

    Examples
    --------
    >>> from thing_kin import rmma, viz
    >>> result = rmma.run(arrangement=1, method="ukf", runs=5, rng=0)
    >>> len(viz.plot_rmma_result(result).axes)
    6
    """
    figure = new_figure(figsize=(11, 6))
    above, below = figure.subplots(2, 3)
    color = METHOD_COLORS.get(result.method, BLUE)
    for axes, measure in zip(above, LABELS, strict=True):
        draw_by_velocity(axes, result, measure, color)
        tidy(axes, xlabel="velocity [cm/s]", ylabel=LABELS[measure])
        from_zero(axes, measure)
    for axes, measure in zip(below, LABELS, strict=True):
        _draw_by_fiducial(axes, result, measure, color)
        tidy(axes, xlabel="fiducial", ylabel=LABELS[measure])
        from_zero(axes, measure)
    figure.suptitle(f"{result.title}: {result.runs} runs at each velocity")
    return figure


def plot_rmma_methods(results: Mapping[str, Result]) -> Figure:
    """Rate, search time and position error of several experiments against velocity.

    Parameters
    ----------
    results : mapping of labels to rmma.Result

    Examples
    --------
    >>> from thing_kin import rmma, viz
    >>> names = ("spiral", "covering")
    >>> results = {name: rmma.run(arrangement=2, method=name, runs=5, rng=0) for name in names}
    >>> len(viz.plot_rmma_methods(results).axes)
    3
    """
    figure = new_figure(figsize=(12, 4))
    for axes, measure in zip(figure.subplots(1, 3), LABELS, strict=True):
        for k, (label, result) in enumerate(results.items()):
            draw_by_velocity(axes, result, measure, color_of(label, k), label)
        tidy(axes, xlabel="velocity [cm/s]", ylabel=LABELS[measure])
        from_zero(axes, measure)
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=6, frameon=False)
    return figure


def color_of(label: str, k: int) -> str:
    """Return a method's own color, or the k-th of others."""
    return METHOD_COLORS.get(label, (BLUE, ORANGE, GREEN, RED, PURPLE, SKY, BLACK)[k % 7])


def draw_by_velocity(
    axes: Axes, result: Result, measure: str, color: str, label: str | None = None
) -> None:
    """Draw a measure against velocity with its intervals."""
    unit = UNITS[measure]
    means = unit * np.asarray(getattr(result, f"{ATTRIBUTES[measure]}_by_velocity"))
    bounds = np.array([_interval(result.at_velocity(v), measure) for v in result.velocities])
    axes.errorbar(
        100 * result.velocities,
        means,
        yerr=error_bars(means, unit * bounds),
        color=color,
        marker="o",
        markersize=4,
        linewidth=1.4,
        capsize=2,
        label=label,
    )


def error_bars(means: NDArray[np.float64], bounds: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lengths (2, N) down and up to bounds (N, 2); none where there is no bound."""
    lengths = np.stack([means - bounds[:, 0], bounds[:, 1] - means])
    return np.where(np.isfinite(lengths), np.maximum(lengths, 0.0), 0.0)


def from_zero(axes: Axes, measure: str) -> None:
    """Let times and errors begin at zero, and rates end at 100 %."""
    if measure == "rate":
        low = axes.get_ylim()[0]
        axes.set_ylim(min(low, 89.0), 100.0 + 0.03 * (100.0 - min(low, 89.0)))
    else:
        axes.set_ylim(0.0, max(axes.get_ylim()[1], 1e-3))


def _interval(part: Result, measure: str) -> tuple[float, float]:
    if measure == "rate":
        return part.interception_interval(unit="run")
    return part.search_time_interval() if measure == "time" else part.position_error_interval()


def _draw_by_fiducial(axes: Axes, result: Result, measure: str, color: str) -> None:
    values = UNITS[measure] * np.asarray(getattr(result, f"{ATTRIBUTES[measure]}_by_fiducial"))
    number = np.arange(1, len(values) + 1)
    shown = np.nan_to_num(values)
    faces = ["0.8" if registered else color for registered in result.registered]
    axes.bar(number, shown, color=faces, width=0.7)
    axes.set_xticks(number)
    if measure == "rate":
        axes.set_ylim(max(0.0, 5.0 * np.floor(shown.min() / 5.0) - 5.0), 100.0)
    for k in np.flatnonzero(result.registered):
        axes.annotate(
            "registered",
            (number[k], 0.0),
            xytext=(0, 4),
            xycoords=("data", "axes fraction"),
            textcoords="offset points",
            rotation=90,
            ha="center",
            va="bottom",
            fontsize=7,
            color="0.35",
        )
