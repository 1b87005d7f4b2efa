"""Time derivative of the Jacobian: differences, Pinocchio, the Hessian; points fixed to frames."""

import numpy as np
import pytest
from hypothesis import given
from numpy.testing import assert_array_equal

import thing_kin as tk
from oracles import PinocchioChain, assert_close, derivative, time_derivative
from strategies import Case, Motion, cases, motions

FRAMES = ("world_aligned", "body", "world")
ATOL = 1e-12  # sums of twelve products of rates up to 1 and lengths up to 25 m
ATOL_DIFFERENCES = 1e-9  # see oracles.derivative

frames = pytest.mark.parametrize("frame", FRAMES)


@frames
@given(motion=motions())
def test_it_is_the_derivative_of_the_jacobian(frame: str, motion: Motion):
    chain, of = motion.case.chain, motion.case.frame
    expected = time_derivative(
        lambda q: chain.jacobian(q, frame, of, motion.point), motion.case.q, motion.qd
    )
    dJ = chain.jacobian_dot(motion.case.q, motion.qd, frame, of, motion.point)
    assert_close(dJ, expected, atol=ATOL_DIFFERENCES)


@frames
@given(motion=motions())
def test_it_is_that_of_pinocchio(frame: str, motion: Motion):
    case, pinocchio = motion.case, PinocchioChain(motion.case.rows)
    for of in {case.frame, len(case.rows)} - {0}:  # of its universe Pinocchio gives none
        expected = pinocchio.jacobian_dot(
            case.q, motion.qd, frame, pinocchio.add_point(of, motion.point)
        )
        dJ = case.chain.jacobian_dot(case.q, motion.qd, frame, of, motion.point)
        assert_close(dJ, expected, atol=ATOL)


@frames
@given(motion=motions())
def test_it_is_the_hessian_times_the_velocities(frame: str, motion: Motion):
    case = motion.case
    H = case.chain.hessian(case.q, frame, case.frame, motion.point)
    dJ = case.chain.jacobian_dot(case.q, motion.qd, frame, case.frame, motion.point)
    assert_close(dJ, H @ motion.qd, atol=ATOL)


@frames
@given(case=cases())
def test_what_stands_still_changes_nothing(frame: str, case: Case):
    still = np.zeros(case.chain.n)
    assert_array_equal(case.chain.jacobian_dot(case.q, still, frame, case.frame), 0.0)
    assert_array_equal(case.chain.jacobian_dot(case.q, still + 1.0, frame, of=0), 0.0)


@frames
def test_of_one_joint_about_its_own_axis(frame: str):
    """Its twist is constant; its velocity in axes of the world turns with the hand."""
    arm = tk.Chain.from_dh([tk.DH(a=2.0, joint="revolute")])
    expected = [[-6.0], [0], [0], [0], [0], [0]] if frame == "world_aligned" else np.zeros((6, 1))
    assert_array_equal(arm.jacobian_dot([0.0], [3.0], frame), expected)


@frames
def test_sliding_joints_alone_turn_no_axis(frame: str):
    rng = np.random.default_rng(3)
    rows = [tk.DH(*rng.uniform(-1, 1, 4), joint="prismatic") for _ in range(5)]
    chain = tk.Chain.from_dh(rows)
    assert_array_equal(chain.jacobian_dot(rng.normal(size=5), rng.normal(size=5), frame), 0.0)


@frames
def test_joints_after_the_frame_have_no_part(frame: str):
    robot = tk.robots.thing()
    q, qd = robot.random(2, rng=3)
    dJ = robot.jacobian_dot(q, qd, frame, of="wrist_1")
    other = qd.copy()
    other[4:6] += 1.0  # wrist_2 and wrist_3
    assert_array_equal(dJ[:, 4:6], 0.0)
    assert_array_equal(robot.jacobian_dot(q, other, frame, of="wrist_1"), dJ)


@frames
def test_both_orders_of_the_thing_have_the_same_columns(frame: str):
    arm_first, base_first = tk.robots.thing(), tk.robots.thing(order="base_first")
    to_base_first = [arm_first.names.index(name) for name in base_first.names]
    Q, Qd = arm_first.random(10, rng=1), arm_first.random(10, rng=2)
    expected = arm_first.jacobian_dot(Q, Qd, frame)[..., to_base_first]
    dJ = base_first.jacobian_dot(Q[:, to_base_first], Qd[:, to_base_first], frame)
    assert_array_equal(dJ, expected)


