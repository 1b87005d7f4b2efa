"""Terms: their values, Jacobians and Hessians against other sources, at degenerate places too."""

from collections.abc import Callable

import numpy as np
import pinocchio as pin
import pytest
import sympy
from hypothesis import assume, example, given
from hypothesis import strategies as st

import thing_kin as tk
from oracles import PinocchioChain, assert_close, derivative
from strategies import Case, cases, lengths, poses, rotation_vectors, seeds, unit_vectors
from thing_kin import lie, terms

ROBOT = tk.robots.thing()
ARM = tk.robots.ur10()
SEED = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.1, -0.2, 0.3])
WEIGHTS = np.array([1.0, 2.0, 0.5, 1.0, 1.0, 1.0, 0.3, 0.2, 0.1])
OBSTACLES = [
    tk.Disc((0.6, 0.6), 0.4),
    tk.Sphere((9.0, 2.0, 0.5), 0.1),
    tk.Capsule((7.0, -7.0, 0.0), (7.0, -7.0, 2.0), 0.2),
    tk.HalfSpace((0.1, 0.2, 1.0), offset=-0.5),
]
SHAPE = tk.LinkSpheres.along_links(ROBOT, 0.08, 0.2)
ON_BASE = tk.LinkSpheres(ROBOT, [("base", (0.2, 0.0, 0.3), 0.4)])
PLANAR = [tk.DH(a=0.5, joint="revolute")] * 3
points = st.tuples(lengths, lengths, lengths)


def value(term: terms.Term, robot: tk.Chain | None, q: np.ndarray) -> np.ndarray:
    return term.evaluate(robot, q)[0]


def jacobian(term: terms.Term, robot: tk.Chain | None, q: np.ndarray) -> np.ndarray:
    return term.evaluate(robot, q)[1]


def assert_derivatives(
    term: terms.Term,
    robot: tk.Chain | None,
    q: np.ndarray,
    step: float = 1e-3,
    rtol: float = 1e-8,
) -> None:
    """Against differences of fourth order: of the value, and of the Jacobian."""
    J = jacobian(term, robot, q)
    scale = 1.0 + np.abs(J).max(initial=0.0)
    assert_close(J, derivative(lambda x: value(term, robot, x), q, step), rtol * scale)
    w = np.cos(np.arange(len(J)))
    H = term.hessian(robot, q, w)
    by_differences = derivative(lambda x: w @ jacobian(term, robot, x), q, step)
    assert_close(H, by_differences, 10 * rtol * (1.0 + np.abs(H).max(initial=0.0)))
    assert np.array_equal(H, H.T) or np.abs(H - H.T).max() < 1e-12 * (1.0 + np.abs(H).max())


def frame_of(case: Case) -> str:
    return case.chain.frames[case.frame]


# Pose, position, orientation


@given(case=cases(), target=poses())
def test_pose_is_the_pose_error(case: Case, target: np.ndarray) -> None:
    T = case.chain.fk(case.q, frame_of(case))
    error = tk.pose_error(T, target)
    assume(np.linalg.norm(error[3:]) < np.pi - 1e-6)  # beyond: which of two axes is rounding
    assert_close(value(terms.Pose(target, frame=frame_of(case)), case.chain, case.q), error, 1e-9)
    position = terms.Position(target[:3, 3], frame=frame_of(case))
    assert_close(value(position, case.chain, case.q), error[:3], 1e-13)
    orientation = terms.Orientation(target[:3, :3], frame=frame_of(case))
    assert_close(value(orientation, case.chain, case.q), error[3:], 1e-9)


@given(case=cases(), target=poses())
def test_pose_jacobian_by_pinocchio(case: Case, target: np.ndarray) -> None:
    """Its Jlog3 is the inverse right Jacobian of the logarithm."""
    oracle = PinocchioChain(case.rows)
    J = oracle.jacobian(case.q, of=case.frame)
    R = oracle.fk_all(case.q)[case.frame, :3, :3]
    difference = target[:3, :3] @ R.T
    assume(np.linalg.norm(pin.log3(difference)) < 3.0)  # nearer to pi Pinocchio loses digits
    expected = np.vstack([-J[:3], -pin.Jlog3(difference) @ J[3:]])
    term = terms.Pose(target, frame=frame_of(case))
    assert_close(jacobian(term, case.chain, case.q), expected, 1e-8)
    split = [
        jacobian(terms.Position(target[:3, 3], frame=frame_of(case)), case.chain, case.q),
        jacobian(terms.Orientation(target[:3, :3], frame=frame_of(case)), case.chain, case.q),
    ]
    assert_close(np.vstack(split), expected, 1e-8)


