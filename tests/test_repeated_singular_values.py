"""Where singular values meet: kappa has no gradient there, the manipulability has one."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import thing_kin as tk
from oracles import assert_close, derivative

RIGHT = np.pi / 2


def gantry(lead: tuple[tk.DH, ...] = ()) -> tk.Chain:
    """Three slides and three turns about the tool's origin, all square at q = 0.

    J is orthogonal there; with the middle turn at b its singular values are one, four times, and
    sqrt(1 +- sin(b)), so that M = cos(b).
    """
    slides = [tk.DH(theta=RIGHT, alpha=RIGHT, joint="prismatic")] * 3
    turns = [
        tk.DH(alpha=RIGHT, joint="revolute"),
        tk.DH(theta=RIGHT, alpha=RIGHT, joint="revolute"),
        tk.DH(joint="revolute"),
    ]
    return tk.Chain.from_dh([*lead, *slides, *turns])


def test_all_six_equal():
    robot, q = gantry(), np.zeros(6)
    assert_close(robot.jacobian(q) @ robot.jacobian(q).T, np.eye(6), atol=1e-15)
    assert_allclose(robot.manipulability(q), 1.0, rtol=1e-14)
    assert_allclose(robot.condition_number(q), 1.0, rtol=1e-14)
    for gradient in (robot.condition_number_gradient, robot.dexterity_gradient):
        with pytest.raises(ValueError, match=r"^q: .*repeated"):
            gradient(q)


@pytest.mark.parametrize("seed", range(20))
def test_all_six_equal_up_to_rounding(seed: int):
    """The world turned, the slides anywhere: the same singular values but for their last digits."""
    rng = np.random.default_rng(seed)
    lead = tk.DH(*rng.uniform(-1, 1, 4))
    q = np.append(rng.uniform(-1, 1, 3), [rng.uniform(-3, 3), 0.0, rng.uniform(-3, 3)])
    robot = gantry(lead=(lead,))
    assert_allclose(robot.condition_number(q), 1.0, rtol=1e-14)
    with pytest.raises(ValueError, match=r"^q: .*repeated"):
        robot.condition_number_gradient(q)


@pytest.mark.parametrize("q4", [0.0, 0.4])
def test_the_manipulability_is_smooth_all_the_same(q4: float):
    robot, q = gantry(), np.array([0.1, -0.2, 0.3, 0.5, q4, -0.7])
    assert_allclose(robot.manipulability(q), np.cos(q4), rtol=1e-14)
    assert_close(robot.manipulability_gradient(q), -np.sin(q4) * np.eye(6)[4], atol=1e-14)


def test_values_repeated_between_the_extremes_do_no_harm():
    robot, q = gantry(), np.array([0.1, -0.2, 0.3, 0.5, 0.4, -0.7])
    sigma = np.linalg.svd(robot.jacobian(q), compute_uv=False)
    assert_close(sigma[1:5], np.ones(4), atol=1e-14)
    kappa = sigma[0] / sigma[5]
    for measure in ("condition_number", "dexterity"):
        expected = derivative(getattr(robot, measure), q)
        assert_close(getattr(robot, f"{measure}_gradient")(q), expected, atol=1e-9 * kappa**2)
