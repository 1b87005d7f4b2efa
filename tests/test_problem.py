"""A problem is the sum of what was put in; what is wrong is refused by name."""

import numpy as np
import pytest

import thing_kin as tk
from jets import exp, functions

X = np.array([0.5, -1.5, 2.0])


def term(f, size: int = 1, name: str = "function") -> tk.terms.Function:
    return tk.terms.Function(*functions(f), size=size, name=name)


SQUARES = term(lambda a, b, c: [a**2, b**2 + c], size=2, name="squares")
PRODUCT = term(lambda a, b, c: [a * b * c], name="product")


def test_objectives_add_up() -> None:
    problem = tk.Problem(n=3)
    problem.minimize(SQUARES, weight=2.0)
    problem.minimize(PRODUCT, weight=-1.0)
    problem.minimize_squares(SQUARES, weight=0.5)
    a, b, c = X
    s = np.array([a**2, b**2 + c])
    at = problem.evaluate(X)
    assert at.objective == pytest.approx(2 * s.sum() - a * b * c + 0.5 * s @ s, rel=1e-14)
    J = np.array([[2 * a, 0, 0], [0, 2 * b, 1]])
    gradient = 2 * J.sum(axis=0) - np.array([b * c, a * c, a * b]) + J.T @ s
    np.testing.assert_allclose(at.gradient, gradient, rtol=1e-14)
    assert (at.values.shape, at.jacobian.shape) == ((0,), (0, 3))
    assert (at.violation, at.violations) == (0.0, {})


def test_the_hessian_is_exact() -> None:
    """One Newton step squares the error; Gauss-Newton would only lessen it."""
    problem = tk.Problem(n=2)
    problem.minimize_squares(
        term(lambda a, b: [exp(a) - 3, a + 1 - b, exp(b - a) + 1], size=3), weight=0.3
    )
    best = tk.sqp(problem, [0.0, 0.0], optimality_tolerance=1e-12).x
    near = tk.sqp(problem, best + 1e-3, max_iterations=1, optimality_tolerance=1e-12)
    assert near.iterations == 1
    assert np.abs(near.x - best).max() < 1e-5


def test_names_of_clearances_say_what_is_near_what() -> None:
    robot = tk.robots.thing()
    problem = tk.Problem(robot)
    discs = [tk.Disc(center=(2.0, 0.0), radius=0.5), tk.Disc(center=(0.0, 0.3), radius=0.5)]
    problem.at_least(tk.terms.Clearance(obstacles=discs), 0.0)
    assert problem.constraint_names == (
        "clearance[0] (the base and obstacle 0)",
        "clearance[1] (the base and obstacle 1)",
    )
    at = problem.evaluate(np.zeros(9))
    assert list(at.violations) == ["clearance[1] (the base and obstacle 1)"]


def test_constraints_keep_their_order_and_names() -> None:
    problem = tk.Problem(n=3)
    problem.equal(SQUARES, (0.25, 4.0))
    problem.at_most(PRODUCT, -2.0)
    problem.at_least(PRODUCT, -1.0, name="again")
    problem.between(PRODUCT, -3.0, -2.0)
    problem.bound(1, 0.0, 1.0)
    names = ("squares[0]", "squares[1]", "product", "again", "product (2)")
    assert problem.constraint_names == names
    np.testing.assert_array_equal(problem.constraint_lower, [0.25, 4.0, -np.inf, -1.0, -3.0])
    np.testing.assert_array_equal(problem.constraint_upper, [0.25, 4.0, -2.0, np.inf, -2.0])
    at = problem.evaluate(X)
    np.testing.assert_allclose(at.values, [0.25, 4.25, -1.5, -1.5, -1.5])
    expected = {
        "bound of x[1]": 1.5,
        "product": 0.5,
        "again": 0.5,
        "product (2)": 0.5,
        "squares[1]": 0.25,
    }
    assert at.violations == expected
    assert next(iter(at.violations)) == "bound of x[1]"
    assert at.violation == 1.5


