"""plan_pose: problem (4.34), against numpy's kinematics, SciPy's SLSQP and brute force."""

import concurrent.futures

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.optimize import minimize

import pose_plan_cases
import thing_kin as tk
from arms import panda
from pose_plan_cases import draw, objective, violation
from strategies import seeds

ROBOT = tk.robots.thing()
SEED = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
T_GOAL = tk.transform(xyz=(1.2, -0.9, 0.9), rpy=(0.0, np.pi / 2, 0.0))
DISC = {"base_goal": (0.6, 0.0), "base_radius": 0.3}


@pytest.mark.parametrize("limit", [2 * np.pi, np.pi])
@pytest.mark.parametrize("start", ["near", "far"])
def test_random_instances_are_solved(limit: float, start: str) -> None:
    rng = np.random.default_rng(11)
    for i in range(250):
        case = draw(rng, limit)
        plan = case.solve(getattr(case, start))
        assert plan.success, f"instance {i}: {plan}"
        assert violation(case, plan.q) < 1e-7
        assert plan.objective == pytest.approx(objective(case.robot, plan.q), rel=1e-6)


def test_slsqp_finds_nothing_better_from_there() -> None:
    rng = np.random.default_rng(12)
    for _ in range(15):
        case = draw(rng)
        plan = case.solve(case.near)
        low, high = case.options["heading"]
        goal, radius = case.options["base_goal"], case.options["base_radius"]
        (disc,) = case.options["obstacles"]
        other = minimize(
            lambda q, case=case: np.log(objective(case.robot, q)),
            plan.q,
            method="SLSQP",
            bounds=[*zip(case.robot.lower[:8], case.robot.upper[:8], strict=True), (low, high)],
            constraints=[
                {"type": "eq", "fun": lambda q, c=case: tk.pose_error(c.robot.fk(q), c.T_goal)},
                {
                    "type": "ineq",
                    "fun": lambda q, g=goal, r=radius: r**2 - np.sum((q[6:8] - g) ** 2),
                },
                {
                    "type": "ineq",
                    "fun": lambda q, d=disc: np.sum((q[6:8] - d.center) ** 2) - d.radius**2,
                },
            ],
            options={"ftol": 1e-12, "maxiter": 200},
        )
        if violation(case, other.x) < 1e-7:
            assert objective(case.robot, other.x) > plan.objective * (1 - 1e-5)


def test_the_best_of_all_agrees_with_many_local_searches() -> None:
    rng = np.random.default_rng(13)
    within = 0
    for _ in range(15):
        case = draw(rng)
        best = case.solve(case.near, search="global")
        assert best.success
        assert violation(case, best.q) < 1e-7
        plans = [case.solve(seed) for seed in case.robot.random(80, rng=rng)]
        least = min(plan.objective for plan in plans if plan.success)
        within += best.objective <= least * 1.001
    assert within >= 14


def test_the_best_samples_come_first() -> None:
    rng = np.random.default_rng(14)
    near_best = 0
    for _ in range(30):
        case = draw(rng)
        few = case.solve(case.far, search="global", descents=3)
        best = case.solve(case.far, search="global")
        near_best += few.objective <= 1.01 * best.objective
    assert near_best >= 25  # 28; 10 where the worst come first


def test_the_users_example() -> None:
    wall = tk.Disc(center=(0.6, 0.6), radius=0.4)
    options = {**DISC, "heading": (-np.pi / 4, np.pi / 4), "obstacles": [wall]}
    plan = tk.plan_pose(ROBOT, T_GOAL, seed=SEED, **options)
    assert plan.success, plan.message
    best = tk.plan_pose(ROBOT, T_GOAL, seed=SEED, search="global", **options)
    assert best.objective <= plan.objective + 1e-9


def test_the_arm_alone_counts_if_asked() -> None:
    whole = tk.plan_pose(ROBOT, T_GOAL, seed=SEED, search="global", **DISC)
    arm = tk.plan_pose(ROBOT, T_GOAL, seed=SEED, search="global", jacobian="arm", **DISC)
    weights = np.array([1.0] * 6 + [0.0] * 3)
    same = tk.plan_pose(ROBOT, T_GOAL, seed=SEED, search="global", jacobian=weights, **DISC)
    assert arm.objective == same.objective

    def of_arm(q: np.ndarray) -> float:
        s = np.linalg.svd(ROBOT.jacobian(q)[:, :6], compute_uv=False)
        return float(np.sqrt(s[0] / s[-1] / np.prod(s)))

    assert arm.objective == pytest.approx(of_arm(arm.q), rel=1e-6)
    assert of_arm(arm.q) < of_arm(whole.q)
    assert objective(ROBOT, whole.q) < objective(ROBOT, arm.q)


