"""Drives followed by scans: drift, standstill, losses bridged, time that goes backwards."""

import itertools
import threading
from dataclasses import replace

import numpy as np
import pytest

from ray_casting import World
from scan_drives import PIECE, SENSORS, Drive, Sensor, between, compose, moved, record
from scan_statistics import INSIDE, KNOWN, follow, scanner_of
from scan_worlds import FAMILIES
from thing_kin import lie, odometry

RNG = np.random.default_rng
NARROW, MIDDLE, FINE, OFF = (
    SENSORS[name]
    for name in (
        "180 beams, 180 degrees",
        "361 beams, 180 degrees",
        "1081 beams, 270 degrees",
        "361 beams, off-centre",
    )
)
ROOM = World(np.array([[-4, -3, 4, -3], [4, -3, 4, 3], [4, 3, -4, 3], [-4, 3, -4, -3.0]]))


def scan_at(pose, sensor=NARROW, seed=0, world=ROOM):
    pose = np.asarray(pose, dtype=float)
    return sensor.scan(world, lambda t: np.tile(pose, (len(t), 1)), 0.0, RNG(seed))


def state_of(lidar):
    return np.array(lidar.poses)


# --- drift --------------------------------------------------------------------------------------


@pytest.mark.parametrize("family", [f for f in KNOWN if not f.startswith("corridor")])
def test_drift_in_rooms(family):
    drive = follow(family, MIDDLE, (10, 0), seconds=8.0)
    assert not drive.lost.any()
    assert drive.end[0] < 0.03
    assert drive.end[1] < 0.01


@pytest.mark.parametrize("family", ["corridor, doors", "corridor, pillars"])
def test_drift_in_corridors_with_something_on_their_walls(family):
    drive = follow(family, FINE, (11, 0), seconds=6.0, wheels=0.03)
    assert not drive.lost.any()
    assert drive.end[0] < 0.1
    assert drive.end[1] < 0.01


def test_a_plain_corridor_is_left_to_the_wheels():
    drive = follow("corridor, plain", FINE, (12, 0), seconds=6.0, wheels=0.03)
    assert not drive.lost.any()
    assert drive.end[0] < 0.05 * drive.length + 0.05
    heading = drive.truth[1:-1, 2]
    covariances = drive.covariances[2:]
    along = np.stack([np.cos(heading), -np.sin(heading)], axis=1)
    known = np.sqrt(np.einsum("ni,nij,nj->n", along, covariances[:, :2, :2], along))
    assert np.median(known) > 5 * np.median(np.sqrt(covariances[:, 2, 2]))


def test_an_off_centre_mount():
    drive = follow("room", OFF, (13, 0), seconds=8.0)
    assert not drive.lost.any()
    assert drive.end[0] < 0.03


@pytest.mark.parametrize("family", ["room", "people"])
def test_nees_of_steps(family):
    nees = np.concatenate([follow(family, MIDDLE, (14, k), seconds=6.0).nees for k in range(3)])
    assert np.mean(nees < INSIDE) > 0.9
    assert 0.3 < np.median(nees) < 5.0  # of chi-square of 3: 2.37


def differences(function, at, h=1e-6):
    """Jacobian by central differences."""
    columns = [(function(at + d) - function(at - d)) / (2 * h) for d in h * np.eye(3)]
    return np.stack(columns, axis=1)


@pytest.mark.parametrize("kind", ["covariance", "scan_covariance"])
def test_a_motion_is_as_uncertain_as_both_its_poses(kind):
    """An error in the heading before turns the whole motion: through the derivatives of between."""
    lidar = odometry.LaserOdometry(scanner_of(MIDDLE))
    run = record(FAMILIES["room"](RNG(17)), MIDDLE, RNG(17), 6.0, 3.0)  # steps of 0.2 to 0.3 m
    steps = [lidar.add(scan, t=t) for t, scan in zip(run.times, run.scans, strict=True)]
    ways = []
    for before, now in itertools.pairwise(steps[1:]):
        assert not before.degenerate
        assert not now.degenerate
        a, b = np.array(before.pose), np.array(now.pose)
        by_a = differences(lambda p, b=b: between(p, b), a)
        by_b = differences(lambda p, a=a: between(a, p), b)
        P_a, P_b = getattr(before.match, kind), getattr(now.match, kind)
        expected = by_a @ P_a @ by_a.T + by_b @ P_b @ by_b.T
        # Differences of h = 1e-6 are good to about 1e-9.
        np.testing.assert_allclose(getattr(now, kind), expected, atol=1e-6 * expected.max())
        ways.append(np.hypot(*now.motion[:2]))
    assert max(ways) > 0.15  # else the heading before would not matter


