"""Figures of scans: what is drawn is what was given, in the right frames."""

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.patches import Ellipse

from thing_kin import viz

SCANNER = SimpleNamespace(angles=np.array([0.0, np.pi / 2]), mount=np.array([0.5, 0.0, np.pi / 2]))
UP_AND_BACK = np.array([[0.5, 1.0], [-1.5, 0.0]])  # ranges 1 and 2, in the robot's frame


def test_the_map_is_in_the_axes_of_the_poses():
    scans, poses = np.array([[1.0, 2.0], [1.0, np.inf]]), [[0, 0, 0], [1, 0, np.pi]]
    figure = viz.plot_laser_odometry(SCANNER, scans, poses, truth=np.ones((5, 3)))
    returns, truth, path, *_ = figure.axes[0].lines
    np.testing.assert_allclose(returns.get_xydata(), [*UP_AND_BACK, (0.5, -1.0)], atol=1e-14)
    np.testing.assert_array_equal(path.get_xydata(), [[0, 0], [1, 0]])
    assert len(truth.get_xdata()) == 5
    assert figure.axes[0].get_aspect() == 1.0


def test_poses_for_each_scan():
    with pytest.raises(ValueError, match="poses: got 1 rows, expected one for each of 2 scans"):
        viz.plot_laser_odometry(SCANNER, np.ones((2, 2)), [[0, 0, 0]])
    with pytest.raises(ValueError, match="scans: got shape"):
        viz.plot_laser_odometry(SCANNER, np.ones(2), [[0, 0, 0]])


def matched(covariance, degenerate=False, ambiguous=False):
    pose = np.array([0.1, 0.0, 0.0])
    return SimpleNamespace(
        pose=pose,
        covariance=covariance,
        status="converged",
        degenerate=degenerate,
        ambiguous=ambiguous,
    )


def test_a_match_with_its_residuals_and_its_ellipse():
    c, s = np.cos(0.3), np.sin(0.3)
    R = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    covariance = R @ np.diag([0.04, 0.01, 1.0]) @ R.T
    figure = viz.plot_scan_match(SCANNER, [1.0, 2.0], [1.0, np.nan], matched(covariance))
    (axes,) = figure.axes
    np.testing.assert_allclose(axes.lines[1].get_xydata(), [(0.6, 1.0)])
    (residuals,) = [c for c in axes.collections if isinstance(c, LineCollection)]
    np.testing.assert_allclose(residuals.get_segments(), [[(0.6, 1.0), (0.5, 1.0)]])
    assert "median: 100 mm" in axes.get_title()
    (ellipse,) = [p for p in axes.patches if isinstance(p, Ellipse)]
    np.testing.assert_allclose((ellipse.width, ellipse.height), (0.8, 0.4))  # two sigma each way
    np.testing.assert_allclose(ellipse.angle % 180, np.degrees(0.3))
    np.testing.assert_allclose(ellipse.center, (0.1, 0.0))


def test_a_corridor_is_cut_and_dashed():
    unknown = matched(np.diag([1e8, 1e-4, 1e-4]), degenerate=True)
    (axes,) = viz.plot_scan_match(SCANNER, [1.0, 2.0], [np.inf, np.inf], unknown).axes
    (ellipse,) = [p for p in axes.patches if isinstance(p, Ellipse)]
    assert (ellipse.width, ellipse.get_linestyle()) == (6.0, "--")
    assert "converged, degenerate;" in axes.get_title()
    assert "1e+04" in ellipse.get_label() or "2e+04" in ellipse.get_label()


def test_what_is_ambiguous_says_so():
    doubtful = matched(np.diag([0.04, 1e-4, 1e-4]), ambiguous=True)
    (axes,) = viz.plot_scan_match(SCANNER, [1.0, 2.0], [1.0, 2.0], doubtful).axes
    assert "converged, ambiguous;" in axes.get_title()
