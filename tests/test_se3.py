"""Rigid transforms: the convention of twists, the adjoint's direction, tk.transform.

The laws shared with SO(3) are in test_lie_laws.py.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from scipy.linalg import logm
from scipy.spatial.transform import Rotation

import thing_kin as tk
from oracles import assert_close, rotation_x, rotation_z, translation, vee
from strategies import DEGENERATE_ANGLES, DEGENERATE_AXES, angles, poses, rotation_matrix


def rotation_y(angle: float):
    quarter = rotation_z(np.pi / 2)
    return quarter @ rotation_x(angle) @ quarter.T


@pytest.mark.parametrize("axis", DEGENERATE_AXES, ids=str)
@pytest.mark.parametrize("angle", DEGENERATE_ANGLES)
def test_a_screw_is_its_axis_its_angle_and_its_pitch(axis, angle: float):
    """About the line through c along the axis, by the angle, and h along it: from geometry."""
    c, h = np.array([0.3, -0.7, 1.1]), 0.4
    xi = np.concatenate([np.cross(c, angle * axis) + h * axis, angle * axis])
    R = rotation_matrix(angle * axis)
    T = tk.lie.se3_exp(xi)
    assert_close(T[:3, :3], R, atol=4e-15)
    assert_close(T[:3, 3], c - R @ c + h * axis, atol=1e-14)
    assert_array_equal(T[3], [0.0, 0.0, 0.0, 1.0])


@given(poses(max_angle=3.0))  # logm has no rule for pi
def test_log_is_the_matrix_logarithm(T):
    assert_close(tk.lie.se3_log(T), vee(np.real(logm(T))), atol=1e-11)


def test_without_rotation_log_is_the_translation():
    assert_array_equal(tk.lie.se3_log(translation(1.0, -2.0, 3.0)), [1, -2, 3, 0, 0, 0])
    assert_array_equal(tk.lie.se3_exp([1, -2, 3, 0, 0, 0]), translation(1, -2, 3))


def test_the_adjoint_takes_a_twist_in_b_to_the_same_in_a():
    """A wheel that turns at the origin of b, one metre along x of a: a's origin sinks along y."""
    twist = tk.lie.se3_adjoint(translation(1.0, 0.0, 0.0)) @ [0, 0, 0, 0, 0, 2.0]
    assert_array_equal(twist, [0.0, -2.0, 0.0, 0.0, 0.0, 2.0])


@given(poses())
def test_the_adjoint_of_the_inverse_is_the_inverse(T):
    inverse = np.linalg.inv(T)
    assert_close(tk.lie.se3_adjoint(inverse) @ tk.lie.se3_adjoint(T), np.eye(6), atol=1e-13)


def test_the_adjoint_of_a_batch():
    T = tk.lie.se3_exp(np.random.default_rng(1).normal(size=(4, 6)))
    assert_array_equal(tk.lie.se3_adjoint(T), np.stack([tk.lie.se3_adjoint(t) for t in T]))


@given(st.tuples(angles, angles, angles))
def test_rpy_is_urdf_s(rpy):
    roll, pitch, yaw = rpy
    expected = translation(1, 2, 3) @ rotation_z(yaw) @ rotation_y(pitch) @ rotation_x(roll)
    T = tk.transform(xyz=(1, 2, 3), rpy=rpy)
    assert_close(T, expected, atol=1e-15)
    assert_close(T[:3, :3], Rotation.from_euler("xyz", rpy).as_matrix(), atol=1e-15)


@given(poses())
def test_quaternion_is_scalar_first(T):
    quaternion = Rotation.from_matrix(T[:3, :3]).as_quat(scalar_first=True)
    assert_close(tk.transform(T[:3, 3], quaternion=3.0 * quaternion), T, atol=4e-15)


def test_transform_of_nothing_is_the_identity():
    assert_array_equal(tk.transform(), np.eye(4))
    with pytest.raises(ValueError, match=r"^rpy, quaternion: got both"):
        tk.transform(rpy=(0, 0, 0), quaternion=(1, 0, 0, 0))
