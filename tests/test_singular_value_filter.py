"""The filter (4.12) of Colome & Torras: the facts of its formula, and which filters are refused."""

import pickle

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray

import thing_kin as tk

# h' is smallest for s below 1 whatever nu is, so that this grid meets every place where h may fall.
GRID = np.linspace(0.0, 3.0, 30_001)

shapes = st.floats(0.0, 20.0)
PAIRS = [(0.01, 10.0), (0.005, 0.0), (0.1, 1.0), (0.5, 1.5), (0.6, 3.0)]


def formula(s: NDArray[np.float64], sigma0: float, nu: float) -> NDArray[np.float64]:
    """[M17] (4.12) as printed."""
    return (s**3 + nu * s**2 + 2 * s + 2 * sigma0) / (s**2 + nu * s + 2)


def largest_sigma0(nu: float) -> float:
    """Where the slope of h touches zero, found on the grid and not by the closed form."""
    return float(1.0 / (2.0 * (2 * GRID + nu) / (GRID**2 + nu * GRID + 2) ** 2).max())


@pytest.mark.parametrize(("sigma0", "nu"), PAIRS)
def test_it_is_the_formula(sigma0: float, nu: float) -> None:
    h = tk.SingularValueFilter(sigma0, nu)
    assert (h.sigma0, h.nu) == (sigma0, nu)
    assert h(0.0) == sigma0
    np.testing.assert_allclose(h(GRID), formula(GRID, sigma0, nu), rtol=4e-16 * 4)
    assert h(0.7) == h(np.array([0.7]))[0]


@pytest.mark.parametrize(("sigma0", "nu"), PAIRS)
def test_it_lifts_and_lets_go(sigma0: float, nu: float) -> None:
    h = tk.SingularValueFilter(sigma0, nu)
    lift = h(GRID) - GRID
    assert (lift > 0).all()
    np.testing.assert_allclose(lift, 2 * sigma0 / (GRID**2 + nu * GRID + 2), atol=1e-15)
    for s in (1e6, 1e150, 1e300):
        assert h(s) == pytest.approx(s, rel=4e-16)


@given(shapes, st.floats(0.0, 0.999))
def test_filters_below_the_critical_sigma0_are_accepted_and_increase(
    nu: float, part: float
) -> None:
    h = tk.SingularValueFilter(part * largest_sigma0(nu), nu)
    assert (np.diff(h(GRID)) > 0).all()


@given(shapes, st.floats(1.001, 100.0))
def test_filters_above_it_fall_somewhere_and_are_refused(nu: float, part: float) -> None:
    sigma0 = part * largest_sigma0(nu)
    # Near the critical value h falls over a stretch shorter than the grid's steps.
    if part > 1.01:
        assert (np.diff(formula(GRID, sigma0, nu)) < 0).any()
    with pytest.raises(ValueError, match=r"^sigma0: got .* not increasing, expected"):
        tk.SingularValueFilter(sigma0, nu)


def test_the_critical_sigma0_of_equations_md() -> None:
    """2 s0 (2 s* + nu) <= (s*^2 + nu s* + 2)^2, both branches of s*."""
    for nu in (0.0, 0.5, 1.0, 1.41, 1.42, 2.0, 10.0):
        s = max(0.0, (-3 * nu + np.sqrt(24 - 3 * nu**2)) / 6) if nu < np.sqrt(2) else 0.0
        critical = (s**2 + nu * s + 2) ** 2 / (2 * (2 * s + nu))
        assert critical == pytest.approx(largest_sigma0(nu), rel=1e-6)
        tk.SingularValueFilter(critical * (1 - 1e-12), nu)
        with pytest.raises(ValueError, match="not increasing"):
            tk.SingularValueFilter(critical * (1 + 1e-12), nu)


@given(st.integers(1, 9), st.integers(1, 9), st.integers(0, 2**32 - 1), st.sampled_from(PAIRS))
def test_a_filtered_matrix_has_filtered_singular_values(
    m: int, n: int, seed: int, pair: tuple[float, float]
) -> None:
    rng = np.random.default_rng(seed)
    rank = rng.integers(0, min(m, n) + 1)
    A = rng.normal(size=(m, rank)) @ rng.normal(size=(rank, n))
    F = tk.filter_singular_values(A, sigma0=pair[0], nu=pair[1])
    sigma = np.linalg.svd(A, compute_uv=False)
    filtered = np.linalg.svd(F, compute_uv=False)
    rounding = 1e-14 * max(1.0, sigma[0])
    np.testing.assert_allclose(filtered, formula(sigma, *pair), atol=rounding)
    assert filtered[-1] >= pair[0] - rounding


@given(st.integers(2, 9), st.integers(0, 2**32 - 1))
def test_it_keeps_the_singular_vectors(n: int, seed: int) -> None:
    A = np.random.default_rng(seed).normal(size=(n, n))
    U, sigma, Vt = np.linalg.svd(A)
    assume(sigma[-1] > 1e-3)
    F = tk.filter_singular_values(A, sigma0=0.01, nu=10.0)
    # F = A + U diag(h - sigma) V^T, which does not depend on the choice of repeated vectors.
    np.testing.assert_allclose(F, U @ np.diag(formula(sigma, 0.01, 10.0)) @ Vt, atol=1e-12)


def test_no_lift_is_no_change() -> None:
    A = np.random.default_rng(0).normal(size=(2, 4, 6))
    np.testing.assert_allclose(tk.filter_singular_values(A, sigma0=0.0, nu=1.0), A, atol=1e-14)


@pytest.mark.parametrize(
    ("sigma0", "nu", "name"),
    [
        *((wrong, 1.0, "sigma0") for wrong in (-0.1, np.nan, np.inf)),
        *((0.1, wrong, "nu") for wrong in (-1.0, np.nan, np.inf)),
    ],
)
def test_what_is_no_filter_is_refused(sigma0: float, nu: float, name: str) -> None:
    with pytest.raises(ValueError, match=rf"^{name}: got .*, expected"):
        tk.SingularValueFilter(sigma0, nu)
    with pytest.raises(ValueError, match=rf"^{name}: got .*, expected"):
        tk.filter_singular_values(np.eye(2), sigma0=sigma0, nu=nu)


def test_it_is_a_value() -> None:
    h = tk.SingularValueFilter(0.01, 10.0)
    assert h == pickle.loads(pickle.dumps(h)) == tk.SingularValueFilter(0.01, 10.0)
    assert hash(h) == hash(tk.SingularValueFilter(0.01, 10.0))
    assert h != tk.SingularValueFilter(0.02, 10.0)
