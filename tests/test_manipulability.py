"""Manipulability (4.30), condition number (4.32), dexterity (4.33) and their gradients."""

import numpy as np
import pytest
from hypothesis import given
from numpy.testing import assert_allclose

import thing_kin as tk
from oracles import derivative
from strategies import Case, cases

RTOL = 1e-9  # kappa < 100 here, so that a singular value keeps thirteen digits
# Differences at this step are good to 1e-9 where singular values stay 0.05 sigma_1 apart.
STEP, RTOL_DIFFERENCES = 1e-4, 1e-7

ROBOTS = {
    "thing": tk.robots.thing(),
    "thing, base first": tk.robots.thing(order="base_first"),
    "pioneer": tk.robots.pioneer_lx_ur5(),
    "ur5": tk.robots.ur5(),
}


def is_tame(robot: tk.Chain, q, of=None) -> bool:
    sigma = np.linalg.svd(robot.jacobian(q, of=of), compute_uv=False) if robot.n >= 6 else [1, 0]
    gaps = -np.diff(np.append(sigma, 0.0)) / sigma[0]
    return len(sigma) == 6 and min(gaps[0], gaps[4], sigma[5] / sigma[0]) > 0.05


def tame_postures(robot: tk.Chain, count: int = 5):
    Q = robot.random(500, rng=4)
    return [q for q in Q if is_tame(robot, q)][:count]


POSTURES = [
    pytest.param(robot, q, id=f"{name} {i}")
    for name, robot in ROBOTS.items()
    for i, q in enumerate(tame_postures(robot))
]


def test_there_are_postures_of_every_robot():
    assert len(POSTURES) == 5 * len(ROBOTS)


@pytest.mark.parametrize(("robot", "q"), POSTURES)
def test_measures_are_their_formulas(robot: tk.Chain, q):
    J = robot.jacobian(q)
    M, kappa = np.sqrt(np.linalg.det(J @ J.T)), np.linalg.cond(J)
    assert_allclose(robot.manipulability(q), M, rtol=RTOL)
    assert_allclose(robot.condition_number(q), kappa, rtol=RTOL)
    assert_allclose(robot.dexterity(q), np.sqrt(kappa / M), rtol=RTOL)


@pytest.mark.parametrize(("robot", "q"), POSTURES)
def test_the_gradient_of_m_is_equation_4_31(robot: tk.Chain, q):
    """With the factor M/2 that the source leaves out of (4.31)."""
    J, H = robot.jacobian(q), robot.hessian(q)
    A = J @ J.T
    dA = np.einsum("aik,bi->abk", H, J)
    dA = dA + dA.transpose(1, 0, 2)
    expected = np.sqrt(np.linalg.det(A)) / 2 * np.einsum("ab,bak->k", np.linalg.inv(A), dA)
    gradient = robot.manipulability_gradient(q)
    assert_allclose(gradient, expected, rtol=0, atol=RTOL * np.abs(expected).max())


MEASURES = ["manipulability", "condition_number", "dexterity"]


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize(("robot", "q"), POSTURES)
def test_gradients_are_the_slopes(robot: tk.Chain, q, measure: str):
    expected = derivative(getattr(robot, measure), q, step=STEP)
    gradient = getattr(robot, f"{measure}_gradient")(q)
    assert gradient.shape == (robot.n,)
    assert_allclose(gradient, expected, rtol=0, atol=RTOL_DIFFERENCES * np.abs(expected).max())


def random_chain(seed: int):
    """Six to nine joints and, if there is one, a tame posture of theirs."""
    rng = np.random.default_rng(seed)
    joints = rng.choice(["revolute", "revolute", "prismatic"], size=rng.integers(6, 10))
    chain = tk.Chain.from_dh([tk.DH(*rng.uniform(-1, 1, 4), joint=str(j)) for j in joints])
    tame = (q for q in rng.uniform(-3, 3, (100, chain.n)) if is_tame(chain, q))
    return chain, next(tame, None)


