"""What all figures share: colors, and axes to draw into."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Okabe & Ito: told apart with every kind of color vision, and in print.
BLUE, ORANGE, GREEN, RED = "#0072B2", "#E69F00", "#009E73", "#D55E00"
PURPLE, SKY, BLACK, GRAY = "#CC79A7", "#56B4E9", "#222222", "#8C8C8C"
CYCLE = (BLUE, ORANGE, GREEN, RED, PURPLE, SKY, BLACK)

MISSING = "figures need matplotlib, which is not installed: pip install thing_kin[viz]"


def new_figure(**options: Any) -> Figure:
    """Make an empty figure that needs no display; options as for matplotlib's Figure."""
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise ImportError(MISSING) from error
    return Figure(layout="constrained", **options)


def axes_or_new(axes: Axes | None, **options: Any) -> Axes:
    """Take the given axes, or those of a new figure."""
    return new_figure(**options).add_subplot() if axes is None else axes


def tidy(axes: Axes, *, title: str = "", xlabel: str = "", ylabel: str = "") -> None:
    """Name the axes; a light grid, no box above and to the right."""
    axes.set(title=title, xlabel=xlabel, ylabel=ylabel)
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(visible=True, color="0.9", linewidth=0.6)
    axes.set_axisbelow(True)


def figure_of(axes: Axes) -> Figure:
    """Return the figure that the axes stand in, directly or in a part of it."""
    figure: Figure = axes.figure.figure
    return figure
