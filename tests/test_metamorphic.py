"""Move the world, move the tool, reorder the joints, change the unit of length."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

import thing_kin as tk
from oracles import assert_close, dh_matrix
from strategies import Case, cases, dh_rows, poses

ATOL = 1e-11  # products of two lengths of up to 40 m, twelve roundings


def block_rotation(T):
    return np.kron(np.eye(2), T[:3, :3])


@given(case=cases(), world=dh_rows(st.just("fixed")))
def test_moving_the_world_turns_jacobian_and_hessian(case: Case, world: tk.DH):
    moved, q = tk.Chain.from_dh([world, *case.rows]), case.q
    W = dh_matrix(world.d, world.theta, world.a, world.alpha)
    assert_close(moved.fk(q), W @ case.chain.fk(q), ATOL)
    for frame, turn in {
        "world_aligned": block_rotation(W),
        "body": np.eye(6),
        "world": tk.lie.se3_adjoint(W),
    }.items():
        assert_close(moved.jacobian(q, frame), turn @ case.chain.jacobian(q, frame), ATOL)
        expected = np.einsum("ab,bik->aik", turn, case.chain.hessian(q, frame))
        assert_close(moved.hessian(q, frame), expected, ATOL)


@pytest.mark.parametrize("seed", range(10))
def test_moving_the_world_changes_no_measure(seed: int):
    rng = np.random.default_rng(seed)
    rows = [tk.DH(*rng.uniform(-1, 1, 4), joint="revolute") for _ in range(7)]
    world = tk.DH(*rng.uniform(-1, 1, 4))
    chain, moved = tk.Chain.from_dh(rows), tk.Chain.from_dh([world, *rows])
    q = chain.random(rng=rng)
    rtol = 1e-14 * chain.condition_number(q)  # a singular value's relative rounding error
    for measure in ("manipulability", "condition_number", "dexterity"):
        assert_allclose(getattr(moved, measure)(q), getattr(chain, measure)(q), rtol)
        gradient = getattr(chain, f"{measure}_gradient")(q)
        size = np.abs(gradient).max() * chain.condition_number(q)
        moved_gradient = getattr(moved, f"{measure}_gradient")(q)
        assert_allclose(moved_gradient, gradient, rtol=0, atol=rtol * size)


@given(case=cases(), tool=poses())
def test_a_tool_moves_the_point_and_keeps_the_turning(case: Case, tool):
    tooled, q = case.chain.with_tool(tool), case.q
    assert_close(tooled.fk(q), case.chain.fk(q) @ tool, ATOL)
    inverse = tk.lie.se3_adjoint(np.linalg.inv(tool))
    assert_close(tooled.jacobian(q, "body"), inverse @ case.chain.jacobian(q, "body"), ATOL)
    assert_close(tooled.jacobian(q, "world"), case.chain.jacobian(q, "world"), ATOL)
    assert_close(tooled.jacobian(q)[3:], case.chain.jacobian(q)[3:], ATOL)
    assert_array_equal(tooled.jacobian(q, of="flange"), case.chain.jacobian(q))


def scaled(row: tk.DH, factor: float) -> tk.DH:
    return tk.DH(factor * row.d, row.theta, factor * row.a, row.alpha, row.joint)


@given(case=cases(), factor=st.sampled_from([0.5, 2.0, 1024.0]))  # powers of two: exact
def test_the_unit_of_length_scales_what_is_a_length(case: Case, factor: float):
    chain = tk.Chain.from_dh([scaled(row, factor) for row in case.rows])
    turns = np.array([joint != "prismatic" for joint in chain.joint_types])
    q = np.where(turns, case.q, factor * case.q)
    T, J = case.chain.fk(case.q), case.chain.jacobian(case.q)
    T[:3, 3] *= factor
    J[:3, turns] *= factor
    assert_close(chain.fk(q), T, atol=1e-300)  # exact but for underflow
    assert_close(chain.jacobian(q), J, atol=1e-300)


def test_the_order_of_joints_permutes_the_columns():
    arm_first, base_first = tk.robots.thing(), tk.robots.thing(order="base_first")
    to_base_first = [arm_first.names.index(name) for name in base_first.names]
    assert to_base_first == [6, 7, 8, 0, 1, 2, 3, 4, 5]
    for q in arm_first.random(20, rng=3):
        p = q[to_base_first]
        assert_array_equal(base_first.fk_all(p), arm_first.fk_all(q))
        for frame in ("world_aligned", "body", "world"):
            J, H = arm_first.jacobian(q, frame), arm_first.hessian(q, frame)
            assert_array_equal(base_first.jacobian(p, frame), J[:, to_base_first])
            expected = H[:, to_base_first][:, :, to_base_first]
            assert_array_equal(base_first.hessian(p, frame), expected)
        gradient = arm_first.manipulability_gradient(q)[to_base_first]
        assert_allclose(base_first.manipulability_gradient(p), gradient, rtol=0, atol=1e-12)


def test_the_place_of_the_base_changes_no_measure():
    """x, y and theta move the world: M and kappa of [M17] (4.30), (4.32) do not see them."""
    robot = tk.robots.thing()
    q = robot.random(rng=5)
    for x, y, theta in ([1, 2, 0.3], [-4, 0, 3.0], [0, -5, -1.5]):
        moved = np.append(q[:6], [x, y, theta])
        assert_allclose(robot.manipulability(moved), robot.manipulability(q), rtol=1e-12)
        assert_allclose(robot.condition_number(moved), robot.condition_number(q), rtol=1e-12)
    for measure in ("manipulability", "condition_number", "dexterity"):
        gradient = getattr(robot, f"{measure}_gradient")(q)
        assert_allclose(gradient[6:], 0.0, atol=1e-12 * np.abs(gradient).max())