def test_along_a_plain_corridor_the_scans_alone_say_nothing():
    rng = RNG(18)
    run = record(FAMILIES["corridor, plain"](rng), FINE, rng, 2.0, 10.0)
    guesses, guessed = run.wheels(rng), np.diag([0.03, 0.02, 0.05]) ** 2
    lidar = odometry.LaserOdometry(scanner_of(FINE))
    for k, (t, ranges) in enumerate(zip(run.times, run.scans, strict=True)):
        step = lidar.add(ranges, t=t, motion=guesses[k - 1] if k else None,
                         motion_covariance=guessed if k else None)  # fmt: skip
        if k < 2:
            continue
        heading = run.poses[k - 1, 2]  # of the robot before, in whose axes the motion is
        along = np.array([np.cos(heading), -np.sin(heading), 0.0])
        variance, direction = np.linalg.eigh(step.scan_covariance)
        # What is told stays sharp though both scans' directions along the corridor differ a little.
        assert np.sqrt(variance[:2]).max() < 0.003
        assert variance[2] == pytest.approx(1e4, rel=0.01)
        np.testing.assert_allclose(abs(direction[:, 2] @ along), 1.0, atol=1e-4)
        # With the guess the motion is as uncertain as the guess of this one step, no less, no more.
        both = np.asarray(step.covariance)
        assert along @ both @ along == pytest.approx(along @ guessed @ along, rel=0.1)


def test_after_a_corridor_the_scans_alone_tell_no_way_but_the_next():
    """The pose is told again, the one before was not: a filter has no use for their motion yet."""
    hall = World(np.array([[-90, -1, 4, -1], [-90, 1, 4, 1], [4, -1, 4, 1.0]]))
    sensor = replace(MIDDLE, range_max=3.0)
    lidar = odometry.LaserOdometry(scanner_of(sensor))
    steps = []
    for k in range(30):  # its end comes into sight, and is in the map a keyframe later
        pose = (0.1 * k, 0.0, 0.0)
        ranges = scan_at(pose, sensor, k, hall)
        steps.append(lidar.add(ranges, t=0.1 * k, motion=(0.1, 0, 0) if k else None))
    open_, told = (np.array([s.degenerate == d for s in steps[1:]]) for d in (True, False))
    first = 1 + int(np.argmax(told))
    assert 8 < first < 15
    assert open_[: first - 1].all()
    assert told[first + 2 :].all()
    for k, step in enumerate(steps[1:], 1):
        sd = np.sqrt(np.linalg.eigvalsh(step.scan_covariance))
        assert sd[:2].max() < 0.02, k
        assert (90 < sd[2] < 110) if k <= first else (sd[2] < 0.02), k


def test_catching_up_is_no_velocity():
    """Bridged with a velocity that was too low, then found: the jump is of all the time bridged."""
    lidar = odometry.LaserOdometry(scanner_of(MIDDLE))
    slow, fast, blind = 0.02, 0.1, np.full(361, np.inf)
    for k in range(10):
        lidar.add(scan_at((slow * k, 0, 0), MIDDLE, k), t=0.1 * k)
    for k in range(10, 14):
        assert lidar.add(blind, t=0.1 * k).status == "lost"
    x = slow * 9 + fast * 5
    found = lidar.add(scan_at((x, 0, 0), MIDDLE, 14), t=1.4)
    assert found.status == "tracking"
    np.testing.assert_allclose(found.pose, (x, 0, 0), atol=0.02)
    assert found.motion[0] > 0.35
    # Five guesses of equal worth share it; the velocity is of one.
    bridged = lidar.add(blind, t=1.5).motion
    np.testing.assert_allclose(bridged, (0.9 * fast, 0, 0), atol=0.02)


# --- stop and go --------------------------------------------------------------------------------

SLOW = Sensor(-np.pi, np.pi - np.pi / 180, 360, range_max=12.0, scan_time=0.19)


def stop_and_go(seconds=10.0):
    """Full speed in a second, full stop in two thirds of one, over and over, in a wide bend."""
    poses, twists, speed, ahead = [np.array([-1.5, -1.0, 0.3])], [], 0.0, True
    for _ in range(round(seconds / PIECE)):
        speed += PIECE * (1.0 if ahead else -1.5)
        ahead = (ahead and speed < 1.0) or speed <= 0.0
        twists.append(np.array([max(speed, 0.0), 0.0, 0.6 * max(speed, 0.0)]))
        poses.append(compose(poses[-1], moved(twists[-1], PIECE)))
    return Drive(np.array(poses), np.array(twists))