@given(case=cases(max_rows=8), phi=rotation_vectors(3.0), shift=points, point=points)
def test_pose_derivatives(case: Case, phi: np.ndarray, shift, point) -> None:
    """From no error at all to 3 rad, in all directions."""
    target = case.chain.fk(case.q, frame_of(case))
    target[:3, :3] = lie.so3_exp(phi) @ target[:3, :3]
    target[:3, 3] += shift
    # At 3 rad the logarithm's derivatives grow with the inverse of the way to 2 pi: mild.
    for term in (
        terms.Pose(target, frame=frame_of(case)),
        terms.Orientation(target[:3, :3], frame=frame_of(case)),
        terms.Position(target[:3, 3], frame=frame_of(case), point=point),
    ):
        assert_derivatives(term, case.chain, case.q)


def test_position_and_distance_by_sympy() -> None:
    """A planar arm of three links, and the distance of its tip from a sphere, symbolically."""
    q = sympy.symbols("a b c")
    arm = tk.Chain.from_dh([tk.DH(a=a, joint="revolute") for a in (0.7, 0.5, 0.3)])
    sums = [sum(q[: i + 1]) for i in range(3)]
    x = sum(a * sympy.cos(s) for a, s in zip((0.7, 0.5, 0.3), sums, strict=True))
    y = sum(a * sympy.sin(s) for a, s in zip((0.7, 0.5, 0.3), sums, strict=True))
    at = dict(zip(q, (0.4, -1.1, 0.8), strict=True))
    numbers = np.array(list(at.values()))
    tip = tk.LinkSpheres(arm, [("tool", (0, 0, 0), 0.1)])
    clearance = terms.Clearance(tip, [tk.Sphere((0.2, 0.3, 0.4), 0.2)])
    gap = sympy.sqrt((x - 0.2) ** 2 + (y - 0.3) ** 2 + 0.4**2) - 0.3
    for term, row, formula in (
        (terms.Position((0, 0, 0)), 0, -x),
        (terms.Position((0, 0, 0)), 1, -y),
        (clearance, 0, gap),
    ):
        weights = np.eye(3 if term.name == "position" else 1)[row]
        assert_close(value(term, arm, numbers)[row], float(formula.subs(at)), 1e-14)
        gradient = np.array([formula.diff(v).subs(at) for v in q], dtype=float)
        assert_close(jacobian(term, arm, numbers)[row], gradient, 1e-14)
        exact = np.array(sympy.hessian(formula, q).subs(at), dtype=float)
        assert_close(term.hessian(arm, numbers, weights), exact, 1e-13)


# The cone


@given(case=cases(), axis=unit_vectors(), direction=unit_vectors())
def test_orientation_cone(case: Case, axis: np.ndarray, direction: np.ndarray) -> None:
    term = terms.OrientationCone(3.0 * axis, 0.2 * direction, frame=frame_of(case))
    a = case.chain.fk(case.q, frame_of(case))[:3, :3] @ axis
    # Half angles cancel nothing: 2 atan2(|a - d|, |a + d|).
    angle = 2 * np.arctan2(np.linalg.norm(a - direction), np.linalg.norm(a + direction))
    assert_close(value(term, case.chain, case.q), [angle], 1e-13)
    if 0.1 < angle < np.pi - 0.1:
        assert_derivatives(term, case.chain, case.q)


def test_the_tips_of_the_cone() -> None:
    z = ARM.fk(SEED[:6])[:3, 2]
    ahead = terms.OrientationCone((0, 0, 1), z)
    angle, J = ahead.evaluate(ARM, SEED[:6])
    assert angle[0] < 1e-15
    assert not J.any()
    assert not ahead.hessian(ARM, SEED[:6]).any()
    angle, J = terms.OrientationCone((0, 0, 1), -z).evaluate(ARM, SEED[:6])
    assert angle[0] == pytest.approx(np.pi, abs=1e-15)
    step = -0.01 * J[0] / np.linalg.norm(J)
    nearer = value(terms.OrientationCone((0, 0, 1), -z), ARM, SEED[:6] + step)
    assert nearer[0] < np.pi - 0.005  # there is a way out


# The base


