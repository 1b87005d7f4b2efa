"""The laws that SO(3), SE(2) and SE(3) share, degenerate rotations among the examples."""

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
from strategies import (
    planar_poses,
    planar_twists,
    poses,
    rotation_vectors,
    rotations,
    twists,
)


@dataclass(frozen=True)
class Group:
    """A Lie group, its vectors (angles at most as given), their matrices and its adjoint."""

    name: str
    vectors: Callable[..., st.SearchStrategy]
    elements: Callable[[], st.SearchStrategy]
    matrix: Callable  # of a vector, in the Lie algebra
    ad: Callable  # of a vector: its bracket with another
    Ad: Callable  # of an element
    vee: Callable = vee  # the vector of a velocity in the Lie algebra
    read: Callable = lambda X: X  # of what the library takes for an element: its matrix
    write: Callable = lambda X: X  # and back

    def exp(self, x):
        return self.read(getattr(tk.lie, f"{self.name}_exp")(x))

    def log(self, X):
        return getattr(tk.lie, f"{self.name}_log")(self.write(X))

    @property
    def size(self) -> int:
        """How many numbers a vector has."""
        return 6 if self.name == "se3" else 3

    def __getattr__(self, operation: str) -> Callable:
        """left_jacobian, right_jacobian ... of this group, from thing_kin.lie."""
        return getattr(tk.lie, f"{self.name}_{operation}")


def twist_matrix(xi):
    matrix = np.zeros((4, 4))
    matrix[:3, :3], matrix[:3, 3] = hat(xi[3:]), xi[:3]
    return matrix


def twist_bracket(xi):
    v, w = hat(xi[:3]), hat(xi[3:])
    return np.block([[w, v], [np.zeros((3, 3)), w]])


def planar_matrix(pose):
    """(3, 3) of (x, y, theta), or several."""
    x, y, theta = np.moveaxis(np.asarray(pose), -1, 0)
    c, s, zero = np.cos(theta), np.sin(theta), np.zeros_like(theta)
    rows = [[c, -s, x], [s, c, y], [zero, zero, zero + 1.0]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def planar_pose(X):
    theta = np.arctan2(X[..., 1, 0] - X[..., 0, 1], X[..., 0, 0] + X[..., 1, 1])
    return np.stack([X[..., 0, 2], X[..., 1, 2], theta], axis=-1)


def planar_velocity(xi):
    return np.array([[0.0, -xi[2], xi[0]], [xi[2], 0.0, xi[1]], [0.0, 0.0, 0.0]])


def planar_vee(S):
    return np.array([S[0, 2], S[1, 2], (S[1, 0] - S[0, 1]) / 2])


def planar_bracket(xi):
    return np.array([[0.0, -xi[2], xi[1]], [xi[2], 0.0, -xi[0]], [0.0, 0.0, 0.0]])


SO3 = Group("so3", rotation_vectors, rotations, hat, hat, lambda R: R)
SE3 = Group("se3", twists, poses, twist_matrix, twist_bracket, tk.lie.se3_adjoint)

SE2 = Group(
    "se2",
    planar_twists,
    lambda: planar_poses().map(planar_matrix),
    planar_velocity,
    planar_bracket,
    lambda X: tk.lie.se2_adjoint(planar_pose(X)),
    planar_vee,
    planar_matrix,
    planar_pose,
)

groups = pytest.mark.parametrize("group", [SO3, SE2, SE3], ids=lambda group: group.name)
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
    turn = group.log(X)[2:] if group is SE2 else group.log(X)[-3:]
    assert np.linalg.norm(turn) <= np.pi + 1e-15  # two units in its last place


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
    left = np.stack([group.vee(slope @ inverse) for slope in slopes], axis=-1)
    right = np.stack([group.vee(inverse @ slope) for slope in slopes], axis=-1)
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
    x = np.append(np.zeros(group.size - 1), 2 * np.pi * turns)
    for inverse in (group.left_jacobian_inverse, group.right_jacobian_inverse):
        with pytest.raises(ValueError, match=r"^(phi|xi): got a rotation by a whole number"):
            inverse(x)
        assert np.all(np.isfinite(inverse(0.999 * x)))


@given(planar_poses(), planar_poses())
def test_planar_poses_compose_as_their_matrices(a, b):
    A, B = planar_matrix(a), planar_matrix(b)
    assert_close(planar_matrix(tk.lie.se2_compose(a, b)), A @ B, ATOL)
    assert_close(planar_matrix(tk.lie.se2_inverse(a)), np.linalg.inv(A), ATOL)
    assert_close(planar_matrix(tk.lie.se2_between(a, b)), np.linalg.inv(A) @ B, ATOL)
    for pose in (tk.lie.se2_compose(a, b), tk.lie.se2_inverse(a), tk.lie.se2_between(a, b)):
        assert -np.pi < pose[2] <= np.pi


def test_several_planar_poses_are_a_loop():
    rng = np.random.default_rng(2)
    a, b = rng.normal(size=(5, 3)), rng.normal(size=(5, 3))
    for function in (tk.lie.se2_compose, tk.lie.se2_between):
        together = [function(x, y) for x, y in zip(a, b, strict=True)]
        assert_array_equal(function(a, b), together)
        assert_array_equal(function(a[0], b), [function(a[0], y) for y in b])
        with pytest.raises(ValueError, match=r"^b: got 4 poses, expected 5"):
            function(a, b[:4])
    assert_array_equal(tk.lie.se2_inverse(a), [tk.lie.se2_inverse(x) for x in a])


@groups
def test_a_batch_is_a_loop(group: Group):
    rng = np.random.default_rng(1)
    x = rng.uniform(-1.5, 1.5, (6, group.size))
    x[0] = 0.0
    of_vectors = [group.exp, group.left_jacobian, group.right_jacobian]
    of_vectors += [group.left_jacobian_inverse, group.right_jacobian_inverse]
    for function, argument in [(group.log, group.exp(x)), *((f, x) for f in of_vectors)]:
        assert_array_equal(function(argument), np.stack([function(a) for a in argument]))
        assert function(argument[:0]).shape == (0, *function(argument[0]).shape)
