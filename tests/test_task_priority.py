"""TaskPriority against [M17] (4.16), (4.17) and the Siciliano recursion in plain numpy."""

from functools import partial

import numpy as np
import pytest

import thing_kin as tk
from inverse_cases import (
    FILTERS,
    HOME,
    INVERSES,
    OVERFULL_TASKS,
    RANDOM_POSTURES,
    ROBOT,
    SCHEMES,
    THREE_TASKS,
    TWO_TASKS,
    jacobian_of,
    level_of,
    target_of,
    targets,
)
from inverse_oracles import apply_inverse, projectors, recursive_step, robust_step

ORACLES = {"nakamura": recursive_step, "siciliano": recursive_step, "chiaverini": robust_step}


def solver(tasks, scheme="chiaverini", inverse="exact", singular_value_filter="plain", **options):
    return tk.TaskPriority(
        ROBOT,
        tasks,
        scheme=scheme,
        inverse=INVERSES[inverse],
        singular_value_filter=FILTERS[singular_value_filter],
        **options,
    )


@pytest.mark.parametrize("singular_value_filter", FILTERS)
@pytest.mark.parametrize("inverse", INVERSES)
@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("tasks", [TWO_TASKS[:1], TWO_TASKS, THREE_TASKS], ids=len)
def test_the_step_is_the_equation(tasks, scheme, inverse, singular_value_filter) -> None:
    if scheme == "nakamura" and len(tasks) > 2:
        pytest.skip("(4.16) is about two tasks")
    it = solver(tasks, scheme, inverse, singular_value_filter)
    invert = partial(invert_by, INVERSES[inverse], FILTERS[singular_value_filter])
    for q in RANDOM_POSTURES:
        goals = targets(tasks, q)
        levels = [level_of(*case) for case in zip(tasks, [q] * 3, goals, strict=False)]
        reference = ORACLES[scheme](levels, invert)
        # The postures are far from singular, so that rounding is amplified by 1e4 at most.
        bound = 1e-9 * max(1.0, np.abs(reference).max())
        np.testing.assert_allclose(it.step(q, goals), reference, atol=bound)


def invert_by(inverse, singular_value_filter, A, e, blocks):
    return apply_inverse(inverse, A, e, blocks, singular_value_filter)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_null_motion_is_projected_onto_what_the_tasks_leave(scheme: str) -> None:
    z = np.linspace(-1.0, 1.0, 9)
    for q in RANDOM_POSTURES:
        task, goal = TWO_TASKS[0], targets(TWO_TASKS, q)[0]
        free = projectors([level_of(task, q, goal)])[1] @ z
        assert np.linalg.norm(free) > 1e-2
        step = solver([task], scheme, "damped").solve(q, [goal], null_motion=z)
        np.testing.assert_allclose(step.contributions[1], free, atol=1e-12)
        np.testing.assert_allclose(jacobian_of(task, q) @ step.contributions[1], 0, atol=1e-12)
        assert step.errors[1].shape == step.singular_values[1].shape == (0,)


def test_null_motion_has_no_say_where_the_tasks_need_every_joint() -> None:
    goals = targets(OVERFULL_TASKS, HOME)
    it = solver(OVERFULL_TASKS, "siciliano")
    np.testing.assert_array_equal(it.step(HOME, goals), it.step(HOME, goals, np.ones(9)))


@pytest.mark.parametrize("inverse", INVERSES)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_compatible_tasks_are_all_met(scheme: str, inverse: str) -> None:
    q = HOME
    goals = [target_of(task, HOME + 0.15) for task in TWO_TASKS]
    it = solver(TWO_TASKS, scheme, inverse)
    for _ in range(200):
        q = q + it.step(q, goals)
    errors = it.solve(q, goals).errors
    assert np.linalg.norm(errors[0]) < 1e-9
    assert np.linalg.norm(errors[1]) < 1e-6


@pytest.mark.parametrize("singular_value_filter", FILTERS)
@pytest.mark.parametrize("inverse", INVERSES)
def test_the_hand_settles_where_the_base_cannot(inverse: str, singular_value_filter: str) -> None:
    """The erratum to (4.15)-(4.18): with I - J# J the hand would rest 1 to 3 mm off."""
    q = ROBOT.random(rng=3)
    goals = [ROBOT.fk(q + 0.2), np.array([0.3, -0.1, 0.2])]
    it = solver(TWO_TASKS, "chiaverini", inverse, singular_value_filter)
    for _ in range(300):
        q = q + it.step(q, goals)
    hand, base = it.solve(q, goals).errors
    assert np.linalg.norm(hand) < 1e-9
    assert np.linalg.norm(base) > 0.05


def test_the_step_explains_itself() -> None:
    q, tasks = RANDOM_POSTURES[0], THREE_TASKS
    goals = targets(tasks, q)
    for scheme in ("siciliano", "chiaverini"):
        it = solver(tasks, scheme)
        step = it.solve(q, goals, np.ones(9))
        np.testing.assert_array_equal(step.dq, it.step(q, goals, np.ones(9)))
        np.testing.assert_allclose(step.contributions.sum(axis=0), step.dq, atol=1e-14)
        np.testing.assert_array_equal(step.scales, np.ones(4))
        assert not step.limited
        Ns = projectors([level_of(*case) for case in zip(tasks, [q] * 3, goals, strict=True)])
        for i, (task, sigma) in enumerate(zip(tasks, step.singular_values, strict=False)):
            J = jacobian_of(task, q)
            inverted = J if scheme == "chiaverini" else J @ Ns[i]
            reference = np.linalg.svd(inverted, compute_uv=False)
            np.testing.assert_allclose(sigma, reference[: len(sigma)], atol=1e-12)


def test_defaults() -> None:
    q, goals = HOME, targets(TWO_TASKS, HOME)
    plain = tk.TaskPriority(ROBOT, TWO_TASKS)
    same = tk.TaskPriority(
        ROBOT, TWO_TASKS, scheme="chiaverini", inverse=tk.SelectivelyDamped(np.pi / 4)
    )
    np.testing.assert_array_equal(plain.step(q, goals), same.step(q, goals))
    assert plain.scheme == "chiaverini"
    assert plain.robot == ROBOT


@pytest.mark.parametrize(("scheme", "most"), [("nakamura", 2), ("siciliano", 16)])
def test_the_number_of_tasks_is_bounded(scheme: str, most: int) -> None:
    tk.TaskPriority(ROBOT, [tk.PositionTask()] * most, scheme=scheme)
    for count in (0, most + 1):
        with pytest.raises(ValueError, match=rf"^tasks: got {count} tasks, expected 1 to {most}"):
            tk.TaskPriority(ROBOT, [tk.PositionTask()] * count, scheme=scheme)


def test_what_does_not_fit_is_refused() -> None:
    with pytest.raises(ValueError, match=r"^scheme: got 'x', expected 'nakamura', "):
        tk.TaskPriority(ROBOT, TWO_TASKS, scheme="x")
    with pytest.raises(ValueError, match=r"^tasks: got BaseTask for 'ur5', expected .*base"):
        tk.TaskPriority(tk.robots.ur5(), TWO_TASKS)
    with pytest.raises(ValueError, match=r"^(tasks|of)\b.*: got 'nope', expected one of"):
        tk.TaskPriority(ROBOT, [tk.PoseTask(of="nope")])
    with pytest.raises(ValueError, match=r"^damping: got -1, expected a finite number >= 0"):
        tk.Damped(-1.0)
