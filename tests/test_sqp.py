"""Algorithm 2: what it calls converged is a minimum, what it calls infeasible is, within budget."""

import threading

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import LinearConstraint, linprog, minimize

import thing_kin as tk
from jets import cos, exp, functions, sin
from strategies import seeds

MINIMIZERS = ("augmented_lagrangian", "smoothed", "bfgs", "qp")
EXACT = ("augmented_lagrangian", "smoothed", "qp")


def term(f, size: int = 1, name: str = "function") -> tk.terms.Function:
    return tk.terms.Function(*functions(f), size=size, name=name)


def linear(A: np.ndarray, name: str = "linear") -> tk.terms.Function:
    A = np.atleast_2d(A)
    zeros = np.zeros((*A.shape, A.shape[1]))
    return tk.terms.Function(lambda x: A @ x, lambda x: A, lambda x: zeros, size=len(A), name=name)


def quadratic(P: np.ndarray, g: np.ndarray) -> tk.terms.Function:
    return tk.terms.Function(lambda x: x @ P @ x / 2 + g @ x, lambda x: P @ x + g, lambda x: P)


def kkt_residual(problem: tk.Problem, result: tk.SqpResult) -> float:
    """Of the multipliers that were returned, written out once more."""
    at = problem.evaluate(result.x)
    y, z = result.multipliers, result.bound_multipliers
    slope = at.gradient + at.jacobian.T @ y + z
    slack = []
    for value, lower, upper, force in (
        (at.values, problem.constraint_lower, problem.constraint_upper, y),
        (result.x, problem.lower, problem.upper, z),
    ):
        bound = np.where(force > 0, upper, lower)
        slack += [abs(f * (v - b)) for f, v, b in zip(force, value, bound, strict=True) if f != 0]
    pulls = np.abs(y) * np.linalg.norm(at.jacobian, axis=1)
    scale = max([1.0, *np.abs(at.gradient)])
    return max(np.abs(slope).max() / max([scale, *pulls, *np.abs(z)]), max([0.0, *slack]) / scale)


# --- Convex programs: a manufactured solution, and SciPy ----------------------------------------


