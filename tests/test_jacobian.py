"""Geometric Jacobian against differences of the poses, Pinocchio and KDL, on random chains."""

import numpy as np
import pytest
from hypothesis import given
from numpy.testing import assert_array_equal

import thing_kin as tk
from oracles import PinocchioChain, assert_close, dh_fk_all, jacobian_by_differences
from strategies import Case, cases
from thing_kin.kdl import KdlChain

FRAMES = ("world_aligned", "body", "world")
ATOL = 1e-12  # sums of twelve products of entries up to 40 m
ATOL_DIFFERENCES = 1e-9  # see oracles.derivative


@pytest.mark.parametrize("frame", FRAMES)
@given(case=cases())
def test_it_is_the_velocity_of_the_pose(frame: str, case: Case):
    expected = jacobian_by_differences(lambda q: dh_fk_all(case.rows, q)[-1], case.q, frame)
    assert_close(case.chain.jacobian(case.q, frame), expected, atol=ATOL_DIFFERENCES)


@pytest.mark.parametrize("frame", FRAMES)
@given(case=cases())
def test_of_any_frame_it_is_the_velocity_of_that_frame(frame: str, case: Case):
    chain, of = case.chain, case.frame
    expected = jacobian_by_differences(lambda q: chain.fk(q, of), case.q, frame)
    assert_close(chain.jacobian(case.q, frame, of), expected, atol=ATOL_DIFFERENCES)


@pytest.mark.parametrize("frame", FRAMES)
@given(case=cases())
def test_it_is_that_of_pinocchio(frame: str, case: Case):
    pinocchio, of = PinocchioChain(case.rows), case.frame
    assert_close(case.chain.jacobian(case.q, frame), pinocchio.jacobian(case.q, frame), atol=ATOL)
    if of > 0:  # of its universe Pinocchio gives no Jacobian
        expected = pinocchio.jacobian(case.q, frame, of)
        assert_close(case.chain.jacobian(case.q, frame, of), expected, atol=ATOL)


@given(cases())
def test_it_is_that_of_kdl(case: Case):
    assert_close(case.chain.jacobian(case.q), KdlChain(case.chain).jacobian(case.q), atol=ATOL)


@given(cases())
def test_the_three_frames_are_one_twist_seen_from_three_places(case: Case):
    J, body, world = (case.chain.jacobian(case.q, frame, case.frame) for frame in FRAMES)
    T = case.chain.fk(case.q, case.frame)
    R = T[:3, :3]
    assert_close(J, np.kron(np.eye(2), R) @ body, atol=ATOL)
    assert_close(world, tk.lie.se3_adjoint(T) @ body, atol=1e-11)  # products of two lengths


@given(cases())
def test_a_frame_is_moved_only_by_the_joints_before_it(case: Case):
    moving = sum(row.joint != "fixed" for row in case.rows[: case.frame])
    J = case.chain.jacobian(case.q, of=case.frame)
    assert_array_equal(J[:, moving:], 0.0)
    assert np.all(np.linalg.norm(J[:, :moving], axis=0) > 1.0 - 1e-12)  # an axis is a unit vector


@given(cases())
def test_a_prismatic_column_is_its_axis_and_turns_nothing(case: Case):
    J = case.chain.jacobian(case.q)
    slides = [joint == "prismatic" for joint in case.chain.joint_types]
    assert_array_equal(J[3:, slides], 0.0)
    assert_close(np.linalg.norm(J[:3, slides], axis=0), np.ones(sum(slides)), atol=1e-14)


def test_algorithm_1_as_printed_would_lose_the_base():
    """[M17] Algorithm 1 multiplies z by `rev`, which makes both columns of the base vanish."""
    J = tk.robots.thing().jacobian(np.zeros(9))
    assert_array_equal(J[:, 6:8], np.eye(6)[:, :2])


def test_a_planar_arm_by_hand():
    arm = tk.Chain.from_dh([tk.DH(a=1.0, joint="revolute"), tk.DH(a=0.5, joint="revolute")])
    q = np.array([0.3, 0.9])
    x1, y1 = np.cos(0.3), np.sin(0.3)
    x2, y2 = 0.5 * np.cos(1.2), 0.5 * np.sin(1.2)
    expected = [[-y1 - y2, -y2], [x1 + x2, x2], [0, 0], [0, 0], [0, 0], [1, 1]]
    assert_close(arm.jacobian(q), expected, atol=1e-15)


def test_frames_by_name_and_by_index_are_the_same():
    robot = tk.robots.thing()
    q = robot.random(rng=1)
    for i, name in enumerate(robot.frames):
        assert_array_equal(robot.jacobian(q, of=i), robot.jacobian(q, of=name))
    assert_array_equal(robot.jacobian(q, of="tool"), robot.jacobian(q))
