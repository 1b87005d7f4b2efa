"""A user's own term: what it may return, what is refused, and its derivatives checked."""

import numpy as np
import pytest

import thing_kin as tk
from jets import functions, sin

VALUE, JACOBIAN, HESSIAN = functions(lambda a, b: [a**3 * b, sin(a * b), a - b])
TERM = tk.terms.Function(VALUE, JACOBIAN, HESSIAN, size=3, name="three")
X = np.array([0.7, -1.3])


def problem_of(term: tk.terms.Function, n: int = 2) -> tk.Problem:
    problem = tk.Problem(n=n)
    problem.minimize_squares(term)
    return problem


def test_it_passes_through() -> None:
    problem = tk.Problem(n=2)
    problem.between(TERM, -1.0, 1.0)
    at = problem.evaluate(X)
    np.testing.assert_array_equal(at.values, VALUE(X))
    np.testing.assert_array_equal(at.jacobian, JACOBIAN(X))
    assert problem.constraint_names == ("three[0]", "three[1]", "three[2]")


def test_one_number_needs_no_brackets() -> None:
    problem = tk.Problem(n=2)
    problem.minimize(tk.terms.Function(lambda x: x[0] * x[1], lambda x: x[::-1]))
    at = problem.evaluate((2.0, 3.0))
    assert at.objective == 6.0
    np.testing.assert_array_equal(at.gradient, [3.0, 2.0])


def test_right_derivatives_pass() -> None:
    check = tk.check_derivatives(TERM, X)
    assert check.success
    assert check.jacobian_difference < 1e-10
    assert check.hessian_difference < 1e-8


@pytest.mark.parametrize(("row", "col"), [(0, 1), (2, 0)])
def test_a_wrong_entry_is_found(row: int, col: int) -> None:
    def jacobian(x: np.ndarray) -> np.ndarray:
        J = JACOBIAN(x)
        J[row, col] += 0.01
        return J

    check = tk.check_derivatives(tk.terms.Function(VALUE, jacobian, HESSIAN, size=3), X)
    assert not check.success
    assert check.jacobian_entry == (row, col)
    expected = 0.01 / max(1.0, np.abs(JACOBIAN(X)).max())
    assert check.jacobian_difference == pytest.approx(expected, rel=0.02)


def test_a_wrong_hessian_is_found() -> None:
    def hessian(x: np.ndarray) -> np.ndarray:
        H = HESSIAN(x)
        H[1, 0, 0] += 0.1
        return H

    check = tk.check_derivatives(tk.terms.Function(VALUE, JACOBIAN, hessian, size=3), X)
    assert not check.success
    assert check.hessian_entry == (1, 0, 0)
    assert check.jacobian_difference < 1e-10


def test_without_a_hessian_differences_take_its_place() -> None:
    without = tk.terms.Function(VALUE, JACOBIAN, size=3)
    solved = [tk.sqp(problem_of(term), X).x for term in (TERM, without)]
    np.testing.assert_allclose(*solved, atol=1e-7)


@pytest.mark.parametrize(
    ("returned", "said"),
    [
        (np.zeros(2), r"value of 'bad': got shape \(2,\), expected \(3,\)"),
        (5.0, r"value of 'bad': got shape \(\), expected \(3,\)"),
        ([1.0, np.nan, 1.0], r"value of 'bad': got nan at flat index 1, expected finite"),
        ([1.0, np.inf, 1.0], r"value of 'bad': got inf"),
        ("text", r"value of 'bad': got"),
        ([1j, 0, 0], r"value of 'bad': got dtype complex128"),
    ],
)
def test_what_a_value_must_not_be(returned: object, said: str) -> None:
    problem = problem_of(tk.terms.Function(lambda x: returned, JACOBIAN, size=3, name="bad"))
    with pytest.raises(ValueError, match=said):
        problem.evaluate(X)
    with pytest.raises(ValueError, match=said):
        tk.sqp(problem, X)


