"""Pseudoinverse and task-priority step; also what regularization costs, where no peer does it."""

from itertools import cycle
from typing import Any

import numpy as np
import pytest
from pytest_benchmark.fixture import BenchmarkFixture

import thing_kin as tk
from peers import Peer
from racing import PROBLEM, contenders, race

FILTER = tk.SingularValueFilter(sigma0=0.01, nu=10.0)


@contenders("pinv")
def test_pinv(benchmark: BenchmarkFixture, peer: Peer) -> None:
    race(benchmark, peer, "pinv")


@contenders("step")
def test_step(benchmark: BenchmarkFixture, peer: Peer) -> None:
    race(benchmark, peer, "step")


@pytest.mark.benchmark(group="step, regularized")
@pytest.mark.parametrize("scheme", ["nakamura", "siciliano", "chiaverini"])
@pytest.mark.parametrize(
    "inverse", [tk.Exact(), tk.Damped(1e-3), tk.SelectivelyDamped()], ids=lambda i: type(i).__name__
)
def test_regularized_step(benchmark: BenchmarkFixture, scheme: str, inverse: Any) -> None:
    solver = tk.TaskPriority(
        PROBLEM.robot,
        [tk.PoseTask(), tk.BaseTask()],
        scheme=scheme,
        inverse=inverse,
        singular_value_filter=FILTER,
    )
    turns = cycle([(q, (T_goal, base)) for q, T_goal, base in PROBLEM.inputs["step"]])
    step = benchmark(lambda: solver.step(*next(turns)))
    assert step.shape == (9,)
    assert 0.0 < np.abs(step).max() < 10.0  # goals two centimeters away, the filter's floor 0.01


@pytest.mark.benchmark(group="step, limited")
@pytest.mark.parametrize("dt", [0.002, 0.02, 0.2])
def test_limited_step(benchmark: BenchmarkFixture, dt: float) -> None:
    """Hand, base and posture: nearly always, sometimes and hardly ever at a velocity limit."""
    tasks = [tk.PoseTask(), tk.BaseTask(), tk.PostureTask()]
    solver = tk.TaskPriority(PROBLEM.robot, tasks, limits=True, dt=dt)
    turns = cycle([(q, (T_goal, base, q)) for q, T_goal, base in PROBLEM.inputs["step"]])
    step = benchmark(lambda: solver.step(*next(turns)))
    assert (np.abs(step) <= PROBLEM.robot.velocity_limits * dt).all()
