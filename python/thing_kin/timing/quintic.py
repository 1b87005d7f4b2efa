"""A piecewise quintic with continuous second derivative, from values and two derivatives."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from math import comb

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

DEGREE = 5
PARTS = 4  # of a piece, for bounds: their slack falls with the square
# FALLING[d, k]: what u^k becomes, differentiated d times: k!/(k - d)!.
FALLING = np.array(
    [[np.prod(np.arange(k, k - d, -1.0)) if k >= d else 0.0 for k in range(6)] for d in range(6)]
)


@dataclass(frozen=True)
class Quintic:
    """Values y, first and second derivatives at the knots x, (K,) and (K, n)."""

    x: Array
    y: Array
    dy: Array
    ddy: Array

    @cached_property
    def coefficients(self) -> Array:
        """(6, K - 1, n), of powers of (x - x_k) / (x_k+1 - x_k)."""
        h = np.diff(self.x)[:, None]
        y, v, a = self.y[:-1], self.dy, self.ddy
        step = self.y[1:] - y
        v0, v1, a0, a1 = v[:-1] * h, v[1:] * h, a[:-1] * h * h, a[1:] * h * h
        c3 = 10.0 * step - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1
        c4 = -15.0 * step + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1
        c5 = 6.0 * step - 3.0 * (v0 + v1) - 0.5 * (a0 - a1)
        return np.stack([y, v0, 0.5 * a0, c3, c4, c5])

    def piece(self, x: Array) -> NDArray[np.intp]:
        """Index of the piece that each x stands in, (M,)."""
        return np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, len(self.x) - 2)

    def __call__(self, x: Array, orders: int) -> list[Array]:
        """Values and derivatives up to `orders` at x, (M, n) each."""
        k = self.piece(x)
        h = np.diff(self.x)[k][:, None]
        return _derivatives(self.coefficients[:, k], h, (x - self.x[k])[:, None] / h, orders)

    def grid(self, per_piece: int, orders: int) -> list[Array]:
        """Sample all pieces, both ends too: (K - 1, per_piece + 1, n) each."""
        h = np.diff(self.x)[:, None, None]
        u = np.linspace(0.0, 1.0, per_piece + 1)[None, :, None]
        return _derivatives(self.coefficients[:, :, None, :], h, u, orders)

    def tops(self, d: int) -> Array:
        """(K - 1, n): each piece's derivative d is nowhere larger than this, either way.

        The largest Bernstein coefficient of its parts: a polynomial lies in their hull.
        """
        c = FALLING[d, d:, None, None] * self.coefficients[d:]
        hull = np.abs(np.einsum("bk,kpn->bpn", _bernstein(DEGREE - d), c)).max(axis=0)
        return np.asarray(hull / np.diff(self.x)[:, None] ** d)

    def reach(self) -> tuple[Array, Array]:
        """(K - 1, n) each: no piece goes below the first or above the second."""
        hull = np.einsum("bk,kpn->bpn", _bernstein(DEGREE), self.coefficients)
        return hull.min(axis=0), hull.max(axis=0)

    def stretched(self, factor: float) -> Quintic:
        """Return the same curve, `factor` times slower."""
        return Quintic(self.x * factor, self.y, self.dy / factor, self.ddy / factor**2)


@cache
def _bernstein(degree: int) -> Array:
    """From powers of u in [0, 1] to the Bernstein coefficients of PARTS equal parts."""
    matrices = []
    for part in range(PARTS):
        shift = np.zeros((degree + 1, degree + 1))  # u = (part + x) / PARTS, in powers of x
        for j in range(degree + 1):
            for k in range(j, degree + 1):
                shift[j, k] = comb(k, j) * part ** (k - j) / PARTS**k
        hull = [
            [comb(i, j) / comb(degree, j) for j in range(degree + 1)] for i in range(degree + 1)
        ]
        matrices.append(np.array(hull) @ shift)
    return np.concatenate(matrices)


def _derivatives(c: Array, h: Array, u: Array, orders: int) -> list[Array]:
    """Value and derivatives at u in [0, 1] of pieces of length h, by Horner's rule."""
    values = []
    for d in range(orders + 1):
        value = FALLING[d, DEGREE] * c[DEGREE] + 0.0 * u
        for k in range(DEGREE - 1, d - 1, -1):
            value = FALLING[d, k] * c[k] + u * value
        values.append(value / h**d)
    return values
