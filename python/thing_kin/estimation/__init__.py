"""Where the base is, where the hand is, and how sure we are.

Filters, wheel odometry, the localizer of the base and the pose of the hand, each with its
covariance. Planar poses are (x, y, theta), their covariances in world axes; twists (vx, vy, omega)
in the body; metres, radians, seconds.
"""

from thing_kin._estimation import (
    ExtendedKalmanFilter,
    FilterRun,
    GaussianFilter,
    KalmanFilter,
    MeasurementModel,
    MotionModel,
    UnscentedKalmanFilter,
    chi_square_quantile,
    nees,
    numeric_jacobian,
)
from thing_kin.estimation import models
from thing_kin.estimation.consistency import ConsistencyReport, consistency_report
from thing_kin.estimation.jacobian_check import JacobianCheck, check_jacobian
from thing_kin.estimation.simulation import Simulation, simulate

__all__ = [
    "ConsistencyReport",
    "ExtendedKalmanFilter",
    "FilterRun",
    "GaussianFilter",
    "JacobianCheck",
    "KalmanFilter",
    "MeasurementModel",
    "MotionModel",
    "Simulation",
    "UnscentedKalmanFilter",
    "check_jacobian",
    "chi_square_quantile",
    "consistency_report",
    "models",
    "nees",
    "numeric_jacobian",
    "simulate",
]
