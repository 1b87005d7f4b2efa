"""Scan matching over many worlds: tables to tune by. Not a test: test_scan_matching.py is.

    python tests/soak_scans.py [--count 60] [--drives 3] [--seed 0] [--sensors 180 1081]

A row is repeated by its seed: match k of a row has numpy.random.default_rng((seed, k)).
"""

import argparse

import numpy as np

from scan_drives import SENSORS
from scan_statistics import follow, matches
from scan_worlds import FAMILIES


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--drives", type=int, default=3)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--sensors", nargs="*", default=[""], help="parts of their names")
    arguments = parser.parse_args()
    chosen = {n: s for n, s in SENSORS.items() if any(part in n for part in arguments.sensors)}
    for name, sensor in chosen.items():
        for family in FAMILIES:
            near = matches(family, sensor, arguments.count, arguments.seed)
            print(f"{name:24} {family:18} near {near.line()}", flush=True)
            worst = [near.seeds[k] for k in np.flatnonzero(near.unsaid)[:5]]
            if worst:
                print(f"{'':43} unsaid at {worst}")
            far = matches(
                family, sensor, arguments.count, arguments.seed, guess_error=(0.5, np.pi / 4)
            )
            print(f"{'':43} far  {far.line()}", flush=True)
            for k in range(arguments.drives):
                for wheels in (None, 0.03):
                    drive = follow(family, sensor, (arguments.seed, k), wheels=wheels)
                    aided = "wheels" if wheels else "alone "
                    print(f"{'':43} drive {k} {aided} {drive.line()}", flush=True)


if __name__ == "__main__":
    main()
