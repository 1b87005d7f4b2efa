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
    MecanumIdentification,
    MecanumOdometry,
    NisStatistics,
    angles_from_ticks,
    dead_reckon,
    end_effector,
    identify_mecanum,
    integrate_twist,
    integrate_twist_jacobians,
    pose_difference,
)
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

__all__ = [
    "BaseEstimate",
    "BaseLocalizer",
    "DeadReckoning",
    "DifferentialDriveOdometry",
    "EndEffector",
    "LocalizationExperiment",
    "LocalizationRun",
    "MecanumIdentification",
    "MecanumOdometry",
    "NisStatistics",
    "RobotLocalization",
    "RosSource",
    "SimulatedDrive",
    "angles_from_ticks",
    "dead_reckon",
    "end_effector",
    "identify_mecanum",
    "integrate_twist",
    "integrate_twist_jacobians",
    "localization_experiment",
    "pose_difference",
    "read_robot_localization",
    "simulate_drive",
]
