"""Batches in lanes and threads: every level of instructions, every size, every `out`."""

import math
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


@pytest.mark.usefixtures("restored_level")
@pytest.mark.parametrize("level", available_levels())
@pytest.mark.parametrize("frame", ["world_aligned", "body", "world"])
def test_jacobians_are_those_of_single_postures_in_every_frame(frame: str, level: str) -> None:
    tk.use_simd_level(level)
    Q = THING.random(11, rng=8)
    for of, point in (("tool", None), ("wrist_1", None), ("wrist_1", [0.3, -0.2, 0.1])):
        singles = np.stack([THING.jacobian(q, frame, of, point) for q in Q])
        assert_close(THING.jacobian(Q, frame, of, point), singles, atol=3e-14)
        if point is None:
            T, J = THING.fk_and_jacobian(Q, frame, of)
            assert_close(T, THING.fk(Q, of), atol=3e-14)
            assert_close(J, singles, atol=3e-14)


HALF_TURNS = [
    np.array(axis) / np.linalg.norm(axis)
    for axis in (
        *((1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 1, -2), (0, -2, 1), (1, -1, 0), (-1, 1, 0)),
        *((0.5, -1, 0.2), (-0.2, 0.1, 0.7), (0.3, 0.3, -0.4), (1, 2, 3), (0.1, -0.9, -0.2)),
        *((1e-16, -1, 0.3), (-1e-16, 1, 0), (-1e-16, 1e-16, 1), (1e-16, -1e-16, 1)),
    )
]


@pytest.mark.usefixtures("restored_level")
@pytest.mark.parametrize("level", available_levels())
@pytest.mark.parametrize("axis", HALF_TURNS, ids=str)
def test_quaternions_of_half_turns(axis: NDArray[np.float64], level: str) -> None:
    """w = 0 exactly, and the first of x, y, z that is more than rounding is positive."""
    tk.use_simd_level(level)
    tool = np.eye(4)
    tool[:3, :3] = tk.lie.so3_exp(np.pi * axis)
    arm = tk.Chain.from_dh([tk.DH(joint="revolute")]).with_tool(tool)
    Q = np.array([0.0, 1e-9, -1e-9, 0.3, -0.3, 0.0, 2.0, -2.0, 0.0])[:, None]
    first = axis[np.abs(axis) > 1e-15][0]
    for rows in (Q, Q[:1]):
        quaternions = arm.fk_quaternion(rows)[:, 3:]
        for quaternion in quaternions[rows[:, 0] == 0.0]:
            assert quaternion[0] == 0.0
            assert_close(quaternion[1:], np.sign(first) * axis, atol=4e-16)
        expected = tk.lie.quaternion_from_rotation(arm.fk(rows)[:, :3, :3])
        assert_close(quaternions, expected, atol=4e-16)


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
    st.sampled_from([1.0, -1.0]),
    st.integers(0, 8),
)
def test_huge_angles_are_reduced_exactly(size: float, sign: float, row: int) -> None:
    chain = tk.Chain.from_dh([tk.DH(a=1.0, joint="revolute")])
    Q = np.linspace(-3.0, 3.0, 9)[:, None]
    Q[row] = sign * (size + 0.5 if size < 1e15 else size)
    expected = np.stack([np.cos(Q[:, 0]), np.sin(Q[:, 0])], axis=-1)
    assert_close(chain.fk(Q)[:, :2, 3], expected, atol=4e-16)
    assert_close(chain.fk(Q[row])[:2, 3], expected[row], atol=4e-16)


@pytest.mark.usefixtures("restored_level")
@pytest.mark.parametrize("level", available_levels())
@pytest.mark.parametrize("size", [1e6, -1e9, 1e15, -1e300])
def test_a_row_with_a_huge_angle_leaves_the_others_alone(level: str, size: float) -> None:
    """Where one angle is huge, its neighbors go another way than usual: to the same bits."""
    tk.use_simd_level(level)
    small = np.arctan2(np.sin(size), np.cos(size))
    Q = THING.random(150, rng=7)
    functions = [getattr(THING, method) for method in METHODS]
    functions += [lambda Q, i=i: THING.fk_and_jacobian(Q)[i] for i in range(2)]
    for function in functions:
        usual = function(Q)
        for row in (0, 5, 63, 64, 130, 149):  # of whole lanes, of the rest; of every stretch
            for joint in (0, 5, 8):  # the first and the last of the arm, the base's turn
                unusual = Q.copy()
                unusual[row, joint] = size
                result = function(unusual)
                assert_array_equal(np.delete(result, row, 0), np.delete(usual, row, 0))
                assert_array_equal(result[row], function(unusual[row : row + 1])[0])
                unusual[row, joint] = small
                assert_close(result[row], function(unusual)[row], atol=3e-14)


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


def views(count: int | None, *places: int) -> tuple[NDArray[np.float64], ...]:
    """T and J in one piece of memory, from the given places on."""
    memory = np.zeros(1000)
    shapes = [shape_of(method, count) for method in ("fk", "jacobian")]
    return tuple(
        memory[at : at + math.prod(shape)].reshape(shape)
        for at, shape in zip(places, shapes, strict=True)
    )


@pytest.mark.parametrize("count", [None, 1, 5])
def test_two_outs_that_share_memory_are_refused(count: int | None) -> None:
    Q = THING.random(count, rng=3)
    T_size, J_size = 16 * (count or 1), 54 * (count or 1)
    for places in ((0, T_size), (J_size, 0)):  # side by side
        T, J = THING.fk_and_jacobian(Q, out=views(count, *places))
        assert_array_equal(T, THING.fk_and_jacobian(Q)[0])
        assert_array_equal(J, THING.fk_and_jacobian(Q)[1])
    for places in ((0, 0), (0, T_size - 1), (J_size - 1, 0), (1, 0)):
        pair = views(count, *places)
        with pytest.raises(ValueError, match=r"^out: got two arrays that share memory, expected"):
            THING.fk_and_jacobian(Q, out=pair)
        assert not pair[0].any()
        assert not pair[1].any()


def test_no_rows_share_no_memory() -> None:
    memory = np.zeros(1)[:0]
    pair = (memory.reshape(0, 4, 4), memory.reshape(0, 6, 9))
    assert THING.fk_and_jacobian(np.empty((0, 9)), out=pair)[1] is pair[1]


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
