"""Joint and wheel limits of a step: kept exactly, at the limit, on the way to it and outside."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import thing_kin as tk
from inverse_cases import HOME, ROBOT, SINGULAR_POSTURES

DT = 0.01
ARM = tk.Chain.from_dh(
    [
        tk.DH(
            a=a, joint="revolute", lower=-2.0, upper=1.5, velocity_limit=v, acceleration_limit=8.0
        )
        for a, v in ((0.5, 2.0), (0.4, 1.0), (0.3, 3.0))
    ]
)
THING = ROBOT.with_limits(
    velocity_limits=np.where(np.isfinite(ROBOT.velocity_limits), ROBOT.velocity_limits, 1.0),
    acceleration_limits=np.where(
        np.isfinite(ROBOT.acceleration_limits), ROBOT.acceleration_limits, 3.0
    ),
)
WHEELS = tk.WheelLimits(radius=0.1, k=0.6, speed=6.0)


def posture_solver(robot: tk.Chain, **options: object) -> tk.TaskPriority:
    return tk.TaskPriority(robot, [tk.PostureTask()], limits=True, dt=DT, **options)


def wheel_speeds(theta: float, base_step: np.ndarray, wheels: tk.WheelLimits) -> np.ndarray:
    """Those whose forward kinematics, [M17] (3.20), is the body twist: a pseudoinverse of it."""
    k = wheels.k
    forward = (wheels.radius / 4) * np.array(
        [[1, 1, 1, 1], [-1, 1, -1, 1], [-1 / k, -1 / k, 1 / k, 1 / k]]
    )
    c, s = np.cos(theta), np.sin(theta)
    twist = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) @ base_step / DT
    return np.linalg.pinv(forward) @ twist


def within(robot: tk.Chain, q: np.ndarray, dq: np.ndarray) -> bool:
    inside = np.all(q + dq <= robot.upper) and np.all(q + dq >= robot.lower)
    return bool(inside and np.all(np.abs(dq) <= robot.velocity_limits * DT))


@settings(max_examples=200, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from([1e-3, 1.0, 1e6]))
def test_position_and_velocity_hold_in_floating_point(seed: int, reach: float) -> None:
    rng = np.random.default_rng(seed)
    q = rng.uniform(THING.lower, THING.upper)
    at = rng.uniform(size=9) < 0.3
    q[at] = np.where(rng.uniform(size=9) < 0.5, THING.lower, THING.upper)[at]
    close = rng.uniform(size=9) < 0.2
    q[close] = np.nextafter(q, 0.0)[close]
    target = q + reach * rng.uniform(-1, 1, 9)
    solver = posture_solver(THING)
    dq = solver.step(q, [target])
    assert within(THING, q, dq)
    assert np.abs(solver.solve(q, [target]).residuals[0]).max() <= reach * 1.01 + 7


def test_a_free_posture_is_reached_and_a_limited_one_as_nearly_as_can_be() -> None:
    solver = posture_solver(THING, inverse=tk.Exact())
    wish = HOME + 1e-3
    np.testing.assert_allclose(solver.step(HOME, [wish]), wish - HOME, atol=1e-15)
    far = HOME + np.linspace(-1, 1, 9)
    expected = np.clip(far - HOME, -THING.velocity_limits * DT, THING.velocity_limits * DT)
    step = solver.solve(HOME, [far])
    np.testing.assert_allclose(step.dq, expected, atol=1e-15)
    np.testing.assert_array_equal(step.active_limits, np.sign(np.round(far - HOME, 12)))
    assert {k for k, s in zip(step.limit_kinds, step.active_limits, strict=True) if s} == {
        "velocity"
    }


def test_the_names_of_what_is_active() -> None:
    q = np.array([1.5 - 1e-3, 0.0, -2.0 + 1e-4])
    step = posture_solver(ARM).solve(q, [[2.0, 1.0, -3.0]])
    np.testing.assert_array_equal(step.active_limits, [1, 1, -1])
    assert step.active_limits.dtype == np.int8
    assert step.limit_kinds == ["position", "velocity", "position"]
    step = posture_solver(ARM).solve(np.zeros(3), [np.ones(3)], previous=np.zeros(3))
    assert step.limit_kinds == ["acceleration"] * 3
    np.testing.assert_allclose(step.dq, 8.0 * DT**2, rtol=1e-15)
    step = posture_solver(ARM, step_limit=1e-4).solve(np.zeros(3), [np.ones(3)])
    assert step.limit_kinds == ["step"] * 3
    assert step.dq.tolist() == [1e-4] * 3
    free = posture_solver(ARM).solve(np.zeros(3), [np.zeros(3)])
    assert free.limit_kinds == [""] * 3
    assert not free.active_limits.any()


@pytest.mark.parametrize("outside", [1e-12, 1e-3, 5.0])
def test_outside_it_comes_back_as_fast_as_the_velocity_bound_allows(outside: float) -> None:
    q = np.array([1.5 + outside, -2.0 - outside, 0.0])
    solver = posture_solver(ARM)
    step = solver.solve(q, [[4.0, -4.0, 0.0]])  # wants to go further out
    back = np.minimum(outside, ARM.velocity_limits * DT)
    np.testing.assert_allclose(step.dq[:2], [-back[0], back[1]], rtol=1e-3)
    np.testing.assert_array_equal(step.active_limits[:2], [1, -1])
    for _ in range(1000):
        q = q + solver.step(q, [[4.0, -4.0, 0.0]])
    assert q[0] == 1.5
    assert q[1] == -2.0


def test_outside_with_acceleration_limits_it_turns_round_first() -> None:
    q, dq = np.array([1.6, 0.0, 0.0]), np.array([0.005, 0.0, 0.0])
    solver = posture_solver(ARM)
    change = 8.0 * DT**2
    for i in range(400):
        new = solver.step(q, [[4.0, 0.0, 0.0]], previous=dq)
        assert new[0] <= 0.0 or q[0] <= 1.5  # no further out, even if that takes a jolt
        if i > 0:
            assert np.abs(new - dq).max() <= change * (1 + 1e-9)
        q, dq = q + new, new
    assert q[0] == pytest.approx(1.5, abs=1e-12)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_acceleration_and_position_hold_together(seed: int) -> None:
    """From rest, whatever is asked for: braking starts early enough, so that nothing conflicts."""
    rng = np.random.default_rng(seed)
    q, dq = rng.uniform(THING.lower, THING.upper), np.zeros(9)
    solver = posture_solver(THING, inverse=tk.Exact())
    change = THING.acceleration_limits * DT**2
    target = rng.uniform(-10, 10, 9)
    for i in range(150):
        if i % 40 == 0:
            target = rng.uniform(-10, 10, 9)
        new = solver.step(q, [target], previous=dq)
        assert within(THING, q, new)
        assert (np.abs(new - dq) <= change * (1 + 1e-9) + 1e-15).all()
        q, dq = q + new, new


def test_braking_is_as_late_as_can_be() -> None:
    """The limit is reached in the least number of steps: bang-bang, by brute force."""
    robot = tk.Chain.from_dh(
        [tk.DH(a=1.0, joint="revolute", lower=-1.0, upper=1.0, acceleration_limit=10.0)]
    )
    solver = posture_solver(robot, inverse=tk.Exact())
    change = 10.0 * DT**2
    q, dq, steps = np.array([0.0]), np.array([0.0]), 0
    while q[0] < 1.0 - 1e-12 and steps < 1000:
        dq = solver.step(q, [[5.0]], previous=dq)
        q = q + dq
        steps += 1
    # With v changes up and down the way is change * v^2 at most in 2 v - 1 steps, v (v + 1) in 2 v.
    least = next(k for k in range(1000) if change * ((k + 1) // 2) * (k // 2 + 1) >= 1.0 - 1e-12)
    assert steps == least
    assert q[0] <= 1.0


def test_sliding_along_a_limit_does_not_chatter() -> None:
    """A hand that is pulled beyond what a joint allows: the joint stays exactly at its limit."""
    q = np.array([0.2, 1.5, 0.4])
    solver = tk.TaskPriority(ARM, [tk.PositionTask()], limits=True, dt=DT)
    p = ARM.fk(q)[:3, 3]
    seen = []
    for i in range(300):
        angle = np.arctan2(p[1], p[0]) + 0.002 * i
        # Nearer to the shoulder than the elbow's limit allows.
        target = 0.5 * np.linalg.norm(p) * np.array([np.cos(angle), np.sin(angle), 0.0])
        step = solver.solve(q, [target])
        assert within(ARM, q, step.dq)
        seen.append(step.dq)
        q = q + step.dq
    assert q[1] == 1.5
    settled = np.array(seen[100:])
    assert (settled[:, 1] == 0.0).all()
    jumps = np.abs(np.diff(settled, axis=0)).max()
    assert jumps < 1e-5  # as smooth as the target


def test_wheels() -> None:
    tasks = [tk.BaseTask()]
    solver = tk.TaskPriority(THING, tasks, limits=True, dt=DT, wheel_limits=WHEELS)
    rng = np.random.default_rng(4)
    for _ in range(300):
        q = rng.uniform(-1, 1, 9)
        target = q[6:] + rng.uniform(-1, 1, 3) * rng.choice([0.001, 0.02, 1.0])
        step = solver.solve(q, [target])
        speeds = wheel_speeds(q[8], step.dq[6:], WHEELS)
        assert np.abs(speeds).max() <= WHEELS.speed + 1e-9
        expected = np.where(np.abs(speeds) > WHEELS.speed - 1e-6, np.sign(speeds), 0)
        np.testing.assert_array_equal(step.active_wheels, expected)
        assert within(THING, q, step.dq)
    assert wheel_speeds(0.0, np.array([DT, 0.0, 0.0]), WHEELS) == pytest.approx([10.0] * 4)


def test_zero_width_boxes_hold_joints_still() -> None:
    q = HOME.copy()
    lower, upper = ROBOT.lower.copy(), ROBOT.upper.copy()
    lower[2] = upper[2] = q[2]
    robot = ROBOT.with_limits(lower=lower, upper=upper)
    solver = tk.TaskPriority(robot, [tk.PoseTask()], limits=True, dt=DT, inverse=tk.Exact())
    step = solver.solve(q, [robot.fk(q + 1e-4)])
    assert step.dq[2] == 0.0
    assert np.abs(step.residuals[0]).max() < 1e-12  # the others do it
    frozen = ROBOT.with_limits(lower=q, upper=q)
    solver = tk.TaskPriority(frozen, [tk.PoseTask()], limits=True, dt=DT)
    assert not solver.step(q, [robot.fk(q + 0.1)]).any()


@pytest.mark.parametrize("name", SINGULAR_POSTURES)
def test_singular_postures_stay_bounded_without_any_velocity_limit(name: str) -> None:
    q = SINGULAR_POSTURES[name]
    free = ROBOT.with_limits(velocity_limits=np.full(9, np.inf))
    T = free.fk(q)
    for axis in range(6):
        xi = 0.01 * np.eye(6)[axis]
        goal = T.copy()
        goal[:3, 3] += xi[:3]
        goal[:3, :3] = tk.lie.so3_exp(xi[3:]) @ T[:3, :3]
        dq = tk.TaskPriority(free, [tk.PoseTask()], limits=True, dt=DT).step(q, [goal])
        assert np.linalg.norm(dq) <= 0.01 / (2 * np.sqrt(1e-4)) * (1 + 1e-9)


REFUSED = [
    ({"limits": True}, "dt: got None"),
    ({"limits": True, "dt": 0.0}, "dt: got 0"),
    ({"limits": True, "dt": -1.0}, "dt: got -1"),
    ({"limits": True, "dt": np.nan}, "dt: got nan"),
    ({"limits": True, "dt": np.inf}, "dt: got inf"),
    ({"dt": 0.1}, "dt: got 0.1 without limits"),
    ({"wheel_limits": WHEELS}, "wheel_limits: got"),
    ({"limits": True, "dt": DT, "scheme": "chiaverini"}, "scheme: got 'chiaverini' with limits"),
    ({"limits": True, "dt": DT, "inverse": tk.SelectivelyDamped()}, "inverse: got Selectively"),
    ({"limits": True, "dt": DT, "step_limit": -1.0}, "step_limit: got"),
]


@pytest.mark.parametrize(("options", "said"), REFUSED)
def test_options_that_make_no_sense(options: dict, said: str) -> None:
    with pytest.raises(ValueError, match=f"^{said}"):
        tk.TaskPriority(ROBOT, [tk.PoseTask()], **options)


def test_arguments_that_make_no_sense() -> None:
    for name in ("radius", "k", "speed"):
        for wrong in (0.0, -1.0, np.nan, np.inf):
            good = {"radius": 0.1, "k": 0.5, "speed": 5.0}
            with pytest.raises(ValueError, match=f"^{name}: got .*, expected"):
                tk.WheelLimits(**{**good, name: wrong})
    with pytest.raises(ValueError, match=r"^wheel_limits: got 'ur5'"):
        tk.TaskPriority(tk.robots.ur5(), [tk.PoseTask()], limits=True, dt=DT, wheel_limits=WHEELS)
    unlimited = tk.TaskPriority(ROBOT, [tk.PostureTask()])
    with pytest.raises(ValueError, match=r"^previous: got"):
        unlimited.step(HOME, [HOME], previous=HOME)
    for wrong in (HOME[:3], np.full(9, np.nan), "no"):
        with pytest.raises(ValueError, match=r"^previous: got"):
            posture_solver(ROBOT).step(HOME, [HOME], previous=wrong)
    assert not unlimited.limits
    assert posture_solver(ROBOT).limits
    assert unlimited.scheme == "chiaverini"
    assert posture_solver(ROBOT).scheme == "siciliano"
