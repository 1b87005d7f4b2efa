"""Velocity, drift and acceleration, classical and spatial: differences, Pinocchio, by hand."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from numpy.testing import assert_array_equal

import thing_kin as tk
from oracles import PinocchioChain, assert_close, time_derivative
from strategies import Case, Motion, cases, motions

FRAMES = ("world_aligned", "body", "world")
KINDS = ("classical", "spatial")
ATOL = 1e-12  # sums of twelve products of rates up to 1 and lengths up to 25 m
ATOL_DIFFERENCES = 1e-9  # see oracles.derivative

frames = pytest.mark.parametrize("frame", FRAMES)
kinds = pytest.mark.parametrize("kind", KINDS)


def place(motion: Motion) -> dict:
    return {"of": motion.case.frame, "point": motion.point}


def path(motion: Motion, t: float):
    """The position of the point while the joints accelerate evenly."""
    q = motion.case.q + t * motion.qd + t**2 / 2 * motion.qdd
    return (motion.case.chain.fk(q, motion.case.frame) @ np.append(motion.point, 1.0))[:3]


@frames
@given(motion=motions())
def test_velocity_is_the_jacobian_times_qd(frame: str, motion: Motion):
    chain, q, at = motion.case.chain, motion.case.q, place(motion)
    v = chain.velocity(q, motion.qd, frame, **at)
    assert_close(v, chain.jacobian(q, frame, **at) @ motion.qd, atol=ATOL)


@given(motions())
def test_velocity_is_that_of_the_position(motion: Motion):
    chain, q = motion.case.chain, motion.case.q
    straight = Motion(motion.case, motion.qd, np.zeros(chain.n), motion.point)
    expected = time_derivative(lambda t: path(straight, t[0]), np.zeros(1), np.ones(1))
    v = chain.velocity(q, motion.qd, **place(motion))
    assert_close(v[:3], expected, atol=ATOL_DIFFERENCES)


@frames
@given(motion=motions())
def test_drift_is_jacobian_dot_times_qd(frame: str, motion: Motion):
    chain, q, at = motion.case.chain, motion.case.q, place(motion)
    drift = chain.drift(q, motion.qd, frame, **at)
    assert_close(drift, chain.jacobian_dot(q, motion.qd, frame, **at) @ motion.qd, atol=ATOL)


@frames
@given(motion=motions())
def test_with_the_drift_it_is_the_derivative_of_the_velocity(frame: str, motion: Motion):
    """Of these numbers: classical in axes of the world, spatial in the other two."""
    chain, q, qd, qdd, at = (
        motion.case.chain, motion.case.q, motion.qd / 2, motion.qdd / 2, place(motion),
    )  # fmt: skip
    n = chain.n
    expected = time_derivative(
        lambda x: chain.velocity(x[:n], x[n:], frame, **at),
        np.concatenate([q, qd]),
        np.concatenate([qd, qdd]),
    )
    rate = chain.jacobian(q, frame, **at) @ qdd + chain.drift(q, qd, frame, **at)
    assert_close(rate, expected, atol=ATOL_DIFFERENCES)
    kind = "classical" if frame == "world_aligned" else "spatial"
    assert_close(chain.acceleration(q, qd, qdd, frame, kind=kind, **at), rate, atol=ATOL)


@given(motions())
def test_classical_is_the_second_derivative_of_the_position(motion: Motion):
    h = 5e-3  # off by A h^4/90 of sums of sines of amplitude A = 25 m, and by eps A/h^2
    weights = np.array([-1, 16, -30, 16, -1]) / (12 * h**2)
    expected = sum(w * path(motion, k * h) for k, w in zip(range(-2, 3), weights, strict=True))
    chain, q, at = motion.case.chain, motion.case.q, place(motion)
    a = chain.acceleration(q, motion.qd, motion.qdd, **at)
    assert_close(a[:3], expected, atol=2e-8)
    R = chain.fk(q, motion.case.frame)[:3, :3]
    body = chain.acceleration(q, motion.qd, motion.qdd, "body", **at)
    assert_close(body, np.kron(np.eye(2), R.T) @ a, atol=ATOL)


@frames
@kinds
@given(motion=motions())
def test_it_is_that_of_pinocchio(frame: str, kind: str, motion: Motion):
    case, pinocchio = motion.case, PinocchioChain(motion.case.rows)
    for of in {case.frame, len(case.rows)}:
        at = pinocchio.add_point(of, motion.point)
        v = case.chain.velocity(case.q, motion.qd, frame, of, motion.point)
        assert_close(v, pinocchio.velocity(case.q, motion.qd, frame, at), atol=ATOL)
        a = case.chain.acceleration(case.q, motion.qd, motion.qdd, frame, of, kind, motion.point)
        expected = pinocchio.acceleration(case.q, motion.qd, motion.qdd, frame, at, kind)
        assert_close(a, expected, atol=ATOL)


@frames
@given(motion=motions())
def test_the_two_kinds_differ_by_omega_cross_v(frame: str, motion: Motion):
    chain, q, at = motion.case.chain, motion.case.q, place(motion)
    classical, spatial = (
        chain.acceleration(q, motion.qd, motion.qdd, frame, kind=kind, **at) for kind in KINDS
    )
    v = chain.velocity(q, motion.qd, frame, **at)
    assert_close((classical - spatial)[:3], np.cross(v[3:], v[:3]), atol=ATOL)
    assert_array_equal(classical[3:], spatial[3:])


@given(motions())
def test_the_spatial_one_is_carried_like_a_twist(motion: Motion):
    case, of = motion.case, motion.case.frame
    world, body = (
        case.chain.acceleration(case.q, motion.qd, motion.qdd, frame, of, "spatial")
        for frame in ("world", "body")
    )
    T = case.chain.fk(case.q, of)
    assert_close(world, tk.lie.se3_adjoint(T) @ body, atol=1e-11)  # products of two lengths


@frames
@given(motion=motions(), case=cases())
def test_what_stands_still(frame: str, motion: Motion, case: Case):
    n, at = case.chain.n, {"of": case.frame, "point": motion.point}
    still = np.zeros(n)
    assert_array_equal(case.chain.velocity(case.q, still, frame, **at), 0.0)
    assert_array_equal(case.chain.drift(case.q, still, frame, **at), 0.0)
    J = case.chain.jacobian(case.q, frame, **at)
    for kind in KINDS:  # from rest there is no difference
        a = case.chain.acceleration(case.q, still, still + 0.1, frame, kind=kind, **at)
        assert_close(a, 0.1 * J.sum(axis=1), atol=ATOL)
        root = case.chain.acceleration(case.q, still + 1, still + 1, frame, of=0, kind=kind)
        assert_array_equal(root, 0.0)


def test_a_wheel_by_hand():
    """A point on its rim, on its axle, and at the world's origin."""
    wheel = tk.Chain.from_dh([tk.DH(a=2.0, joint="revolute")])
    q, qd, qdd = [0.0], [3.0], [0.5]
    assert_array_equal(wheel.acceleration(q, qd, qdd), [-18.0, 1.0, 0, 0, 0, 0.5])
    assert_array_equal(wheel.acceleration(q, qd, qdd, kind="spatial"), [0, 1.0, 0, 0, 0, 0.5])
    hub = {"point": (-2.0, 0.0, 0.0)}
    assert_array_equal(wheel.velocity(q, qd, **hub), [0, 0, 0, 0, 0, 3.0])
    assert_array_equal(wheel.acceleration(q, qd, qdd, **hub), [0, 0, 0, 0, 0, 0.5])
    assert_array_equal(wheel.acceleration(q, qd, qdd, "world"), [0, 0, 0, 0, 0, 0.5])


