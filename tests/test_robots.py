"""The robots of the theses: geometry against their tables, limits against their sources."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import thing_kin as tk
from oracles import assert_close, dh_fk_all, rotation_z, translation

PI = np.pi

# [M17] Table A.1: d, theta, a, alpha, joint. The joint variable adds to the offset.
TABLE_A_1 = [
    tk.DH(0.0, PI / 2, 0.0, PI / 2),
    tk.DH(0.0, PI / 2, 0.0, PI / 2, "prismatic"),
    tk.DH(0.0, PI / 2, 0.0, PI / 2, "prismatic"),
    tk.DH(0.0, 0.0, 0.0, 0.0, "revolute"),
    tk.DH(0.653, 0.0, 0.27, 0.0),
    tk.DH(0.0, PI / 2, 0.01, 0.0),
    tk.DH(0.1273, 0.0, 0.0, PI / 2, "revolute"),
    tk.DH(0.0, 0.0, -0.612, 0.0, "revolute"),
    tk.DH(0.0, 0.0, -0.5723, 0.0, "revolute"),
    tk.DH(0.163941, 0.0, 0.0, PI / 2, "revolute"),
    tk.DH(0.1157, 0.0, 0.0, -PI / 2, "revolute"),
    tk.DH(0.0922, 0.0, 0.0, 0.0, "revolute"),
]
# The table lists the base first; its frames in the names of robots.thing(). Row 5 has none there.
FRAMES = {4: "base", 6: "mount", 7: "shoulder", 8: "upper_arm", 9: "forearm", 12: "tool"}


def base_first(q):
    return np.concatenate([q[6:], q[:6]])


def test_the_thing_is_table_a_1():
    robot = tk.robots.thing()
    for q in [np.zeros(9), *robot.random(50, rng=1)]:
        frames = dh_fk_all(TABLE_A_1, base_first(q))
        for row, name in FRAMES.items():
            assert_close(robot.fk(q, name), frames[row], atol=1e-12)


def test_the_thing_base_first_is_the_table_s_own_order():
    robot, table = tk.robots.thing(order="base_first"), tk.Chain.from_dh(TABLE_A_1)
    assert robot.names == ("x", "y", "theta", "q0", "q1", "q2", "q3", "q4", "q5")
    Q = robot.random(50, rng=2)
    assert_close(robot.fk(Q), table.fk(Q), atol=1e-12)
    assert_close(robot.jacobian(Q), table.jacobian(Q), atol=1e-12)


def test_rows_1_to_4_are_the_planar_pose():
    """And rows 1 to 3 at zero the identity."""
    rows = tk.Chain.from_dh(TABLE_A_1[:4])
    assert_array_equal(rows.fk_all(np.zeros(3))[3:], [np.eye(4)] * 2)
    for x, y, theta in [(1.0, 2.0, 0.5), (-3.0, 0.0, -3.0), (0.0, 4.0, 2.0)]:
        expected = translation(x, y, 0.0) @ rotation_z(theta)
        assert_close(rows.fk([x, y, theta]), expected, atol=1e-15)


def test_the_thing_at_zero():
    robot = tk.robots.thing()
    assert robot.names == ("q0", "q1", "q2", "q3", "q4", "q5", "x", "y", "theta")
    assert_close(robot.fk(np.zeros(9))[:3, 3], [0.526141, -1.1743, 0.6646], atol=1e-12)


UR5 = {
    "d": [0.089159, 0, 0, 0.10915, 0.09465, 0.0823],
    "a": [0, -0.425, -0.39225, 0, 0, 0],
    "alpha": [PI / 2, 0, 0, PI / 2, -PI / 2, 0],
}


def ur_rows(d, a, alpha):
    return [tk.DH(d[i], 0.0, a[i], alpha[i], "revolute") for i in range(6)]


def test_the_ur5_is_the_table_of_x21_and_the_ur10_the_arm_of_the_thing():
    ur5, ur10 = tk.robots.ur5(), tk.robots.ur10()
    for q in ur5.random(20, rng=3):
        assert_close(ur5.fk_all(q), dh_fk_all(ur_rows(**UR5), q), atol=1e-13)
        assert_close(ur10.fk_all(q), dh_fk_all(TABLE_A_1[6:], q), atol=1e-13)


def test_the_pioneer_carries_the_ur5_where_its_mount_says():
    q = np.append(np.ones(6), [1.0, 2.0, 0.5])
    base = translation(1.0, 2.0, 0.0) @ rotation_z(0.5)
    arm = tk.robots.ur5().fk(q[:6])
    stated = translation(0.075, 0.0, 0.448)
    mount = tk.transform(xyz=(0.1, -0.2, 0.3), rpy=(0.1, 0.2, 0.3))
    default, given = tk.robots.pioneer_lx_ur5(), tk.robots.pioneer_lx_ur5(mount)
    assert_close(default.fk(q), base @ stated @ arm, atol=1e-14)
    assert_close(given.fk(q), base @ mount @ arm, atol=1e-14)
    other = tk.robots.pioneer_lx_ur5(mount, order="base_first")
    assert_array_equal(other.fk(np.concatenate([q[6:], q[:6]])), given.fk(q))


@pytest.mark.parametrize("robot", [tk.robots.ur5(), tk.robots.ur10(), tk.robots.thing()], ids=repr)
def test_arms_turn_twice_either_way(robot: tk.Chain):
    assert_array_equal(robot.lower[:6], np.full(6, -2 * PI))
    assert_array_equal(robot.upper[:6], np.full(6, 2 * PI))


def test_rates_of_the_arms():
    fast, slow = np.deg2rad(180.0), np.deg2rad(120.0)
    assert_close(tk.robots.ur5().velocity_limits, np.full(6, fast), atol=1e-15)
    expected = [slow, slow, fast, fast, fast, fast]
    for robot in (tk.robots.ur10(), tk.robots.thing()):
        assert_close(robot.velocity_limits[:6], expected, atol=1e-15)
        assert_array_equal(robot.acceleration_limits[:6], np.full(6, 5.0))


def test_limits_of_the_bases():
    for robot in (tk.robots.thing(), tk.robots.pioneer_lx_ur5()):
        assert_array_equal(robot.lower[6:], [-5.0, -5.0, -PI])
        assert_array_equal(robot.upper[6:], [5.0, 5.0, PI])
    assert_array_equal(tk.robots.thing().velocity_limits[6:], [1.1, 1.1, 2.0])
    assert_array_equal(tk.robots.thing().acceleration_limits[6:], [2.5, 2.5, 1.0])
    pioneer = tk.robots.pioneer_lx_ur5()
    assert_close(pioneer.velocity_limits[6:], [1.8, 1.8, PI], atol=1e-15)
    assert_close(pioneer.acceleration_limits[6:], [0.5, 0.5, np.deg2rad(150.0)], atol=1e-15)


@pytest.mark.parametrize("make", [tk.robots.thing, tk.robots.pioneer_lx_ur5])
def test_given_base_limits_keep_the_rates(make):
    default, robot = make(), make(base_limits=[(-1, 1), (-2, 2), (-3, 3)])
    assert_array_equal(robot.lower[6:], [-1, -2, -3])
    assert_array_equal(robot.upper[6:], [1, 2, 3])
    assert_array_equal(robot.velocity_limits, default.velocity_limits)
    assert_array_equal(robot.acceleration_limits, default.acceleration_limits)