def test_slopes_of_random_chains():
    tame = [(chain, q) for chain, q in map(random_chain, range(60)) if q is not None]
    assert len(tame) > 20
    for chain, q in tame:
        for measure in MEASURES:
            expected = derivative(getattr(chain, measure), q, step=STEP)
            gradient = getattr(chain, f"{measure}_gradient")(q)
            atol = RTOL_DIFFERENCES * np.abs(expected).max()
            assert_allclose(gradient, expected, rtol=0, atol=atol)


@given(cases())
def test_m_is_the_product_of_six_singular_values(case: Case):
    sigma = np.linalg.svd(case.chain.jacobian(case.q), compute_uv=False)
    expected = np.prod(sigma) if len(sigma) == 6 else 0.0
    atol = 1e-13 * sigma[0] ** 6  # a value that counts as zero is off by all of itself
    assert_allclose(case.chain.manipulability(case.q), expected, rtol=0, atol=atol)


@given(cases(max_rows=5))
def test_five_joints_span_no_six_dimensions(case: Case):
    assert_no_dexterity(case.chain, case.q)


def assert_no_dexterity(robot: tk.Chain, q, of=None):
    """What a posture is worth where the rank is lost."""
    assert robot.manipulability(q, of) == 0.0
    assert robot.condition_number(q, of) == np.inf
    assert robot.dexterity(q, of) == np.inf
    np.testing.assert_array_equal(robot.manipulability_gradient(q, of), np.zeros(robot.n))
    for gradient in (robot.condition_number_gradient, robot.dexterity_gradient):
        with pytest.raises(ValueError, match=r"^q: .*singular value"):
            gradient(q, of)


@pytest.mark.parametrize(
    "q",
    [
        pytest.param([0.3, -1.0, 0.0, 0.4, 0.9, 0.2], id="elbow straight"),
        pytest.param([0.3, -1.0, 1.2, 0.4, 0.0, 0.2], id="wrist in line"),
        pytest.param([0.3, -1.0, 1.2, 0.4, np.pi, 0.2], id="wrist folded"),
        pytest.param(np.zeros(6), id="all zero"),
    ],
)
def test_singular_postures_of_an_arm(q):
    assert np.linalg.matrix_rank(tk.robots.ur5().jacobian(q)) < 6
    assert_no_dexterity(tk.robots.ur5(), q)


def test_of_a_frame_within_the_arm():
    robot = tk.robots.thing()
    q = next(q for q in robot.random(500, rng=7) if is_tame(robot, q, "wrist_2"))
    J = robot.jacobian(q, of="wrist_2")
    assert_allclose(robot.manipulability(q, of="wrist_2"), np.sqrt(np.linalg.det(J @ J.T)), RTOL)
    for measure in MEASURES:
        expected = derivative(lambda q, m=measure: getattr(robot, m)(q, "wrist_2"), q, step=STEP)
        gradient = getattr(robot, f"{measure}_gradient")(q, "wrist_2")
        assert_allclose(gradient, expected, rtol=0, atol=RTOL_DIFFERENCES * np.abs(expected).max())
    assert_no_dexterity(robot, q, of="base")  # three joints


def test_a_lost_rank_anywhere_in_a_batch_is_refused_or_counted():
    arm = tk.robots.ur5()
    Q = np.array([[0.3, -1.0, 1.2, 0.4, 0.9, 0.2], np.zeros(6)])
    assert arm.manipulability(Q)[0] > 0.0
    assert arm.manipulability(Q)[1] == 0.0
    assert list(np.isfinite(arm.condition_number(Q))) == [True, False]
    with pytest.raises(ValueError, match=r"^q: "):
        arm.condition_number_gradient(Q)


def test_one_configuration_gives_a_float():
    q = tk.robots.ur5().random(rng=0)
    assert all(type(getattr(tk.robots.ur5(), measure)(q)) is float for measure in MEASURES)
