"""Scans, matches, LIDAR odometry."""

from collections.abc import Callable
from typing import Any

import numpy as np

from public_arrays.argument import XI, Argument
from thing_kin import odometry

SCANNER = odometry.Scanner(-1.5, 1.5, 9, range_max=30.0)
RANGES = np.array([2.0, 2.1, 2.2, 2.1, 2.0, 1.9, 1.8, 1.9, 2.0])


def matched(name: str) -> Callable[[Any], Any]:
    known = {"guess": XI[3:], "guess_covariance": np.eye(3)}

    def call(value: Any) -> np.ndarray:
        match = odometry.match(SCANNER, RANGES, RANGES, **{**known, name: value})
        return np.append(match.pose, match.covariance)

    return call


def followed(name: str) -> Callable[[Any], Any]:
    def call(value: Any) -> np.ndarray:
        lidar = odometry.LaserOdometry(SCANNER)
        lidar.add(RANGES, t=0.0)
        step = lidar.add(RANGES, t=0.1, **{"motion": XI[3:], name: value})
        return np.append(step.pose, step.covariance)

    return call


LIDAR = [
    Argument("Scanner", "mount", XI[3:], lambda v: odometry.Scanner(0, 1, 9, mount=v).mount),
    Argument(
        "Scanner.points",
        "twist",
        XI[3:],
        lambda v: SCANNER.points(RANGES, twist=v)[0],
        moderate=True,
    ),
    Argument("match", "guess", XI[3:], matched("guess"), moderate=True),
    Argument("match", "guess_covariance", np.eye(3), matched("guess_covariance"), moderate=True),
    Argument("LaserOdometry", "motion", XI[3:], followed("motion"), moderate=True),
    Argument("LaserOdometry", "twists", XI.reshape(2, 3), followed("twists"), moderate=True),
    Argument(
        "LaserOdometry",
        "motion_covariance",
        np.eye(3),
        followed("motion_covariance"),
        moderate=True,
    ),
]
