"""An arm on an omnidirectional base: a planar pose, a mount, and the arm's own kinematics."""

import numpy as np
import pytest
from hypothesis import given
from numpy.testing import assert_array_equal

import thing_kin as tk
from oracles import assert_close, dh_fk_all, rotation_z, translation
from strategies import Case, cases, poses

ATOL = 1e-12  # as in test_posture.py


def planar(x: float, y: float, theta: float):
    return translation(x, y, 0.0) @ rotation_z(theta)


@given(case=cases(), mount=poses())
def test_it_is_base_pose_mount_and_arm_in_a_row(case: Case, mount):
    base = np.array([1.5, -2.5, 0.7])
    robot = tk.on_omni_base(case.chain, mount)
    q = np.append(case.q, base)
    arm = dh_fk_all(case.rows, case.q)
    assert_close(robot.fk(q), planar(*base) @ mount @ arm[-1], ATOL)
    name = case.chain.frames[case.frame] if case.frame > 0 else "mount"
    assert_close(robot.fk(q, name), planar(*base) @ mount @ arm[case.frame], ATOL)


@given(case=cases(max_rows=5), mount=poses())
def test_base_first_is_the_same_robot_in_another_order(case: Case, mount):
    base = [1.5, -2.5, 0.7]
    robot = tk.on_omni_base(case.chain, mount)
    other = tk.on_omni_base(case.chain, mount, order="base_first")
    q, p = np.append(case.q, base), np.append(base, case.q)
    assert_array_equal(other.fk_all(p), robot.fk_all(q))
    assert_array_equal(other.jacobian(p)[:, :3], robot.jacobian(q)[:, -3:])
    assert_array_equal(other.jacobian(p)[:, 3:], robot.jacobian(q)[:, :-3])
    assert_array_equal(other.base_pose(p), robot.base_pose(q))


@pytest.mark.parametrize("pose", [(0, 0, 0), (1, 2, 0.5), (-3, 0.1, -3.0), (0, 0, 7.0)], ids=str)
def test_the_base_frames(pose):
    robot = tk.on_omni_base(tk.robots.ur5())
    x, y, _ = pose
    q = np.append(np.zeros(6), pose)
    assert_close(robot.fk(q, "base"), planar(*pose), atol=1e-15)
    assert_array_equal(robot.fk(q, "world"), np.eye(4))
    assert_array_equal(robot.fk(q, "base_root")[:3, 3], np.zeros(3))
    assert_array_equal(robot.fk(q, "base_x")[:3, 3], [x, 0, 0])
    assert_array_equal(robot.fk(q, "base_y")[:3, 3], [x, y, 0])


def test_names_frames_and_places_of_the_base():
    arm = tk.robots.ur5()
    arm_first, base_first = tk.on_omni_base(arm), tk.on_omni_base(arm, order="base_first")
    assert arm_first.names == (*arm.names, "x", "y", "theta")
    assert base_first.names == ("x", "y", "theta", *arm.names)
    assert arm_first.joint_types == (*["revolute"] * 6, "prismatic", "prismatic", "revolute")
    assert list(arm_first.base_joints) == [6, 7, 8]
    assert list(base_first.base_joints) == [0, 1, 2]
    base = ("world", "base_root", "base_x", "base_y", "base", "mount")
    assert arm_first.frames == base_first.frames == (*base, *arm.frames[1:])
    assert arm_first.name == "ur5 on an omnidirectional base"
    assert tk.on_omni_base(arm, name="rover").name == "rover"


def test_limits_of_the_base_unless_given_and_of_the_arm_as_they_were():
    arm = tk.robots.ur5()
    robot = tk.on_omni_base(arm)
    assert_array_equal(robot.lower, [*arm.lower, -5.0, -5.0, -np.pi])
    assert_array_equal(robot.upper, [*arm.upper, 5.0, 5.0, np.pi])
    assert_array_equal(robot.velocity_limits, [*arm.velocity_limits, *[np.inf] * 3])
    assert_array_equal(robot.acceleration_limits, [*arm.acceleration_limits, *[np.inf] * 3])


@pytest.mark.parametrize(("order", "place"), [("arm_first", 6), ("base_first", 0)])
def test_given_limits_of_the_base(order: str, place: int):
    robot = tk.on_omni_base(
        tk.robots.ur5(),
        base_limits=[(-1, 2), (-3, 4), (-np.inf, np.inf)],
        base_velocity_limits=(1, 2, 3),
        base_acceleration_limits=(4, 5, 6),
        order=order,
    )
    base = slice(place, place + 3)
    assert_array_equal(robot.lower[base], [-1, -3, -np.inf])
    assert_array_equal(robot.upper[base], [2, 4, np.inf])
    assert_array_equal(robot.velocity_limits[base], [1, 2, 3])
    assert_array_equal(robot.acceleration_limits[base], [4, 5, 6])
    theta = robot.random(200, rng=1)[:, place + 2]  # continuous: drawn in a turn
    assert np.abs(theta).max() <= np.pi


def test_without_a_mount_the_arm_stands_on_the_base_s_origin():
    robot = tk.on_omni_base(tk.robots.ur5())
    assert robot == tk.on_omni_base(tk.robots.ur5(), mount=np.eye(4))
    q = np.append(tk.robots.ur5().random(rng=1), np.zeros(3))
    assert_close(robot.fk(q), tk.robots.ur5().fk(q[:6]), atol=1e-15)


def test_what_cannot_stand_on_a_base():
    with pytest.raises(ValueError, match=r"^arm: got 'thing', which has a base"):
        tk.on_omni_base(tk.robots.thing())
    arm = tk.Chain.from_dh([tk.DH(joint="revolute", name="theta")])
    with pytest.raises(ValueError, match=r"^joint names: got 'theta' twice"):
        tk.on_omni_base(arm)
