"""Least squares in strict order within bounds, level by level, by a QP solver of another house."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import daqp
import numpy as np
from numpy.typing import NDArray

import thing_kin as tk
from inverse_cases import error_of, jacobian_of

Vector = NDArray[np.float64]
Matrix = NDArray[np.float64]


class NoAnswerError(Exception):
    """The solver finds nothing in what a level above has left: a set as thin as its tolerance."""


@dataclass
class Cascade:
    """A quadratic program a level; what a level has reached is an equality for those below."""

    lower: Vector
    upper: Vector
    equalities: list[tuple[Matrix, Vector]] = field(default_factory=list)

    def free(self) -> tuple[Vector, Matrix]:
        """A particular solution of the equalities, and their null space."""
        n = len(self.lower)
        if not self.equalities:
            return np.zeros(n), np.eye(n)
        A = np.vstack([A for A, _ in self.equalities])
        b = np.concatenate([b for _, b in self.equalities])
        U, sigma, Vt = np.linalg.svd(A)
        rank = int(np.sum(sigma > 1e-10))
        return Vt[:rank].T @ ((U.T @ b)[:rank] / sigma[:rank]), Vt[rank:].T

    def minimize(self, A: Matrix, b: Vector, damping: float = 0.0) -> Vector:
        """The level's optimum; of what it leaves free, any."""
        x0, Z = self.free()
        M = A @ Z
        if Z.shape[1] == 0:
            return x0
        _, sigma, Vt = np.linalg.svd(M)
        rank = int(np.sum(sigma > 1e-10))
        rows = Vt[:rank] @ Z.T  # what the level is about
        H = M.T @ M + damping * Vt[:rank].T @ Vt[:rank]
        z, pressing = self.quadratic(H, M.T @ (A @ x0 - b), x0, Z)
        x = x0 + Z @ z
        # What presses on a level stays where it is for those below: complementary slackness.
        bounds = np.where(pressing > 0, self.upper, self.lower)[pressing != 0]
        self.equalities.append((np.eye(len(x))[pressing != 0], bounds))
        self.equalities.append((rows, rows @ x))
        return x

    def quadratic(self, H: Matrix, f: Vector, x0: Vector, Z: Matrix) -> tuple[Vector, Vector]:
        solution = daqp.solve(
            np.ascontiguousarray(H),
            np.ascontiguousarray(f),
            np.ascontiguousarray(Z),
            np.ascontiguousarray(np.minimum(self.upper - x0, 1e30) + 1e-11),
            np.ascontiguousarray(np.maximum(self.lower - x0, -1e30) - 1e-11),
            np.zeros(len(x0), dtype=np.intc),
            primal_tol=1e-12,
            dual_tol=1e-13,
            eps_prox=1e-5,
            progress_tol=1e-16,
            iter_limit=100_000,
        )
        if solution[2] < 1:
            raise NoAnswerError(solution[2])
        multipliers = np.asarray(solution[3]["lam"])
        least = 1e-10 * max(1.0, np.abs(f).max())
        return np.asarray(solution[0]), np.sign(multipliers) * (np.abs(multipliers) > least)


def hierarchy(
    lower: Vector,
    upper: Vector,
    levels: Sequence[tuple[Matrix, Vector]],
    wish: Vector | None = None,
    damping: float = 0.0,
) -> Vector:
    cascade = Cascade(lower, upper)
    for A, b in levels:
        cascade.minimize(A, b, damping)
    n = len(lower)
    return cascade.minimize(np.eye(n), np.zeros(n) if wish is None else wish)


def levels_of(
    tasks: Sequence[tk.Task], q: Vector, targets: Sequence[Vector]
) -> list[tuple[Matrix, Vector]]:
    return [
        (jacobian_of(task, q), task.gain * error_of(task, q, target))
        for task, target in zip(tasks, targets, strict=True)
    ]
