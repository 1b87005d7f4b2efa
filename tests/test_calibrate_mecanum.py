"""Wheels in the frame of results that arms have: table, residuals, folds, outliers, plot."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.stats import chi2

import thing_kin as tk
from test_identify_mecanum import MOUNT, NOMINAL, RADIUS, TRUTH, K, Record, composed, simulate
from thing_kin import estimation as est

NUMBERS = ("wheel_radius", "k", "mount_x", "mount_y", "mount_yaw")


def calibrate(record: Record, **options: object) -> est.MecanumCalibration:
    return est.calibrate_mecanum(
        record.t, record.angles, record.t_reference, record.poses, **{**NOMINAL, **options}
    )


def test_its_numbers_are_those_of_identification() -> None:
    record = simulate()
    result = calibrate(record)
    found = est.identify_mecanum(
        record.t, record.angles, record.t_reference, record.poses, **NOMINAL
    )
    assert result.success
    assert result.names == NUMBERS  # the clocks were said to be one
    assert_allclose(result.nominal, [0.07, 0.369, 0, 0, 0])
    rows = {row.name: row for row in result.table}
    assert rows["wheel_radius"].value == pytest.approx(found.wheel_radius, rel=1e-15)
    assert rows["k"].value == pytest.approx(found.k, rel=1e-15)
    assert rows["k"].change == pytest.approx(found.k - 0.369, rel=1e-12)
    assert rows["k"].std == pytest.approx(found.k_std, rel=1e-12)
    assert_allclose([rows[n].value for n in NUMBERS[2:]], found.mount, rtol=1e-12)
    assert [row.unit for row in result.table] == ["m", "m", "m", "m", "rad"]
    assert result.odometry == found.odometry
    assert (result.wheel_radius, result.k) == (found.wheel_radius, found.k)


def test_deviations_are_honest() -> None:
    """Share of five numbers in their 95 % bands, 20 drives: correlated, so 0.04 or so."""
    inside = []
    for seed in range(20):
        result = calibrate(simulate(seed))
        error = result.nominal + result.values - TRUTH
        inside.append(np.abs(error) < 1.96 * result.std)
    assert 0.85 < np.mean(inside) <= 1.0


def test_residuals_before_and_after() -> None:
    record = simulate(noise=(1e-4, 1e-4), slip=0.1)
    result = calibrate(record)
    assert result.errors.shape == result.errors_nominal.shape == (len(result.times), 3)
    assert result.rms_position < 0.2 * result.rms_position_nominal
    assert result.rms_rotation < 0.2 * result.rms_rotation_nominal
    # A radius of 70 mm for 75: what the wheels say is short by a fifteenth of the way.
    path = result.odometry.integrate_angles(record.t, record.angles).poses
    at = np.stack([np.interp(result.times, record.t, c) for c in path.T], axis=1)
    way = np.linalg.norm(np.diff(at[:, :2], axis=0), axis=1)
    straight = np.abs(np.diff(np.unwrap(at[:, 2]))) < 0.05
    ratio = np.linalg.norm(result.errors_nominal[:-1, :2], axis=1)[straight] / way[straight]
    assert np.median(ratio) == pytest.approx(1 / 15, abs=0.02)


def test_motions_are_as_far_off_as_they_say() -> None:
    distances = np.concatenate([calibrate(simulate(seed)).distances for seed in range(5)])
    # Mean of chi-square over three degrees; axes turn within a window, which mixes variances.
    assert 0.5 < np.mean(distances**2) / 3 < 2.0


def test_without_noise_nothing_is_left() -> None:
    """But the interpolation of the reference in steps of 20 ms."""
    result = calibrate(simulate(slip=0.0, noise=(0.0, 0.0)))
    assert result.rms_position < 2e-4
    assert result.rms_rotation < 2e-4


def test_outliers_are_listed() -> None:
    record = simulate()
    poses = record.poses.copy()
    poses[2000:2300] += [2.0, -1.0, 1.0]  # another body for three seconds
    result = calibrate(replace(record, poses=poses))
    at = result.times[list(result.outliers)] - record.t[0]
    assert ((at > 18.0) & (at < 24.0)).sum() >= 2  # where it begins and ends
    assert len(at) <= 4
    clean = calibrate(record)
    assert len(clean.outliers) <= 1


def test_held_out_stretches() -> None:
    result = calibrate(simulate(), folds=4)
    assert len(result.fold_rms) == 4
    assert result.cross_validated_rms_position == pytest.approx(result.rms_position, rel=0.3)
    assert result.cross_validated_rms_rotation == pytest.approx(result.rms_rotation, rel=0.3)
    assert "held out" in result.report()
    again = calibrate(simulate(), folds=4)
    assert again.fold_rms == result.fold_rms
    for folds in (-1, 0, 1):
        with pytest.raises(ValueError, match=f"^folds: got {folds}, expected at least 2"):
            result.cross_validated(folds)


def test_a_fold_is_not_seen_by_what_predicts_it() -> None:
    """Wheels that shrink for the second half: only held out it shows."""
    record = simulate(slip=0.0, noise=(1e-4, 1e-4))
    angles = record.angles.copy()
    half = len(angles) // 2
    angles[half:] = angles[half] + 1.05 * (angles[half:] - angles[half])
    spoiled = calibrate(replace(record, angles=angles), folds=2)
    assert spoiled.cross_validated_rms_position > 1.5 * spoiled.rms_position


def test_a_robot_that_does_not_turn() -> None:
    result = calibrate(simulate(turning=0.0))
    assert result.unidentifiable == result.combinations == ("k", "mount_x", "mount_y")
    assert np.isinf(result.std[result.names.index("k")])
    assert result.parameters["k"] == 0.0
    report = result.report()
    assert "told by turning" in report
    assert any(line.startswith("k ") and "not told" in line for line in report.splitlines())


def test_a_robot_that_stands() -> None:
    record = simulate(duration=10.0)
    still = replace(
        record,
        angles=np.tile(record.angles[0], (len(record.t), 1)),
        poses=np.tile(record.poses[0], (len(record.poses), 1)),
    )
    result = calibrate(still)
    assert not result.success
    assert set(result.unidentifiable) == set(NUMBERS)
    assert "TOO LITTLE MOTION" in result.report()


def test_what_was_given_as_known_is_not_in_the_table() -> None:
    result = calibrate(simulate(), mount=MOUNT, mount_std=(0.0, 0.0, 0.0))
    assert result.names == ("wheel_radius", "k")
    result = calibrate(simulate(), clock_offset_std=0.1)
    assert result.names[-1] == "clock_offset"
    assert result.table[-1].unit == "s"


def test_no_nominal_values() -> None:
    result = est.calibrate_mecanum(*list(vars(simulate()).values())[:4])
    assert_allclose(result.nominal[:2], [0.1, 0.4])
    assert result.wheel_radius == pytest.approx(RADIUS, abs=1e-3)
    assert result.k == pytest.approx(K, abs=1e-2)


def test_arm_and_wheels_in_one_report() -> None:
    arm = tk.robots.ur5()
    q = arm.random(30, rng=0)
    of_arm = est.calibrate(arm, q, arm.fk(q))
    text = est.calibration_report(arm=of_arm, wheels=calibrate(simulate()))
    assert text.count("parameter ") == 1  # one table
    for line in ("--- arm", "--- wheels", "Calibration of ur5", "Calibration of mecanum wheels"):
        assert line in text
    for name in of_arm.names:
        assert f"arm.{name}" in text
    assert "wheels.wheel_radius" in text


def test_the_plot() -> None:
    result = calibrate(simulate())
    figure = result.plot()
    assert [axes.get_xlabel() for axes in figure.axes[:2]] == ["motion", "error [mm]"]
    assert [t.get_text() for t in figure.axes[2].get_xticklabels()] == ["wheel_radius", "k"]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"folds": 1}, "folds: got 1"),
        ({"folds": 20}, "folds: got 20"),  # none is as long as a window
        ({"folds": 500}, "folds: got 500"),
        ({"gate": 1.0}, "gate: got 1"),
        ({"wheel_radius": -1.0}, "wheel_radius: got"),
        ({"mount": (0, 0)}, "mount: got"),
    ],
)
def test_misuse(options: dict[str, object], said: str) -> None:
    with pytest.raises(ValueError) as error:  # noqa: PT011 - the text is compared below
        calibrate(simulate(duration=10.0), **options)
    assert str(error.value).startswith(said)


def test_two_clocks_leave_no_more() -> None:
    record = simulate(noise=(1e-4, 1e-4), slip=0.1)
    plain = calibrate(record)
    shifted = replace(record, t=record.t + 0.25)
    ahead = calibrate(shifted, clock_offset_std=0.3, folds=3)
    assert ahead.parameters["clock_offset"] == pytest.approx(0.25, abs=0.01)
    assert ahead.rms_position == pytest.approx(plain.rms_position, rel=0.2)
    assert ahead.cross_validated_rms_position == pytest.approx(plain.rms_position, rel=0.3)
    assert calibrate(shifted).rms_position > 3 * plain.rms_position


def test_gaps_of_the_wheels_are_no_motions() -> None:
    record = simulate(noise=(1e-4, 1e-4), slip=0.1)
    kept = np.ones(len(record.t), dtype=bool)
    kept[1000:1100] = False  # two seconds
    result = calibrate(replace(record, t=record.t[kept], angles=record.angles[kept]))
    begun = result.times - record.t[0]
    assert not ((begun > 19.0) & (begun < 21.0)).any()
    assert result.rms_position == pytest.approx(calibrate(record).rms_position, rel=0.2)


def test_a_reference_that_looks_backward() -> None:
    """Half a turn from either side: its yaw has changed by little."""
    result = calibrate(
        simulate(mount=np.array([0.08, -0.05, -3.13])),
        mount=(0.08, -0.05, np.pi),
        mount_std=(0.1, 0.1, 0.05),
    )
    assert result.parameters["mount_yaw"] == pytest.approx(2 * np.pi - 3.13 - np.pi, abs=0.01)


def test_no_window_in_which_both_were_read() -> None:
    """The reference begins a moment before the wheels end: no motion, and no error."""
    record = simulate(duration=10.0)
    late = replace(record, t_reference=record.t_reference[-15:], poses=record.poses[-15:])
    result = calibrate(late)
    assert result.status == "too little motion"
    assert result.errors.shape == result.errors_nominal.shape == (0, 3)
    assert result.outliers == ()
    assert "TOO LITTLE MOTION" in result.report()
    assert result.plot().axes[0].get_title() == "rms nan mm to nan mm"


def test_what_is_assumed_is_what_identification_assumes() -> None:
    record = simulate(duration=10.0)
    found = calibrate(record).identification
    assert len(calibrate(record).times) == len(found.times)  # cut into the same windows
    still = est.calibrate_mecanum(
        record.t, np.zeros_like(record.angles), record.t_reference, record.poses
    )
    assert_allclose(still.values, 0.0, atol=1e-15)  # nothing is told: all is as assumed
    explicit = calibrate(record, window=1.0, longest_gap=0.3)
    np.testing.assert_array_equal(explicit.errors, calibrate(record).errors)


def test_outliers_are_beyond_a_quantile_of_chi_square() -> None:
    result = calibrate(simulate(), gate=0.7)
    beyond = np.flatnonzero(result.distances**2 > chi2.ppf(0.7, 3))
    assert len(beyond) > 2
    assert result.outliers == tuple(beyond)


def test_poses_gone_astray_within_a_window_do_not_count() -> None:
    record = simulate(noise=(1e-4, 1e-4), slip=0.1)
    poses = record.poses.copy()
    poses[::10] += [0.5, -0.3, 0.4]
    astray = calibrate(replace(record, poses=poses))
    assert astray.rms_position == pytest.approx(calibrate(record).rms_position, rel=0.2)


def test_a_gap_in_which_the_robot_stood_is_a_motion() -> None:
    record = simulate(noise=(1e-4, 1e-4), slip=0.1)
    since = record.t - record.t[0]
    moved = np.where(since < 20.0, since, np.maximum(20.0, since - 4.0))  # stands four seconds
    angles = np.stack([np.interp(moved, since, c) for c in record.angles.T], axis=1)
    at = record.t_reference - record.t[0]
    then = np.where(at < 20.0, at, np.maximum(20.0, at - 4.0))
    poses = np.stack([np.interp(then, at, c) for c in record.poses.T], axis=1)
    kept = (since < 21.0) | (since > 23.0)
    stood = replace(record, t=record.t[kept], angles=angles[kept], poses=poses)
    assert len(calibrate(stood).times) == len(calibrate(replace(record, poses=poses)).times)


def test_between_sparse_stamps_wheels_roll_along_arcs() -> None:
    """Twice a second, beside a reference that knows the arcs: chords are 4 mm off."""
    wheels, t = est.MecanumOdometry(RADIUS, K), np.arange(0.0, 60.0, 0.5)
    twists = np.stack([0.3 * np.cos(t), 0.2 * np.sin(2 * t), 0.5 + 0.2 * np.sin(t)], axis=1)
    angles = np.cumsum(wheels.wheel_speeds(twists) * 0.5, axis=0)
    fine = np.arange(0.0, 59.4, 0.02)
    dense = np.stack([np.interp(fine, t, c) for c in angles.T], axis=1)
    poses = wheels.integrate_angles(fine, dense).poses
    result = calibrate(Record(t, angles, fine, poses, poses), longest_gap=1.0)
    assert result.rms_position < 1e-6
    assert result.rms_rotation < 1e-6
    assert result.outliers == ()


def test_distances_do_not_depend_on_how_the_body_is_turned() -> None:
    """Slip is in the robot's axes: more of it to the side."""
    record = simulate(noise=(1e-4, 1e-4), mount=np.zeros(3))
    plain = calibrate(record)
    turned = calibrate(replace(record, poses=composed(record.poses, np.array([0, 0, np.pi / 2]))))
    assert_allclose(turned.distances, plain.distances, rtol=0.01)
