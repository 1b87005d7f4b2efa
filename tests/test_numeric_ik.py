"""Numerical inverse kinematics: what it calls a solution is one; if not, a reason."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

import thing_kin as tk
from ik_cases import ROBOTS, beside_limits, beside_singularities, check, wide_thing
from strategies import Case, cases, seeds

Vector = NDArray[np.float64]
Sample = Callable[[tk.Chain, Vector], Vector]


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("place", [lambda _, q: q, beside_limits, beside_singularities])
def test_reachable_targets_are_reached(name: str, place: Sample) -> None:
    robot = ROBOTS[name]()
    q = place(robot, robot.random(300, rng=1))
    targets = robot.fk(q)
    results = tk.ik(robot, targets, seed=robot.random(300, rng=2))
    assert results.success.all(), next(r.message for r in results if not r.success)
    check(robot, targets, results)


@pytest.mark.parametrize("margin", [0.0, 10.0, 100.0])
def test_far_from_the_origin(margin: float) -> None:
    robot = wide_thing(margin)
    targets = robot.fk(robot.random(300, rng=3))
    results = tk.ik(robot, targets, seed=np.zeros(9))
    assert results.success.all()
    check(robot, targets, results)


@pytest.mark.parametrize("inwards", [1e-3, 1e-6, 1e-9, 1e-12])
def test_at_the_boundary_of_the_workspace(inwards: float) -> None:
    """A stretched arm, and the target drawn back towards the shoulder by so much."""
    arm = tk.robots.ur10()
    rng = np.random.default_rng(4)
    q = np.zeros((50, 6))
    q[:, [0, 1, 4, 5]] = rng.uniform(-3, 3, (50, 4))
    q[:, 3] = rng.uniform(0.5, 2.5, 50) * rng.choice([-1, 1], 50)
    targets = arm.fk(q)
    shoulder, wrist = arm.fk(q, frame=1)[:, :3, 3], arm.fk(q, frame=3)[:, :3, 3]
    way = shoulder - wrist
    targets[:, :3, 3] += inwards * way / np.linalg.norm(way, axis=1, keepdims=True)
    results = tk.ik(arm, targets, position_tolerance=1e-8, rotation_tolerance=1e-8)
    assert results.success.all(), next(r.message for r in results if not r.success)
    check(arm, targets, results, 1e-8)


@given(cases(max_rows=9), seeds, seeds)
def test_any_chain(case: Case, goal: int, start: int) -> None:
    chain = limited(case.chain)
    target = chain.fk(chain.random(rng=goal))
    result = tk.ik(chain, target, seed=chain.random(rng=start))
    assert np.all((result.q >= chain.lower) & (result.q <= chain.upper))
    error = tk.pose_error(chain.fk(result.q), target)
    np.testing.assert_allclose(result.position_error, np.linalg.norm(error[:3]), atol=1e-12)
    np.testing.assert_allclose(result.rotation_error, np.linalg.norm(error[3:]), atol=1e-7)
    assert result.success == (result.position_error <= 1e-7 and result.rotation_error <= 1e-7)
    assert result.success == (result.status == "success")


def limited(chain: tk.Chain) -> tk.Chain:
    """Slides need limits to draw from; a continuous joint can have none."""
    turns = np.array([joint == "continuous" for joint in chain.joint_types])
    return chain.with_limits(
        lower=np.where(turns, -np.inf, np.maximum(chain.lower, -2.0)),
        upper=np.where(turns, np.inf, np.minimum(chain.upper, 2.5)),
    )


def test_the_seed_is_the_answer_where_it_is_one() -> None:
    robot = tk.robots.thing()
    q = robot.random(rng=5)
    result = tk.ik(robot, robot.fk(q), seed=q)
    np.testing.assert_array_equal(result.q, q)
    assert (result.iterations, result.restarts) == (1, 0)


def test_a_seed_beyond_the_limits_is_brought_inside() -> None:
    robot = tk.robots.thing()
    T = robot.fk(robot.random(rng=5))
    result = tk.ik(robot, T, seed=np.full(9, 1e6))
    assert result.success
    check(robot, T, result)


@pytest.mark.parametrize("threads", [2, 3, 4])
def test_results_do_not_depend_on_threads(threads: int) -> None:
    arm = tk.robots.ur5()
    targets = arm.fk(arm.random(200, rng=6))
    targets[::10, :3, 3] *= 3.0  # some out of reach
    one = tk.ik(arm, targets, threads=1)
    many = tk.ik(arm, targets, threads=threads)
    for field in ("q", "success", "status", "position_error", "iterations", "restarts"):
        np.testing.assert_array_equal(getattr(one, field), getattr(many, field))


def test_a_row_is_a_call() -> None:
    arm = tk.robots.ur5()
    targets, starts = arm.fk(arm.random(20, rng=7)), arm.random(20, rng=8)
    many = tk.ik(arm, targets, seed=starts, rng=3)
    for i in range(20):
        one = tk.ik(arm, targets[i], seed=starts[i], rng=3)
        np.testing.assert_array_equal(one.q, many[i].q)
        assert one.message == many.message[i]


def test_success_is_what_forward_kinematics_says() -> None:
    """With tolerances of rounding size the solver's own errors and the verifying ones differ."""
    robot = tk.robots.thing()
    q = robot.random(500, rng=25)
    tolerance = 3e-16
    results = tk.ik(
        robot,
        robot.fk(q),
        seed=q,
        position_tolerance=tolerance,
        rotation_tolerance=tolerance,
        max_restarts=0,
    )
    met = (results.position_error <= tolerance) & (results.rotation_error <= tolerance)
    np.testing.assert_array_equal(results.success, met)
    assert 0 < np.count_nonzero(met) < 500  # the tolerance does divide them


