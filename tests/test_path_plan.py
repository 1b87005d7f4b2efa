"""Whole-body paths: feasible by independent code, optimal, and honest where there is none."""

import dataclasses
from typing import Any

import numpy as np
import pytest

import thing_kin as tk
from arms import panda
from oracles import assert_close
from path_cases import CLEAR, Case, make_case, worst

THING = tk.robots.thing()
SEED = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
ROBOTS = {
    "thing": THING,
    "pioneer_lx_ur5": tk.robots.pioneer_lx_ur5(),
    "panda_on_base": tk.on_omni_base(panda(), name="panda_on_base"),
    "panda": panda(),
}


def forward(count: int, length: float = 3.0) -> tuple[Any, Any]:
    """Poses and base path of the user script: forward, up and down; the base path swings aside."""
    s = np.linspace(0.0, 1.0, count)
    poses = np.repeat(THING.fk(SEED)[None], count, axis=0)
    poses[:, 0, 3] += length * s
    poses[:, 2, 3] += 0.2 * np.sin(4 * np.pi * s)
    return poses, np.column_stack([length * s, 0.2 * np.sin(np.pi * s), np.zeros_like(s)])


DISC = tk.Disc(center=(1.5, 0.45), radius=0.5)


def script(count: int, **changes: Any) -> Case:
    poses, base = forward(count)
    options = {
        "base_path": base,
        "base_radius": 0.3,
        "obstacles": [DISC],
        "max_joint_step": 20.0 / count,
        **changes,
    }
    return Case(THING, poses, SEED, options, np.zeros((count, 9)))


def assert_feasible(case: Case, plan: tk.PathPlan) -> None:
    assert plan.success, plan.message
    assert plan.status == "converged"
    assert plan.failed_waypoint is None
    assert plan.failed_constraint is None
    missed = worst(case, plan.q)
    assert max(missed["position"], missed["rotation"]) < 1e-9
    # What the planner keeps inside of is wider than what rounding may bring it outside.
    assert max(v for k, v in missed.items() if k not in ("position", "rotation")) <= 0.0
    assert plan.constraint_violation == 0.0
    assert plan.position_error.max() < 1e-9
    assert plan.rotation_error.max() < 1e-9


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("seed", range(4))
def test_random_paths_are_followed(name: str, seed: int) -> None:
    case = make_case(ROBOTS[name], 100 + seed, count=30, obstacles=2)
    assert_feasible(case, case.plan())


def test_the_base_bends_around_the_disc() -> None:
    case = script(100)
    plan = case.plan()
    assert_feasible(case, plan)
    np.testing.assert_array_equal(plan.q[0], SEED)
    assert np.hypot(*(case.options["base_path"][:, :2] - DISC.center).T).min() < 0.3


def objective(case: Case, q: Any, weight: float) -> float:
    steps = 0.5 * float((np.diff(q, axis=0) ** 2).sum())
    return steps + weight * float(np.log(case.robot.dexterity(q)).sum())


def test_objective_is_what_it_says() -> None:
    plan = script(20).plan(dexterity_weight=0.01)
    assert_close(plan.objective, objective(script(20), plan.q, 0.01), 1e-12)
    assert_close(plan.dexterity, THING.dexterity(plan.q), 1e-9)
    lengths = np.sqrt(np.linspace(0.5, 2.0, 9))
    weighed = script(20).plan(joint_weights=lengths, dexterity_weight=0.0)
    expected = 0.5 * ((np.diff(weighed.q, axis=0) * lengths) ** 2).sum()
    assert_close(weighed.objective, expected, 1e-12)


