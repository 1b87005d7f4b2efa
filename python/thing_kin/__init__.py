"""The numerical heart of a mobile manipulator.

Poses are (4, 4) homogeneous matrices, planar poses (x, y, theta), quaternions (w, x, y, z), twists
and pose errors [linear, angular]; metres, radians, seconds. A leading axis means a batch. Equation
numbers: [M17] Maric 2017, [X21] Xie 2021.

Examples
--------
>>> import numpy as np, thing_kin as tk
>>> robot = tk.robots.thing()
>>> robot.jacobian(np.zeros(9)).shape
(6, 9)
"""

from thing_kin import lie, robots
from thing_kin._core import (
    DH,
    BaseObstacleTask,
    BaseTask,
    Chain,
    Damped,
    DistanceTask,
    Exact,
    FieldOfViewTask,
    IkBatchResult,
    IkResult,
    IkSolutions,
    JointRangeTask,
    LimitedStep,
    NumericIk,
    OrientationTask,
    PoseTask,
    PositionTask,
    PostureTask,
    SelectivelyDamped,
    SetTask,
    SingularValueFilter,
    Task,
    TaskPriority,
    TaskPriorityStep,
    WheelLimits,
    __version__,
    filter_singular_values,
    has_closed_form,
    ik,
    ik_all,
    null_space,
    null_space_projector,
    on_omni_base,
    pinv,
    pose_error,
    selectively_damped_step,
    simd_level,
    transform,
    use_simd_level,
)
from thing_kin.trajectory import Trajectory, move_to, time_path

__all__ = [
    "DH",
    "BaseObstacleTask",
    "BaseTask",
    "Chain",
    "Damped",
    "DistanceTask",
    "Exact",
    "FieldOfViewTask",
    "IkBatchResult",
    "IkResult",
    "IkSolutions",
    "JointRangeTask",
    "LimitedStep",
    "NumericIk",
    "OrientationTask",
    "PoseTask",
    "PositionTask",
    "PostureTask",
    "SelectivelyDamped",
    "SetTask",
    "SingularValueFilter",
    "Task",
    "TaskPriority",
    "TaskPriorityStep",
    "Trajectory",
    "WheelLimits",
    "__version__",
    "filter_singular_values",
    "has_closed_form",
    "ik",
    "ik_all",
    "lie",
    "move_to",
    "null_space",
    "null_space_projector",
    "on_omni_base",
    "pinv",
    "pose_error",
    "robots",
    "selectively_damped_step",
    "simd_level",
    "time_path",
    "transform",
    "use_simd_level",
]
