"""Random paths with obstacles: how many are followed, and why the others are not.

    python benchmarks/path_soak.py [--count 1000] [--seed 0] [--waypoints 50] [--out FILE.json]

Every path has a solution, which tests/path_cases.py made it from; the robots take turns. A success
is a plan that calls itself one and that Pinocchio and brute force, with 25 points a segment, find
within 1e-6 of every constraint. Needs `pip install pin`.
"""

import argparse
import collections
import json
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np

import thing_kin as tk

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from arms import panda
from path_cases import make_case, worst

TOLERANCE = 1e-6


def robots() -> list[tk.Chain]:
    """Two mobile manipulators of nine joints, one of ten, an arm of seven."""
    return [
        tk.robots.thing(),
        tk.robots.pioneer_lx_ur5(),
        tk.on_omni_base(panda(), name="panda_on_base"),
        panda(),
    ]


def reason(plan: tk.PathPlan) -> str:
    """What failed, without the numbers."""
    text = re.sub(r"\d+", "#", plan.failed_constraint or "")
    return re.sub(r"\(.*?\)|'.*?'", "", text)


def solve(robot: tk.Chain, number: int, waypoints: int) -> dict[str, Any]:
    """One path: what the plan says, and what is so."""
    case = make_case(robot, number, count=waypoints)
    plan = case.plan()
    missed = max(worst(case, plan.q).values())
    return {
        "robot": robot.name,
        "number": number,
        "success": plan.success and missed <= TOLERANCE,
        "wrong": plan.success and missed > TOLERANCE,
        "status": plan.status,
        "reason": "" if plan.success else reason(plan),
        "waypoint": plan.failed_waypoint,
        "violation": missed,
        "iterations": plan.iterations,
        "ms": 1e3 * plan.time,
    }


def table(rows: list[dict[str, Any]]) -> str:
    """A line a robot, then the reasons."""
    lines = [
        "| robot | paths | success | iterations | ms, median | ms, 99 % |",
        "|---|" + "---:|" * 5,
    ]
    names = dict.fromkeys(row["robot"] for row in rows)
    for name in [*names, "all"]:
        some = [row for row in rows if name in (row["robot"], "all")]
        good = [row for row in some if row["success"]]
        ms = [row["ms"] for row in some]
        lines.append(
            f"| {name} | {len(some)} | {100 * len(good) / len(some):.1f} % "
            f"| {np.median([row['iterations'] for row in some]):.0f} "
            f"| {np.median(ms):.1f} | {np.percentile(ms, 99):.0f} |"
        )
    reasons = collections.Counter(row["reason"] for row in rows if not row["success"])
    lines += ["", "| what failed | paths |", "|---|---:|"]
    lines += [
        f"| {what or 'wrongly called a success'} | {n} |" for what, n in reasons.most_common()
    ]
    return "\n".join(lines)


def main() -> None:
    """Run the soak."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--waypoints", type=int, default=50)
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    print(f"seed {arguments.seed}, {arguments.waypoints} waypoints")
    fleet = robots()
    rows = []
    for i in range(arguments.count):
        row = solve(fleet[i % len(fleet)], 10_000 * arguments.seed + i, arguments.waypoints)
        rows.append(row)
        if not row["success"]:
            print({k: row[k] for k in ("robot", "number", "status", "reason", "waypoint")})
    print(table(rows))
    if arguments.out:
        arguments.out.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    sys.exit(any(row["wrong"] for row in rows))


if __name__ == "__main__":
    main()
