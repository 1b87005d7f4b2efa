"""`search.spiral`, [X21] 2.2."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thing_kin import search

# Millimetres; gap = spacing = 6.
ORACLE = [
    (0.0, 0.0),
    (4.3687, -3.174),
    (5.7582, 2.8947),
    (1.3405, 7.2005),
    (-4.7607, 6.5532),
    (-8.6148, 1.8081),
    (-8.4216, -4.2861),
    (-4.5374, -8.9706),
    (1.3334, -10.5362),
    (7.0899, -8.6153),
    (10.9759, -3.9621),
    (11.9913, 2.0095),
]

LENGTHS = st.floats(1e-4, 0.05)


def test_points_of_the_oracle() -> None:
    points = search.spiral((0.0, 0.0), gap=0.006, count=12)
    np.testing.assert_allclose(1e3 * points, ORACLE, atol=5e-5)


@given(gap=LENGTHS, spacing=LENGTHS, turns=st.floats(1.0, 8.0))
def test_lies_on_the_spiral_evenly(gap: float, spacing: float, turns: float) -> None:
    center = np.array([1.5, -0.3])
    points = search.spiral(center, gap=gap, spacing=spacing, radius=turns * gap)
    assert (points[0] == center).all()
    d = points[1:] - center
    r = np.linalg.norm(d, axis=1)
    assert (r <= turns * gap).all()
    # r = gap times turns: the angle says the same, but for whole turns.
    off = r / gap - np.arctan2(d[:, 1], d[:, 0]) / (2 * np.pi)
    np.testing.assert_allclose(off - np.round(off), 0.0, atol=1e-9)
    assert (np.diff(r) > 0).all()
    # Along the arc each step is the spacing, to first order in the step.
    steps = np.diff(r) / gap * 2 * np.pi * np.hypot(r[:-1], gap / (2 * np.pi))
    np.testing.assert_allclose(steps, spacing, rtol=1e-6)


def test_count_and_radius_both_end_it() -> None:
    assert len(search.spiral((0, 0), gap=0.01, count=1)) == 1
    assert len(search.spiral((0, 0), gap=0.01, radius=0.0)) == 1
    wide = search.spiral((0, 0), gap=0.01, radius=0.1)
    np.testing.assert_array_equal(search.spiral((0, 0), gap=0.01, radius=0.1, count=20), wide[:20])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"gap": 0.0, "count": 3}, "gap: got 0"),
        ({"gap": np.nan, "count": 3}, "gap"),
        ({"gap": 0.01, "spacing": -1.0, "count": 3}, "spacing"),
        ({"gap": 0.01, "radius": -1.0}, "radius"),
        ({"gap": 0.01, "radius": np.nan}, "radius"),
        ({"gap": 0.01, "count": 0}, "count: got 0"),
        ({"gap": 0.01, "count": 2.5}, "count: got 2.5"),
        ({"gap": 0.01, "count": True}, "count"),
        ({"gap": 0.01}, "count"),
        ({"gap": 1e-6, "radius": 1.0}, "radius"),
    ],
)
def test_refuses(arguments: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=f"^{message}"):
        search.spiral((0.0, 0.0), **arguments)
