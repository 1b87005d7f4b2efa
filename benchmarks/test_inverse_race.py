"""The race itself: its judge, and that every solver that is installed still answers rightly."""

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import inverse_tables
import step_race
from figures import Figures
from inverse import Solver, gather
from inverse.contest import AbsentError, Contender, race
from inverse.field import ROBOTS, Course, course
from inverse.results import figures
from inverse_plot import draw

PEERS = Path("build/peers")
COUNT = 6


@pytest.fixture(scope="module", params=["ur10", "gen3", "thing"])
def small_course(request: pytest.FixtureRequest, tmp_path_factory: Any) -> Course:
    return course(request.param, COUNT, tmp_path_factory.mktemp(request.param))


@pytest.mark.parametrize("robot", ROBOTS)
def test_a_judge_accepts_what_the_targets_were_made_of(robot: str, tmp_path: Path) -> None:
    chain, laid = ROBOTS[robot][1](), course(robot, COUNT, tmp_path)
    for q, T in zip(chain.random(COUNT, rng=0), laid.targets, strict=True):
        assert laid.judge.is_right(q, T)
        near = np.array(q)
        near[-1] += 2e-5
        assert not laid.judge.is_right(near, T)
        assert not laid.judge.is_right(np.full(chain.n, np.nan), T)
        assert not laid.judge.is_right(None, T)


def test_a_judge_refuses_what_is_beyond_a_limit(tmp_path: Path) -> None:
    laid = course("panda", 1, tmp_path)
    q = np.array(laid.arm.upper)
    assert laid.judge.is_right(q, laid.judge.fk(q).homogeneous)
    q[3] += 2e-6
    assert not laid.judge.is_right(q, laid.judge.fk(q).homogeneous)


def test_a_judge_knows_no_limit_of_a_continuous_joint(tmp_path: Path) -> None:
    laid = course("gen3", 1, tmp_path)
    q = np.zeros(7)
    q[0] = 100.0
    assert laid.judge.is_right(q, laid.judge.fk(q).homogeneous)


def contender_of(solver: type[Solver]) -> Contender:
    python = PEERS / solver.environment / "bin" / "python"
    own = solver.environment and python.exists()
    try:
        return Contender(solver, str(python) if own else sys.executable)
    except AbsentError:
        pytest.skip("not installed")


@pytest.mark.parametrize("name", gather())
def test_a_solver_answers_rightly_or_says_that_it_failed(name: str, small_course: Course) -> None:
    solver = gather()[name]
    if not solver.can(small_course.arm):
        pytest.skip("not made for this arm")
    contender = contender_of(solver)
    try:
        (answers,) = race(small_course, [contender], 20.0).values()
    finally:
        contender.close()
    result = figures(small_course, answers)
    assert result["count"] == COUNT
    assert result["wrong_claims"] == result["unclaimed"] == 0.0
    assert result["success"] > 60.0  # TRAC-IK's milliseconds depend on the machine's load
    assert 0.0 < result["cpu_median"] <= result["cpu_p99"]


@pytest.mark.parametrize("name", gather("steps"))
def test_a_step_keeps_the_limits_and_brings_the_hand_nearer(name: str, tmp_path: Path) -> None:
    laid, starts = step_race.laid_out(40, tmp_path)
    contender = contender_of(gather("steps")[name])
    try:
        (answers,) = race(laid, [contender], 20.0).values()
    finally:
        contender.close()
    result = step_race.figures(laid, starts, answers)
    assert result["kept"] == 100.0
    assert result["left"] < 20.0  # per cent, of a tenth of a radian or a meter a joint


def test_figures_become_tables_and_a_plot(tmp_path: Path) -> None:
    times = {f"{c}_{x}": 1e-3 for c in ("cpu", "wall") for x in ("median", "mean", "p99")}
    shares = {"success": 99.5, "claimed": 100.0, "wrong_claims": 0.5, "unclaimed": 0.0}
    about = {"robot": "ur5", "solver": "rtb", "title": "RTB LM", "count": 200}
    result = {**about, **shares, **times, "curve": [[1e-4, 50.0], [1e-3, 99.5]]}
    content = {
        "machine": {"cpu": "some processor"},
        "robots": {"ur5": "UR5, 6 joints", "ur10": "UR10, 6 joints"},
        "solvers": {"rtb": {"title": "RTB LM", "note": "as it is", "rtb": "1.5", "python": "3"}},
        "results": [result],
    }
    (tmp_path / inverse_tables.FILE).write_text(json.dumps(content))
    made = Figures(tmp_path)
    rows = inverse_tables.inverse(made).splitlines()
    assert rows[0] == "|  | UR5 | UR10 |"
    assert rows[2] == "| RTB LM | 99.50 %, 1 ms / 1 ms / 1 ms | \N{EN DASH} |"
    claims = inverse_tables.inverse_claims(made).splitlines()[2]
    assert claims == "| RTB LM | 200 | 99.50 % | 100 % | 0.50 % | 0 % | 1 ms | 1.00 |"
    assert inverse_tables.inverse_setup(made).splitlines()[2] == "| RTB LM | rtb 1.5 | as it is |"
    steps = {**about, **times, "note": "one", "kept": 100.0, "left": 5.126, "left_mean": 6.0}
    (tmp_path / inverse_tables.STEPS).write_text(json.dumps({"results": [steps]}))
    row = inverse_tables.inverse_steps(made).splitlines()[2]
    assert row == "| RTB LM: one | 1 ms / 1 ms / 1 ms | 100 % | 5.13 %, 6.0 % |"
    draw(content, tmp_path / "plot.png")
    assert (tmp_path / "plot.png").stat().st_size > 10_000
