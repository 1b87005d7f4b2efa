"""KDL's solver behind thing_kin.kdl.ik: limits, honest statuses, and Pinocchio as the judge."""

import numpy as np
import pinocchio as pin
import pytest
from numpy.testing import assert_array_equal

import thing_kin as tk
from arms import gen3, iiwa14, panda
from oracles import Array, translation
from thing_kin import kdl
from urdf_trees import PinocchioTree, read_by_pinocchio

ROBOTS = {
    "ur10": tk.robots.ur10(),
    "panda": panda(),
    "iiwa14": iiwa14(),
    "gen3": gen3(),
    "thing": tk.robots.thing(),  # its q is not in the order of the chain
}
POSITION, ROTATION = 1e-7, 1e-6  # the defaults
COUNT = 40


def errors(chain: tk.Chain, Q: Array, targets: Array) -> tuple[Array, Array]:
    """By Pinocchio, of the chain as URDF: m and rad."""
    ends = chain.frames[0], chain.frames[-1]
    tree = PinocchioTree(read_by_pinocchio(chain.to_urdf()), *ends, chain.names)
    found = np.stack([tree.fk(q) for q in Q])
    turned = [pin.log3(a[:3, :3].T @ b[:3, :3]) for a, b in zip(found, targets, strict=True)]
    return np.linalg.norm(found - targets, axis=1)[:, 3], np.linalg.norm(turned, axis=1)


def within_limits(chain: tk.Chain, Q: Array) -> bool:
    return bool(np.all((chain.lower <= Q) & (chain.upper >= Q)))


@pytest.fixture(scope="module", params=ROBOTS)
def solved(request: pytest.FixtureRequest) -> tuple[tk.Chain, Array, Array, tk.IkBatchResult]:
    chain = ROBOTS[request.param]
    targets, seeds = chain.fk(chain.random(COUNT, rng=1)), chain.random(COUNT, rng=2)
    return chain, targets, seeds, kdl.ik(chain, targets, seed=seeds)


def test_reachable_poses_are_reached_within_the_limits(solved):
    chain, targets, _, results = solved
    assert results.success.all()
    assert within_limits(chain, results.q)
    position, rotation = errors(chain, results.q, targets)
    assert position.max() <= POSITION + 1e-12  # rounding of some metres
    assert rotation.max() <= ROTATION + 1e-12
    # The angle by the logarithm of a rotation matrix: to the root of the rounding where it is tiny.
    np.testing.assert_allclose(results.position_error, position, rtol=0, atol=1e-12)
    np.testing.assert_allclose(results.rotation_error, rotation, rtol=0, atol=1e-10)


def test_it_is_what_thing_kin_says_of_the_same_targets(solved):
    chain, targets, seeds, results = solved
    assert isinstance(results, tk.IkBatchResult)
    assert_array_equal(results.success, tk.ik(chain, targets, seed=seeds).success)


def test_a_batch_is_a_loop_on_any_number_of_threads(solved):
    chain, targets, seeds, results = solved
    for threads in (1, 2, 4):
        again = kdl.ik(chain, targets, seed=seeds, threads=threads)
        for name in ("q", "status", "position_error", "active_limits", "iterations", "restarts"):
            assert_array_equal(getattr(again, name), getattr(results, name))
    for i in range(3):
        one = kdl.ik(chain, targets[i], seed=seeds[i])
        assert isinstance(one, tk.IkResult)
        assert_array_equal(one.q, results.q[i])
        assert (one.status, one.iterations) == (results.status[i], results.iterations[i])
    assert len(kdl.ik(chain, targets[:0])) == 0


def test_joints_that_turn_freely_stay_within_half_a_turn_of_the_seed(solved):
    chain, _, seeds, results = solved
    endless = chain.upper - chain.lower == np.inf
    assert np.all(np.abs(results.q - seeds)[:, endless] <= np.pi + 1e-12)


def test_joints_are_brought_back_by_whole_turns():
    """The same arm, its limits moved by a turn and a half: KDL starts and ends elsewhere."""
    arm = tk.robots.ur5()
    chain = arm.with_limits(lower=np.full(6, 2 * np.pi), upper=np.full(6, 4 * np.pi))
    targets = arm.fk(arm.random(20, rng=3))
    results = kdl.ik(chain, targets, seed=np.full(6, 4 * np.pi - 0.01))
    assert results.success.all()
    assert within_limits(chain, results.q)


@pytest.mark.parametrize(("lower", "upper"), [(-np.inf, 1.0), (-1.0, np.inf)])
def test_a_limit_on_one_side_is_kept(lower: float, upper: float):
    row = tk.DH(a=0.5, joint="revolute", lower=lower, upper=upper)
    chain = tk.Chain.from_dh([row, tk.DH(a=0.4, joint="revolute")])
    targets = chain.fk(np.random.default_rng(4).uniform(-np.pi, np.pi, (20, 2)))
    results = kdl.ik(chain, targets, seed=(0.5, 0.5))
    assert results.success.all()  # every turn of the first joint has an image within its limits
    assert within_limits(chain, results.q)


