"""A soak of the localizer: a million measurements, and a covariance that is one after each.

    python tests/soak_localizer.py --measurements 1000000

Variances from 1e-12 to 1e6, gaps up to a day, outliers, late arrival, motions that overlap, resets.
After each measurement the covariance is symmetric to the bit and positive definite, nothing is NaN,
and every measurement has been counted once.
"""

import argparse

import numpy as np

from thing_kin import estimation as est


def covariance(rng: np.random.Generator) -> np.ndarray:
    """Ill-conditioned, and turned, so that its entries correlate."""
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    R = turn @ np.diag(10.0 ** rng.uniform(-12, 6, 3)) @ turn.T
    return (R + R.T) / 2 + 1e-13 * np.trace(R) * np.eye(3)


def check(localizer: est.BaseLocalizer, t: float | None) -> None:
    e = localizer.estimate(t)
    P = e.covariance
    assert np.isfinite(e.pose).all(), e.pose
    assert np.isfinite(e.twist).all(), e.twist
    assert (P == P.T).all(), P
    scale = np.sqrt(np.diag(P))
    # In units of its own deviations, where rounding is one part in 1e16 of everything.
    assert np.linalg.eigvalsh(P / np.outer(scale, scale))[0] > 0, P
    assert -np.pi < e.pose[2] <= np.pi


def soak(measurements: int, seed: int, filter: str, every: int = 1) -> est.BaseLocalizer:
    rng = np.random.default_rng(seed)
    localizer = est.BaseLocalizer(
        covariance=1e-12 * np.eye(3),
        process_noise=np.diag(10.0 ** rng.uniform(-12, 2, 3)),
        history=2.0,
        filter=filter,
        gate=0.999,
    )
    t, given = 1.7e9, 0
    while given < measurements:
        t += rng.choice([0.0, 0.01, 0.01, 0.01, 0.1, 1.0, 100.0, 86400.0], p=PICK)
        at = t - rng.choice([0.0, 0.0, 0.05, 1.0])
        z = rng.normal(size=3) * 10.0 ** rng.uniform(-3, 3)
        match rng.integers(0, 6):
            case 0 | 1:
                localizer.add_twist(at, z, covariance(rng), source=rng.choice(["wheels", "visual"]))
            case 2:
                localizer.add_pose(at, z, covariance(rng), source="lidar")
            case 3:
                back = rng.uniform(0.01, 0.9)
                localizer.add_relative_pose(at - back, at, z, covariance(rng), source="scan")
            case 4:
                localizer.add_yaw_rate(at, z[0], 10.0 ** rng.uniform(-12, 6), source="imu")
            case _:
                localizer.add_yaw(at, z[0], 10.0 ** rng.uniform(-12, 6), source="imu")
        given += 1
        if given % every == 0:
            check(localizer, rng.choice([None, t, t + 10.0 ** rng.uniform(-6, 6)]))
        if given % 5000 == 0:
            localizer.reset((0, 0, 3.1), 10.0 ** rng.uniform(-12, 6) * np.eye(3), t=t)
    heard = (localizer.accepted, localizer.rejected, localizer.refused)
    assert sum(sum(counts.values()) for counts in heard) == given, heard
    assert min(localizer.accepted.values()) > 0
    return localizer


PICK = np.array([2, 20, 20, 20, 5, 1, 0.1, 0.02])
PICK /= PICK.sum()

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--measurements", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    for name in ("ekf", "ukf"):
        kept = soak(arguments.measurements // 2, arguments.seed, name, every=10)
        print(name, kept.accepted, kept.rejected, kept.refused)
