"""The reader of robot_localization's parameter files: what is taken, what is said of the rest."""

import math
import warnings
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import chi2

from thing_kin import estimation as est

pytest.importorskip("yaml")

# Written by hand after the documented parameters.
TEXT = """
ekf_filter_node:
  ros__parameters:
    frequency: 50.0
    sensor_timeout: 0.1
    two_d_mode: true
    publish_tf: true
    map_frame: map
    odom_frame: odom
    base_link_frame: base_link
    world_frame: odom
    smooth_lagged_data: true
    history_length: 3.0
    odom0: /wheels
    odom0_config: [false, false, false,
                   false, false, false,
                   true,  true,  false,
                   false, false, true,
                   false, false, false]
    odom0_differential: false
    odom0_queue_size: 10
    odom0_twist_rejection_threshold: 4.0
    odom1: /laser
    odom1_config: [[true, true, false], [false, false, true], [true, false, false],
                   [false, false, false], [false, false, false]]
    odom1_differential: true
    pose0: /amcl_pose
    pose0_config: [true, true, false, false, false, true, false, false, false,
                   false, false, false, false, false, false]
    pose0_rejection_threshold: 2.5
    twist0: /twist
    twist0_config: [false, false, false, false, false, false, true, false, false,
                    false, false, false, false, false, false]
    imu0: /imu
    imu0_config: [false, false, false, true, true, false, false, false, false,
                  true, true, true, false, false, false]
    imu0_relative: true
    initial_state: [1.0, 2.0, 0.0, 0.0, 0.0, 0.5, 0, 0, 0, 0, 0, 0, 0, 0, 0]
    initial_estimate_covariance: [1e-2, 2e-2, 1, 1, 1, 3e-2, 1, 1, 1, 1, 1, 1, 1, 1, 1]
"""


def read(text: str, **options) -> est.RobotLocalization:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return est.read_robot_localization(text, **options)


def test_everything_that_is_taken_over(tmp_path: Path) -> None:
    settings = read(TEXT)
    fuse = {name: source.fuse for name, source in settings.sources.items()}
    assert fuse == {
        "odom0": ("vx", "vy", "omega"),
        "odom1_pose": ("x", "y", "theta"),
        "odom1_twist": ("vx",),
        "pose0": ("x", "y", "theta"),
        "twist0": ("vx",),
        "imu0": ("omega",),
    }
    assert settings.sources["odom1_pose"].differential
    assert not settings.sources["odom1_twist"].differential
    assert settings.sources["pose0"].topic == "/amcl_pose"
    assert (settings.frequency, settings.sensor_timeout, settings.history) == (50.0, 0.1, 3.0)
    np.testing.assert_array_equal(settings.pose, [1, 2, 0.5])
    np.testing.assert_array_equal(settings.covariance, np.diag([1e-2, 2e-2, 3e-2]))
    path = tmp_path / "ekf.yaml"
    path.write_text(TEXT, encoding="utf-8")
    for source in (path, str(path)):
        assert est.read_robot_localization(source).sources == settings.sources


def test_thresholds_are_mahalanobis_distances() -> None:
    sources = read(TEXT).sources
    assert math.isclose(sources["odom0"].gate, chi2.cdf(16.0, 3), rel_tol=1e-12)
    assert math.isclose(sources["pose0"].gate, chi2.cdf(6.25, 3), rel_tol=1e-12)
    assert sources["imu0"].gate is None
    one = read(TEXT + "    twist0_rejection_threshold: 1.5\n").sources["twist0"]
    assert math.isclose(one.gate, chi2.cdf(2.25, 1), rel_tol=1e-12)


