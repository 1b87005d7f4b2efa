"""The figures of inverse_race.py as a picture: how much is solved in how much time."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import EngFormatter

Style = dict[str, Any]
DASHED = (0, (3, 1.5))
STYLES: dict[str, Style] = {
    "thing_kin": {"color": "#08519c", "lw": 2.6},
    "thing_kin_alone": {"color": "#6baed6", "lw": 1.8},
    "thing_kin_all": {"color": "#08519c", "lw": 2.0, "ls": DASHED},
    "thing_kin_kdl": {"color": "0.45", "lw": 1.6, "ls": DASHED},
    "rtb": {"color": "#2ca02c", "lw": 1.8},
    "trac_ik_5": {"color": "#e6850e", "lw": 1.6, "ls": DASHED},
    "trac_ik_50": {"color": "#e6850e", "lw": 1.8},
    "eaik": {"color": "#c2185b", "lw": 1.8},
    "pykdl": {"color": "0.45", "lw": 1.8},
    "pink": {"color": "#d98fb5", "lw": 1.8},
    "mink": {"color": "#17a2b8", "lw": 1.8},
    "placo": {"color": "#8c6d4f", "lw": 1.8},
}
COLUMNS = 3


def label_axes(axes: Axes, title: str) -> None:
    axes.set_title(title, fontsize=10)
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter(EngFormatter("s", sep=" "))
    axes.set_ylim(0, 101)
    axes.tick_params(labelsize=8.5)
    axes.grid(True, color="0.9", lw=0.6)
    axes.spines[["top", "right"]].set_visible(False)


def draw(content: dict[str, Any], path: Path) -> None:
    """Write the picture: a panel a robot."""
    robots, machine = content["robots"], content["machine"]
    rows = -(-len(robots) // COLUMNS)
    figure = Figure(figsize=(11, 1.1 + 3.1 * rows), layout="constrained")
    panels = list(figure.subplots(rows, COLUMNS, sharex=True, sharey=True, squeeze=False).flat)
    for axes, (robot, title) in zip(panels, robots.items(), strict=False):
        label_axes(axes, title)
        for result in (r for r in content["results"] if r["robot"] == robot and r["curve"]):
            seconds, share = zip(*result["curve"], strict=True)
            axes.plot(seconds, share, **STYLES.get(result["solver"], {"color": "k"}))
    for axes in panels[len(robots) :]:
        axes.set_visible(False)
    for axes in panels[: len(robots)][-COLUMNS:]:
        axes.set_xlabel("CPU time of a target", fontsize=9)
    figure.supylabel("targets solved within it, %", fontsize=9)
    seen = {r["solver"]: r["title"] for r in content["results"]}
    handles = [Line2D([], [], label=seen[s], **style) for s, style in STYLES.items() if s in seen]
    figure.legend(handles=handles, loc="outside lower center", ncols=6, frameon=False, fontsize=9)
    figure.suptitle(f"1e-5 m, 1e-5 rad, within limits · {machine['cpu']}", fontsize=10)
    figure.savefig(path, dpi=110)
