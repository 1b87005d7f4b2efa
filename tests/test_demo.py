"""The main job: the whole path, its claims checked by other means than the demo's own."""

import json

import numpy as np
import pytest

import thing_kin as tk
from thing_kin import demo
from thing_kin.demo import follow, wall
from thing_kin.demo.plans import write_plans
from thing_kin.demo.report import NEAR_SINGULAR, checks


@pytest.fixture(scope="module")
def outcome():
    return demo.solve()


def test_path_is_600_even_poses_over_the_panel():
    path = wall.wall_path(600)
    p, z_axis = path.hand[:, :3, 3], path.hand[:, :3, 2]
    assert len(path) == 600
    np.testing.assert_allclose(z_axis, np.tile([1.0, 0.0, 0.0], (600, 1)), atol=0)
    np.testing.assert_allclose(np.linalg.det(path.hand[:, :3, :3]), 1.0, atol=1e-15)
    np.testing.assert_allclose(p[:, 1].max() - p[:, 1].min(), 3.0, atol=1e-12)
    np.testing.assert_allclose(path.length, 13 * 1.2 + 12 * 0.25, atol=1e-12)
    step = np.linalg.norm(np.diff(p, axis=0), axis=1)
    spacing = path.length / 599
    assert step.max() <= spacing + 1e-12  # shorter only where a corner is cut
    assert step.min() >= spacing / np.sqrt(2) - 1e-12
    assert np.abs(path.base[:, :2]).max() < 5.0


def test_hand_is_on_its_target_by_another_formula(outcome):
    T, target = outcome.robot.fk(outcome.robust.q), outcome.path.hand
    distance = np.linalg.norm(T[:, :3, 3] - target[:, :3, 3], axis=1)
    # |R - R_target| (Frobenius) = 2 sqrt(2) sin(angle / 2)
    turned = np.linalg.norm(T[:, :3, :3] - target[:, :3, :3], axis=(1, 2)) / np.sqrt(2)
    assert distance.max() < 1.01e-9  # the tolerance of the iteration, and rounding
    assert turned.max() < 1.01e-9
    assert outcome.robust_measures.arrived.all()


def test_limits_are_kept_and_base_stays_in_its_range(outcome):
    robot, q = outcome.robot, outcome.robust.q
    assert (q > robot.lower).all()
    assert (q < robot.upper).all()
    assert np.abs(q[:, list(robot.base_joints[:2])]).max() < 5.0
    nearest = min(np.min(q - robot.lower), np.min(robot.upper - q))
    np.testing.assert_allclose(outcome.robust_measures.margin.min(), nearest, atol=0)


def test_reach_agrees_with_the_elbow(outcome):
    # From the base's real pose, what is missing to the stretched arm follows from q2 alone.
    robot, q = outcome.robot, outcome.robust.q
    actual = wall.WallPath(robot.fk(q), robot.base_pose(q), 0.0)
    upper, fore = 0.612, 0.5723  # [M17] Table A.1
    span = np.sqrt(upper**2 + fore**2 + 2 * upper * fore * np.cos(q[:, 2]))
    missing = wall.beyond_reach(robot, actual)
    # The run keeps wrist_1 below the hand: above the shoulder that is the nearer of the two wrists.
    above = robot.fk(q)[:, 2, 3] > robot.fk(q, frame="shoulder")[:, 2, 3]
    assert above.sum() > 300
    # The hand's axis is level to 1e-9 rad only, with some 0.1 m of wrist behind it.
    np.testing.assert_allclose(missing[above], (span - upper - fore)[above], atol=1e-8, rtol=0)
    assert (missing <= span - upper - fore + 1e-8).all()


def test_base_gives_way_where_the_arm_ends_and_only_there(outcome):
    short, measures = outcome.beyond_reach, outcome.robust_measures
    assert (short > 0.0).sum() >= 5
    # Heading turns the shoulder, 0.27 m from the base's frame, too; 2 % for the wrist's offset.
    moved = measures.base_error + 0.271 * np.abs(outcome.robust.q[:, 8])
    assert (moved >= short / 1.03).all()
    assert measures.base_error[short < -0.1].max() < 1e-3
    assert measures.base_error.max() < 0.02


