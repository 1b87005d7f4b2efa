"""Matrices whose rank is exact, for tests of inverses and null spaces."""

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

Matrix = NDArray[np.float64]

EPS = np.finfo(np.float64).eps


def of_rank(m: int, n: int, rank: int, seed: int) -> Matrix:
    """Product of small whole numbers: its rank is at most `rank`, exactly and not to rounding."""
    rng = np.random.default_rng(seed)
    return (rng.integers(-4, 5, (m, rank)) @ rng.integers(-4, 5, (rank, n))).astype(float)


@st.composite
def matrices(draw: st.DrawFn, most: int = 12) -> Matrix:
    """Tall, wide and square, 1 to `most` on a side, of every rank from 0."""
    m, n = draw(st.integers(1, most)), draw(st.integers(1, most))
    return of_rank(m, n, draw(st.integers(0, min(m, n))), draw(st.integers(0, 2**32 - 1)))
