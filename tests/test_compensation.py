"""`search.compensate`, [X21] (2.2)."""

import numpy as np
import pytest

from thing_kin import search


def test_a_constant_dwell_and_times_of_their_own() -> None:
    points = search.spiral((1.0, 2.0), gap=0.01, count=20)
    velocity = np.array([0.02, -0.01])
    constant = search.compensate(points, velocity, dwell=0.25)
    np.testing.assert_allclose(
        constant, points + np.outer(0.25 * np.arange(20), velocity), atol=1e-15
    )
    times = np.linspace(0.0, 3.0, 20) ** 2
    np.testing.assert_allclose(
        search.compensate(points, velocity, times), points + np.outer(times, velocity), atol=1e-15
    )
    assert search.compensate(np.zeros((0, 2)), velocity, 0.1).shape == (0, 2)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"points": [[0, 0, 0]]}, "points"),
        ({"points": [0, 0]}, "points"),
        ({"points": [[0, np.nan]]}, "points"),
        ({"velocity": 0.02}, "velocity"),
        ({"dwell": [0.1, 0.2]}, "dwell"),
        ({"dwell": np.nan}, "dwell"),
    ],
)
def test_refuses(arguments: dict[str, object], message: str) -> None:
    good: dict[str, object] = {"points": np.zeros((3, 2)), "velocity": (0.0, 0.0), "dwell": 0.1}
    with pytest.raises(ValueError, match=f"^{message}"):
        search.compensate(**(good | arguments))  # type: ignore[arg-type]
