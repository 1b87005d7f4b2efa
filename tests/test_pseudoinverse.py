"""Exact, damped and filtered pseudoinverses: laws, numpy as the oracle, degenerate matrices."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from numpy.typing import NDArray

import thing_kin as tk
from matrices import EPS, Matrix, matrices, of_rank

FILTER = tk.SingularValueFilter(0.01, 10.0)


def nonzero_singular_values(A: Matrix) -> NDArray[np.float64]:
    sigma = np.linalg.svd(A, compute_uv=False)
    return sigma[sigma > max(A.shape) * EPS * sigma[0]] if sigma[0] > 0 else np.ones(1)


def error_bound(A: Matrix) -> float:
    """Relative error to expect of a pseudoinverse: rounding times the condition number."""
    sigma = nonzero_singular_values(A)
    return float(20 * max(A.shape) * EPS * sigma[0] / sigma[-1])


def assert_moore_penrose(A: Matrix, P: Matrix) -> None:
    bound = error_bound(A) * max(1.0, np.linalg.norm(A) * np.linalg.norm(P))
    for product, expected in ((A @ P @ A, A), (P @ A @ P, P)):
        assert np.linalg.norm(product - expected) <= bound * np.linalg.norm(expected)
    for projector in (A @ P, P @ A):
        assert np.linalg.norm(projector - projector.T) <= bound


@given(matrices())
@example(np.zeros((3, 5)))
@example(np.eye(4))
@example(np.diag([2.0, 2.0, 0.0]))  # repeated singular values, one of them zero
@example(np.ones((1, 1)))
@example(np.ones((12, 12)))
def test_it_satisfies_moore_and_penrose_and_agrees_with_numpy(A: Matrix) -> None:
    P = tk.pinv(A)
    assert P.shape == A.T.shape
    assert_moore_penrose(A, P)
    reference = np.linalg.pinv(A, rcond=max(A.shape) * EPS)
    assert np.linalg.norm(P - reference) <= error_bound(A) * np.linalg.norm(reference)


@pytest.mark.parametrize(("m", "n", "rank"), [(32, 32, 32), (32, 7, 7), (7, 32, 7), (32, 32, 20)])
def test_the_largest_sizes(m: int, n: int, rank: int) -> None:
    A = of_rank(m, n, rank, seed=m + n + rank)
    assert len(nonzero_singular_values(A)) == rank
    P = tk.pinv(A)
    assert_moore_penrose(A, P)
    assert np.trace(A @ P) == pytest.approx(rank, abs=error_bound(A) * 32)


@given(matrices(), st.integers(-500, 500))
def test_powers_of_two_only_move_the_exponent(A: Matrix, exponent: int) -> None:
    """Reaches 1e-150 and 1e150; nothing may overflow, underflow or change a digit on the way."""
    np.testing.assert_array_equal(tk.pinv(np.ldexp(A, exponent)), np.ldexp(tk.pinv(A), -exponent))


@pytest.mark.parametrize("scale", [1e-150, 1e-75, 1.0, 1e75, 1e150])
def test_badly_scaled_matrices(scale: float) -> None:
    A = of_rank(6, 9, 6, seed=0) * scale
    np.testing.assert_allclose(A @ tk.pinv(A), np.eye(6), atol=error_bound(A))
    np.testing.assert_allclose(
        tk.pinv(A, damping=scale**2) @ A, tk.pinv(A / scale, damping=1.0) @ (A / scale), atol=1e-12
    )


def test_singular_values_of_very_different_size_keep_their_digits() -> None:
    P = tk.pinv(np.diag([1e10, 1.0, 1e-4]))
    np.testing.assert_allclose(P, np.diag([1e-10, 1.0, 1e4]), rtol=1e-15)
    # Beyond max(m, n) eps sigma_1 a singular value counts as zero.
    np.testing.assert_array_equal(tk.pinv(np.diag([1.0, 4.1e-16])), np.diag([1.0, 0.0]))
    np.testing.assert_allclose(tk.pinv(np.diag([1.0, 4.6e-16])), np.diag([1.0, 1 / 4.6e-16]))


@given(matrices(), st.floats(1e-6, 1e2))
def test_damped_is_the_regularized_least_squares_solution(A: Matrix, damping: float) -> None:
    """[M17] (4.7): J^T (J J^T + lambda I)^-1."""
    G = A @ A.T + damping * np.eye(len(A))
    reference = np.linalg.solve(G, A).T
    bound = 20 * max(A.shape) * EPS * np.linalg.cond(G) * max(1.0, np.linalg.norm(reference))
    assert np.linalg.norm(tk.pinv(A, damping=damping) - reference) <= bound


def test_each_singular_value_may_have_its_own_lambda() -> None:
    """[M17] (4.11), largest singular value first; a lambda of zero is exact there."""
    A = np.random.default_rng(2).normal(size=(4, 7))
    damping = np.array([0.0, 1e-2, 1.0, 30.0])
    U, sigma, Vt = np.linalg.svd(A, full_matrices=False)
    reference = Vt.T @ np.diag(sigma / (sigma**2 + damping)) @ U.T
    np.testing.assert_allclose(tk.pinv(A, damping=damping), reference, atol=1e-13)
    np.testing.assert_array_equal(tk.pinv(A, damping=np.full(4, 0.3)), tk.pinv(A, damping=0.3))
    np.testing.assert_array_equal(tk.pinv(A, damping=0.0), tk.pinv(A))


@given(matrices())
def test_the_filter_composes_with_each_inverse(A: Matrix) -> None:
    """The filtered matrix has full rank, so that the plain formulas apply to it."""
    F = tk.filter_singular_values(A, sigma0=0.01, nu=10.0)
    cond = np.linalg.cond(F)
    for damping in (None, 1e-3):
        P = tk.pinv(A, damping=damping, singular_value_filter=FILTER)
        if damping is None:
            assert np.linalg.norm(P, 2) <= 1 / 0.01 * (1 + 100 * EPS * cond)
        # A repeated zero leaves the choice of its singular vectors free: compare what is unique.
        if np.linalg.matrix_rank(A) == min(A.shape):
            reference = np.linalg.pinv(F) if damping is None else tk.pinv(F, damping=damping)
            assert np.linalg.norm(P - reference) <= 1e3 * EPS * cond * np.linalg.norm(reference)


@given(matrices())
def test_transposition_commutes(A: Matrix) -> None:
    bound = error_bound(A) * np.linalg.norm(tk.pinv(A))
    np.testing.assert_allclose(tk.pinv(A.T), tk.pinv(A).T, atol=bound)


def test_orthogonal_matrices_repeat_their_singular_value() -> None:
    Q, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(8, 8)))
    np.testing.assert_allclose(tk.pinv(3 * Q), Q.T / 3, atol=1e-15 * 8)
    np.testing.assert_allclose(tk.pinv(3 * Q, damping=9.0), Q.T / 6, atol=1e-15 * 8)


def test_a_batch_is_its_items() -> None:
    A = np.random.default_rng(4).normal(size=(5, 3, 6))
    np.testing.assert_array_equal(tk.pinv(A), [tk.pinv(item) for item in A])
    assert tk.pinv(A[:0]).shape == (0, 6, 3)