def test_neighbors_that_keep_the_constraints_are_worse() -> None:
    """First and second order at once: feasible paths nearby, made by inverse kinematics."""
    case = script(12, obstacles=[], base_radius=0.8)  # by far enough
    plan = case.plan()
    rng = np.random.default_rng(1)
    weight = 1.0 / 12**2
    tried = 0
    for size in (1e-2, 1e-3):
        for _ in range(60):
            q = plan.q + size * rng.normal(size=plan.q.shape)
            q[0] = plan.q[0]
            near = tk.ik(THING, case.poses, q, max_step=0.2)
            q = np.vstack([plan.q[:1], near.q[1:]])
            missed = worst(case, q)
            del missed["position"], missed["rotation"]
            if near.success.all() and max(missed.values()) <= 0.0:
                tried += 1
                assert objective(case, q, weight) > plan.objective - 1e-9
    assert tried > 5


def test_more_freedom_is_no_worse() -> None:
    wide = script(25, base_radius=0.4).plan()
    narrow = script(25).plan()
    without = script(25, obstacles=[]).plan()
    assert wide.objective < narrow.objective
    assert without.objective <= narrow.objective + 1e-9


def test_better_than_task_priority() -> None:
    priority = script(40, obstacles=[]).plan(method="task_priority")
    plan = script(40, obstacles=[]).plan()
    assert priority.success, priority.message
    assert plan.objective < priority.objective


def test_task_priority_keeps_the_hand_first() -> None:
    case = script(60, obstacles=[])
    plan = case.plan(method="task_priority")
    assert plan.success, plan.message
    missed = worst(case, plan.q)
    assert max(missed["position"], missed["rotation"]) < 1e-8
    assert_close(plan.q[:, 6:], case.options["base_path"], 1e-5)  # the base can follow here
    np.testing.assert_array_equal(plan.q[0], SEED)


def test_task_priority_says_what_it_runs_into() -> None:
    plan = script(60).plan(method="task_priority")
    assert not plan.success
    assert plan.status == "infeasible"
    assert plan.failed_constraint is not None
    assert "the base" in plan.failed_constraint
    assert 15 < plan.failed_waypoint < 35  # type: ignore[operator]
    fast = script(60, obstacles=[], max_joint_step=0.02).plan(method="task_priority")
    assert fast.failed_constraint is not None
    assert "max_joint_step" in fast.failed_constraint


def test_a_path_through_pi() -> None:
    """The heading goes on beyond pi; windows are meant up to whole turns."""
    count = 40
    turn = np.linspace(0.0, 1.5 * np.pi, count)
    robot = THING.with_limits(lower=np.full(9, -20.0), upper=np.full(9, 20.0))
    q = SEED + np.column_stack([np.zeros((count, 8)), turn])
    base = np.column_stack([np.zeros((count, 2)), np.angle(np.exp(1j * turn))])
    plan = tk.plan_path(
        robot, robot.fk(q), seed=SEED, base_path=base, base_radius=0.1, heading=0.05
    )
    assert plan.success, plan.message
    assert np.abs(plan.q[:, 8] - turn).max() <= 0.05
    seed = SEED + 2 * np.pi * np.eye(9)[8]
    ahead = tk.plan_path(robot, robot.fk(q), seed=seed, base_path=base, heading=0.05)
    assert ahead.success, ahead.message
    assert np.abs(ahead.q[:, 8] - turn - 2 * np.pi).max() <= 0.05
    fixed = tk.plan_path(robot, robot.fk(q[:5]), seed=seed, heading=(-0.2, 0.7))
    assert fixed.success, fixed.message
    assert fixed.q[:, 8].min() >= 2 * np.pi - 0.2


def test_one_and_two_waypoints() -> None:
    for count in (1, 2):
        case = script(count, max_joint_step=4.0)
        plan = case.plan()
        if count == 1:
            assert_feasible(case, plan)
            np.testing.assert_array_equal(plan.q, SEED[None])
        else:
            assert_feasible(case, plan)


def test_a_seed_off_the_path_starts_nearby() -> None:
    case = script(30)
    seed = SEED + 0.05
    plan = dataclasses.replace(case, seed=seed).plan()
    assert_feasible(case, plan)
    assert np.abs(plan.q[0] - seed).max() < 0.3
    far = dataclasses.replace(case, seed=SEED + np.array([0, 0, 0, 0, 0, 0, -1.0, 0.5, 0])).plan()
    assert_feasible(case, far)


