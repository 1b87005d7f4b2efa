"""The exact Hessian against differences of the Jacobian, and its structure, on random chains."""

import numpy as np
import pytest
from hypothesis import given
from numpy.testing import assert_array_equal

import thing_kin as tk
from oracles import PinocchioChain, assert_close, derivative
from strategies import Case, cases

FRAMES = ("world_aligned", "body", "world")
# See oracles.derivative; the spatial Jacobian's moments grow with the length squared.
ATOL = 1e-9


@pytest.mark.parametrize("frame", FRAMES)
@given(case=cases())
def test_it_is_the_derivative_of_the_jacobian(frame: str, case: Case):
    for of in (None, case.frame):
        expected = derivative(lambda q, of=of: case.chain.jacobian(q, frame, of), case.q)
        H = case.chain.hessian(case.q, frame, of)
        assert H.shape == (6, case.chain.n, case.chain.n)
        assert_close(H, expected, atol=ATOL)


@pytest.mark.parametrize("frame", FRAMES)
@given(case=cases())
def test_it_is_the_derivative_of_another_library_s_jacobian(frame: str, case: Case):
    pinocchio = PinocchioChain(case.rows)
    expected = derivative(lambda q: pinocchio.jacobian(q, frame), case.q)
    assert_close(case.chain.hessian(case.q, frame), expected, atol=ATOL)


@given(cases())
def test_second_derivatives_of_the_position_commute(case: Case):
    linear = case.chain.hessian(case.q)[:3]
    assert_close(linear, linear.transpose(0, 2, 1), atol=1e-12)


@pytest.mark.parametrize("frame", FRAMES)
@given(case=cases())
def test_rotations_do_not_commute_and_differ_by_the_bracket(frame: str, case: Case):
    """d w_i/dq_k - d w_k/dq_i = w_k x w_i in axes of the world, its opposite in the body's."""
    sign = -1.0 if frame == "body" else 1.0
    w = case.chain.jacobian(case.q, frame)[3:]
    H = case.chain.hessian(case.q, frame)[3:]
    brackets = np.cross(w[:, None, :], w[:, :, None], axis=0)  # [:, i, k] = w_k x w_i
    assert_close(H - H.transpose(0, 2, 1), sign * brackets, atol=1e-12)


@given(cases())
def test_joints_after_the_frame_have_no_part(case: Case):
    moving = sum(row.joint != "fixed" for row in case.rows[: case.frame])
    for frame in FRAMES:
        H = case.chain.hessian(case.q, frame, case.frame)
        assert_array_equal(H[:, moving:, :], 0.0)
        assert_array_equal(H[:, :, moving:], 0.0)


@pytest.mark.parametrize("order", ["arm_first", "base_first"])
def test_it_holds_on_the_thing_in_both_orders(order: str):
    robot = tk.robots.thing(order=order)
    for q in robot.random(5, rng=2):
        for frame in FRAMES:
            expected = derivative(lambda q, frame=frame: robot.jacobian(q, frame), q)
            assert_close(robot.hessian(q, frame), expected, atol=ATOL)
