"""Threads: equal results, and the GIL is free while the core computes."""

import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from numpy.typing import NDArray

import thing_kin as tk
from inverse_cases import FILTERS, INVERSES, RANDOM_POSTURES, ROBOT, SCHEMES, TWO_TASKS, targets

POSTURES = np.vstack([RANDOM_POSTURES + 0.01 * i for i in range(10)])
GOALS = [targets(TWO_TASKS, q, seed=i) for i, q in enumerate(POSTURES)]
MOST_CALLS = 20_000


def make_solver(scheme: str, inverse: str) -> tk.TaskPriority:
    return tk.TaskPriority(
        ROBOT,
        TWO_TASKS,
        scheme=scheme,
        inverse=INVERSES[inverse],
        singular_value_filter=FILTERS["filtered"],
        step_limit=0.1,
    )


def all_steps(solver: tk.TaskPriority) -> NDArray[np.float64]:
    return np.array([solver.step(*case) for case in zip(POSTURES, GOALS, strict=True)])


@pytest.mark.parametrize("inverse", INVERSES)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_four_threads_step_as_one(scheme: str, inverse: str) -> None:
    serial = all_steps(make_solver(scheme, inverse))
    shared = make_solver(scheme, inverse)
    own = [make_solver(scheme, inverse) for _ in range(4)]
    for solvers in (own, [shared] * 4):
        together = threading.Barrier(4)

        def run(solver: tk.TaskPriority, together: threading.Barrier = together) -> NDArray:
            together.wait()
            return all_steps(solver)

        with ThreadPoolExecutor(4) as pool:
            for steps in pool.map(run, solvers):
                assert steps.tobytes() == serial.tobytes()


def test_four_threads_place_one_robot() -> None:
    serial = ROBOT.jacobian(POSTURES)
    with ThreadPoolExecutor(4) as pool:
        for J in pool.map(lambda _: ROBOT.jacobian(POSTURES), range(8)):
            assert J.tobytes() == serial.tobytes()


@pytest.fixture
def no_forced_switches() -> Iterator[None]:
    """Python takes the GIL from no running thread: it must be given up."""
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1000.0)
    yield
    sys.setswitchinterval(interval)


def gives_up_the_gil(call: Callable[[], object]) -> bool:
    """Whether this thread gets to run between the first and the last of many calls in another.

    No clock: the other thread calls until it sees that this one ran, or gives up. Without a forced
    switch, this one runs before the end only if a call releases the GIL.
    """
    this_ran = False
    seen = False

    def work() -> None:
        nonlocal seen
        for _ in range(MOST_CALLS):
            call()
            if this_ran:
                seen = True
                return

    worker = threading.Thread(target=work)
    worker.start()
    this_ran = True
    worker.join()
    return seen


Q = np.tile(RANDOM_POSTURES, (20, 1))
J = ROBOT.jacobian(Q)
SOLVER = make_solver("chiaverini", "selective")
CALLS = {
    "fk": lambda: ROBOT.fk(Q),
    "jacobian": lambda: ROBOT.jacobian(Q),
    "hessian": lambda: ROBOT.hessian(Q),
    "manipulability": lambda: ROBOT.manipulability(Q),
    "dexterity_gradient": lambda: ROBOT.dexterity_gradient(Q),
    "pinv": lambda: tk.pinv(J),
    "so3_exp": lambda: tk.lie.so3_exp(Q[:, :3]),
    "step": lambda: SOLVER.step(POSTURES[0], GOALS[0]),
    "solve": lambda: SOLVER.solve(POSTURES[0], GOALS[0]),
}


@pytest.mark.usefixtures("no_forced_switches")
@pytest.mark.parametrize("name", CALLS)
def test_the_gil_is_released(name: str) -> None:
    assert gives_up_the_gil(CALLS[name])


@pytest.mark.usefixtures("no_forced_switches")
def test_a_call_that_keeps_the_gil_is_told_from_one_that_does_not() -> None:
    assert not gives_up_the_gil(lambda: sum(range(10)))