@pytest.mark.parametrize("told", [True, False], ids=["twists", "without"])
def test_a_slow_scanner_on_a_robot_that_brakes(told):
    """5 scans a second, each made in 0.19 s; wheels are off by 3 %."""
    rng, drive = RNG(40), stop_and_go()
    times = np.arange(0.0, drive.seconds - 0.2, 0.2)
    lidar = odometry.LaserOdometry(scanner_of(SLOW))
    world = World(ROOM.segments, np.array([[1.5, 2.0, 0.2]]))
    wheels = 1.0 + 0.03 * rng.normal(size=(len(times), 3))
    motions = np.vstack([np.zeros(3), between(drive(times[:-1]), drive(times[1:]))])
    steps = []
    for k, t in enumerate(times):
        ends = drive.twists[[round(t / PIECE), round((t + SLOW.scan_time) / PIECE)]] * wheels[k]
        steps.append(
            lidar.add(
                SLOW.scan(world, drive, t, rng),
                t=t,
                motion=motions[k] * wheels[k] if k else None,
                twists=ends if told else None,
            )
        )
    away = np.array([s.motion for s in steps[1:]]) - motions[1:]
    way = np.hypot(*away[:, :2].T)
    assert all(s.status in ("tracking", "still") for s in steps[1:])
    if told:
        assert np.median(way) < 0.003
        assert way.max() < 0.015
    else:  # what it is for: a constant twist is off by up to 0.3 m/s for 0.2 s
        assert np.median(way) > 0.0035
        assert way.max() > 0.015


@pytest.mark.parametrize("twists", [np.zeros((2, 3)), np.array([[0.5, 0.1, -0.4]] * 2)])
def test_twists_that_are_equal_are_a_constant_one(twists):
    scanner = odometry.Scanner(**{**MIDDLE.arguments(), "scan_time": 0.08})
    one, other = (odometry.LaserOdometry(scanner) for _ in range(2))
    run = record(FAMILIES["room"](RNG(41)), MIDDLE, RNG(41), 1.0, 5.0)
    for t, scan in zip(run.times, run.scans, strict=True):
        # The motion of a constant twist is what is told by both.
        motion = lie.se2_exp(0.2 * twists[0]) if t > 0 else None
        a = one.add(scan, t=t, motion=motion, twists=twists)
        b = other.add(scan, t=t, motion=motion, twists=np.add(twists, [[0, 0, 0], [1e-12, 0, 0]]))
        np.testing.assert_allclose(a.pose, b.pose, atol=1e-8)


# --- large turns --------------------------------------------------------------------------------


@pytest.mark.parametrize("degrees", [-150, -90, 45, 120, 150])
def test_turns_against_the_local_map(degrees):
    rng = RNG(20)
    world = FAMILIES["room"](rng)
    sensor = replace(FINE, scan_time=0.0)  # it stands while it scans
    drive = record(world, sensor, rng, seconds=3.0)
    lidar = odometry.LaserOdometry(scanner_of(sensor))
    for k, turn in enumerate(np.linspace(0, 2 * np.pi, 20, endpoint=False)):  # looks around first
        pose = compose(drive.poses[0], np.array([0.0, 0.0, turn]))
        lidar.add(scan_at(pose, sensor, k, world), t=0.1 * k)
    motion = np.array([0.3, 0.1, np.radians(degrees) + 2 * np.pi / 20])
    pose = compose(pose, motion)
    step = lidar.add(scan_at(pose, sensor, 99, world), t=2.0)
    assert step.status == "tracking"
    np.testing.assert_allclose(between(drive.poses[0], pose), step.pose, atol=0.03)


# --- statuses -----------------------------------------------------------------------------------


def test_the_first_scan_is_the_origin():
    lidar = odometry.LaserOdometry(scanner_of(NARROW))
    assert np.asarray(lidar.poses).shape == (0, 3)
    step = lidar.add(scan_at((0.5, 0.3, 1.0)), t=3.0)
    assert step.status == "first"
    np.testing.assert_array_equal(step.pose, 0)
    np.testing.assert_array_equal(step.motion, 0)


