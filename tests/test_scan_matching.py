"""One match: errors where the truth is exact, a covariance to believe, what can't be matched."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ray_casting import World
from scan_drives import SENSORS, Sensor, between, compose, pair
from scan_statistics import INSIDE, KNOWN, matches, scanner_of
from scan_worlds import FAMILIES, turned_box
from thing_kin import odometry

RNG = np.random.default_rng
NARROW, FINE, TURN = (
    SENSORS[name]
    for name in ("180 beams, 180 degrees", "1081 beams, 270 degrees", "360 beams, whole turn")
)
MIDDLE = SENSORS["361 beams, 180 degrees"]
STANDING = replace(FINE, scan_time=0.0)
QUIET = Sensor(-np.pi, np.pi - np.pi / 360, 720, noise=0.0, dropouts=0.0)
ROOM = World(np.array([[-4, -3, 4, -3], [4, -3, 4, 3], [4, 3, -4, 3], [-4, 3, -4, -3.0]]))


def scan_of(world, sensor, pose, rng=None):
    pose = np.asarray(pose, dtype=float)
    rng = rng or RNG(0)
    return sensor.scan(world, lambda t: np.tile(pose, (len(t), 1)), 0.0, rng)


# --- errors against truth -----------------------------------------------------------------------


@pytest.mark.parametrize("family", KNOWN)
@pytest.mark.parametrize("sensor", [NARROW, MIDDLE, FINE], ids=lambda s: f"{s.n} beams")
def test_errors_in_each_family(family, sensor):
    found = matches(family, sensor, 12, seed=1)
    way = np.hypot(*found.errors[:, :2].T)
    assert not found.unsaid.any(), np.array(found.seeds)[found.unsaid]
    sure = found.converged & ~found.degenerate
    assert np.median(way[sure]) < (0.012 if sensor.n < 1000 else 0.006)
    assert np.median(np.abs(found.errors[sure, 2])) < 0.006


def test_without_noise_the_match_is_exact():
    a, b = np.array([0.5, -0.3, 0.2]), np.array([0.7, -0.2, 0.5])
    match = odometry.match(scanner_of(QUIET), scan_of(ROOM, QUIET, a), scan_of(ROOM, QUIET, b))
    assert match.status == "converged"
    # Walls are straight: point to line has no error of its own but where lines span a corner.
    np.testing.assert_allclose(match.pose, between(a, b), atol=1e-3)


def test_a_scan_against_itself():
    scan = scan_of(ROOM, MIDDLE, (0.3, 0.2, 0.1))
    match = odometry.match(scanner_of(MIDDLE), scan, scan)
    assert match.status == "converged"
    np.testing.assert_allclose(match.pose, 0, atol=1e-3)  # lines are means, points are not


# --- what must not change it --------------------------------------------------------------------


@settings(max_examples=15)
@given(st.tuples(*[st.floats(-0.5, 0.5)] * 2, st.floats(-3, 3)))
def test_the_mount_turns_the_answer_and_nothing_else(mount):
    two = pair(FAMILIES["room"](RNG(2)), MIDDLE, RNG(3))
    plain = odometry.match(scanner_of(MIDDLE), two.a, two.b)
    moved = odometry.Scanner(**{**MIDDLE.arguments(), "mount": mount})
    m = np.array(mount)
    off = odometry.match(moved, two.a, two.b)
    # The laser's motion is the same, so that the robot's is its conjugate by the mount.
    expected = compose(m, compose(np.asarray(plain.pose), between(m, np.zeros(3))))
    np.testing.assert_allclose(off.pose, expected, atol=2e-3)


def test_a_scanner_that_hangs_upside_down_tells_the_same():
    two = pair(FAMILIES["room"](RNG(4)), MIDDLE, RNG(4))
    given = MIDDLE.arguments()
    falling = {**given, "angle_min": given["angle_max"], "angle_max": given["angle_min"]}
    one = odometry.match(scanner_of(MIDDLE), two.a, two.b)
    other = odometry.match(odometry.Scanner(**falling), two.a[::-1], two.b[::-1])
    # Points are merged in the other order: a share of the 2 mm that such a match is good to.
    np.testing.assert_allclose(other.pose, one.pose, atol=1e-3)
    np.testing.assert_allclose(other.covariance, one.covariance, rtol=0.2, atol=1e-6)


def test_the_guess_turns_with_the_world_it_is_made_in():
    """Both robots turned by the same on the spot: b in a is another, the scans' worth is not."""
    room, sensor = FAMILIES["room"](RNG(6)), replace(TURN, noise=0.0, dropouts=0.0)
    a, b = np.zeros(3), np.array([0.1, 0.05, 0.1])
    for yaw in (0.5, 2.0, -3.0):
        turn = np.array([0.0, 0.0, yaw])
        scans = [scan_of(room, sensor, compose(p, turn)) for p in (a, b)]
        match = odometry.match(scanner_of(sensor), *scans)
        expected = between(compose(a, turn), compose(b, turn))
        np.testing.assert_allclose(match.pose, expected, atol=0.01)


