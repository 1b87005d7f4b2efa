"""Markdown tables of pose_race.py's figures, in the form of markdown.py."""

from typing import Any

from figures import Figures
from inverse_tables import share
from markdown import NONE, table, time

FILE = "pose_race.json"
PATHS = "path_race.json"
LIMITS = {"2pi": "±2 pi", "pi": "±pi"}


def cell(result: dict[str, Any] | None) -> str:
    """Feasible; of these wrongly claimed not counted; best; median and 99 % of CPU time."""
    if result is None:
        return NONE
    times = " / ".join(time(result[f"cpu_{x}"]) for x in ("median", "p99"))
    return f"{share(result['success'])}, best {share(result['best'])}, {times}"


def pose(figures: Figures) -> str:
    """A column for each start and limits of the arm."""
    content = figures.content(FILE)
    results, solvers = content["results"], content["solvers"]
    courses = list(dict.fromkeys((r["start"], r["limits"]) for r in results))
    rows = []
    for name, about in solvers.items():
        at = {(r["start"], r["limits"]): r for r in results if r["solver"] == name}
        rows.append([about["title"], *(cell(at.get(course)) for course in courses)])
    head = [f"{start} start, arm {LIMITS[limits]}" for start, limits in courses]
    return table(["", *head], rows)


def pose_claims(figures: Figures) -> str:
    """What solvers say of their answers, and how far these are from the best known."""
    content = figures.content(FILE)
    rows = []
    for name, about in content["solvers"].items():
        found = [r for r in content["results"] if r["solver"] == name]
        total = sum(r["count"] for r in found)
        shares = [
            share(sum(r["count"] * r[key] for r in found) / total)
            for key in ("success", "claimed", "wrong_claims")
        ]
        over = [r["over_best"] for r in found if r["over_best"] is not None]
        worst = f"{max(over):.3f}" if over else NONE
        rows.append([about["title"], str(total), *shares, worst])
    head = "instances, feasible, said to be, wrongly, objective over the best known: worst median"
    return table(["", *head.split(", ")], rows)


def pose_setup(figures: Figures) -> str:
    """Versions, and what was chosen."""
    rows = []
    for about in figures.content(FILE)["solvers"].values():
        packages = {k: v for k, v in about.items() if k not in ("title", "note")}
        versions = ", ".join(f"{name} {version}" for name, version in packages.items())
        rows.append([about["title"], versions or NONE, about["note"]])
    return table(["", "versions", "set-up"], rows)


def pose_paths(figures: Figures) -> str:
    """The path of user script 05: objective, violation, iterations, CPU time."""
    rows = [
        [
            f"{result['title']}, {result['count']} waypoints",
            f"{result['objective']:.6f}",
            f"{result['violation']:.1e}",
            str(result["iterations"]),
            time(result["cpu_median"]),
        ]
        for result in figures.content(PATHS)["results"]
    ]
    return table(["", "objective", "largest violation", "iterations", "CPU time"], rows)
