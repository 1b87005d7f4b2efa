"""Rotations: SciPy's, the choice of a sign at half a turn, quaternions.

The laws shared with SE(3) are in test_lie_laws.py.
"""

import numpy as np
import pytest
from hypothesis import given
from numpy.testing import assert_array_equal
from scipy.spatial.transform import Rotation

import thing_kin as tk
from oracles import assert_close
from strategies import (
    DEGENERATE_ANGLES,
    DEGENERATE_AXES,
    rotation_matrix,
    rotation_vectors,
    rotations,
)

ATOL = 4e-15  # a few units in the last place of pi

axes = pytest.mark.parametrize("axis", DEGENERATE_AXES, ids=str)


@axes
@pytest.mark.parametrize("angle", DEGENERATE_ANGLES)
def test_exp_and_log_are_scipy_s_at_degenerate_angles(axis, angle: float):
    phi = angle * axis
    assert_close(tk.lie.so3_exp(phi), Rotation.from_rotvec(phi).as_matrix(), ATOL)
    if angle < np.pi:
        assert_close(tk.lie.so3_log(rotation_matrix(phi)), phi, ATOL)


@given(rotation_vectors(max_angle=7.0))
def test_exp_and_log_are_scipy_s(phi):
    R = Rotation.from_rotvec(phi)
    assert_close(tk.lie.so3_exp(phi), R.as_matrix(), ATOL)
    log = tk.lie.so3_log(R.as_matrix())
    error = Rotation.from_rotvec(log) * R.inv()  # whichever sign SciPy would choose at pi
    assert error.magnitude() <= ATOL


@axes
@pytest.mark.parametrize("angle", [1e-300, 1e-20, 1e-12, 1e-8])
def test_small_rotations_keep_all_their_digits(axis, angle: float):
    log = tk.lie.so3_log(tk.lie.so3_exp(angle * axis))
    assert np.abs(log - angle * axis).max() <= 1e-15 * angle


def first_nonzero_positive(axis):
    return axis * np.sign(axis[np.flatnonzero(axis)[0]])


@axes
def test_at_half_a_turn_the_first_nonzero_component_is_positive(axis):
    expected = np.pi * first_nonzero_positive(axis)
    exact = 2.0 * np.outer(axis, axis) - np.eye(3)
    for R in (exact, exact.T, tk.lie.so3_exp(np.pi * axis), tk.lie.so3_exp(-np.pi * axis)):
        assert_close(tk.lie.so3_log(R), expected, ATOL)


def test_a_component_that_is_rounding_does_not_choose_the_sign():
    for noise in (-1e-16, 0.0, 1e-16):
        axis = np.array([noise, -0.6, 0.8])
        R = 2.0 * np.outer(axis, axis) - np.eye(3)
        assert_close(tk.lie.so3_log(R), np.pi * np.array([0.0, 0.6, -0.8]), ATOL)


@axes
def test_a_last_place_beside_pi_does_not_flip_the_sign(axis):
    expected = np.pi * first_nonzero_positive(axis)
    for angle in (np.nextafter(np.pi, 0.0), np.pi, np.nextafter(np.pi, 4.0)):
        assert_close(tk.lie.so3_log(rotation_matrix(angle * axis)), expected, ATOL)


@axes
def test_beyond_pi_the_rotation_is_the_short_way_round(axis):
    short = tk.lie.so3_log(rotation_matrix((np.pi + 1e-9) * axis))
    assert_close(short, (1e-9 - np.pi) * axis, ATOL)


@given(rotations())
def test_quaternions_are_scipy_s_with_w_first_and_not_negative(R):
    q = tk.lie.quaternion_from_rotation(R)
    assert q[0] >= 0.0
    assert_close(np.linalg.norm(q), 1.0, ATOL)
    scipy = Rotation.from_matrix(R).as_quat(scalar_first=True)
    assert_close(q * np.sign(q @ scipy), scipy, ATOL)
    assert_close(tk.lie.rotation_from_quaternion(q), R, ATOL)


@axes
def test_quaternions_of_half_turns_follow_the_sign_rule(axis):
    R = 2.0 * np.outer(axis, axis) - np.eye(3)
    q = tk.lie.quaternion_from_rotation(R)
    assert q[0] == 0.0
    assert_close(q[1:], first_nonzero_positive(axis), ATOL)


@given(rotations())
def test_a_quaternion_s_length_and_sign_do_not_matter(R):
    q = tk.lie.quaternion_from_rotation(R)
    for factor in (-1.0, 1e-6, 1e6):
        assert_close(tk.lie.rotation_from_quaternion(factor * q), R, ATOL)


def test_quaternions_in_a_batch():
    R = Rotation.random(8, rng=1).as_matrix()
    Q = tk.lie.quaternion_from_rotation(R)
    assert_array_equal(Q, np.stack([tk.lie.quaternion_from_rotation(r) for r in R]))
    assert_close(tk.lie.rotation_from_quaternion(Q), R, ATOL)


@given(rotations())
def test_roll_pitch_yaw_give_the_rotation_back(R):
    roll, pitch, yaw = rpy = tk.lie.rpy_from_rotation(R)
    assert abs(pitch) <= np.pi / 2
    assert max(abs(roll), abs(yaw)) <= np.pi
    assert_close(tk.lie.rotation_from_rpy(rpy), R, 2 * ATOL)
    assert_close(Rotation.from_euler("xyz", rpy).as_matrix(), R, 2 * ATOL)


@pytest.mark.parametrize("distance", [0.0, 1e-17, 1e-15, 1e-13, 1e-10, 1e-8, 1e-4, 0.3])
@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("roll", [0.0, 0.7, np.pi / 2, -3.0])
def test_roll_pitch_yaw_near_a_pitch_of_a_quarter_turn(roll: float, sign: float, distance: float):
    """Roll may lose its digits there; the three together do not."""
    pitch = sign * (np.pi / 2 - distance)
    R = Rotation.from_euler("xyz", (roll, pitch, 1.1)).as_matrix()
    rpy = tk.lie.rpy_from_rotation(R)
    lost = 8e-15 if distance < 1e-14 else 0.0  # the cosine of the pitch, where roll is set to 0
    assert_close(tk.lie.rotation_from_rpy(rpy), R, ATOL + lost)
    assert_close(rpy[1], pitch, ATOL + 1.0001 * lost)
    if distance < 1e-15:
        assert rpy[0] == 0.0
        assert_close(np.cos(rpy[2] - (1.1 - sign * roll)), 1.0, ATOL)
    elif distance >= 1e-10:
        assert_close(rpy, [roll, pitch, 1.1], 1e-15 / distance)


@pytest.mark.parametrize("zero", [0.0, -0.0])
def test_half_turns_about_x_and_z_are_pi(zero: float):
    about_x = [[1, zero, zero], [zero, -1, zero], [zero, zero, -1]]
    about_z = [[-1, zero, zero], [zero, -1, zero], [zero, zero, 1]]
    assert_array_equal(tk.lie.rpy_from_rotation(about_x), [np.pi, 0, 0])
    assert_array_equal(tk.lie.rpy_from_rotation(about_z), [0, 0, np.pi])


def test_roll_pitch_yaw_in_a_batch():
    R = Rotation.random(8, rng=2).as_matrix()
    rpy = tk.lie.rpy_from_rotation(R)
    assert_array_equal(rpy, [tk.lie.rpy_from_rotation(r) for r in R])
    assert_array_equal(
        tk.lie.rotation_from_rpy(rpy), [tk.transform(rpy=angles)[:3, :3] for angles in rpy]
    )
