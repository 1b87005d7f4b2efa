"""Kalman filters beside filterpy: a prediction and an update, one call each, and a whole record.

    python benchmarks/filter_race.py --rounds 15

Every round times every contender in turn; the table has the medians of the rounds and their
ratios. Models are those of the user: functions with their Jacobians, in Python; in `run` and in the
lines named so, the models are built in.
"""

import argparse
import time
from collections.abc import Callable
from functools import partial

import numpy as np
from filterpy.kalman import (
    ExtendedKalmanFilter,
    KalmanFilter,
    MerweScaledSigmaPoints,
    UnscentedKalmanFilter,
)

from thing_kin import estimation as est

DT = 0.1
F4 = np.eye(4) + DT * np.eye(4, k=2)
H4 = np.eye(2, 4)
Q4, R2 = 1e-4 * np.eye(4), 1e-2 * np.eye(2)
X4, P4 = np.array([0.0, 0.0, 1.0, 0.5]), np.eye(4)
F8, Q8, R3 = np.eye(8) + DT * np.eye(8, k=3), 1e-4 * np.eye(8), 1e-2 * np.eye(3)
H8, X8, P8 = np.eye(3, 8), np.full(8, 0.1), np.eye(8)
Z2, Z3 = np.array([0.1, 0.2]), np.array([0.1, 0.2, 0.1])


def by_filterpy_kalman() -> Callable[[], None]:
    """n = 4, m = 2."""
    filter = KalmanFilter(4, 2)
    filter.x, filter.P, filter.F, filter.H, filter.Q, filter.R = X4, P4, F4, H4, Q4, R2

    def step() -> None:
        filter.predict()
        filter.update(Z2)

    return step


def by_kalman() -> Callable[[], None]:
    filter = est.KalmanFilter(X4, P4)

    def step() -> None:
        filter.predict(F4, Q4)
        filter.update(Z2, H4, R2)

    return step


def by_filterpy_extended() -> Callable[[], None]:
    """n = 8, m = 3."""
    filter = ExtendedKalmanFilter(8, 3)
    filter.x, filter.P, filter.F, filter.Q, filter.R = X8, P8, F8, Q8, R3

    def step() -> None:
        filter.predict()
        filter.update(Z3, lambda x: H8, lambda x: H8 @ x)

    return step


def by_extended() -> Callable[[], None]:
    filter = est.ExtendedKalmanFilter(X8, P8)

    def step() -> None:
        filter.predict(lambda x: F8 @ x, Q8, jacobian=lambda x: F8)
        filter.update(Z3, lambda x: H8 @ x, R3, jacobian=lambda x: H8)

    return step


def by_extended_built_in() -> Callable[[], None]:
    model = est.models.omnidirectional()
    pose = est.models.components((0, 1, 2), angles=(2,))
    filter = est.ExtendedKalmanFilter(X8, P8, angles=model.angles)

    def step() -> None:
        filter.predict(model, Q8, dt=DT)
        filter.update(Z3, pose, R3)

    return step


def by_filterpy_unscented() -> Callable[[], None]:
    """n = 4, m = 2, 9 points."""
    points = MerweScaledSigmaPoints(4, 0.1, 2.0, -1.0)
    filter = UnscentedKalmanFilter(4, 2, DT, lambda x: H4 @ x, lambda x, dt: F4 @ x, points)
    filter.x, filter.P, filter.Q, filter.R = X4, P4, Q4, R2

    def step() -> None:
        filter.predict()
        filter.update(Z2)

    return step


def by_unscented() -> Callable[[], None]:
    filter = est.UnscentedKalmanFilter(X4, P4, alpha=0.1, beta=2.0, kappa=-1.0)

    def step() -> None:
        filter.predict(lambda x: F4 @ x, Q4)
        filter.update(Z2, lambda x: H4 @ x, R2)

    return step


def by_unscented_built_in() -> Callable[[], None]:
    model = est.models.constant_velocity(dimension=2)
    position = est.models.components((0, 1))
    filter = est.UnscentedKalmanFilter(X4, P4, alpha=0.1, beta=2.0, kappa=-1.0)

    def step() -> None:
        filter.predict(model, Q4, dt=DT)
        filter.update(Z2, position, R2)

    return step


RECORD = 2000


def by_run() -> Callable[[], None]:
    """The EKF of eight states over a record: seconds of all its rows."""
    model = est.models.omnidirectional()
    pose = est.models.components((0, 1, 2), angles=(2,))
    record = np.tile(Z3, (RECORD, 1))

    def step() -> None:
        filter = est.ExtendedKalmanFilter(X8, P8, angles=model.angles)
        filter.run(record, f=model, h=pose, R=R3, Q=Q8, dt=DT)

    return step


def seconds(step: Callable[[], None], count: int) -> float:
    """Of one step, the mean of some."""
    start = time.perf_counter()
    for _ in range(count):
        step()
    return (time.perf_counter() - start) / count


# Name, of which peer, the step, how many in a round, rows of a step.
Line = tuple[str, str | None, Callable[[], Callable[[], None]], int, int]
LINES: list[Line] = [
    ("filterpy Kalman n=4 m=2", None, by_filterpy_kalman, 200, 1),
    ("Kalman", "filterpy Kalman n=4 m=2", by_kalman, 2000, 1),
    ("filterpy EKF n=8 m=3", None, by_filterpy_extended, 200, 1),
    ("EKF, Python functions", "filterpy EKF n=8 m=3", by_extended, 2000, 1),
    ("EKF, built-in models", "filterpy EKF n=8 m=3", by_extended_built_in, 2000, 1),
    ("EKF, `run` of 2000 rows, a row", "filterpy EKF n=8 m=3", by_run, 2, RECORD),
    ("filterpy UKF n=4", None, by_filterpy_unscented, 100, 1),
    ("UKF, Python functions", "filterpy UKF n=4", by_unscented, 2000, 1),
    ("UKF, built-in models", "filterpy UKF n=4", by_unscented_built_in, 2000, 1),
]


def main() -> None:
    """Race."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=15)
    rounds = parser.parse_args().rounds
    contenders = [
        (name, partial(seconds, make(), count), rows) for name, _, make, count, rows in LINES
    ]
    samples: dict[str, list[float]] = {}
    for _ in range(rounds):
        for name, run, rows in contenders:
            samples.setdefault(name, []).append(run() / rows)
    medians = {name: float(np.median(taken)) for name, taken in samples.items()}
    print("| filter | predict + update | times faster |\n|---|---:|---:|")
    for name, peer, *_ in LINES:
        ratio = f"{medians[peer] / medians[name]:.0f}" if peer else ""
        print(f"| {name} | {1e6 * medians[name]:.2f} µs | {ratio} |")


if __name__ == "__main__":
    main()
