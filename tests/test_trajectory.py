"""A path gets time: within every limit between the knots too, beside the path, and fast."""

import csv
import subprocess
import sys
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import thing_kin as tk
from trajectory_checks import (
    assert_consistent,
    assert_rest_to_rest,
    assert_within,
    distance_to_polyline,
    wheel_speeds,
)

ROBOT = tk.robots.thing()
ARM = tk.robots.ur5()
WHEELS = tk.WheelLimits(radius=0.0759, k=0.6, speed=8.0)
V, A = ROBOT.velocity_limits, ROBOT.acceleration_limits


def slide(velocity: float = 1.0, acceleration: float = 2.0, bound: float = np.inf) -> tk.Chain:
    row = tk.DH(joint="prismatic", lower=-bound, upper=bound)
    chain = tk.Chain.from_dh([row])
    return chain.with_limits(velocity_limits=[velocity], acceleration_limits=[acceleration])


def random_path(rng: np.random.Generator, n: int, kind: str) -> np.ndarray:
    """Corners, curves, or steps that turn back, stand still and move a joint at a time."""
    if kind == "corners":
        return rng.uniform(-1.5, 1.5, (n, 9))
    if kind == "smooth":
        s = np.linspace(0, 1, n)[:, None]
        return np.sin(s * rng.uniform(0, 6, 9) + rng.uniform(0, 6, 9)) * rng.uniform(0, 1.5, 9)
    steps = rng.choice([-0.5, 0.0, 0.0, 1e-5, 0.3], (n, 9)) * (rng.random((n, 9)) < 0.3)
    return np.clip(np.cumsum(steps, axis=0), -2.5, 2.5)


paths = st.builds(
    lambda seed, n, kind: random_path(np.random.default_rng(seed), n, kind),
    st.integers(0, 2**32 - 1),
    st.integers(1, 12),
    st.sampled_from(["corners", "smooth", "steps"]),
)


@settings(max_examples=15)
@given(q=paths, tolerance=st.sampled_from([1e-4, 2e-3, 0.05]), wheels=st.booleans())
@example(q=np.zeros((1, 9)), tolerance=2e-3, wheels=True)
@example(q=np.ones((4, 9)), tolerance=2e-3, wheels=False)
def test_a_path_is_followed_within_all_limits(q, tolerance, wheels):
    limits = WHEELS if wheels else None
    trajectory = tk.time_path(ROBOT, q, tolerance=tolerance, wheel_limits=limits)
    assert_rest_to_rest(trajectory, q)
    assert_within(trajectory, V, A)
    t = np.linspace(0.0, trajectory.duration, 1601)
    at, qd, _ = trajectory.sample(t)
    assert trajectory.path_deviation <= tolerance
    assert distance_to_polyline(at, q).max() <= trajectory.path_deviation + 1e-7
    if trajectory.duration > 0:
        assert_consistent(trajectory)
    if wheels:
        speeds = wheel_speeds(WHEELS, at[::2, 6:], qd[::2, 6:])
        assert np.abs(speeds).max() <= WHEELS.speed * (1 + 1e-9)
    near = np.array([np.abs(at - w).max(axis=1).min() for w in q])
    step = np.abs(np.diff(at, axis=0)).max(initial=0.0)
    assert near.max() <= step  # through every waypoint, as far as samples show


@settings(max_examples=4)
@given(q=paths, jerk=st.sampled_from([10.0, 60.0]))
def test_jerk_is_limited(q, jerk):
    trajectory = tk.time_path(ROBOT, q, jerk_limits=jerk)
    assert_within(trajectory, V, A, jerk)
    assert_rest_to_rest(trajectory, q)


@pytest.mark.parametrize("way", [1e-3, 0.1, 1.0, 30.0])
def test_a_straight_line_takes_little_more_than_the_least_time(way):
    v, a = 1.0, 2.0
    least = 2 * np.sqrt(way / a) if way < v * v / a else way / v + v / a
    robot = slide(v, a)
    for trajectory in (
        tk.time_path(robot, [[0.0], [way]]),
        tk.move_to(robot, [0.0], [way]),
        tk.time_path(robot, np.linspace(0, way, 7)[:, None]),
    ):
        assert least <= trajectory.duration <= 1.03 * least
        assert_rest_to_rest(trajectory, np.array([[0.0], [way]]))


