"""Search methods in worlds that they were not made for: rates and times as distributions.

python benchmarks/rmma_family.py [--first 100] [--worlds 200] [--runs 4] [--out family.csv]

The worlds are those of tests/rmma_family.py, one a seed; its head says what differs.
"""

from __future__ import annotations

import argparse
import csv
import sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from rmma_family import Family, draw
from thing_kin import rmma

VELOCITIES = (0.01, 0.02, 0.03)
METHODS: dict[str, dict[str, object]] = {
    "spiral": {"method": "spiral"},
    "ukf": {"method": "ukf"},
    "covering": {"method": "covering"},
    "covering, told 6 mm": {"method": "covering", "detection_radius": 0.006},
    "covering, odometry on failure": {"method": "covering", "odometry": "failure"},
}


def measure(seed: int, runs: int) -> tuple[Family, list[tuple[float, float]]]:
    """Rate of the searched fiducials and mean search time, for each method."""
    world, arrangement = draw(seed)
    rows = []
    for options in METHODS.values():
        result = rmma.run(
            arrangement, velocities=VELOCITIES, runs=runs, rng=seed, world=world, **options
        )
        rows.append((float(result.intercepted[..., ~result.registered].mean()), result.search_time))
    return world, rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--first", type=int, default=100)
    parser.add_argument("--worlds", type=int, default=200)
    parser.add_argument("--runs", type=int, default=4)
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    seeds = range(arguments.first, arguments.first + arguments.worlds)
    with ProcessPoolExecutor() as pool:
        measured = list(pool.map(partial(measure, runs=arguments.runs), seeds))
    table = np.array([rows for _, rows in measured])
    print(f"{len(seeds)} worlds, seeds from {seeds[0]}, {arguments.runs} runs at {VELOCITIES} m/s")
    print(f"{'':30} rate: mean  10 %   1 %   >=99 %   time: median  90 %")
    for k, name in enumerate(METHODS):
        rate, time = table[:, k, 0], table[:, k, 1]
        print(
            f"{name:30} {100 * rate.mean():10.1f} {100 * np.quantile(rate, 0.1):5.1f} "
            f"{100 * np.quantile(rate, 0.01):5.1f} {100 * (rate >= 0.99).mean():7.0f} "
            f"{np.median(time):14.2f} {np.quantile(time, 0.9):5.2f}"
        )
    print("\nwhere covering fails most:")
    for i in np.argsort(table[:, 2, 0])[:8]:
        world = measured[i][0]
        print(f"{100 * table[i, 2, 0]:5.1f} % {table[i, 2, 1]:5.2f} s  {world}")
    if arguments.out:
        with arguments.out.open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["seed", *METHODS, *(f"{name}, s" for name in METHODS)])
            for (world, _), row in zip(measured, table, strict=True):
                writer.writerow([world.seed, *row[:, 0], *row[:, 1]])


if __name__ == "__main__":
    main()
