"""What each task asks for: its error, its Jacobian, the shape of its target, its frame."""

import numpy as np
import pytest

import thing_kin as tk
from inverse_cases import HOME, RANDOM_POSTURES, ROBOT, error_of, jacobian_of, target_of

FRAME_TASKS = (tk.PoseTask, tk.PositionTask, tk.OrientationTask)
TASKS = [
    *(kind(gain=0.5) for kind in FRAME_TASKS),
    *(kind(of="forearm") for kind in FRAME_TASKS),
    tk.BaseTask(gain=0.25),
    tk.PostureTask(),
]
SHAPES = {
    tk.PoseTask: (4, 4),
    tk.PositionTask: (3,),
    tk.OrientationTask: (3, 3),
    tk.BaseTask: (3,),
    tk.PostureTask: (9,),
}


def alone(task: tk.Task, inverse: object = None) -> tk.TaskPriority:
    return tk.TaskPriority(ROBOT, [task], inverse=inverse or tk.Exact())


@pytest.mark.parametrize("task", TASKS, ids=repr)
def test_error_and_jacobian(task: tk.Task) -> None:
    """The exact step of one task is J^+ gain e, which shows both."""
    for q in RANDOM_POSTURES:
        target = target_of(task, q + 0.1)
        step = alone(task).solve(q, [target])
        e = error_of(task, q, target)
        np.testing.assert_allclose(step.errors[0], e, atol=1e-14)
        J = jacobian_of(task, q)
        reference = np.linalg.pinv(J, rcond=1e-14) @ (task.gain * e)
        np.testing.assert_allclose(step.dq, reference, atol=1e-11)


@pytest.mark.parametrize("task", TASKS, ids=repr)
def test_the_error_is_what_a_small_motion_takes_away(task: tk.Task) -> None:
    """J is the derivative: after a small dq the error falls by J dq, but for second order."""
    dq = 1e-5 * np.linspace(-1.0, 1.0, 9)
    target = target_of(task, HOME)
    before = alone(task).solve(HOME - dq, [target]).errors[0]
    np.testing.assert_allclose(before, jacobian_of(task, HOME) @ dq, atol=1e-9)
    np.testing.assert_allclose(alone(task).solve(HOME, [target]).errors[0], 0, atol=1e-14)


@pytest.mark.parametrize("task", TASKS, ids=repr)
def test_the_shape_of_its_target(task: tk.Task) -> None:
    shape = SHAPES[type(task)]
    for wrong in ((), (1,), (4,), (6,), (8,), (4, 3), (4, 4), (3, 3), (3, 1), (1, *shape)):
        if wrong == shape:
            continue
        with pytest.raises(ValueError, match=r"^targets\[0\]: got shape .*, expected \(") as error:
            alone(task).step(HOME, [np.zeros(wrong)])
        assert str(shape) in str(error.value)


def test_the_number_of_targets() -> None:
    for targets in ([], [HOME, HOME]):
        with pytest.raises(ValueError, match=rf"^targets: got {len(targets)}, expected 1"):
            alone(tk.PostureTask()).step(HOME, targets)


TURNS = [
    (0.0, np.pi, np.pi),
    (np.pi, 0.0, np.pi),  # -pi is written pi
    (3.0, -3.0, 2 * np.pi - 6.0),
    (-3.0, 3.0, 6.0 - 2 * np.pi),
    (0.1, 0.1 + 4 * np.pi, 0.0),
    (-0.5, 0.7, 1.2),
    (100.0, -100.0, -200.0 + 64 * np.pi),
]


@pytest.mark.parametrize(("at", "goal", "error"), TURNS)
def test_theta_goes_the_short_way_round(at: float, goal: float, error: float) -> None:
    q, target = HOME.copy(), HOME.copy()
    q[8], target[8] = at, goal
    for task, wanted in ((tk.BaseTask(), target[6:]), (tk.PostureTask(), target)):
        e = alone(task).solve(q, [wanted]).errors[0]
        assert -np.pi < e[-1] <= np.pi
        np.testing.assert_allclose(e[-1], error, atol=1e-13)
        np.testing.assert_array_equal(e[:-1], 0.0)


def test_only_theta_is_wrapped() -> None:
    """A revolute joint of an arm has limits: it can't take the short way round."""
    e = alone(tk.PostureTask()).solve(HOME, [HOME + 5.0]).errors[0]
    np.testing.assert_allclose(e, [5.0] * 8 + [5.0 - 2 * np.pi], atol=1e-14)
    arm = tk.robots.ur5()
    solver = tk.TaskPriority(arm, [tk.PostureTask()])
    np.testing.assert_array_equal(solver.solve(np.zeros(6), [np.full(6, 5.0)]).errors[0], 5.0)


def test_continuous_joints_go_the_short_way_round() -> None:
    arm = tk.Chain.from_dh([tk.DH(a=1.0, joint=j) for j in ("continuous", "revolute")])
    e = tk.TaskPriority(arm, [tk.PostureTask()]).solve(np.zeros(2), [np.full(2, 5.0)]).errors[0]
    np.testing.assert_allclose(e, [5.0 - 2 * np.pi, 5.0], rtol=1e-15)


def test_the_base_is_found_in_either_order() -> None:
    robot = tk.robots.thing(order="base_first")
    q = np.roll(HOME, 3)
    solver = tk.TaskPriority(robot, [tk.BaseTask()], inverse=tk.Exact())
    goal = HOME[6:] + np.array([0.1, -0.2, 0.3])
    np.testing.assert_allclose(solver.step(q, [goal]), [0.1, -0.2, 0.3] + [0] * 6, atol=1e-15)
    wrapped = tk.TaskPriority(robot, [tk.PostureTask()]).solve(q, [q + 4.0]).errors[0]
    np.testing.assert_allclose(wrapped[2], 4.0 - 2 * np.pi)


def test_of_is_the_frame_that_moves() -> None:
    """Joints beyond the frame have nothing to do with it."""
    goal = ROBOT.fk(HOME, frame="upper_arm")[:3, 3] + 0.01
    step = alone(tk.PositionTask(of="upper_arm")).step(HOME, [goal])
    assert np.abs(step[:2]).max() > 1e-4
    np.testing.assert_allclose(step[2:6], 0.0, atol=1e-15)
    assert tk.PositionTask(of="upper_arm").of == "upper_arm"
    assert tk.PositionTask().of is None
    assert repr(tk.PoseTask(gain=0.5, of="base")) == "PoseTask(gain=0.5, of='base')"


@pytest.mark.parametrize("kind", SHAPES)
@pytest.mark.parametrize("gain", [0.0, -1.0, np.nan, np.inf])
def test_gains_are_positive(kind: type[tk.Task], gain: float) -> None:
    assert kind(gain=0.3).gain == 0.3
    assert kind().gain == 1.0
    with pytest.raises(ValueError, match=r"^gain: got .*, expected a number > 0"):
        kind(gain=gain)
