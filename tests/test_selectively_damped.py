"""Selectively damped least squares against a plain reading of Buss & Kim (2005), [M17] (4.11)."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

import thing_kin as tk
from inverse_oracles import selectively_damped

FILTER = tk.SingularValueFilter(0.01, 10.0)

sizes = st.integers(1, 9)
seeds = st.integers(0, 2**32 - 1)
scales = st.sampled_from([1e-6, 1e-2, 1.0, 1e3])
gammas = st.sampled_from([1e-3, 0.5, np.pi / 4, 20.0])


def problem(m: int, n: int, seed: int, scale: float) -> tuple[NDArray, NDArray]:
    rng = np.random.default_rng(seed)
    # Columns of different size, so that singular values are spread and simple.
    return rng.normal(size=(m, n)) * 10.0 ** rng.uniform(-3, 1, n), scale * rng.normal(size=m)


def default_blocks(m: int) -> list[int]:
    return [3, 3] if m == 6 else [m]


@given(sizes, sizes, seeds, scales, gammas, st.sampled_from([None, FILTER]))
def test_it_is_the_algorithm(m, n, seed, scale, gamma_max, singular_value_filter) -> None:
    J, e = problem(m, n, seed, scale)
    step = tk.selectively_damped_step(J, e, gamma_max, singular_value_filter=singular_value_filter)
    reference = selectively_damped(J, e, gamma_max, default_blocks(m), singular_value_filter)
    # Singular vectors of close singular values are known to eps over their distance.
    np.testing.assert_allclose(step, reference, atol=1e-9 * gamma_max)


@given(st.lists(st.integers(1, 4), min_size=1, max_size=4), seeds, scales)
def test_blocks_of_any_size(blocks: list[int], seed: int, scale: float) -> None:
    J, e = problem(sum(blocks), 7, seed, scale)
    step = tk.selectively_damped_step(J, e, 0.5, blocks=blocks)
    np.testing.assert_allclose(step, selectively_damped(J, e, 0.5, blocks), atol=1e-9)


def test_blocks_matter_and_six_rows_are_a_pose() -> None:
    J, e = problem(6, 9, 0, 1.0)
    whole = tk.selectively_damped_step(J, e, blocks=[6])
    pose = tk.selectively_damped_step(J, e, blocks=[3, 3])
    assert np.abs(whole - pose).max() > 1e-3
    np.testing.assert_array_equal(tk.selectively_damped_step(J, e), pose)
    # The default bound is pi/4.
    np.testing.assert_array_equal(tk.selectively_damped_step(J, e, np.pi / 4), pose)


@given(sizes, sizes, seeds, st.sampled_from([1.0, 1e6, 1e150]), gammas)
def test_no_joint_moves_further_than_the_bound(m, n, seed, scale, gamma_max) -> None:
    J, e = problem(m, n, seed, scale)
    J[-1] = J[0]  # of lower rank, too
    step = tk.selectively_damped_step(J, e, gamma_max)
    assert np.abs(step).max() <= gamma_max * (1 + 1e-15)


@given(sizes, sizes, seeds)
def test_small_errors_are_not_damped(m: int, n: int, seed: int) -> None:
    J, e = problem(m, n, seed, 1e-12)
    exact = np.linalg.pinv(J) @ e
    np.testing.assert_allclose(
        tk.selectively_damped_step(J, e), exact, atol=1e-10 * np.linalg.norm(exact)
    )


def test_each_direction_is_clamped_by_itself() -> None:
    """By hand: u = v = unit vectors, N = 1, rho = sigma, M = 1, so that gamma_i = gamma_max."""
    J = np.diag([2.0, 1.0, 1e-9])
    step = tk.selectively_damped_step(J, [0.4, 0.1, 0.1], gamma_max=0.5)
    np.testing.assert_allclose(step, [0.2, 0.1, 0.5], rtol=1e-14)
    # sigma = (2, 1), v = (1, +-1)/sqrt 2, rho = sqrt(5/2) (1, 1): M = sqrt(5)/2 and sqrt(5).
    J = np.array([[2.0, 2.0], [1.0, -1.0]]) / np.sqrt(2)
    first = tk.selectively_damped_step(J, [100.0, 0.0], gamma_max=0.5)
    second = tk.selectively_damped_step(J, [0.0, 100.0], gamma_max=0.5)
    np.testing.assert_allclose(first, np.array([1.0, 1.0]) / np.sqrt(5), rtol=1e-13)
    np.testing.assert_allclose(second, np.array([0.5, -0.5]) / np.sqrt(5), rtol=1e-13)


def test_a_zero_singular_value_is_skipped() -> None:
    step = tk.selectively_damped_step(np.diag([1.0, 0.0]), [0.1, 1.0])
    np.testing.assert_array_equal(step, [0.1, 0.0])
    np.testing.assert_array_equal(tk.selectively_damped_step(np.zeros((3, 5)), np.ones(3)), 0.0)


@given(sizes, sizes, seeds, scales)
def test_symmetries(m: int, n: int, seed: int, scale: float) -> None:
    """Odd in e; joints may be renumbered and turned round; rows renumbered within a block."""
    J, e = problem(m, n, seed, scale)
    step = tk.selectively_damped_step(J, e, 0.5, blocks=[m])
    rng = np.random.default_rng(seed)
    joints, rows, signs = rng.permutation(n), rng.permutation(m), rng.choice([-1, 1], n)
    np.testing.assert_array_equal(tk.selectively_damped_step(J, -e, 0.5, blocks=[m]), -step)
    moved = tk.selectively_damped_step((J * signs)[np.ix_(rows, joints)], e[rows], 0.5, blocks=[m])
    np.testing.assert_allclose(moved, (step * signs)[joints], atol=1e-9)


@pytest.mark.parametrize("blocks", [[], [3], [3, 4], [-1, 7], [0, 6], [6, 1]])
def test_blocks_that_do_not_add_up_are_refused(blocks: list[int]) -> None:
    with pytest.raises(ValueError, match=r"^blocks: got \[.*\], expected .* add up to 6"):
        tk.selectively_damped_step(np.eye(6), np.ones(6), blocks=blocks)


@pytest.mark.parametrize("gamma_max", [0.0, -1.0, np.nan, np.inf])
def test_the_bound_is_positive(gamma_max: float) -> None:
    for call in (
        lambda: tk.selectively_damped_step(np.eye(2), np.ones(2), gamma_max),
        lambda: tk.SelectivelyDamped(gamma_max),
    ):
        with pytest.raises(ValueError, match=r"^gamma_max: got .*, expected a finite number > 0"):
            call()
