"""`search.stochastic`, [X21] (2.1)."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thing_kin import search

DEVIATIONS = st.floats(1e-5, 0.05)


@given(
    a=DEVIATIONS,
    b=DEVIATIONS,
    correlation=st.floats(-0.99, 0.99),
    gap=st.floats(1e-4, 0.02),
    keep=st.integers(1, 300),
    seed=st.integers(0, 2**70),
)
def test_cells_of_a_grid_by_falling_density(
    a: float, b: float, correlation: float, gap: float, keep: int, seed: int
) -> None:
    center = np.array([2.0, -1.0])
    covariance = np.array([[a * a, correlation * a * b], [correlation * a * b, b * b]])
    points = search.stochastic(center, covariance, gap, keep=keep, rng=seed)
    assert 1 <= len(points) <= keep
    assert (points[0] == center).all()
    cells = (points - center) / gap
    np.testing.assert_allclose(cells, np.round(cells), atol=1e-6)
    assert len(np.unique(np.round(cells), axis=0)) == len(cells)
    d = points - center
    distance = np.einsum("ni,ij,nj->n", d, np.linalg.inv(covariance), d)
    assert (np.diff(distance) >= -1e-6 * (1 + distance[1:])).all()


def test_draws_have_the_covariance() -> None:
    # Cells once each tell nothing of how often; a fine grid keeps (nearly) all draws apart.
    covariance = np.array([[4e-4, 1.5e-4], [1.5e-4, 1e-4]])
    points = search.stochastic((0, 0), covariance, 1e-7, count=100_000, keep=100_001, rng=0)
    assert len(points) > 99_900
    # Standard deviation of a sample variance: sqrt(2 / n), 0.45 %.
    np.testing.assert_allclose(np.cov(points.T), covariance, rtol=0.02)
    np.testing.assert_allclose(points.mean(0), 0.0, atol=4 * 0.02 / np.sqrt(1e5))


def test_ties_by_x_then_y() -> None:
    points = search.stochastic((0, 0), np.eye(2), 1.0, count=5000, keep=9, rng=1)
    ring = [(-1, 0), (0, -1), (0, 1), (1, 0), (-1, -1), (-1, 1), (1, -1), (1, 1)]
    np.testing.assert_array_equal(points, [(0, 0), *ring])


def test_singular_covariances() -> None:
    line = search.stochastic((0, 0), [[0, 0], [0, 1e-4]], 1e-3, rng=0)
    assert (line[:, 0] == 0).all()
    assert len(line) > 10
    assert len(search.stochastic((0, 0), np.zeros((2, 2)), 1e-3, rng=0)) == 1
    diagonal = search.stochastic((0, 0), 1e-4 * np.ones((2, 2)), 1e-3, rng=0)
    np.testing.assert_array_equal(diagonal[:, 0], diagonal[:, 1])


def test_randomness() -> None:
    def draw(rng: object) -> np.ndarray:
        return search.stochastic((0, 0), 1e-4 * np.eye(2), 1e-3, rng=rng)  # type: ignore[arg-type]

    np.testing.assert_array_equal(draw(7), draw(7))
    assert not np.array_equal(draw(7), draw(8))
    assert not np.array_equal(draw(1), draw(1 + 2**64))
    assert not np.array_equal(draw(None), draw(None))
    generator = np.random.default_rng(0)
    first, second = draw(generator), draw(generator)
    assert not np.array_equal(first, second)
    np.testing.assert_array_equal(first, draw(np.random.default_rng(0)))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"covariance": [[1, 2], [2, 1]]}, "covariance"),
        ({"covariance": np.eye(3)}, "covariance"),
        ({"covariance": np.full((2, 2), np.nan)}, "covariance"),
        ({"center": (0, np.inf)}, "center"),
        ({"center": (0, 0, 0)}, "center"),
        ({"sample_gap": 0.0}, "sample_gap"),
        ({"count": 0}, "count"),
        ({"keep": -1}, "keep"),
        ({"rng": -1}, "rng"),
        ({"rng": 0.5}, "rng"),
        ({"rng": True}, "rng"),
        ({"rng": "seed"}, "rng"),
    ],
)
def test_refuses(arguments: dict[str, object], message: str) -> None:
    good: dict[str, object] = {"center": (0, 0), "covariance": np.eye(2), "sample_gap": 0.1}
    with pytest.raises(ValueError, match=f"^{message}"):
        search.stochastic(**(good | arguments))  # type: ignore[arg-type]