def test_the_localizer_of_a_file() -> None:
    localizer = read(TEXT).localizer(t=0.0)
    np.testing.assert_array_equal(localizer.estimate().pose, [1, 2, 0.5])
    assert set(localizer.accepted) == set(read(TEXT).sources)
    assert localizer.add_yaw_rate(0.1, 0.3, 1e-3, source="imu0")
    with pytest.raises(ValueError, match="imu0"):
        localizer.add_yaw(0.1, 0.3, 1e-3, source="imu0")
    localizer.add_pose(0.2, (40, 40, 0.5), 1e-4 * np.eye(3), source="pose0")
    assert localizer.rejected["pose0"] == 1
    localizer.add_pose(0.2, (40, 40, 0.5), 1e-4 * np.eye(3), source="new")  # no gate there
    assert localizer.accepted["new"] == 1


def test_process_noise_by_rows_or_diagonal() -> None:
    Q = np.arange(225.0).reshape(15, 15)
    rows = ", ".join(map(str, (Q @ Q.T).ravel().tolist()))
    found = read(TEXT + f"    process_noise_covariance: [{rows}]\n").process_noise
    np.testing.assert_allclose(found, (Q @ Q.T)[np.ix_([0, 1, 5], [0, 1, 5])])
    diagonal = ", ".join(map(str, range(15)))
    found = read(TEXT + f"    process_noise_covariance: [{diagonal}]\n").process_noise
    np.testing.assert_array_equal(found, np.diag([0, 1, 5]))


def test_files_of_ros_1_and_several_nodes() -> None:
    flat = "\n".join(line[4:] for line in TEXT.splitlines()[3:])
    assert read(flat).sources == read(TEXT).sources
    two = TEXT + TEXT.replace("ekf_filter_node", "ekf_map")
    with pytest.raises(ValueError, match=r"^node: got None, expected one of \['ekf_filter_node'"):
        read(two)
    assert read(two, node="ekf_map").sources == read(TEXT).sources
    with pytest.raises(ValueError, match=r"^node: got 'ukf'"):
        read(two, node="ukf")


ACCELERATING = TEXT.replace(
    "true, true, true, false, false, false]", "true, true, true, true, false, false]"
)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (ACCELERATING, "imu0_config: ax not taken over"),
        (TEXT.replace("two_d_mode: true", "two_d_mode: false"), "two_d_mode: "),
        (TEXT + "    use_control: true\n", "use_control: not taken over"),
        (TEXT + "    imu0_remove_gravitational_acceleration: true\n", "imu0_remove_grav"),
        (TEXT + "    odom0_pose_use_child_frame: true\n", "odom0_pose_use_child_frame: "),
        (TEXT.replace("0.5, 0, 0, 0", "0.5, 1, 0, 0"), "initial_state: only"),
        (TEXT + "    fancy_new_option: 3\n", "fancy_new_option: not taken over"),
    ],
)
def test_what_is_not_taken_over_is_said(text: str, said: str) -> None:
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        est.read_robot_localization(text)
    assert any(str(warning.message).startswith(said) for warning in heard)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (TEXT.replace("true,  true,  false,", "true, true,"), "odom0_config: got 14 entries"),
        (TEXT.replace("true,  true,  false,", "1, true,  false,"), "odom0_config: got 15"),
        (TEXT.replace("odom0_config", "odom9_config"), "odom0_config: got nothing"),
        (TEXT + "    odom7_differential: true\n", "odom7_differential: got no odom7"),
        (TEXT.replace("2.5", "-2.5"), "pose0_rejection_threshold: got -2.5"),
        (TEXT.replace("frequency: 50.0", "frequency: often"), "frequency: got"),
        (TEXT.replace("[1.0, 2.0,", "[1.0,"), "initial_state: got 14 numbers"),
        (TEXT.replace("[1e-2, 2e-2,", "[.nan, 2e-2,"), "initial_estimate_covariance: got"),
        ("- 1\n- 2\n", "source: got list"),
        ("a: [1,\n", "source: got no YAML"),
    ],
)
def test_what_is_wrong_is_named(text: str, said: str) -> None:
    with pytest.raises(ValueError) as error:  # noqa: PT011
        est.read_robot_localization(text)
    assert str(error.value).startswith(said)