def manufactured(seed: int) -> tuple[tk.Problem, np.ndarray, np.ndarray, np.ndarray]:
    """A convex QP whose solution, multipliers and active set were chosen first."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 8))
    equal, unequal = int(rng.integers(0, n)), int(rng.integers(0, 5))
    root = rng.normal(size=(n, n))
    P = root @ root.T + 0.1 * np.eye(n)
    x = rng.normal(size=n)
    A, G = rng.normal(size=(equal, n)), rng.normal(size=(unequal, n))
    active = rng.random(unequal) < 0.5
    y = rng.normal(size=equal)
    force = np.where(active, rng.uniform(0.1, 2.0, unequal), 0.0)
    g = -(P @ x + A.T @ y + G.T @ force)
    problem = tk.Problem(n=n)
    problem.minimize(quadratic(P, g))
    if equal:
        problem.equal(linear(A), A @ x)
    if unequal:
        problem.at_most(linear(G), G @ x + np.where(active, 0.0, rng.uniform(0.1, 1.0, unequal)))
    return problem, x, np.concatenate([y, force]), rng.normal(size=n)


@given(seed=seeds)
@settings(max_examples=60)
def test_convex_programs_have_the_solution_they_were_made_of(seed: int) -> None:
    problem, x, multipliers, x0 = manufactured(seed)
    for minimizer in ("augmented_lagrangian", "qp"):
        result = tk.sqp(problem, x0, minimizer=minimizer)
        assert result.success, (minimizer, result.message)
        np.testing.assert_allclose(result.x, x, atol=1e-5)
        if np.linalg.matrix_rank(problem.evaluate(x).jacobian) == len(multipliers):
            np.testing.assert_allclose(result.multipliers, multipliers, atol=1e-4)


@pytest.mark.parametrize("seed", range(8))
def test_scipy_finds_nothing_better(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n, m = 5, 4
    root = rng.normal(size=(n, 3))  # singular
    P, g, A = root @ root.T, rng.normal(size=n), rng.normal(size=(m, n))
    lower, upper = -rng.random(m), rng.random(m)
    problem = tk.Problem(n=n, lower=-1.0, upper=1.0)
    problem.minimize(quadratic(P, g))
    problem.between(linear(A), lower, upper)
    x0 = rng.normal(size=n)
    ours = tk.sqp(problem, x0)
    theirs = minimize(
        lambda x: x @ P @ x / 2 + g @ x,
        np.clip(x0, -1, 1),
        jac=lambda x: P @ x + g,
        bounds=[(-1, 1)] * n,
        constraints=LinearConstraint(A, lower, upper),
        method="SLSQP",
        options={"ftol": 1e-14, "maxiter": 1000},
    )
    assert ours.success, ours.message
    assert ours.objective == pytest.approx(theirs.fun, abs=1e-7)


@pytest.mark.parametrize("minimizer", EXACT)
@pytest.mark.parametrize("seed", range(4))
def test_linear_programs(seed: int, minimizer: str) -> None:
    """No curvature at all: the solution is a corner."""
    rng = np.random.default_rng(seed)
    c, A, b = rng.normal(size=4), rng.normal(size=(3, 4)), rng.random(3)
    problem = tk.Problem(n=4, lower=0.0, upper=2.0)
    problem.minimize(linear(c))
    problem.at_most(linear(A), b)
    ours = tk.sqp(problem, np.ones(4), minimizer=minimizer)
    theirs = linprog(c, A_ub=A, b_ub=b, bounds=(0.0, 2.0))
    assert ours.success, ours.message
    assert ours.objective == pytest.approx(theirs.fun, abs=1e-7)


# --- Nonlinear -----------------------------------------------------------------------------------


@pytest.mark.parametrize("minimizer", MINIMIZERS)
def test_unconstrained(minimizer: str) -> None:
    problem = tk.Problem(n=2)
    problem.minimize_squares(term(lambda a, b: [10 * (b - a**2), 1 - a], size=2))
    result = tk.sqp(problem, (-1.2, 1.0), minimizer=minimizer)
    assert result.success, result.message
    np.testing.assert_allclose(result.x, 1.0, atol=1e-6)


@pytest.mark.parametrize("minimizer", MINIMIZERS)
def test_one_variable(minimizer: str) -> None:
    problem = tk.Problem(n=1, upper=0.5)
    problem.minimize(term(lambda a: [exp(a) - 2 * a]))
    result = tk.sqp(problem, [-3.0], minimizer=minimizer)
    assert result.success, result.message
    np.testing.assert_allclose(result.x, 0.5, atol=1e-9)
    assert result.bound_multipliers[0] == pytest.approx(2 - np.exp(0.5), abs=1e-7)


@pytest.mark.parametrize("minimizer", MINIMIZERS)
def test_no_objective(minimizer: str) -> None:
    """Any feasible point will do."""
    problem = tk.Problem(n=2, lower=0.0)
    problem.equal(term(lambda a, b: [a**2 + b**2, a - b], size=2), (8.0, 0.0))
    result = tk.sqp(problem, (5.0, 0.3), minimizer=minimizer)
    assert result.success, result.message
    np.testing.assert_allclose(result.x, 2.0, atol=1e-7)


def test_nothing_at_all() -> None:
    result = tk.sqp(tk.Problem(n=2, upper=1.0), (3.0, 0.5))
    assert result.success
    np.testing.assert_array_equal(result.x, [1.0, 0.5])  # brought into the bounds
    assert (result.iterations, len(result.trace)) == (0, 0)


def test_all_variables_fixed() -> None:
    problem = tk.Problem(n=2, lower=(1.0, 2.0), upper=(1.0, 2.0))
    problem.minimize(term(lambda a, b: [a**2 + b]))
    for minimizer in MINIMIZERS:
        result = tk.sqp(problem, (7.0, 7.0), minimizer=minimizer)
        assert result.success, result.message
        np.testing.assert_array_equal(result.x, [1.0, 2.0])


def maratos(x0: float) -> tuple[tk.Problem, np.ndarray]:
    """Powell 1987: on the circle, a full Newton step raises both objective and violation."""
    problem = tk.Problem(n=2)
    problem.minimize(term(lambda a, b: [2 * (a**2 + b**2 - 1) - a]))
    problem.equal(term(lambda a, b: [a**2 + b**2 - 1]))
    return problem, np.array([np.cos(x0), np.sin(x0)])


@pytest.mark.parametrize("minimizer", EXACT)
def test_the_maratos_effect_is_corrected(minimizer: str) -> None:
    problem, start = maratos(0.1)
    result = tk.sqp(problem, start, minimizer=minimizer)
    assert result.success, result.message
    np.testing.assert_allclose(result.x, [1.0, 0.0], atol=1e-7)
    assert result.multipliers[0] == pytest.approx(-1.5, abs=1e-6)
    assert result.iterations <= 6
    without = tk.sqp(problem, start, minimizer=minimizer, second_order_correction=False)
    assert without.iterations > result.iterations


@pytest.mark.parametrize("minimizer", EXACT)
def test_dependent_constraints(minimizer: str) -> None:
    """The same equality three times, and an inequality that touches it."""
    A = np.array([[1.0, 1.0, 1.0]])
    problem = tk.Problem(n=3)
    problem.minimize(term(lambda a, b, c: [(a - 1) ** 2 + b**2 + (c + 2) ** 2]))
    problem.equal(linear(np.repeat(A, 3, axis=0)), 3.0)
    problem.at_most(linear(2 * A), 6.0)
    result = tk.sqp(problem, np.zeros(3), minimizer=minimizer)
    assert result.success, result.message
    np.testing.assert_allclose(result.x, [7 / 3, 4 / 3, -2 / 3], atol=1e-7)


def test_no_multipliers_exist() -> None:
    """HS 13: its solution (1, 0) is no KKT point; near it, multipliers grow without bound."""
    problem = tk.Problem(n=2, lower=0.0)
    problem.minimize(term(lambda a, b: [(a - 2) ** 2 + b**2]))
    problem.at_least(term(lambda a, b: [(1 - a) ** 3 - b]), 0.0)
    result = tk.sqp(problem, (-2.0, -2.0))
    assert result.constraint_violation <= 1e-8
    np.testing.assert_allclose(result.x, [1.0, 0.0], atol=1e-3 if result.success else 0.02)


@given(seed=seeds, minimizer=st.sampled_from(["augmented_lagrangian", "qp"]))
@settings(max_examples=10)
def test_nonconvex_problems_end_at_kkt_points(seed: int, minimizer: str) -> None:
    """Waves under constraints, from anywhere: the certificate is checked by hand."""
    rng = np.random.default_rng(seed)
    n, w = 4, rng.normal(size=(3, 4))
    problem = tk.Problem(n=n, lower=-3.0, upper=3.0)
    problem.minimize(
        term(lambda *x: [sum(sin(w[0, i] * x[i] + i) * cos(x[i - 1]) for i in range(n))])
    )
    problem.equal(term(lambda *x: [sum(w[1, i] * x[i] for i in range(n)) + sin(x[0] * x[1])]))
    problem.at_most(term(lambda *x: [sum(xi**2 for xi in x)]), 4.0)
    result = tk.sqp(problem, rng.normal(size=n) * 3, minimizer=minimizer)
    assert result.success, result
    assert problem.evaluate(result.x).violation <= 1e-8
    assert kkt_residual(problem, result) < 1.1e-6
    assert np.all(result.multipliers[1:] >= 0)


# --- Infeasible ---------------------------------------------------------------------------------


def contradiction() -> tk.Problem:
    problem = tk.Problem(n=2)
    problem.minimize(term(lambda a, b: [a**2 + b**2]))
    problem.equal(linear([1.0, 1.0], name="one"), 1.0)
    problem.equal(linear([1.0, 1.0], name="other"), 3.0)
    return problem


@pytest.mark.parametrize("minimizer", EXACT)
def test_contradicting_equalities(minimizer: str) -> None:
    result = tk.sqp(contradiction(), (5.0, -3.0), minimizer=minimizer)
    assert (result.success, result.status) == (False, "infeasible")
    named = contradiction().evaluate(result.x).violations
    assert sum(named.values()) == pytest.approx(2.0, abs=1e-6)
    for name, amount in named.items():
        assert (f"{name} by " in result.message) == (amount > 1e-8)
    assert result.iterations < 200


@pytest.mark.parametrize("minimizer", EXACT)
def test_disjoint_regions(minimizer: str) -> None:
    """Two discs four apart: the least sum of violations is between them."""
    problem = tk.Problem(n=2)
    problem.minimize(term(lambda a, b: [b]))
    problem.at_most(term(lambda a, b: [(a + 2) ** 2 + b**2], name="left"), 1.0)
    problem.at_most(term(lambda a, b: [(a - 2) ** 2 + b**2], name="right"), 1.0)
    result = tk.sqp(problem, (3.0, 2.0), minimizer=minimizer)
    assert result.status == "infeasible", result.message
    assert "left by" in result.message
    assert "right by" in result.message
    np.testing.assert_allclose(result.x, 0.0, atol=1e-3)


def test_crossed_bounds() -> None:
    problem = tk.Problem(n=2, lower=(0.0, 1.0), upper=(5.0, -1.0))
    problem.minimize(term(lambda a, b: [a**2]))
    result = tk.sqp(problem, (1.0, 0.5))
    assert (result.status, result.iterations) == ("infeasible", 0)
    assert result.message == "infeasible: crossed bounds of x[1] by 2"
    assert result.constraint_violation == 2.0
    crossed = tk.Problem(n=1)
    crossed.between(linear([1.0], name="place"), 1.0, 0.0)
    result = tk.sqp(crossed, [0.3])
    assert result.status == "infeasible"
    assert "place by" in result.message


def test_out_of_the_bounds() -> None:
    problem = tk.Problem(n=2, lower=-1.0, upper=1.0)
    problem.equal(term(lambda a, b: [exp(a) + b], name="sum"), 10.0)
    result = tk.sqp(problem, (0.0, 0.0))
    assert result.status == "infeasible"
    np.testing.assert_allclose(result.x, 1.0, atol=1e-7)
    assert f"sum by {10 - np.e - 1:.6g}"[:10] in result.message


def test_budgets_end_it() -> None:
    problem = tk.Problem(n=2)
    problem.minimize_squares(term(lambda a, b: [10 * (b - a**2), 1 - a], size=2))
    problem.equal(linear([1.0, 1.0], name="sum"), 3.0)
    none = tk.sqp(problem, (-1.2, 1.0), max_iterations=0)
    assert (none.status, none.iterations) == ("budget", 0)
    assert none.message == "out of budget: violated are sum by 3.2"
    few = tk.sqp(problem, (-1.2, 1.0), max_iterations=3)
    assert (few.status, few.iterations, len(few.trace)) == ("budget", 3, 3)
    assert tk.sqp(problem, (-1.2, 1.0), deadline=0.0).status == "budget"


def test_unbounded_below_is_not_converged() -> None:
    problem = tk.Problem(n=1)
    problem.minimize(linear([1.0]))
    result = tk.sqp(problem, [0.0], max_iterations=100)
    assert result.status == "budget"
    assert np.isfinite(result.x).all()


# --- The run ------------------------------------------------------------------------------------


@pytest.mark.parametrize("minimizer", EXACT)
def test_the_trace_is_algorithm_2(minimizer: str) -> None:
    """Within a penalty, the merit of accepted steps falls, and the region follows the steps."""
    problem = tk.Problem(n=2)
    problem.minimize(term(lambda a, b: [100 * a]))  # so steep that the first penalty is too small
    problem.at_least(term(lambda a, b: [a - b**2, b], size=2), (0.0, 1.0))
    options = {"tau_plus": 1.5, "tau_minus": 0.5, "k": 5.0, "mu0": 2.0, "delta0": 0.25}
    result = tk.sqp(problem, (2.0, 3.0), minimizer=minimizer, **options)
    assert result.success, result.message
    np.testing.assert_allclose(result.x, 1.0, atol=1e-7)
    trace = result.trace
    assert (trace.penalty[0], trace.radius[0]) == (2.0, 0.25)
    assert 10.0 in trace.penalty
    merit = trace.merit
    for i in np.flatnonzero(np.diff(trace.penalty) == 0):
        assert merit[i + 1] <= merit[i] + 1e-9 * abs(merit[i])
        if trace.accepted[i]:
            assert trace.radius[i + 1] == pytest.approx(1.5 * trace.radius[i])
        else:
            assert merit[i + 1] == merit[i]
            assert trace.radius[i + 1] <= trace.radius[i]


def test_it_says_the_same_each_time_from_any_thread() -> None:
    problem, start = maratos(1.0)
    first = tk.sqp(problem, start)
    results: list[tk.SqpResult] = []
    threads = [
        threading.Thread(target=lambda: results.append(tk.sqp(problem, start))) for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 4
    for result in results:
        np.testing.assert_array_equal(result.x, first.x)
        np.testing.assert_array_equal(result.trace.merit, first.trace.merit)


def test_scaling_the_objective_moves_nothing() -> None:
    for weight in (1e-3, 1e3):
        problem = tk.Problem(n=2)
        problem.minimize(term(lambda a, b: [(a - 2) ** 2 + (b - 1) ** 2]), weight=weight)
        problem.at_least(term(lambda a, b: [2 - a - b, b - a**2], size=2), 0.0)
        result = tk.sqp(problem, (2.0, 2.0), optimality_tolerance=1e-10)
        assert result.success, result.message
        np.testing.assert_allclose(result.x, 1.0, atol=1e-6)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"x0": np.zeros(3)}, r"x0: got shape \(3,\), expected \(2,\)"),
        ({"x0": [0.0, np.nan]}, "x0: got nan"),
        ({"minimizer": "best"}, "minimizer: got 'best'"),
        ({"c": 1.0}, "c: got 1"),
        ({"tau_plus": 1.0}, "tau_plus: got 1"),
        ({"tau_minus": 0.0}, "tau_minus: got 0"),
        ({"k": np.nan}, "k: got nan"),
        ({"mu0": 0.0}, "mu0: got 0"),
        ({"mu_max": 1.0}, "mu_max: got 1"),
        ({"delta0": np.inf}, "delta0: got inf"),
        ({"delta_min": -1.0}, "delta_min: got -1"),
        ({"delta_max": 0.1}, "delta_max: got 0.1"),
        ({"step_tolerance": np.nan}, "step_tolerance: got nan"),
        ({"improvement_tolerance": -1.0}, "improvement_tolerance: got -1"),
        ({"constraint_tolerance": 0.0}, "constraint_tolerance: got 0"),
        ({"optimality_tolerance": np.inf}, "optimality_tolerance: got inf"),
        ({"max_iterations": -1}, "max_iterations: got -1"),
        ({"deadline": -1.0}, "deadline: got -1"),
    ],
)
def test_misuse(options: dict, said: str) -> None:
    problem = tk.Problem(n=2)
    with pytest.raises(ValueError, match=said):
        tk.sqp(problem, **{"x0": np.zeros(2), **options})


# --- Robots -------------------------------------------------------------------------------------

ROBOT = tk.robots.thing()
SEED = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
T_GOAL = tk.transform(xyz=(1.2, -0.9, 0.9), rpy=(0.0, np.pi / 2, 0.0))


def whole_body_pose(T_goal: np.ndarray, base: tuple[float, float], radius: float) -> tk.Problem:
    """[M17] (4.34), term by term."""
    problem = tk.Problem(ROBOT)
    problem.minimize(tk.terms.Dexterity())
    problem.equal(tk.terms.Pose(T_goal))
    problem.at_most(tk.terms.BaseDistance(base), radius)
    problem.bound("theta", -np.pi / 4, np.pi / 4)
    return problem


@pytest.mark.parametrize("minimizer", EXACT)
def test_the_whole_body_pose(minimizer: str) -> None:
    """As plan_pose, which eliminates the pose instead; from a seed 1.2 m away."""
    disc = tk.Disc(center=(0.6, 0.6), radius=0.4)
    plan = tk.plan_pose(
        ROBOT, T_GOAL, seed=SEED, base_goal=(0.6, 0.0), base_radius=0.3,
        heading=(-np.pi / 4, np.pi / 4), obstacles=[disc],
    )  # fmt: skip
    problem = whole_body_pose(T_GOAL, (0.6, 0.0), 0.3)
    problem.minimize(tk.terms.SeedDistance(SEED), weight=1e-6)
    problem.at_least(tk.terms.BaseDistance((0.6, 0.6)), 0.4)
    result = tk.sqp(problem, SEED, minimizer=minimizer)
    assert result.success, result.message
    assert result.objective < 1.1 * plan.objective
    position, rotation = np.split(tk.pose_error(ROBOT.fk(result.q), T_GOAL), 2)
    assert np.linalg.norm(position) < 1e-7
    assert np.linalg.norm(rotation) < 1e-7
    base = ROBOT.base_pose(result.q)
    assert np.hypot(*(base[:2] - (0.6, 0.0))) <= 0.3 + 1e-8
    assert np.hypot(*(base[:2] - (0.6, 0.6))) >= 0.4 - 1e-8
    assert abs(base[2]) <= np.pi / 4


@pytest.mark.parametrize("minimizer", ["augmented_lagrangian", "qp"])
def test_from_an_optimum_it_stays(minimizer: str) -> None:
    """Where plan_pose ends, Algorithm 2 finds nothing to do, nor after a push."""
    rng = np.random.default_rng(5)
    for _ in range(5):
        q = SEED + 0.3 * rng.normal(size=9) * (np.arange(9) < 6)
        T = ROBOT.fk(q)
        options = {"base_goal": (0.0, 0.0), "base_radius": 0.5, "heading": (-np.pi / 4, np.pi / 4)}
        plan = tk.plan_pose(ROBOT, T, seed=q, **options)
        assert plan.success
        problem = whole_body_pose(T, (0.0, 0.0), 0.5)
        near = plan.q + 1e-3 * rng.normal(size=9)
        result = tk.sqp(problem, near, minimizer=minimizer)
        assert result.success, result.message
        assert result.objective == pytest.approx(plan.objective, rel=1e-6)
        assert result.iterations < 20


def test_a_pose_out_of_reach() -> None:
    problem = whole_body_pose(tk.transform(xyz=(4.0, 0.0, 0.5)), (0.0, 0.0), 0.3)
    result = tk.sqp(problem, SEED, minimizer="qp")
    assert result.status == "infeasible", result.message
    named = [name for name, by in problem.evaluate(result.x).violations.items() if by > 1e-8]
    assert named
    for name in named[:5]:
        assert f"{name} by " in result.message