@given(seed=seeds)
def test_base_terms(seed: int) -> None:
    rng = np.random.default_rng(seed)
    q = ROBOT.random(rng=rng)
    center = rng.uniform(-3, 3, 2)
    for robot, x in ((ROBOT, q), (tk.robots.thing(order="base_first"), np.roll(q, 3))):
        base = robot.base_pose(x)[:2]
        distance = terms.BaseDistance(center)
        assert_close(value(distance, robot, x), [np.hypot(*(base - center))], 1e-14)
        assert_derivatives(distance, robot, x, step=1e-3 * min(1.0, np.hypot(*(base - center))))
        position = terms.BasePosition(center)
        assert_close(value(position, robot, x), center - base, 1e-14)
        assert_derivatives(position, robot, x)


def test_at_the_center_there_is_a_way_out() -> None:
    distance, J = terms.BaseDistance(SEED[6:8]).evaluate(ROBOT, SEED)
    assert distance[0] == 0.0
    assert np.linalg.norm(J) == 1.0
    assert not terms.BaseDistance(SEED[6:8]).hessian(ROBOT, SEED).any()


# Clearance


@given(seed=seeds)
@example(seed=0)
def test_clearances_one_by_one(seed: int) -> None:
    q = ROBOT.random(rng=seed)
    term = terms.Clearance(SHAPE, OBSTACLES)
    centers = SHAPE.centers(ROBOT, q)
    expected = [OBSTACLES[0].signed_distance((*ROBOT.base_pose(q)[:2], 0.0))]
    for obstacle in OBSTACLES[1:]:
        expected.extend(obstacle.signed_distance(centers) - 0.08)
    expected.extend(np.linalg.norm(centers[i] - centers[j]) - 0.16 for i, j in SHAPE.pairs)
    numbers = value(term, ROBOT, q)
    assert_close(numbers, expected, 1e-13)
    rows = term.rows(ROBOT)
    assert len(rows) == len(numbers)
    assert rows[0] == "the base and obstacle 0"
    assert rows[1].startswith("sphere 0 (")
    assert rows[-1].startswith(f"spheres {SHAPE.pairs[-1][0]} (")


def test_clearance_derivatives() -> None:
    rng = np.random.default_rng(3)
    term = terms.Clearance(SHAPE, OBSTACLES)
    checked = 0
    for _ in range(20):
        q = ROBOT.random(rng=rng)
        if value(term, ROBOT, q).min() > -0.1:  # centers of pairs are 0.06 m apart at least
            checked += 1
            assert_derivatives(term, ROBOT, q, step=2e-4, rtol=1e-7)
    assert checked > 10


def test_what_counts_as_clearance() -> None:
    spheres = len(SHAPE)
    pairs = len(SHAPE.pairs)
    sizes = {
        terms.Clearance(SHAPE): pairs,
        terms.Clearance(SHAPE, self_collision=False): 0,
        terms.Clearance(SHAPE, OBSTACLES): 1 + 3 * spheres + pairs,
        terms.Clearance(SHAPE, OBSTACLES, self_collision=False): 1 + 3 * spheres,
        terms.Clearance(obstacles=OBSTACLES[:1]): 1,
        terms.Clearance(): 0,
    }
    for term, size in sizes.items():
        numbers, J = term.evaluate(ROBOT, SEED)
        assert numbers.shape == (size,)
        assert J.shape == (size, 9)
        assert term.hessian(ROBOT, SEED).shape == (9, 9)


# Dexterity

MEASURES: dict[str, tuple[Callable, str]] = {
    "Manipulability": (terms.Manipulability, "manipulability"),
    "ConditionNumber": (terms.ConditionNumber, "condition_number"),
    "Dexterity": (terms.Dexterity, "dexterity"),
}


def bent(seed: int) -> np.ndarray:
    """A random posture whose elbow and wrist are not straight."""
    q = ROBOT.random(rng=seed)
    q[2] = 1.5 + 0.5 * np.sin(q[2])
    q[4] = 1.3 + 0.5 * np.sin(q[4])
    return q


@pytest.mark.parametrize("name", MEASURES)
@given(seed=seeds)
def test_measures_of_the_whole_body(name: str, seed: int) -> None:
    make, method = MEASURES[name]
    q = bent(seed)
    expected = getattr(ROBOT, method)(q)
    assert_close(value(make(), ROBOT, q), [expected], 1e-11 * expected)
    gradient = getattr(ROBOT, f"{method}_gradient")(q)
    assert_close(jacobian(make(), ROBOT, q)[0], gradient, 1e-9 * (1 + np.abs(gradient).max()))