def test_standing_still_is_seen_and_does_not_drift():
    lidar = odometry.LaserOdometry(scanner_of(MIDDLE))
    status = [
        lidar.add(scan_at((0.5, 0.3, 1.0), MIDDLE, seed=k), t=0.1 * k).status for k in range(200)
    ]
    assert status[1:].count("still") > 150
    assert np.abs(lidar.poses).max() < 0.005


def test_duplicated_scans_are_no_motion():
    lidar = odometry.LaserOdometry(scanner_of(NARROW))
    scan = scan_at((0.5, 0.3, 1.0))
    for k in range(5):
        step = lidar.add(scan, t=0.1 * k)
    np.testing.assert_allclose(step.pose, 0, atol=1e-6)
    assert np.linalg.eigvalsh(step.covariance)[0] > 0


@pytest.mark.parametrize("bad", [np.inf, np.nan, -np.inf, 0.0])
def test_a_lost_scan_is_bridged_by_the_guess_and_says_so(bad):
    lidar = odometry.LaserOdometry(scanner_of(MIDDLE))
    path = [np.array([0.05 * k, 0.0, 0.02 * k]) for k in range(12)]
    for k in range(10):
        step = lidar.add(scan_at(path[k], MIDDLE, k), t=0.1 * k)
    sure = np.sqrt(np.diag(step.covariance))
    motion = between(path[9], path[10])
    lost = lidar.add(np.full(361, bad), t=1.0, motion=motion)
    assert lost.status == "lost"
    np.testing.assert_allclose(lost.motion, motion)
    assert (np.sqrt(np.diag(lost.covariance)) > 2 * sure).all()
    found = lidar.add(scan_at(path[11], MIDDLE, 11), t=1.1)
    assert found.status == "tracking"
    np.testing.assert_allclose(found.pose, path[11], atol=0.02)
    assert len(lidar.poses) == 12


def test_bridged_without_wheels_it_keeps_its_velocity():
    lidar = odometry.LaserOdometry(scanner_of(MIDDLE))
    for k in range(10):
        lidar.add(scan_at((0.05 * k, 0, 0), MIDDLE, k), t=0.1 * k)
    lost = lidar.add(np.full(361, np.inf), t=1.0)
    assert lost.status == "lost"
    np.testing.assert_allclose(lost.motion, (0.05, 0, 0), atol=0.02)


def test_motion_covariance_of_the_bridge_is_the_wheels():
    lidar = odometry.LaserOdometry(scanner_of(NARROW))
    lidar.add(scan_at((0, 0, 0)), t=0.0)
    covariance = np.diag([0.04, 0.01, 0.09])
    lost = lidar.add(
        np.full(180, np.inf), t=0.1, motion=(0.1, 0.0, 0.0), motion_covariance=covariance
    )
    assert lost.status == "lost"
    assert (np.diag(lost.covariance) >= 0.999 * np.diag(covariance)).all()


def test_poses_are_the_chain_of_the_motions():
    drive = follow("room", NARROW, (15, 0), seconds=4.0)
    pose = np.zeros(3)
    for motion, expected in zip(drive.motions[1:], drive.poses[1:], strict=True):
        pose = compose(pose, motion)
        np.testing.assert_allclose(pose[:2], expected[:2], atol=1e-9)
        np.testing.assert_allclose(np.exp(1j * pose[2]), np.exp(1j * expected[2]), atol=1e-9)


# --- misuse -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "argument"),
    [
        ({"t": 0.25}, "t"),  # backwards
        ({"t": np.nan}, "t"),
        ({"t": np.inf}, "t"),
        ({"ranges": np.ones(179)}, "ranges"),
        ({"ranges": np.empty(0)}, "ranges"),
        ({"motion": (0.0, 0.0)}, "motion"),
        ({"motion": (0.0, np.nan, 0.0)}, "motion"),
        ({"motion": (0.0, 0.0, 0.0), "motion_covariance": -np.eye(3)}, "motion_covariance"),
        ({"motion": (0.0, 0.0, 0.0), "motion_covariance": np.eye(2)}, "motion_covariance"),
        ({"twists": np.zeros(3)}, "twists"),
        ({"twists": np.full((2, 3), np.nan)}, "twists"),
        ({"twists": np.full((2, 3), 1e200)}, "twists"),
    ],
)
def test_refused_and_unharmed(change, argument):
    lidar, twin = (odometry.LaserOdometry(scanner_of(NARROW)) for _ in range(2))
    for one in (lidar, twin):
        for k in range(4):
            one.add(scan_at((0.02 * k, 0, 0), seed=k), t=0.1 * k)
    before = state_of(lidar)
    given = {"ranges": scan_at((0.08, 0, 0), seed=4), "t": 0.4, **change}
    with pytest.raises(ValueError, match=rf"^{argument}\b"):
        lidar.add(given.pop("ranges"), **given)
    np.testing.assert_array_equal(state_of(lidar), before)
    for k in range(4, 8):  # as if it had never been asked
        steps = [one.add(scan_at((0.02 * k, 0, 0), seed=k), t=0.1 * k) for one in (lidar, twin)]
        np.testing.assert_array_equal(steps[0].pose, steps[1].pose)
        np.testing.assert_array_equal(steps[0].covariance, steps[1].covariance)


