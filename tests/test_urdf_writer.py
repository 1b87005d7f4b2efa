"""URDF out, and in again: the same kinematics, names and limits."""

import re

import numpy as np
import pytest
from hypothesis import given
from numpy.testing import assert_array_equal

import thing_kin as tk
from oracles import assert_close
from strategies import Case, cases, poses
from urdf_trees import TREE, random_tree

PI = np.pi
read = tk.Chain.from_urdf


def assert_same_kinematics(chain: tk.Chain, again: tk.Chain, atol: float) -> None:
    """q of `again` is in the order of the joints from the root."""
    place = [chain.names.index(name) for name in again.names]
    Q = np.random.default_rng(0).uniform(-3.0, 3.0, size=(5, chain.n))
    for frame in chain.frames:
        assert_close(again.fk(Q[:, place], frame), chain.fk(Q, frame), atol)
    assert_close(again.jacobian(Q[:, place]), chain.jacobian(Q)[:, :, place], atol)
    for limits in ("lower", "upper", "velocity_limits"):
        assert_array_equal(getattr(again, limits), getattr(chain, limits)[place])


@given(cases())
def test_a_chain_of_rows_comes_back(case: Case) -> None:
    """Rounding of at most 24 products of entries up to 12 m."""
    again = read(case.chain.to_urdf())
    assert_same_kinematics(case.chain, again, atol=5e-14)
    assert again.names == case.chain.names
    unlimited = np.isinf(case.chain.lower) & np.isinf(case.chain.upper)
    for before, after, free in zip(
        case.chain.joint_types, again.joint_types, unlimited, strict=True
    ):
        assert after == ("continuous" if before == "revolute" and free else before)


@given(case=cases(max_rows=3), tool=poses())
def test_turned_frames_come_back(case: Case, tool: np.ndarray) -> None:
    """Any rotation, those where roll and yaw are one among them."""
    chain = case.chain.with_tool(tool)
    assert_same_kinematics(chain, read(chain.to_urdf()), atol=1e-14)


@pytest.mark.parametrize("pitch", [PI / 2, -PI / 2, PI / 2 - 1e-9, PI / 2 - 1e-15, -1.5])
def test_the_poles_of_roll_pitch_and_yaw(pitch: float) -> None:
    arm = tk.robots.ur5()
    for roll, yaw in ((0.0, 0.3), (1.0, 0.0), (-2.0, 3.0)):
        chain = arm.with_tool(tk.transform(xyz=(0, 0, 0), rpy=(roll, pitch, yaw)))
        assert_same_kinematics(chain, read(chain.to_urdf()), atol=3e-15)
    at_pole = arm.with_tool(tk.transform(xyz=(0, 0, 0), rpy=(1.0, PI / 2, 0.0))).to_urdf()
    assert re.findall(r'rpy="(\S+) ', at_pole)[-1] == "0"


@pytest.mark.parametrize("seed", range(50))
def test_a_urdf_comes_back_with_the_same_frames(seed: int) -> None:
    """Once written nothing changes any more but the last digits, and only once."""
    rng = np.random.default_rng(seed)
    robot, base, tip = random_tree(rng)
    chain = read(robot.text(), base, tip)
    again = read(chain.to_urdf())
    assert_same_kinematics(chain, again, atol=2e-14)
    third = read(again.to_urdf())
    assert third.frames == again.frames
    assert third.joint_types == again.joint_types == chain.joint_types
    assert_same_kinematics(again, third, atol=2e-14)


def test_a_urdf_needs_no_further_links_if_its_chain_runs_downwards() -> None:
    chain = read(TREE.text(), tip="hand")
    assert read(chain.to_urdf()).frames == chain.frames
    assert read(chain.to_urdf("other")).name == "other"


@pytest.mark.parametrize("robot", [tk.robots.thing(), tk.robots.ur10(), tk.robots.pioneer_lx_ur5()])
def test_the_robots_come_back(robot: tk.Chain) -> None:
    again = read(robot.to_urdf())
    assert_same_kinematics(robot, again, atol=3e-15)
    assert again.base_joints is None
    assert_array_equal(again.acceleration_limits, np.full(robot.n, np.inf))


def test_names_that_are_taken_already() -> None:
    rows = [
        tk.DH(a=1.0, joint="revolute", frame="x", name="x_fixed"),
        tk.DH(a=1.0, frame="x_joint"),
        tk.DH(frame="x_joint2"),
    ]
    chain = tk.Chain.from_dh(rows)
    again = read(chain.to_urdf())
    assert again.frames == ("world", "x_joint3", "x", "x_joint", "x_joint2")
    assert again.names == ("x_fixed",)


UNLIMITED = {
    "revolute": ("continuous", -np.inf, np.inf),
    "continuous": ("continuous", -np.inf, np.inf),
    "prismatic": ("prismatic", -np.inf, np.inf),
}


@pytest.mark.parametrize("joint", UNLIMITED)
def test_infinite_limits(joint: str) -> None:
    limits = {} if joint == "continuous" else {"lower": -np.inf, "upper": np.inf}
    again = read(tk.Chain.from_dh([tk.DH(joint=joint, **limits)]).to_urdf())
    assert (again.joint_types[0], again.lower[0], again.upper[0]) == UNLIMITED[joint]
    assert again.velocity_limits[0] == np.inf


def test_one_infinite_limit_keeps_the_type() -> None:
    chain = tk.Chain.from_dh([tk.DH(joint="revolute", lower=-1.0, upper=np.inf)])
    again = read(chain.to_urdf())
    assert (again.joint_types[0], again.lower[0], again.upper[0]) == ("revolute", -1.0, np.inf)


@pytest.mark.parametrize("name", ["\0", "a\x01b", "\x1f", "\ufffe", "x\uffff"])
def test_names_that_xml_cannot_hold(name: str) -> None:
    chain = tk.Chain.from_dh([tk.DH(joint="revolute", name=name)])
    with pytest.raises(ValueError, match=r"^chain: got a name with characters that XML has not"):
        chain.to_urdf()
    with pytest.raises(ValueError, match="characters that XML has not"):
        tk.robots.ur5().to_urdf(name)