@pytest.mark.parametrize("name", MEASURES)
@given(seed=seeds)
def test_measures_by_numpy(name: str, seed: int) -> None:
    make, _ = MEASURES[name]
    q = bent(seed)
    for columns, frame, factors in (
        ("arm", None, np.repeat([1.0, 0.0], [6, 3])),
        (WEIGHTS, None, WEIGHTS),
        ("whole_body", "wrist_2", np.ones(9)),
    ):
        sigma = np.linalg.svd(ROBOT.jacobian(q, of=frame) * factors, compute_uv=False)
        M, kappa = sigma.prod(), sigma[0] / sigma[-1]
        expected = {"Manipulability": M, "ConditionNumber": kappa}.get(name, np.sqrt(kappa / M))
        term = make(jacobian=columns, frame=frame)
        assert_close(value(term, ROBOT, q), [expected], 1e-9 * expected)


@pytest.mark.parametrize("name", MEASURES)
@pytest.mark.parametrize("columns", ["whole_body", "arm", WEIGHTS], ids=["whole", "arm", "weights"])
def test_derivatives_of_measures(name: str, columns) -> None:
    make, _ = MEASURES[name]
    for seed in range(10):
        assert_derivatives(make(jacobian=columns), ROBOT, bent(seed), step=3e-4, rtol=1e-7)


def test_of_an_arm_alone_the_whole_body_is_the_arm() -> None:
    q = SEED[:6]
    assert value(terms.Dexterity(jacobian="arm"), ARM, q) == value(terms.Dexterity(), ARM, q)


def test_where_the_rank_is_lost() -> None:
    straight = np.zeros(6)
    for make in (terms.ConditionNumber, terms.Dexterity):
        with pytest.raises(ValueError, match=r"^q: got a configuration without .*, expected"):
            make().evaluate(ARM, straight)
        with pytest.raises(ValueError, match=r"^q: got a configuration without .*, expected"):
            make().hessian(ARM, straight)
    M, J = terms.Manipulability().evaluate(ARM, straight)
    assert M[0] == 0.0
    assert not J.any()
    assert not terms.Manipulability().hessian(ARM, straight).any()


# Joints


@given(seed=seeds)
def test_seed_distance(seed: int) -> None:
    rng = np.random.default_rng(seed)
    q, center = rng.normal(size=(2, 9))
    weights = rng.uniform(0, 2, 9)
    for robot in (ROBOT, None):
        term = terms.SeedDistance(center, weights)
        assert_close(value(term, robot, q), [weights @ (q - center) ** 2], 1e-13)
        assert_close(
            value(terms.SeedDistance(center, 2.0), robot, q), [2 * np.sum((q - center) ** 2)], 1e-13
        )
        assert_derivatives(term, robot, q)
    long = rng.normal(size=(2, 50))  # more variables than a robot may have
    assert_close(
        value(terms.SeedDistance(long[0]), None, long[1]), [np.sum((long[0] - long[1]) ** 2)], 1e-12
    )


def test_seed_distance_goes_the_shorter_way_round() -> None:
    arm = tk.Chain.from_dh([tk.DH(joint="continuous"), tk.DH(a=1.0, joint="revolute")])
    term = terms.SeedDistance([3.0, 3.0])
    q = np.array([-3.0, -3.0])
    assert_close(value(term, arm, q), [(2 * np.pi - 6) ** 2 + 36], 1e-12)
    assert_derivatives(term, arm, q)
    assert value(term, None, q) == 72.0


@given(case=cases())
def test_joint_centering(case: Case) -> None:
    robot = case.chain
    expected = 0.0
    for x, low, high in zip(case.q, robot.lower, robot.upper, strict=True):
        if np.isfinite(high - low):
            expected += ((x - (low + high) / 2) / (high - low)) ** 2
    assert_close(value(terms.JointCentering(), robot, case.q), [expected], 1e-14)
    assert_derivatives(terms.JointCentering(), robot, case.q)


# In a problem


def around(obstacles: list, q: np.ndarray, T: np.ndarray) -> tk.SqpResult:
    """The pose T nearest to q, two centimeters clear of the obstacles."""
    problem = tk.Problem(ROBOT)
    problem.minimize(terms.SeedDistance(q))
    problem.equal(terms.Pose(T))
    problem.at_least(terms.Clearance(SHAPE, obstacles), 0.02)
    return tk.sqp(problem, q)


