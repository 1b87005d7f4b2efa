"""Markdown tables of inverse_race.py's and step_race.py's figures, in the form of markdown.py."""

from typing import Any

from figures import Figures
from markdown import NONE, table, time

FILE = "inverse_race.json"
STEPS = "step_race.json"
Result = dict[str, Any]


def results(figures: Figures) -> list[Result]:
    found: list[Result] = figures.content(FILE)["results"]
    return found


def share(percent: float) -> str:
    """Hundredths only where they tell something."""
    return f"{percent:.{0 if percent in (0.0, 100.0) else 2}f} %"


def cell(result: Result | None) -> str:
    if result is None:
        return NONE
    times = " / ".join(time(result[f"cpu_{x}"]) for x in ("median", "mean", "p99"))
    return f"{share(result['success'])}, {times}"


def by_solver(figures: Figures) -> dict[str, list[Result]]:
    """In the order of the race."""
    names = figures.content(FILE)["solvers"]
    return {name: [r for r in results(figures) if r["solver"] == name] for name in names}


def inverse(figures: Figures) -> str:
    """A column a robot."""
    robots, solvers = figures.content(FILE)["robots"], figures.content(FILE)["solvers"]
    rows = []
    for name, found in by_solver(figures).items():
        at = {result["robot"]: result for result in found}
        rows.append([solvers[name]["title"], *(cell(at.get(robot)) for robot in robots)])
    return table(["", *(title.partition(",")[0] for title in robots.values())], rows)


def spread(values: list[int]) -> str:
    low, high = min(values), max(values)
    return str(high) if low == high else f"{low} to {high}"


def inverse_claims(figures: Figures) -> str:
    """What the solvers say of their answers, over all robots."""
    solvers = figures.content(FILE)["solvers"]
    rows = []
    for name, found in by_solver(figures).items():
        if not found:
            continue
        total = sum(result["count"] for result in found)

        def over_all(key: str, found: list[Result] = found, total: int = total) -> str:
            return share(sum(r["count"] * r[key] for r in found) / total)

        wall = sum(r["count"] * r["wall_mean"] for r in found) / total
        cpu = sum(r["count"] * r["cpu_mean"] for r in found) / total
        shares = [over_all(key) for key in ("success", "claimed", "wrong_claims", "unclaimed")]
        targets = spread([result["count"] for result in found])
        rows.append([solvers[name]["title"], targets, *shares, time(wall), f"{wall / cpu:.2f}"])
    head = "targets a robot, right, said to be right, of them wrong, right but not said"
    return table(["", *head.split(", "), "mean wall time", "wall / CPU"], rows)


def inverse_setup(figures: Figures) -> str:
    """Versions, and what was chosen."""
    rows = []
    for about in figures.content(FILE)["solvers"].values():
        packages = {k: v for k, v in about.items() if k not in ("title", "note", "python")}
        versions = ", ".join(f"{name} {version}" for name, version in packages.items())
        rows.append([about["title"], versions or NONE, about["note"]])
    return table(["", "versions", "set-up"], rows)


def inverse_steps(figures: Figures) -> str:
    """One differential step within limits."""
    rows = [
        [
            f"{result['title']}: {result['note']}",
            " / ".join(time(result[f"cpu_{x}"]) for x in ("median", "mean", "p99")),
            share(result["kept"]),
            f"{result['left']:.2f} %, {result['left_mean']:.1f} %",
        ]
        for result in figures.content(STEPS)["results"]
    ]
    head = ["", "median / mean / p99", "limits kept", "hand's error that is left: median, mean"]
    return table(head, rows)
