"""Where the base is, where the hand is, and how sure we are.

Filters, wheel odometry, the localizer of the base and the pose of the hand, each with its
covariance. Planar poses are (x, y, theta), their covariances in world axes; twists (vx, vy, omega)
in the body; metres, radians, seconds.
"""

from thing_kin._estimation import (
    BaseEstimate,
    BaseLocalizer,
    DeadReckoning,
    DifferentialDriveOdometry,
    EndEffector,
    ExtendedKalmanFilter,
    FilterRun,
    GaussianFilter,
    KalmanFilter,
    MeasurementModel,
    MecanumIdentification,
    MecanumOdometry,
    MotionModel,
    NisStatistics,
    UnscentedKalmanFilter,
    angles_from_ticks,
    chi_square_quantile,
    dead_reckon,
    end_effector,
    identify_mecanum,
    integrate_twist,
    integrate_twist_jacobians,
    nees,
    numeric_jacobian,
    pose_difference,
)
from thing_kin.estimation import models
from thing_kin.estimation.calibration import calibrate
from thing_kin.estimation.calibration_base import CalibratedNumber, CalibrationResult
from thing_kin.estimation.calibration_result import Calibration
from thing_kin.estimation.calibration_words import calibration_report
from thing_kin.estimation.consistency import ConsistencyReport, consistency_report
from thing_kin.estimation.jacobian_check import JacobianCheck, check_jacobian
from thing_kin.estimation.mecanum_calibration import MecanumCalibration, calibrate_mecanum
from thing_kin.estimation.robot_localization import (
    RobotLocalization,
    RosSource,
    read_robot_localization,
)
from thing_kin.estimation.simulated_drive import (
    LocalizationExperiment,
    LocalizationRun,
    SimulatedDrive,
    localization_experiment,
    simulate_drive,
)
from thing_kin.estimation.simulation import Simulation, simulate

__all__ = [
    "BaseEstimate",
    "BaseLocalizer",
    "CalibratedNumber",
    "Calibration",
    "CalibrationResult",
    "ConsistencyReport",
    "DeadReckoning",
    "DifferentialDriveOdometry",
    "EndEffector",
    "ExtendedKalmanFilter",
    "FilterRun",
    "GaussianFilter",
    "JacobianCheck",
    "KalmanFilter",
    "LocalizationExperiment",
    "LocalizationRun",
    "MeasurementModel",
    "MecanumCalibration",
    "MecanumIdentification",
    "MecanumOdometry",
    "MotionModel",
    "NisStatistics",
    "RobotLocalization",
    "RosSource",
    "SimulatedDrive",
    "Simulation",
    "UnscentedKalmanFilter",
    "angles_from_ticks",
    "calibrate",
    "calibrate_mecanum",
    "calibration_report",
    "check_jacobian",
    "chi_square_quantile",
    "consistency_report",
    "dead_reckon",
    "end_effector",
    "identify_mecanum",
    "integrate_twist",
    "integrate_twist_jacobians",
    "localization_experiment",
    "models",
    "nees",
    "numeric_jacobian",
    "pose_difference",
    "read_robot_localization",
    "simulate",
    "simulate_drive",
]