@pytest.mark.parametrize("way", [0.01, 1.0, 30.0])
def test_with_jerk_the_least_time_has_seven_phases(way):
    v, a, j = 1.0, 2.0, 10.0
    trajectory = tk.move_to(slide(v, a), [0.0], [way], jerk_limits=j)
    if way >= v * (v / a + a / j):
        least = way / v + v / a + a / j
    elif way < 2 * a**3 / j**2:
        least = 4 * np.cbrt(way / (2 * j))
    else:
        least = a / j + np.sqrt((a / j) ** 2 + 4 * way / a)
    np.testing.assert_allclose(trajectory.duration, least, rtol=1e-6)
    assert_within(trajectory, v, a, j)
    assert_consistent(trajectory)
    smoothed = tk.time_path(slide(v, a), [[0.0], [way]], jerk_limits=j)
    assert least * (1 - 1e-9) <= smoothed.duration <= 1.3 * least
    assert_within(smoothed, v, a, j)


def test_time_scales_with_the_limits():
    """Metamorphic: all velocities by c, accelerations by c^2: the same motion, c times faster."""
    q = random_path(np.random.default_rng(3), 6, "corners")
    slow = tk.time_path(ROBOT, q)
    fast = tk.time_path(ROBOT, q, velocity_limits=3 * V, acceleration_limits=9 * A)
    np.testing.assert_allclose(fast.duration * 3, slow.duration, rtol=1e-3)


def test_reversed_path_takes_as_long():
    q = random_path(np.random.default_rng(4), 8, "corners")
    there, back = tk.time_path(ROBOT, q), tk.time_path(ROBOT, q[::-1])
    np.testing.assert_allclose(there.duration, back.duration, rtol=0.02)


def test_wider_corners_are_faster():
    q = random_path(np.random.default_rng(5), 6, "corners")
    durations = [tk.time_path(ROBOT, q, tolerance=x).duration for x in (1e-4, 1e-3, 1e-2, 1e-1)]
    assert all(later <= 1.03 * sooner for sooner, later in pairwise(durations))
    assert durations[-1] < 0.97 * durations[0]


def test_a_dense_smooth_path_is_not_slowed_by_its_many_waypoints():
    s = np.linspace(0, 1, 200)[:, None]
    q = np.sin(2 * np.pi * s) * np.linspace(0.1, 1.0, 9)
    coarse = tk.time_path(ROBOT, q[::5], tolerance=0.05)
    np.testing.assert_allclose(tk.time_path(ROBOT, q).duration, coarse.duration, rtol=0.02)


def test_joint_limits_are_not_overshot():
    """A joint that touches its limit at waypoints, at corners and along a stretch."""
    rng = np.random.default_rng(6)
    for _ in range(10):
        q = np.clip(rng.uniform(-2, 2, (8, 1)), -1.0, 1.0)
        trajectory = tk.time_path(slide(bound=1.0), q, tolerance=0.2)
        at = trajectory.sample(np.linspace(0, trajectory.duration, 5001))[0]
        assert np.abs(at).max() <= 1.0 + 1e-12
        assert np.abs(at).max() >= np.abs(q).max() - 1e-3


def test_a_joint_may_stand_still():
    q = np.zeros((4, 9))
    q[:, 3] = [0.0, 1.0, 0.5, 2.0]
    limits = np.zeros(9)
    limits[3] = 1.0
    trajectory = tk.time_path(ROBOT, q, velocity_limits=limits)
    at = trajectory.sample(np.linspace(0, trajectory.duration, 1001))[0]
    np.testing.assert_array_equal(np.delete(at, 3, axis=1), np.zeros((1001, 8)))
    with pytest.raises(ValueError, match=r"velocity_limits: got 0 for joint 4, which moves by 1"):
        tk.time_path(
            ROBOT, np.eye(9)[:2] + np.eye(9)[4] * [[0], [1]], velocity_limits=[1, 1] + 7 * [0]
        )


