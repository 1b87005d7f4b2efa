"""The ten-dimensional task vector, [M17] (3.3)-(3.5), and the base pose in it."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from scipy.spatial.transform import Rotation

import thing_kin as tk
from oracles import assert_close

ROBOTS = [
    tk.robots.thing(),
    tk.robots.thing(order="base_first"),
    tk.robots.pioneer_lx_ur5(),
]


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda r: f"{r.name} {r.names[0]}")
def test_it_is_position_quaternion_and_base_pose(robot: tk.Chain):
    for q in robot.random(50, rng=1):
        s, T = robot.task_vector(q), robot.fk(q)
        quaternion = Rotation.from_matrix(T[:3, :3]).as_quat(canonical=True, scalar_first=True)
        by_name = dict(zip(robot.names, q, strict=True))
        assert_array_equal(s[:3], T[:3, 3])
        assert_close(s[3:7], quaternion, atol=1e-14)
        assert_array_equal(s[7:], [by_name[name] for name in ("x", "y", "theta")])
        assert_array_equal(s[7:], robot.base_pose(q))


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda r: f"{r.name} {r.names[0]}")
def test_the_quaternion_has_a_sign(robot: tk.Chain):
    S = robot.task_vector(robot.random(1000, rng=2))
    assert np.all(S[:, 3] >= 0.0)
    assert_close(np.linalg.norm(S[:, 3:7], axis=1), np.ones(1000), atol=4e-15)


def test_theta_is_not_wrapped():
    q = np.array([0, 0, 0, 0, 0, 0, 1.0, 2.0, 7.0])
    assert_array_equal(tk.robots.thing().base_pose(q), [1.0, 2.0, 7.0])


def test_at_zero():
    """[M17] Table A.1: at q = 0 the tool is turned by Rz(pi/2) Rx(pi/2)."""
    expected = [0.526141, -1.1743, 0.6646, 0.5, 0.5, 0.5, 0.5, 0.0, 0.0, 0.0]
    assert_close(tk.robots.thing().task_vector(np.zeros(9)), expected, atol=1e-12)


@pytest.mark.parametrize("method", ["task_vector", "base_pose"])
def test_without_a_base_there_is_none(method: str):
    with pytest.raises(ValueError, match=r"^robot: got 'ur5' without a base"):
        getattr(tk.robots.ur5(), method)(np.zeros(6))