@pytest.mark.parametrize("returned", [np.zeros((2, 3)), np.zeros(6), np.full((3, 2), np.nan), 1.0])
def test_what_derivatives_must_not_be(returned: object) -> None:
    problem = problem_of(tk.terms.Function(VALUE, lambda x: returned, size=3, name="bad"))
    with pytest.raises(ValueError, match="jacobian of 'bad': got"):
        tk.sqp(problem, X)
    term = tk.terms.Function(VALUE, JACOBIAN, lambda x: returned, size=3, name="bad")
    with pytest.raises(ValueError, match="hessian of 'bad': got"):
        tk.sqp(problem_of(term), X)


class OwnError(Exception):
    pass


@pytest.mark.parametrize("minimizer", ["augmented_lagrangian", "qp"])
def test_what_a_function_raises_comes_through(minimizer: str) -> None:
    calls = []

    def value(x: np.ndarray) -> np.ndarray:
        calls.append(x)
        if len(calls) == 4:
            raise OwnError("the fourth")
        return VALUE(x)

    with pytest.raises(OwnError, match="the fourth"):
        tk.sqp(problem_of(tk.terms.Function(value, JACOBIAN, size=3)), X, minimizer=minimizer)
    assert len(calls) == 4


def test_a_function_may_keep_and_change_what_it_gets() -> None:
    kept = []

    def value(x: np.ndarray) -> float:
        kept.append(x.copy())
        x[:] = np.nan
        return float(kept[-1] @ kept[-1])

    problem = tk.Problem(n=2)
    problem.minimize(tk.terms.Function(value, lambda x: 2 * x))
    result = tk.sqp(problem, (3.0, 4.0))
    np.testing.assert_allclose(result.x, 0.0, atol=1e-8)


def test_none_says_that_it_does_not_exist() -> None:
    """x log x, which has no value below 0; its minimum is at 1/e."""

    def value(x: np.ndarray) -> float | None:
        return float(x[0] * np.log(x[0])) if x[0] > 0 else None

    term = tk.terms.Function(value, lambda x: 1 + np.log(x), lambda x: 1 / x[:, None], name="xlogx")
    problem = tk.Problem(n=1)
    problem.minimize(term)
    result = tk.sqp(problem, [0.01], delta0=10.0)
    assert result.success
    assert result.x[0] == pytest.approx(np.exp(-1), abs=1e-7)
    with pytest.raises(ValueError, match=r"x: got .*'xlogx' does not exist, expected"):
        problem.evaluate([-1.0])
    nowhere = tk.sqp(problem, [-1.0])
    assert (nowhere.success, nowhere.status) == (False, "budget")
    assert "'xlogx' does not exist" in nowhere.message
    with pytest.raises(ValueError, match="x: got 'xlogx' that does not exist"):
        tk.check_derivatives(term, [-1.0])


@pytest.mark.parametrize(
    ("arguments", "options", "said"),
    [
        ((1, JACOBIAN), {}, "value: got int, expected a function"),
        ((VALUE, None), {}, "jacobian: got NoneType"),
        ((VALUE, JACOBIAN, 3), {}, "hessian: got int"),
        ((VALUE, JACOBIAN), {"size": 0}, "size: got 0"),
        ((VALUE, JACOBIAN), {"n": 0}, "n: got 0"),
    ],
)
def test_misuse(arguments: tuple, options: dict, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        tk.terms.Function(*arguments, **options)


def test_the_number_of_variables() -> None:
    term = tk.terms.Function(VALUE, JACOBIAN, size=3, n=2, name="three")
    with pytest.raises(ValueError, match="term: got 'three' of 2 variables, expected one of 5"):
        tk.Problem(n=5).minimize(term)
    with pytest.raises(ValueError, match=r"x: got shape \(3,\), expected \(2,\)"):
        tk.check_derivatives(term, np.zeros(3))