@pytest.mark.parametrize("unlimited", ["velocity_limits", "acceleration_limits"])
def test_one_kind_of_limit_is_enough(unlimited):
    q = random_path(np.random.default_rng(7), 5, "corners")
    trajectory = tk.time_path(ROBOT, q, **{unlimited: np.inf})
    bounded = tk.time_path(ROBOT, q)
    assert 0 < trajectory.duration < bounded.duration * 1.02
    limits = {"velocity": V, "acceleration": A}
    del limits[unlimited.removesuffix("_limits")]
    assert_within(trajectory, **limits)
    move = tk.move_to(ROBOT, q[0], q[1], **{unlimited: np.inf})
    assert_within(move, **limits)


def test_nothing_limits():
    with pytest.raises(ValueError, match=r"velocity_limits: got none for the joints that move"):
        tk.time_path(ARM, np.eye(6)[:2], velocity_limits=np.inf, acceleration_limits=np.inf)
    with pytest.raises(ValueError, match=r"velocity_limits: got none"):
        tk.move_to(ARM, np.zeros(6), np.ones(6), velocity_limits=np.inf, acceleration_limits=np.inf)


def planned(reach: float) -> tk.PathPlan:
    """User script 05, in a third of the waypoints."""
    seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
    s = np.linspace(0.0, 1.0, 34)
    poses = np.repeat(ROBOT.fk(seed)[None], len(s), axis=0)
    poses[:, 0, 3] += reach * s
    base_path = np.column_stack([3.0 * s, 0.2 * np.sin(np.pi * s), np.zeros_like(s)])
    disc = tk.Disc(center=(1.5, 0.45), radius=0.5)
    options = {"base_path": base_path, "base_radius": 0.3, "max_joint_step": 0.6}
    return tk.plan_path(ROBOT, poses, seed=seed, obstacles=[disc], **options)


def test_a_planned_path_is_timed():
    path = planned(3.0)
    trajectory = path.timed()
    assert_rest_to_rest(trajectory, path.q)
    assert_within(trajectory, V, A)
    assert trajectory.joint_names == ROBOT.names
    xy = trajectory.sample(np.linspace(0.0, trajectory.duration, 5000))[0][:, 6:8]
    clearance = np.hypot(*(xy - (1.5, 0.45)).T).min() - 0.5
    assert clearance >= -np.sqrt(2) * trajectory.path_deviation
    assert path.timed(jerk_limits=20.0).duration > trajectory.duration


def test_a_path_that_failed_gets_no_time():
    with pytest.raises(ValueError, match=r"^plan: got one that failed .*, expected a success"):
        planned(30.0).timed()


def test_standing():
    for trajectory in (
        tk.time_path(ROBOT, np.ones((1, 9))),
        tk.time_path(ROBOT, np.ones((5, 9))),
        tk.move_to(ROBOT, np.ones(9), np.ones(9)),
    ):
        assert trajectory.duration == 0.0
        assert trajectory.path_deviation == 0.0
        for t in (-1.0, 0.0, 2.0):
            q, qd, qdd, jerk = trajectory.sample(t, 3)
            np.testing.assert_array_equal(q, np.ones(9))
            np.testing.assert_array_equal([qd, qdd, jerk], np.zeros((3, 9)))


def test_repeated_waypoints_change_nothing():
    q = random_path(np.random.default_rng(8), 5, "corners")
    once, again = tk.time_path(ROBOT, q), tk.time_path(ROBOT, np.repeat(q, 3, axis=0))
    np.testing.assert_array_equal(once.positions, again.positions)
    np.testing.assert_array_equal(once.times, again.times)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"q": np.full((3, 9), np.nan)}, "q: got NaN or inf"),
        ({"q": np.zeros((0, 9))}, r"q: got shape \(0, 9\)"),
        ({"q": np.zeros(9)}, r"q: got shape \(9,\)"),
        ({"q": np.zeros((3, 8))}, r"q: got shape \(3, 8\)"),
        ({"q": np.full((2, 9), 7.0)}, "q: got a joint .* outside its limits"),
        ({"velocity_limits": -1.0}, "velocity_limits: got -1"),
        ({"velocity_limits": np.nan}, "velocity_limits: got nan"),
        ({"acceleration_limits": np.ones(3)}, r"acceleration_limits: got shape \(3,\)"),
        ({"jerk_limits": 0.0}, "jerk_limits: got 0 for joint 0, which moves by 1"),
        ({"tolerance": 0.0}, "tolerance: got 0.0"),
        ({"tolerance": np.nan}, "tolerance: got nan"),
    ],
)
def test_misuse(arguments, message):
    with pytest.raises(ValueError, match=f"^{message}.*expected"):
        tk.time_path(ROBOT, **{"q": np.array([np.zeros(9), np.ones(9)]), **arguments})