def test_both_ways_are_inverse():
    for seed in range(5):
        two = pair(FAMILIES["room"](RNG(seed)), FINE, RNG(seed))
        there = odometry.match(scanner_of(FINE), two.a, two.b)
        back = odometry.match(scanner_of(FINE), two.b, two.a)
        # Not nearer: on round things both ways are wrong towards them, see below.
        np.testing.assert_allclose(compose(there.pose, back.pose), 0, atol=0.02)


@pytest.mark.parametrize("radius", [0.2, 0.3, 0.5, 1.0])
def test_round_things_pull_by_a_centimeter_at_most(radius):
    """Lines through arcs lie behind them: with all pillars in front the error is one-sided."""
    errors = []
    for k in range(10):
        rng = RNG((7, k))
        centers = np.stack(
            [rng.uniform(2, 6, 8), rng.uniform(-4, 4, 8), np.full(8, radius)], axis=1
        )
        hall = World(np.empty((0, 4)), centers)
        b = rng.uniform(-0.05, 0.05, 3)
        scans = [scan_of(hall, STANDING, p, rng) for p in (np.zeros(3), b)]
        errors.append(np.asarray(odometry.match(scanner_of(STANDING), *scans).pose) - b)
    assert np.abs(np.mean(errors, axis=0)).max() < 0.013


def test_it_is_a_function_of_its_arguments():
    two = pair(FAMILIES["people"](RNG(5)), FINE, RNG(5))
    scanner = scanner_of(FINE)
    before = two.a.copy(), two.b.copy()
    one, other = (odometry.match(scanner, two.a, two.b) for _ in range(2))
    np.testing.assert_array_equal(one.pose, other.pose)
    np.testing.assert_array_equal(one.covariance, other.covariance)
    np.testing.assert_array_equal(two.a, before[0])
    np.testing.assert_array_equal(two.b, before[1])


# --- recovery -----------------------------------------------------------------------------------


@pytest.mark.parametrize("sensor", [FINE, TURN], ids=lambda s: f"{s.n} beams")
def test_recovery_from_half_a_meter_and_45_degrees(sensor):
    lost = unsaid = count = 0
    for family in ("room", "glass", "people", "pillars"):
        found = matches(family, sensor, 10, seed=2, guess_error=(0.5, np.pi / 4))
        lost, unsaid, count = lost + found.lost.sum(), unsaid + found.unsaid.sum(), count + 10
    assert lost <= 0.05 * count
    assert unsaid <= 0.05 * count


# --- the covariance -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("family", "inside"),
    [
        ("room", 0.9),
        ("empty room", 0.9),
        ("corridor, pillars", 0.95),
        ("glass", 0.9),
        ("pillars", 0.85),  # round things, see above
        ("people", 0.95),
    ],
)
def test_nees_is_in_its_band(family, inside):
    found = matches(family, MIDDLE, 60, seed=3)
    nees = found.nees
    assert len(nees) > 45
    assert np.mean(nees < INSIDE) >= inside
    assert 0.4 < np.median(nees) < 4.0  # of chi-square of 3: 2.37
    assert nees.mean() < 4.0  # 3


def test_noise_is_counted_once():
    """Over families, as each has some matches only."""
    found = [matches(f, MIDDLE, 60, seed=3) for f in ("room", "empty room", "glass")]
    assert np.mean(np.concatenate([f.nees for f in found])) > 1.25  # 3 were exact; twice: 1.1


def corridor_with(things, end=40.0):
    """Walls along x, one across at the end, and boxes: x, y, size."""
    walls = [[-30, -1.2, 40, -1.2], [-30, 1.2, 40, 1.2], [end, -1.2, end, 1.2]]
    boxes = [turned_box(np.array([x, y]), size, size, 0.0) for x, y, size in things]
    return World(np.vstack([walls, *boxes]))


def nees_from(match, truth):
    return (match.pose - truth) @ np.linalg.solve(match.covariance, match.pose - truth)


