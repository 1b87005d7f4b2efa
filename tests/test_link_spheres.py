"""A robot's shape as spheres: where they are, and which pairs are worth watching."""

import pickle
from itertools import combinations, pairwise

import numpy as np
import pytest
from hypothesis import given

import thing_kin as tk
from oracles import PinocchioChain, assert_close, dh_fk_all
from strategies import Motion, motions

ROBOT = tk.robots.thing()
SEED = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])


@given(motion=motions())
def test_centers_by_pinocchio(motion: Motion) -> None:
    case, point = motion.case, motion.point
    spheres = [(case.chain.frames[case.frame], point, 0.1), (None, (0, 0, 0), 0.2)]
    shape = tk.LinkSpheres(case.chain, spheres)
    oracle = PinocchioChain(case.rows)
    oracle.add_point(case.frame, point)
    expected = oracle.fk_all(case.q)[[-1, -2], :3, 3]
    assert_close(shape.centers(case.chain, case.q), expected, 1e-12)
    many = shape.centers(case.chain, np.stack([case.q, case.q]))
    assert many.shape == (2, 2, 3)
    assert np.array_equal(many[0], many[1])


@given(motion=motions())
def test_spheres_along_links_cover_the_straight_ways(motion: Motion) -> None:
    """From each joint's frame, before its motion, to the next one's, where the joint is at zero."""
    case = motion.case
    shape = tk.LinkSpheres.along_links(case.chain, radius=0.1, spacing=0.2)
    q = np.where(np.array(case.chain.joint_types) == "prismatic", 0.0, case.q)
    frames = dh_fk_all(case.rows, q)
    # A distal row's joint moves about or along the z axis of the frame before it.
    origins = [frames[i, :3, 3] for i, row in enumerate(case.rows) if row.joint != "fixed"]
    origins.append(frames[-1, :3, 3])
    centers = shape.centers(case.chain, q)
    for one, other in pairwise(origins):
        for t in np.linspace(0.0, 1.0, 7):
            p = one + t * (other - one)
            assert np.linalg.norm(centers - p, axis=1).min() <= 0.1 + 1e-9
    assert {radius for _, _, radius in shape.spheres} == {0.1}


def test_the_base_is_left_out() -> None:
    shape = tk.LinkSpheres.along_links(ROBOT, radius=0.1)
    frames = {frame for frame, _, _ in shape.spheres}
    assert frames.isdisjoint({"world", "base_root", "base_x", "base_y", "base", "mount"})
    assert {"upper_arm", "forearm", "wrist_1", "tool"} <= frames


def test_default_pairs_leave_the_robot_free_to_move() -> None:
    """No pair overlaps in a quarter of all postures, and none where the user scripts start."""
    for radius in (0.05, 0.08, 0.1):
        shape = tk.LinkSpheres.along_links(ROBOT, radius, spacing=0.15)
        assert len(shape.pairs) > 20
        i, j = np.array(shape.pairs).T
        centers = shape.centers(ROBOT, ROBOT.random(2000, rng=1))
        gaps = np.linalg.norm(centers[:, i] - centers[:, j], axis=-1) - 2 * radius
        assert (gaps < 0.0).mean(axis=0).max() < 0.3  # 256 postures say a quarter
        seed = shape.centers(ROBOT, SEED)
        assert (np.linalg.norm(seed[i] - seed[j], axis=-1) > 2 * radius).all()


def test_default_pairs_miss_no_collision_that_can_be_told() -> None:
    """What is no pair is one link, a neighbor, overlaps often, or never met in 3000 postures."""
    shape = tk.LinkSpheres.along_links(ROBOT, 0.07, spacing=0.14)
    frames = [ROBOT.frames.index(frame) for frame, _, _ in shape.spheres]
    centers = shape.centers(ROBOT, ROBOT.random(3000, rng=2))
    left_out = set(combinations(range(len(shape)), 2)) - set(shape.pairs)
    never = 0
    for i, j in left_out:
        if abs(frames[i] - frames[j]) <= 1:  # of the arm's frames each has a joint of its own
            continue
        share = (np.linalg.norm(centers[:, i] - centers[:, j], axis=-1) < 0.14).mean()
        assert share == 0.0 or share > 0.2
        never += share == 0.0
    assert never > 10


