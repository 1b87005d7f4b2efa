"""The scans that other tests believe: the caster against walks along the beam, drives, families."""

import numpy as np
import pytest

from ray_casting import World, cast, distance_to
from scan_drives import CLEARANCE, SENSORS, Sensor, between, compose, drive, moved, pair, record
from scan_worlds import FAMILIES

RNG = np.random.default_rng


def march(world, pose, angle):
    """Range by steps that touch nothing: shares only the distance to things with the caster."""
    direction = np.array([np.cos(pose[2] + angle), np.sin(pose[2] + angle)])
    way = 0.0
    while way < 100.0:
        free = abs(distance_to(world, pose[None, :2] + way * direction)[0])
        if free < 1e-9:
            return way
        way += free
    return np.inf


@pytest.mark.parametrize("family", [f for f in FAMILIES if f != "glass"])
def test_the_caster_agrees_with_marching(family):
    rng = RNG(7)
    world = FAMILIES[family](rng)
    pose = np.array([*rng.uniform(-0.7, 0.7, 2), 1.0])
    angles = np.linspace(-np.pi, np.pi, 60, endpoint=False) + 0.0123
    got = cast(world, np.tile(pose, (60, 1)), angles)
    expected = np.array([march(world, pose, angle) for angle in angles])
    near = got < 90
    np.testing.assert_array_equal(near, expected < 90)
    np.testing.assert_allclose(got[near], expected[near], atol=1e-6)


def test_ranges_in_closed_form():
    square = World(np.array([[2.0, -5, 2, 5]]), np.array([[0.0, 3, 1]]))
    poses = np.zeros((4, 3))
    angles = np.array([0.0, np.pi / 3, np.pi / 2, np.pi])
    np.testing.assert_allclose(cast(square, poses, angles), [2, 4, 2, np.inf], rtol=1e-12)
    inside = cast(square, np.array([[0.0, 3, 0]]), np.array([np.pi / 2]))
    np.testing.assert_allclose(inside, 1.0)
    tangent = cast(square, np.array([[-1.0, 0, 0]]), np.array([np.pi / 2]))
    np.testing.assert_allclose(tangent, 3.0)


def test_glass_lets_its_share_pass():
    two = World(np.array([[1.0, -5, 1, 5], [2, -5, 2, 5]]), clear=np.array([0.7, 0.0]))
    ranges = cast(two, np.zeros((20_000, 3)), np.zeros(20_000), rng=RNG(0))
    assert set(np.unique(ranges)) == {1.0, 2.0}
    assert abs(np.mean(ranges == 2.0) - 0.7) < 0.01  # three sigma


def test_walkers_walk():
    world = World(np.empty((0, 4)), walkers=np.array([[1.0, 0, 4, 0, 0.5, 1.5]]))
    for t, x in ((0.0, 1.0), (1.0, 2.5), (2.0, 4.0), (3.0, 2.5), (4.0, 1.0)):
        np.testing.assert_allclose(world.discs_at(t), [[x, 0.0, 0.5]])


def test_walkers_step_aside():
    world = World(np.array([[5.0, -9, 5, 9]]), walkers=np.array([[0.0, 1, 4, 1, 0.2, 1.0]]))
    up = np.array([np.pi / 2])
    for x, expected in ((0.0, 0.8), (0.1, 1 - np.sqrt(0.03))):
        np.testing.assert_allclose(cast(world, np.array([[x, 0.0, 0.0]]), up), expected)
    assert np.isinf(cast(world, np.array([[0.0, 0.6, 0.0]]), up)).all()
    assert np.isinf(cast(world, np.array([[0.0, 1.0, 0.0]]), up)).all()


def test_planar_poses():
    a, b = RNG(1).normal(size=(2, 5, 3))
    np.testing.assert_allclose(compose(a, between(a, b)), b, atol=1e-14)
    twist = np.array([0.7, 0.2, 0.9])
    fine = np.zeros(3)
    for _ in range(1000):
        fine = compose(fine, moved(twist, 1.7e-3))
    np.testing.assert_allclose(moved(twist, 1.7), fine, atol=1e-12)
    np.testing.assert_allclose(moved(np.array([0.7, 0.2, 0.0]), 2.0), [1.4, 0.4, 0.0])


@pytest.mark.parametrize("family", FAMILIES)
def test_drives_are_smooth_and_touch_nothing(family):
    rng = RNG(3)
    world = FAMILIES[family](rng)
    way = drive(world, rng, 8.0)
    still = World(world.segments, world.circles)
    assert distance_to(still, way.poses[:, :2]).min() > 0.05
    length = np.sum(np.hypot(*np.diff(way.poses[:, :2], axis=0).T))
    assert length > 1.5
    t = np.linspace(0, way.seconds, 1601)
    steps = np.abs(between(way(t)[:-1], way(t)[1:]))
    assert steps.max(axis=0)[0] <= 1.0 * 0.00501
    assert steps.max(axis=0)[2] <= 1.4 * 0.00501
    np.testing.assert_allclose(way(0.02 * np.arange(9)), way.poses[:9], atol=1e-12)


def test_a_moving_scan_is_of_the_places_where_its_beams_left():
    wall = World(np.array([[5.0, -90, 5, 90]]))
    sensor = Sensor(-0.5, 0.5, 11, scan_time=0.1, noise=0.0, dropouts=0.0, mount=(0.2, 0.1, 0.3))
    way = record(wall, sensor, RNG(0), seconds=1.0).drive
    got = sensor.scan(wall, way, 0.5, RNG(0))
    for k, t in enumerate(0.5 + 0.01 * np.arange(11)):
        laser = compose(way(t), np.array(sensor.mount))
        angle = laser[2] + sensor.angles[k]
        with np.errstate(divide="ignore"):
            expected = (5.0 - laser[0]) / np.cos(angle)
        np.testing.assert_allclose(got[k], expected if 0 < expected < 30 else np.inf, rtol=1e-9)


def test_what_ranges_say_where_there_is_none():
    sensor = Sensor(-1.0, 1.0, 2000, range_min=0.5, range_max=3.0, dropouts=0.1)
    here = np.zeros(3)

    def scan(x):
        wall = World(np.array([[x, -90, x, 90]]))
        return sensor.scan(wall, lambda t: np.tile(here, (len(t), 1)), 0.0, RNG(2))

    assert np.isposinf(scan(3.1)).all()
    assert np.isneginf(scan(0.2)[~np.isposinf(scan(0.2))]).all()
    usual = scan(1.0)
    assert abs(np.mean(~np.isfinite(usual)) - 0.1) < 0.02
    seen = np.isfinite(usual)
    assert abs(np.std((usual - 1 / np.cos(sensor.angles))[seen]) - sensor.noise) < 5e-4


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("name", SENSORS)
def test_pairs(family, name):
    rng = RNG(11)
    sensor = SENSORS[name]
    two = pair(FAMILIES[family](rng), sensor, rng)
    assert two.a.shape == two.b.shape == (sensor.n,)
    assert np.isfinite(two.a).sum() > 10
    assert np.hypot(*two.truth[:2]) <= 0.3
    assert abs(two.truth[2]) <= 0.3


def test_the_same_seed_the_same_scans():
    world = FAMILIES["people"](RNG(5))
    one, two = (record(world, SENSORS["180 beams, 180 degrees"], RNG(6), 2.0) for _ in range(2))
    np.testing.assert_array_equal(one.scans, two.scans)
    assert one.scans.shape == (20, 180)
    assert SENSORS["1081 beams, 270 degrees"].range_min < CLEARANCE
