"""Batches in lanes and threads: every level of instructions, every size, every `out`."""

from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from numpy.typing import NDArray

import thing_kin as tk
from oracles import PinocchioChain, assert_close
from strategies import Case, cases

THING = tk.robots.thing()
LEVELS = ("baseline", "avx2", "avx512")
METHODS = ("fk", "fk_quaternion", "jacobian")


def available_levels() -> list[str]:
    """The levels of this processor: any below its best."""
    return list(LEVELS[: LEVELS.index(tk.simd_level()) + 1])


@pytest.fixture
def restored_level() -> Iterator[None]:
    level = tk.simd_level()
    yield
    tk.use_simd_level(level)


@given(cases())
def test_all_levels_agree_with_pinocchio_and_each_other(case: Case) -> None:
    best = tk.simd_level()
    expected = PinocchioChain(case.rows).fk_all(case.q)[-1]
    Q = np.tile(case.q, (3, 1))
    try:
        for level in available_levels():
            tk.use_simd_level(level)
            assert_close(case.chain.fk(case.q), expected, atol=1e-12)
            assert_close(case.chain.fk(Q)[2], expected, atol=1e-12)
            J = case.chain.jacobian(case.q, of=case.frame)
            assert_close(case.chain.jacobian(Q, of=case.frame)[2], J, atol=1e-12)
    finally:
        tk.use_simd_level(best)


@pytest.mark.usefixtures("restored_level")
@pytest.mark.parametrize("frame", ["world_aligned", "body", "world"])
def test_levels_differ_by_rounding_only(frame: str) -> None:
    Q = THING.random(1001, rng=0)
    results = []
    for level in available_levels():
        tk.use_simd_level(level)
        T, J = THING.fk_and_jacobian(Q, frame=frame)
        results.append((T, J, THING.fk_quaternion(Q)))
    for T, J, p in results[1:]:
        for got, expected in zip((T, J, p), results[0], strict=True):
            # Coordinates up to 8 m, a dozen roundings each.
            assert_close(got, expected, atol=3e-14)


def test_an_unknown_or_missing_level_is_refused() -> None:
    with pytest.raises(ValueError, match=r"^level: got 'sse9', expected 'baseline', 'avx2'"):
        tk.use_simd_level("sse9")
    for level in LEVELS[len(available_levels()) :]:
        with pytest.raises(ValueError, match=rf"^level: got '{level}'"):
            tk.use_simd_level(level)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("count", [1, 2, 3, 7, 8, 9, 63, 64, 65, 130])
def test_a_row_does_not_know_how_many_there_are(method: str, count: int) -> None:
    Q = THING.random(130, rng=1)
    function = getattr(THING, method)
    assert_array_equal(function(Q[:count]), function(Q)[:count])
    assert_array_equal(function(Q[130 - count :]), function(Q)[130 - count :])


@pytest.mark.parametrize("method", [*METHODS, "fk_all", "hessian", "manipulability", "task_vector"])
def test_any_number_of_threads_gives_the_same(method: str) -> None:
    Q = THING.random(40_001 if method in METHODS else 3001, rng=2)
    function = getattr(THING, method)
    one = function(Q, threads=1)
    for threads in (2, 3, 7, None):
        assert_array_equal(function(Q, threads=threads), one)


@pytest.mark.parametrize("n", [1, 2, 3, 7, 8, 9, 31, 32])
def test_any_number_of_joints_in_any_order(n: int) -> None:
    rng = np.random.default_rng(n)
    kinds = rng.choice(["revolute", "prismatic"], n)
    rows = [tk.DH(*rng.uniform(-1.5, 1.5, 4), joint=str(kind)) for kind in kinds]
    chain, peer = tk.Chain.from_dh(rows), PinocchioChain(rows)
    Q = rng.uniform(-3.0, 3.0, (5, n))
    T, J = chain.fk_and_jacobian(Q)
    for i, q in enumerate(Q):
        assert_close(T[i], peer.fk_all(q)[-1], atol=1e-12)
        assert_close(J[i], chain.jacobian(q), atol=1e-12)


@given(
    st.sampled_from([0.0, 4e5, 499_999.0, 500_001.0, 1e6, 1e9, 1e15, 1e22, 1e300]),
    st.integers(0, 8),
)
def test_huge_angles_are_reduced_exactly(size: float, row: int) -> None:
    chain = tk.Chain.from_dh([tk.DH(a=1.0, joint="revolute")])
    Q = np.linspace(-3.0, 3.0, 9)[:, None]
    Q[row] = size + 0.5 if size < 1e15 else size
    expected = np.stack([np.cos(Q[:, 0]), np.sin(Q[:, 0])], axis=-1)
    assert_close(chain.fk(Q)[:, :2, 3], expected, atol=4e-16)
    assert_close(chain.fk(Q[row])[:2, 3], expected[row], atol=4e-16)