def test_pairs_by_hand() -> None:
    spheres = [("shoulder", (0, 0, 0), 0.1), ("forearm", (0, 0, 0), 0.1), ("tool", (0, 0, 0), 0.1)]
    assert tk.LinkSpheres(ROBOT, spheres, pairs=[(2, 0)]).pairs == ((2, 0),)
    assert tk.LinkSpheres(ROBOT, spheres, pairs=[]).pairs == ()
    assert tk.LinkSpheres(ROBOT, []).pairs == ()


def test_a_shape_is_a_value() -> None:
    spheres = [("shoulder", (0, 0, 0), 0.1), (11, np.array([0.0, 0.1, 0.2]), 0.2)]
    shape = tk.LinkSpheres(ROBOT, spheres)
    assert shape.spheres == (("shoulder", (0.0, 0.0, 0.0), 0.1), ("tool", (0.0, 0.1, 0.2), 0.2))
    assert len(shape) == 2
    assert repr(shape) == f"LinkSpheres(2 spheres, {len(shape.pairs)} pairs)"
    same = pickle.loads(pickle.dumps(shape))
    assert same == shape
    assert hash(same) == hash(shape)
    assert tk.LinkSpheres(ROBOT, spheres[:1]) != shape


def test_frames_are_kept_by_name() -> None:
    shape = tk.LinkSpheres(ROBOT, [("wrist_2", (0, 0, 0.1), 0.1)])
    longer = ROBOT.with_tool(tk.transform(xyz=(0, 0, 0.3)))
    assert_close(shape.centers(longer, SEED), shape.centers(ROBOT, SEED), 1e-15)
    on_base = tk.LinkSpheres(ROBOT, [("base", (0, 0, 0.1), 0.1)])
    with pytest.raises(ValueError, match=r"^spheres\[0\].frame: got 'base', expected one of"):
        on_base.centers(tk.robots.ur5(), np.zeros(6))


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: tk.LinkSpheres(ROBOT, [("no", (0, 0, 0), 0.1)]), r"spheres\[0\]: got 'no'"),
        (lambda: tk.LinkSpheres(ROBOT, [("tool", (0, 0), 0.1)]), r"spheres\[0\]: got shape"),
        (lambda: tk.LinkSpheres(ROBOT, [("tool", (0, 0, 0), 0.0)]), r"spheres\[0\].radius: got 0"),
        (lambda: tk.LinkSpheres(ROBOT, [("tool", (0, 0, 0))]), r"spheres\[0\]: got"),
        (lambda: tk.LinkSpheres(ROBOT, ["abc"]), r"spheres\[0\]: got 'abc'"),
        (lambda: tk.LinkSpheres(ROBOT, 3), "spheres: got 3"),
        (lambda: tk.LinkSpheres(ROBOT, [], pairs=[(0, 1)]), r"pairs\[0\]: got 0, 1"),
        (lambda: tk.LinkSpheres(ROBOT, [], pairs=[(0, "a")]), r"pairs\[0\]: got"),
        (lambda: tk.LinkSpheres(ROBOT, [], pairs=[3]), r"pairs\[0\]: got 3"),
        (lambda: tk.LinkSpheres.along_links(ROBOT, 0.0), "radius: got 0"),
        (lambda: tk.LinkSpheres.along_links(ROBOT, np.nan), "radius: got nan"),
        (lambda: tk.LinkSpheres.along_links(ROBOT, 0.1, 1e-6), "spacing: got 1e-06"),
    ],
)
def test_what_is_no_shape(make, said: str) -> None:
    with pytest.raises(ValueError, match=f"^{said}.*, expected"):
        make()
