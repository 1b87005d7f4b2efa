"""The reproduction as a report, CSV files and figures."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import thing_kin as tk
from thing_kin.rmma import discussion, thesis
from thing_kin.rmma.records import write_csv

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from thing_kin.rmma.experiment import Method
    from thing_kin.rmma.reproduction import Reproduction

TRACED = 0.02  # m/s: velocity of the runs that are drawn
HEAD = """# The RMMA experiment, [X21] chapter 5

thing_kin {version}; {runs} runs at each of five velocities, {covering} with the covering search;
seed {seed}. [X21]: J. Xie, *Stochastic Modeling for Mobile Manipulators*, 2021. Its figures are
those printed, with misprints set right. The world is a kinematic one whose unknowns were fitted to
the spiral's figures alone; "sd" is how much the thesis's protocol of ten runs scatters in it.
"""


KINDS = {
    "figures": "The thesis's figures: what matches, and what does not",
    "claims": "What the thesis says of them",
    "library": "The reference simulation, and the better search",
}


def report(done: Reproduction) -> str:
    """Lay out discussion, checks and tables as Markdown."""
    results = done.results
    head = HEAD.format(
        version=tk.__version__,
        runs=results[1, "spiral", None].runs,
        covering=results[1, "covering", None].runs,
        seed=done.seed,
    )
    findings = discussion.discuss(results, done.worlds)
    failed = [claim for claim, holds in done.checks.items() if not holds]
    checked = f"{len(done.checks) - len(failed)} of {len(done.checks)} hold" + (
        "; not: " + "; ".join(failed) if failed else ""
    )
    return "\n".join(
        [
            head,
            *_sections(findings),
            "## Checks\n",
            checked + ". What so few runs cannot tell from noise passes.",
            "",
            "## Misprints of the thesis, and what is right\n",
            *(f"- {e.where}: {e.printed}; {e.right}" for e in thesis.ERRATA),
            "",
            "## Tables\n",
            *(f"```text\n{table}\n```\n" for table in done.tables()),
        ]
    )


def write(done: Reproduction, out: Path, *, plots: bool, animation: bool) -> list[str]:
    """Write report, CSV files and figures; returns their names."""
    out.mkdir(parents=True, exist_ok=True)
    text = report(done)
    names = ["report.md", "results.csv", "velocities.csv", "fiducials.csv", "worlds.csv"]
    names += [done.practice.to_csv(out / "which_search_when.csv").name]
    done.grid.to_csv(out / "results.csv")
    done.worlds.to_csv(out / "worlds.csv")
    write_csv(out / "velocities.csv", _by(done, "velocity"))
    write_csv(out / "fiducials.csv", _by(done, "fiducial"))
    if plots:
        figures = _write_figures(done, out, animation)
        text += "\n## Figures\n\n" + "\n".join(f"![{name}]({name})\n" for name in figures)
        names += figures
    (out / "report.md").write_text(text, encoding="utf-8")
    return names


def _sections(findings: Sequence[discussion.Finding]) -> Iterator[str]:
    """Yield findings by kind, those that hold first."""
    for kind, title in KINDS.items():
        yield f"## {title}\n"
        for holds in (True, False):
            word = "Yes" if holds else "No"
            some = [f for f in findings if f.kind == kind and f.holds is holds]
            yield from (f"- **{word}**: {f.statement}: {f.evidence}." for f in some)
        yield ""


def _by(done: Reproduction, what: str) -> dict[str, list[Any]]:
    """Columns of the measures by velocity or by fiducial."""
    columns: dict[str, list[Any]] = {"arrangement": [], "method": [], "config": [], what: []}
    measures = ("interception_rate", "search_time", "position_error")
    columns |= {name: [] for name in measures}
    for (arrangement, method, config), result in done.results.items():
        by = result.velocities if what == "velocity" else range(1, len(result.registered) + 1)
        for k, value in enumerate(by):
            columns["arrangement"].append(arrangement)
            columns["method"].append(method)
            columns["config"].append(config)
            columns[what].append(float(value) if what == "velocity" else int(value))
            for name in measures:
                columns[name].append(float(getattr(result, f"{name}_by_{what}")[k]))
    return columns


def _write_figures(done: Reproduction, out: Path, animation: bool) -> list[str]:
    from thing_kin import rmma, viz

    makers = figure_makers(done)
    for name, make in makers.items():
        make().savefig(out / name, dpi=120)
    if not animation:
        return list(makers)
    trace = rmma.trace(1, "ukf", velocity=TRACED, rng=done.seed)
    viz.animate_rmma_run(trace, out / "run_ukf.gif")
    return [*makers, "run_ukf.gif"]


def figure_makers(done: Reproduction) -> dict[str, Callable[[], Figure]]:
    """Return what draws each figure, by the name of its file."""
    from thing_kin import viz

    return {
        "arrangements.png": viz.plot_rmma_arrangements,
        **{
            f"figure_5_{k}.png": partial(viz.plot_rmma_thesis_figure, f"5.{k}", done.results)
            for k in range(1, 9)
        },
        **{f"methods_{k}.png": partial(_methods, done, k) for k in (1, 2, 3)},
        "run_ukf.png": partial(_run, done, "ukf"),
        "run_covering.png": partial(_run, done, "covering"),
        "which_search_when.png": partial(viz.plot_rmma_practice, done.practice),
    }


def _run(done: Reproduction, method: Method) -> Figure:
    from thing_kin import rmma, viz

    trace = rmma.trace(1, method, velocity=TRACED, rng=done.seed)
    return viz.plot_rmma_run(trace, detection_radius=rmma.World().detection_radius)


def _methods(done: Reproduction, arrangement: int) -> Figure:
    from thing_kin import viz

    config = thesis.TABLE_5_2_CONFIGURATION[arrangement]
    keys = {"spiral": None, "linear_kf": 6, "ukf": config}
    keys |= dict.fromkeys(("covering, no odometry", "covering, odometry on failure", "covering"))
    figure = viz.plot_rmma_methods(
        {name: done.results[arrangement, name, c] for name, c in keys.items()}
    )
    figure.suptitle(f"all methods, arrangement #{arrangement}")
    return figure
