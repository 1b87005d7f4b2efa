"""Calibrations: residuals before and after, and what is known of the parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from thing_kin.viz.style import BLACK, BLUE, GRAY, ORANGE, RED, new_figure, tidy

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from thing_kin.estimation import CalibrationResult

    Array = NDArray[np.float64]


def plot_calibration(result: CalibrationResult) -> Figure:
    """Errors of each measurement before and after, their distribution, the parameters.

    Outliers are ringed. A parameter's bar is its change from nominal, its whisker twice its
    standard deviation; what the data do not tell is gray, its name too.

    Parameters
    ----------
    result : estimation.Calibration or estimation.MecanumCalibration

    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import estimation as est, viz
    >>> arm = tk.robots.ur5()
    >>> q = arm.random(30, rng=0)
    >>> figure = viz.plot_calibration(est.calibrate(arm, q, arm.fk(q)))
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['error [mm]', 'share', 'change [mm, mrad, %]']
    """
    figure = new_figure(figsize=(12, 7))
    parts = figure.subplot_mosaic([["errors", "share"], ["values", "values"]], width_ratios=(2, 1))
    numbers = result._position_numbers
    before, after = (_lengths(e[..., :numbers]) for e in (result.errors_nominal, result.errors))
    for lengths, color, name in ((before, ORANGE, "nominal"), (after, BLUE, "calibrated")):
        at = np.repeat(np.arange(len(lengths)), lengths.shape[1])
        parts["errors"].semilogy(at, lengths.ravel(), "o", color=color, ms=4, label=name)
        ordered = np.sort(lengths[np.isfinite(lengths)])
        share = np.arange(1, len(ordered) + 1) / max(len(ordered), 1)
        parts["share"].semilogx(ordered, share, color=color, lw=1.6, label=name)
    for outlier in result.outliers:
        posture, point = outlier if isinstance(outlier, tuple) else (outlier, 0)
        parts["errors"].plot(posture, after[posture, point], "o", mfc="none", mec=RED, ms=10)
    title = f"rms {1e3 * result.rms_position_nominal:.3g} mm to {1e3 * result.rms_position:.3g} mm"
    tidy(parts["errors"], title=title, xlabel=result._measurement, ylabel="error [mm]")
    tidy(parts["share"], xlabel="error [mm]", ylabel="share")
    parts["errors"].legend(loc="best", frameon=False)
    _values(parts["values"], result)
    return figure


def _lengths(errors: Array) -> Array:
    """Of positions, mm, (N, k)."""
    lengths: Array = 1e3 * np.linalg.norm(errors, axis=-1)
    lengths = np.maximum(lengths, 1e-9)  # on a logarithmic axis
    return lengths if lengths.ndim > 1 else lengths[:, None]


def _values(axes: Axes, result: CalibrationResult) -> None:
    """Of the robot alone: where base, tool, points and a reference stand is no error."""
    places = ("base", "tool", "points", "mount_")
    rows = [row for row in result.table if not row.name.startswith(places)]
    factor = np.array([100.0 if row.unit == "1" else 1e3 for row in rows])
    values = factor * np.array([row.change for row in rows])
    std = factor * np.array([row.std for row in rows])
    told = np.isfinite(std)
    at = np.arange(len(rows))
    axes.bar(at, values, color=[BLUE if t else GRAY for t in told], width=0.6)
    whiskers = np.where(told, 2 * std, 0.0)
    axes.errorbar(at, values, whiskers, fmt="none", ecolor=BLACK, elinewidth=1.0, capsize=2)
    axes.set_xticks(at, [row.name for row in rows], rotation=60, ha="right", fontsize=7)
    for label, is_told in zip(axes.get_xticklabels(), told, strict=True):
        label.set_color(BLACK if is_told else GRAY)
    tidy(axes, title="Changes, with twice their deviations", ylabel="change [mm, mrad, %]")
