"""The figures of scaling.py as a picture: a panel each, and one for what memory costs."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import EngFormatter, FuncFormatter

Result = dict[str, Any]

DASHED = (0, (3, 1.5))
MATRIX, QUATERNION = "#08519c", "#c2185b"
TITLES = {
    "fk": "fk: pose as 4x4 matrix",
    "fk_quaternion": "fk_quaternion: position and quaternion",
    "fk_and_jacobian": "fk_and_jacobian",
}
COLORS = {"avx512": "#08519c", "avx2": "#e6850e", "baseline": "#2ca02c"}
GRAYS = {"numpy_vectorized": "0.45", "pinocchio": "0.7"}
NAMES = {"numpy_vectorized": "numpy, vectorized", "pinocchio": "Pinocchio, loop"}


def of(results: list[Result], **wanted: Any) -> tuple[list[int], list[float]]:
    """Sizes and times of one line."""
    found = [r for r in results if all(r[key] == value for key, value in wanted.items())]
    return [r["size"] for r in found], [r["seconds"] for r in found]


def panel(axes: Axes, results: list[Result], work: str) -> None:
    for who, gray in GRAYS.items():
        axes.loglog(*of(results, work=work, who=who), color=gray, lw=2)
    for level, color in COLORS.items():
        line = {"work": work, "who": "thing_kin", "level": level, "out": False}
        axes.loglog(*of(results, **line, threads=1), color=color, lw=1.8)
        axes.loglog(*of(results, **line, threads=None), color=color, lw=1.8, ls=DASHED)
    axes.set_title(TITLES[work], fontsize=10)


def memory_panel(axes: Axes, results: list[Result], level: str) -> None:
    """Large batches at the best level, on a linear scale."""
    for work, color in (("fk", MATRIX), ("fk_quaternion", QUATERNION)):
        for out, marker in ((False, "o"), (True, "s")):
            for threads, style in ((1, "-"), (None, DASHED)):
                line = {"work": work, "who": "thing_kin", "level": level, "out": out}
                sizes, times = of(results, **line, threads=threads)
                large = [(n, t) for n, t in zip(sizes, times, strict=True) if n >= 10_000]
                face = color if out else "white"
                axes.semilogx(
                    *zip(*large, strict=True), color=color, marker=marker, mfc=face, ms=5, ls=style
                )
    axes.set_ylim(bottom=0)
    axes.set_title(f"what out= and quaternions give ({level})", fontsize=10)


def legend_of_panels(figure: Figure, levels: list[str], peers: list[str]) -> None:
    handles = [Line2D([], [], color=COLORS[level], lw=2, label=level) for level in levels]
    handles += [
        Line2D([], [], color="0.2", lw=1.8, label="one thread"),
        Line2D([], [], color="0.2", lw=1.8, ls=DASHED, label="all threads"),
    ]
    handles += [Line2D([], [], color=GRAYS[w], lw=2, label=NAMES[w]) for w in GRAYS if w in peers]
    figure.legend(handles=handles, loc="outside lower center", ncols=7, frameon=False, fontsize=9)


def legend_of_memory(axes: Axes) -> None:
    handles = [
        Line2D([], [], color=MATRIX, lw=2, label="4x4 matrix, 128 bytes"),
        Line2D([], [], color=QUATERNION, lw=2, label="quaternion, 56 bytes"),
        Line2D([], [], ls="", marker="o", ms=5, color="0.2", mfc="white", label="new array"),
        Line2D([], [], ls="", marker="s", ms=5, color="0.2", label="out="),
    ]
    axes.legend(handles=handles, loc="upper center", ncols=2, frameon=False, fontsize=8.5)
    axes.set_ylim(top=axes.get_ylim()[1] * 1.3)  # room for it


def label_axes(axes: Axes) -> None:
    axes.set_xlabel("poses in a batch", fontsize=9)
    axes.set_ylabel("wall time of a pose", fontsize=9)
    axes.tick_params(labelsize=9)
    axes.grid(True, color="0.9", lw=0.6)
    axes.spines[["top", "right"]].set_visible(False)


def draw(content: dict[str, Any], path: Path) -> None:
    """Write the picture."""
    results, machine = content["results"], content["machine"]
    level = machine["simd_level"]
    figure = Figure(figsize=(10, 8.2), layout="constrained")
    *panels, last = figure.subplots(2, 2).flat
    for axes, work in zip(panels, TITLES, strict=True):
        panel(axes, results, work)
        label_axes(axes)
        axes.yaxis.set_major_formatter(EngFormatter("s"))
        axes.sharey(panels[0])
    memory_panel(last, results, level)
    label_axes(last)
    last.yaxis.set_major_formatter(FuncFormatter(lambda s, _: f"{s * 1e9:.0f} ns"))
    legend_of_memory(last)
    legend_of_panels(
        figure,
        [x for x in COLORS if any(r["level"] == x for r in results)],
        [w for w in GRAYS if any(r["who"] == w for r in results)],
    )
    figure.suptitle(f"The Thing, 9 joints · {machine['cpu']}, {machine['cpus']} cpus", fontsize=10)
    figure.savefig(path, dpi=110)
