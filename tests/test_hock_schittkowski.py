"""Algorithm 2 on Hock and Schittkowski's problems: to their optima, with each minimizer."""

import numpy as np
import pytest

import thing_kin as tk
from hock_schittkowski import HS, PROBLEMS

# The book gives up to ten digits; ours are good to more.
OBJECTIVE = 1e-6
FEASIBILITY = 1e-8
TOO_STIFF = {100, 113}  # for penalties rounded over 1e-9; they end short of the optimum, and say so


def check(hs: HS, result: tk.SqpResult) -> None:
    assert result.success, result.message
    assert abs(result.objective - hs.best) <= OBJECTIVE * max(1.0, abs(hs.best)), result
    problem = hs.problem()
    at = problem.evaluate(result.x)
    assert at.violation <= FEASIBILITY
    assert at.objective == result.objective
    assert np.all(result.x >= problem.lower)
    assert np.all(result.x <= problem.upper)


def test_there_are_many() -> None:
    assert len(PROBLEMS) >= 50
    assert sum(hs.equal is not None or hs.at_least is not None for hs in PROBLEMS) >= 40


@pytest.mark.parametrize("hs", PROBLEMS, ids=lambda hs: f"HS{hs.number}")
@pytest.mark.parametrize("minimizer", ["augmented_lagrangian", "smoothed", "qp"])
def test_optimum(hs: HS, minimizer: str) -> None:
    if minimizer == "smoothed" and hs.number in TOO_STIFF:
        pytest.skip("the steps of this one are lost in rounding at a width of 1e-9")
    check(hs, tk.sqp(hs.problem(), hs.x0, minimizer=minimizer))


@pytest.mark.parametrize("hs", PROBLEMS, ids=lambda hs: f"HS{hs.number}")
def test_bfgs_ends_there_too(hs: HS, capfd: pytest.CaptureFixture[str]) -> None:
    check(hs, tk.sqp(hs.problem(), hs.x0, minimizer="bfgs"))
    assert capfd.readouterr() == ("", "")  # Ceres' line search would warn where all is flat


@pytest.mark.parametrize("hs", PROBLEMS, ids=lambda hs: f"HS{hs.number}")
def test_derivatives_of_the_problems(hs: HS) -> None:
    """The gradients that the solver gets, by differences: an error here would excuse it."""
    problem = hs.problem()
    x = np.clip(np.array(hs.x0, dtype=float) + 0.1, problem.lower, problem.upper)
    at = problem.evaluate(x)
    for i in range(problem.n):
        h = 1e-6 * max(1.0, abs(x[i]))
        ahead, behind = x.copy(), x.copy()
        ahead[i] += h
        behind[i] -= h
        a, b = problem.evaluate(ahead), problem.evaluate(behind)
        scale = 1.0 + np.abs(at.gradient).max()
        assert abs((a.objective - b.objective) / (2 * h) - at.gradient[i]) < 1e-5 * scale
        if at.values.size:
            slope = (a.values - b.values) / (2 * h)
            scale = 1.0 + np.abs(at.jacobian).max()
            np.testing.assert_allclose(slope, at.jacobian[:, i], atol=1e-5 * scale)