@pytest.mark.parametrize("kind", ["sphere", "capsule", "box", "ceiling", "disc"])
def test_the_robot_gives_way_to_an_obstacle_in_its_elbow(kind: str) -> None:
    T = ROBOT.fk(SEED)
    elbow = SHAPE.centers(ROBOT, SEED)[[frame for frame, _, _ in SHAPE.spheres].index("forearm")]
    obstacle = {
        "sphere": tk.Sphere(np.add(elbow, (0.0, 0.1, 0.05)), 0.1),
        "capsule": tk.Capsule(elbow - (0.0, 0.0, 2.0), elbow, 0.05),
        "box": tk.Box(size=(0.2, 0.3, 0.2), center=elbow, rpy=(0.1, 0.2, 0.3)),
        "ceiling": tk.HalfSpace((0.0, 0.0, -1.0), point=np.add(elbow, (0.0, 0.0, 0.04))),
        "disc": tk.Disc(np.add(SEED[6:8], (0.1, 0.05)), 0.2),
    }[kind]
    is_disc = isinstance(obstacle, tk.Disc)

    def clearance(q: np.ndarray) -> float:
        if is_disc:
            return obstacle.signed_distance((*ROBOT.base_pose(q)[:2], 0.0))
        return (obstacle.signed_distance(SHAPE.centers(ROBOT, q)) - 0.08).min()

    assert clearance(SEED) < 0.0
    result = around([obstacle], SEED, T)
    assert result.success, result.message
    assert clearance(result.x) == pytest.approx(0.02, abs=1e-6)  # it goes no further than it must
    assert np.abs(tk.pose_error(ROBOT.fk(result.x), T)).max() < 1e-6


# All of them

ALL = [
    terms.Pose(np.eye(4)),
    terms.Position((1, 2, 3), frame="forearm", point=(0.1, 0, 0)),
    terms.Orientation(np.eye(3)),
    terms.OrientationCone((0, 0, 1), (1, 0, 0)),
    terms.BaseDistance((0.6, 0.0)),
    terms.BasePosition((0.6, 0.0)),
    terms.Clearance(SHAPE, OBSTACLES),
    terms.Manipulability(jacobian="arm"),
    terms.ConditionNumber(jacobian=WEIGHTS, frame="wrist_2"),
    terms.Dexterity(),
    terms.SeedDistance(SEED),
    terms.JointCentering(),
]


def test_they_are_all_here() -> None:
    public = {name for name in terms.__all__ if name not in ("Term", "Function")}
    assert {type(term).__name__ for term in ALL} == public


@pytest.mark.parametrize("term", ALL, ids=lambda t: t.name)
def test_a_batch_is_row_by_row(term: terms.Term) -> None:
    q = np.stack([bent(seed) for seed in range(4)])
    numbers, J = term.evaluate(ROBOT, q)
    m = numbers.shape[1]
    assert J.shape == (4, m, 9)
    H = term.hessian(ROBOT, q)
    assert H.shape == (4, 9, 9)
    for i, row in enumerate(q):
        one, of_one = term.evaluate(ROBOT, row)
        assert np.array_equal(one, numbers[i])
        assert np.array_equal(of_one, J[i])
        assert np.array_equal(term.hessian(ROBOT, row), H[i])
        by_parts = sum(term.hessian(ROBOT, row, e) for e in np.eye(m))
        assert_close(by_parts, H[i], 1e-11 * (1 + np.abs(H[i]).max()))