def test_a_robot_brings_its_limits() -> None:
    robot = tk.robots.thing()
    problem = tk.Problem(robot)
    assert (problem.n, problem.names) == (9, robot.names)
    np.testing.assert_array_equal(problem.lower, robot.lower)
    np.testing.assert_array_equal(problem.upper, robot.upper)
    problem.bound("theta", -0.25, 0.5)
    problem.bound(0, upper=1.0)
    j = robot.names.index("theta")
    assert (problem.lower[j], problem.upper[j]) == (-0.25, 0.5)
    assert (problem.lower[0], problem.upper[0]) == (-np.inf, 1.0)
    assert problem.evaluate(np.ones(9)).violations == {"bound of theta": 0.5}


def test_bounds_without_a_robot() -> None:
    problem = tk.Problem(n=2, lower=-1.0, upper=(2.0, np.inf))
    np.testing.assert_array_equal(problem.lower, [-1.0, -1.0])
    np.testing.assert_array_equal(problem.upper, [2.0, np.inf])


def test_arrays_are_copies() -> None:
    problem = tk.Problem(n=2, lower=0.0)
    problem.lower[:] = 5.0
    np.testing.assert_array_equal(problem.lower, 0.0)


def test_crossed_bounds_are_kept_and_named() -> None:
    problem = tk.Problem(n=2)
    problem.bound(0, 1.0, -1.0)
    assert problem.evaluate([0.0, 0.0]).violations == {"crossed bounds of x[0]": 2.0}


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({}, "n: got None"),
        ({"n": 0}, "n: got 0"),
        ({"n": -3}, "n: got -3"),
        ({"n": 2, "lower": [0.0, np.nan]}, "lower: got nan"),
        ({"n": 2, "upper": np.zeros(3)}, r"upper: got shape \(3,\)"),
        ({"n": 2, "upper": "a"}, "upper: got"),
        ({"robot": 5}, "robot: got int"),
        ({"robot": tk.robots.ur5(), "n": 6}, "n: got a value beside robot"),
        ({"robot": tk.robots.ur5(), "lower": 0.0}, "lower: got a value beside robot"),
    ],
)
def test_misuse_of_the_constructor(options: dict, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        tk.Problem(**options)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda p: p.minimize(PRODUCT, weight=np.nan), "weight: got nan"),
        (lambda p: p.minimize(PRODUCT, weight=np.inf), "weight: got inf"),
        (lambda p: p.minimize_squares(PRODUCT, weight=-1.0), "weight: got -1"),
        (lambda p: p.equal(PRODUCT, np.nan), "target: got nan"),
        (lambda p: p.equal(PRODUCT, np.inf), "target: got inf"),
        (lambda p: p.equal(SQUARES, np.zeros(3)), r"target: got shape \(3,\)"),
        (lambda p: p.at_most(SQUARES, [np.nan, 0.0]), "upper: got nan"),
        (lambda p: p.at_least(PRODUCT, None), "lower: got"),
        (lambda p: p.between(PRODUCT, 0.0, np.nan), "upper: got nan"),
        (lambda p: p.bound("theta", 0.0, 1.0), r"variable: got 'theta', expected one of 'x\[0\]'"),
        (lambda p: p.bound(3, 0.0, 1.0), "variable: got 3, expected 0 to 2"),
        (lambda p: p.bound(-1, 0.0, 1.0), "variable: got -1"),
        (lambda p: p.bound(10**30, 0.0, 1.0), "variable: got 1000"),
        (lambda p: p.bound(1.5, 0.0, 1.0), "variable: got float"),
        (lambda p: p.bound(0, np.nan, 1.0), "lower: got nan"),
        (lambda p: p.bound(0, 0.0, [1.0, 2.0]), r"upper: got shape \(2,\)"),
        (lambda p: p.evaluate(np.zeros(4)), r"x: got shape \(4,\), expected \(3,\)"),
        (lambda p: p.evaluate([0.0, np.nan, 0.0]), "x: got nan"),
    ],
)
def test_misuse_changes_nothing(call, said: str) -> None:
    problem = tk.Problem(n=3)
    problem.minimize(SQUARES)
    before = (repr(problem), problem.lower.tolist(), problem.upper.tolist())
    with pytest.raises(ValueError, match=said):
        call(problem)
    assert (repr(problem), problem.lower.tolist(), problem.upper.tolist()) == before
