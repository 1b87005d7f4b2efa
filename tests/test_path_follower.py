"""Paths whose poses come in one by one."""

import numpy as np
import pytest

import thing_kin as tk
from oracles import assert_close
from path_cases import Case, worst

ROBOT = tk.robots.thing()
SEED = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
DISC = tk.Disc(center=(1.5, 0.45), radius=0.5)
STEP = 0.1


def course(count: int) -> Case:
    s = np.linspace(0.0, 1.0, count)
    poses = np.repeat(ROBOT.fk(SEED)[None], count, axis=0)
    poses[:, 0, 3] += 3.0 * s
    base = np.column_stack([3.0 * s, 0.2 * np.sin(np.pi * s), np.zeros(count)])
    options = {
        "base_path": base,
        "base_radius": 0.3,
        "obstacles": [DISC],
        "max_joint_step": STEP,
    }
    return Case(ROBOT, poses, SEED, options, np.zeros((count, 9)))


def follow(case: Case, window: int) -> list[tk.FollowerStep]:
    options = {k: v for k, v in case.options.items() if k != "base_path"}
    follower = tk.PathFollower(case.robot, SEED, window=window, base="xytheta", **options)
    waiting = list(zip(case.poses, case.options["base_path"], strict=True))
    steps = []
    while waiting or follower.pending:
        while waiting and follower.push(*waiting[0]):
            del waiting[0]
        step = follower.step()
        assert step is not None
        steps.append(step)
    assert follower.step() is None
    return steps


def test_it_follows_past_the_disc() -> None:
    case = course(150)
    steps = follow(case, 30)
    q = np.array([step.q for step in steps])
    assert q.shape == (150, 9)
    missed = worst(case, q)
    assert max(missed["position"], missed["rotation"]) < 1e-9
    assert max(missed.values()) < 1e-5  # one iteration a step leaves its curvature
    assert np.abs(np.array([s.violation for s in steps])).max() < 1e-5
    assert steps[-1].position_error < 1e-9
    assert steps[-1].rotation_error < 1e-9


def test_a_long_window_comes_near_the_whole_path() -> None:
    case = course(80)
    whole = case.plan(dexterity_weight=1e-4)
    options = {k: v for k, v in case.options.items() if k != "base_path"}
    follower = tk.PathFollower(
        ROBOT, SEED, window=80, base="xytheta", dexterity_weight=1e-4, **options
    )
    for pose, base in zip(case.poses, case.options["base_path"], strict=True):
        assert follower.push(pose, base)
    q = np.array([follower.step().q for _ in range(80)])  # type: ignore[union-attr]
    lengths = [0.5 * float((np.diff(path, axis=0) ** 2).sum()) for path in (q, whole.q)]
    assert lengths[0] < 1.2 * lengths[1]


def test_equal_input_gives_equal_output() -> None:
    first, second = follow(course(40), 10), follow(course(40), 10)
    assert_close([s.q for s in first], [s.q for s in second], 0.0)


def test_misuse_names_the_argument() -> None:
    with pytest.raises(ValueError, match=r"^window"):
        tk.PathFollower(ROBOT, SEED, window=0)
    with pytest.raises(ValueError, match=r"^base:"):
        tk.PathFollower(ROBOT, SEED, base="round")
    with pytest.raises(ValueError, match=r"^base_radius"):
        tk.PathFollower(ROBOT, SEED, base_radius=0.3)
    with pytest.raises(ValueError, match=r"^seed"):
        tk.PathFollower(ROBOT, SEED[:3])
    follower = tk.PathFollower(ROBOT, SEED)
    assert (follower.pending, follower.window, follower.robot) == (0, 20, ROBOT)
    with pytest.raises(ValueError, match=r"^pose"):
        follower.push(np.eye(3))
    with pytest.raises(ValueError, match=r"^base"):
        follower.push(ROBOT.fk(SEED), np.zeros(3))
