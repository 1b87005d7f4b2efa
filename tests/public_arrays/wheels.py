"""Wheel odometry, its identification, the hand on a base."""

from collections.abc import Callable
from typing import Any

import numpy as np

from public_arrays.argument import ROBOT, XI, Argument, Q
from thing_kin import estimation as est

TWISTS = np.stack([XI[:3], -XI[:3], XI[3:], XI[:3], XI[3:]])
STAMPS = np.array([0.0, 0.1, 0.3, 0.4, 0.6])
P3 = np.diag([0.1, 0.2, 0.3])
MECANUM = est.MecanumOdometry(0.07, 0.4)
DRIVE = est.DifferentialDriveOdometry(0.1, 0.4)
WHEELS = MECANUM.wheel_speeds(TWISTS)
RECORD_T = np.linspace(0.0, 8.0, 81)
RECORD_ANGLES = np.cumsum(
    0.1 * MECANUM.wheel_speeds(np.stack([np.cos(RECORD_T), np.sin(RECORD_T), RECORD_T / 8], 1)),
    axis=0,
)
RECORD_POSES = MECANUM.integrate_angles(RECORD_T, RECORD_ANGLES).poses


def reckoned(method: Callable[..., Any], name: str, **others: Any) -> Callable[[Any], Any]:
    return lambda value: method(**{**others, name: value}).covariances


def identified(name: str, identify: Any = est.identify_mecanum) -> Callable[[Any], Any]:
    known = {
        "t": RECORD_T,
        "wheel_angles": RECORD_ANGLES,
        "t_reference": RECORD_T,
        "poses": RECORD_POSES,
    }
    return lambda value: identify(**{**known, name: value}).covariance


def hand_with(name: str) -> Callable[[Any], Any]:
    known = {"robot": ROBOT, "q_arm": Q[:6], "estimate": (Q[6:], P3)}
    return lambda value: est.end_effector(**{**known, name: value}).task_covariance


RECKONING = {"pose": Q[6:], "covariance": P3, "twist_covariance": P3}
ODOMETRY = [
    Argument("integrate_twist", "pose", Q[6:], lambda v: est.integrate_twist(v, Q[6:], 0.1)),
    Argument("integrate_twist", "twist", Q[6:], lambda v: est.integrate_twist(Q[6:], v, 0.1)),
    Argument("jacobians", "pose", Q[6:], lambda v: est.integrate_twist_jacobians(v, Q[6:], 0.1)[0]),
    Argument(
        "jacobians", "twist", Q[6:], lambda v: est.integrate_twist_jacobians(Q[6:], v, 0.1)[0]
    ),
    Argument("pose_difference", "a", Q[6:], lambda v: est.pose_difference(v, Q[6:])),
    Argument("pose_difference", "b", Q[6:], lambda v: est.pose_difference(Q[6:], v)),
    Argument("angles_from_ticks", "ticks", WHEELS, lambda v: est.angles_from_ticks(v, 360)),
    Argument("MecanumOdometry.twist", "wheel_speeds", WHEELS[0], MECANUM.twist),
    Argument("MecanumOdometry.wheel_speeds", "twist", XI[:3], MECANUM.wheel_speeds),
    Argument("MecanumOdometry.slip", "wheel_speeds", WHEELS[0], MECANUM.slip),
    Argument("DifferentialDriveOdometry.twist", "wheel_speeds", XI[:2], DRIVE.twist),
    Argument(
        "DifferentialDriveOdometry.wheel_speeds",
        "twist",
        np.array([0.3, 0.0, 0.2]),
        DRIVE.wheel_speeds,
    ),
    Argument(
        "DifferentialDriveOdometry",
        "wheel_radius",
        np.array([0.1, 0.2]),
        lambda v: np.array(est.DifferentialDriveOdometry(v, 0.4).wheel_radius),
    ),
    *(
        Argument(label, name, good, reckoned(method, name, **{**RECKONING, **record}))
        for label, method, record in (
            ("dead_reckon", est.dead_reckon, {"twists": TWISTS, "dt": 0.1}),
            ("integrate", MECANUM.integrate, {"t": STAMPS, "wheel_speeds": WHEELS}),
            ("integrate_angles", MECANUM.integrate_angles, {"t": STAMPS, "wheel_angles": WHEELS}),
            ("drive integrate", DRIVE.integrate, {"t": STAMPS, "wheel_speeds": WHEELS[:, :2]}),
            (
                "drive integrate_angles",
                DRIVE.integrate_angles,
                {"t": STAMPS, "wheel_angles": WHEELS[:, :2]},
            ),
        )
        for name, good in {**RECKONING, **record}.items()
        if name != "dt"
    ),
    Argument(
        "integrate",
        "slip_variance",
        XI[:3],
        reckoned(MECANUM.integrate, "slip_variance", t=STAMPS, wheel_speeds=WHEELS),
    ),
    *(
        Argument("identify_mecanum", name, good, identified(name))
        for name, good in {
            "t": RECORD_T,
            "wheel_angles": RECORD_ANGLES,
            "t_reference": RECORD_T,
            "poses": RECORD_POSES,
            "mount": XI[3:],
            "mount_std": XI[3:],
        }.items()
    ),
    *(
        Argument("calibrate_mecanum", name, good, identified(name, est.calibrate_mecanum))
        for name, good in {
            "t": RECORD_T,
            "wheel_angles": RECORD_ANGLES,
            "t_reference": RECORD_T,
            "poses": RECORD_POSES,
            "mount": XI[3:],
            "mount_std": XI[3:],
        }.items()
    ),
    *(
        Argument("end_effector", name, good, hand_with(name))
        for name, good in {
            "q_arm": Q[:6],
            "estimate": Q[6:],
            "joint_std": np.full(6, 0.1),
            "joint_covariance": np.eye(6),
            "mount_covariance": np.eye(6),
        }.items()
    ),
]
