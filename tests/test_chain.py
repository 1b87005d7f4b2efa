"""What a chain says of itself, chains made from chains, and random configurations."""

import numpy as np
import pytest
from hypothesis import given
from numpy.testing import assert_array_equal

import thing_kin as tk
from oracles import assert_close, translation
from strategies import Case, cases, seeds

ROWS = [
    tk.DH(d=0.3),
    tk.DH(a=1.0, joint="revolute", lower=-1.0, upper=2.0, velocity_limit=3.0),
    tk.DH(alpha=0.5, joint="prismatic", lower=0.0, upper=0.5, acceleration_limit=4.0),
    tk.DH(a=0.2),
]


def test_names_types_and_frames_are_numbered_along_the_chain():
    chain = tk.Chain.from_dh(ROWS)
    assert chain.name == "chain"
    assert chain.n == 2
    assert chain.names == ("q0", "q1")
    assert chain.joint_types == ("revolute", "prismatic")
    assert chain.frames == ("world", "frame1", "frame2", "frame3", "tool")
    assert chain.base_joints is None


def test_given_names_are_kept_and_the_others_numbered():
    rows = [
        tk.DH(joint="revolute", name="waist", frame="trunk"),
        tk.DH(joint="revolute"),
        tk.DH(joint="revolute", name="wrist", frame="hand"),
    ]
    chain = tk.Chain.from_dh(rows, name="torso")
    assert chain.name == "torso"
    assert chain.names == ("waist", "q1", "wrist")
    assert chain.frames == ("world", "trunk", "frame2", "hand")


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ([], r"^rows: got no row"),
        ([tk.DH()], r"^rows: got 0 joints, expected 1 to 32"),
        ([tk.DH(joint="revolute")] * 33, r"^rows: got 33 joints, expected 1 to 32"),
        ([tk.DH(joint="revolute", name="a")] * 2, r"^joint names: got 'a' twice"),
        ([tk.DH(joint="revolute", frame="f")] * 2, r"^frame names: got 'f' twice"),
        ([tk.DH(joint="revolute", frame="world")], r"^frame names: got 'world' twice"),
    ],
)
def test_rows_that_make_no_chain(rows: list[tk.DH], message: str):
    with pytest.raises(ValueError, match=message):
        tk.Chain.from_dh(rows)


def test_limits_stand_in_the_order_of_q():
    chain = tk.Chain.from_dh(ROWS)
    assert_array_equal(chain.lower, [-1.0, 0.0])
    assert_array_equal(chain.upper, [2.0, 0.5])
    assert_array_equal(chain.velocity_limits, [3.0, np.inf])
    assert_array_equal(chain.acceleration_limits, [np.inf, 4.0])


@pytest.mark.parametrize("order", ["arm_first", "base_first"])
@pytest.mark.parametrize("which", ["lower", "upper", "velocity_limits", "acceleration_limits"])
def test_with_limits_replaces_one_and_leaves_the_rest(order: str, which: str):
    robot = tk.robots.thing(order=order)
    new = getattr(robot, which) + 0.01 * np.arange(9)
    changed = robot.with_limits(**{which: new})
    for limits in ("lower", "upper", "velocity_limits", "acceleration_limits"):
        source = new if limits == which else getattr(robot, limits)
        assert_array_equal(getattr(changed, limits), source)
    q = robot.random(rng=0)
    assert_array_equal(changed.fk_all(q), robot.fk_all(q))
    assert (changed.names, changed.base_joints) == (robot.names, robot.base_joints)
    assert robot.with_limits() == robot


def test_a_tool_is_a_further_frame():
    arm, tool = tk.robots.ur5(), translation(0.0, 0.1, 0.2)
    q = arm.random(rng=1)
    renamed = arm.with_tool(tool)
    assert renamed.frames == (*arm.frames[:-1], "flange", "tool")
    named = arm.with_tool(tool, frame="gripper").with_tool(tool, frame="finger")
    assert named.frames == (*arm.frames, "gripper", "finger")
    assert_close(named.fk(q), arm.fk(q) @ tool @ tool, atol=1e-15)
    assert_array_equal(named.fk(q, "tool"), arm.fk(q))
    assert_array_equal(renamed.fk(q, "flange"), arm.fk(q))
    assert arm.frames[-1] == "tool"
    assert arm.with_tool(tool).n == 6


@given(case=cases(), seed=seeds)
def test_random_is_numpy_s_uniform(case: Case, seed: int):
    chain = case.chain
    slides = np.array([joint == "prismatic" for joint in chain.joint_types])
    chain = chain.with_limits(
        lower=np.where(slides, -0.5, chain.lower), upper=np.where(slides, 0.25, chain.upper)
    )
    bounds = np.clip(chain.lower, -np.pi, None), np.clip(chain.upper, None, np.pi)
    one = np.random.default_rng(seed).uniform(*bounds, (chain.n,))
    many = np.random.default_rng(seed).uniform(*bounds, (4, chain.n))
    assert_array_equal(chain.random(rng=seed), one)
    assert_array_equal(chain.random(4, rng=seed), many)


def test_random_takes_a_generator_and_moves_it_on():
    robot, rng = tk.robots.thing(), np.random.default_rng(7)
    first, second = robot.random(rng=rng), robot.random(rng=rng)
    assert_array_equal(np.stack([first, second]), robot.random(2, rng=7))
    assert robot.random(0, rng=7).shape == (0, 9)
    assert robot.random(1, rng=7).shape == (1, 9)


def test_a_joint_without_limits_is_drawn_in_a_turn_and_a_slide_needs_limits():
    expected = np.random.default_rng(3).uniform(-np.pi, np.pi, (5, 1))
    for row in (
        tk.DH(joint="revolute", lower=-np.inf, upper=np.inf),
        tk.DH(joint="continuous"),
    ):
        assert_array_equal(tk.Chain.from_dh([row]).random(5, rng=3), expected)
    with pytest.raises(ValueError, match=r"^q0: got a joint without limits"):
        tk.Chain.from_dh([tk.DH(joint="prismatic")]).random(rng=3)


@pytest.mark.parametrize(("lower", "upper"), [(-np.inf, 1.0), (1.0, np.inf)])
def test_random_keeps_a_limit_on_one_side(lower: float, upper: float):
    chain = tk.Chain.from_dh([tk.DH(joint="revolute", lower=lower, upper=upper)])
    Q = chain.random(100, rng=1)
    assert np.all((chain.lower <= Q) & (upper >= Q))
