"""Chain.difference against exact rational arithmetic with sixty digits of pi."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

import thing_kin as tk
from strategies import Case, cases

PI = Fraction(3141592653589793238462643383279502884197169399375105820974944, 10**60)
FREE = tk.Chain.from_dh([tk.DH(a=1.0, joint="continuous")])
MIXED = tk.Chain.from_dh(
    [tk.DH(a=1.0, joint=joint) for joint in ("continuous", "revolute", "prismatic", "continuous")]
)
angles = st.floats(-1e5, 1e5) | st.integers(-5000, 5000).map(lambda half_turns: half_turns * np.pi)


def exact(q_from: float, q_to: float) -> Fraction:
    """In [-pi, pi), pi the true one."""
    difference = Fraction(q_to) - Fraction(q_from)
    return difference - 2 * PI * ((difference + PI) // (2 * PI))


@given(angles, angles)
@example(0.0, np.pi)
@example(0.0, -np.pi)
@example(np.pi, -np.pi)
@example(0.0, np.nextafter(np.pi, 4.0))
@example(-2000 * np.pi, 2000 * np.pi)
@example(1e-17, 2000 * np.pi)
def test_it_is_exact_to_rounding(q_from: float, q_to: float) -> None:
    """Sine, cosine and arc tangent each round: 3 in 2^-52 of pi at most; modulo a turn."""
    (got,) = FREE.difference([q_from], [q_to])
    assert -np.pi <= got < np.pi
    error = abs(Fraction(got) - exact(q_from, q_to))
    assert min(error, 2 * PI - error) <= 3 * np.pi * 2**-52


@given(st.integers(-1000, 1000), st.floats(-3.0, 3.0))
def test_whole_turns_do_not_count(turns: int, angle: float) -> None:
    """What remains is the rounding of q itself, 2^-53 of its 6000 rad."""
    (got,) = FREE.difference([0.5], [0.5 + angle + turns * 2 * np.pi])
    assert abs(got - angle) <= 7000 * 2**-52


@pytest.mark.parametrize("size", [1e8, 1e16, 1e40])
def test_angles_beyond_all_reason_stay_in_range(size: float) -> None:
    (got,) = FREE.difference([-size], [size / 3])
    assert -np.pi <= got < np.pi


@given(cases())
def test_other_joints_have_the_plain_difference(case: Case) -> None:
    target = case.q[::-1] + 4.0
    got = case.chain.difference(case.q, target)
    for joint, difference, plain in zip(case.chain.joint_types, got, target - case.q, strict=True):
        if joint != "continuous":
            assert difference == plain
        assert abs(np.sin(difference) - np.sin(plain)) < 1e-14


def test_small_differences_are_the_plain_ones() -> None:
    rng = np.random.default_rng(1)
    Q, dQ = rng.uniform(-2, 2, (100, 4)), rng.uniform(-1e-9, 1e-9, (100, 4))
    np.testing.assert_allclose(MIXED.difference(Q, Q + dQ), (Q + dQ) - Q, rtol=0, atol=1e-24)
    assert_array_equal(MIXED.difference(Q, Q), np.zeros_like(Q))


def test_it_leads_there() -> None:
    rng = np.random.default_rng(2)
    A, B = rng.uniform(-20, 20, (2, 50, 4))
    reached = A + MIXED.difference(A, B)
    np.testing.assert_allclose(MIXED.fk(reached), MIXED.fk(B), atol=1e-13)


def test_batches_are_loops_and_one_goes_with_many() -> None:
    rng = np.random.default_rng(3)
    A, B = rng.uniform(-20, 20, (2, 7, 4))
    expected = np.stack([MIXED.difference(a, b) for a, b in zip(A, B, strict=True)])
    assert_array_equal(MIXED.difference(A, B), expected)
    assert_array_equal(MIXED.difference(A[0], B)[3], MIXED.difference(A[0], B[3]))
    assert_array_equal(MIXED.difference(A, B[0])[3], MIXED.difference(A[3], B[0]))
    assert MIXED.difference(A[:0], B[0]).shape == (0, 4)
    assert MIXED.difference(q_from=A[0], q_to=B[0]).shape == (4,)


def test_what_does_not_fit() -> None:
    with pytest.raises(ValueError, match=r"^q_to: got 3 configurations, expected as many as q_fr"):
        MIXED.difference(np.zeros((2, 4)), np.zeros((3, 4)))
    with pytest.raises(ValueError, match=r"^q_from: got shape \(3,\), expected \(4,\) or \(N, 4\)"):
        MIXED.difference(np.zeros(3), np.zeros(4))
    with pytest.raises(ValueError, match=r"^q_to: got 1e\+60, expected numbers up to 1e\+50"):
        MIXED.difference(np.zeros(4), np.full(4, 1e60))