def test_what_hangs_on_one_thing_is_as_uncertain_as_that_thing():
    # It has moved, and tells more of x than the wall behind: the fit goes with it.
    before, after = (corridor_with([(x, 0.6, 0.8)], end=4.0) for x in (1.2, 1.28))
    sensor = replace(MIDDLE, dropouts=0.0)
    for seed in range(10):
        a = scan_of(before, sensor, (0, 0, 0), RNG(seed))
        b = scan_of(after, sensor, (0, 0, 0), RNG(seed + 100))
        match = odometry.match(scanner_of(sensor), a, b)
        assert match.status == "converged"
        assert not match.degenerate
        assert match.pose[0] < -0.04
        assert nees_from(match, np.zeros(3)) < INSIDE


def test_two_fits_that_are_as_good_are_ambiguous():
    still, walking = [(2.5, 0.7, 0.5), (5.0, -0.7, 0.5)], [(2.5, -0.7, 0.5), (5.0, 0.7, 0.5)]
    moved = [(x + 0.3, y, size) for x, y, size in walking]
    before, after = corridor_with(still + walking), corridor_with(still + moved)
    sensor = replace(FINE, scan_time=0.0, dropouts=0.0)
    scanner = scanner_of(sensor)
    a = scan_of(before, sensor, (0, 0, 0), RNG(1))
    b = scan_of(after, sensor, (0, 0, 0), RNG(2))
    for guess in (0.0, -0.15, -0.3):  # the guess counts a little where scans don't decide
        match = odometry.match(scanner, a, b, guess=(guess, 0, 0), search_below=1.0)
        assert match.status == "converged"
        assert match.ambiguous
        assert "ambiguous" in repr(match)
        for truth in (0.0, -0.3):
            assert nees_from(match, np.array([truth, 0.0, 0.0])) < INSIDE
        sd = np.sqrt(np.diag(match.covariance))
        assert 0.15 < sd[0] < 0.19  # 0.21 were half and half; walls stand still, too
        assert sd[1] < 0.01
        np.testing.assert_allclose(match.scan_covariance, match.covariance, rtol=1e-9)
    # The larger is what stands, the less the rest counts.
    large = [(x, y, 0.8) for x, y, _ in still]
    a = scan_of(corridor_with(large + walking), sensor, (0, 0, 0), RNG(1))
    b = scan_of(corridor_with(large + moved), sensor, (0, 0, 0), RNG(2))
    match = odometry.match(scanner, a, b, guess=(-0.15, 0, 0), search_below=1.0)
    assert match.ambiguous
    assert 0.06 < np.sqrt(match.covariance[0, 0]) < 0.12
    a = scan_of(before, sensor, (0, 0, 0), RNG(1))
    b = scan_of(before, sensor, (0, 0, 0), RNG(2))
    alone = odometry.match(scanner, a, b, search_below=1.0)
    assert not alone.ambiguous
    assert np.sqrt(alone.covariance[0, 0]) < 0.01


def test_fitness_is_of_all_points_wherever_the_iteration_ends():
    two = pair(FAMILIES["room"](RNG(3)), STANDING, RNG(3))
    guess = two.truth + np.array([0.05, 0.05, 0.02])
    for most in (1, 2, 3, 30):
        match = odometry.match(
            scanner_of(STANDING), two.a, two.b, guess=guess, max_iterations=most, search_below=0.0
        )
        assert match.status == ("converged" if most == 30 else "iteration_limit")
        assert match.fitness > 0.9
        assert match.inliers > 0.9


def test_covariances_are_covariances():
    for family in FAMILIES:
        for covariance in matches(family, NARROW, 5, seed=4).covariances:
            np.testing.assert_array_equal(covariance, covariance.T)
            assert np.linalg.eigvalsh(covariance)[0] > 0
            assert np.isfinite(covariance).all()


@pytest.mark.parametrize("sensor", [NARROW, FINE], ids=lambda s: f"{s.n} beams")
def test_a_corridor_says_along_which_direction_it_knows_nothing(sensor):
    for k in range(10):
        rng = RNG((6, k))
        world = FAMILIES["corridor, plain"](rng)
        heading = rng.uniform(-0.4, 0.4)
        a = np.array([0.0, rng.uniform(-0.3, 0.3), heading])
        b = compose(a, np.array([rng.uniform(0, 0.3), 0.02, rng.uniform(-0.2, 0.2)]))
        scans = [scan_of(world, sensor, p, rng) for p in (a, b)]
        guess = between(a, b) + np.array([0.05, 0.0, 0.05])
        match = odometry.match(scanner_of(sensor), *scans, guess=tuple(guess))
        assert match.degenerate, k
        along = np.array([np.cos(heading), -np.sin(heading), 0.0])
        across = np.array([np.sin(heading), np.cos(heading), 0.0])
        covariance = np.asarray(match.covariance)
        assert np.sqrt(along @ covariance @ along) > 0.1, k
        assert np.sqrt(across @ covariance @ across) < 0.03, k
        # The guess stays along the corridor; across and in the turn the walls speak.
        away = np.asarray(match.pose) - between(a, b)
        assert abs(away @ along - (guess - between(a, b)) @ along) < 0.02, k
        assert abs(away @ across) < 0.03, k
        assert abs(away[2]) < 0.02, k