def test_five_hundred_waypoints() -> None:
    case = script(500)
    assert_feasible(case, case.plan())


def test_warm_start_takes_fewer_iterations() -> None:
    cold = script(50).plan()
    again = script(50).plan(warm_start=cold)
    assert again.success
    assert again.iterations <= 2
    assert_close(again.objective, cold.objective, 1e-9)
    moved = script(50, base_radius=0.29)
    warm = moved.plan(warm_start=cold.q)
    assert_feasible(moved, warm)
    assert warm.iterations <= moved.plan().iterations


def test_equal_input_gives_equal_output() -> None:
    first, second = script(40).plan(), script(40).plan()
    np.testing.assert_array_equal(first.q, second.q)
    assert first.iterations == second.iterations


def test_order_of_joints_does_not_matter() -> None:
    other = tk.robots.thing(order="base_first")
    places = [3, 4, 5, 6, 7, 8, 0, 1, 2]
    seed = np.empty(9)
    seed[places] = SEED
    case = script(25)
    plan = tk.plan_path(other, case.poses, seed=seed, **case.options)
    assert plan.success, plan.message
    assert_close(plan.objective, case.plan().objective, 1e-8)
    assert_close(plan.q[:, places], case.plan().q, 1e-4)


def test_arm_dexterity_differs() -> None:
    whole = script(25).plan(dexterity_weight=0.05)
    arm = script(25).plan(dexterity_weight=0.05, jacobian="arm")
    same = script(25).plan(dexterity_weight=0.05, jacobian=[1, 1, 1, 1, 1, 1, 0, 0, 0])
    assert_close(arm.q, same.q, 0.0)
    ur = tk.robots.ur10()
    assert_close(arm.dexterity, ur.dexterity(arm.q[:, :6]), 1e-8)
    assert ur.dexterity(arm.q[:, :6]).mean() < ur.dexterity(whole.q[:, :6]).mean()


def test_obstacles_are_checked_between_waypoints() -> None:
    """Two poses on either side of a thin disc: at both waypoints all is well."""
    poses, _ = forward(3, length=0.8)
    seed = SEED
    disc = tk.Disc(center=(0.2, 0.0), radius=0.03)
    free = tk.plan_path(THING, poses, seed=seed)
    base = free.q[:, 6:8]
    assert np.hypot(*(base - disc.center).T).min() > disc.radius
    case = Case(THING, poses, seed, {"obstacles": [disc]}, free.q)
    if worst(case, free.q)["clearance"] > 0.0:
        assert_feasible(case, case.plan())
    blocked = case.plan(warm_start=free)
    assert worst(case, blocked.q)["clearance"] <= 0.0


class TestNoSuchPath:
    def test_pose_out_of_reach(self) -> None:
        case = script(30, obstacles=[])
        case.poses[17, 2, 3] += 5.0
        for method in ("sqp", "task_priority"):
            plan = case.plan(method=method)
            assert (plan.success, plan.status) == (False, "infeasible")
            assert plan.failed_waypoint == 17
            assert plan.failed_constraint == "pose"
            assert "waypoint 17: pose" in plan.message
            assert np.isfinite(plan.q).all()
            assert plan.position_error[:17].max() < 1e-6

    def test_first_pose_out_of_reach(self) -> None:
        case = script(5)
        case.poses[0, 2, 3] += 9.0
        plan = case.plan()
        assert (plan.success, plan.failed_waypoint, plan.failed_constraint) == (False, 0, "pose")

    def test_base_disc_within_an_obstacle(self) -> None:
        plan = script(40, obstacles=[tk.Disc(center=(1.5, 0.2), radius=0.9)]).plan()
        assert (plan.success, plan.status) == (False, "infeasible")
        assert plan.failed_constraint is not None
        assert "base" in plan.failed_constraint
        assert 5 < plan.failed_waypoint < 25  # type: ignore[operator]

    def test_step_too_small(self) -> None:
        plan = script(40, max_joint_step=0.01).plan()
        assert (plan.success, plan.status) == (False, "infeasible")
        assert plan.constraint_violation > 0.01
        assert plan.failed_constraint is not None

    def test_seed_inside_an_obstacle(self) -> None:
        plan = script(10, obstacles=[tk.Disc(center=(0.05, 0.0), radius=0.1)]).plan()
        assert (plan.success, plan.failed_waypoint) == (False, 0)
        assert plan.failed_constraint == "the base and obstacle 0"

    def test_fixed_arm_beyond_its_reach(self) -> None:
        arm = tk.robots.ur10()
        poses = np.repeat(arm.fk(SEED[:6])[None], 20, axis=0)
        poses[:, 0, 3] += np.linspace(0.0, 2.0, 20)
        plan = tk.plan_path(arm, poses, seed=SEED[:6])
        assert (plan.success, plan.failed_constraint) == (False, "pose")
        assert plan.failed_waypoint is not None
        assert plan.position_error[: plan.failed_waypoint].max() < 1e-6


