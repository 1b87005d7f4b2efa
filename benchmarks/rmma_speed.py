"""How long the experiment takes: the thesis's grid, an entry of 1000 runs, on all cores and on one.

python benchmarks/rmma_speed.py
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

from thing_kin import rmma


def seconds(call: Callable[[], object], rounds: int = 5) -> float:
    """Median of several."""
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def grid(workers: int | None) -> None:
    """3 arrangements, 5 velocities, 10 runs, 3 methods: what the thesis took days for."""
    for arrangement in (1, 2, 3):
        for method in ("spiral", "linear_kf", "ukf"):
            rmma.run(arrangement, method, runs=10, rng=0, workers=workers)


def main() -> None:
    grid(None)
    for workers in (None, 1):
        print(f"workers={workers}")
        print(f"  the thesis's grid, 450 runs: {seconds(lambda w=workers: grid(w)):.3f} s")
        for method in ("spiral", "linear_kf", "ukf", "covering"):
            taken = seconds(
                lambda w=workers, m=method: rmma.run(1, m, (0.02,), runs=1000, rng=0, workers=w), 3
            )
            print(f"  1000 runs of {method}, arrangement 1, 2 cm/s: {taken:.3f} s")


if __name__ == "__main__":
    main()
