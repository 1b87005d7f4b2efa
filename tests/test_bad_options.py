"""Options that are no arrays: names, counts, limits of joints; what is wrong is said by name."""

import numpy as np
import pytest

import thing_kin as tk
from thing_kin.kdl import KdlChain

ROBOT = tk.robots.thing()
ARM = tk.robots.ur5()
Q = np.zeros(9)
T = np.eye(4)
ROW = tk.DH(a=1.0, joint="revolute")
SOLVER = tk.TaskPriority(ROBOT, [tk.PoseTask(), tk.BaseTask()])
MEASURES = ("manipulability", "condition_number", "dexterity")
FRAMES = [("fk", "frame"), ("jacobian", "of"), ("hessian", "of")] + [
    (name + suffix, "of") for name in MEASURES for suffix in ("", "_gradient")
]


def refuses(call, *names: str) -> None:
    with pytest.raises(ValueError, match=r": got .*, expected ") as error:
        call()
    assert str(error.value).startswith(names), error.value


@pytest.mark.parametrize("wrong", ["nope", "", "\ud800", -1, 12, 10**30, 1.5, [], b"tool"])
@pytest.mark.parametrize(("method", "name"), FRAMES)
def test_frames_of_the_chain(method: str, name: str, wrong: object) -> None:
    refuses(lambda: getattr(ROBOT, method)(Q, **{name: wrong}), f"{name}: got")


@pytest.mark.parametrize("wrong", ["nope", "", "World", "tool"])
def test_names_from_a_list(wrong: str) -> None:
    for call in (ROBOT.jacobian, ROBOT.hessian):
        refuses(lambda call=call: call(Q, frame=wrong), f"frame: got '{wrong}'")
    refuses(lambda: tk.pose_error(T, T, frame=wrong), f"frame: got '{wrong}'")
    refuses(lambda: tk.pose_error(T, T, method=wrong), f"method: got '{wrong}'")
    refuses(lambda: tk.TaskPriority(ROBOT, [tk.PoseTask()], scheme=wrong), "scheme: got")
    refuses(lambda: tk.robots.thing(order=wrong), "order: got")
    refuses(lambda: tk.on_omni_base(ARM, order=wrong), "order: got")
    refuses(lambda: tk.DH(joint=wrong), "joint: got")
    if wrong not in ("", "tool"):
        refuses(lambda: KdlChain(ARM).fk(Q[:6], frame=wrong), "frame: got")


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("name", ["d", "theta", "a", "alpha"])
def test_rows_are_finite(name: str, wrong: float) -> None:
    refuses(lambda: tk.DH(**{name: wrong}), f"{name}: got")


def test_limits_of_a_row() -> None:
    for name in ("velocity_limit", "acceleration_limit"):
        for wrong in (0.0, -1.0, np.nan):
            refuses(lambda n=name, w=wrong: tk.DH(joint="revolute", **{n: w}), f"{name}: got")
    refuses(lambda: tk.DH(joint="revolute", lower=1.0, upper=0.5), "lower")
    refuses(lambda: tk.DH(joint="prismatic", lower=np.nan), "lower")
    refuses(lambda: tk.DH(lower=-1.0), "joint: got a fixed row")
    refuses(lambda: ROBOT.with_limits(lower=ROBOT.upper + 1.0), "lower")


@pytest.mark.parametrize("rows", [[], [tk.DH(a=1.0)], [ROW] * 33])
def test_a_chain_has_one_to_32_joints(rows: list[tk.DH]) -> None:
    refuses(lambda: tk.Chain.from_dh(rows), "rows: got")
    assert tk.Chain.from_dh([ROW] * 32).n == tk._core.MAX_DOF == 32


def test_names_are_unique() -> None:
    twice = [tk.DH(joint="revolute", name="a", frame=f) for f in ("f", "g")]
    with pytest.raises(ValueError, match=r"got .*'a'.*, expected"):
        tk.Chain.from_dh(twice)
    with pytest.raises(ValueError, match=r"got .*'f'.*, expected"):
        tk.Chain.from_dh([tk.DH(joint="revolute", frame="f")] * 2)
    refuses(lambda: tk.on_omni_base(ROBOT), "arm: got")