def test_hopeless_descents_are_given_up() -> None:
    """Half of the descents of this arm stall: no more than a few iterations go into one."""
    panda = ROBOTS["panda"]()
    results = tk.ik(panda, panda.fk(panda.random(300, rng=26)), seed=panda.random(300, rng=27))
    assert results.restarts.sum() > 150
    assert np.sum(results.iterations) / np.sum(results.restarts + 1) < 12.0


def test_rng_chooses_the_restarts() -> None:
    arm = ROBOTS["panda"]()
    T = arm.fk(arm.random(rng=9))
    first = tk.ik(arm, T, rng=1)
    np.testing.assert_array_equal(first.q, tk.ik(arm, T, rng=1).q)
    others = [tk.ik(arm, T, rng=k) for k in range(2, 12)]
    assert all(other.success for other in others)
    assert any(not np.array_equal(other.q, first.q) for other in others)
    generator = np.random.default_rng(0)
    drawn = [tk.ik(arm, T, rng=generator).q for _ in range(10)]
    assert len({q.tobytes() for q in drawn}) > 1


def test_every_level_of_instructions_reaches() -> None:
    best = tk.simd_level()
    arm = tk.robots.ur10()
    targets = arm.fk(arm.random(100, rng=10))
    try:
        for level in ("baseline", "avx2", "avx512"):
            try:
                tk.use_simd_level(level)
            except ValueError:
                continue
            results = tk.ik(arm, targets)
            assert results.success.all()
            check(arm, targets, results)
    finally:
        tk.use_simd_level(best)


