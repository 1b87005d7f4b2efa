"""What matches and drives amount to over many worlds: errors, losses, NEES, degeneracy flagged.

Needs `thing_kin.odometry`. Tests run it over a few worlds, soak_scans.py over many.
"""

from dataclasses import dataclass, field

import numpy as np

from scan_drives import Sensor, between, compose, pair, record
from scan_worlds import FAMILIES
from thing_kin import odometry

KNOWN = tuple(f for f in FAMILIES if f != "corridor, plain")  # where all three can be told
INSIDE = 7.815  # chi-square of 3, 95 %
LOST = (0.1, np.radians(3.0))


def scanner_of(sensor: Sensor):
    given = sensor.arguments()
    return odometry.Scanner(**{**given, "noise": given["noise"] or 0.01})


def errors_of(found, truth):
    """(N, 3): of the estimate, in the axes of a."""
    away = np.asarray(found) - truth
    away[..., 2] = np.arctan2(np.sin(away[..., 2]), np.cos(away[..., 2]))
    return away


def nees_of(errors, covariances):
    return np.einsum("ni,nij,nj->n", errors, np.linalg.inv(covariances), errors)


@dataclass
class Matches:
    """One row for each match."""

    errors: np.ndarray
    covariances: np.ndarray
    status: list[str]
    degenerate: np.ndarray
    ambiguous: np.ndarray
    truth: np.ndarray
    seeds: list[tuple[int, int]] = field(default_factory=list)

    @property
    def converged(self):
        return np.array([s == "converged" for s in self.status])

    @property
    def lost(self):
        """Wrong by more than LOST, whatever was said."""
        wrong = (np.hypot(*self.errors[:, :2].T) > LOST[0]) | (np.abs(self.errors[:, 2]) > LOST[1])
        return wrong | ~np.isfinite(self.errors).all(axis=1)

    @property
    def unsaid(self):
        """Lost and called converged, neither degenerate nor ambiguous: what must not be."""
        return self.lost & self.converged & ~self.degenerate & ~self.ambiguous

    @property
    def nees(self):
        sure = self.converged & ~self.degenerate
        return nees_of(self.errors[sure], self.covariances[sure])

    def line(self):
        good = ~self.lost
        way = 1e3 * np.hypot(*self.errors[good, :2].T) if good.any() else np.array([np.nan])
        turn = 1e3 * np.abs(self.errors[good, 2]) if good.any() else np.array([np.nan])
        nees = self.nees if len(self.nees) else np.array([np.nan])
        return (
            f"lost {100 * self.lost.mean():5.1f} % unsaid {100 * self.unsaid.mean():5.1f} % "
            f"mm {np.median(way):5.1f} {np.percentile(way, 95):5.1f} "
            f"mrad {np.median(turn):5.2f} {np.percentile(turn, 95):5.2f} "
            f"NEES median {np.median(nees):6.2f} mean {nees.mean():7.2f} "
            f"inside {100 * np.mean(nees < INSIDE):5.1f} % degenerate "
            f"{100 * self.degenerate.mean():5.1f} % ambiguous {100 * self.ambiguous.mean():5.1f} %"
        )


def matches(family, sensor, count, seed=0, *, distance=0.3, turn=0.3, guess_error=None):
    """Match `count` pairs of a family; each its own world, repeated by (seed, k).

    The guess is zero, or the truth but for guess_error = (metres, radians) at most.
    """
    scanner, rows = scanner_of(sensor), []
    for k in range(count):
        rng = np.random.default_rng((seed, k))
        two = pair(FAMILIES[family](rng), sensor, rng, distance, turn)
        guess = np.zeros(3)
        if guess_error is not None:
            way, where = rng.uniform(0, guess_error[0]), rng.uniform(-np.pi, np.pi)
            by = rng.uniform(-guess_error[1], guess_error[1])
            guess = compose(two.truth, np.array([way * np.cos(where), way * np.sin(where), by]))
        rows.append((two.truth, odometry.match(scanner, two.a, two.b, guess=tuple(guess))))
    truth = np.array([t for t, _ in rows])
    return Matches(
        errors=errors_of(np.array([m.pose for _, m in rows]), truth),
        covariances=np.array([m.covariance for _, m in rows]),
        status=[m.status for _, m in rows],
        degenerate=np.array([m.degenerate for _, m in rows]),
        ambiguous=np.array([m.ambiguous for _, m in rows]),
        truth=truth,
        seeds=[(seed, k) for k in range(count)],
    )


@dataclass
class Followed:
    """One drive as it was followed."""

    poses: np.ndarray
    truth: np.ndarray
    motions: np.ndarray
    covariances: np.ndarray
    status: list[str]

    @property
    def step_errors(self):
        return errors_of(self.motions[1:], between(self.truth[:-1], self.truth[1:]))

    @property
    def lost(self):
        away = self.step_errors
        return (np.hypot(*away[:, :2].T) > LOST[0]) | (np.abs(away[:, 2]) > LOST[1])

    @property
    def nees(self):
        return nees_of(self.step_errors, self.covariances[1:])

    @property
    def length(self):
        return float(np.hypot(*np.diff(self.truth[:, :2], axis=0).T).sum())

    @property
    def end(self):
        """Metres and radians in which the end is wrong."""
        away = between(between(self.truth[0], self.truth[-1]), self.poses[-1])
        return float(np.hypot(*away[:2])), abs(float(away[2]))

    def line(self):
        way = 1e3 * np.hypot(*self.step_errors[:, :2].T)
        told = {s: self.status.count(s) for s in sorted(set(self.status))}
        return (
            f"{self.length:5.1f} m end {self.end[0]:6.3f} m {np.degrees(self.end[1]):5.2f} deg "
            f"lost {int(self.lost.sum())}/{len(self.lost)} mm a step {np.median(way):5.1f} "
            f"{np.percentile(way, 95):5.1f} NEES median {np.median(self.nees):6.2f} "
            f"inside {100 * np.mean(self.nees < INSIDE):5.1f} % {told}"
        )


def follow(family, sensor, seed=0, *, seconds=20.0, rate=10.0, wheels=None, speed=None, lidar=None):
    """Follow a drive; with wheels, their motions (wrong by that share) are the guess."""
    rng = np.random.default_rng(seed)
    drive = record(FAMILIES[family](rng), sensor, rng, seconds, rate, speed)
    lidar = lidar or odometry.LaserOdometry(scanner_of(sensor))
    guesses = None if wheels is None else drive.wheels(rng, wheels)
    steps = []
    for k, (t, ranges) in enumerate(zip(drive.times, drive.scans, strict=True)):
        motion = None if guesses is None or k == 0 else guesses[k - 1]
        steps.append(lidar.add(ranges, t=t, motion=motion))
    return Followed(
        poses=np.array(lidar.poses),
        truth=drive.poses,
        motions=np.array([s.motion for s in steps]),
        covariances=np.array([s.covariance for s in steps]),
        status=[s.status for s in steps],
    )
