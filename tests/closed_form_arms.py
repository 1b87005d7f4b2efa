"""Six-joint arms of every class that ik_all takes, and brute force to compare it with."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

import thing_kin as tk

Vector = NDArray[np.float64]
Rows = list[list[float]]
RIGHT = np.pi / 2


def chain(rows: Rows, joint: str = "continuous") -> tk.Chain:
    return tk.Chain.from_dh(
        [tk.DH(d=d, theta=t, a=a, alpha=alpha, joint=joint) for d, t, a, alpha in rows]
    )


def free_rows(rng: np.random.Generator) -> Rows:
    """Lengths of 0.1 to 1, any sign; axes at 0.3 rad or more from parallel."""

    def length() -> float:
        return float(rng.uniform(0.1, 1.0) * rng.choice([-1, 1]))

    def tilt() -> float:
        return float(rng.uniform(0.3, np.pi - 0.3) * rng.choice([-1, 1]))

    return [[length(), float(rng.uniform(-3, 3)), length(), tilt()] for _ in range(6)]


def parallel(rng: np.random.Generator, first: int) -> Rows:
    """Three parallel axes from joint `first` on (from 1), either way round."""
    rows = free_rows(rng)
    for row in rows[first - 1 : first + 1]:
        row[3] = float(rng.choice([0.0, np.pi]))
    return rows


def ur_like(rng: np.random.Generator) -> Rows:
    rows = parallel(rng, 2)
    rows[4][2] = 0.0  # axes 5 and 6 meet
    return rows


def parallel_last(rng: np.random.Generator) -> Rows:
    rows = parallel(rng, 2)
    rows[4][3] = 0.0  # axes 5 and 6 parallel
    return rows


def wrist(rng: np.random.Generator, **rows_set: tuple[int, int, float]) -> Rows:
    """A spherical wrist; rows_set: (row, column, value)."""
    rows = free_rows(rng)
    rows[3][2] = rows[4][2] = rows[4][0] = 0.0
    for row, column, value in rows_set.values():
        rows[row][column] = value
    return rows


def spherical_shoulder(rng: np.random.Generator) -> Rows:
    rows = free_rows(rng)
    rows[0][2] = rows[1][2] = rows[1][0] = 0.0
    return rows


# Unimation PUMA 560 (Corke's parameters) and the proportions of KUKA's KR series.
PUMA: Rows = [
    [0.6718, 0.0, 0.0, RIGHT],
    [0.0, 0.0, 0.4318, 0.0],
    [0.15005, 0.0, 0.0203, -RIGHT],
    [0.4318, 0.0, 0.0, RIGHT],
    [0.0, 0.0, 0.0, -RIGHT],
    [0.05, 0.0, 0.0, 0.0],
]
KR: Rows = [
    [0.675, 0.0, 0.35, -RIGHT],
    [0.0, -RIGHT, 1.15, 0.0],
    [0.0, 0.0, -0.041, RIGHT],
    [-1.0, 0.0, 0.0, -RIGHT],
    [0.0, 0.0, 0.0, RIGHT],
    [-0.24, np.pi, 0.0, np.pi],
]

ARMS: dict[str, Callable[[np.random.Generator], tk.Chain]] = {
    "ur5": lambda _: tk.robots.ur5(),
    "ur10": lambda _: tk.robots.ur10(),
    "puma": lambda _: chain(PUMA, "revolute"),
    "kr": lambda _: chain(KR),
    "ur_like": lambda rng: chain(ur_like(rng)),
    "parallel_askew": lambda rng: chain(parallel(rng, 2)),
    "parallel_last": lambda rng: chain(parallel_last(rng)),
    "parallel_345": lambda rng: chain(parallel(rng, 3)),
    "wrist": lambda rng: chain(wrist(rng)),
    "wrist_parallel_12": lambda rng: chain(wrist(rng, a=(0, 3, 0.0))),
    "wrist_parallel_23": lambda rng: chain(wrist(rng, a=(1, 3, np.pi))),
    "wrist_meet_12": lambda rng: chain(wrist(rng, a=(0, 2, 0.0))),
    "wrist_meet_23": lambda rng: chain(wrist(rng, a=(1, 2, 0.0))),
    "wrist_meet_123": lambda rng: chain(wrist(rng, a=(0, 2, 0.0), b=(1, 2, 0.0))),
    "spherical_shoulder": lambda rng: chain(spherical_shoulder(rng)),
}


def wrapped(q: Vector) -> Vector:
    return (q + np.pi) % (2 * np.pi) - np.pi


def nearest(q: Vector, solutions: Vector) -> float:
    """Largest joint difference, modulo turns, to the solution where that is least."""
    return float(np.abs(wrapped(solutions - q)).max(axis=1).min())


def brute_force(arm: tk.Chain, T: Vector, rng: np.random.Generator, starts: int = 600) -> Vector:
    """Solutions that Newton's method finds from everywhere, (k, 6), each once."""
    q = rng.uniform(-np.pi, np.pi, (starts, 6))
    for _ in range(60):
        pose, J = arm.fk_and_jacobian(q)
        error = tk.pose_error(pose, T)
        H = J.transpose(0, 2, 1) @ J + 1e-14 * np.eye(6)
        step = np.linalg.solve(H, J.transpose(0, 2, 1) @ error[..., None])[..., 0]
        q = q + step * np.minimum(1.0, 0.5 / np.abs(step).max(axis=1, keepdims=True))
    found: list[Vector] = []
    for candidate in q[np.linalg.norm(tk.pose_error(arm.fk(q), T), axis=1) < 1e-11]:
        if not found or nearest(candidate, np.array(found)) > 1e-5:
            found.append(wrapped(candidate))
    return np.array(found).reshape(-1, 6)