class TestParts:
    def test_position(self) -> None:
        arm = tk.robots.ur10()
        points = arm.fk(arm.random(50, rng=11))[:, :3, 3]
        results = tk.ik(arm, points, task="position")
        assert results.success.all()
        np.testing.assert_allclose(arm.fk(results.q)[:, :3, 3], points, atol=1.01e-7)
        np.testing.assert_array_equal(results.rotation_error, 0.0)

    def test_orientation(self) -> None:
        arm = tk.robots.ur10()
        turns = arm.fk(arm.random(50, rng=12))[:, :3, :3]
        results = tk.ik(arm, turns, task="orientation")
        assert results.success.all()
        np.testing.assert_allclose(arm.fk(results.q)[:, :3, :3], turns, atol=1.01e-7)
        np.testing.assert_array_equal(results.position_error, 0.0)

    @pytest.mark.parametrize("free", range(6))
    @pytest.mark.parametrize("axes", ["target", "world"])
    def test_a_free_coordinate(self, free: int, axes: str) -> None:
        """Targets that five joints miss by that coordinate alone; the others are met."""
        arm = tk.robots.ur10()
        lower, upper = arm.lower.copy(), arm.upper.copy()
        lower[5] = upper[5] = 0.3  # five joints are left
        short = arm.with_limits(lower=lower, upper=upper)
        twist = np.zeros(6)
        twist[free] = 0.4
        shift, turn = twist[:3], Rotation.from_rotvec(twist[3:]).as_matrix()
        targets = short.fk(short.random(30, rng=13))
        if axes == "world":
            targets[:, :3, 3] += shift
            targets[:, :3, :3] = turn @ targets[:, :3, :3]
        else:
            targets[:, :3, 3] += targets[:, :3, :3] @ shift
            targets[:, :3, :3] = targets[:, :3, :3] @ turn
        weights = np.where(twist == 0.0, 1.0, 0.0)
        results = tk.ik(short, targets, weights=weights, weight_axes=axes)
        assert results.success.mean() > 0.95  # a stretched arm has solutions that are hard to hit
        q, targets = results.q[results.success], targets[results.success]
        error = tk.pose_error(short.fk(q), targets).reshape(-1, 2, 3)
        if axes == "target":
            error = np.einsum("nji,nkj->nki", targets[:, :3, :3], error)
        error = error.reshape(-1, 6)
        np.testing.assert_allclose(error[:, weights > 0], 0.0, atol=1.01e-7)
        assert np.abs(error[:, free]).max() > 1e-2
        np.testing.assert_array_equal(results.q[:, 5], 0.3)

    @pytest.mark.parametrize("axes", ["target", "world"])
    def test_free_coordinates_may_be_anywhere(self, axes: str) -> None:
        """Beyond reach in a coordinate that does not count, and the base does not drive there."""
        robot = tk.robots.thing()
        starts = robot.random(50, rng=31)
        targets = robot.fk(starts + np.r_[np.full(6, 0.05), np.zeros(3)])
        away = np.array([1e3, 0.0, 0.0])
        targets[:, :3, 3] += targets[:, :3, :3] @ away if axes == "target" else away
        weights = (0, 1, 1, 1, 1, 1)
        results = tk.ik(robot, targets, seed=starts, weights=weights, weight_axes=axes)
        assert results.success.all()
        assert np.abs(results.q - starts).max() < 1.0
        targets[:, :3, 3] += 1e3  # now in the others too
        far = tk.ik(robot, targets, seed=starts, weights=weights, weight_axes=axes)
        assert not far.success.any()

    def test_free_turn_about_the_tool(self) -> None:
        """What differs from the target is a turn about its own z."""
        robot = tk.robots.thing()
        T = robot.fk(robot.random(rng=14))
        result = tk.ik(robot, T, weights=(1, 1, 1, 1, 1, 0))
        assert result.success
        twist = tk.pose_error(robot.fk(result.q), T, frame="body")
        np.testing.assert_allclose(twist[[0, 1, 2, 3, 4]], 0.0, atol=1e-6)

    def test_weights_shift_the_compromise(self) -> None:
        arm = tk.robots.ur5()
        T = tk.transform(xyz=(2.0, 0.3, 0.4), rpy=(0.3, -0.5, 1.0))
        turned = tk.ik(arm, T, weights=(1, 1, 1, 10, 10, 10))
        near = tk.ik(arm, T, weights=(10, 10, 10, 1, 1, 1))
        assert turned.rotation_error < near.rotation_error
        assert near.position_error < turned.position_error

    def test_another_frame(self) -> None:
        robot = tk.robots.thing()
        T = robot.fk(robot.random(rng=15), frame="wrist_1")
        result = tk.ik(robot, T, frame="wrist_1", seed=np.zeros(9))
        assert result.success
        np.testing.assert_allclose(robot.fk(result.q, frame="wrist_1"), T, atol=1e-6)
        np.testing.assert_array_equal(result.q[4:6], 0.0)  # beyond the frame: nothing moves them


