"""thing_kin beside its peers, interleaved in one process: the table that users read.

    python benchmarks/compare.py [--rounds N] [--level LEVEL] [--json FILE] [WORK ...]

A ratio is the peer's median over thing_kin's, so that 2 means twice as fast as the peer. Every
peer's answers are checked against thing_kin's before it is timed. Times are CPU times.
"""

import argparse
import json
from pathlib import Path

import numpy as np

import thing_kin as tk
from import_time import interleaved_imports
from peers import Peer, gather
from problem import IMPORT, WORKS, Problem, Work, agree
from report import HEADER, Line, lines_of, machine, rows, summary
from timing import Call, interleaved, pin_to_one_cpu

CHECKED = 64  # inputs of each work on which the answers are compared
NAMES = [work.name for work in (*WORKS, IMPORT)]
LEVELS = ("baseline", "avx2", "avx512")


def is_right(work: Work, peer: Peer, reference: Peer, problem: Problem) -> bool:
    function, expected = peer.works()[work.name], reference.works()[work.name]
    return all(
        agree(expected(x), peer.answer(work.name, function(peer.prepare(work.name, x))))
        for x in problem.inputs[work.name][:CHECKED]
    )


def contender(work: Work, peer: Peer, problem: Problem) -> Call:
    return peer.works()[work.name], [peer.prepare(work.name, x) for x in problem.inputs[work.name]]


def compare(work: Work, peers: list[Peer], problem: Problem, rounds: int) -> list[Line]:
    able = [peer for peer in peers if work.name in peer.works()]
    right = [peer for peer in able if is_right(work, peer, able[0], problem)]
    times = interleaved({p.name: contender(work, p, problem) for p in right}, rounds)
    lines = list(lines_of(work, times))
    wrong = [p.name for p in able if p not in right]
    return lines + [Line(work, name, np.nan, lines[0].ours, True) for name in wrong]


def record(line: Line) -> dict[str, str | float | bool]:
    about = {"work": line.work.name, "title": line.work.title, "peer": line.peer}
    if line.wrong:
        return {**about, "wrong": True}
    return {**about, "seconds": line.seconds, "ratio": line.ratio}


def write(path: Path, about: dict[str, str | int | None], lines: list[Line]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    results = [record(line) for line in lines]
    path.write_text(json.dumps({"machine": about, "results": results}, indent=2) + "\n")


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("works", nargs="*", metavar="WORK", help=f"of {', '.join(NAMES)}")
    parser.add_argument("--rounds", type=int, default=9, help="at least 7; default %(default)s")
    parser.add_argument("--level", choices=LEVELS, help="instructions; default: the best here")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures there too")
    options = parser.parse_args()
    if unknown := set(options.works) - set(NAMES):
        parser.error(f"no such work: {', '.join(sorted(unknown))}")
    if options.rounds < 7:
        parser.error("a median needs at least 7 rounds")
    return options


def introduce(about: dict[str, str | int | None], peers: list[Peer]) -> None:
    print(", ".join(f"{key}: {value}" for key, value in about.items()))
    for peer in peers:
        print(f"  {peer.name:<17} {peer.note}")
    print(f"\n{HEADER}\n{'-' * len(HEADER)}")


def main() -> None:
    options = parse()
    if options.level:
        tk.use_simd_level(options.level)
    problem = Problem()
    peers, about = gather(problem), machine(pin_to_one_cpu())
    introduce(about, peers)
    lines: list[Line] = []
    for work in (*WORKS, IMPORT):
        if work.name not in (options.works or NAMES):
            continue
        if work is IMPORT:
            new = list(lines_of(IMPORT, interleaved_imports(options.rounds)))
        else:
            new = compare(work, peers, problem, options.rounds)
        lines += new
        print(*rows(new), sep="\n", flush=True)
    print(f"\n{summary(lines)}")
    if options.json:
        write(options.json, about, lines)


if __name__ == "__main__":
    main()
