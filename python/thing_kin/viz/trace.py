"""How an optimization went."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from thing_kin.viz.style import BLUE, GRAY, ORANGE, RED, new_figure, tidy

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from thing_kin import SqpTrace


def plot_trace(trace: SqpTrace) -> Figure:
    """Objective, violation, trust region and penalty of Algorithm 2, iteration by iteration.

    Steps that were refused are marked with crosses: there the trust region shrinks.

    Parameters
    ----------
    trace : SqpTrace

    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import viz
    >>> problem = tk.Problem(n=1)
    >>> problem.minimize(tk.terms.Function(lambda x: x[0] ** 4, lambda x: 4 * x**3))
    >>> figure = viz.plot_trace(tk.sqp(problem, [1.0]).trace)
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['objective', 'violation', 'radius, penalty']
    """
    figure = new_figure(figsize=(8, 7))
    above, middle, below = figure.subplots(3, 1, sharex=True)
    iteration = np.arange(1, len(trace) + 1)
    refused = ~trace.accepted

    above.plot(iteration, trace.objective, color=BLUE, linewidth=1.3)
    above.plot(
        iteration[refused],
        trace.objective[refused],
        "x",
        color=RED,
        markersize=5,
        label="step refused",
    )
    tidy(above, ylabel="objective")
    if refused.any():
        above.legend(frameon=False)

    # A log scale has no zero: what holds exactly stands at the bottom.
    middle.plot(iteration, np.maximum(trace.violation, 1e-16), color=ORANGE, linewidth=1.3)
    middle.set_yscale("log")
    tidy(middle, ylabel="violation")

    below.step(iteration, trace.radius, where="mid", color=BLUE, label="trust region")
    below.step(iteration, trace.penalty, where="mid", color=GRAY, label="penalty")
    below.set_yscale("log")
    tidy(below, xlabel="iteration", ylabel="radius, penalty")
    below.legend(frameon=False)
    return figure
