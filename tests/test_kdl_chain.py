"""The KDL back end: it follows thing_kin's conventions and input rules.

Agreement on random chains is in test_posture.py and test_jacobian.py.
"""

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import thing_kin as tk
from oracles import assert_close, translation
from thing_kin.kdl import KdlChain

ROBOTS = [
    tk.robots.thing(),
    tk.robots.thing(order="base_first"),
    tk.robots.pioneer_lx_ur5(),
    tk.robots.ur10().with_tool(translation(0.1, 0.2, 0.3)),
]


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda r: f"{r.name} {r.names[0]}")
def test_it_agrees_on_the_robots_in_their_own_order_of_joints(robot: tk.Chain):
    kdl = KdlChain(robot)
    Q = robot.random(20, rng=1)
    assert_close(kdl.jacobian(Q), robot.jacobian(Q), atol=1e-13)
    for i, name in enumerate(robot.frames):
        assert_close(kdl.fk(Q, frame=name), robot.fk_all(Q)[:, i], atol=1e-13)


def test_the_default_frame_is_the_tool():
    robot = tk.robots.thing()
    q = robot.random(rng=2)
    assert_array_equal(KdlChain(robot).fk(q), KdlChain(robot).fk(q, frame="tool"))


def test_a_batch_is_a_loop():
    robot = tk.robots.thing()
    kdl = KdlChain(robot)
    Q = robot.random(5, rng=3)
    assert_array_equal(kdl.fk(Q), np.stack([kdl.fk(q) for q in Q]))
    assert_array_equal(kdl.jacobian(Q), np.stack([kdl.jacobian(q) for q in Q]))
    assert kdl.fk(Q[:0]).shape == (0, 4, 4)
    assert kdl.jacobian(Q[:0]).shape == (0, 6, 9)


def test_what_is_wrong_is_said():
    kdl = KdlChain(tk.robots.ur5())
    with pytest.raises(ValueError, match=r"^q: got shape \(5,\), expected \(6,\) or \(N, 6\)"):
        kdl.fk(np.zeros(5))
    with pytest.raises(ValueError, match=r"^q: got nan at flat index 0, expected finite"):
        kdl.jacobian(np.full(6, np.nan))
    with pytest.raises(ValueError, match=r"^frame: got 'elbow', expected one of 'world', "):
        kdl.fk(np.zeros(6), frame="elbow")


def test_it_outlives_the_chain_it_was_made_of():
    robot = tk.robots.ur5().with_tool(translation(0.1, 0.0, 0.0))
    expected = robot.fk(np.ones(6))
    kdl = KdlChain(robot)
    del robot
    assert_close(kdl.fk(np.ones(6)), expected, atol=1e-14)
