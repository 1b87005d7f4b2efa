"""The laws that SO(3) and SE(3) share, run over both, degenerate rotations among the examples."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from scipy.linalg import expm

import thing_kin as tk
from oracles import assert_close, derivative, hat, vee
from strategies import poses, rotation_vectors, rotations, twists


@dataclass(frozen=True)
class Group:
    """A Lie group, its vectors (angles at most as given), their matrices and its adjoint."""

    name: str
    vectors: Callable[..., st.SearchStrategy]
    elements: Callable[[], st.SearchStrategy]
    matrix: Callable  # of a vector, in the Lie algebra
    ad: Callable  # of a vector: its bracket with another
    Ad: Callable  # of an element

    def __getattr__(self, operation: str) -> Callable:
        """exp, log, left_jacobian ... of this group, from thing_kin.lie."""
        return getattr(tk.lie, f"{self.name}_{operation}")


def twist_matrix(xi):
    matrix = np.zeros((4, 4))
    matrix[:3, :3], matrix[:3, 3] = hat(xi[3:]), xi[:3]
    return matrix


def twist_bracket(xi):
    v, w = hat(xi[:3]), hat(xi[3:])
    return np.block([[w, v], [np.zeros((3, 3)), w]])


SO3 = Group("so3", rotation_vectors, rotations, hat, hat, lambda R: R)
SE3 = Group("se3", twists, poses, twist_matrix, twist_bracket, tk.lie.se3_adjoint)

groups = pytest.mark.parametrize("group", [SO3, SE3], ids=lambda group: group.name)
# Below pi by what rounding may take: at pi log has two right answers (test_so3.py).
BELOW_PI = np.pi - 1e-9
ATOL = 1e-13  # translations of up to ten metres


@groups
@given(data=st.data())
def test_exp_is_the_matrix_exponential(group: Group, data: st.DataObject):
    x = data.draw(group.vectors(max_angle=7.0))
    assert_close(group.exp(x), expm(group.matrix(x)), ATOL)


@groups
@given(data=st.data())
def test_log_undoes_exp(group: Group, data: st.DataObject):
    x = data.draw(group.vectors(max_angle=BELOW_PI))
    assert_close(group.log(group.exp(x)), x, ATOL)


@groups
@given(data=st.data())
def test_exp_undoes_log_even_at_pi(group: Group, data: st.DataObject):
    X = data.draw(group.elements())
    assert_close(group.exp(group.log(X)), X, ATOL)
    assert np.linalg.norm(group.log(X)[-3:]) <= np.pi + 1e-15  # two units in its last place


@groups
@given(data=st.data())
def test_the_inverse_has_the_opposite_vector(group: Group, data: st.DataObject):
    x = data.draw(group.vectors())
    assert_close(group.exp(x) @ group.exp(-x), np.eye(len(group.exp(x))), ATOL)


@groups
@given(data=st.data(), s=st.floats(-1.0, 1.0), t=st.floats(-1.0, 1.0))
def test_multiples_of_one_vector_add(group: Group, data: st.DataObject, s: float, t: float):
    x = data.draw(group.vectors())
    assert_close(group.exp(s * x) @ group.exp(t * x), group.exp((s + t) * x), ATOL)


@groups
@given(data=st.data())
def test_the_adjoint_carries_a_vector_through_an_element(group: Group, data: st.DataObject):
    X, x = data.draw(group.elements()), data.draw(group.vectors())
    carried = X @ group.exp(x) @ np.linalg.inv(X)
    assert_close(carried, group.exp(group.Ad(X) @ x), ATOL)
    Y = data.draw(group.elements())
    assert_close(group.Ad(X @ Y), group.Ad(X) @ group.Ad(Y), ATOL)


@groups
@given(data=st.data())
def test_the_left_jacobian_is_the_slope_of_exp(group: Group, data: st.DataObject):
    x = data.draw(group.vectors(max_angle=7.0))
    slopes = np.moveaxis(derivative(group.exp, x), -1, 0)
    inverse = np.linalg.inv(group.exp(x))
    left = np.stack([vee(slope @ inverse) for slope in slopes], axis=-1)
    right = np.stack([vee(inverse @ slope) for slope in slopes], axis=-1)
    assert_close(group.left_jacobian(x), left, atol=1e-10)
    assert_close(group.right_jacobian(x), right, atol=1e-10)


@groups
@given(data=st.data())
def test_the_left_jacobian_is_the_integral_of_the_adjoint(group: Group, data: st.DataObject):
    """J_l = int_0^1 exp(s ad) ds, a block of one matrix exponential: no formula is shared."""
    x = data.draw(group.vectors(max_angle=7.0))
    n = len(x)
    blocks = np.zeros((2 * n, 2 * n))
    blocks[:n, :n], blocks[:n, n:] = group.ad(x), np.eye(n)
    assert_close(group.left_jacobian(x), expm(blocks)[:n, n:], ATOL)


@groups
@given(data=st.data())
def test_left_and_right_jacobians_are_related(group: Group, data: st.DataObject):
    x = data.draw(group.vectors(max_angle=7.0))
    assert_array_equal(group.right_jacobian(x), group.left_jacobian(-x))
    assert_close(group.left_jacobian(x), group.Ad(group.exp(x)) @ group.right_jacobian(x), ATOL)


@groups
@given(data=st.data())
def test_the_inverses_are_inverses(group: Group, data: st.DataObject):
    x = data.draw(group.vectors(max_angle=5.0))  # at 2 pi there is none
    for side in ("left", "right"):
        J = getattr(group, f"{side}_jacobian")(x)
        inverse = getattr(group, f"{side}_jacobian_inverse")(x)
        assert_close(inverse @ J, np.eye(len(x)), ATOL)
        assert_close(J @ inverse, np.eye(len(x)), ATOL)


@groups
@pytest.mark.parametrize("turns", [1, -1, 2])
def test_at_whole_turns_there_is_no_inverse(group: Group, turns: int):
    x = np.append(np.zeros(3 if group is SE3 else 0), [0.0, 0.0, 2 * np.pi * turns])
    for inverse in (group.left_jacobian_inverse, group.right_jacobian_inverse):
        with pytest.raises(ValueError, match=r"^(phi|xi): got a rotation by a whole number"):
            inverse(x)
        assert np.all(np.isfinite(inverse(0.999 * x)))


@groups
def test_a_batch_is_a_loop(group: Group):
    rng = np.random.default_rng(1)
    x = rng.uniform(-1.5, 1.5, (6, 6 if group is SE3 else 3))
    x[0] = 0.0
    of_vectors = [group.exp, group.left_jacobian, group.right_jacobian]
    of_vectors += [group.left_jacobian_inverse, group.right_jacobian_inverse]
    for function, argument in [(group.log, group.exp(x)), *((f, x) for f in of_vectors)]:
        assert_array_equal(function(argument), np.stack([function(a) for a in argument]))
        assert function(argument[:0]).shape == (0, *function(argument[0]).shape)
