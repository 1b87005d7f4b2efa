"""Rotations SO(3), rigid transforms SE(3): exp, log, adjoint, Jacobians, quaternions, rpy."""

from thing_kin._core.lie import as_matrix as as_matrix  # for thing_kin.interop, not public
from thing_kin._core.lie import (
    quaternion_from_rotation,
    rotation_from_quaternion,
    rotation_from_rpy,
    rpy_from_rotation,
    se3_adjoint,
    se3_exp,
    se3_left_jacobian,
    se3_left_jacobian_inverse,
    se3_log,
    se3_right_jacobian,
    se3_right_jacobian_inverse,
    so3_exp,
    so3_left_jacobian,
    so3_left_jacobian_inverse,
    so3_log,
    so3_right_jacobian,
    so3_right_jacobian_inverse,
)

__all__ = [
    "quaternion_from_rotation",
    "rotation_from_quaternion",
    "rotation_from_rpy",
    "rpy_from_rotation",
    "se3_adjoint",
    "se3_exp",
    "se3_left_jacobian",
    "se3_left_jacobian_inverse",
    "se3_log",
    "se3_right_jacobian",
    "se3_right_jacobian_inverse",
    "so3_exp",
    "so3_left_jacobian",
    "so3_left_jacobian_inverse",
    "so3_log",
    "so3_right_jacobian",
    "so3_right_jacobian_inverse",
]