# A point fixed to a frame, of the Jacobian and the Hessian too.


@frames
@given(motion=motions())
def test_the_jacobian_of_a_point_is_that_of_a_tool_there(frame: str, motion: Motion):
    case = motion.case
    there = case.chain.with_tool(tk.transform(xyz=motion.point), frame="there")
    J = case.chain.jacobian(case.q, frame, point=motion.point)
    assert_close(J, there.jacobian(case.q, frame), atol=ATOL)
    H = case.chain.hessian(case.q, frame, point=motion.point)
    assert_close(H, there.hessian(case.q, frame), atol=1e-11)  # products of two lengths


@given(motions())
def test_the_jacobian_of_a_point_is_its_velocity(motion: Motion):
    case = motion.case
    at = np.append(motion.point, 1.0)
    expected = derivative(lambda q: (case.chain.fk(q, case.frame) @ at)[:3], case.q)
    J = case.chain.jacobian(case.q, of=case.frame, point=motion.point)
    assert_close(J[:3], expected, atol=ATOL_DIFFERENCES)
    assert_array_equal(J[3:], case.chain.jacobian(case.q, of=case.frame)[3:])


@given(motions())
def test_a_spatial_twist_has_no_point(motion: Motion):
    case = motion.case
    for method in (case.chain.jacobian, case.chain.hessian):
        assert_array_equal(method(case.q, "world", point=motion.point), method(case.q, "world"))


def test_the_hessian_of_a_point_is_the_derivative():
    robot, point = tk.robots.thing(), (0.3, -0.2, 0.5)
    for frame in FRAMES:
        q = robot.random(rng=4)
        expected = derivative(lambda q, frame=frame: robot.jacobian(q, frame, "forearm", point), q)
        assert_close(robot.hessian(q, frame, "forearm", point), expected, atol=ATOL_DIFFERENCES)


# Batches and what is wrong.


@frames
def test_batches_are_what_single_calls_give(frame: str):
    robot = tk.robots.thing()
    Q, Qd = robot.random(7, rng=5), robot.random(7, rng=6)
    one = [robot.jacobian_dot(q, qd, frame) for q, qd in zip(Q, Qd, strict=True)]
    assert_array_equal(robot.jacobian_dot(Q, Qd, frame), one)
    assert_array_equal(
        robot.jacobian_dot(Q[0], Qd, frame), [robot.jacobian_dot(Q[0], qd, frame) for qd in Qd]
    )
    assert_array_equal(
        robot.jacobian_dot(Q, Qd[0], frame), [robot.jacobian_dot(q, Qd[0], frame) for q in Q]
    )
    assert robot.jacobian_dot(Q[:0], Qd[:0], frame).shape == (0, 6, 9)
    assert robot.jacobian_dot(Q[:0], Qd[0], frame).shape == (0, 6, 9)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"q": np.zeros(8)}, r"^q: got shape \(8,\), expected \(9,\) or \(N, 9\)"),
        ({"qd": np.zeros(8)}, r"^qd: got shape \(8,\), expected \(9,\) or \(N, 9\)"),
        ({"qd": np.full(9, np.nan)}, "^qd: got nan"),
        ({"qd": np.full(9, 1e60)}, r"^qd: got 1e\+60"),
        ({"q": np.zeros((3, 9)), "qd": np.zeros((2, 9))}, "^qd: got 2 items, expected 3, as many"),
        ({"frame": "tool"}, "^frame: got 'tool', expected 'world_aligned'"),
        ({"of": "nose"}, "^of: got 'nose'"),
        ({"point": (1.0, 2.0)}, r"^point: got shape \(2,\), expected \(3,\)"),
        ({"point": np.zeros((1, 3))}, r"^point: got shape \(1, 3\), expected \(3,\)"),
        ({"point": (0, 0, np.inf)}, "^point: got inf"),
    ],
)
def test_what_is_wrong_is_named(arguments, message: str):
    given_arguments = {"q": np.zeros(9), "qd": np.zeros(9), **arguments}
    with pytest.raises(ValueError, match=message):
        tk.robots.thing().jacobian_dot(**given_arguments)
