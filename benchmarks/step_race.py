"""One differential step within limits, head to head: the hand's pose, the base's pose, a posture.

    python benchmarks/step_race.py [--count N] [--peers DIRECTORY] [--out FILE.json]

The Thing at random configurations, in each of which two joints are at, or close to, a limit; the
hand's target is up to a tenth of a radian or a meter a joint away, the base's half of that. A step
of 0.05 s has to keep joint and velocity limits, to 1e-6.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

import thing_kin as tk
from inverse import gather
from inverse.contest import AbsentError, Contender, race
from inverse.field import WARM_UP, Course, course
from inverse.results import times
from inverse.steps import DT
from report import machine, shown

AWAY = 0.1  # rad or m a joint
SLACK = 1e-6


def laid_out(count: int, directory: Path) -> tuple[Course, Any]:
    """The course, and the configurations at which steps begin."""
    laid = course("thing", count, directory)
    chain, rng = tk.robots.thing(order="base_first"), np.random.default_rng(3)
    Q = chain.random(count + WARM_UP, rng=rng)
    for q in Q:
        for joint in rng.choice(chain.n, 2, replace=False):
            near = rng.choice([0.0, 0.0, 1e-3])
            upper = rng.random() < 0.5
            q[joint] = chain.upper[joint] - near if upper else chain.lower[joint] + near
    goals = np.clip(Q + rng.uniform(-AWAY, AWAY, Q.shape), chain.lower, chain.upper)
    targets = chain.fk(goals)
    np.savez(laid.file, targets=targets, seeds=Q)
    return Course(laid.arm, laid.file, targets[:count], laid.judge), Q[:count]


def hand_error(laid: Course, q: Any, T: Any) -> float:
    """Meters and radians alike, by Pinocchio."""
    found = laid.judge.fk(q).homogeneous
    turned = np.linalg.norm(found[:3, :3] - T[:3, :3]) / np.sqrt(2.0)
    return float(np.hypot(np.linalg.norm(found[:3, 3] - T[:3, 3]), turned))


def figures(laid: Course, starts: Any, answers: list[Any]) -> dict[str, Any]:
    """How many steps keep the limits, what they leave of the hand's error, and their times."""
    chain = tk.robots.thing(order="base_first")
    kept, left = [], []
    for (q, *_), start, T in zip(answers, starts, laid.targets, strict=False):
        beyond = np.maximum(chain.lower - q, q - chain.upper).max()
        fast = (np.abs(np.subtract(q, start)) - DT * chain.velocity_limits).max()
        kept.append(max(beyond, fast) <= SLACK)
        left.append(hand_error(laid, q, T) / hand_error(laid, start, T))
    return {
        "count": len(answers),
        "kept": 100.0 * float(np.mean(kept)),
        "left": 100.0 * float(np.median(left)),
        "left_mean": 100.0 * float(np.mean(left)),
        **times("cpu", [cpu for _, _, cpu, _ in answers]),
        **times("wall", [wall for _, _, _, wall in answers]),
    }


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=10_000, help="steps; default %(default)s")
    parser.add_argument(
        "--seconds", type=float, default=10.0, help="a solver's; default %(default)s"
    )
    parser.add_argument(
        "--peers", type=Path, default=Path("build/peers"), help="default %(default)s"
    )
    parser.add_argument(
        "--out", type=Path, default=Path("build/step_race.json"), metavar="FILE.json"
    )
    return parser.parse_args()


def main() -> None:
    options = parse()
    results, about = [], machine(None)
    with tempfile.TemporaryDirectory() as directory:
        laid, starts = laid_out(options.count, Path(directory))
        field = []
        for solver in gather("steps").values():
            python = options.peers / solver.environment / "bin" / "python"
            own = solver.environment and python.exists()
            try:
                field.append(Contender(solver, str(python) if own else sys.executable))
            except AbsentError as reason:
                print(f"  {solver.title:<12} absent: {reason}")
        for name, answers in race(laid, field, options.seconds).items():
            solver = gather("steps")[name]
            result = figures(laid, starts, answers)
            results.append({"solver": name, "title": solver.title, "note": solver.note, **result})
            cpu = " / ".join(shown(result[f"cpu_{x}"]) for x in ("median", "mean", "p99"))
            print(
                f"  {solver.title:<12} {cpu}; limits kept {result['kept']:.2f} %; left of the "
                f"hand's error {result['left']:.2f} %, mean {result['left_mean']:.2f} %"
            )
        for contender in field:
            contender.close()
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(json.dumps({"machine": about, "results": results}, indent=1) + "\n")


if __name__ == "__main__":
    main()
