"""What a step of a BaseLocalizer costs: wheels at 50 Hz with an IMU, and LIDAR that comes late.

    python benchmarks/localizer_step.py --rounds 15

Medians of the rounds. Each round drives on for some seconds with a full history of ten.
"""

import argparse
import time
from collections.abc import Callable

import numpy as np

from thing_kin import estimation as est

DT, COUNT = 0.02, 500
R, POSE_R = 1e-3 * np.eye(3), 1e-4 * np.eye(3)
TWIST = np.array([0.5, 0.1, 0.2])
Step = Callable[[], object]


class Drive:
    """A localizer that has driven for longer than it remembers, and its steps."""

    def __init__(self, filter: str) -> None:
        self.localizer = est.BaseLocalizer(t=0.0, filter=filter, gate=1.0)
        self.k = 0
        for _ in range(1500):
            self.wheels()

    def wheels(self) -> None:
        self.k += 1
        self.localizer.add_twist(self.k * DT, TWIST, R, source="wheels")

    def in_order(self) -> None:
        """A twist, then the estimate."""
        self.wheels()
        self.localizer.estimate()

    def with_late_pose(self) -> None:
        """The same, and a pose that is 50 ms old: two twists are computed again."""
        self.in_order()
        pose = self.localizer.estimate((self.k - 2.5) * DT).pose
        self.localizer.add_pose((self.k - 2.5) * DT, pose, POSE_R, source="lidar")


def seconds(step: Step) -> float:
    start = time.perf_counter()
    for _ in range(COUNT):
        step()
    return (time.perf_counter() - start) / COUNT


def main() -> None:
    """Measure."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=15)
    rounds = parser.parse_args().rounds
    steps: dict[str, Step] = {}
    for filter in ("ekf", "ukf"):
        steps[f"{filter}: add_twist"] = Drive(filter).wheels
        steps[f"{filter}: add_twist, estimate"] = Drive(filter).in_order
        steps[f"{filter}: and a pose 50 ms late, with its estimate"] = Drive(filter).with_late_pose
    samples: dict[str, list[float]] = {name: [] for name in steps}
    for _ in range(rounds):
        for name, step in steps.items():
            samples[name].append(seconds(step))
    print("| step | time |\n|---|---:|")
    for name, taken in samples.items():
        print(f"| {name} | {1e6 * float(np.median(taken)):.2f} µs |")


if __name__ == "__main__":
    main()