def test_a_solution_beyond_a_limit_is_blamed_on_the_limit():
    chain = tk.Chain.from_dh([tk.DH(a=1.0, joint="revolute", name="hip", lower=-1.0, upper=1.0)])
    for angle, side in [(1.5, 1), (-1.5, -1)]:
        result = kdl.ik(chain, chain.fk([angle]), seed=[0.0])
        assert (result.success, result.status) == (False, "limited")
        assert_array_equal(result.active_limits, [side])
        assert "'hip' at its " + ("upper" if side > 0 else "lower") in result.message
        assert_array_equal(result.q, [float(side)])
        np.testing.assert_allclose(result.rotation_error, 0.5, atol=1e-12)


def test_a_slide_is_no_turn():
    rows = [tk.DH(alpha=np.pi / 2, joint="revolute"), tk.DH(joint="prismatic", lower=0, upper=1)]
    chain = tk.Chain.from_dh(rows)
    assert kdl.ik(chain, chain.fk([0.5, 0.9]), seed=[0.0, 0.1]).success
    beyond = kdl.ik(chain, chain.fk([0.5, 1.0 + 2 * np.pi]), seed=[0.0, 0.1])
    assert beyond.status == "unreachable"
    assert_array_equal(beyond.active_limits, [0, 1])


@pytest.mark.parametrize("name", ROBOTS)
def test_what_is_far_away_is_unreachable(name: str):
    chain = ROBOTS[name]
    result = kdl.ik(chain, translation(0.0, 0.0, 50.0), max_restarts=5)
    assert (result.success, result.status) == (False, "unreachable")
    assert within_limits(chain, result.q)
    position, rotation = errors(chain, result.q[None], translation(0.0, 0.0, 50.0)[None])
    np.testing.assert_allclose([result.position_error], position, rtol=0, atol=1e-10)
    np.testing.assert_allclose([result.rotation_error], rotation, rtol=0, atol=1e-10)
    assert "beyond reach" in result.message


def test_a_failure_says_that_its_budget_ran_out_and_is_within_the_limits():
    chain = panda()
    targets, seeds = chain.fk(chain.random(60, rng=5)), chain.random(60, rng=6)
    results = kdl.ik(chain, targets, seed=seeds, max_restarts=0)
    assert 5 < results.success.sum() < 55  # a single start: hence restarts
    assert set(results.status) <= {"success", "budget", "limited"}
    assert within_limits(chain, results.q)
    assert_array_equal(results.restarts, 0)
    position, rotation = errors(chain, results.q, targets)
    assert np.all(((position > POSITION) | (rotation > ROTATION))[~results.success])
    few = kdl.ik(chain, targets, seed=seeds, max_iterations=3)
    assert few.iterations.max() <= 3


def test_without_a_seed_and_with_one_outside_the_limits():
    chain = iiwa14()
    T = chain.fk(chain.random(rng=7))
    assert kdl.ik(chain, T).success
    assert kdl.ik(chain, T, seed=np.full(7, 3.0)).success


def test_a_deadline_ends_it():
    chain = panda()
    T = chain.fk(chain.random(rng=8)) @ translation(0.0, 0.0, 0.9)
    result = kdl.ik(chain, T, deadline=1e-9)
    assert result.status == "deadline"
    assert result.restarts == 0


def test_rng_chooses_the_restarts():
    chain = panda()
    T = chain.fk(chain.random(rng=9))
    first, other = kdl.ik(chain, T, rng=1), kdl.ik(chain, T, rng=2)
    assert first.success
    assert other.success
    assert np.abs(first.q - other.q).max() > 1e-3
    assert_array_equal(kdl.ik(chain, T, rng=1).q, first.q)
    drawn = [kdl.ik(chain, T, rng=np.random.default_rng(3)).q for _ in range(2)]
    assert_array_equal(*drawn)


ARM = tk.robots.ur5()
GOOD = ARM.fk(np.zeros(6))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"target": np.eye(3)}, r"^target: got shape \(3, 3\)"),
        ({"target": 2.0 * np.eye(4)}, r"^target: "),
        ({"seed": np.zeros(5)}, r"^seed: got shape \(5,\)"),
        ({"seed": np.zeros((2, 6))}, r"^seed: got 2 configurations, expected one"),
        ({"seed": np.full(6, np.nan)}, r"^seed: got nan"),
        ({"position_tolerance": 0.0}, r"^position_tolerance: got 0"),
        ({"rotation_tolerance": np.nan}, r"^rotation_tolerance: got nan"),
        ({"max_iterations": 0}, r"^max_iterations: got 0, expected at least 1"),
        ({"max_restarts": -1}, r"^max_restarts: got -1, expected at least 0"),
        ({"deadline": 0.0}, r"^deadline: got 0"),
        ({"rng": -1}, r"^rng: got -1, expected a whole number from 0"),
        ({"rng": 2**64}, r"^rng: got 18446744073709551616"),
        ({"rng": "a"}, r"^rng: got 'a'"),
        ({"threads": 0}, r"^threads: got 0"),
    ],
)
def test_what_is_wrong_is_said(arguments: dict, message: str):
    with pytest.raises(ValueError, match=message):
        kdl.ik(ARM, **{"target": GOOD, **arguments})
