"""Set-based tasks in closed loop: kept, recovered, at their place among the priorities."""

import numpy as np
import pytest

import thing_kin as tk
from inverse_cases import HOME, ROBOT

DT = 0.02
THING = ROBOT.with_limits(
    velocity_limits=np.where(np.isfinite(ROBOT.velocity_limits), ROBOT.velocity_limits, 1.0)
)


def run(tasks, goals_of, steps: int, q: np.ndarray = HOME) -> np.ndarray:
    solver = tk.TaskPriority(THING, tasks, limits=True, dt=DT)
    path = [q]
    for i in range(steps):
        path.append(path[-1] + solver.step(path[-1], goals_of(i)))
    return np.array(path)


def test_the_base_drives_around_an_obstacle() -> None:
    q = HOME.copy()
    q[6:] = 0.0
    center = (1.0, 0.01)
    path = run(
        [tk.BaseObstacleTask(0.5), tk.BaseTask(gain=0.2)],
        lambda _: [center, (2.0, 0.0, 0.0)],
        600,
        q,
    )
    distance = np.linalg.norm(path[:, 6:8] - center, axis=1)
    assert distance.min() >= 0.5 - 1e-12  # a convex distance: never inside
    assert distance.min() < 0.5 + 1e-3  # a step along the tangent leads off by its square
    np.testing.assert_allclose(path[-1, 6:], [2.0, 0.0, 0.0], atol=1e-3)


def test_in_the_middle_of_an_obstacle_there_is_a_way_out() -> None:
    path = run([tk.BaseObstacleTask(0.3)], lambda _: [HOME[6:8]], 50)
    assert np.linalg.norm(path[-1, 6:8] - HOME[6:8]) == pytest.approx(0.3, abs=1e-9)


def angle_to(q: np.ndarray, point: np.ndarray, axis: np.ndarray) -> float:
    T = ROBOT.fk(q)
    way = point - T[:3, 3]
    return float(np.arccos(np.clip(T[:3, :3] @ axis @ way / np.linalg.norm(way), -1, 1)))


def test_a_point_stays_in_view_while_the_hand_moves_on() -> None:
    T = ROBOT.fk(HOME)
    point = T[:3, 3] + 0.8 * T[:3, 2]
    goal = T[:3, 3] + 0.3 * T[:3, 0] + 0.2 * T[:3, 1]
    axis = np.array([0.0, 0.0, 1.0])
    position = tk.PositionTask(gain=0.05)
    blind = run([position], lambda _: [goal], 300)
    assert max(angle_to(q, point, axis) for q in blind) > 0.15
    path = run([tk.FieldOfViewTask(0.1), position], lambda _: [point, goal], 300)
    assert max(angle_to(q, point, axis) for q in path) < 0.1 + 1e-3  # to first order in a step
    assert np.linalg.norm(ROBOT.fk(path[-1])[:3, 3] - goal) < 1e-4
    sideways = tk.FieldOfViewTask(0.1, axis=(1.0, 0.0, 0.0), gain=0.2)
    path = run([sideways], lambda _: [point], 400)
    assert angle_to(path[-1], point, np.array([1.0, 0.0, 0.0])) < 0.1 + 1e-6


def test_a_tether_and_a_keep_out_sphere() -> None:
    p = ROBOT.fk(HOME)[:3, 3]
    pull = p + np.array([0.0, 0.0, 0.4])
    tether = run([tk.DistanceTask(upper=0.1), tk.PositionTask(gain=0.1)], lambda _: [p, pull], 200)
    distances = [np.linalg.norm(ROBOT.fk(q)[:3, 3] - p) for q in tether]
    assert max(distances) < 0.1 + 1e-4
    assert distances[-1] == pytest.approx(0.1, abs=1e-6)
    sphere = p + np.array([0.0, 0.01, 0.2])
    around = run(
        [tk.DistanceTask(lower=0.15), tk.PositionTask(gain=0.1)], lambda _: [sphere, pull], 400
    )
    distances = [np.linalg.norm(ROBOT.fk(q)[:3, 3] - sphere) for q in around]
    assert min(distances) > 0.15 - 1e-4
    assert np.linalg.norm(ROBOT.fk(around[-1])[:3, 3] - pull) < 1e-3


def test_an_interval_yields_to_what_stands_above_it_and_to_nothing_else() -> None:
    lower, upper = np.full(9, -np.inf), np.full(9, np.inf)
    lower[1], upper[1] = HOME[1] - 0.001, HOME[1] + 0.001
    ranges = tk.JointRangeTask(lower, upper)
    goal = HOME + 0.01 * np.array([1, 1, -1, 1, 1, 1, 1, 1, 1])
    T_goal = ROBOT.fk(goal)
    above = tk.TaskPriority(THING, [ranges, tk.PostureTask()], limits=True, dt=DT)
    step = above.solve(HOME, [None, goal])
    assert step.dq[1] == pytest.approx(0.001, abs=1e-15)
    assert step.active_intervals[0].tolist() == [0, 1, 0, 0, 0, 0, 0, 0, 0]
    np.testing.assert_allclose(step.dq[[0, 2]], (goal - HOME)[[0, 2]] / (1 + 1e-4), rtol=1e-9)
    below = tk.TaskPriority(THING, [tk.PostureTask(), ranges], limits=True, dt=DT)
    step = below.solve(HOME, [goal, None])
    np.testing.assert_allclose(step.dq, (goal - HOME) / (1 + 1e-4), rtol=1e-9)
    assert step.residuals[1][1] == pytest.approx(0.009, rel=1e-3)
    both = tk.TaskPriority(THING, [tk.PoseTask(), ranges], limits=True, dt=DT)
    step = both.solve(HOME, [T_goal, None])
    assert np.abs(step.residuals[0]).max() < 1e-4  # damped
    assert step.dq[1] <= 0.001 + 1e-12  # three joints more than the hand needs