@pytest.mark.parametrize("term", ALL, ids=lambda t: t.name)
def test_what_they_say_of_themselves(term: terms.Term) -> None:
    assert isinstance(term, terms.Term)
    assert repr(term).startswith(f"{type(term).__name__}(")
    snake = "".join(f"_{c.lower()}" if c.isupper() else c for c in type(term).__name__)
    assert term.name == snake[1:]
    if not isinstance(term, terms.SeedDistance):
        with pytest.raises(ValueError, match=r"^robot: got none, expected"):
            term.evaluate(None, SEED)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: terms.Pose(2 * np.eye(4)), "target: got"),
        (lambda: terms.Orientation(2 * np.eye(3)), "target: got"),
        (lambda: terms.Position((0, 0)), "target: got shape"),
        (lambda: terms.Position((0, 0, 0), point=(0, 0, np.inf)), "point: got inf"),
        (lambda: terms.OrientationCone((0, 0, 0), (0, 0, 1)), "axis: got no direction"),
        (lambda: terms.OrientationCone((0, 0, 1), (0, 0, 0)), "direction: got no direction"),
        (lambda: terms.BaseDistance((0, 0, 0)), "center: got shape"),
        (lambda: terms.BaseDistance((0, 0)).evaluate(ARM, SEED[:6]), "robot: got 'ur10' without"),
        (lambda: terms.BasePosition((0, 0)).evaluate(ARM, SEED[:6]), "robot: got 'ur10' without"),
        (lambda: terms.Clearance(obstacles=OBSTACLES), r"spheres: got none, with obstacles\[1\]"),
        (lambda: terms.Clearance(SHAPE, [1]), r"obstacles\[0\]: got int"),
        (lambda: terms.Clearance(SHAPE, OBSTACLES[0]), "obstacles: got Disc"),
        (
            lambda: terms.Clearance(ON_BASE).evaluate(ARM, SEED[:6]),
            r"spheres\[0\].frame: got 'base'",
        ),
        (lambda: terms.Clearance(obstacles=OBSTACLES[:1]).rows(ARM), r"obstacles\[0\]: got a Disc"),
        (lambda: terms.Dexterity(jacobian="body"), "jacobian: got 'body'"),
        (lambda: terms.Dexterity(jacobian=-WEIGHTS), "jacobian: got -1"),
        (lambda: terms.Dexterity(jacobian=WEIGHTS).evaluate(ARM, SEED[:6]), "jacobian: got 9"),
        (lambda: terms.Dexterity(jacobian=np.eye(9)[0]).evaluate(ROBOT, SEED), "jacobian: got 1"),
        (lambda: terms.Dexterity().evaluate(tk.Chain.from_dh(PLANAR), np.zeros(3)), "robot: got"),
        (lambda: terms.Dexterity(frame="no").evaluate(ROBOT, SEED), "frame: got 'no'"),
        (lambda: terms.SeedDistance(SEED).evaluate(ARM, SEED[:6]), "seed: got 9"),
        (lambda: terms.SeedDistance(SEED, [1.0]), "weights: got 1"),
        (lambda: terms.SeedDistance(SEED, -1.0), "weights: got a negative"),
        (lambda: terms.SeedDistance(SEED, [[1.0], [1.0, 2.0]]), "weights: got"),
        (lambda: terms.Pose(np.eye(4)).evaluate(ROBOT, SEED[:6]), "q: got shape"),
        (lambda: terms.Pose(np.eye(4)).evaluate("thing", SEED), "robot: got str"),
        (lambda: terms.Pose(np.eye(4)).hessian(ROBOT, SEED, np.ones(5)), "weights: got shape"),
    ],
)
def test_what_does_not_fit(call, said: str) -> None:
    with pytest.raises(ValueError, match=f"^{said}.*, expected"):
        call()


def test_what_they_are_made_of() -> None:
    T = tk.transform(xyz=(1, 2, 3), rpy=(0.1, 0.2, 0.3))
    assert np.array_equal(terms.Pose(T).target, T)
    assert terms.Pose(T).frame is None
    assert np.array_equal(terms.Orientation(T[:3, :3], frame="tool").target, T[:3, :3])
    assert terms.Orientation(T[:3, :3], frame="tool").frame == "tool"
    position = terms.Position((1, 2, 3), frame="forearm", point=(4, 5, 6))
    assert position.target.tolist() == [1, 2, 3]
    assert position.point.tolist() == [4, 5, 6]
    cone = terms.OrientationCone((0, 3, 4), (0, 0, -2))
    np.testing.assert_allclose(cone.axis, (0, 0.6, 0.8), atol=1e-16)
    assert cone.direction.tolist() == [0, 0, -1]
    assert terms.BaseDistance((1, 2)).center.tolist() == [1, 2]
    assert terms.BasePosition((1, 2)).target.tolist() == [1, 2]
    assert terms.Dexterity().jacobian == "whole_body"
    assert terms.Dexterity(jacobian="arm").jacobian == "arm"
    assert terms.Dexterity(jacobian=WEIGHTS, frame="tool").jacobian == tuple(WEIGHTS)
    seed = terms.SeedDistance([1, 2], weights=3.0)
    assert seed.seed.tolist() == [1, 2]
    assert seed.weights.tolist() == [3, 3]
    with pytest.raises(ValueError, match="read-only"):
        seed.seed[0] = 0.0
