"""Random limited steps in numbers: limits kept, priorities strict, optima those of a QP solver.

python tests/soak_limits.py [count] [seed]      100 000 steps by default; 2 000 are in the test run
"""

import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

import thing_kin as tk
from inverse_cases import HOME, ROBOT, jacobian_of, target_of
from limits_oracle import NoAnswerError, hierarchy, levels_of

Vector = NDArray[np.float64]

DT = 0.01
THING = ROBOT.with_limits(
    velocity_limits=np.where(np.isfinite(ROBOT.velocity_limits), ROBOT.velocity_limits, 1.0),
    acceleration_limits=np.where(
        np.isfinite(ROBOT.acceleration_limits), ROBOT.acceleration_limits, 3.0
    ),
)
STACKS: list[list[tk.Task]] = [
    [tk.PoseTask(), tk.BaseTask(gain=0.5)],
    [tk.PoseTask(), tk.BaseTask(), tk.PostureTask(gain=0.1)],
    [tk.PositionTask(), tk.OrientationTask(), tk.BaseTask(), tk.PostureTask()],
    [tk.BaseTask(), tk.PoseTask(), tk.PositionTask(of="wrist_1")],
    [tk.PositionTask(), tk.PositionTask(), tk.PoseTask(), tk.PoseTask()],
    [tk.PostureTask(), tk.PoseTask()],
]
INVERSES = [tk.Exact(), tk.Damped(1e-4), tk.Damped(1e-2)]
WHEELS = [None, tk.WheelLimits(radius=0.1, k=0.6, speed=6.0)]
FILTERS = [None, tk.SingularValueFilter(0.01, 10.0)]


@dataclass
class Case:
    tasks: Sequence[tk.Task]
    q: Vector
    targets: list[Vector]
    inverse: object
    filtered: bool
    wheels: bool
    previous: Vector | None


@dataclass
class Report:
    """The worst of everything."""

    violation: float = 0.0
    leak: float = 0.0  # over max(1, |dq|)
    oracle: float = 0.0  # largest difference of a level
    differing: int = 0  # by more than 1e-8: theirs gives way by 1e-11, which may be much
    compared: int = 0
    unanswered: int = 0
    limited: int = 0
    iterations: int = 0
    status: Counter = field(default_factory=Counter)


def random_posture(rng: np.random.Generator) -> Vector:
    """Anywhere, near a singularity, at limits, a little outside of them."""
    q = rng.uniform(THING.lower, THING.upper)
    if rng.uniform() < 0.5:
        q = HOME + rng.uniform(-0.5, 0.5, 9)
    if rng.uniform() < 0.2:
        q[rng.choice([2, 4])] = rng.choice([0.0, 1e-3, 1e-6, 1e-9, 1e-12])
    at = rng.uniform(size=9) < rng.choice([0.0, 0.2])
    q[at] = np.where(rng.uniform(size=9) < 0.5, THING.lower, THING.upper)[at]
    if rng.uniform() < 0.05:
        q[rng.integers(9)] *= 1.2
    return q


def random_case(rng: np.random.Generator) -> Case:
    tasks = STACKS[rng.integers(len(STACKS))]
    q = random_posture(rng)
    distance = rng.choice([0.0, 1e-4, 0.01, 0.03, 0.3, 3.0])
    targets = [target_of(task, q + distance * rng.uniform(-1, 1, 9)) for task in tasks]
    previous = None
    if rng.uniform() < 0.3:
        previous = rng.uniform(-1, 1, 9) * THING.velocity_limits * DT
    inverse = INVERSES[rng.integers(len(INVERSES))]
    return Case(tasks, q, targets, inverse, rng.uniform() < 0.1, rng.uniform() < 0.2, previous)


def solver_of(case: Case, levels: int) -> tk.TaskPriority:
    key = (tuple(map(id, case.tasks)), levels, case.inverse, case.filtered, case.wheels)
    if key not in SOLVERS:
        SOLVERS[key] = tk.TaskPriority(
            THING,
            case.tasks[:levels],
            limits=True,
            dt=DT,
            inverse=case.inverse,
            singular_value_filter=FILTERS[case.filtered],
            wheel_limits=WHEELS[case.wheels],
        )
    return SOLVERS[key]


SOLVERS: dict[tuple, tk.TaskPriority] = {}


def box(case: Case) -> tuple[Vector, Vector]:
    """Position and velocity; who comes from outside may take longer to turn round."""
    reach = THING.velocity_limits * DT
    lower = np.clip(THING.lower - case.q, -reach, reach)
    upper = np.clip(THING.upper - case.q, -reach, reach)
    if case.previous is not None:
        return np.minimum(lower, 0.0), np.maximum(upper, 0.0)
    return lower, upper


def violation(case: Case, dq: Vector) -> float:
    lower, upper = box(case)
    return float(max(0.0, np.max(lower - dq), np.max(dq - upper)))


def check(case: Case, report: Report, with_oracle: bool) -> None:
    step = solver_of(case, len(case.tasks)).solve(case.q, case.targets, previous=case.previous)
    dq = step.dq
    assert np.isfinite(dq).all(), case
    report.status[step.status] += 1
    report.limited += bool(step.active_limits.any())
    report.iterations = max(report.iterations, step.iterations)
    report.violation = max(report.violation, violation(case, dq))
    size = max(1.0, float(np.linalg.norm(dq)))
    for level in range(1, len(case.tasks)):
        alone = solver_of(case, level).step(case.q, case.targets[:level], previous=case.previous)
        for task in case.tasks[:level]:
            leak = np.linalg.norm(jacobian_of(task, case.q) @ (dq - alone))
            report.leak = max(report.leak, float(leak) / size)
    if with_oracle and not (case.filtered or case.wheels or case.previous is not None):
        levels = levels_of(case.tasks, case.q, case.targets)
        damping = case.inverse.damping if isinstance(case.inverse, tk.Damped) else 0.0
        try:
            theirs = hierarchy(*box(case), levels, damping=damping)
        except NoAnswerError:
            report.unanswered += 1
            return
        report.compared += 1
        difference = max(float(np.linalg.norm(A @ (dq - theirs))) for A, _ in levels)
        report.oracle = max(report.oracle, difference)
        report.differing += difference > 1e-8


def run(count: int, seed: int, oracle_every: int = 10) -> Report:
    rng = np.random.default_rng(seed)
    report = Report()
    for i in range(count):
        check(random_case(rng), report, i % oracle_every == 0)
    return report


if __name__ == "__main__":
    arguments = [int(argument) for argument in sys.argv[1:]]
    print(run(*(arguments + [100_000, 0][len(arguments) :])))