def test_contradictory_intervals_share_the_miss() -> None:
    low, high = np.full(9, -np.inf), np.full(9, np.inf)
    one, other = high.copy(), low.copy()
    one[0], other[0] = HOME[0] - 0.01, HOME[0] + 0.02
    first = tk.JointRangeTask(low, one)
    second = tk.JointRangeTask(other, high)
    solver = tk.TaskPriority(THING, [first, second], limits=True, dt=DT)
    step = solver.solve(HOME, [None, None])
    assert step.dq[0] == pytest.approx(-0.01, abs=1e-14)  # the first is first
    assert step.residuals[1][0] == pytest.approx(-0.03, abs=1e-14)
    assert step.status == "optimal"


def test_the_gain_is_the_share_of_an_excess() -> None:
    upper = np.full(9, np.inf)
    upper[0] = HOME[0] - 0.01
    for gain in (0.25, 1.0):
        task = tk.JointRangeTask(np.full(9, -np.inf), upper, gain=gain)
        step = tk.TaskPriority(THING, [task], limits=True, dt=DT).step(HOME, [None])
        assert step[0] == pytest.approx(-0.01 * gain, rel=1e-12)
        assert not step[1:].any()


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: tk.DistanceTask(-1.0), "lower: got -1"),
        (lambda: tk.DistanceTask(np.inf), "lower: got inf"),
        (lambda: tk.DistanceTask(1.0, 0.5), "upper: got 0.5"),
        (lambda: tk.DistanceTask(1.0, np.nan), "upper: got nan"),
        (lambda: tk.BaseObstacleTask(0.0), "radius: got 0"),
        (lambda: tk.BaseObstacleTask(np.nan), "radius: got nan"),
        (lambda: tk.FieldOfViewTask(0.0), "limit: got 0"),
        (lambda: tk.FieldOfViewTask(4.0), "limit: got 4"),
        (lambda: tk.FieldOfViewTask(1.0, axis=(0, 0, 0)), "axis: got"),
        (lambda: tk.FieldOfViewTask(1.0, axis=(0, 0)), "axis: got"),
        (lambda: tk.JointRangeTask(np.ones(9), np.zeros(9)), "lower: got"),
        (lambda: tk.JointRangeTask(np.ones(9), np.full(9, np.nan)), "lower: got"),
        (lambda: tk.JointRangeTask(np.ones(9), np.ones(8)), "upper: got 8"),
        (lambda: tk.JointRangeTask(np.ones((3, 3)), np.ones(8)), "lower: got"),
        (lambda: tk.JointRangeTask("abc", np.ones(8)), "lower: got"),
        (lambda: tk.JointRangeTask([], []), "lower: got"),
        (lambda: tk.BaseObstacleTask(1.0, gain=1.5), "gain: got 1.5"),
        (lambda: tk.BaseObstacleTask(1.0, gain=0.0), "gain: got 0"),
    ],
)
def test_what_makes_no_interval(make, said: str) -> None:
    with pytest.raises(ValueError, match=f"^{said}.*, expected"):
        make()


def test_where_they_do_not_fit() -> None:
    task = tk.BaseObstacleTask(0.5)
    with pytest.raises(ValueError, match=r"^tasks: got BaseObstacleTask without limits"):
        tk.TaskPriority(THING, [task])
    with pytest.raises(ValueError, match=r"^tasks: got BaseObstacleTask for 'ur5'"):
        tk.TaskPriority(tk.robots.ur5(), [task], limits=True, dt=DT)
    ranges = tk.JointRangeTask(np.zeros(3), np.ones(3))
    with pytest.raises(ValueError, match=r"^tasks: got JointRangeTask of 3"):
        tk.TaskPriority(THING, [ranges], limits=True, dt=DT)
    many = [tk.JointRangeTask(np.zeros(9), np.ones(9))] * 8
    with pytest.raises(ValueError, match=r"^tasks: got 72 rows"):
        tk.TaskPriority(THING, many, limits=True, dt=DT)
    solver = tk.TaskPriority(THING, [task, many[0]], limits=True, dt=DT)
    with pytest.raises(ValueError, match=r"^targets\[1\]: got .*, expected None"):
        solver.step(HOME, [(0, 0), HOME])
    for wrong in ((0, 0, 0), None, np.nan):
        with pytest.raises(ValueError, match=r"^targets\[0\]: got"):
            solver.step(HOME, [wrong, None])


def test_what_a_task_says_of_itself() -> None:
    assert tk.DistanceTask(0.1, 0.2).of is None
    assert (tk.DistanceTask(0.1, 0.2).lower, tk.DistanceTask(0.1, 0.2).upper) == (0.1, 0.2)
    assert tk.FieldOfViewTask(0.3, axis=(0, 3, 4), of="wrist_1").axis.tolist() == [0.0, 0.6, 0.8]
    assert "wrist_1" in repr(tk.FieldOfViewTask(0.3, of="wrist_1"))
    assert repr(tk.JointRangeTask(np.zeros(3), np.ones(3))) == "JointRangeTask(3 joints, gain=1.0)"
    assert tk.JointRangeTask(np.zeros(3), np.ones(3)).lower.tolist() == [0.0] * 3
    assert tk.BaseObstacleTask(0.5).radius == 0.5
