"""`search.covering`: stops that cover the plane, by probability per second."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from thing_kin import search

COVARIANCE = np.array([[4e-4, 1e-4], [1e-4, 2e-4]])


def found_by_monte_carlo(points: np.ndarray, radius: float, draws: np.ndarray) -> float:
    """Share of the draws within the radius of a stop."""
    away = np.linalg.norm(draws[:, None] - points[None], axis=2).min(axis=1)
    return float((away <= radius).mean())


@settings(max_examples=25)
@given(
    a=st.floats(0.003, 0.04),
    b=st.floats(0.003, 0.04),
    turn=st.floats(0, np.pi),
    radius=st.floats(0.004, 0.015),
)
def test_finds_what_it_says(a: float, b: float, turn: float, radius: float) -> None:
    c, s = np.cos(turn), np.sin(turn)
    R = np.array([[c, -s], [s, c]])
    covariance = R @ np.diag([a * a, b * b]) @ R.T
    plan = search.covering((1.0, 2.0), covariance, radius)
    draws = np.random.default_rng(0).multivariate_normal((1.0, 2.0), covariance, 4000)
    # Sight falls off from 0.8 to 1.1 radii and lapses 5 %: a sharp disc finds more, not less.
    truth = found_by_monte_carlo(plan.points, radius, draws)
    assert truth >= plan.found[-1] - 0.01
    assert plan.found[-1] > 0.98


def test_found_is_the_probability_of_the_sight_that_it_assumes() -> None:
    plan = search.covering((0, 0), COVARIANCE, 0.01, count=12)
    rng = np.random.default_rng(1)
    draws = rng.multivariate_normal((0, 0), COVARIANCE, 20_000)
    share = np.linalg.norm(draws[:, None] - plan.points[None], axis=2) / 0.01
    sees = 0.95 * np.clip((1.1 - share) / 0.3, 0, 1)
    found = 1 - np.cumprod(1 - sees, axis=1).mean(axis=0)
    # 20 000 draws tell a probability to 0.0035; cells as wide as a third of the radius, to 0.01.
    np.testing.assert_allclose(plan.found, found, atol=0.02)


def test_begins_where_most_is_and_orders_by_probability_per_second() -> None:
    plan = search.covering((0.3, -0.2), COVARIANCE, 0.008)
    np.testing.assert_allclose(plan.points[0], (0.3, -0.2), atol=1e-12)
    np.testing.assert_allclose(
        np.diff(plan.times),
        0.16 + np.linalg.norm(np.diff(plan.points, axis=0), axis=1) / 0.18,
        rtol=1e-12,
    )
    early = plan.found[len(plan.points) // 4]
    assert early > 0.5 * plan.found[-1]
    # A slow arm makes smaller steps.
    slow = search.covering((0.3, -0.2), COVARIANCE, 0.008, speed=0.01, count=20)
    quick = search.covering((0.3, -0.2), COVARIANCE, 0.008, speed=10.0, count=20)
    way = [np.linalg.norm(np.diff(p.points, axis=0), axis=1).sum() for p in (slow, quick)]
    assert way[0] < way[1]


def test_beats_the_spiral_on_a_narrow_belief() -> None:
    covariance = np.diag([0.03**2, 0.004**2])
    radius = 0.006
    draws = np.random.default_rng(2).multivariate_normal((0, 0), covariance, 4000)
    plan = search.covering((0, 0), covariance, radius, count=25)
    spiral = search.spiral((0, 0), gap=1.5 * radius, count=25)
    assert found_by_monte_carlo(plan.points, radius, draws) > 0.15 + found_by_monte_carlo(
        spiral, radius, draws
    )


def test_windows() -> None:
    square = np.array([[0, 0], [0.1, 0], [0.1, 0.1], [0, 0.1]])
    inside = search.covering((0, 0), COVARIANCE, 0.008, within=square).points
    assert len(inside) > 5
    assert (inside >= 0).all()
    assert (inside <= 0.1).all()
    plan = search.covering(
        (0, 0), COVARIANCE, 0.008, reach_center=(0.0, 0.0), reach_radius=0.03, velocity=(-0.01, 0.0)
    )
    carrier = np.outer(plan.times, (-0.01, 0.0))
    assert (np.linalg.norm(plan.points - carrier, axis=1) <= 0.03 + 1e-12).all()
    assert search.covering((0, 0), COVARIANCE, 0.008, deadline=2.0).times.max() <= 2.0
    nowhere = search.covering((0, 0), COVARIANCE, 0.008, reach_center=(5.0, 0.0), reach_radius=0.1)
    assert len(nowhere) == 0
    assert "0 stops" in repr(nowhere)


def test_a_region_without_uncertainty_is_one_look_and_a_second_one() -> None:
    plan = search.covering((0, 0), np.zeros((2, 2)), 0.01, count=3)
    assert (plan.points[0] == 0).all()
    assert plan.found[0] > 0.94


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"radius": 0.0}, "radius"),
        ({"radius": np.inf}, "radius"),
        ({"covariance": -np.eye(2)}, "covariance"),
        ({"stop_time": 0.0}, "stop_time"),
        ({"speed": np.nan}, "speed"),
        ({"extent": -1.0}, "extent"),
        ({"extent": 1e6}, "extent"),
        ({"within": [[0, 0], [1, 1]]}, "within"),
        ({"reach_center": (0, 0, 0)}, "reach_center"),
        ({"reach_radius": 0.0}, "reach_radius"),
        ({"velocity": (0, np.inf)}, "velocity"),
        ({"deadline": -1.0}, "deadline"),
        ({"least_rate": 0.0}, "least_rate"),
        ({"count": 0}, "count"),
    ],
)
def test_refuses(arguments: dict[str, object], message: str) -> None:
    good: dict[str, object] = {"center": (0, 0), "covariance": COVARIANCE, "radius": 0.01}
    with pytest.raises(ValueError, match=f"^{message}"):
        search.covering(**(good | arguments))  # type: ignore[arg-type]
