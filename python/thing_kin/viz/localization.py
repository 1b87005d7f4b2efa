"""A localized drive: the way, and the errors with what they were said to be."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from thing_kin.viz.style import BLACK, BLUE, GREEN, ORANGE, new_figure, tidy

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from thing_kin.estimation import LocalizationExperiment

COLORS = {"wheels": ORANGE, "lidar": GREEN, "fused": BLUE}
LABELS = {"wheels": "wheels alone", "lidar": "LIDAR alone", "fused": "fused"}


def plot_localization(experiment: LocalizationExperiment) -> Figure:
    """Estimates of a simulated drive against the truth, with the fused estimate's 2-sigma band.

    What figures 6.1 and 6.2 of [M17] were to show.

    Parameters
    ----------
    experiment : LocalizationExperiment
        What `estimation.localization_experiment` returns.

    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> from thing_kin import viz
    >>> figure = viz.plot_localization(est.localization_experiment(20.0, rng=0))
    >>> len(figure.axes)
    5
    """
    figure = new_figure(figsize=(12, 7.2))
    grid = figure.add_gridspec(4, 2, width_ratios=[1.0, 1.15])
    _plot_way(figure.add_subplot(grid[:, 0]), experiment)
    first = None
    for k, label in enumerate(("error in x [m]", "error in y [m]", "error in heading [rad]")):
        axes = figure.add_subplot(grid[k, 1], sharex=first)
        first = first or axes
        _plot_error(axes, experiment, k)
        tidy(axes, ylabel=label)
    axes = figure.add_subplot(grid[3, 1], sharex=first)
    for name, run in experiment.runs.items():
        axes.plot(run.t, np.maximum(run.nees, 1e-2), color=COLORS[name], linewidth=1.0)
    axes.axhline(7.81, color=BLACK, linestyle=":", linewidth=1.2, label="95 % bound")
    axes.set_yscale("log")
    tidy(axes, ylabel="NEES", xlabel="time [s]")
    axes.legend(loc="lower right", frameon=False)
    return figure


def _plot_way(axes, experiment: LocalizationExperiment) -> None:  # type: ignore[no-untyped-def]
    truth = experiment.drive.truth
    for name, run in experiment.runs.items():
        axes.plot(*run.pose[:, :2].T, color=COLORS[name], linewidth=1.3, label=LABELS[name])
    axes.plot(*truth[:, :2].T, "--", color=BLACK, linewidth=1.1, label="truth")
    axes.plot(*truth[0, :2], "o", color=BLACK, markersize=5)
    axes.set_aspect("equal", adjustable="datalim")
    way = experiment.drive.length
    tidy(axes, title=f"a drive of {way:.0f} m", xlabel="x [m]", ylabel="y [m]")
    axes.legend(loc="best", frameon=False)


def _plot_error(axes, experiment: LocalizationExperiment, k: int) -> None:  # type: ignore[no-untyped-def]
    fused = experiment.runs["fused"]
    band = 2 * fused.sigma[:, k]
    axes.fill_between(
        fused.t, -band, band, color=BLUE, alpha=0.18, linewidth=0, label="2 sigma of the fused"
    )
    for name, run in experiment.runs.items():
        axes.plot(run.t, run.error[:, k], color=COLORS[name], linewidth=1.1)
    # Wheels alone would hide the others.
    shown = [np.abs(run.error[:, k]).max() for n, run in experiment.runs.items() if n != "wheels"]
    limit = 1.25 * max(*shown, float(band.max()))
    axes.set_ylim(-limit, limit)
    if k == 0:
        axes.legend(loc="upper left", frameon=False)