def test_wheels_need_a_base():
    with pytest.raises(ValueError, match=r"wheel_limits: got .* no base"):
        tk.time_path(ARM, np.eye(6)[:2], wheel_limits=WHEELS)


def test_sampling_one_time_is_a_row_of_sampling_many():
    trajectory = tk.time_path(ROBOT, random_path(np.random.default_rng(9), 5, "corners"))
    t = np.linspace(-0.1, trajectory.duration + 0.1, 57)
    many = trajectory.sample(t, 3)
    for i, one in enumerate(t):
        for a, b in zip(trajectory.sample(one, 3), many, strict=True):
            np.testing.assert_array_equal(a, b[i])
    with pytest.raises(ValueError, match="derivatives: got 4"):
        trajectory.sample(0.0, 4)


def test_message_and_csv(tmp_path):
    trajectory = tk.time_path(ROBOT, random_path(np.random.default_rng(10), 5, "corners"))
    message = trajectory.to_message()
    assert message["joint_names"] == list(ROBOT.names)
    points = message["points"]
    times = [point["time_from_start"] for point in points]
    assert times[0] == 0.0
    assert times[-1] == trajectory.duration
    assert (np.diff(times) > 0).all()
    for name, i in (("positions", 0), ("velocities", 1), ("accelerations", 2)):
        rows = np.array([point[name] for point in points])
        np.testing.assert_allclose(rows, trajectory.sample(times)[i], atol=1e-6)
    trajectory.to_csv(tmp_path / "path.csv")
    same = tk.Trajectory.from_csv(tmp_path / "path.csv")
    assert same.joint_names == trajectory.joint_names
    for t in np.linspace(0, trajectory.duration, 11):
        np.testing.assert_array_equal(same.sample(t, 3), trajectory.sample(t, 3))
    with (tmp_path / "path.csv").open(newline="") as file:
        table = list(csv.reader(file))
    assert table[0][:2] == ["time", "q0 position"]
    assert len(table) == len(points) + 1


@pytest.mark.parametrize("text", ["", "a,b\n1,2\n", "time,x position,x velocity\n0,1,2\n"])
def test_other_tables_are_refused(tmp_path, text):
    (tmp_path / "other.csv").write_text(text)
    with pytest.raises(ValueError, match="path: got a table"):
        tk.Trajectory.from_csv(tmp_path / "other.csv")


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"times": [0.0, 0.0]}, "times: got what does not increase"),
        ({"times": [1.0, 2.0]}, "times: got what does not increase from 0"),
        ({"times": [0.0, np.inf]}, "times: got NaN or inf"),
        ({"positions": [[0.0], [np.nan]]}, "positions: got NaN"),
        ({"velocities": [[0.0]]}, r"velocities: got shape \(1, 1\), expected \(2, 1\)"),
    ],
)
def test_a_trajectory_checks_what_it_is_made_of(changed, message):
    rest = [[0.0], [0.0]]
    good = {"times": [0, 1], "positions": rest, "velocities": rest, "accelerations": rest}
    with pytest.raises(ValueError, match=message):
        tk.Trajectory(["x"], **{**good, **changed})


@pytest.mark.parametrize(("missing", "call"), [("toppra", "time_path"), ("ruckig", "move_to")])
def test_what_is_missing_is_named(missing, call):
    q = "[[0.0] * 6, [1.0] * 6]"
    arguments = q if call == "time_path" else f"*{q}"
    code = (
        f"import sys; sys.modules['{missing}'] = None\n"
        "import thing_kin as tk\n"
        f"try: tk.{call}(tk.robots.ur5(), {arguments})\n"
        "except ImportError as error: print(error)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "pip install thing_kin[timing]" in done.stdout