def test_coriolis_by_hand():
    """A slider that moves out on a turning arm: 2 w x v."""
    arm = tk.Chain.from_dh(
        [tk.DH(alpha=np.pi / 2, joint="revolute"), tk.DH(d=1.0, joint="prismatic")]
    )
    a = arm.acceleration([0.0, 0.5], [2.0, 3.0], [0.0, 0.0])
    # It stands at (0, -1.5, 0) and moves along -y: -w^2 r and 2 w v.
    assert_close(a, [2 * 2.0 * 3.0, 2.0**2 * 1.5, 0, 0, 0, 0], atol=1e-14)


@frames
def test_both_orders_of_the_thing(frame: str):
    arm_first, base_first = tk.robots.thing(), tk.robots.thing(order="base_first")
    to_base_first = [arm_first.names.index(name) for name in base_first.names]
    motion = [arm_first.random(10, rng=i) for i in range(3)]
    turned = [x[:, to_base_first] for x in motion]
    for kind in KINDS:
        expected = arm_first.acceleration(*motion, frame, kind=kind)
        assert_close(base_first.acceleration(*turned, frame, kind=kind), expected, atol=1e-10)
    drift = arm_first.drift(*motion[:2], frame)
    assert_array_equal(base_first.drift(*turned[:2], frame), drift)


@frames
@kinds
def test_batches_are_what_single_calls_give(frame: str, kind: str):
    robot = tk.robots.thing()
    whole = [robot.random(5, rng=i) for i in range(3)]
    for batched in product((True, False), repeat=3):
        arguments = [x if is_batch else x[0] for x, is_batch in zip(whole, batched, strict=True)]
        result = robot.acceleration(*arguments, frame, "wrist_1", kind)
        if not any(batched):
            assert result.shape == (6,)
            continue
        one = [
            robot.acceleration(*items, frame, "wrist_1", kind)
            for items in zip(*np.broadcast_arrays(*map(np.atleast_2d, arguments)), strict=True)
        ]
        assert_array_equal(result, one)
    for method in (robot.velocity, robot.drift):
        one = [method(q, qd, frame) for q, qd in zip(*whole[:2], strict=True)]
        assert_array_equal(method(*whole[:2], frame), one)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"q": np.zeros((1, 2, 9))}, r"^q: got shape \(1, 2, 9\)"),
        ({"qd": np.zeros(1)}, r"^qd: got shape \(1,\), expected \(9,\) or \(N, 9\)"),
        ({"qdd": "fast"}, "^qdd: got"),
        ({"qdd": np.full(9, np.inf)}, "^qdd: got inf"),
        (
            {"q": np.zeros((3, 9)), "qdd": np.zeros((2, 9))},
            "^qdd: got 2 items, expected 3, as .* q",
        ),
        ({"qd": np.zeros((3, 9)), "qdd": np.zeros((0, 9))}, "^qdd: got 0 items, .* as qd"),
        ({"kind": "total"}, "^kind: got 'total', expected 'classical' or 'spatial'"),
        ({"frame": "classical"}, "^frame: got 'classical'"),
        ({"of": 99}, "^of: got"),
        ({"point": 1.0}, r"^point: got shape \(\), expected \(3,\)"),
    ],
)
def test_what_is_wrong_is_named(arguments, message: str):
    good = dict.fromkeys(("q", "qd", "qdd"), np.zeros(9))
    with pytest.raises(ValueError, match=message):
        tk.robots.thing().acceleration(**{**good, **arguments})