def test_sine_and_cosine_are_good_to_the_last_place_or_so() -> None:
    """Near every multiple of pi/4 up to some thousand turns, and everywhere between."""
    chain = tk.Chain.from_dh([tk.DH(a=1.0, joint="revolute")])
    multiples = np.arange(-40_000, 40_000) * (np.pi / 4)
    angles = np.concatenate([multiples, np.random.default_rng(0).uniform(-7000, 7000, 80_000)])
    x, y = chain.fk(angles[:, None])[:, :2, 3].T
    for got, expected in ((x, np.cos(angles)), (y, np.sin(angles))):
        error = np.abs(got - expected) / np.spacing(np.abs(expected))
        assert error.max() <= 2.0


def shape_of(method: str, count: int | None) -> tuple[int, ...]:
    one = {"fk": (4, 4), "fk_quaternion": (7,), "jacobian": (6, 9)}[method]
    return one if count is None else (count, *one)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("count", [None, 0, 5])
def test_out_is_filled_and_returned(method: str, count: int | None) -> None:
    Q = THING.random(count, rng=3)
    out = np.full(shape_of(method, count), np.nan)
    function = getattr(THING, method)
    assert function(Q, out=out) is out
    assert_array_equal(out, function(Q))


@pytest.mark.parametrize("count", [None, 5])
def test_out_of_two_results_is_a_pair(count: int | None) -> None:
    Q = THING.random(count, rng=3)
    pair = tuple(np.empty(shape_of(method, count)) for method in ("fk", "jacobian"))
    T, J = THING.fk_and_jacobian(Q, out=pair)
    assert T is pair[0]
    assert J is pair[1]
    assert_close(T, THING.fk(Q), atol=4e-15)
    assert_close(J, THING.jacobian(Q), atol=4e-15)
    for bad in (pair[0], pair[:1], [*pair]):
        with pytest.raises(ValueError, match=r"^out: got .*, expected a tuple of two arrays"):
            THING.fk_and_jacobian(Q, out=bad)


def test_out_of_a_float_result_is_an_array() -> None:
    q = THING.random(rng=4)
    out = np.empty(())
    assert THING.manipulability(q, out=out) is out
    assert out == THING.manipulability(q)


@pytest.mark.parametrize(
    ("out", "got"),
    [
        (np.empty((5, 4, 3)), r"float64 of shape \(5, 4, 3\)"),
        (np.empty((4, 4)), r"float64 of shape \(4, 4\)"),
        (np.empty((5, 4, 4), np.float32), "float32"),
        (np.empty((5, 4, 4), order="F"), "not in C order"),
        (np.empty((5, 4, 8))[:, :, ::2], "not in C order"),
        ([[0.0]], "list"),
    ],
)
def test_an_out_that_does_not_fit_is_refused(out: NDArray[np.float64], got: str) -> None:
    with pytest.raises(ValueError, match=rf"^out: got .*{got}.*, expected .*\(5, 4, 4\)"):
        THING.fk(THING.random(5, rng=0), out=out)


def test_a_read_only_out_is_refused() -> None:
    out = np.empty((4, 4))
    out.flags.writeable = False
    with pytest.raises(ValueError, match=r"^out: got .*read-only"):
        THING.fk(np.zeros(9), out=out)


def test_an_out_that_shares_memory_with_q() -> None:
    memory = np.zeros(16 * 9)
    Q = memory[: 9 * 9].reshape(9, 9)
    Q[...] = THING.random(9, rng=5)
    expected = THING.fk(Q)
    assert_array_equal(THING.fk(Q, out=memory.reshape(9, 4, 4)), expected)


@pytest.mark.parametrize("threads", [0, -1, 1.5, "two", True])
def test_threads_is_a_whole_number_from_one(threads: object) -> None:
    with pytest.raises(ValueError, match=r"^threads: got "):
        THING.fk(np.zeros((2, 9)), threads=threads)  # type: ignore[arg-type]


@pytest.mark.parametrize("method", METHODS)
def test_other_layouts_are_converted(method: str) -> None:
    Q = THING.random(6, rng=6).round(3)
    function = getattr(THING, method)
    expected = function(Q)
    wide = np.zeros((6, 18))
    wide[:, ::2] = Q
    for same in (wide[:, ::2], np.asfortranarray(Q), Q.tolist(), Q.astype(">f8"), Q[::-1][::-1]):
        assert_array_equal(function(same), expected)
    single = Q.astype(np.float32)
    assert_array_equal(function(single), function(single.astype(np.float64)))