class TestNear:
    @given(seeds)
    def test_max_step_is_never_exceeded(self, seed: int) -> None:
        robot = tk.robots.thing()
        rng = np.random.default_rng(seed)
        q = robot.random(rng=rng)
        step = rng.uniform(0.01, 0.5, 9)
        result = tk.ik(robot, robot.fk(robot.random(rng=rng)), seed=q, max_step=step)
        assert np.all(np.abs(result.q - q) <= step)
        assert result.success or result.status in ("step_bound", "limited", "unreachable")
        near = np.clip(q + rng.uniform(-1, 1, 9) * step, robot.lower, robot.upper)
        assert tk.ik(robot, robot.fk(near), seed=q, max_step=step).success

    def test_fails_rather_than_jumps(self) -> None:
        """A target that only another branch reaches within the step."""
        arm = tk.robots.ur10()
        q = np.array([0.2, -1.2, 1.5, -0.4, 0.9, 0.1])
        T = arm.fk(q)
        T[:3, 3] += [0.0, 0.3, 0.0]
        free = tk.ik(arm, T, seed=q)
        bound = tk.ik(arm, T, seed=q, max_step=0.1)
        assert free.success
        assert bound.status == "step_bound"
        assert "max_step" in bound.message
        assert np.abs(bound.q - q).max() <= 0.1

    @pytest.mark.parametrize("name", ["ur5", "panda", "thing"])
    def test_nearest_is_at_least_as_near(self, name: str) -> None:
        robot = ROBOTS[name]()
        rng = np.random.default_rng(16)
        for _ in range(10):
            seed, T = robot.random(rng=rng), robot.fk(robot.random(rng=rng))
            nearest = tk.ik(robot, T, seed=seed, nearest=True)
            assert nearest.success
            check(robot, T, nearest)
            others = [tk.ik(robot, T, seed=seed, rng=k) for k in range(5)]
            best = min(np.linalg.norm(other.q - seed) for other in others)
            assert np.linalg.norm(nearest.q - seed) <= best + 1e-6

    def test_a_heavy_base_moves_less(self) -> None:
        robot = tk.robots.thing()
        rng = np.random.default_rng(17)
        light, heavy = 0.0, 0.0
        weights = np.array([1.0] * 6 + [100.0] * 3)
        for _ in range(20):
            q = robot.random(rng=rng)
            T = robot.fk(np.clip(q + rng.uniform(-0.3, 0.3, 9), robot.lower, robot.upper))
            light += np.linalg.norm(tk.ik(robot, T, seed=q).q[6:] - q[6:])
            result = tk.ik(robot, T, seed=q, joint_weights=weights)
            assert result.success
            heavy += np.linalg.norm(result.q[6:] - q[6:])
        assert heavy < 0.5 * light


class TestObjectives:
    """A local optimum: no motion that keeps the target and the limits lessens the measure."""

    @pytest.mark.parametrize("objective", ["seed", "limits", "manipulability"])
    @pytest.mark.parametrize("name", ["panda", "thing"])
    def test_is_a_local_optimum(self, objective: str, name: str) -> None:
        robot = ROBOTS[name]()
        rng = np.random.default_rng(18)
        for _ in range(5):
            start, T = robot.random(rng=rng), robot.fk(robot.random(rng=rng))
            result = tk.ik(robot, T, seed=start, objective=objective, rng=1)
            plain = tk.ik(robot, T, seed=start, rng=1)
            assert result.success
            check(robot, T, result)

            def measure(q: Vector, start: Vector = start) -> float:
                if objective == "manipulability":
                    return -float(np.log(robot.manipulability(q)))
                if objective == "seed":
                    return 0.5 * float(np.sum((q - start) ** 2))
                middle, span = (robot.lower + robot.upper) / 2, robot.upper - robot.lower
                return 0.5 * float(np.sum(((q - middle) / span) ** 2))

            assert measure(result.q) <= measure(plain.q) + 1e-9
            free = (result.active_limits == 0).nonzero()[0]
            Z = tk.null_space(robot.jacobian(result.q)[:, free])
            h = 1e-5
            for z in Z.T:
                step = np.zeros_like(result.q)
                step[free] = h * z
                slope = (measure(result.q + step) - measure(result.q - step)) / (2 * h)
                scale = 1.0 if objective == "manipulability" else measure(result.q) + 1e-3
                assert abs(slope) < 5e-2 * scale

    def test_without_freedom_it_changes_nothing(self) -> None:
        arm = tk.robots.ur10()
        T = arm.fk(arm.random(rng=19))
        plain, other = tk.ik(arm, T), tk.ik(arm, T, objective="limits")
        np.testing.assert_allclose(plain.q, other.q, atol=1e-6)


