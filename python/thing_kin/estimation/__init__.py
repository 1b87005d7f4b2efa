"""Where the base is, where the hand is, and how sure we are.

Filters, wheel odometry, the localizer of the base and the pose of the hand, each with its
covariance. Planar poses are (x, y, theta), their covariances in world axes; twists (vx, vy, omega)
in the body; metres, radians, seconds.
"""

from thing_kin._estimation import (
    DeadReckoning,
    DifferentialDriveOdometry,
    EndEffector,
    MecanumIdentification,
    MecanumOdometry,
    angles_from_ticks,
    dead_reckon,
    end_effector,
    identify_mecanum,
    integrate_twist,
    integrate_twist_jacobians,
    pose_difference,
)

__all__ = [
    "DeadReckoning",
    "DifferentialDriveOdometry",
    "EndEffector",
    "MecanumIdentification",
    "MecanumOdometry",
    "angles_from_ticks",
    "dead_reckon",
    "end_effector",
    "identify_mecanum",
    "integrate_twist",
    "integrate_twist_jacobians",
    "pose_difference",
]