def test_unix_stamps_lose_nothing():
    plain, stamped = (odometry.LaserOdometry(scanner_of(NARROW)) for _ in range(2))
    for k in range(6):  # quarters of a second are exact in both
        scan = scan_at((0.05 * k, 0, 0), seed=k)
        one, other = plain.add(scan, t=0.25 * k), stamped.add(scan, t=1.7e9 + 0.25 * k)
        np.testing.assert_array_equal(one.pose, other.pose)


def test_after_many_lost_scans_it_begins_anew_elsewhere():
    rng = RNG(22)
    here, there = FAMILIES["room"](rng), FAMILIES["pillars"](rng)
    sensor = replace(FINE, scan_time=0.0)
    lidar = odometry.LaserOdometry(scanner_of(sensor), lost_limit=3)
    for k in range(4):
        lidar.add(scan_at((0.05 * k, 0, 0), sensor, k, here), t=0.1 * k)
    for k in range(4, 9):
        lidar.add(np.full(1081, np.inf), t=0.1 * k)
    poses = [np.array([0.05 * k, 0.0, 0.01 * k]) for k in range(20)]
    steps = [lidar.add(scan_at(p, sensor, k, there), t=1 + 0.1 * k) for k, p in enumerate(poses)]
    assert [s.status for s in steps[-10:]] == ["tracking"] * 10
    for k in range(11, 20):
        np.testing.assert_allclose(steps[k].motion, between(poses[k - 1], poses[k]), atol=0.01)


def test_steps_and_poses_are_copies():
    lidar = odometry.LaserOdometry(scanner_of(NARROW))
    for k in range(3):
        step = lidar.add(scan_at((0.02 * k, 0, 0), seed=k), t=0.1 * k)
    last = np.array(step.pose)
    poses = lidar.poses
    if poses.flags.writeable:
        poses[:] = 7.0
    lidar.add(scan_at((0.06, 0, 0), seed=3), t=0.3)
    np.testing.assert_array_equal(step.pose, last)
    np.testing.assert_array_equal(lidar.poses[2], last)


def test_a_map_that_is_nothing_like_the_scan_is_lost_and_then_found():
    rng = RNG(21)
    here, there = FAMILIES["room"](rng), FAMILIES["pillars"](rng)
    lidar = odometry.LaserOdometry(scanner_of(FINE))
    for k in range(5):
        lidar.add(scan_at((0.03 * k, 0, 0), FINE, k, here), t=0.1 * k)
    status = [
        lidar.add(scan_at((0.03 * k, 0, 0), FINE, k, there), t=0.1 * k).status for k in range(5, 15)
    ]
    assert status[0] != "still"
    assert status[-1] in ("tracking", "lost")
    assert np.isfinite(lidar.poses).all()


def test_it_may_be_read_while_another_thread_adds():
    lidar = odometry.LaserOdometry(scanner_of(NARROW))
    run = record(FAMILIES["room"](RNG(1)), NARROW, RNG(1), 5.0, 10.0)
    done = threading.Event()

    def add_all():
        for t, scan in zip(run.times, run.scans, strict=True):
            lidar.add(scan, t=t)
        done.set()

    worker = threading.Thread(target=add_all)
    worker.start()
    seen = 0
    while not done.is_set():
        poses, points = lidar.poses, lidar.map_points
        assert np.isfinite(poses).all()
        assert np.isfinite(points).all()
        assert len(poses) >= seen
        seen = len(poses)
    worker.join()
    alone = odometry.LaserOdometry(scanner_of(NARROW))
    for t, scan in zip(run.times, run.scans, strict=True):
        alone.add(scan, t=t)
    np.testing.assert_array_equal(lidar.poses, alone.poses)
