"""How figures 5.1 to 5.8 of [X21] are drawn anew, with the numbers that its tables tell.

The thesis's curves are in its pictures only. What its tables have, means over all velocities and
rates of fiducials, is drawn as hollow diamonds.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from thing_kin.rmma import thesis
from thing_kin.rmma.intervals import wilson
from thing_kin.rmma.tables import ten_runs
from thing_kin.viz.rmma import (
    ATTRIBUTES,
    LABELS,
    METHOD_COLORS,
    UNITS,
    draw_by_velocity,
    error_bars,
    from_zero,
)
from thing_kin.viz.style import BLACK, BLUE, GRAY, GREEN, ORANGE, new_figure, tidy

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from thing_kin.rmma import Result
    from thing_kin.rmma.thesis import Measures

    Results = Mapping[tuple[int, str, int | None], Result]

MEAN_AT = 3.6  # cm/s: where the means stand, right of the fastest velocity
DIAMOND: dict[str, Any] = {"marker": "D", "markersize": 6, "markerfacecolor": "white"}


def _linear_and_ukf(results: Results) -> Figure:
    figure = _compared(
        [
            (method, results[1, method, 6], thesis.TABLE_5_1[method], METHOD_COLORS[method])
            for method in ("linear_kf", "ukf")
        ],
        ("rate", "time"),
    )
    figure.suptitle("[X21] figure 5.1: linear Kalman filter and UKF, arrangement #1")
    return figure


def _methods(arrangement: int) -> Callable[[Results], Figure]:
    def draw(results: Results) -> Figure:
        config = thesis.TABLE_5_2_CONFIGURATION[arrangement]
        lines = [
            (name, results[arrangement, name, c], thesis.TABLE_5_2[arrangement, name], color)
            for name, c, color in (("ukf", config, BLUE), ("spiral", None, ORANGE))
        ]
        figure = _compared(lines, ("rate", "time", "error"))
        figure.suptitle(
            f"[X21] figure 5.{1 + arrangement}: UKF (configuration {config}) and spiral search, "
            f"arrangement #{arrangement}"
        )
        return figure

    return draw


def _configuration_6(results: Results) -> Figure:
    lines = [
        (
            f"arrangement #{k}",
            results[k, "ukf", 6],
            thesis.TABLES_5_3_TO_5_5[k, 6],
            color,
        )
        for k, color in ((2, GREEN), (3, BLUE))
    ]
    figure = _compared(lines, ("rate", "time", "error"))
    figure.suptitle("[X21] figure 5.7: UKF in configuration 6, tuned on arrangement #1")
    return figure


def _compared(
    lines: Sequence[tuple[str, Result, Measures, str]], measures: Sequence[str]
) -> Figure:
    figure = new_figure(figsize=(4.3 * len(measures), 4.2))
    for axes, measure in zip(figure.subplots(1, len(measures)), measures, strict=True):
        for k, (label, result, printed, color) in enumerate(lines):
            draw_by_velocity(axes, result, measure, color, label)
            _means(axes, result, printed, measure, color, 0.16 * (k - 0.5 * (len(lines) - 1)))
        ticks = [100 * v for v in lines[0][1].velocities]
        axes.set_xticks([*ticks, MEAN_AT], [*(f"{v:g}" for v in ticks), "mean"])
        axes.axvline(0.5 * (ticks[-1] + MEAN_AT), color="0.85", linewidth=0.8)
        tidy(axes, xlabel="velocity [cm/s]", ylabel=LABELS[measure])
        from_zero(axes, measure)
    handles, labels = axes.get_legend_handles_labels()
    handles.append(axes.plot([], [], color=BLACK, linestyle="none", **DIAMOND)[0])
    labels.append("thesis's mean, 2 sd of its ten runs")
    figure.legend(handles, labels, loc="outside lower center", ncols=4, frameon=False)
    return figure


def _means(
    axes: Axes, result: Result, printed: Measures, measure: str, color: str, shift: float
) -> None:
    """Mean over all velocities, and the thesis's with what ten runs scatter."""
    unit, name = UNITS[measure], ATTRIBUTES[measure]
    scatter = ten_runs(result)[("rate", "time", "error").index(measure)]
    bar = 2 * unit * scatter if np.isfinite(scatter) else 0.0
    axes.plot(MEAN_AT + shift - 0.05, unit * getattr(result, name), "o", color=color, markersize=6)
    axes.errorbar(
        MEAN_AT + shift + 0.05,
        unit * getattr(printed, name),
        yerr=bar,
        color=color,
        capsize=3,
        linewidth=1.0,
        **DIAMOND,
    )


