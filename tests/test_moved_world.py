"""Moving the world and everything in it: what the step must not notice.

The exact and the damped inverse are blind to rotations of a task's rows. The selectively damped
one clamps by norms of blocks, which rotate too, but its clamp of single joints sees a rotated base:
there only translations leave it unchanged.
"""

import numpy as np
import pytest
from numpy.typing import NDArray

import thing_kin as tk
from inverse_cases import FILTERS, HOME, INVERSES, ROBOT, SCHEMES, TWO_TASKS, targets

ARM = [
    tk.DH(d=0.1273, alpha=np.pi / 2, joint="revolute"),
    tk.DH(a=-0.612, joint="revolute"),
    tk.DH(a=-0.5723, joint="revolute"),
    tk.DH(d=0.163941, alpha=np.pi / 2, joint="revolute"),
    tk.DH(d=0.1157, alpha=-np.pi / 2, joint="revolute"),
    tk.DH(d=0.0922, joint="prismatic"),
    tk.DH(a=0.2, alpha=0.3, joint="revolute", frame="hand"),
]
ROTATION = [tk.DH(theta=0.7, alpha=-1.1), tk.DH(theta=2.0, alpha=0.4)]
TRANSLATION = [tk.DH(theta=0.9, a=3.0, d=-2.0), tk.DH(theta=-0.9)]
TASKS = (tk.PositionTask(gain=0.5), tk.OrientationTask(), tk.PositionTask(of="frame3"))
LEFT_ALONE = {
    "rotation": (ROTATION, ["exact", "damped"]),
    "translation": (TRANSLATION, list(INVERSES)),
}
CASES = [(move, inverse) for move, (_, inverses) in LEFT_ALONE.items() for inverse in inverses]


def named(rows: list[tk.DH]) -> list[tk.DH]:
    """The same rows, their frames named by their place in the arm."""
    return [
        tk.DH(r.d, r.theta, r.a, r.alpha, r.joint, frame=r.frame or f"frame{i + 1}")
        for i, r in enumerate(rows)
    ]


def shifted(T: NDArray, W: NDArray, task: tk.Task) -> NDArray:
    moved = W @ T
    return moved[:3, :3] if isinstance(task, tk.OrientationTask) else moved[:3, 3]


@pytest.mark.parametrize("singular_value_filter", FILTERS)
@pytest.mark.parametrize(("move", "inverse"), CASES)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_a_chain_of_constant_first_rows(scheme, move, inverse, singular_value_filter) -> None:
    rows = [tk.DH(r.d, r.theta, r.a, r.alpha, frame=f"world{i}")
            for i, r in enumerate(LEFT_ALONE[move][0])]  # fmt: skip
    here, there = tk.Chain.from_dh(named(ARM)), tk.Chain.from_dh(rows + named(ARM))
    W = there.fk(np.zeros(7), frame="world1")
    tasks = TASKS[:2] if scheme == "nakamura" else TASKS
    options = {
        "scheme": scheme,
        "inverse": INVERSES[inverse],
        "singular_value_filter": FILTERS[singular_value_filter],
    }
    for q in np.random.default_rng(7).uniform(-2, 2, (10, 7)):
        goals = [here.fk(q + 0.3, frame=task.of) for task in tasks]
        steps = [
            tk.TaskPriority(chain, tasks, **options).step(
                q, [shifted(T, world, task) for T, task in zip(goals, tasks, strict=True)]
            )
            for chain, world in ((here, np.eye(4)), (there, W))
        ]
        assert np.abs(steps[0]).max() > 1e-3
        bound = 1e-9 * max(1.0, np.abs(steps[0]).max())
        np.testing.assert_allclose(steps[1], steps[0], atol=bound)


@pytest.mark.parametrize("inverse", INVERSES)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_the_base_and_all_targets_translated(scheme: str, inverse: str) -> None:
    shift = np.array([4.0, -3.0, 0.0])
    solver = tk.TaskPriority(ROBOT, TWO_TASKS, scheme=scheme, inverse=INVERSES[inverse])
    T_goal, base_goal = targets(TWO_TASKS, HOME)
    step = solver.step(HOME, [T_goal, base_goal])
    q, T = HOME.copy(), T_goal.copy()
    q[6:8] += shift[:2]
    T[:3, 3] += shift
    np.testing.assert_allclose(solver.step(q, [T, base_goal + shift]), step, atol=1e-12)


@pytest.mark.parametrize("inverse", ["exact", "damped"])
@pytest.mark.parametrize("scheme", SCHEMES)
def test_the_base_and_all_targets_turned(scheme: str, inverse: str) -> None:
    """The base's steps in x and y turn with the world, all others stay."""
    angle = 0.8
    W = tk.transform(rpy=(0, 0, angle))
    solver = tk.TaskPriority(ROBOT, TWO_TASKS, scheme=scheme, inverse=INVERSES[inverse])
    T_goal, base_goal = targets(TWO_TASKS, HOME)
    turn = np.eye(9)
    turn[6:8, 6:8] = W[:2, :2]
    by_angle = angle * np.eye(9)[8]
    step = solver.step(
        turn @ HOME + by_angle, [W @ T_goal, turn[6:, 6:] @ base_goal + by_angle[6:]]
    )
    np.testing.assert_allclose(step, turn @ solver.step(HOME, [T_goal, base_goal]), atol=1e-11)


@pytest.mark.parametrize("inverse", INVERSES)
def test_the_order_of_joints_is_a_convention(inverse: str) -> None:
    goals = targets(TWO_TASKS, HOME)
    step, other = (
        tk.TaskPriority(robot, TWO_TASKS, inverse=INVERSES[inverse]).step(q, goals)
        for robot, q in (
            (ROBOT, HOME),
            (tk.robots.thing(order="base_first"), np.roll(HOME, 3)),
        )
    )
    np.testing.assert_allclose(np.roll(other, -3), step, atol=1e-12)
