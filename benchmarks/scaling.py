"""Time of a pose against the size of the batch, instructions and threads: figures and a plot.

    python benchmarks/scaling.py [--out FILE.png] [--rounds N] [--most ROWS]

Wall time, as threads are the point; contenders take turns. Needs the extra `viz`.
"""

import argparse
import json
import time
from pathlib import Path
from statistics import median
from typing import Any

import thing_kin as tk
from peers import gather
from problem import Problem
from report import machine, shown
from scaling_lines import WORKS, Line, Run, lines_of
from scaling_plot import draw

SIZES = sorted({a * 10**b for a in (1, 3) for b in range(6)} | {10**6})
SECONDS = 0.002  # of a measurement at least


def seconds(run: Run, Q: Any, calls: int) -> float:
    """Wall time of a call."""
    start = time.perf_counter()
    for _ in range(calls):
        run(Q)
    return (time.perf_counter() - start) / calls


def calls_for(run: Run, Q: Any) -> int:
    """How many last long enough; finding out also warms up."""
    calls = 1
    while True:
        took = seconds(run, Q, calls) * calls
        if took >= SECONDS / 4:
            return max(1, round(calls * SECONDS / took))
        calls *= 4


def measure(lines: list[Line], Q: Any, rounds: int) -> dict[Line, float]:
    """Median seconds of a pose for every line, A B A B ..."""
    runs: dict[Line, tuple[Run, int]] = {}
    for line in lines:
        tk.use_simd_level(line.level)
        run = line.make(len(Q))
        runs[line] = run, calls_for(run, Q)
    times: dict[Line, list[float]] = {line: [] for line in lines}
    for _ in range(rounds):
        for line, (run, calls) in runs.items():
            tk.use_simd_level(line.level)
            times[line].append(seconds(run, Q, calls) / len(Q))
    return {line: median(taken) for line, taken in times.items()}


def scale(problem: Problem, sizes: list[int], rounds: int) -> list[dict[str, Any]]:
    """All works at all sizes; three rounds where one takes seconds."""
    Q, best, peers = problem.robot.random(max(sizes), rng=0), tk.simd_level(), gather(problem)
    results = []
    for work in WORKS:
        lines = list(lines_of(problem.robot, work, peers))
        for size in sizes:
            fitting = [line for line in lines if line.fits(size)]
            taken = measure(fitting, Q[:size], rounds if size < 100_000 else 3)
            results += [{**line.about(), "size": size, "seconds": s} for line, s in taken.items()]
            fastest = min(taken, key=lambda line: taken[line])
            print(f"{work:<16} {size:>8}  {fastest.label:<28} {shown(taken[fastest])}", flush=True)
    tk.use_simd_level(best)
    return results


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("build/scaling.png"), metavar="FILE.png")
    parser.add_argument("--rounds", type=int, default=7, help="default %(default)s")
    parser.add_argument("--most", type=int, default=SIZES[-1], help="rows; default %(default)s")
    parser.add_argument("--redraw", action="store_true", help="from the figures of the last run")
    return parser.parse_args()


def main() -> None:
    options = parse()
    figures = options.out.with_suffix(".json")
    if not options.redraw:
        sizes = [size for size in SIZES if size <= options.most]
        results = scale(Problem(), sizes, options.rounds)
        figures.parent.mkdir(parents=True, exist_ok=True)
        content = {"machine": machine(None), "results": results}
        figures.write_text(json.dumps(content, indent=1) + "\n")
    draw(json.loads(figures.read_text()), options.out)
    print(f"{options.out} and {figures}")


if __name__ == "__main__":
    main()
