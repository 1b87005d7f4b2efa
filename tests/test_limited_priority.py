"""Bounded least squares in strict order: against a QP solver, and what must never change."""

import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import thing_kin as tk
from inverse_cases import (
    HOME,
    OVERFULL_TASKS,
    RANDOM_POSTURES,
    ROBOT,
    SINGULAR_POSTURES,
    THREE_TASKS,
    TWO_TASKS,
    jacobian_of,
    targets,
)
from limits_oracle import hierarchy, levels_of

DT = 0.01
THING = ROBOT.with_limits(
    velocity_limits=np.where(np.isfinite(ROBOT.velocity_limits), ROBOT.velocity_limits, 1.0)
)
TASKS = {
    "two": TWO_TASKS,
    "three": THREE_TASKS,
    "overfull": OVERFULL_TASKS,
    "posture": (tk.PositionTask(), tk.PostureTask(gain=0.3)),
    "twice": (tk.PositionTask(), tk.PositionTask(), tk.PoseTask(), tk.BaseTask()),
}


def box(robot: tk.Chain, q: np.ndarray, dt: float) -> tuple[np.ndarray, np.ndarray]:
    reach = robot.velocity_limits * dt
    return np.maximum(robot.lower - q, -reach), np.minimum(robot.upper - q, reach)


def random_case(rng: np.random.Generator, tasks, distance: float) -> tuple[np.ndarray, list]:
    q = rng.uniform(THING.lower, THING.upper)
    at = rng.uniform(size=9) < 0.15
    q[at] = np.where(rng.uniform(size=9) < 0.5, THING.lower, THING.upper)[at]
    return q, targets(tasks, q, int(rng.integers(1 << 30)), distance)


@pytest.mark.parametrize("damping", [0.0, 1e-4])
@pytest.mark.parametrize("distance", [0.003, 0.02, 0.5])
@pytest.mark.parametrize("tasks", TASKS)
def test_against_a_cascade_of_quadratic_programs(tasks, distance: float, damping: float) -> None:
    tasks = TASKS[tasks]
    rng = np.random.default_rng(7)
    inverse = tk.Damped(damping) if damping else tk.Exact()
    solver = tk.TaskPriority(THING, tasks, limits=True, dt=DT, inverse=inverse)
    for _ in range(25):
        q, goals = random_case(rng, tasks, distance)
        wish = rng.uniform(-1, 1, 9) * 0.01
        levels = levels_of(tasks, q, goals)
        theirs = hierarchy(*box(THING, q, DT), levels, wish, damping)
        step = solver.solve(q, goals, wish)
        assert step.status == "optimal"
        # Each level in turn; a level with damping does not minimize its own residual alone.
        for A, b in levels:
            assert np.linalg.norm(A @ (step.dq - theirs)) < 1e-7, (A @ step.dq - b, A @ theirs - b)
        np.testing.assert_allclose(step.dq, theirs, atol=1e-5)


@pytest.mark.parametrize("inverse", [tk.Exact(), tk.Damped(1e-4), tk.Damped(1e-2)], ids=repr)
@pytest.mark.parametrize("tasks", TASKS)
def test_within_all_limits_it_is_the_recursion(tasks, inverse) -> None:
    tasks = TASKS[tasks]
    options = {"scheme": "siciliano", "inverse": inverse}
    limited = tk.TaskPriority(ROBOT, tasks, limits=True, dt=1e6, **options)
    free = tk.TaskPriority(ROBOT, tasks, **options)
    rng = np.random.default_rng(3)
    for q in RANDOM_POSTURES * 0.4:
        goals = targets(tasks, q, int(rng.integers(100)), 0.05)
        expected = free.step(q, goals, np.ones(9))
        step = limited.solve(q, goals, np.ones(9))
        if np.all((q + expected <= ROBOT.upper) & (q + expected >= ROBOT.lower)):
            np.testing.assert_allclose(step.dq, expected, atol=1e-9 * max(1, abs(expected).max()))
            assert step.iterations == 0


class Solvers:
    """Of the first task, the first two, ..."""

    def __init__(self, tasks, **options: object) -> None:
        self.tasks = tasks
        self.of_first = [
            tk.TaskPriority(THING, tasks[: k + 1], limits=True, dt=DT, **options)
            for k in range(len(tasks))
        ]


def check_steps(solvers: Solvers, cases) -> None:
    """Limits hold to the last bit, and no level changes what those above it have reached."""
    *parts, last = solvers.of_first
    for q, goals in cases:
        whole = last.solve(q, goals)
        size = max(1.0, np.linalg.norm(whole.dq))
        assert np.isfinite(whole.dq).all()
        assert (q + whole.dq <= np.maximum(THING.upper, q)).all()
        assert (q + whole.dq >= np.minimum(THING.lower, q)).all()
        assert (np.abs(whole.dq) <= THING.velocity_limits * DT).all()
        for k, part in enumerate(parts):
            alone = part.solve(q, goals[: k + 1])
            A = jacobian_of(solvers.tasks[k], q)
            assert np.linalg.norm(A @ (whole.dq - alone.dq)) <= 1e-9 * size


