"""Task priority and its inverses in plain numpy, from the equations and not from the library."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import thing_kin as tk

Vector = NDArray[np.float64]
Matrix = NDArray[np.float64]
Filter = tk.SingularValueFilter | None

EPS = np.finfo(np.float64).eps


@dataclass(frozen=True)
class Level:
    """A task at one posture: J dq should be e."""

    J: Matrix
    e: Vector
    blocks: Sequence[int]


def rank_of(sigma: Vector, shape: tuple[int, ...], scale: float = 0.0) -> int:
    return int(np.sum(sigma > max(shape) * EPS * max(sigma[0], scale)))


def lifted(sigma: Vector, singular_value_filter: Filter) -> Vector:
    """[M17] (4.12)."""
    if singular_value_filter is None:
        return sigma
    sigma0, nu = singular_value_filter.sigma0, singular_value_filter.nu
    return sigma + 2 * sigma0 / (sigma**2 + nu * sigma + 2)


def clamp_max_abs(v: Vector, bound: float) -> Vector:
    largest = np.abs(v).max()
    return v * (bound / largest) if largest > bound else v


def selectively_damped(
    A: Matrix,
    e: Vector,
    gamma_max: float,
    blocks: Sequence[int],
    singular_value_filter: Filter = None,
) -> Vector:
    """Buss & Kim (2005) as in equations.md section 2, one singular direction after the other."""
    U, sigma, Vt = np.linalg.svd(A, full_matrices=False)
    rank = len(sigma) if singular_value_filter else rank_of(sigma, A.shape)
    sigma = lifted(sigma, singular_value_filter)
    parts = np.split(np.arange(len(A)), np.cumsum(blocks)[:-1])
    filtered = U @ np.diag(sigma) @ Vt
    rho = sum(np.linalg.norm(filtered[part], axis=0) for part in parts)
    step = np.zeros(A.shape[1])
    for s, u, v in list(zip(sigma, U.T, Vt, strict=True))[:rank]:
        N = sum(np.linalg.norm(u[part]) for part in parts)
        M = np.abs(v) @ rho / s
        step += clamp_max_abs(u @ e / s * v, gamma_max * min(1.0, N / M))
    return clamp_max_abs(step, gamma_max)


def apply_inverse(
    inverse: object, A: Matrix, e: Vector, blocks: Sequence[int], singular_value_filter: Filter
) -> Vector:
    if isinstance(inverse, tk.SelectivelyDamped):
        return selectively_damped(A, e, inverse.gamma_max, blocks, singular_value_filter)
    U, sigma, Vt = np.linalg.svd(A, full_matrices=False)
    sigma = lifted(sigma, singular_value_filter)
    damping = inverse.damping if isinstance(inverse, tk.Damped) else 0.0
    return Vt.T @ (sigma / (sigma**2 + damping) * (U.T @ e))


def projector(J: Matrix) -> Matrix:
    """I - J^+ J from the rows of V that belong to nonzero singular values."""
    _, sigma, Vt = np.linalg.svd(J)
    row_space = Vt[: rank_of(sigma, J.shape)]
    return np.eye(J.shape[1]) - row_space.T @ row_space


def projectors(levels: Sequence[Level]) -> list[Matrix]:
    """N_0 = I, then of the stacked Jacobians of the first, the first two, ... levels."""
    identity = np.eye(levels[0].J.shape[1])
    stacked = [np.vstack([level.J for level in levels[: i + 1]]) for i in range(len(levels))]
    return [identity, *(projector(J) for J in stacked)]


Invert = Callable[[Matrix, Vector, Sequence[int]], Vector]


def recursive_step(levels: Sequence[Level], invert: Invert) -> Vector:
    """[M17] (4.16), and Siciliano & Slotine for more than two tasks."""
    dq = np.zeros(levels[0].J.shape[1])
    for level, N in zip(levels, projectors(levels), strict=False):
        dq = dq + N @ invert(level.J @ N, level.e - level.J @ dq, level.blocks)
    return dq


def robust_step(levels: Sequence[Level], invert: Invert) -> Vector:
    """[M17] (4.17): sum_i N_{i-1} J_i# e_i."""
    steps = [invert(level.J, level.e, level.blocks) for level in levels]
    return sum(N @ step for N, step in zip(projectors(levels), steps, strict=False))