def test_what_is_untold_has_the_variance_of_the_guess_or_none_of_use():
    """Two sides of a wall that no beam sees the ends of: along it the guess, or 100 m alone."""
    wall = World(np.array([[2.0, -90, 2, 90]]))
    sigma = np.array([0.3, 0.2, 0.1])
    scans = [scan_of(wall, NARROW, p) for p in ((0, 0, 0), (0.1, 0.1, 0.05))]
    match = odometry.match(scanner_of(NARROW), *scans, guess_covariance=np.diag(sigma**2))
    np.testing.assert_allclose(np.abs(match.directions), [[0, 1, 0]], atol=0.01)
    for covariance, along in ((match.covariance, sigma[1] ** 2), (match.scan_covariance, 1e4)):
        variance, direction = np.linalg.eigh(covariance)
        # A normal that is off by 0.01 takes 1e-4 of it and adds as much of the other's.
        assert variance[2] == pytest.approx(along, rel=0.01)
        np.testing.assert_allclose(np.abs(direction[:, 2]), [0, 1, 0], atol=0.01)
        assert np.sqrt(variance[:2]).max() < 0.02


def test_a_single_wall_is_degenerate_too():
    wall = World(np.array([[2.0, -90, 2, 90]]))
    scans = [scan_of(wall, NARROW, p) for p in ((0, 0, 0), (0.1, 0.1, 0.05))]
    match = odometry.match(scanner_of(NARROW), *scans)
    assert match.degenerate
    assert np.sqrt(match.covariance[1, 1]) > 0.1
    assert abs(match.pose[0] - 0.1) < 0.02


def test_a_circle_tells_no_turn():
    tower = World(np.empty((0, 4)), np.array([[0.0, 0, 3]]))
    scans = [scan_of(tower, QUIET, p) for p in ((0, 0, 0), (0.1, 0.05, 0.3))]
    match = odometry.match(scanner_of(QUIET), *scans)
    assert match.degenerate
    assert np.sqrt(match.covariance[2, 2]) > 0.05


@pytest.mark.parametrize("family", ["room", "empty room"])
def test_a_room_is_not_called_degenerate(family):
    assert matches(family, FINE, 20, seed=7).degenerate.sum() == 0


# --- what can't be matched ----------------------------------------------------------------------

GOOD = scan_of(ROOM, NARROW, (0.0, 0.0, 0.0))
BAD = {
    "all infinite": np.full(180, np.inf),
    "all too near": np.full(180, -np.inf),
    "all NaN": np.full(180, np.nan),
    "a single beam": np.where(np.arange(180) == 90, 2.0, np.inf),
    "two beams": np.where(np.arange(180) % 90 == 45, 2.0, np.inf),
    "all zero": np.zeros(180),
    "beyond the range": np.full(180, 1e6),
}


@pytest.mark.parametrize("name", BAD)
@pytest.mark.parametrize("swapped", [False, True])
def test_scans_without_content(name, swapped):
    scans = (GOOD, BAD[name])[:: -1 if swapped else 1]
    match = odometry.match(scanner_of(NARROW), *scans, guess=(0.1, 0.0, 0.2))
    assert match.status != "converged"
    np.testing.assert_allclose(match.pose, (0.1, 0.0, 0.2))  # nothing better is known
    assert np.isfinite(match.covariance).all()
    assert np.linalg.eigvalsh(match.covariance)[0] > 0
    assert np.sqrt(np.diag(match.covariance)).min() > 0.05


@pytest.mark.parametrize(
    "scan",
    [np.full(180, 3.0), GOOD[::-1], RNG(0).uniform(0.1, 30, 180), -GOOD],
    ids=["constant", "reversed", "random", "negative"],
)
def test_scans_of_nothing_that_is(scan):
    match = odometry.match(scanner_of(NARROW), GOOD, scan)
    assert np.isfinite(match.pose).all()
    assert np.isfinite(match.covariance).all()
    assert np.linalg.eigvalsh(match.covariance)[0] > 0


