"""A long drive, simulated: what wheels and LIDAR odometry make of it, alone and fused."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thing_kin._estimation import BaseLocalizer

__all__ = [
    "LocalizationExperiment",
    "LocalizationRun",
    "SimulatedDrive",
    "localization_experiment",
    "simulate_drive",
]

Array = NDArray[np.float64]

# What is wrong with the sensors. Wheels: shares of the speed that slip takes, for some seconds;
# scale errors for good; noise of a sample. LIDAR odometry: noise of a match, a lasting drift.
SLIP, SLIP_SECONDS = np.array([0.02, 0.06, 0.01]), 2.0
WHEEL_BIAS = np.array([0.003, -0.004, 0.002])
WHEEL_NOISE = np.array([0.01, 0.02, 0.01])  # m/s, m/s, rad/s
SCAN_NOISE = np.array([0.003, 0.003, 0.0006])  # m, m, rad a match
SCAN_DRIFT, SCAN_DRIFT_SECONDS = np.array([0.003, 0.003, 0.0006]), 5.0  # m/s, m/s, rad/s


@dataclass(frozen=True)
class SimulatedDrive:
    """A drive and what was measured on it.

    Parameters
    ----------
    t : (N,), s
        Stamps of the wheels, the first one of the start.
    truth : (N, 3), m and rad
    twist : (N - 1, 3)
        True, over each interval, in the body.
    wheels : (N - 1, 3)
        As measured.
    wheel_covariance : (3, 3)
        Of one of them: so wide that slip, which lasts, is accounted for.
    scan_t : (M,), s
    motions : (M - 1, 3)
        LIDAR odometry from scan to scan.
    motion_covariance : (3, 3)

    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> drive = est.simulate_drive(20.0, rng=0)
    >>> drive.truth.shape[0] == len(drive.t)
    True
    """

    t: Array
    truth: Array
    twist: Array
    wheels: Array
    wheel_covariance: Array
    scan_t: Array
    motions: Array
    motion_covariance: Array

    @property
    def length(self) -> float:
        """Way driven, m."""
        return float(np.hypot(*np.diff(self.truth[:, :2], axis=0).T).sum())


@dataclass(frozen=True)
class LocalizationRun:
    """An estimate along a drive.

    Parameters
    ----------
    t : (K,), s
    pose : (K, 3), m and rad
    covariance : (K, 3, 3)
    error : (K, 3)
        Estimate minus truth, world axes.

    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> run = est.localization_experiment(20.0, rng=0).runs["fused"]
    >>> run.sigma.shape == run.error.shape
    True
    """

    t: Array
    pose: Array
    covariance: Array
    error: Array

    @property
    def sigma(self) -> Array:
        """(K, 3), standard deviations of x, y, theta."""
        return np.sqrt(np.diagonal(self.covariance, axis1=1, axis2=2))

    @property
    def nees(self) -> Array:
        """(K,), normalized estimation error squared: 3 on average where the covariance is right."""
        solved = np.linalg.solve(self.covariance, self.error[..., None])
        nees: Array = (self.error[:, None, :] @ solved)[:, 0, 0]
        return nees

    @property
    def position_error(self) -> Array:
        """(K,), m."""
        return np.hypot(self.error[:, 0], self.error[:, 1])

    @property
    def within(self) -> float:
        """Share of the time that the NEES is below its 95 % bound, 7.81."""
        return float((self.nees < 7.814727903251179).mean())


@dataclass(frozen=True)
class LocalizationExperiment:
    """A drive, and the runs "wheels", "lidar" and "fused" along it.

    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> list(est.localization_experiment(20.0, rng=0).runs)
    ['wheels', 'lidar', 'fused']
    """

    drive: SimulatedDrive
    runs: dict[str, LocalizationRun]

    def table(self) -> str:
        """Return the figures of merit, a run a line.

        Returns
        -------
        str

        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> print(est.localization_experiment(20.0, rng=0).table().splitlines()[0])
        run      rms [m]  end [m]  end [% of way]  rms heading [rad]  mean NEES  below 95 %
        """
        lines = [
            "run      rms [m]  end [m]  end [% of way]  rms heading [rad]  mean NEES  below 95 %"
        ]
        for name, run in self.runs.items():
            end = run.position_error[-1]
            rms = np.sqrt((run.position_error**2).mean())
            heading = np.sqrt((run.error[:, 2] ** 2).mean())
            lines.append(
                f"{name:<7}{rms:9.2f}{end:9.2f}{100 * end / self.drive.length:16.2f}"
                f"{heading:19.4f}{run.nees.mean():11.2f}{100 * run.within:10.0f} %"
            )
        return "\n".join(lines)


def simulate_drive(
    length: float = 1000.0, *, rng: np.random.Generator | int | None = None
) -> SimulatedDrive:
    """Drive for so many metres, with wheels at 50 Hz and LIDAR odometry at 10 Hz.

    The base drives at about 0.8 m/s, sideways a little, and turns all the time. Wheels slip: a
    share of the speed is lost or won for some seconds; they have a bias, and noise. LIDAR odometry
    has noise in each match and a drift that lasts some seconds.

    Parameters
    ----------
    length : float, m
    rng : numpy Generator or int, optional

    Returns
    -------
    SimulatedDrive

    Raises
    ------
    ValueError
        If length is not a finite number > 0.

    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> round(est.simulate_drive(100.0, rng=1).length)
    100
    """
    if not (np.isfinite(length) and length > 0):
        raise ValueError(f"length: got {length}, expected a finite number of metres > 0")
    random = np.random.default_rng(rng)
    dt, ratio = 0.02, 5
    count = max(1, round(length / 0.8 / (dt * ratio))) * ratio
    t: Array = dt * np.arange(count + 1, dtype=np.float64)
    middle = t[1:] - dt / 2
    twist = np.stack(
        [
            0.8 + 0.15 * np.sin(2 * np.pi * middle / 37.0),
            0.06 * np.sin(2 * np.pi * middle / 13.0),
            0.10 * np.sin(2 * np.pi * middle / 53.0) + 0.16 * np.sin(2 * np.pi * middle / 171.0),
        ],
        axis=1,
    )
    twist[:, :2] *= length / (np.hypot(twist[:, 0], twist[:, 1]).sum() * dt)
    truth = _chained(np.zeros(3), twist * dt)
    slip = _lasting(random, count, dt / SLIP_SECONDS) * SLIP
    noise = random.normal(size=(count, 3)) * WHEEL_NOISE
    wheels = twist * (1 + WHEEL_BIAS + slip) + noise
    # What lasts for s seconds moves the pose as much as independent errors of 2 s/dt the variance.
    lasting = SLIP**2 * (twist**2).mean(axis=0) * 2 * SLIP_SECONDS / dt
    scans = truth[::ratio]
    drift = _lasting(random, len(scans) - 1, ratio * dt / SCAN_DRIFT_SECONDS) * SCAN_DRIFT
    matched = random.normal(size=(len(scans) - 1, 3)) * SCAN_NOISE + drift * ratio * dt
    lasting_drift = SCAN_DRIFT**2 * 2 * SCAN_DRIFT_SECONDS * ratio * dt
    return SimulatedDrive(
        t=t,
        truth=truth,
        twist=twist,
        wheels=wheels,
        wheel_covariance=np.diag(WHEEL_NOISE**2 + lasting),
        scan_t=t[::ratio],
        motions=_seen(scans[:-1], scans[1:]) + matched,
        motion_covariance=np.diag(SCAN_NOISE**2 + lasting_drift),
    )


def localization_experiment(
    length: float = 1000.0,
    *,
    rng: np.random.Generator | int | None = None,
    filter: str = "ekf",
    every: float = 1.0,
) -> LocalizationExperiment:
    """Localize a simulated drive by wheels alone, by LIDAR odometry alone, and by both: [M17] 6.1.

    Figures 6.1 and 6.2 of [M17], "Simulated localization", are empty. They were to show that what
    (3.24) and (3.25) fuse is better than either source alone, and how sure it is.

    Parameters
    ----------
    length : float, m
    rng : numpy Generator or int, optional
    filter : {'ekf', 'ukf'}
    every : float, s
        How often the estimate is compared with the truth.

    Returns
    -------
    LocalizationExperiment

    Raises
    ------
    ValueError
        If length, filter or every is out of its range.

    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> runs = est.localization_experiment(200.0, rng=0).runs
    >>> bool(runs["fused"].sigma[-1, 0] < runs["wheels"].sigma[-1, 0])
    True
    """
    if not (np.isfinite(every) and every > 0):
        raise ValueError(f"every: got {every}, expected a finite number of seconds > 0")
    drive = simulate_drive(length, rng=rng)
    used = {"wheels": ("wheels",), "lidar": ("lidar",), "fused": ("wheels", "lidar")}
    runs = {name: _run(drive, sources, filter, every) for name, sources in used.items()}
    return LocalizationExperiment(drive, runs)


def _run(
    drive: SimulatedDrive, sources: tuple[str, ...], filter: str, every: float
) -> LocalizationRun:
    localizer = BaseLocalizer(
        covariance=1e-8 * np.eye(3),
        process_noise=1e-10 * np.eye(3),  # all noise is in the sources
        t=0.0,
        history=1.0,
        filter=filter,
    )
    localizer.source("wheels", covariance=drive.wheel_covariance)
    localizer.source("lidar", covariance=drive.motion_covariance, gate=1.0)
    step = max(1, round(every / (drive.scan_t[1] - drive.scan_t[0])))
    ratio = round((len(drive.t) - 1) / (len(drive.scan_t) - 1))
    estimates, at = [], []
    for j in _scans(localizer, drive, sources, ratio):
        if j % step == 0 or j == len(drive.scan_t) - 1:
            estimates.append(localizer.estimate(drive.scan_t[j]))
            at.append(j)
    pose = np.array([e.pose for e in estimates])
    error = pose - drive.truth[::ratio][at]
    error[:, 2] = np.remainder(error[:, 2] + np.pi, 2 * np.pi) - np.pi
    covariance = np.array([e.covariance for e in estimates])
    return LocalizationRun(drive.scan_t[at], pose, covariance, error)


def _scans(
    localizer: BaseLocalizer, drive: SimulatedDrive, sources: tuple[str, ...], ratio: int
) -> Iterator[int]:
    """Give the localizer what was measured up to each scan in turn."""
    for j in range(1, len(drive.scan_t)):
        if "wheels" in sources:
            for k in range((j - 1) * ratio, j * ratio):
                localizer.add_twist(drive.t[k + 1], drive.wheels[k], source="wheels")
        if "lidar" in sources:
            t1, t2 = drive.scan_t[j - 1], drive.scan_t[j]
            if "wheels" in sources:
                localizer.add_relative_pose(t1, t2, drive.motions[j - 1], source="lidar")
            else:  # by itself, a motion is a mean twist
                localizer.add_twist(
                    t2,
                    _mean_twist(drive.motions[j - 1]) / (t2 - t1),
                    drive.motion_covariance / (t2 - t1) ** 2,
                    source="lidar",
                )
        yield j


def _mean_twist(motion: Array) -> Array:
    """Take the logarithm of a small planar motion."""
    half = motion[2] / 2
    scale = half / np.tan(half) if abs(half) > 1e-6 else 1 - half**2 / 3
    x, y = motion[:2]
    return np.array([scale * x + half * y, scale * y - half * x, motion[2]])


def _lasting(random: np.random.Generator, count: int, step: float) -> Array:
    """(count, 3) of variance one that forget themselves in 1/step rows (Gauss-Markov)."""
    keep = np.exp(-step)
    white = random.normal(size=(count, 3)) * np.sqrt(1 - keep**2)
    white[0] /= np.sqrt(1 - keep**2)
    out = np.empty((count, 3))
    last = np.zeros(3)
    for k in range(count):
        last = keep * last + white[k]
        out[k] = last
    return out


def _chained(start: Array, motions: Array) -> Array:
    """Poses along constant twists, exactly."""
    angle = motions[:, 2]
    small = np.abs(angle) < 1e-9
    safe = np.where(small, 1.0, angle)
    s = np.where(small, 1.0, np.sin(safe) / safe)
    c = np.where(small, angle / 2, (1 - np.cos(safe)) / safe)
    x = s * motions[:, 0] - c * motions[:, 1]
    y = c * motions[:, 0] + s * motions[:, 1]
    theta = start[2] + np.concatenate([[0.0], np.cumsum(angle)])
    cos, sin = np.cos(theta[:-1]), np.sin(theta[:-1])
    out = np.empty((len(motions) + 1, 3))
    out[0], out[:, 2] = start, np.remainder(theta + np.pi, 2 * np.pi) - np.pi
    out[1:, 0] = start[0] + np.cumsum(cos * x - sin * y)
    out[1:, 1] = start[1] + np.cumsum(sin * x + cos * y)
    return out


def _seen(past: Array, poses: Array) -> Array:
    """Each pose as its past sees it."""
    d = poses - past
    cos, sin = np.cos(past[:, 2]), np.sin(past[:, 2])
    turn = np.remainder(d[:, 2] + np.pi, 2 * np.pi) - np.pi
    return np.stack([cos * d[:, 0] + sin * d[:, 1], cos * d[:, 1] - sin * d[:, 0], turn], axis=1)
