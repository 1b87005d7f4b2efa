"""An arm and its reflectors."""

import functools
from collections.abc import Callable
from typing import Any

import numpy as np

from public_arrays.argument import ARM, ROBOT, Argument, T
from thing_kin import estimation as est

ARM_POSTURES = ARM.random(8, rng=0)
ARM_POSES = ARM.fk(ARM_POSTURES)


@functools.cache
def calibrated_arm() -> est.Calibration:
    return est.calibrate(ARM, ARM_POSTURES, ARM_POSES, sag=(1,))


# Two, so that they are not of a rotation's shape.
REFLECTORS = np.array([[0.05, 0.0, 0.1], [-0.03, 0.06, 0.12]])
SEEN_REFLECTORS = np.stack([(ARM_POSES @ [*p, 1.0])[:, :3] for p in REFLECTORS], axis=1)
ROBOT_POSTURES = ROBOT.random(8, rng=0)
ROBOT_POSES = ROBOT.fk(ROBOT_POSTURES)


def calibrated(name: str, **others: Any) -> Callable[[Any], Any]:
    known = {"chain": ARM, "q": ARM_POSTURES, "measured": ARM_POSES, "loss": "linear", **others}

    def call(value: Any) -> np.ndarray:
        found = est.calibrate(**{**known, name: value})
        return np.concatenate([found.values, np.diag(found.covariance)])

    return call


CALIBRATION = [
    Argument("calibrate", "q", ARM_POSTURES, calibrated("q"), moderate=True),
    Argument("calibrate", "measured", ARM_POSES, calibrated("measured"), moderate=True),
    Argument("calibrate", "covariance", 0.1 * np.eye(6), calibrated("covariance"), moderate=True),
    Argument(
        "calibrate", "q_covariance", 0.1 * np.eye(6), calibrated("q_covariance"), moderate=True
    ),
    Argument("readings", "q", ARM_POSTURES, lambda v: calibrated_arm().readings(v), moderate=True),
    Argument("predict", "q", ARM_POSTURES, lambda v: calibrated_arm().predict(v), moderate=True),
    Argument("calibrate", "base", T, calibrated("base"), moderate=True),
    Argument("calibrate", "tool", T, calibrated("tool"), moderate=True),
    Argument(
        "calibrate",
        "points",
        REFLECTORS,
        calibrated("points", measured=SEEN_REFLECTORS),
        moderate=True,
    ),
    Argument(
        "calibrate base_covariance",
        "base_covariance",
        1e-4 * np.eye(3),
        calibrated("base_covariance", chain=ROBOT, q=ROBOT_POSTURES, measured=ROBOT_POSES),
        moderate=True,
    ),
    Argument(
        "calibrate sag",
        "gravity",
        np.array([0.0, 0.0, -9.81]),
        calibrated("gravity", sag=(1, 2)),
        moderate=True,
    ),
]
