"""Every array argument of the public API, for fuzzing: a good value, and a call for others."""

from public_arrays.argument import Argument
from public_arrays.calibration import CALIBRATION
from public_arrays.filters import FILTERS
from public_arrays.interop import INTEROP
from public_arrays.inverse import CLOSED_FORM, IK, LIMITS, TASK_PRIORITY
from public_arrays.kinematics import CHAIN, LIE, LINALG, MODEL, MOTION
from public_arrays.lidar import LIDAR
from public_arrays.localizer import LOCALIZER
from public_arrays.optimization import OBSTACLES, POSE_PLAN, PROBLEM, TERMS
from public_arrays.planning import PATH, TIMING
from public_arrays.search import SEARCH
from public_arrays.wheels import ODOMETRY

__all__ = ["ARGUMENTS", "FILTERS", "OPTIONAL", "OPTIONAL_OF", "REQUIRED", "Argument"]

ARGUMENTS = [
    *LIDAR,
    *SEARCH,
    *CALIBRATION,
    *FILTERS,
    *ODOMETRY,
    *LOCALIZER,
    *POSE_PLAN,
    *TIMING,
    *PROBLEM,
    *INTEROP,
    *CHAIN,
    *MOTION,
    *LIE,
    *LINALG,
    *MODEL,
    *TASK_PRIORITY,
    *LIMITS,
    *CLOSED_FORM,
    *IK,
    *PATH,
    *OBSTACLES,
    *TERMS,
]

# None means "not given" to these.
OPTIONAL = {
    "damping",
    "mount",
    "rpy",
    "null_motion",
    "previous",
    "axis",
    "lower",
    "upper",
    "step_limit",
} | {
    "velocity_limits",
    "acceleration_limits",
    "quaternion",
    "point",
    "seed",
    "weights",
    "joint_weights",
    "max_step",
    "center",
    "pose",
    "jerk_limits",
    "base_path",
    "heading",
    "max_joint_step",
    "warm_start",
    "covariance",
    "twist_covariance",
    "slip_variance",
    "joint_covariance",
    "mount_covariance",
    "guess_covariance",
    "motion",
    "motion_covariance",
    "reach_center",
    "within",
    "q_covariance",
}

# The same, of these labels alone.
OPTIONAL_OF = {
    ("calibrate", "base"),
    ("calibrate", "tool"),
    ("calibrate", "points"),
    ("calibrate base_covariance", "base_covariance"),
}

# Labels where such a name is not optional.
REQUIRED = (
    "Scanner",
    "Path",
    "rotation",
    "JointRange",
    "Disc",
    "Sphere",
    "HalfSpace",
    "terms.Cone",
    "terms.BaseDistance",
    "terms.SeedDistance of",
    "identify_mecanum",
    "calibrate_mecanum",
    "integrate",
    "jacobians",
    "dead_reckon",
    "drive integrate",
    "se2_",
    "at_most",
    "at_least",
    "between",
    "BaseLocalizer",
    "spiral",
    "stochastic",
    "covering of",
)