def test_arm_is_near_singular_and_the_body_is_not(outcome):
    J = outcome.robot.jacobian(outcome.robust.q)
    arm, body = (np.linalg.cond(columns) for columns in (J[:, :, :6], J))
    assert arm.max() > 100.0
    assert body.max() < 10.0
    assert outcome.robust_measures.sigma_arm.min() < NEAR_SINGULAR


def test_plain_pseudoinverse_grows_there_and_robust_scheme_does_not(outcome):
    near = outcome.robust_measures.sigma_arm < NEAR_SINGULAR
    out_of_reach = outcome.beyond_reach > 1e-4
    assert outcome.robust_measures.joint_step.max() < np.pi / 4
    assert outcome.plain.largest_step[near].max() > 10.0  # rad: turns of a joint in one iteration
    assert not outcome.plain_measures.arrived[out_of_reach].any()
    assert outcome.plain_measures.margin.min() < 0.0
    assert outcome.plain.sigma.min() < 0.01
    assert outcome.robust.sigma.min() > 0.3


def test_before_the_singularity_both_schemes_agree_and_the_plain_one_is_quicker(outcome):
    first = int(np.argmax(outcome.robust_measures.sigma_arm < 0.1))
    difference = np.abs(outcome.robust.q - outcome.plain.q)[:first]
    assert first > 100
    # The robust scheme stops when the hand is there; the base may lag by a millimetre.
    assert difference.max() < 5e-3
    assert np.median(outcome.plain.iterations[:first]) < np.median(
        outcome.robust.iterations[:first]
    )


def test_each_step_is_what_the_solver_says(outcome):
    k = 300
    targets = [outcome.path.hand[k], outcome.path.base[k]]
    q = outcome.robust.q[k - 1]
    for _ in range(outcome.robust.iterations[k]):
        q = q + follow.robust_solver(outcome.robot).step(q, targets)
    np.testing.assert_array_equal(q, outcome.robust.q[k])


def test_checks_hold_and_can_fail(outcome, monkeypatch):
    held = checks(outcome)
    assert len(held) == 8
    assert all(held.values())
    monkeypatch.setattr(wall, "STEP_BACK", 0.0)
    regular = checks(demo.solve(60))
    assert {claim for claim, holds in regular.items() if not holds} == {
        "the arm comes near a singular posture",
        "there the plain pseudoinverse takes steps over 10 times as large",
        "and loses the wall",
    }


def test_equal_runs_and_progress():
    calls = []
    first, second = demo.solve(40, lambda: calls.append(1)), demo.solve(40)
    np.testing.assert_array_equal(first.robust.q, second.robust.q)
    np.testing.assert_array_equal(first.plain.q, second.plain.q)
    assert len(calls) == 2 * 40


def test_brief_run_writes_what_it_says(tmp_path):
    result = demo.run(tmp_path, brief=True)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(result["files"])
    assert json.loads((tmp_path / "summary.json").read_text()) == result
    assert all(result["checks"].values())
    assert result["version"] == tk.__version__
    assert result["poses"] == result["robust"]["poses_reached"] == demo.BRIEF_POSES
    assert result["robust"]["worst_position_error_m"] < 1e-8
    for name in set(result["files"]) - {"summary.json"}:
        data = (tmp_path / name).read_bytes()
        assert data.startswith(b"\x89PNG\r\n\x1a\n")
        assert len(data) > 20_000  # an empty figure has some 5 kB


def test_planners_pictures(tmp_path):
    names = write_plans(tmp_path)
    assert names == ["pose_plan.png", "path_plan.png", "dexterity.png", "trajectory.png"]
    for name in names:
        assert (tmp_path / name).stat().st_size > 20_000
