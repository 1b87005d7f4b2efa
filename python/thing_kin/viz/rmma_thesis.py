"""Figures 5.1 to 5.8 of [X21] drawn anew."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from thing_kin.rmma import Result


def plot_rmma_thesis_figure(
    number: str, results: Mapping[tuple[int, str, int | None], Result]
) -> Figure:
    """Draw figure 5.1, … or 5.8 of [X21] anew, with the thesis's means as hollow diamonds.

    Parameters
    ----------
    number : str
        "5.1" to "5.8".
    results : mapping from (arrangement, method, configuration) to rmma.Result
        What `rmma.reproduce` computes; the configuration of "spiral" is None. Figures 5.1 to 5.6
        and 5.8 need the configurations of Table 5.2, 5.7 the sixth.

    Examples
    --------
    >>> from thing_kin import rmma, viz
    >>> results = {
    ...     (1, method, 6): rmma.run(arrangement=1, method=method, config=6, runs=5, rng=0)
    ...     for method in ("linear_kf", "ukf")
    ... }
    >>> len(viz.plot_rmma_thesis_figure("5.1", results).axes)
    2
    """
    from thing_kin.viz.rmma_thesis_figures import FIGURES  # brings the whole experiment

    if number not in FIGURES:
        raise ValueError(f"number: got {number!r}, expected one of {', '.join(FIGURES)}")
    return FIGURES[number](results)
