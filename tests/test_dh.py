"""Denavit-Hartenberg rows, [M17] (3.7): what they mean and what they default to."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

import thing_kin as tk
from oracles import assert_close, dh_matrix
from strategies import dh_rows

JOINT = tk.DH(joint="prismatic")  # at q = 0 a row that changes nothing


def pose_of(row: tk.DH):
    """The row's transform: a chain needs a joint, so one that stays at zero stands before it."""
    return tk.Chain.from_dh([JOINT, row]).fk([0.0])


@given(dh_rows(st.just("fixed")))
def test_a_row_is_its_four_factors(row: tk.DH):
    assert_close(pose_of(row), dh_matrix(row.d, row.theta, row.a, row.alpha), atol=1e-15)


@given(dh_rows(st.sampled_from(("revolute", "continuous", "prismatic"))), st.floats(-3.0, 3.0))
def test_the_joint_variable_adds_to_theta_or_d(row: tk.DH, q: float):
    turns = row.joint != "prismatic"
    expected = dh_matrix(row.d + (not turns) * q, row.theta + turns * q, row.a, row.alpha)
    assert_close(tk.Chain.from_dh([row]).fk([q]), expected, atol=4e-15)


QUARTERS = [k * np.pi / 2 for k in range(-4, 5)]


@pytest.mark.parametrize("theta", QUARTERS)
@pytest.mark.parametrize("alpha", QUARTERS)
def test_right_angles_are_exact(theta: float, alpha: float):
    T = pose_of(tk.DH(theta=theta, alpha=alpha, d=2.0, a=3.0))
    assert_array_equal(T, np.rint(T))
    assert_close(T, dh_matrix(2.0, theta, 3.0, alpha), atol=1e-14)


@pytest.mark.parametrize("error", [1e-14, 1e-12, -1e-9])
def test_what_is_only_nearly_a_right_angle_is_not_rounded_to_one(error: float):
    T = pose_of(tk.DH(theta=np.pi / 2 + error))
    assert_close(T[0, 0], np.cos(np.pi / 2 + error), atol=1e-30)
    assert pose_of(tk.DH(alpha=1e-300))[2, 1] == 1e-300


def test_a_row_of_nothing_is_the_identity():
    assert_array_equal(pose_of(tk.DH()), np.eye(4))
    row = tk.DH()
    assert (row.d, row.theta, row.a, row.alpha) == (0.0, 0.0, 0.0, 0.0)
    assert (row.joint, row.name, row.frame) == ("fixed", "", "")


def test_positional_arguments_are_d_theta_a_alpha_joint():
    row = tk.DH(1.0, 2.0, 3.0, 4.0, "revolute")
    assert (row.d, row.theta, row.a, row.alpha, row.joint) == (1.0, 2.0, 3.0, 4.0, "revolute")


def test_default_limits():
    revolute, prismatic = tk.DH(joint="revolute"), tk.DH(joint="prismatic")
    assert (revolute.lower, revolute.upper) == (-np.pi, np.pi)
    assert (prismatic.lower, prismatic.upper) == (-np.inf, np.inf)
    continuous = tk.DH(joint="continuous")
    assert (continuous.lower, continuous.upper) == (-np.inf, np.inf)
    for row in (revolute, prismatic, continuous):
        assert (row.velocity_limit, row.acceleration_limit) == (np.inf, np.inf)


def test_given_limits_and_names_are_kept():
    row = tk.DH(
        joint="revolute",
        name="elbow",
        frame="forearm",
        lower=-1.0,
        upper=2.0,
        velocity_limit=3.0,
        acceleration_limit=4.0,
    )
    assert (row.name, row.frame) == ("elbow", "forearm")
    assert (row.lower, row.upper) == (-1.0, 2.0)
    assert (row.velocity_limit, row.acceleration_limit) == (3.0, 4.0)


def test_one_given_limit_leaves_the_other_at_its_default():
    assert tk.DH(joint="revolute", upper=1.0).lower == -np.pi
    assert tk.DH(joint="prismatic", lower=0.0).upper == np.inf


def test_a_continuous_joint_has_no_position_limits():
    row = tk.DH(joint="continuous", lower=-np.inf, upper=np.inf, velocity_limit=2.0)
    assert row.velocity_limit == 2.0
    for limit in ("lower", "upper"):
        with pytest.raises(
            ValueError, match=rf"^{limit}: got 1, expected no limit \(inf\) for a con"
        ):
            tk.DH(joint="continuous", **{limit: 1.0})
    chain = tk.Chain.from_dh([tk.DH(joint="continuous")])
    with pytest.raises(ValueError, match=r"^lower: got -1, expected no limit"):
        chain.with_limits(lower=[-1.0])
    assert chain.with_limits(velocity_limits=[2.0]).velocity_limits[0] == 2.0


def test_none_and_fixed_are_the_same_constant_row():
    assert tk.DH(joint=None).joint == tk.DH(joint="fixed").joint == "fixed"
    with pytest.raises(ValueError, match=r"^joint: got a fixed row with a joint's name or limits"):
        tk.DH(name="q0")
    with pytest.raises(ValueError, match=r"^joint: got 'ball', expected 'revolute'"):
        tk.DH(joint="ball")


@pytest.mark.parametrize("attribute", ["d", "theta", "a", "alpha", "joint", "name", "lower"])
def test_a_row_cannot_be_changed(attribute: str):
    with pytest.raises(AttributeError):
        setattr(tk.DH(joint="revolute"), attribute, 1.0)


def test_repr_is_the_call_that_makes_it():
    row = tk.DH(d=0.1, theta=0.2, a=-0.3, alpha=0.4, joint="revolute")
    assert repr(row) == "DH(d=0.1, theta=0.2, a=-0.3, alpha=0.4, joint='revolute')"
    assert repr(eval(repr(row), {"DH": tk.DH})) == repr(row)