def test_a_window_of_heading_may_cross_half_a_turn() -> None:
    free = ROBOT.with_limits(lower=[*ROBOT.lower[:8], -20.0], upper=[*ROBOT.upper[:8], 20.0])
    plan = tk.plan_pose(free, T_GOAL, seed=SEED, heading=(3.0, 3.6), **DISC)
    assert plan.success
    assert 3.0 <= plan.q[8] <= 3.6


def test_link_spheres_keep_clear_of_shapes() -> None:
    shape = tk.LinkSpheres.along_links(ROBOT, radius=0.06, spacing=0.1)
    free = tk.plan_pose(ROBOT, T_GOAL, seed=SEED, **DISC)
    centers = shape.centers(ROBOT, free.q)
    ball = tk.Sphere(center=centers[len(centers) // 2] + (0.0, 0.0, 0.05), radius=0.1)
    plan = tk.plan_pose(ROBOT, T_GOAL, seed=SEED, obstacles=[ball], spheres=shape, **DISC)
    assert plan.success, plan.message

    def clearance(q: np.ndarray) -> float:
        gaps = np.linalg.norm(shape.centers(ROBOT, q) - ball.center, axis=1) - 0.06 - 0.1
        return float(gaps.min())

    assert clearance(free.q) < -0.01
    assert clearance(plan.q) > -1e-7


@pytest.mark.parametrize(
    "robot", [tk.robots.ur10(), panda(), tk.robots.pioneer_lx_ur5()], ids=lambda r: r.name
)
def test_any_robot(robot: tk.Chain) -> None:
    rng = np.random.default_rng(14)
    lower, upper = np.maximum(robot.lower, -2.5), np.minimum(robot.upper, 2.5)
    for _ in range(30):
        drawn = rng.uniform(lower, upper)
        plan = tk.plan_pose(robot, robot.fk(drawn), seed=rng.uniform(lower, upper))
        assert plan.success, plan.message
        np.testing.assert_allclose(robot.fk(plan.q), robot.fk(drawn), atol=1e-7)
        assert np.all((plan.q >= robot.lower) & (plan.q <= robot.upper))


def test_a_fixed_arm_of_six_joints_takes_its_best_branch() -> None:
    arm = tk.robots.ur10()
    target = arm.fk(np.array([0.3, -1.0, 1.3, -0.7, 1.1, 0.2]))
    best = tk.plan_pose(arm, target, search="global")
    branches = tk.ik_all(arm, target)
    assert best.objective == pytest.approx(min(objective(arm, q) for q in branches.q), rel=1e-9)


def test_no_base_goal_is_no_constraint_on_the_base() -> None:
    plan = tk.plan_pose(ROBOT, tk.transform(xyz=(4.0, -4.0, 0.9)), seed=SEED)
    assert plan.success


def test_out_of_reach_says_so() -> None:
    plan = tk.plan_pose(ROBOT, tk.transform(xyz=(9.0, 0.0, 1.0)), seed=SEED, **DISC)
    assert (plan.success, plan.status) == (False, "infeasible")
    assert "the hand's position" in plan.message
    assert 5.0 < plan.constraint_violation < 8.0  # the hand is as near as it was brought
    assert np.all(np.isfinite(plan.q))


def test_disjoint_discs_say_so() -> None:
    obstacle = tk.Disc(center=(0.6, 0.0), radius=0.5)
    plan = tk.plan_pose(ROBOT, T_GOAL, seed=SEED, obstacles=[obstacle], **DISC)
    assert plan.status == "infeasible"
    assert "obstacle 0" in plan.message
    assert plan.constraint_violation >= 0.1 - 1e-9  # disc and obstacle are 0.2 m apart


@pytest.mark.parametrize(
    "options", [{"heading": (4.0, 5.0)}, {"base_goal": (9.0, 0.0), "base_radius": 1.0}]
)
def test_goals_outside_the_limits_say_so(options: dict[str, object]) -> None:
    plan = tk.plan_pose(ROBOT, T_GOAL, seed=SEED, **options)  # type: ignore[arg-type]
    assert plan.status == "infeasible"
    assert "limits of joint" in plan.message
    assert plan.constraint_violation > 0.8
    assert np.all((plan.q >= ROBOT.lower) & (plan.q <= ROBOT.upper))


def test_out_of_iterations_says_so() -> None:
    plan = tk.plan_pose(ROBOT, T_GOAL, seed=SEED, max_iterations=1, max_restarts=0, **DISC)
    assert (plan.success, plan.status) == (False, "budget")


def test_the_result_depends_on_arguments_alone() -> None:
    case = draw(np.random.default_rng(15))
    planner = tk.PosePlanner(case.robot, **case.options, search="global")
    once = planner.solve(case.T_goal, case.far)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        plans = pool.map(lambda _: planner.solve(case.T_goal, case.far), range(8))
    for plan in plans:
        assert np.array_equal(plan.q, once.q)
    other = case.solve(case.far, search="global", rng=7)
    assert other.success


@settings(max_examples=40, deadline=None)
@given(seed=seeds)
def test_moving_the_world_moves_the_base(seed: int) -> None:
    """The whole scene shifted and turned: the optimum moves with it."""
    case = draw(np.random.default_rng(seed))
    rng = np.random.default_rng(seed + 1)
    x, y, turn = rng.uniform(-3, 3, 3)
    move = tk.transform(xyz=(x, y, 0.0), rpy=(0.0, 0.0, turn))

    def moved(point: np.ndarray) -> np.ndarray:
        return (move @ np.array([*point, 0.0, 1.0]))[:2]

    (disc,) = case.options["obstacles"]
    low, high = case.options["heading"]
    plan = case.solve(case.near)
    q = plan.q.copy()
    q[6:8], q[8] = moved(q[6:8]), q[8] + turn
    other = tk.plan_pose(
        case.robot,
        move @ case.T_goal,
        seed=q,
        base_goal=moved(case.options["base_goal"]),
        base_radius=case.options["base_radius"],
        heading=(low + turn, high + turn),
        obstacles=[tk.Disc(center=moved(disc.center), radius=disc.radius)],
    )
    assert plan.success
    assert other.success
    assert other.objective == pytest.approx(plan.objective, rel=1e-6)
    np.testing.assert_allclose(other.q, q, atol=1e-3)


@pytest.mark.parametrize(
    ("options", "name"),
    [
        ({"base_goal": (0.0, 0.0)}, "base_radius"),
        ({"base_radius": 0.3}, "base_goal"),
        ({"base_goal": (0.0, 0.0), "base_radius": 0.0}, "base_radius"),
        ({"base_goal": (0.0, 0.0), "base_radius": np.nan}, "base_radius"),
        ({"base_goal": (0.0, np.nan), "base_radius": 0.3}, "base_goal"),
        ({"heading": (1.0, 0.0)}, "heading"),
        ({"heading": (np.nan, 0.0)}, "heading"),
        ({"jacobian": "leg"}, "jacobian"),
        ({"jacobian": [-1.0] * 9}, "jacobian"),
        ({"jacobian": [1.0] * 8}, "jacobian"),
        ({"search": "everywhere"}, "search"),
        ({"max_iterations": 0}, "max_iterations"),
        ({"descents": 0}, "descents"),
        ({"tolerance": 0.0}, "tolerance"),
        ({"tolerance": np.nan}, "tolerance"),
        ({"frame": "foot"}, "frame"),
        ({"obstacles": [3]}, "obstacles"),
        ({"obstacles": [tk.Sphere(center=(1, 0, 0), radius=0.1)]}, "spheres"),
        ({"seed": [np.nan] * 9}, "seed"),
        ({"seed": [0.0] * 8}, "seed"),
        ({"target": np.zeros((4, 4))}, "target"),
    ],
)
def test_bad_arguments_are_named(options: dict[str, object], name: str) -> None:
    arguments = {"target": T_GOAL, **options}
    with pytest.raises(ValueError, match=rf"^{name}"):
        tk.plan_pose(ROBOT, **arguments)  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["base_goal", "heading"])
def test_a_robot_without_base_has_no_goal_for_it(name: str) -> None:
    options = {
        "base_goal": {"base_goal": (0, 0), "base_radius": 1.0},
        "heading": {"heading": (0, 1)},
    }
    with pytest.raises(ValueError, match=rf"^{name}"):
        tk.plan_pose(tk.robots.ur10(), T_GOAL, **options[name])


def test_five_joints_are_too_few() -> None:
    with pytest.raises(ValueError, match=r"^robot"):
        tk.plan_pose(tk.Chain.from_dh([tk.DH(a=0.3, joint="revolute")] * 5), T_GOAL)


def test_cases_are_feasible_where_they_were_drawn() -> None:
    rng = np.random.default_rng(16)
    for _ in range(50):
        case = pose_plan_cases.draw(rng)
        assert violation(case, case.drawn) < 1e-9