def test_a_six_joint_arm_has_no_choice() -> None:
    arm = tk.robots.ur10()
    q = SEED[:6] + np.linspace(0.0, 0.4, 20)[:, None]
    plan = tk.plan_path(arm, arm.fk(q), seed=q[0])
    assert plan.success, plan.message
    assert_close(plan.q, q, 1e-8)


@pytest.mark.parametrize(
    ("changes", "name"),
    [
        ({"base_radius": 0.0}, "base_radius"),
        ({"base_path": None}, "base_radius"),
        ({"base_path": np.zeros((3, 3))}, "base_path"),
        ({"base_path": np.full((10, 3), np.nan)}, "base_path"),
        ({"heading": -0.1}, "heading"),
        ({"heading": (1.0, 0.0)}, "heading"),
        ({"method": "best"}, "method"),
        ({"max_joint_step": 0.0}, "max_joint_step"),
        ({"max_joint_step": np.nan}, "max_joint_step"),
        ({"joint_weights": -1.0}, "joint_weights"),
        ({"jacobian": "leg"}, "jacobian"),
        ({"jacobian": [-1.0] * 9}, "jacobian"),
        ({"dexterity_weight": -1.0}, "dexterity_weight"),
        ({"max_iterations": 0}, "max_iterations"),
        ({"position_tolerance": 0.0}, "position_tolerance"),
        ({"obstacles": [tk.Sphere(center=(0, 0, 1), radius=0.1)]}, "spheres"),
        ({"obstacles": [3]}, "obstacles"),
        ({"warm_start": np.zeros((3, 9))}, "warm_start"),
        ({"frame": "nose"}, "frame"),
    ],
)
def test_misuse_names_the_argument(changes: dict[str, Any], name: str) -> None:
    with pytest.raises(ValueError, match=f"^{name}"):
        script(10, **changes).plan()


def test_misuse_of_poses_and_seed() -> None:
    case = script(10)
    bad = case.poses.copy()
    bad[3, 0, 3] = np.nan
    with pytest.raises(ValueError, match=r"^poses"):
        dataclasses.replace(case, poses=bad).plan()
    with pytest.raises(ValueError, match=r"^poses"):
        dataclasses.replace(case, poses=case.poses[:0]).plan()
    with pytest.raises(ValueError, match=r"^seed"):
        dataclasses.replace(case, seed=SEED[:4]).plan()
    with pytest.raises(ValueError, match=r"^robot"):
        tk.plan_path(
            tk.Chain.from_dh([tk.DH(a=1.0, joint="revolute")] * 3),
            np.eye(4)[None],
            seed=np.zeros(3),
        )


def test_the_cases_have_solutions() -> None:
    """What the random paths stand on: their witnesses."""
    case = make_case(THING, 5)
    missed = worst(case, case.witness)
    assert max(missed["position"], missed["rotation"]) < 1e-12
    assert missed["clearance"] < -0.5 * CLEAR