class TestFailure:
    @given(seeds)
    def test_the_closest_pose_is_stationary_and_has_a_reason(self, seed: int) -> None:
        arm = tk.robots.ur5()
        rng = np.random.default_rng(seed)
        T = arm.fk(arm.random(rng=rng))
        T[:3, 3] *= rng.uniform(2.0, 5.0) / np.linalg.norm(T[:3, 3])
        result = tk.ik(arm, T)
        assert result.status == "unreachable"
        assert "beyond reach" in result.message
        assert np.all(np.isfinite(result.q))
        reach = np.linalg.norm(T[:3, 3]) - result.position_error
        assert reach < 1.3  # links of 0.425, 0.39, ... m

    @pytest.mark.parametrize("closed_form", [True, False])
    @pytest.mark.parametrize("distance", [1.2, 2.0, 8.0])
    def test_no_other_solver_comes_nearer(self, distance: float, closed_form: bool) -> None:
        arm = tk.robots.ur5()
        rng = np.random.default_rng(20)
        turn = Rotation.random(random_state=1).as_matrix()
        T = tk.transform(xyz=distance * np.array([0.6, -0.64, 0.48]))
        T[:3, :3] = turn
        length = 0.3 * link_lengths(arm)
        result = tk.ik(arm, T, closed_form=closed_form)

        def residual(q: Vector) -> Vector:
            error = tk.pose_error(arm.fk(q), T)
            return np.r_[error[:3] / length, error[3:]]

        best = min(
            least_squares(residual, arm.random(rng=rng), bounds=(arm.lower, arm.upper)).cost
            for _ in range(30)
        )
        assert 0.5 * np.sum(residual(result.q) ** 2) <= best * (1 + 1e-6)

    def test_limits_are_named(self) -> None:
        """Where limits hold it back, the reason names them, and without them it goes on."""
        panda = ROBOTS["panda"]()
        named = 0
        rng = np.random.default_rng(21)
        wide = panda.with_limits(lower=np.full(7, -np.pi), upper=np.full(7, np.pi))
        for _ in range(60):
            T = wide.fk(wide.random(rng=rng))
            result = tk.ik(panda, T)
            if result.status != "limited":
                continue
            named += 1
            for joint, side in zip(panda.names, result.active_limits, strict=True):
                text = f"joint '{joint}' at its {'lower' if side < 0 else 'upper'} limit"
                assert (text in result.message) == (side != 0)
            at = np.where(result.active_limits < 0, panda.lower, panda.upper)
            held = result.active_limits != 0
            np.testing.assert_array_equal(result.q[held], at[held])
        assert named > 3

    def test_beyond_the_base(self) -> None:
        robot = tk.robots.thing()
        T = tk.transform(xyz=(60.0, 0.0, 0.8))
        result = tk.ik(robot, T)
        assert result.status == "limited"
        assert "joint 'x' at its upper limit" in result.message
        assert result.active_limits[robot.names.index("x")] == 1

    def test_nothing_is_said_to_be_out_of_reach_that_is_not(self) -> None:
        """A small budget and max_step leave targets unmet that could be met."""
        arm = tk.robots.ur10()
        targets, starts = arm.fk(arm.random(200, rng=1)), arm.random(200, rng=2)
        few = tk.ik(arm, targets, seed=starts, max_restarts=0, max_iterations=10)
        assert set(few.status) == {"success", "budget"}
        near = tk.ik(arm, targets, seed=starts, max_step=2.0, max_restarts=10)
        assert set(near.status) == {"success", "step_bound", "limited"}
        targets[:, :3, 3] += 5.0
        far = tk.ik(arm, targets, seed=starts, max_restarts=0)
        assert set(far.status) == {"unreachable"}
        assert few.message[(few.status == "budget").argmax()].startswith("iterations or restarts")

    def test_budgets(self) -> None:
        arm = tk.robots.ur10()
        T = arm.fk(arm.random(rng=22))
        hard = tk.ik(arm, T, max_iterations=1, max_restarts=0)
        assert hard.iterations >= 1
        assert not hard.success or hard.restarts == 0
        far = tk.ik(arm, tk.transform(xyz=(5.0, 0, 0)), deadline=1e-9)
        assert far.status == "deadline"
        assert np.all(np.isfinite(far.q))
        assert tk.ik(arm, T, max_restarts=0, seed=arm.random(rng=1)).restarts == 0

    @given(st.floats(1e3, 1e9))
    def test_very_far(self, distance: float) -> None:
        result = tk.ik(tk.robots.thing(), tk.transform(xyz=(distance, -distance, distance)))
        assert result.status in ("limited", "unreachable")
        assert np.all(np.isfinite(result.q))
        assert 0.9 * distance < result.position_error < 2 * distance


