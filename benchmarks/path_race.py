"""The path of user script 05 in 50 and 500 waypoints: plan_path beside CasADi + IPOPT.

python benchmarks/path_race.py [--counts 50 500] [--rounds N] [--out FILE.json]
"""

import argparse
import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from path import Course, course, ours
from path.casadi_ipopt import ITERATIONS, CasadiIpopt
from pose_race import find_peers, one_thread
from report import machine, shown
from timing import pin_to_one_cpu

Solve = Callable[[], tuple[Any, bool, int]]


def measured(title: str, problem: Course, solve: Solve, rounds: int) -> dict[str, Any]:
    times = []
    for _ in range(rounds):
        begin = time.thread_time_ns()
        q, claim, iterations = solve()
        times.append((time.thread_time_ns() - begin) * 1e-9)
    result = {
        "title": title,
        "count": len(q),
        "objective": problem.objective(q),
        "violation": problem.violation(q),
        "claimed": bool(claim),
        "iterations": int(iterations),
        "cpu_median": float(np.median(times)),
    }
    print(
        f"  {title:<18} {len(q):>4} waypoints: objective {result['objective']:.6f}, violation "
        f"{result['violation']:.1e}, {iterations} iterations, {shown(result['cpu_median'])}",
        flush=True,
    )
    return result


def run(counts: list[int], rounds: int) -> list[dict[str, Any]]:
    results = []
    for count in counts:
        problem = course(count)
        results.append(
            measured("thing_kin.plan_path", problem, lambda p=problem: ours.solve(p), rounds)
        )
        try:
            peer = CasadiIpopt(problem)
        except ImportError as reason:
            print(f"  CasADi + IPOPT: absent: {reason}")
            continue
        results.append(measured("CasADi + IPOPT", problem, peer.solve, 1))
    return results


def main() -> None:
    one_thread()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("--counts", type=int, nargs="+", default=[50, 500], metavar="N")
    add("--rounds", type=int, default=9, help="of thing_kin; default %(default)s")
    add("--peers", type=Path, default=Path("build/peers"), help="default %(default)s")
    add("--out", type=Path, default=Path("build/path_race.json"), metavar="FILE.json")
    options = parser.parse_args()
    find_peers(options.peers)
    pin_to_one_cpu()
    content = {
        "machine": machine(None),
        "most_iterations": ITERATIONS,
        "results": run(options.counts, options.rounds),
    }
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(json.dumps(content, indent=1) + "\n")


if __name__ == "__main__":
    main()
