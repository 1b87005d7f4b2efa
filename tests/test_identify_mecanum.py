"""Identification of mecanum wheels, on simulated records whose truth is known."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.stats import chi2

from thing_kin import estimation as est

RADIUS, K = 0.075, 0.33  # the truth
NOMINAL = {"wheel_radius": 0.07, "k": 0.369}
SLIP = np.array([1e-4, 2e-4, 3e-4])  # m^2/m, m^2/m, rad^2/m
MOUNT = np.array([0.08, -0.05, 0.3])
PLAIN = ("fl", "rl", "rr", "fr")


@dataclass(frozen=True)
class Record:
    """What identify_mecanum is given."""

    t: NDArray
    angles: NDArray
    t_reference: NDArray
    poses: NDArray
    truth: NDArray  # of the robot, at t


def composed(a, b):
    c, s = np.cos(a[:, 2]), np.sin(a[:, 2])
    x, y = a[:, 0] + c * b[0] - s * b[1], a[:, 1] + s * b[0] + c * b[1]
    return np.stack([x, y, a[:, 2] + b[2]], axis=1)


def simulate(
    seed: int = 0,
    turning: float = 0.6,
    duration: float = 60.0,
    slip: float = 1.0,
    noise: tuple[float, float] = (1e-3, 5e-3),
    mount: NDArray = MOUNT,
    order: tuple[str, ...] = PLAIN,
) -> Record:
    """Wheels at 50 Hz roll freely, the robot slips, a tracker at 100 Hz sees a body on it."""
    rng = np.random.default_rng(seed)
    t = 1.6e9 + np.arange(0.0, duration, 0.02)
    s = t - t[0]
    twists = np.stack(
        [0.3 * np.sin(0.5 * s + seed), 0.25 * np.cos(0.3 * s), turning * np.sin(0.23 * s)], axis=1
    )
    wheels = est.MecanumOdometry(RADIUS, K, order)
    rolled = np.cumsum(wheels.wheel_speeds(twists[1:]) * 0.02, axis=0)
    angles = np.vstack([np.zeros(4), rolled]) + rng.uniform(-50, 50, 4)
    travel = RADIUS * np.abs(np.diff(angles, axis=0)).mean(axis=1)
    slipped = rng.normal(size=(len(t) - 1, 3)) * np.sqrt(slip * SLIP * travel[:, None])
    truth = est.dead_reckon([1.0, -2.0, 0.4], twists[1:] * 0.02 + slipped, 1.0).poses
    truth[:, 2] = np.unwrap(truth[:, 2])
    t_reference = np.arange(t[0] + 0.013, t[-1] - 0.01, 0.01)
    at = np.stack([np.interp(t_reference, t, c) for c in truth.T], axis=1)
    seen = composed(at, mount) + rng.normal(size=at.shape) * [noise[0], noise[0], noise[1]]
    return Record(t, angles, t_reference, seen, truth)


def identify(record: Record, **options):
    return est.identify_mecanum(
        record.t,
        record.angles,
        record.t_reference,
        record.poses,
        **{**NOMINAL, **options},
    )


def values(found) -> NDArray:
    return np.array([found.wheel_radius, found.k, *found.mount])


TRUTH = np.array([RADIUS, K, *MOUNT])


def errors_in_deviations(found, truth=TRUTH) -> NDArray:
    return (values(found) - truth) / np.sqrt(np.diag(found.covariance)[:5])


def test_a_record_without_noise_shows_the_truth() -> None:
    """What is left is the interpolation of the reference in steps of 20 ms."""
    found = identify(simulate(slip=0.0, noise=(0.0, 0.0)))
    assert found.success
    assert found.status == "converged"
    np.testing.assert_allclose(values(found), TRUTH, atol=2e-4)
    assert found.rms_aligned < 1e-3
    assert found.odometry == est.MecanumOdometry(found.wheel_radius, found.k)


def test_its_covariance_is_honest() -> None:
    """Over 25 runs the NEES of five numbers is in the 99.9 % band of its mean (chi-square, 125)."""
    nees, inside, slips = [], [], []
    for seed in range(25):
        found = identify(simulate(seed))
        assert found.success
        assert all(found.identifiable[name] for name in found.names[:5])
        error = values(found) - TRUTH
        nees.append(error @ np.linalg.solve(found.covariance[:5, :5], error))
        inside.append(found.nees_inside)
        slips.append(found.slip_variance)
    low, high = chi2.ppf([0.0005, 0.9995], 5 * 25) / 25
    assert low < np.mean(nees) < high
    assert np.mean(inside) > 0.85
    # Axes turn within a window, which mixes x and y: each is known to a factor of two.
    ratio = np.median(slips, axis=0) / SLIP
    assert np.all((ratio > 0.5) & (ratio < 2.0))


def test_a_robot_that_does_not_turn_does_not_show_k() -> None:
    found = identify(simulate(turning=0.0))
    assert found.success
    assert found.identifiable == {
        "wheel_radius": True,
        "k": False,
        "mount_x": False,
        "mount_y": False,
        "mount_yaw": True,
        "clock_offset": False,
    }
    assert (found.k, found.k_std) == (0.369, 0.2 * 0.369)
    assert abs(found.wheel_radius - RADIUS) < 4 * found.wheel_radius_std
    assert found.wheel_radius_std < 1e-3
    assert found.covariance[1, 1] == pytest.approx((0.2 * 0.369) ** 2)
    assert "k = 0.369 +- 0.0738, not identifiable: nominal value kept" in found.report()


def test_a_robot_that_stands_shows_nothing() -> None:
    record = simulate(duration=10.0)
    still = replace(
        record,
        angles=np.tile(record.angles[0], (len(record.t), 1)),
        poses=np.tile(record.poses[0], (len(record.poses), 1)),
    )
    found = identify(still)
    assert found.status == "too little motion"
    assert not found.success
    assert not any(found.identifiable.values())
    assert (found.wheel_radius, found.k) == pytest.approx((0.07, 0.369))


@pytest.mark.parametrize("order", [("fl", "fr", "rl", "rr"), ("rr", "fr", "rl", "fl")])
def test_the_order_of_the_wheels_is_a_renaming(order) -> None:
    plain, other = simulate(), simulate(order=order)
    here = identify(plain)
    there = identify(replace(plain, angles=other.angles), order=order)
    np.testing.assert_allclose(values(there), values(here), rtol=1e-9)
    assert there.odometry.order == order


def test_no_nominal_values_are_needed() -> None:
    found = est.identify_mecanum(*list(vars(simulate()).values())[:4])
    assert found.success
    assert np.abs(errors_in_deviations(found)).max() < 4.5


@pytest.mark.parametrize("nominal", [(0.05, 0.25), (0.11, 0.55)])
def test_wrong_nominal_values_do_no_harm(nominal) -> None:
    good = identify(simulate(), wheel_radius_std=1.0, k_std=1.0)
    found = identify(
        simulate(), wheel_radius=nominal[0], k=nominal[1], wheel_radius_std=1.0, k_std=1.0
    )
    np.testing.assert_allclose(values(found), values(good), atol=2e-4)


@pytest.mark.parametrize("yaw", [-3.0, -1.5, 1.5, np.pi])
def test_the_reference_may_be_mounted_in_any_direction(yaw: float) -> None:
    mount = np.array([0.08, -0.05, yaw])
    found = identify(simulate(mount=mount))
    off = est.pose_difference(found.mount, mount) / np.sqrt(np.diag(found.covariance)[2:5])
    assert np.abs(off).max() < 4.5
    assert abs(found.wheel_radius - RADIUS) < 4.5 * found.wheel_radius_std


def test_the_world_may_be_moved() -> None:
    record = simulate()
    found = identify(record)
    origin = np.array([3.0, -4.0, 2.5])
    c, s = np.cos(origin[2]), np.sin(origin[2])
    x, y, theta = record.poses.T
    moved = np.stack([origin[0] + c * x - s * y, origin[1] + s * x + c * y, theta + 2.5], axis=1)
    there = identify(replace(record, poses=moved))
    # Medians of x and y depend on the axes: a tenth of a standard deviation.
    assert np.abs(errors_in_deviations(there, values(found))).max() < 0.5


def test_outliers_of_the_reference_hardly_count() -> None:
    record = simulate()
    rng = np.random.default_rng(5)
    poses = record.poses.copy()
    wild = rng.uniform(size=len(poses)) < 0.1
    poses[wild] += rng.normal(size=(wild.sum(), 3)) * [1.0, 1.0, 2.0]
    poses[2000:2300] += [2.0, -1.0, 1.0]  # another body for three seconds
    found = identify(replace(record, poses=poses))
    assert found.success
    assert found.outliers >= 2
    assert np.abs(errors_in_deviations(found)).max() < 5
    assert abs(found.wheel_radius - RADIUS) < 1e-3


def test_gaps_of_both_records() -> None:
    record = simulate()
    kept = np.ones(len(record.t), dtype=bool)
    kept[1000:1100] = False  # two seconds without wheels
    seen = np.ones(len(record.t_reference), dtype=bool)
    seen[3500:3900] = False  # four seconds without a reference
    found = identify(
        replace(
            record,
            t=record.t[kept],
            angles=record.angles[kept],
            t_reference=record.t_reference[seen],
            poses=record.poses[seen],
        )
    )
    assert found.success
    assert found.windows < 57
    assert np.abs(errors_in_deviations(found)).max() < 4.5


@pytest.mark.parametrize("offset", [-0.6, 0.25])
def test_two_clocks(offset: float) -> None:
    record = simulate()
    found = identify(replace(record, t=record.t + offset), clock_offset_std=0.3)
    assert found.success
    assert found.identifiable["clock_offset"]
    # In the wheels' steps of 20 ms the speed changes by 5 mm/s.
    assert abs(found.clock_offset - offset) < 4.5 * found.clock_offset_std + 2e-3
    assert found.clock_offset_std < 0.03
    assert np.abs(errors_in_deviations(found)).max() < 4.5


def test_encoders_that_overflow() -> None:
    record = simulate()
    ticks = np.round(record.angles * 2100 / (2 * np.pi))
    angles = est.angles_from_ticks(np.mod(ticks, 4096), 2100, counter_range=4096)
    found = identify(replace(record, angles=angles))
    assert np.abs(errors_in_deviations(found)).max() < 4.5


def test_a_slow_reference() -> None:
    record = simulate(duration=120.0)
    found = identify(
        replace(record, t_reference=record.t_reference[::40], poses=record.poses[::40]),
        window=2.0,
    )
    assert found.success
    assert np.abs(errors_in_deviations(found)).max() < 4.5


def test_what_is_known_is_not_changed() -> None:
    found = identify(simulate(), wheel_radius=0.075, wheel_radius_std=0.0, mount=MOUNT,
                     mount_std=(0.0, 0.0, 0.0))  # fmt: skip
    assert found.wheel_radius == pytest.approx(0.075, rel=1e-15)
    np.testing.assert_array_equal(found.mount, MOUNT)
    assert found.wheel_radius_std == 0.0
    assert abs(found.k - K) < 4 * found.k_std


def test_where_the_robot_began() -> None:
    record = simulate()
    found = identify(record)
    truth = np.array([np.interp(found.start_time, record.t, c) for c in record.truth.T])
    error = est.pose_difference(found.start, truth)
    assert error @ np.linalg.solve(found.start_covariance, error) < 16.3  # 99.9 %, 3 degrees
    aligned = found.odometry.integrate_angles(record.t, record.angles, found.aligned_pose)
    rms = np.sqrt(np.mean(np.sum((aligned.poses - record.truth)[:, :2] ** 2, axis=1)))
    assert rms == pytest.approx(found.rms_aligned, rel=0.1)
    assert found.rms_aligned < found.rms_unaligned < found.rms_nominal


def test_answers_are_repeatable() -> None:
    here, there = identify(simulate()), identify(simulate())
    np.testing.assert_array_equal(values(here), values(there))
    np.testing.assert_array_equal(here.covariance, there.covariance)


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("t", {"t": np.zeros(3000)}),
        ("t", {"t": np.arange(3000.0)[::-1]}),
        ("wheel_angles", {"angles": np.zeros((5, 4))}),
        ("wheel_angles", {"angles": np.full((3000, 4), np.nan)}),
        ("t_reference", {"t_reference": np.arange(5996.0)}),
        ("poses", {"poses": np.zeros((5, 3))}),
        ("poses", {"poses": np.full((5986, 3), np.inf)}),
    ],
)
def test_bad_records(name: str, arguments) -> None:
    with pytest.raises(ValueError, match=f"^{name}: got"):
        identify(replace(simulate(), **arguments))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("wheel_radius", -1.0),
        ("k", 0.0),
        ("wheel_radius_std", -0.1),
        ("k_std", np.nan),
        ("mount", [0.0, 0.0]),
        ("mount_std", [0.1, 0.1, -1.0]),
        ("clock_offset_std", np.inf),
        ("window", 0.0),
        ("longest_gap", -1.0),
        ("order", ("fl", "fr")),
    ],
)
def test_bad_options(name: str, value) -> None:
    with pytest.raises(ValueError, match=f"^{name}: got"):
        identify(simulate(duration=5.0), **{name: value})


@pytest.mark.parametrize("nominal", [np.pi, -np.pi])
@pytest.mark.parametrize("std", [3.0, 0.05])
def test_a_reference_that_looks_backward(nominal: float, std: float) -> None:
    """Half a turn is the same from either side."""
    mount = np.array([0.08, -0.05, -3.13])
    found = identify(simulate(mount=mount), mount=(0.08, -0.05, nominal), mount_std=(0.1, 0.1, std))
    assert found.success
    assert found.identifiable["mount_yaw"]
    np.testing.assert_allclose(found.mount, mount, atol=0.02)


@pytest.mark.parametrize("std", [3.0, 4.0, 8.0, 1e12])
def test_clocks_that_may_be_off_by_more_than_the_record_lasts(std: float) -> None:
    """Offsets at which the records hardly meet agree with anything."""
    found = identify(simulate(duration=12.0), clock_offset_std=std)
    assert found.success
    assert found.clock_offset == pytest.approx(0.0, abs=0.02)