def link_lengths(arm: tk.Chain) -> float:
    """The sum of the links after the first joint, the scale of a radian in the solver."""
    frames = np.array([arm.fk(np.zeros(6), frame=i)[:3, 3] for i in range(7)])
    return float(np.linalg.norm(np.diff(frames, axis=0), axis=1).sum())


class TestExtremes:
    """Numbers that are legal, and of a size or a kind that few mean."""

    def test_restarts_without_end(self) -> None:
        arm = tk.robots.ur10()
        T = arm.fk(arm.random(rng=25))
        result = tk.ik(arm, T, max_restarts=2**31 - 1)
        np.testing.assert_array_equal(result.q, tk.ik(arm, T).q)

    @pytest.mark.parametrize("turns", [1e2, 1e8, 1e11, 1e39])
    def test_turns_back_to_the_seed_cost_no_success(self, turns: float) -> None:
        """Their rounding, 2e-16 of the angle, may exceed the tolerance: then they are not made."""
        rows = [tk.DH(a=0.3, d=0.1, alpha=i % 2, joint="continuous") for i in range(6)]
        arm = tk.Chain.from_dh(rows)
        T = arm.fk(np.linspace(0.1, 0.9, 6))
        result = tk.ik(arm, T, seed=np.full(6, 2 * np.pi * turns))
        assert result.success, result.message
        check(arm, T, result)
        assert turns > 1e3 or np.all(np.abs(result.q - 2 * np.pi * turns) <= np.pi * (1 + 1e-12))

    @pytest.mark.parametrize("limit", [1e5, 1e16, 1.7e308, np.inf])
    @pytest.mark.parametrize("one_sided", [False, True])
    def test_limits_that_mean_none(self, limit: float, one_sided: bool) -> None:
        rows = [tk.DH(a=0.3, joint="prismatic", lower=-1.0, upper=1.0)]
        rows += [tk.DH(a=0.3, d=0.1, alpha=np.pi / 2, joint="revolute") for i in range(6)]
        upper = np.full(7, 2.0 if one_sided else limit)
        arm = tk.Chain.from_dh(rows).with_limits(lower=np.full(7, -limit), upper=upper)
        targets = arm.fk(np.random.default_rng(26).uniform(-1.5, 1.5, (50, 7)))
        for objective in ("none", "limits", "manipulability"):
            results = tk.ik(arm, targets, objective=objective)
            assert results.success.all()
            check(arm, targets, results)
            assert np.abs(results.q).max() < 100.0

    def test_a_limit_range_that_has_no_square(self) -> None:
        """For the objective 'limits' such a joint is one that stands still."""
        robot = tk.robots.thing()
        q = robot.random(rng=27)
        q[0] = 0.0
        lower, upper = robot.lower.copy(), robot.upper.copy()
        lower[0], upper[0] = 0.0, 0.0
        still = robot.with_limits(lower=lower, upper=upper)
        upper[0] = 1e-200
        nearly = robot.with_limits(lower=lower, upper=upper)
        expected, result = (
            tk.ik(r, robot.fk(q), seed=q, objective="limits") for r in (still, nearly)
        )
        np.testing.assert_allclose(result.q, expected.q, atol=1e-5)
        assert not np.allclose(result.q, q, atol=1e-2)

    def test_links_that_are_rounding(self) -> None:
        """A gantry with a wrist: no length makes a radian of meters."""
        slides = [(0.0, np.pi / 2), (np.pi / 2, np.pi / 2), (np.pi / 2, 0.0)]
        rows = [
            tk.DH(theta=theta, alpha=alpha, joint="prismatic", lower=-1.0, upper=1.0)
            for theta, alpha in slides
        ]
        rows += [
            tk.DH(a=1e-17, alpha=alpha, joint="revolute", lower=-3.0, upper=3.0)
            for alpha in (np.pi / 2, -np.pi / 2, 0.0)
        ]
        gantry = tk.Chain.from_dh(rows)
        targets = gantry.fk(gantry.random(100, rng=28))
        results = tk.ik(gantry, targets, seed=gantry.random(100, rng=29))
        assert results.success.all()
        check(gantry, targets, results)

    @pytest.mark.parametrize("name", ["target", "seed"])
    def test_squares_that_overflow_are_refused(self, name: str) -> None:
        robot = tk.robots.thing()
        arguments = {"target": np.full(3, 0.5), "seed": np.zeros(9)}
        arguments[name] = arguments[name] + 1e200
        with pytest.raises(ValueError, match=rf"^{name}: got 1e\+200"):
            tk.ik(robot, task="position", **arguments)

    @pytest.mark.parametrize("weight", [5e-324, 1e-300, 1e-7, 1e7, np.inf])
    def test_joint_weights_that_overflow_are_refused(self, weight: float) -> None:
        with pytest.raises(ValueError, match=r"^joint_weights: got .* numbers in \[1e-6, 1e6\]"):
            tk.NumericIk(tk.robots.ur5(), joint_weights=weight)

    def test_no_polishing_after_the_deadline(self) -> None:
        arm = tk.robots.ur10()
        result = tk.ik(arm, tk.transform(xyz=(1.0, 1.0, 1.0)), seed=np.ones(6), deadline=1e-9)
        assert result.status == "deadline"
        assert 1 <= result.iterations <= 40  # one attempt

    @pytest.mark.parametrize("restarts", [0, 1, 2])
    @pytest.mark.parametrize("nearest", [False, True])
    def test_small_budgets_beside_a_closed_form(self, restarts: int, nearest: bool) -> None:
        """Its solutions cost iterations, too, and all of them may be outside limits or max_step."""
        arm = tk.robots.ur10()
        tight = arm.with_limits(lower=np.full(6, 0.1), upper=np.full(6, 0.4))
        targets = arm.fk(arm.random(100, rng=32))
        seed = np.full(6, 0.2) if nearest else None
        for iterations in (1, 2, 5, 40):
            for max_step in (None, 0.05) if nearest else (None,):
                results = tk.ik(
                    tight,
                    targets,
                    seed=seed,
                    nearest=nearest,
                    max_step=max_step,
                    max_restarts=restarts,
                    max_iterations=iterations,
                )
                assert not results.success.any()
                assert np.all((results.q >= 0.1) & (results.q <= 0.4))
                assert np.all(results.restarts <= restarts)
                T = tight.fk(results.q)
                away = np.linalg.norm(T[:, :3, 3] - targets[:, :3, 3], axis=1)
                np.testing.assert_allclose(results.position_error, away, atol=1e-13)

    @pytest.mark.parametrize("frame", [0, "shoulder"])
    def test_a_frame_that_hardly_moves(self, frame: int | str) -> None:
        arm = tk.robots.ur5()
        T = arm.fk(np.zeros(6), frame)
        assert tk.ik(arm, T, frame=frame).success
        T[2, 3] += 0.25
        result = tk.ik(arm, T, frame=frame)
        assert result.status == "unreachable"
        np.testing.assert_allclose(result.position_error, 0.25, rtol=1e-9)
        assert result.message.startswith("0.25 m")