def _iterations(results: Results) -> Figure:
    figure = new_figure(figsize=(10, 9))
    panels = figure.subplots(3, 2, sharex=True, sharey=True)
    for arrangement in (1, 2, 3):
        config = thesis.TABLE_5_2_CONFIGURATION[arrangement]
        for axes, (method, c) in zip(
            panels[arrangement - 1], (("ukf", config), ("spiral", None)), strict=True
        ):
            result = results[arrangement, method, c]
            _draw_iterations(axes, result, METHOD_COLORS[method])
            printed = thesis.TABLE_5_2[arrangement, method].interception_rate
            axes.axhline(100 * printed, color=BLACK, linestyle=":", linewidth=1.2)
            tidy(axes, title=f"arrangement #{arrangement}, {method}")
            if method == "ukf":
                axes.set_ylabel(LABELS["rate"])
    for axes in panels[-1]:
        axes.set_xlabel("run, at all velocities")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    handles.append(axes.plot([], [], color=BLACK, linestyle=":")[0])
    labels.append("thesis's mean")
    figure.legend(handles, labels, loc="outside lower center", ncols=3, frameon=False)
    figure.suptitle("[X21] figure 5.5: performance from run to run")
    return figure


def _draw_iterations(axes: Axes, result: Result, color: str) -> None:
    """Ten runs, and how other tens went: each run's rate over all velocities."""
    rate = 100 * result.intercepted.mean(axis=(0, 2))
    blocks = rate[: len(rate) // 10 * 10].reshape(-1, 10) if len(rate) >= 10 else rate[None]
    number = np.arange(1, blocks.shape[1] + 1)
    if len(blocks) > 1:
        low, high = np.percentile(rate, [5, 95])
        axes.axhspan(low, high, color=color, alpha=0.12, linewidth=0, label="90 % of all runs")
        axes.plot(number, blocks[1:6].T, color=GRAY, linewidth=0.6, alpha=0.6)
    axes.plot(number, blocks[0], color=color, marker="o", markersize=4, label="the first ten runs")


def _fiducials(results: Results) -> Figure:
    result = results[1, "ukf", 6]
    rates = 100 * result.intercepted.mean(axis=1)
    printed = np.full(len(result.registered), np.nan)
    printed[~result.registered] = thesis.BY_FIDUCIAL[1, "ukf"]
    printed[result.registered] = 1.0
    ours = result.interception_rate_by_fiducial
    values = np.vstack([rates, 100 * ours, 100 * printed])
    figure = new_figure(figsize=(9, 5))
    axes = figure.add_subplot()
    image = axes.imshow(values, cmap="Blues", vmin=40, vmax=100, aspect="auto")
    for (row, column), value in np.ndenumerate(values):
        dark = "white" if value > 80 else "black"
        axes.text(column, row, f"{value:.0f}", ha="center", va="center", color=dark)
    rows = [f"{100 * v:g} cm/s" for v in result.velocities]
    axes.set_yticks(range(len(values)), [*rows, "all velocities", "thesis, all"])
    axes.set_xticks(range(values.shape[1]), [str(k + 1) for k in range(values.shape[1])])
    axes.axhline(len(rows) - 0.5, color="white", linewidth=4)
    axes.set_xlabel("fiducial; 1 and 4 are registered")
    figure.colorbar(image, label=LABELS["rate"])
    figure.suptitle("[X21] figure 5.6: interception by fiducial, arrangement #1, configuration 6")
    return figure


def _distances(results: Results) -> Figure:
    figure = new_figure(figsize=(10, 9))
    panels = figure.subplots(3, 2, sharex="row", sharey="row")
    for arrangement in (1, 2, 3):
        config = thesis.TABLE_5_2_CONFIGURATION[arrangement]
        for axes, (method, c) in zip(
            panels[arrangement - 1], (("ukf", config), ("spiral", None)), strict=True
        ):
            _draw_distances(axes, results[arrangement, method, c], arrangement, method)
            tidy(axes, title=f"arrangement #{arrangement}, {method}")
            if method == "ukf":
                axes.set_ylabel(LABELS["rate"])
    for axes in panels[-1]:
        axes.set_xlabel("distance from the fiducial before [m], (fiducial)")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=2, frameon=False)
    figure.suptitle("[X21] figure 5.8: rates by distance, from the shortest to the longest")
    return figure


def _draw_distances(axes: Axes, result: Result, arrangement: int, method: str) -> None:
    """Rates in the order of the distances: to scale, most would lie on each other."""
    order = np.argsort(thesis.DISTANCES[arrangement], kind="stable")
    way = np.array(thesis.DISTANCES[arrangement])[order]
    printed = np.array(thesis.BY_FIDUCIAL[arrangement, method])[order]
    numbers = np.flatnonzero(~result.registered)[order] + 1
    ours = result.interception_rate_by_fiducial[numbers - 1]
    place = np.arange(len(way))
    bounds = np.array([wilson(50 * rate, 50) for rate in printed])
    axes.errorbar(
        place + 0.08,
        100 * printed,
        yerr=100 * error_bars(printed, bounds),
        color=GRAY,
        linestyle="none",
        linewidth=0.9,
        label="thesis, 95 % of 50 searches",
        **DIAMOND,
    )
    axes.plot(place - 0.08, 100 * ours, "o", color=METHOD_COLORS[method], label="here")
    axes.set_xticks(place, [f"{d:.2f}\n({k})" for d, k in zip(way, numbers, strict=True)])


FIGURES: Mapping[str, Callable[[Results], Figure]] = {
    "5.1": _linear_and_ukf,
    "5.2": _methods(1),
    "5.3": _methods(2),
    "5.4": _methods(3),
    "5.5": _iterations,
    "5.6": _fiducials,
    "5.7": _configuration_6,
    "5.8": _distances,
}