@pytest.mark.parametrize(
    "options",
    [
        {"inverse": tk.Exact()},
        {},
        {"singular_value_filter": tk.SingularValueFilter(0.01, 10.0)},
        {"inverse": tk.Exact(), "singular_value_filter": tk.SingularValueFilter(0.01, 10.0)},
    ],
    ids=["exact", "damped", "damped, filtered", "filtered"],
)
@pytest.mark.parametrize("tasks", TASKS)
def test_lower_levels_change_nothing_above(tasks, options: dict) -> None:
    tasks = TASKS[tasks]
    rng = np.random.default_rng(11)
    cases = [random_case(rng, tasks, d) for d in (1e-3, 0.02, 0.5, 3.0) for _ in range(25)]
    cases += [(q, targets(tasks, q, 1, 0.3)) for q in SINGULAR_POSTURES.values()]
    check_steps(Solvers(tasks, **options), cases)


@settings(max_examples=100, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    tasks=st.sampled_from(sorted(TASKS)),
    distance=st.sampled_from([1e-6, 1e-3, 0.02, 1.0, 10.0]),
    gain=st.sampled_from([1e-6, 1.0, 1e6]),
)
def test_any_step(seed: int, tasks: str, distance: float, gain: float) -> None:
    rng = np.random.default_rng(seed)
    scaled = [
        type(task)(gain=gain) if isinstance(task, tk.PostureTask | tk.BaseTask) else task
        for task in TASKS[tasks]
    ]
    check_steps(Solvers(scaled), [random_case(rng, scaled, distance)])


@pytest.mark.parametrize("size", [1e6, 1e100, 1e300])
def test_targets_as_far_as_can_be(size: float) -> None:
    tasks = [tk.PoseTask(gain=1e6), tk.BaseTask(gain=1e6)]
    goals = [tk.transform(xyz=(size, 0, 0)), [size, -size, 0.0]]
    for robot, dt in ((THING, DT), (ROBOT, 1e3)):
        step = tk.TaskPriority(robot, tasks, limits=True, dt=dt).solve(HOME, goals)
        assert np.isfinite(step.dq).all()
        assert (HOME + step.dq <= robot.upper).all()
        assert (HOME + step.dq >= robot.lower).all()


def test_all_bounds_active() -> None:
    far = HOME + 3 * np.array([1, -1, 1, -1, 1, -1, 1, -1, 1])
    solver = tk.TaskPriority(THING, [tk.PostureTask(), tk.PoseTask()], limits=True, dt=DT)
    step = solver.solve(HOME, [far, ROBOT.fk(HOME)])
    np.testing.assert_array_equal(step.dq, np.sign(far - HOME) * THING.velocity_limits * DT)
    assert (step.active_limits != 0).all()


def test_what_a_step_explains() -> None:
    tasks = [tk.PoseTask(gain=0.5), tk.BaseObstacleTask(0.5), tk.BaseTask()]
    solver = tk.TaskPriority(THING, tasks, limits=True, dt=DT)
    goals = [
        ROBOT.fk(HOME + 0.05),
        HOME[6:8] + np.array([0.502, 0.0]),
        HOME[6:] + np.array([0.1, 0, 0]),
    ]
    step = solver.solve(HOME, goals)
    A, b = levels_of(tasks[:1], HOME, goals[:1])[0]
    np.testing.assert_allclose(step.residuals[0], A @ step.dq - b, atol=1e-13)
    np.testing.assert_allclose(step.errors[0] * 0.5, b, atol=1e-13)
    assert [len(active) for active in step.active_intervals] == [0, 1, 0]
    assert step.status == "optimal"
    assert step.iterations >= 1
    assert "optimal" in repr(step)
    np.testing.assert_array_equal(solver.step(HOME, goals), step.dq)


def test_four_threads_step_as_one() -> None:
    rng = np.random.default_rng(5)
    cases = [random_case(rng, THREE_TASKS, 0.1) for _ in range(200)]
    shared = tk.TaskPriority(THING, THREE_TASKS, limits=True, dt=DT)
    serial = np.array([shared.step(*case) for case in cases])
    together = threading.Barrier(4)

    def run(_: int) -> np.ndarray:
        together.wait()
        return np.array([shared.step(*case) for case in cases])

    with ThreadPoolExecutor(4) as pool:
        for steps in pool.map(run, range(4)):
            assert steps.tobytes() == serial.tobytes()