class TestResult:
    def test_of_one(self) -> None:
        arm = tk.robots.ur5()
        result = tk.ik(arm, arm.fk(arm.random(rng=23)))
        assert result.active_limits.dtype == np.int8
        assert result.time > 0.0
        assert "reached within" in result.message
        assert "success" in repr(result)

    def test_of_many(self) -> None:
        arm = tk.robots.ur5()
        targets = arm.fk(arm.random(5, rng=24))
        targets[2, :3, 3] += 10.0
        results = tk.ik(arm, targets)
        assert len(results) == 5
        assert results.success.dtype == np.bool_
        assert list(results.status) == ["success"] * 2 + ["unreachable"] + ["success"] * 2
        assert "beyond reach" in results.message[2]
        assert results.active_limits.shape == (5, 6)
        assert results[-1].success
        assert [r.status for r in results] == list(results.status)
        assert repr(results) == "IkBatchResult(4 of 5 reached)"
        with pytest.raises(IndexError):
            results[5]

    def test_of_none(self) -> None:
        results = tk.ik(tk.robots.ur5(), np.zeros((0, 4, 4)))
        assert len(results) == 0
        assert results.q.shape == (0, 6)
        assert results.success.all()

    def test_it_outlives_its_chain(self) -> None:
        result = tk.ik(tk.robots.ur5(), tk.transform(xyz=(9.0, 0.0, 0.0)))
        solver = tk.NumericIk(tk.robots.ur5())
        assert "beyond reach" in result.message
        assert solver.solve(tk.transform(xyz=(9.0, 0.0, 0.0))).message == result.message


