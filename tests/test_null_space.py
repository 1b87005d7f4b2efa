"""The exact null-space projector of [M17] (4.15) and its basis."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import thing_kin as tk
from matrices import EPS, Matrix, matrices, of_rank


@given(matrices(), st.sampled_from([1e-150, 1.0, 1e150]))
@example(np.zeros((2, 3)), 1.0)
@example(np.eye(3), 1.0)
@example(np.ones((12, 12)), 1.0)
@example(of_rank(32, 32, 20, 1), 1.0)
@example(of_rank(6, 32, 6, 2), 1.0)
def test_projector_and_basis(A: Matrix, scale: float) -> None:
    n = A.shape[1]
    rank = np.linalg.matrix_rank(A)
    rounding = 40 * max(A.shape) * EPS
    Z = tk.null_space(A * scale)
    N = tk.null_space_projector(A * scale)
    assert Z.shape == (n, n - rank)
    np.testing.assert_allclose(Z.T @ Z, np.eye(n - rank), atol=rounding)
    np.testing.assert_allclose(N, N.T, atol=rounding)
    np.testing.assert_allclose(N @ N, N, atol=rounding)
    np.testing.assert_allclose(N, Z @ Z.T, atol=rounding)
    assert np.trace(N) == pytest.approx(n - rank, abs=rounding * n)
    # The claim that strict priority rests on: relative to A, whatever its condition.
    assert np.linalg.norm(A @ N) <= rounding * np.linalg.norm(A)


@given(matrices())
def test_it_is_what_the_pseudoinverse_leaves(A: Matrix) -> None:
    P = np.linalg.pinv(A, rcond=max(A.shape) * EPS)
    bound = 20 * max(A.shape) * EPS * max(1.0, np.linalg.norm(A) * np.linalg.norm(P))
    np.testing.assert_allclose(tk.null_space_projector(A), np.eye(A.shape[1]) - P @ A, atol=bound)


def test_a_nearly_singular_matrix_keeps_its_rows_out() -> None:
    """sigma = 1e-12 is small but no zero: its direction belongs to the row space."""
    A = np.diag([1.0, 1e-12, 0.0])
    np.testing.assert_allclose(tk.null_space_projector(A), np.diag([0.0, 0.0, 1.0]), atol=1e-15)


def test_a_batch_is_its_items() -> None:
    A = np.random.default_rng(4).normal(size=(5, 3, 6))
    singles = [tk.null_space_projector(item) for item in A]
    np.testing.assert_array_equal(tk.null_space_projector(A), singles)
    with pytest.raises(ValueError, match=r"^J: got a batch, expected shape \(m, n\)"):
        tk.null_space(A)
