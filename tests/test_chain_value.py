"""A chain is an immutable value: compared, hashed, copied, pickled, printed."""

import copy
import pickle

import numpy as np
import pytest
from hypothesis import given
from numpy.testing import assert_array_equal

import thing_kin as tk
from oracles import translation
from strategies import Case, cases

LIMITS = ("lower", "upper", "velocity_limits", "acceleration_limits")


@pytest.mark.parametrize("attribute", ["name", "n", "names", "frames", "lower", "anything"])
def test_attributes_cannot_be_set(attribute: str):
    with pytest.raises(AttributeError):
        setattr(tk.robots.ur5(), attribute, 1)


@pytest.mark.parametrize("limits", LIMITS)
def test_limits_are_read_only_arrays(limits: str):
    robot = tk.robots.ur5()
    array = getattr(robot, limits)
    assert (array.shape, array.dtype) == ((6,), np.float64)
    with pytest.raises(ValueError, match="read-only"):
        array[0] = 7.0
    array.flags.writeable = True  # who insists writes into a copy
    array[0] = 7.0
    assert getattr(robot, limits)[0] != 7.0


def test_the_list_of_rows_is_read_once():
    rows = [tk.DH(a=1.0, joint="revolute")]
    chain = tk.Chain.from_dh(rows)
    rows.append(tk.DH(a=5.0))
    assert chain == tk.Chain.from_dh(rows[:1])


BASE = {
    "d": 0.1,
    "theta": 0.2,
    "a": 0.3,
    "alpha": 0.4,
    "joint": "revolute",
    "name": "n",
    "frame": "f",
    "lower": -1.0,
    "upper": 1.0,
    "velocity_limit": 2.0,
    "acceleration_limit": 3.0,
}
CHANGES = {
    "d": 0.1 + 1e-15,
    "theta": 0.25,
    "a": -0.3,
    "alpha": 0.0,
    "joint": "prismatic",
    "name": "m",
    "frame": "g",
    "lower": -1.5,
    "upper": 1.5,
    "velocity_limit": np.inf,
    "acceleration_limit": 4.0,
}


@pytest.mark.parametrize("field", CHANGES)
def test_chains_are_equal_only_if_all_is_equal(field: str):
    chain = tk.Chain.from_dh([tk.DH(**BASE)])
    assert chain == tk.Chain.from_dh([tk.DH(**BASE)])
    assert chain != tk.Chain.from_dh([tk.DH(**{**BASE, field: CHANGES[field]})])


def test_other_ways_to_differ():
    arm = tk.Chain.from_dh([tk.DH(**BASE)])
    assert arm != tk.Chain.from_dh([tk.DH(**BASE)], name="another")
    assert arm != arm.with_tool(np.eye(4))
    assert tk.robots.thing() != tk.robots.thing(order="base_first")
    assert arm != "chain"
    assert (arm == None) is False  # noqa: E711


@given(cases())
def test_equal_chains_have_equal_hashes(case: Case):
    again = tk.Chain.from_dh(case.rows)
    assert again == case.chain
    assert hash(again) == hash(case.chain)
    assert {case.chain: 1}[again] == 1


def test_the_robots_have_different_hashes():
    robots = [tk.robots.ur5(), tk.robots.ur10(), tk.robots.thing(), tk.robots.pioneer_lx_ur5()]
    assert len({hash(robot) for robot in robots}) == 4


COPIES = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    **{
        f"pickle {protocol}": lambda chain, p=protocol: pickle.loads(pickle.dumps(chain, p))
        for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1)
    },
}
ROBOTS = {
    "thing": tk.robots.thing(),
    "base first": tk.robots.thing(order="base_first", base_limits=[(-1, 2)] * 3),
    "with a tool": tk.robots.ur5().with_tool(translation(0.1, 0.2, 0.3)),
    "unlimited": tk.Chain.from_dh([tk.DH(theta=0.1), tk.DH(a=0.3, joint="prismatic")]),
    "continuous": tk.Chain.from_dh([tk.DH(a=0.1, joint="continuous"), tk.DH(joint="revolute")]),
}


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=ROBOTS)
@pytest.mark.parametrize("duplicate", COPIES.values(), ids=COPIES)
def test_copies_are_equal_and_compute_the_same(robot: tk.Chain, duplicate):
    twin = duplicate(robot)
    assert twin == robot
    assert hash(twin) == hash(robot)
    for attribute in ("name", "n", "names", "joint_types", "frames", "base_joints"):
        assert getattr(twin, attribute) == getattr(robot, attribute)
    for limits in LIMITS:
        assert_array_equal(getattr(twin, limits), getattr(robot, limits))
    q = np.linspace(-1.0, 1.0, robot.n)
    assert_array_equal(twin.fk_all(q), robot.fk_all(q))


def test_repr_is_short():
    assert repr(tk.robots.thing()) == "Chain('thing', n=9)"


def test_str_is_a_table_of_joints_types_and_limits():
    head, columns, *lines = str(tk.robots.thing()).splitlines()
    assert head == "thing: 9 joints, 12 frames (world ... tool)"
    assert columns.split() == [
        *("joint", "type", "lower", "upper", "velocity", "acceleration", "unit")
    ]
    assert len(lines) == 9
    assert lines[0].split() == ["0", "q0", "revolute", "-6.283", "6.283", "2.094", "5", "rad"]
    assert lines[6].split() == ["6", "x", "prismatic", "-5", "5", "1.1", "2.5", "m"]
    ends = {line.rindex(line.split()[5]) + len(line.split()[5]) for line in lines}
    assert len(ends) == 1  # the velocities stand right-aligned under one another


def test_the_table_of_a_continuous_joint():
    line = str(tk.Chain.from_dh([tk.DH(joint="continuous")])).splitlines()[2]
    assert line.split() == ["0", "q0", "continuous", "-inf", "inf", "inf", "inf", "rad"]


def test_a_long_name_does_not_break_the_table():
    chain = tk.Chain.from_dh([tk.DH(joint="revolute", name="x" * 200)])
    line = str(chain).splitlines()[2]
    assert line.split()[2:] == ["revolute", "-3.142", "3.142", "inf", "inf", "rad"]
