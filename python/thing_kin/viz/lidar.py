"""LIDAR odometry: the path in the map it made, one match with its residuals and its ellipse."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from thing_kin.viz.style import BLACK, BLUE, GRAY, GREEN, ORANGE, RED, axes_or_new, figure_of, tidy

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike, NDArray

    from thing_kin.odometry import ScanMatch, Scanner

    Array = NDArray[np.float64]

SHOWN_RESIDUAL = 0.5  # m: farther from all of the other scan than this, a return has no partner
LONGEST_SIGMA = 3.0  # m: a longer half axis is cut there, and drawn dashed


def plot_laser_odometry(
    scanner: Scanner,
    scans: ArrayLike,
    poses: ArrayLike,
    *,
    truth: ArrayLike | None = None,
    axes: Axes | None = None,
) -> Figure:
    """Path of the robot in the map of all returns.

    Walls that are drawn once are known once: where the path drifted they are double.

    Parameters
    ----------
    scanner : odometry.Scanner
    scans : (K, n), m
        Ranges; what is not finite is left out.
    poses : (K, 3), m and rad
        Of the robot at each scan, e.g. `LaserOdometry.poses`.
    truth : (N, 3), optional
        Poses of a reference in the same axes.
    axes : matplotlib Axes, optional
        Where to draw; default: a new figure.

    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import odometry, viz
    >>> scanner = odometry.Scanner(-1.0, 1.0, 5)
    >>> scans = np.full((2, 5), 3.0)
    >>> figure = viz.plot_laser_odometry(scanner, scans, [[0, 0, 0], [0.1, 0, 0]])
    >>> len(figure.axes[0].lines[0].get_xdata())  # ten returns
    10
    """
    axes = axes_or_new(axes, figsize=(8, 7))
    ranges, path = _matrix(scans, "scans"), _matrix(poses, "poses")
    if len(ranges) != len(path):
        raise ValueError(
            f"poses: got {len(path)} rows, expected one for each of {len(ranges)} scans"
        )
    points = np.vstack(
        [_placed(p, _returns(scanner, r)) for r, p in zip(ranges, path, strict=True)]
    )
    axes.plot(*points.T, ".", color=GRAY, markersize=0.8, label="returns", rasterized=True)
    if truth is not None:
        axes.plot(
            *_matrix(truth, "truth")[:, :2].T, "--", color=BLACK, linewidth=1.1, label="truth"
        )
    axes.plot(*path[:, :2].T, color=BLUE, linewidth=1.4, label="odometry")
    axes.plot(*path[0, :2], "o", color=GREEN, markersize=6, label="start")
    axes.plot(*path[-1, :2], "s", color=RED, markersize=5, label="end")
    axes.set_aspect("equal", adjustable="datalim")
    tidy(axes, title=f"{len(path)} scans", xlabel="x [m]", ylabel="y [m]")
    axes.legend(loc="best", frameon=False)
    return figure_of(axes)


def plot_scan_match(
    scanner: Scanner,
    ranges_a: ArrayLike,
    ranges_b: ArrayLike,
    match: ScanMatch,
    *,
    sigmas: float = 2.0,
    axes: Axes | None = None,
) -> Figure:
    """Two scans laid upon each other, what is left between them, and how sure the match is.

    A line joins each return of b to the nearest return of a, as long as it is nearer than 0.5 m.
    The ellipse is the covariance of b's place: along a corridor it is long, cut at 3 m (and then
    dashed), which is what the match doesn't know.

    Parameters
    ----------
    scanner : odometry.Scanner
    ranges_a, ranges_b : (n,), m
        As given to `odometry.match`.
    match : odometry.ScanMatch
        What it returned; its `pose`, `covariance`, `status`, `degenerate` and `ambiguous` are
        drawn.
    sigmas : float
        Half axes of the ellipse, in standard deviations.
    axes : matplotlib Axes, optional
        Where to draw; default: a new figure.

    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import odometry, viz
    >>> scanner = odometry.Scanner(-2.0, 2.0, 90)
    >>> scan = 2.0 + 0.3 * np.sin(3 * scanner.angles)
    >>> figure = viz.plot_scan_match(scanner, scan, scan, odometry.match(scanner, scan, scan))
    >>> figure.axes[0].get_xlabel()
    'x in a [m]'
    """
    from matplotlib.collections import LineCollection

    axes = axes_or_new(axes, figsize=(8, 7))
    a = _returns(scanner, np.asarray(ranges_a, dtype=float))
    b = _placed(np.asarray(match.pose), _returns(scanner, np.asarray(ranges_b, dtype=float)))
    axes.plot(*a.T, ".", color=BLUE, markersize=3, label="a")
    axes.plot(*b.T, ".", color=ORANGE, markersize=3, label="b, moved by the match")
    joined = _nearest(a, b)
    axes.add_collection(LineCollection(list(joined), colors=RED, linewidths=0.7, label="residuals"))
    _ellipse(axes, np.asarray(match.pose), np.asarray(match.covariance), sigmas)
    left = np.linalg.norm(joined[:, 1] - joined[:, 0], axis=1)
    middle = f"{1e3 * np.median(left):.0f} mm" if len(left) else "none"
    doubts = [d for d in ("degenerate", "ambiguous") if getattr(match, d)]
    told = ", ".join([match.status, *doubts])
    axes.set_aspect("equal", adjustable="datalim")
    title = f"{told}; to the nearest return, median: {middle}"
    tidy(axes, title=title, xlabel="x in a [m]", ylabel="y in a [m]")
    axes.legend(loc="best", frameon=False)
    return figure_of(axes)


def _matrix(values: ArrayLike, name: str) -> Array:
    array = np.asarray(values, dtype=float)
    if array.ndim != 2:
        raise ValueError(f"{name}: got shape {array.shape}, expected two axes")
    return array


def _placed(pose: Array, points: Array) -> Array:
    c, s = np.cos(pose[2]), np.sin(pose[2])
    placed: Array = points @ np.array([[c, s], [-s, c]]) + pose[:2]
    return placed


def _returns(scanner: Scanner, ranges: Array) -> Array:
    """In the robot's frame, (N, 2)."""
    seen = np.isfinite(ranges)
    r, angle = ranges[seen], scanner.angles[seen]
    points = r[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return _placed(np.asarray(scanner.mount), points)


def _nearest(a: Array, b: Array) -> Array:
    """Lines (M, 2, 2) from returns of b to the nearest of a."""
    if not len(a) or not len(b):
        return np.empty((0, 2, 2))
    distance = np.linalg.norm(b[:, None] - a, axis=2)
    nearest = distance.argmin(axis=1)
    near = distance.min(axis=1) < SHOWN_RESIDUAL
    return np.stack([b[near], a[nearest[near]]], axis=1)


def _ellipse(axes: Axes, pose: Array, covariance: Array, sigmas: float) -> None:
    from matplotlib.patches import Ellipse

    variance, directions = np.linalg.eigh(covariance[:2, :2])
    half = sigmas * np.sqrt(np.maximum(variance, 0.0))
    shown = np.minimum(half, LONGEST_SIGMA)
    axes.plot(*pose[:2], "+", color=GREEN, markersize=9)
    long = directions[:, 1]
    ellipse = Ellipse(
        (pose[0], pose[1]),
        width=2 * shown[1],
        height=2 * shown[0],
        angle=float(np.degrees(np.arctan2(long[1], long[0]))),
        fill=False,
        edgecolor=GREEN,
        linewidth=1.6,
        linestyle="--" if half[1] > LONGEST_SIGMA else "-",
        label=f"{sigmas:g} sigma: {half[1]:.2g} m by {half[0]:.2g} m",
    )
    axes.add_patch(ellipse)
