"""The step limit shortens contributions, lowest priority first, and turns none."""

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import linprog

import thing_kin as tk
from inverse_cases import (
    HOME,
    INVERSES,
    OVERFULL_TASKS,
    RANDOM_POSTURES,
    ROBOT,
    SCHEMES,
    SINGULAR_POSTURES,
    THREE_TASKS,
    TWO_TASKS,
    jacobian_of,
    targets,
)

POSTURES = [*RANDOM_POSTURES[:6], *SINGULAR_POSTURES.values()]
PER_JOINT = np.array([0.1, 0.02, np.inf, 0.3, 0.05, 1.0, 0.04, 0.2, np.inf])
LIMITS = [0.01, 0.1, 1.0, 3.0, PER_JOINT]
ROUNDING = 1e-9  # relative: a joint at its limit has room for what rounding moves it


def steps(scheme: str, inverse: str, limit: float | NDArray[np.float64]):
    tasks = TWO_TASKS if scheme == "nakamura" else THREE_TASKS
    for chosen in (tasks, TWO_TASKS if scheme == "nakamura" else OVERFULL_TASKS):
        options = {"scheme": scheme, "inverse": INVERSES[inverse], "step_limit": limit}
        solver = tk.TaskPriority(ROBOT, chosen, **options)
        free = tk.TaskPriority(ROBOT, chosen, **options | {"step_limit": None})
        for q in POSTURES:
            goals = targets(chosen, q)
            z = np.linspace(-1.0, 1.0, 9)
            yield solver.solve(q, goals, z), free.solve(q, goals, z)


def largest_scale(above: NDArray, contribution: NDArray, limit: NDArray) -> float | None:
    """The largest s in [0, 1] with |above + s contribution| <= limit, as a linear program."""
    room = np.concatenate([limit - above, limit + above])
    slopes = np.concatenate([contribution, -contribution])[:, None]
    finite = np.isfinite(room)
    result = linprog([-1.0], A_ub=slopes[finite], b_ub=room[finite], bounds=[(0.0, 1.0)])
    return None if result.status == 2 else float(result.x[0])


def expected_scales(contributions: NDArray, limit: NDArray) -> list[float]:
    """task_priority.hpp: whole contributions from the highest priority down, as many as leave the
    next one a scale to fit with; then what room is left."""
    for kept in reversed(range(len(contributions))):
        above = contributions[:kept].sum(axis=0)
        scale = largest_scale(above, contributions[kept], limit)
        if scale is not None:
            break
    scales = [1.0] * kept + [scale]
    for contribution in contributions[kept + 1 :]:
        total = np.array(scales) @ contributions[: len(scales)]
        scales.append(largest_scale(total, contribution, limit * (1 + ROUNDING)) or 0.0)
    return scales


@pytest.mark.parametrize("limit", LIMITS, ids=str)
@pytest.mark.parametrize("inverse", INVERSES)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_no_joint_exceeds_it_and_no_level_turns(scheme, inverse, limit) -> None:
    limited = 0
    for step, free in steps(scheme, inverse, limit):
        assert (np.abs(step.dq) <= limit).all()
        np.testing.assert_array_equal(step.contributions, free.contributions)
        assert ((step.scales >= 0) & (step.scales <= 1)).all()
        assert step.limited == (step.scales < 1).any()
        # dq must be this sum to rounding of what is in it, not of what was left out of it.
        terms = step.scales[:, None] * step.contributions
        bound = 1e-12 * max(1.0, np.abs(terms).max())
        np.testing.assert_allclose(step.dq, terms.sum(axis=0), atol=bound)
        if not step.limited:
            np.testing.assert_array_equal(step.dq, free.dq)
        limited += step.limited
    assert limited > 0 or np.min(limit) >= 1.0  # far limits bind for some inverses only


@pytest.mark.parametrize("limit", [0.1, 1.0, PER_JOINT], ids=str)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_the_scales_are_the_documented_ones(scheme, limit) -> None:
    everywhere = np.broadcast_to(limit, 9)
    for step, _ in steps(scheme, "selective", limit):
        reference = expected_scales(step.contributions, everywhere)
        moves = np.abs(step.contributions).max(axis=1) > 1e-9  # the scale of nothing means nothing
        np.testing.assert_allclose(step.scales[moves], np.array(reference)[moves], atol=1e-6)


@pytest.mark.parametrize("limit", [0.01, 0.1, 3.0])
@pytest.mark.parametrize("scheme", SCHEMES)
def test_the_first_task_moves_the_way_it_wanted(scheme: str, limit: float) -> None:
    solver = tk.TaskPriority(ROBOT, TWO_TASKS, scheme=scheme, inverse=tk.Exact(), step_limit=limit)
    for q in POSTURES:
        goals = targets(TWO_TASKS, q)
        step = solver.solve(q, goals)
        wanted = TWO_TASKS[0].gain * step.errors[0]
        A = jacobian_of(TWO_TASKS[0], q)
        if np.linalg.svd(A, compute_uv=False)[-1] < 1e-3:
            continue  # A A^+ a is not a there
        np.testing.assert_allclose(A @ step.dq, step.scales[0] * wanted, atol=1e-10)
        assert step.scales[0] > 0


def test_a_limit_out_of_reach_changes_nothing() -> None:
    goals = targets(TWO_TASKS, HOME)
    free = tk.TaskPriority(ROBOT, TWO_TASKS).step(HOME, goals)
    for limit in (100.0, np.inf, np.full(9, np.inf), np.abs(free).max()):
        limited = tk.TaskPriority(ROBOT, TWO_TASKS, step_limit=limit).solve(HOME, goals)
        np.testing.assert_array_equal(limited.dq, free)
        assert not limited.limited


@pytest.mark.parametrize("limit", [0.0, -0.1, np.nan, np.zeros(9), np.full(3, 0.1), np.eye(9)])
def test_what_is_no_limit_is_refused(limit) -> None:
    with pytest.raises(ValueError, match=r"^step_limit: got .*, expected"):
        tk.TaskPriority(ROBOT, TWO_TASKS, step_limit=limit)
