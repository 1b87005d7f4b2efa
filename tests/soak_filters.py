"""A soak of the Kalman filters: a million steps each, and a covariance that is one after each.

    python tests/soak_filters.py --steps 1000000

Variances from 1e-12 to 1e6, gaps from a microsecond to hours, missing data, outliers.
"""

import argparse
from typing import Any

import numpy as np

from thing_kin import estimation as est

KINDS = ("linear", "extended", "unscented", "root")
H = np.eye(2, 4)


def make_filter(kind: str) -> Any:
    """A filter of four states: position and velocity in the plane."""
    start = (np.array([0.0, 0.0, 1.0, 0.5]), np.eye(4))
    if kind == "linear":
        return est.KalmanFilter(*start)
    if kind == "extended":
        return est.ExtendedKalmanFilter(*start)
    return est.UnscentedKalmanFilter(*start, square_root=kind == "root")


def soak(kind: str, steps: int, seed: int) -> int:
    """How many steps said that they could not be done; raises where the covariance is none."""
    rng = np.random.default_rng(seed)
    filter = make_filter(kind)
    failed = 0
    for _ in range(steps):
        A = np.eye(4) + 10.0 ** rng.uniform(-6, 4) * np.eye(4, k=2)
        Q = np.diag(10.0 ** rng.uniform(-12, 6, 4))
        failed += not filter.predict(A, Q)
        if rng.random() < 0.7:
            z = rng.normal(size=2) * 10.0 ** rng.uniform(-3, 6)
            R = np.diag(10.0 ** rng.uniform(-12, 6, 2))
            failed += not filter.update(z, H, R)
        P = filter.P
        assert (P == P.T).all(), P
        np.linalg.cholesky(P)
        assert np.isfinite(filter.x).all(), filter.x
    return failed


def main() -> None:
    """Run the soak."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    for kind in KINDS:
        failed = soak(kind, arguments.steps, arguments.seed)
        print(f"{kind}: {arguments.steps} steps, {failed} refused")


if __name__ == "__main__":
    main()
