"""Problem (4.34) head to head: the same instances, starts and checker for everybody.

    python benchmarks/pose_race.py [SOLVER ...] [--count N] [--peers DIRECTORY] [--out FILE.json]

Solvers take turns at each instance, in one process, on one thread; what is timed is CPU time, the
median of five calls on end.
A success is an answer that Pinocchio, on a model of its own, finds feasible within 1e-5 m and rad.
The best known objective of an instance is the least of all feasible answers and of many starts.
casadi and nlopt are taken from the environment that inverse_peers.py made, if they are not here.
"""

import argparse
import json
import os
import sys
import time
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np

import thing_kin as tk
from pose import Instance, Outside, Solver, entered, gather
from pose.instances import ARM_LIMITS, STARTS, draw
from pose.judge import Judge
from report import machine, shown
from timing import pin_to_one_cpu

Answer = tuple[Any, bool, float]  # q, claim, CPU seconds
NEAR_BEST = 1e-3  # of the best known
CALLS, LONG = 5, 5e-3  # of one instance; s


def one_thread() -> None:
    """Begin anew with linear algebra on one thread, which is asked for before numpy is loaded."""
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
    if any(os.environ.get(name) != "1" for name in names):
        os.environ.update(dict.fromkeys(names, "1"))
        os.execv(sys.executable, [sys.executable, *sys.argv])


def find_peers(directory: Path) -> None:
    """Add what inverse_peers.py installed, after all that is here already."""
    sys.path += [str(path) for path in directory.glob("main/lib/python3*/site-packages")]


def timed(solver: Solver, i: int) -> Answer:
    """The median of a few calls on end, as a loop has them: the first finds cold caches."""
    x = solver.prepare(i)
    times = []
    while len(times) < CALLS:
        start = time.thread_time_ns()
        result = solver.solve(x)
        times.append((time.thread_time_ns() - start) * 1e-9)
        if times[0] > LONG:  # caches do not matter
            break
    return (*solver.answer(result), float(np.median(times)))


def race(solvers: list[Solver], count: int) -> dict[str, list[Answer]]:
    answers: dict[str, list[Answer]] = {}
    here = [solver for solver in solvers if not isinstance(solver, Outside)]
    for solver in solvers:
        answers[solver.name] = solver.all() if isinstance(solver, Outside) else []
    for solver in here:
        timed(solver, 0)  # warm up
    for i in range(count):
        for solver in here[i % len(here) :] + here[: i % len(here)]:
            answers[solver.name].append(timed(solver, i))
    return answers


def best_known(
    instances: list[Instance], answers: dict[str, list[Answer]], judge: Judge, starts: int
) -> Any:
    """(N,): of all answers and of `starts` local searches of ours from random starts."""
    best = np.full(len(instances), np.inf)
    rng = np.random.default_rng(12345)
    for i, x in enumerate(instances):
        found = [answer[i][0] for answer in answers.values()]
        for _ in range(starts):
            plan = tk.plan_pose(
                x.robot,
                x.T,
                seed=rng.uniform(x.lower, x.upper),
                base_goal=x.goal,
                base_radius=x.radius,
                heading=x.heading,
                obstacles=[x.obstacle],
            )
            found.append(plan.q)
        right = [judge.objective(q) for q in found if judge.is_feasible(x, q)]
        best[i] = min(right, default=np.inf)
    return best


def figures(
    instances: list[Instance], answers: list[Answer], judge: Judge, best: Any
) -> dict[str, Any]:
    right = np.array([judge.is_feasible(x, a[0]) for x, a in zip(instances, answers, strict=True)])
    value = np.array(
        [judge.objective(a[0]) if r else np.inf for a, r in zip(answers, right, strict=True)]
    )
    claims, cpu = (np.array([answer[k] for answer in answers]) for k in (1, 2))
    over = value[right] / best[right]
    return {
        "count": len(answers),
        "success": 100.0 * float(right.mean()),
        "claimed": 100.0 * float(claims.mean()),
        "wrong_claims": 100.0 * float((claims & ~right).mean()),
        "best": 100.0 * float((value <= best * (1.0 + NEAR_BEST)).mean()),
        "over_best": float(np.median(over)) if right.any() else None,
        "cpu_median": float(np.median(cpu)),
        "cpu_p99": float(np.quantile(cpu, 0.99)),
    }


def row(title: str, r: dict[str, Any]) -> str:
    over = "none" if r["over_best"] is None else f"{r['over_best']:.3f}"
    return (
        f"  {title:<20} {r['success']:6.1f} % right, {r['wrong_claims']:5.1f} % claimed wrongly, "
        f"best {r['best']:5.1f} %, {over:>6} of it; "
        f"{shown(r['cpu_median']):>8} {shown(r['cpu_p99']):>8}"
    )


def course(options: argparse.Namespace, limits: str, start: str, judge: Judge) -> list[Any]:
    instances = draw(options.count, limits, start, options.seed)
    solvers = list(entered(options.solvers, instances))
    answers = race(solvers, len(instances))
    best = best_known(instances, answers, judge, options.starts)
    print(f"\narm limits +-{limits}, {start} start; median and p99 of CPU time", flush=True)
    found = []
    for solver in solvers:
        result = figures(instances, answers[solver.name], judge, best)
        about = {"limits": limits, "start": start, "solver": solver.name}
        found.append({**about, **result})
        print(row(solver.title, result), flush=True)
    return found


def versions(solver: type[Solver]) -> dict[str, str]:
    found = {}
    for package in solver.packages:
        try:
            found[package] = version(package)
        except PackageNotFoundError:  # a build that is not installed
            found[package] = str(getattr(sys.modules.get(package), "__version__", "?"))
    return found


def main() -> None:
    one_thread()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("solvers", nargs="*", metavar="SOLVER")
    add("--count", type=int, default=200, help="instances a course; default %(default)s")
    add("--seed", type=int, default=20260, help="of the instances; default %(default)s")
    add("--starts", type=int, default=50, help="for the best known; default %(default)s")
    add("--peers", type=Path, default=Path("build/peers"), help="default %(default)s")
    add("--out", type=Path, default=Path("build/pose_race.json"), metavar="FILE.json")
    options = parser.parse_args()
    find_peers(options.peers)
    if unknown := set(options.solvers) - set(gather()):
        parser.error(f"no such solver: {', '.join(sorted(unknown))}")
    pin_to_one_cpu()
    judge = Judge()
    print(f"{options.count} instances of (4.34) a course, drawn with seed {options.seed}")
    results = [
        result
        for limits in ARM_LIMITS
        for start in STARTS
        for result in course(options, limits, start, judge)
    ]
    raced = {result["solver"] for result in results}
    content = {
        "machine": machine(None),
        "seed": options.seed,
        "starts": options.starts,
        "solvers": {
            name: {"title": solver.title, "note": solver.note, **versions(solver)}
            for name, solver in gather().items()
            if name in raced
        },
        "results": results,
    }
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(json.dumps(content, indent=1) + "\n")
    print(options.out)


if __name__ == "__main__":
    main()