@pytest.mark.parametrize(
    ("argument", "value"),
    [
        ("target", np.zeros((4, 4))),
        ("target", np.eye(3)),
        ("target", np.full((4, 4), np.nan)),
        ("seed", np.zeros(5)),
        ("seed", np.zeros((2, 6))),
        ("seed", np.full(6, np.inf)),
        ("frame", "nose"),
        ("frame", 99),
        ("task", "dance"),
        ("weights", np.ones(5)),
        ("weights", np.zeros(6)),
        ("weights", [1, 1, 1, 1, 1, -1]),
        ("weights", [1, 1, 1, 1, 1, np.nan]),
        ("weight_axes", "body"),
        ("position_tolerance", 0.0),
        ("rotation_tolerance", np.nan),
        ("joint_weights", np.ones(5)),
        ("joint_weights", 0.0),
        ("max_step", -1.0),
        ("max_step", np.nan),
        ("objective", "beauty"),
        ("max_iterations", 0),
        ("max_restarts", -1),
        ("deadline", 0.0),
        ("deadline", np.nan),
        ("rng", -1),
        ("rng", "one"),
        ("rng", None),
        ("threads", 0),
    ],
)
def test_bad_input_is_named(argument: str, value: object) -> None:
    arm = tk.robots.ur5()
    arguments: dict[str, object] = {"target": arm.fk(np.zeros(6)), "seed": np.zeros(6)}
    with pytest.raises(ValueError, match=f"^{argument}: got "):
        tk.ik(arm, **{**arguments, argument: value})  # type: ignore[arg-type]


@pytest.mark.parametrize("option", [{"nearest": True}, {"max_step": 0.1}, {"objective": "seed"}])
def test_what_is_about_a_seed_needs_one(option: dict[str, object]) -> None:
    arm = tk.robots.ur5()
    with pytest.raises(ValueError, match=r"^seed: got None"):
        tk.ik(arm, arm.fk(np.zeros(6)), **option)  # type: ignore[arg-type]
