"""Derivatives of position and orientation in coordinates, up to their singularities."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import assume, given
from numpy.testing import assert_array_equal
from scipy.spatial.transform import Rotation

import thing_kin as tk
from oracles import assert_close, derivative
from strategies import Case, Motion, cases, motions

# See oracles.derivative; the rates of roll and yaw grow with 1/cos(pitch), here below 10, and their
# derivatives with its powers, so that these differences keep fewer digits.
ATOL_DIFFERENCES, ATOL_RPY_DIFFERENCES = 1e-9, 1e-5
ATOL = 1e-12

# R = Ry(q), then Rx(q): the pitch itself is a joint.
PITCH = tk.Chain.from_dh(
    [
        tk.DH(alpha=-np.pi / 2),
        tk.DH(alpha=np.pi / 2, joint="revolute", frame="nose"),
        tk.DH(theta=np.pi / 2, alpha=np.pi / 2),
        tk.DH(joint="revolute"),
    ]
)
ROBOTS = [tk.robots.thing(), tk.robots.thing(order="base_first"), tk.robots.pioneer_lx_ur5()]
robots = pytest.mark.parametrize("robot", ROBOTS, ids=lambda r: f"{r.name} {r.names[0]}")
orientations = pytest.mark.parametrize("orientation", ["quaternion", "rpy"])


def product(a, b):
    """Of quaternions (w, x, y, z)."""
    vector = a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])
    return np.concatenate([[a[0] * b[0] - a[1:] @ b[1:]], vector])


def near(x, reference, orientation: str):
    """The branch of the coordinates that `reference` is on."""
    if orientation == "quaternion":
        return x * np.sign(x @ reference)
    return x + 2 * np.pi * np.round((reference - x) / (2 * np.pi))


def coordinates(R, orientation: str):
    if orientation == "quaternion":
        return Rotation.from_matrix(R).as_quat(scalar_first=True)
    return Rotation.from_matrix(R).as_euler("xyz")  # fixed axes


@orientations
@given(motion=motions())
def test_it_is_the_derivative_of_the_coordinates(orientation: str, motion: Motion):
    chain, of = motion.case.chain, motion.case.frame
    R = chain.fk(motion.case.q, of)[:3, :3]
    assume(orientation == "quaternion" or np.hypot(R[2, 1], R[2, 2]) > 0.1)
    here = (
        tk.lie.quaternion_from_rotation(R)
        if orientation == "quaternion"
        else coordinates(R, orientation)
    )

    def of_q(q):
        T = chain.fk(q, of)
        angles = near(coordinates(T[:3, :3], orientation), here, orientation)
        return np.concatenate([(T @ np.append(motion.point, 1.0))[:3], angles])

    J = chain.analytic_jacobian(motion.case.q, orientation, of, motion.point)
    atol = ATOL_DIFFERENCES if orientation == "quaternion" else ATOL_RPY_DIFFERENCES
    assert_close(J, derivative(of_q, motion.case.q), atol=atol)


@given(motions())
def test_a_quaternion_s_rate_is_half_the_velocity_times_it(motion: Motion):
    """2 dQ/dq_k Q* = (0, w_k), up to a whole turn of Q; and Q stays of unit length."""
    case = motion.case
    J = case.chain.jacobian(case.q, of=case.frame, point=motion.point)
    A = case.chain.analytic_jacobian(case.q, of=case.frame, point=motion.point)
    Q = tk.lie.quaternion_from_rotation(case.chain.fk(case.q, case.frame)[:3, :3])
    assert_array_equal(A[:3], J[:3])
    conjugate = Q * [1, -1, -1, -1]
    for k in range(case.chain.n):
        expected = np.concatenate([[0.0], J[3:, k]])
        assert_close(2 * product(A[3:, k], conjugate), expected, atol=1e-14)


@given(motions())
def test_rates_of_roll_pitch_yaw_give_the_velocity_of_pinocchio(motion: Motion):
    case = motion.case
    R = case.chain.fk(case.q, case.frame)[:3, :3]
    cosine = np.hypot(R[2, 1], R[2, 2])
    assume(cosine > 1e-6)
    A = case.chain.analytic_jacobian(case.q, "rpy", case.frame, motion.point)
    J = case.chain.jacobian(case.q, of=case.frame, point=motion.point)
    rates_to_velocity = pin.rpy.computeRpyJacobian(
        tk.lie.rpy_from_rotation(R), pin.LOCAL_WORLD_ALIGNED
    )
    assert_array_equal(A[:3], J[:3])
    # Sines and cosines of the three angles have a few eps; the rates are their quotients.
    assert_close(rates_to_velocity @ A[3:], J[3:], atol=1e-14 / cosine)


@orientations
@given(case=cases())
def test_of_the_root_it_is_zero(orientation: str, case: Case):
    rows = 7 if orientation == "quaternion" else 6
    J = case.chain.analytic_jacobian(case.q, orientation, of=0)
    assert_array_equal(J, np.zeros((rows, case.chain.n)))


# Where a quaternion changes its sign.


@pytest.mark.parametrize("distance", [1e-3, 1e-9, 1e-14])
def test_beside_half_a_turn_it_is_that_of_the_branch_taken(distance: float):
    arm = tk.Chain.from_dh([tk.DH(joint="revolute")])
    for sign, angle in ((1.0, np.pi - distance), (-1.0, np.pi + distance)):
        J = arm.analytic_jacobian([angle])[3:, 0]
        expected = sign * np.array([-np.sin(angle / 2), 0.0, 0.0, np.cos(angle / 2)]) / 2
        assert_close(J, expected, atol=1e-15)


@pytest.mark.parametrize("turns", [-1.0, 1.0])
def test_at_half_a_turn_it_is_that_of_the_axis_chosen(turns: float):
    """quaternion_from_rotation gives (0, 0, 0, 1) for both."""
    arm = tk.Chain.from_dh([tk.DH(joint="revolute")])
    J = arm.analytic_jacobian([turns * np.pi])[3:, 0]
    assert_close(J, [-0.5, 0.0, 0.0, 0.0], atol=1e-15)


# Where roll and yaw have no rates.


@pytest.mark.parametrize("distance", [0.0, 1e-12, -1e-12, 9e-10])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_at_a_pitch_of_a_quarter_turn_there_are_no_rates(sign: float, distance: float):
    pitch = sign * (np.pi / 2 - distance)
    message = rf"^q: got a pitch of {sign * 1.5708:g} rad of frame 'nose', expected .*pi/2"
    with pytest.raises(ValueError, match=message):
        PITCH.analytic_jacobian([pitch, 0.3], "rpy", of="nose")
    assert np.isfinite(PITCH.analytic_jacobian([pitch, 0.3], of="nose")).all()


@pytest.mark.parametrize("distance", [2e-9, -2e-9, 1e-6, 0.1])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_beside_it_they_are_right(sign: float, distance: float):
    """Beyond a quarter turn the pitch goes back, and roll and yaw are half a turn away."""
    J = PITCH.analytic_jacobian([sign * (np.pi / 2 - distance), 0.0], "rpy", of="nose")
    # The axis is exactly y, but for eps/distance.
    atol = 4e-15 / abs(distance)
    assert_close(J[3:, 0], [0.0, np.sign(distance), 0.0], atol=atol)


def test_in_a_batch_the_item_is_named():
    Q = np.array([[0.1, 0.0], [0.2, 0.0], [-np.pi / 2, 0.0], [np.pi / 2, 0.0]])
    with pytest.raises(ValueError, match=r"^q: got a pitch of -1\.5708 rad .* in item 2, expected"):
        PITCH.analytic_jacobian(Q, "rpy", of="nose")
    tilted = np.zeros((2, 9))
    tilted[1, 5] = np.pi / 2  # at zero the tool's y is up, and joint 5 turns about its z
    with pytest.raises(ValueError, match=r"^q: got a pitch of .* frame 'tool' in item 1, expected"):
        tk.robots.thing().task_jacobian(tilted, "rpy")
    assert tk.robots.thing().task_jacobian(tilted).shape == (2, 10, 9)


@pytest.mark.parametrize("quarter", [np.pi / 2, -np.pi / 2])
def test_the_task_vector_has_an_answer_there(quarter: float):
    robot = tk.robots.thing()
    q = np.array([0.3, 0, 0, 0, 0, quarter, 0.5, 0.2, 0.1])
    s = robot.task_vector(q, orientation="rpy")
    assert s[3] == 0.0
    assert_close(abs(s[4]), np.pi / 2, atol=1e-7)  # the sine of the pitch is 1 to rounding
    R = tk.lie.rotation_from_rpy(s[3:6])
    assert_close(R, robot.fk(q)[:3, :3], atol=2e-14)  # kGimbalLockTolerance


# The task vector of a robot on a base.


@robots
def test_the_task_vector_in_roll_pitch_yaw(robot: tk.Chain):
    Q = robot.random(100, rng=1)
    S, with_quaternion = robot.task_vector(Q, "rpy"), robot.task_vector(Q)
    assert S.shape == (100, 9)
    assert_array_equal(S[:, :3], with_quaternion[:, :3])
    assert_array_equal(S[:, 6:], with_quaternion[:, 7:])
    expected = Rotation.from_matrix(robot.fk(Q)[:, :3, :3]).as_euler("xyz")
    assert_close(np.cos(S[:, 3:6] - expected), np.ones((100, 3)), atol=1e-15)
    assert_array_equal(S, [robot.task_vector(q, "rpy") for q in Q])


@robots
@orientations
def test_task_jacobian_is_the_derivative_of_the_task_vector(robot: tk.Chain, orientation: str):
    turned = slice(3, -3)
    Q = robot.random(50, rng=2)
    S = robot.task_vector(Q, orientation)
    tame = np.abs(S[:, 3]) > 0.05 if orientation == "quaternion" else np.cos(S[:, 4]) > 0.3
    assert tame.sum() > 20
    for q, here in zip(Q[tame], S[tame], strict=True):

        def of_q(q, here=here):
            s = robot.task_vector(q, orientation)
            s[turned] = near(s[turned], here[turned], orientation)
            return s

        atol = ATOL_DIFFERENCES if orientation == "quaternion" else ATOL_RPY_DIFFERENCES
        assert_close(robot.task_jacobian(q, orientation), derivative(of_q, q), atol=atol)


@robots
@orientations
def test_task_jacobian_is_the_tool_s_above_the_base_s(robot: tk.Chain, orientation: str):
    q = robot.random(rng=3)
    J = robot.task_jacobian(q, orientation)
    assert_array_equal(J[:-3], robot.analytic_jacobian(q, orientation))
    base = np.eye(9)[[robot.names.index(name) for name in ("x", "y", "theta")]]
    assert_array_equal(J[-3:], base)


@orientations
def test_batches_are_what_single_calls_give(orientation: str):
    robot = tk.robots.thing()
    Q = robot.random(6, rng=5)
    options = {"orientation": orientation, "of": "wrist_1", "point": (0.1, 0.2, 0.3)}
    one = [robot.analytic_jacobian(q, **options) for q in Q]
    assert_array_equal(robot.analytic_jacobian(Q, **options), one)
    one = [robot.task_jacobian(q, orientation) for q in Q]
    assert_array_equal(robot.task_jacobian(Q, orientation), one)
    rows = 10 if orientation == "quaternion" else 9
    assert robot.task_jacobian(Q[:0], orientation).shape == (0, rows, 9)


@pytest.mark.parametrize("method", ["analytic_jacobian", "task_jacobian", "task_vector"])
def test_what_is_wrong_is_named(method: str):
    call = getattr(tk.robots.thing(), method)
    with pytest.raises(ValueError, match=r"^orientation: got 'euler', expected 'quaternion' or"):
        call(np.zeros(9), orientation="euler")
    with pytest.raises(ValueError, match=r"^q: got shape \(6,\), expected \(9,\) or \(N, 9\)"):
        call(np.zeros(6))
    with pytest.raises(ValueError, match=r"^q: got nan"):
        call(np.full(9, np.nan), "rpy")


def test_without_a_base_there_is_no_task_jacobian():
    with pytest.raises(ValueError, match=r"^robot: got 'ur5' without a base"):
        tk.robots.ur5().task_jacobian(np.zeros(6))


def test_frames_and_points_are_checked():
    with pytest.raises(ValueError, match=r"^of: got 'nose'"):
        tk.robots.ur5().analytic_jacobian(np.zeros(6), of="nose")
    with pytest.raises(ValueError, match=r"^point: got shape \(4,\), expected \(3,\)"):
        tk.robots.ur5().analytic_jacobian(np.zeros(6), point=np.zeros(4))
