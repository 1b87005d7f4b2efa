"""NLopt's SLSQP in C++: benchmarks/cpp/pose_nlopt.cpp, built with the preset release."""

import subprocess
from pathlib import Path
from typing import Any

import numpy as np

from pose import Instance, Outside, register

PROGRAM = Path("build/release/benchmarks/cpp/pose_nlopt")


@register
class NloptCpp(Outside):
    name = "nlopt_cpp"
    title = "NLopt SLSQP, C++"
    note = "xtol 1e-9, 500 evaluations; functions and Jacobians by thing_kin in C++"

    def __init__(self, instances: list[Instance]) -> None:
        super().__init__(instances)
        if not PROGRAM.exists():
            raise FileNotFoundError(f"{PROGRAM} is not built")

    def all(self) -> list[tuple[Any, bool, float]]:
        rows = [
            np.concatenate(
                [
                    *(x.lower, x.upper, x.T[:3].ravel(), x.goal, [x.radius]),
                    *(x.obstacle.center, [x.obstacle.radius], x.seed),
                ]
            )
            for x in self.instances
        ]
        text = "\n".join(" ".join(repr(float(value)) for value in row) for row in rows)
        done = subprocess.run([PROGRAM], input=text, capture_output=True, text=True, check=True)
        found = np.array([line.split() for line in done.stdout.splitlines()], dtype=float)
        return [(row[:9], bool(row[9]), float(row[10])) for row in found]