@pytest.mark.parametrize("robot", [tk.robots.thing, tk.robots.pioneer_lx_ur5])
@pytest.mark.parametrize(
    "wrong", [[], [(0, 1)], [(0, 1)] * 4, [(1, 0)] * 3, [(np.nan, 1)] * 3, [(0, 1, 2)] * 3]
)
def test_limits_of_the_base(robot, wrong: list) -> None:
    refuses(lambda: robot(base_limits=wrong), "base_limits: got")
    refuses(lambda: tk.on_omni_base(ARM, base_limits=wrong), "base_limits: got")


@pytest.mark.parametrize("wrong", [(1.0,), (1.0, 2.0, np.nan), (1.0, 2.0, 0.0), (1.0, -2.0, 3.0)])
@pytest.mark.parametrize("name", ["base_velocity_limits", "base_acceleration_limits"])
def test_rates_of_the_base(name: str, wrong: tuple) -> None:
    refuses(lambda: tk.on_omni_base(ARM, **{name: wrong}), f"{name}: got")


@pytest.mark.parametrize(
    "mount",
    [np.zeros((4, 4)), np.diag([2.0, 2.0, 2.0, 1.0]), np.diag([1.0, 1.0, -1.0, 1.0]), 2 * T],
)
def test_mounts_and_tools_are_rigid(mount: np.ndarray) -> None:
    refuses(lambda: tk.on_omni_base(ARM, mount), "mount: got")
    refuses(lambda: tk.robots.pioneer_lx_ur5(mount), "mount: got")
    refuses(lambda: ARM.with_tool(mount), "tool: got")


def test_one_orientation_is_enough() -> None:
    both = {"rpy": (0, 0, 0), "quaternion": (1, 0, 0, 0)}
    refuses(lambda: tk.transform(**both), "rpy")
    refuses(lambda: tk.transform(quaternion=(0, 0, 0, 0)), "quaternion: got zero")


def test_a_robot_without_a_base_has_none() -> None:
    for call in (ARM.base_pose, ARM.task_vector):
        refuses(lambda call=call: call(np.zeros(6)), "robot: got 'ur5'")
    refuses(lambda: tk.TaskPriority(ARM, [tk.BaseTask()]), "tasks: got BaseTask")


def test_tasks_and_targets() -> None:
    refuses(lambda: tk.TaskPriority(ROBOT, [None]), "tasks: got None")
    refuses(lambda: tk.TaskPriority(ROBOT, [tk.PoseTask(of="nope")]), "of: got", "tasks")
    for wrong in ([], [T], [T, Q[6:], T], "ab", np.zeros((2, 3))):
        refuses(lambda w=wrong: SOLVER.step(Q, w), "targets")
    for wrong in (None, 5, {1: 2}, np.zeros(())):
        with pytest.raises(TypeError):  # no sequence at all
            SOLVER.step(Q, wrong)


def test_batches_of_different_length() -> None:
    poses = np.repeat(T[None], 3, axis=0)
    refuses(lambda: tk.pose_error(poses, poses[:2]), "T_goal: got 2 poses")
    turned = tk.transform(rpy=(0, 0, 1.6))
    refuses(lambda: tk.pose_error(T, turned, method="cross"), "T_goal: got")


def test_drawing() -> None:
    refuses(lambda: ROBOT.random(-1), "n: got -1")
    sliding = tk.Chain.from_dh([tk.DH(joint="prismatic", name="slide")])
    refuses(lambda: sliding.random(), "slide: got a joint without limits")


@pytest.mark.parametrize("wrong", [None, "thing", 5, ROW, [ROW]])
def test_what_is_no_robot_is_a_type_error(wrong: object) -> None:
    with pytest.raises(TypeError):
        tk.TaskPriority(wrong, [tk.PoseTask()])
    with pytest.raises(TypeError):
        tk.on_omni_base(wrong)
