"""Forward kinematics against numpy, Pinocchio and KDL; every form of input."""

import numpy as np
import pytest
from hypothesis import given
from numpy.testing import assert_array_equal

import thing_kin as tk
from oracles import PinocchioChain, assert_close, dh_fk_all
from strategies import Case, cases
from thing_kin.kdl import KdlChain

# Twelve products of matrices with entries up to 40 m, each rounded: below 1e-13 in all.
ATOL = 1e-12

THING = tk.robots.thing()


@given(cases())
def test_all_frames_are_those_of_the_rows_multiplied_in_numpy(case: Case):
    assert_close(case.chain.fk_all(case.q), dh_fk_all(case.rows, case.q), atol=ATOL)


@given(cases())
def test_all_frames_are_those_of_pinocchio(case: Case):
    assert_close(case.chain.fk_all(case.q), PinocchioChain(case.rows).fk_all(case.q), atol=ATOL)


@given(cases())
def test_any_frame_is_that_of_kdl(case: Case):
    name = case.chain.frames[case.frame]
    expected = KdlChain(case.chain).fk(case.q, frame=name)
    assert_close(case.chain.fk(case.q, frame=name), expected, atol=ATOL)


@given(cases())
def test_fk_is_one_of_fk_all(case: Case):
    poses = case.chain.fk_all(case.q)
    assert poses.shape == (len(case.rows) + 1, 4, 4)
    name = case.chain.frames[case.frame]
    assert_close(case.chain.fk(case.q, frame=case.frame), poses[case.frame], atol=ATOL)
    assert_array_equal(case.chain.fk(case.q, frame=name), case.chain.fk(case.q, frame=case.frame))
    assert_close(case.chain.fk(case.q), poses[-1], atol=ATOL)


@given(cases())
def test_poses_are_rigid(case: Case):
    for T in case.chain.fk_all(case.q):
        assert_close(T[:3, :3] @ T[:3, :3].T, np.eye(3), atol=1e-14)
        assert np.linalg.det(T[:3, :3]) > 0.0
        assert_array_equal(T[3], [0.0, 0.0, 0.0, 1.0])


METHODS = [
    "fk",
    "fk_quaternion",
    "fk_all",
    "jacobian",
    "hessian",
    "manipulability",
    "manipulability_gradient",
    "condition_number",
    "condition_number_gradient",
    "dexterity",
    "dexterity_gradient",
    "base_pose",
    "task_vector",
]


@pytest.mark.parametrize("method", METHODS)
def test_a_batch_is_a_loop(method: str):
    function = getattr(THING, method)
    Q = THING.random(19, rng=5)
    singles = np.stack([function(q) for q in Q])
    if method in {"fk", "fk_quaternion", "jacobian"}:  # kernels of their own: equal to rounding
        assert_close(function(Q), singles, atol=4e-15)
    else:
        assert_array_equal(function(Q), singles)


@pytest.mark.parametrize("method", METHODS)
def test_an_empty_batch_gives_an_empty_array(method: str):
    function = getattr(THING, method)
    one = np.shape(function(THING.random(rng=0)))
    assert function(np.empty((0, 9))).shape == (0, *one)


def strided(Q):
    """The same numbers with gaps between them, along both axes."""
    wide = np.full((2 * Q.shape[0], 3 * Q.shape[1]), np.nan)
    wide[::2, ::3] = Q
    return wide[::2, ::3]


FORMS = {
    "Fortran order": np.asfortranarray,
    "strided": strided,
    "reversed": lambda Q: Q[::-1, ::-1].copy()[::-1, ::-1],
    "big endian": lambda Q: Q.astype(">f8"),
    "longdouble": lambda Q: Q.astype(np.longdouble),
    "float32": lambda Q: Q.astype(np.float32),
    "list": lambda Q: Q.tolist(),
    "tuple of rows": tuple,
}


@pytest.mark.parametrize("method", ["fk", "jacobian", "base_pose"])
@pytest.mark.parametrize("form", FORMS)
def test_input_of_any_form_is_read_right(method: str, form: str):
    function = getattr(THING, method)
    Q = THING.random(4, rng=6).astype(np.float32).astype(np.float64)  # exact in float32 too
    given_form = FORMS[form](Q)
    assert_array_equal(function(given_form), function(Q))
    assert_array_equal(function(given_form[1]), function(Q[1]))


@pytest.mark.parametrize("dtype", [np.int8, np.int64, np.uint16])
def test_integers_are_numbers(dtype: type):
    q = np.arange(9, dtype=dtype)
    assert_array_equal(THING.fk(q), THING.fk(q.astype(float)))


def test_unaligned_input_is_read_right():
    q = THING.random(rng=8)
    unaligned = np.frombuffer(b"\0" + q.tobytes(), dtype=np.uint8)[1:].view(np.float64)
    assert not unaligned.flags.aligned
    assert_array_equal(THING.fk(unaligned), THING.fk(q))


def test_the_argument_is_not_changed_and_the_result_is_new():
    q = THING.random(rng=9)
    q.flags.writeable = False
    first, second = THING.fk(q), THING.fk(q)
    first[:] = 0.0
    assert_array_equal(THING.fk(q), second)
