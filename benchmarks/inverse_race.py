"""Inverse kinematics head to head: the same targets, seeds, tolerance and checker for everybody.

    python benchmarks/inverse_race.py [--count N] [--seconds S] [--peers DIRECTORY] [--out FILE.png]

Each solver runs in a process of its own, in the environment that inverse_peers.py made for it
(thing_kin's own where there is none), and has S seconds a robot: slow ones get to fewer targets.
A success is an answer that Pinocchio finds within 1e-5 m and 1e-5 rad of the target, and within the
limits. Writes FILE.json and a plot.
"""

import argparse
import json
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from inverse import gather
from inverse.contest import AbsentError, Contender, race
from inverse.field import ROBOTS, courses
from inverse.results import figures
from inverse_plot import draw
from report import machine, shown

Result = dict[str, Any]


def contenders(names: list[str], peers: Path) -> Iterator[Contender]:
    """Those that are installed, and a line about each."""
    for name, solver in gather().items():
        if names and name not in names:
            continue
        python = peers / solver.environment / "bin" / "python"
        own = solver.environment and python.exists()
        try:
            contender = Contender(solver, str(python) if own else sys.executable)
        except AbsentError as reason:
            print(f"  {solver.title:<18} absent: {reason}")
            continue
        versions = ", ".join(f"{p} {v}" for p, v in contender.versions.items() if p != "python")
        print(f"  {solver.title:<18} {versions or 'version unknown'}: {solver.note}", flush=True)
        yield contender


def row(title: str, result: Result) -> str:
    cpu = " ".join(f"{shown(result[f'cpu_{x}']):>8}" for x in ("median", "mean", "p99"))
    return (
        f"  {title:<18} {result['success']:7.2f} % of {result['count']:>5}, "
        f"claims {result['claimed']:6.2f} %, {result['wrong_claims']:5.2f} % wrongly; {cpu}"
    )


def run(options: argparse.Namespace, directory: Path) -> dict[str, Any]:
    field = list(contenders(options.solvers, options.peers))
    results: list[Result] = []
    for course in courses(options.robots, options.count, directory):
        print(
            f"\n{course.arm.title}: success, claims; median, mean and p99 of CPU time", flush=True
        )
        for name, answers in race(course, field, options.seconds).items():
            if not answers:
                continue
            solver = gather()[name]
            about = {"robot": course.arm.name, "solver": name, "title": solver.title}
            results.append({**about, **figures(course, answers)})
            print(row(solver.title, results[-1]), flush=True)
    for contender in field:
        contender.close()
    return {
        "machine": machine(None),
        "robots": {name: ROBOTS[name][0] for name in options.robots},
        "solvers": {
            c.solver.name: {"title": c.solver.title, "note": c.solver.note, **c.versions}
            for c in field
        },
        "results": results,
    }


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("solvers", nargs="*", metavar="SOLVER", help=f"of {', '.join(gather())}")
    add("--robots", nargs="+", default=list(ROBOTS), choices=ROBOTS, metavar="ROBOT")
    add("--count", type=int, default=10_000, help="targets a robot; default %(default)s")
    add("--seconds", type=float, default=6.0, help="of a solver and robot; default %(default)s")
    add("--peers", type=Path, default=Path("build/peers"), help="default %(default)s")
    add("--out", type=Path, default=Path("build/inverse_race.png"), metavar="FILE.png")
    add("--redraw", action="store_true", help="from the figures of the last run")
    options = parser.parse_args()
    if unknown := set(options.solvers) - set(gather()):
        parser.error(f"no such solver: {', '.join(sorted(unknown))}")
    return options


def main() -> None:
    options = parse()
    file = options.out.with_suffix(".json")
    if not options.redraw:
        file.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as directory:
            content = run(options, Path(directory))
        file.write_text(json.dumps(content, indent=1) + "\n")
    draw(json.loads(file.read_text()), options.out)
    print(f"{options.out} and {file}")


if __name__ == "__main__":
    main()