@pytest.mark.parametrize("seed", range(8))
def test_whatever_comes_the_answer_is_numbers(seed):
    rng = RNG((30, seed))
    for _ in range(40):
        n = int(rng.choice([1, 2, 3, 5, 30, 180]))
        first = rng.uniform(-4, 4)
        last = first + rng.choice([-1, 1]) * rng.choice([1e-3, 0.1, 1, 6])
        scanner = odometry.Scanner(first, last, n, range_max=float(rng.choice([1, 30, np.inf])))
        scans = 10.0 ** rng.uniform(rng.choice([-300, -3, 0]), rng.choice([1, 4, 300]), (2, n))
        odd = rng.choice([np.nan, np.inf, -np.inf, 0, -1, 1e308, 5e-324])
        scans[rng.random((2, n)) < rng.choice([0, 0.1, 0.9])] = odd
        match = odometry.match(scanner, *scans, guess=tuple(rng.normal(size=3)))
        assert np.isfinite(match.pose).all()
        assert np.isfinite(match.covariance).all()
        np.testing.assert_array_equal(match.covariance, np.transpose(match.covariance))
        values = np.linalg.eigvalsh(match.covariance)
        assert values[0] > -1e-12 * values[-1]


def test_a_few_bad_beams_do_no_harm():
    two = pair(FAMILIES["room"](RNG(8)), MIDDLE, RNG(8))
    rng = RNG(9)
    for value in (np.nan, np.inf, -np.inf, 0.0, -1.0, 1e300):
        hurt = np.where(rng.random(361) < 0.1, value, two.b)
        match = odometry.match(scanner_of(MIDDLE), two.a, hurt)
        assert match.status == "converged"
        assert np.abs(np.asarray(match.pose) - two.truth).max() < 0.03


@pytest.mark.parametrize(
    ("change", "argument"),
    [
        ({"ranges_a": GOOD[:-1]}, "ranges_a"),
        ({"ranges_b": np.append(GOOD, 1.0)}, "ranges_b"),
        ({"ranges_b": np.empty(0)}, "ranges_b"),
        ({"guess": (0.0, 0.0)}, "guess"),
        ({"guess": (0.0, np.nan, 0.0)}, "guess"),
        ({"guess": (np.inf, 0.0, 0.0)}, "guess"),
        ({"guess_covariance": np.eye(2)}, "guess_covariance"),
        ({"guess_covariance": -np.eye(3)}, "guess_covariance"),
        ({"guess_covariance": np.full((3, 3), np.nan)}, "guess_covariance"),
    ],
)
def test_misuse_names_the_argument(change, argument):
    given = {"ranges_a": GOOD, "ranges_b": GOOD, "guess": (0.0, 0.0, 0.0), **change}
    a, b = given.pop("ranges_a"), given.pop("ranges_b")
    with pytest.raises(ValueError, match=rf"^{argument}"):
        odometry.match(scanner_of(NARROW), a, b, **given)


@pytest.mark.parametrize(
    ("change", "argument"),
    [
        ({"n": 0}, "n"),
        ({"n": 10**6}, "n"),
        ({"n": -5}, "n"),
        ({"angle_min": np.nan}, "angle_min"),
        ({"angle_max": np.inf}, "angle_max"),
        ({"angle_max": NARROW.angle_min}, "angle_max"),
        ({"angle_max": 20.0}, "angle_max"),
        ({"range_min": -1.0}, "range_min"),
        ({"range_max": 0.01}, "range_max"),
        ({"range_max": np.nan}, "range_max"),
        ({"mount": (0.0, 0.0)}, "mount"),
        ({"mount": (0.0, np.nan, 0.0)}, "mount"),
        ({"scan_time": -0.1}, "scan_time"),
        ({"scan_time": np.inf}, "scan_time"),
        ({"noise": 0.0}, "noise"),
        ({"noise": np.nan}, "noise"),
    ],
)
def test_scanners_that_cannot_be(change, argument):
    with pytest.raises(ValueError, match=rf"^{argument}"):
        odometry.Scanner(**{**NARROW.arguments(), **change})


def test_the_ust_10lx():
    scanner = odometry.Scanner.ust10lx(mount=(0.3, 0.0, 0.1))
    assert len(scanner.angles) == 1081
    np.testing.assert_allclose(np.degrees(scanner.angles[[0, 540, -1]]), [-135, 0, 135], atol=1e-9)
    np.testing.assert_allclose(scanner.mount, (0.3, 0.0, 0.1))
