"""The race of (4.34): its instances, its judge, and that every solver that is there still works."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import pose_tables
from figures import Figures
from path import course
from path.casadi_ipopt import CasadiIpopt
from path.ours import solve
from pose import Outside, gather
from pose.functions import Functions
from pose.instances import ARM_LIMITS, STARTS, draw
from pose.judge import Judge
from pose_race import best_known, figures, race

COUNT = 4
JUDGE = Judge()


@pytest.mark.parametrize("limits", ARM_LIMITS)
def test_every_instance_has_a_solution_near_its_near_start(limits: str) -> None:
    for x in draw(50, limits, "near", 1):
        assert (x.seed >= x.lower).all()
        assert (x.seed <= x.upper).all()
        assert JUDGE.violation(x, x.seed) < 1.5
    assert JUDGE.violation(x, np.full(9, np.nan)) == np.inf


def test_both_starts_are_of_the_same_instances_and_a_seed_draws_them_again() -> None:
    near, far = (draw(5, "pi", start, 7) for start in STARTS)
    again, other = draw(5, "pi", "near", 7), draw(5, "pi", "near", 8)
    for a, b, c, d in zip(near, far, again, other, strict=True):
        np.testing.assert_array_equal(a.T, b.T)
        assert a.goal == b.goal
        np.testing.assert_array_equal(a.seed, c.seed)
        assert np.abs(a.T - d.T).max() > 1e-3


def test_the_judge_sees_each_violation() -> None:
    x = draw(1, "2pi", "near", 2)[0]
    q = np.array([0.3, -1.2, 1.4, -0.6, 1.2, 0.4, 0.1, 0.2, 0.5])
    x = replace(x, T=x.robot.fk(q), goal=(0.1, 0.2), heading=(0.4, 0.6))
    x = replace(x, obstacle=type(x.obstacle)(center=(5.0, 5.0), radius=0.1))
    assert JUDGE.is_feasible(x, q)
    np.testing.assert_allclose(JUDGE.objective(q), x.robot.dexterity(q), rtol=1e-9)
    near = type(x.obstacle)(center=(0.1, 0.25), radius=0.1)
    wrong = {
        "hand": replace(x, T=x.robot.fk(q + 2e-5)),
        "goal": replace(x, goal=(0.1, 0.2 + x.radius + 2e-5)),
        "heading": replace(x, heading=(0.5 + 2e-5, 0.6)),
        "obstacle": replace(x, obstacle=near),
    }
    for name, instance in wrong.items():
        assert not JUDGE.is_feasible(instance, q), name


def test_the_functions_have_right_derivatives() -> None:
    x = draw(1, "pi", "far", 3)[0]
    f, q, h = Functions(x), x.seed, 1e-6
    for value, derivative in (
        (f.objective, f.gradient),
        (f.pose, f.pose_jacobian),
        (f.room, f.room_jacobian),
    ):
        steps = h * np.eye(9)
        slope = np.stack([(np.asarray(value(q + d)) - value(q - d)) / (2 * h) for d in steps], -1)
        np.testing.assert_allclose(derivative(q), slope, atol=1e-6)


@pytest.mark.parametrize("name", gather())
def test_a_solver_solves_near_starts(name: str) -> None:
    instances = draw(COUNT, "2pi", "near", 4)
    try:
        solver = gather()[name](instances)
    except (ImportError, FileNotFoundError):
        pytest.skip("not installed")
    answers = race([solver], COUNT)[name] if not isinstance(solver, Outside) else solver.all()
    best = best_known(instances, {name: answers}, JUDGE, 2)
    result = figures(instances, answers, JUDGE, best)
    assert result["success"] >= 75.0
    assert result["wrong_claims"] == 0.0
    assert result["over_best"] >= 1.0
    assert 0.0 < result["cpu_median"] <= result["cpu_p99"]


def test_the_path_of_both_is_the_same_optimum() -> None:
    pytest.importorskip("casadi")
    problem = course(20)
    ours, theirs = solve(problem)[0], CasadiIpopt(problem).solve()[0]
    assert problem.violation(ours) < 1e-9
    assert problem.objective(ours) < 1.02 * problem.objective(theirs)


def test_figures_become_tables(tmp_path: Path) -> None:
    shares = {"success": 99.5, "claimed": 100.0, "wrong_claims": 0.5, "best": 15.0}
    times = {"cpu_median": 1e-4, "cpu_p99": 1e-3, "over_best": 1.1, "count": 200}
    result = {"solver": "scipy", "limits": "pi", "start": "far", **shares, **times}
    solvers = {"scipy": {"title": "SciPy SLSQP", "note": "as it is", "scipy": "1.17"}}
    content = {"solvers": solvers, "results": [result]}
    (tmp_path / pose_tables.FILE).write_text(json.dumps(content))
    made = Figures(tmp_path)
    rows = pose_tables.pose(made).splitlines()
    assert rows[0] == "|  | far start, arm ±pi |"
    assert rows[2] == "| SciPy SLSQP | 99.50 %, best 15.00 %, 100 µs / 1 ms |"
    claims = pose_tables.pose_claims(made).splitlines()[2]
    assert claims == "| SciPy SLSQP | 200 | 99.50 % | 100 % | 0.50 % | 1.100 |"
    assert pose_tables.pose_setup(made).splitlines()[2] == "| SciPy SLSQP | scipy 1.17 | as it is |"
    row = {"title": "a", "count": 50, "objective": 0.1, "violation": 1e-9, "iterations": 7}
    row["cpu_median"] = 6e-3
    (tmp_path / pose_tables.PATHS).write_text(json.dumps({"results": [row]}))
    line = pose_tables.pose_paths(made).splitlines()[2]
    assert line == "| a, 50 waypoints | 0.100000 | 1.0e-09 | 7 | 6 ms |"
