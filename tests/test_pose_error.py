"""Pose differences: (3.17), (3.18) and (4.28) of [M17] as corrected."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from scipy.linalg import expm

import thing_kin as tk
from oracles import assert_close, derivative, hat
from strategies import (
    DEGENERATE_AXES,
    Case,
    cases,
    poses,
    rotation_matrix,
    rotation_vectors,
    unit_vectors,
)

ATOL = 1e-14  # of an angle: a product of rotations, then its logarithm


def turned(T, phi):
    """T turned by phi, axes of the world, its origin moved by (1, -2, 3)."""
    goal = T.copy()
    goal[:3, :3] = rotation_matrix(phi) @ T[:3, :3]
    goal[:3, 3] += 1.0, -2.0, 3.0
    return goal


def cross_error(R, R_goal):
    """(3.18a) and (3.18b) as they stand."""
    e = 0.5 * sum(np.cross(c, d) for c, d in zip(R.T, R_goal.T, strict=True))
    L = -0.5 * sum(hat(c) @ hat(d) for c, d in zip(R.T, R_goal.T, strict=True))
    return np.linalg.solve(L, e)


@given(T=poses(), phi=rotation_vectors(max_angle=np.pi - 1e-9))
def test_it_is_goal_minus_current_and_the_rotation_vector(T, phi):
    assert_close(tk.pose_error(T, turned(T, phi)), [1.0, -2.0, 3.0, *phi], ATOL)


@given(T=poses(), T_goal=poses())
def test_the_body_form_leads_to_the_goal(T, T_goal):
    xi = tk.pose_error(T, T_goal, frame="body")
    v, w = xi[:3], xi[3:]
    twist = np.zeros((4, 4))
    twist[:3, :3], twist[:3, 3] = hat(w), v
    assert np.linalg.norm(w) <= np.pi + ATOL
    assert_close(T @ expm(twist), T_goal, atol=1e-13)


@given(cases())
def test_to_first_order_it_is_the_jacobian(case: Case):
    chain, q = case.chain, case.q
    T = chain.fk(q)
    slope = derivative(lambda x: tk.pose_error(T, chain.fk(x)), q)
    assert_close(slope, chain.jacobian(q), atol=1e-9)
    slope = derivative(lambda x: tk.pose_error(T, chain.fk(x), frame="body"), q)
    assert_close(slope, chain.jacobian(q, "body"), atol=1e-9)


@given(cases(max_rows=6), poses(max_angle=2.0))  # clear of the cut at pi
def test_the_body_form_s_exact_derivative_has_the_group_s_jacobian_inverse(case: Case, offset):
    """d log(T^-1 T_goal)/dq = -J_l^-1(error) J_body: what an optimizer needs away from the goal."""
    chain, q = case.chain, case.q
    T_goal = chain.fk(q) @ offset
    error = tk.pose_error(chain.fk(q), T_goal, frame="body")
    expected = -tk.lie.se3_left_jacobian_inverse(error) @ chain.jacobian(q, "body")
    slope = derivative(lambda x: tk.pose_error(chain.fk(x), T_goal, frame="body"), q)
    assert_close(slope, expected, atol=1e-8)  # twists bend more than poses


@given(T=poses(), axis=unit_vectors(), angle=st.floats(0.0, np.pi / 2 - 1e-3))
def test_cross_is_the_tangent_and_the_printed_equation(T, axis, angle: float):
    goal = turned(T, angle * axis)
    error = tk.pose_error(T, goal, method="cross")
    atol = 1e-14 / np.cos(angle) ** 2  # the slope of the tangent
    assert_close(error, [1.0, -2.0, 3.0, *np.tan(angle) * axis], atol)
    assert_close(error[3:], cross_error(T[:3, :3], goal[:3, :3]), atol)
    body = np.kron(np.eye(2), T[:3, :3].T) @ error
    assert_close(tk.pose_error(T, goal, method="cross", frame="body"), body, atol)


@given(T=poses(), axis=unit_vectors(), angle=st.floats(np.pi / 2 + 1e-12, np.pi))
def test_cross_is_refused_where_it_points_the_wrong_way(T, axis, angle: float):
    with pytest.raises(ValueError, match=r"^T_goal: .* rad from T, expected less than pi/2"):
        tk.pose_error(T, turned(T, angle * axis), method="cross")


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize("rounded", [np.rint, np.asarray])
def test_cross_is_refused_at_a_quarter_turn(axis: int, sign: int, rounded):
    """Of zeros and ones, or as sine and cosine give it: L is singular, to rounding."""
    T_goal = np.eye(4)
    T_goal[:3, :3] = rounded(rotation_matrix(sign * np.pi / 2 * np.eye(3)[axis]))
    with pytest.raises(ValueError, match=r"^T_goal: "):
        tk.pose_error(np.eye(4), T_goal, method="cross")


@pytest.mark.parametrize("axis", DEGENERATE_AXES, ids=str)
def test_at_half_a_turn_the_sign_is_chosen_and_always_the_same(axis):
    half_turn = np.eye(4)
    half_turn[:3, :3] = 2.0 * np.outer(axis, axis) - np.eye(3)
    first = axis[np.flatnonzero(axis)[0]]
    for T_goal in (half_turn, half_turn.T):
        error = tk.pose_error(np.eye(4), T_goal)
        assert_close(error[3:], np.pi * np.sign(first) * axis, atol=ATOL)
        assert_close(tk.pose_error(np.eye(4), T_goal, frame="body")[3:], error[3:], atol=0.0)


@given(T=poses())
def test_from_a_pose_to_itself_nothing_is_missing(T):
    for options in ({}, {"frame": "body"}, {"method": "cross"}):
        assert_close(tk.pose_error(T, T, **options), np.zeros(6), atol=1e-15)


@pytest.mark.parametrize("options", [{}, {"frame": "body"}, {"method": "cross"}], ids=str)
def test_a_single_pose_goes_with_every_one_of_a_batch(options):
    robot = tk.robots.thing()
    q = robot.random(rng=1)
    A, B = robot.fk(q + np.linspace(0.0, 0.1, 5)[:, None]), robot.fk(q + np.full((5, 9), 0.05))
    each = [tk.pose_error(a, b, **options) for a, b in zip(A, B, strict=True)]
    assert_array_equal(tk.pose_error(A, B, **options), each)
    assert_array_equal(tk.pose_error(A, B[0], **options), each)
    from_one = [tk.pose_error(A[0], b, **options) for b in B]
    assert_array_equal(tk.pose_error(A[0], B, **options), from_one)
    for empty in (tk.pose_error(A[:0], B[0]), tk.pose_error(A[0], B[:0])):
        assert empty.shape == (0, 6)
    with pytest.raises(ValueError, match=r"^T_goal: got 4 poses, expected 5"):
        tk.pose_error(A, B[:4], **options)
