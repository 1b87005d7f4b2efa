"""Lower tasks never disturb higher ones: claims about the linear residual A dq - a."""

import numpy as np
import pytest

import thing_kin as tk
from inverse_cases import (
    FILTERS,
    INVERSES,
    OVERFULL_TASKS,
    RANDOM_POSTURES,
    ROBOT,
    SCHEMES,
    SINGULAR_POSTURES,
    THREE_TASKS,
    TWO_TASKS,
    jacobian_of,
    posture,
    targets,
)

POSTURES = {**{f"random {i}": q for i, q in enumerate(RANDOM_POSTURES)}, **SINGULAR_POSTURES}
TASKS = {"two": TWO_TASKS, "three": THREE_TASKS, "overfull": OVERFULL_TASKS}


@pytest.mark.parametrize("step_limit", [None, 0.05, 3.0])
@pytest.mark.parametrize("tasks", TASKS)
@pytest.mark.parametrize("singular_value_filter", FILTERS)
@pytest.mark.parametrize("inverse", INVERSES)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_lower_tasks_leave_the_residual_alone(
    scheme, inverse, singular_value_filter, tasks, step_limit
) -> None:
    tasks = TASKS[tasks]
    if scheme == "nakamura":
        tasks = tasks[:2]
    options = {
        "scheme": scheme,
        "inverse": INVERSES[inverse],
        "singular_value_filter": FILTERS[singular_value_filter],
    }
    whole = tk.TaskPriority(ROBOT, tasks, step_limit=step_limit, **options)
    alone = tk.TaskPriority(ROBOT, tasks[:1], **options)
    worst = {}
    for name, q in POSTURES.items():
        goals = targets(tasks, q)
        A = jacobian_of(tasks[0], q)
        step = whole.solve(q, goals, null_motion=np.linspace(-1, 1, 9))
        change = A @ (step.dq - step.scales[0] * alone.step(q, goals[:1]))
        size = max(1.0, np.linalg.norm(step.dq))
        worst[name] = np.linalg.norm(change) / size
    assert {name: leak for name, leak in worst.items() if not leak < 1e-10} == {}


@pytest.mark.parametrize("singular_value_filter", FILTERS)
@pytest.mark.parametrize("inverse", INVERSES)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_every_level_is_in_the_null_space_of_all_above(
    scheme, inverse, singular_value_filter
) -> None:
    tasks = THREE_TASKS[:2] if scheme == "nakamura" else THREE_TASKS
    solver = tk.TaskPriority(
        ROBOT,
        tasks,
        scheme=scheme,
        inverse=INVERSES[inverse],
        singular_value_filter=FILTERS[singular_value_filter],
    )
    for q in POSTURES.values():
        step = solver.solve(q, targets(tasks, q), null_motion=np.ones(9))
        for high, task in enumerate(tasks):
            lower = step.contributions[high + 1 :]
            moved = np.abs(jacobian_of(task, q) @ lower.T).max(axis=0)
            assert (moved < 1e-10 * np.maximum(1.0, np.linalg.norm(lower, axis=1))).all()


def approach(joint: str) -> list[np.ndarray]:
    return [posture(**{joint: 10.0**-k}) for k in range(1, 13)]


def exact_steps(scheme: str, q: np.ndarray) -> tuple[np.ndarray, float]:
    """The step, and |a|/sigma_min(A) + |b|/sigma_min(B) for its two tasks."""
    solver = tk.TaskPriority(ROBOT, TWO_TASKS, scheme=scheme, inverse=tk.Exact())
    step = solver.solve(q, targets(TWO_TASKS, q))
    parts = zip(TWO_TASKS, step.errors, strict=True)
    return step.dq, sum(
        task.gain * np.linalg.norm(e) / np.linalg.svd(jacobian_of(task, q), compute_uv=False)[-1]
        for task, e in parts
    )


@pytest.mark.parametrize("joint", ["q4", "q2"])
def test_chiaverini_stays_bounded_through_algorithmic_singularities(joint: str) -> None:
    """Each task alone is far from singular; together they are, where the arm is."""
    for q in [*approach(joint), posture(**{joint: 0.0})]:
        dq, bound = exact_steps("chiaverini", q)
        assert np.linalg.norm(dq) <= bound * (1 + 1e-12)
        assert bound < 20.0


@pytest.mark.parametrize("scheme", ["nakamura", "siciliano"])
@pytest.mark.parametrize("joint", ["q4", "q2"])
def test_the_recursions_grow_without_bound_there(scheme: str, joint: str) -> None:
    lengths = [np.linalg.norm(exact_steps(scheme, q)[0]) for q in approach(joint)[2:10]]
    # Ten times nearer is ten times longer, up to 1e10 rad.
    np.testing.assert_allclose(np.divide(lengths[1:], lengths[:-1]), 10.0, rtol=0.05)
    assert lengths[-1] > 1e8


@pytest.mark.parametrize("inverse", INVERSES)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_a_task_said_twice_changes_nothing(scheme: str, inverse: str) -> None:
    """What the first leaves of the second is rounding, and no matrix to be inverted."""
    options = {"scheme": scheme, "inverse": INVERSES[inverse]}
    again = (tk.PoseTask(gain=0.8), tk.PoseTask(gain=0.8))
    part = (tk.PoseTask(gain=0.8), tk.PositionTask())
    for q in RANDOM_POSTURES:
        (T,) = targets(TWO_TASKS[:1], q)
        once = tk.TaskPriority(ROBOT, again[:1], **options).step(q, [T])
        for tasks, goals in ((again, [T, T]), (part, [T, T[:3, 3] + 0.1])):
            step = tk.TaskPriority(ROBOT, tasks, **options).solve(q, goals, np.ones(9))
            np.testing.assert_allclose(step.contributions[:2].sum(axis=0), once, atol=1e-9)
            free = tk.null_space(jacobian_of(again[0], q))
            np.testing.assert_allclose(step.contributions[2], free @ free.T @ np.ones(9), atol=1e-9)
