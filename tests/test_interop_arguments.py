"""Poses and rotations of other libraries go in wherever a (4, 4) or (3, 3) matrix does."""

import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial.transform import Rotation

import thing_kin as tk
from peer_types import POSES, ROTATIONS, SEVERAL_POSES, SEVERAL_ROTATIONS, Peer, params
from public_arrays import ARGUMENTS, FILTERS, Argument
from test_import import foreign, modules_after

FILTER_LABELS = {argument.label for argument in FILTERS}


def of_shape(*shape: int) -> list[Argument]:
    return [
        argument
        for argument in ARGUMENTS
        if np.shape(argument.good) == shape
        and argument.label
        not in FILTER_LABELS  # theirs are states, covariances and matrices of any size
        and not argument.name.endswith(("covariance", "noise"))
    ]


TAKE_POSES, TAKE_ROTATIONS = of_shape(4, 4), of_shape(3, 3)
TAKE_VECTORS = [
    argument
    for argument in ARGUMENTS
    # (4, 4) is a batch of four of these.
    if np.ndim(argument.good) == 1 and np.shape(argument.good) != (4,)
]
# Both or neither; everything else is one pose or rotation.
TAKE_SEVERAL = {"se3_log", "se3_adjoint", "pose_error", "pose_error body"} | {
    "so3_log",
    "quaternion_from_rotation",
    "rpy_from_rotation",
    "from_pose",
    "quaternion",
    "ik",
    "ik orientation",
    "kdl.ik",
}

by_label = {"ids": lambda argument: f"{argument.label}-{argument.name}"}


def test_the_arguments_are_found() -> None:
    """So that an empty list can't pass."""
    poses = {(argument.label, argument.name) for argument in TAKE_POSES}
    assert {
        ("se3_log", "T"),
        ("se3_adjoint", "T"),
        ("pose_error", "T"),
        ("pose_error", "T_goal"),
        ("with_tool", "tool"),
        ("on_omni_base", "mount"),
        ("pioneer", "mount"),
        ("step", "targets[0]"),
    } <= poses
    rotations = {(argument.label, argument.name) for argument in TAKE_ROTATIONS}
    assert {("so3_log", "R"), ("rpy_from_rotation", "R"), ("step", "targets[3]")} <= rotations
    assert {argument.name for argument in TAKE_VECTORS} >= {"q", "qd", "xyz", "targets[2]"}


@pytest.mark.parametrize("argument", TAKE_POSES, **by_label)
@pytest.mark.parametrize("peer", params(POSES))
def test_a_pose(peer: Peer, argument: Argument) -> None:
    thing = peer.make(argument.good)
    same = argument.call(np.array(peer.array(thing)))
    np.testing.assert_array_equal(argument.call(thing), same)


@pytest.mark.parametrize("argument", TAKE_ROTATIONS, **by_label)
@pytest.mark.parametrize("peer", params(ROTATIONS))
def test_a_rotation(peer: Peer, argument: Argument) -> None:
    thing = peer.make(argument.good)
    same = argument.call(np.array(peer.array(thing)))
    np.testing.assert_array_equal(argument.call(thing), same)


def turned(argument: Argument) -> np.ndarray:
    """Two different ones: the good value, and half a turn about z on top of it."""
    half = np.diag([-1.0, -1.0, 1.0, 1.0][: len(argument.good)])
    return np.stack([argument.good, argument.good @ half])


def assert_several(peer: Peer, argument: Argument) -> None:
    thing = peer.make(turned(argument))
    if argument.label not in TAKE_SEVERAL:
        with pytest.raises(ValueError, match=r": got shape \(2, .*, expected ") as error:
            argument.call(thing)
        assert str(error.value).startswith(argument.names)
        return
    result = argument.call(thing)
    assert len(result) == 2
    np.testing.assert_array_equal(result, argument.call(np.array(peer.array(thing))))


@pytest.mark.parametrize("argument", TAKE_POSES, **by_label)
@pytest.mark.parametrize("peer", params(SEVERAL_POSES))
def test_several_poses(peer: Peer, argument: Argument) -> None:
    assert_several(peer, argument)


@pytest.mark.parametrize("argument", TAKE_ROTATIONS, **by_label)
@pytest.mark.parametrize("peer", params(SEVERAL_ROTATIONS))
def test_several_rotations(peer: Peer, argument: Argument) -> None:
    assert_several(peer, argument)


def assert_refused(argument: Argument, thing: object) -> None:
    with pytest.raises(ValueError, match=r": got .*, expected ") as error:
        argument.call(thing)
    assert str(error.value).startswith(argument.names)


R = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
T = np.block([[R, np.ones((3, 1))], [np.zeros((1, 3)), 1.0]])


@pytest.mark.parametrize("argument", TAKE_POSES, **by_label)
@pytest.mark.parametrize("peer", params(ROTATIONS))
def test_a_rotation_is_no_pose(peer: Peer, argument: Argument) -> None:
    assert_refused(argument, peer.make(R))


@pytest.mark.parametrize("argument", TAKE_ROTATIONS, **by_label)
@pytest.mark.parametrize("peer", params(POSES))
def test_a_pose_is_no_rotation(peer: Peer, argument: Argument) -> None:
    if argument.label == "quaternion":
        pytest.skip("takes either")
    assert_refused(argument, peer.make(T))


@pytest.mark.parametrize("argument", TAKE_VECTORS, **by_label)
@pytest.mark.parametrize("peer", params(POSES))
def test_a_pose_is_no_vector(peer: Peer, argument: Argument) -> None:
    assert_refused(argument, peer.make(T))


@pytest.mark.parametrize("argument", TAKE_POSES, **by_label)
def test_a_pose_that_is_none(argument: Argument) -> None:
    """Pinocchio itself takes any matrix."""
    assert_refused(argument, pin.SE3(T + np.diag([1e-3, 0, 0, 0])))
    assert_refused(argument, pin.SE3(T * [[1, 1, 1, np.nan]] * 3 + [[1, 1, 1, 1]]))


@pytest.mark.parametrize("argument", TAKE_ROTATIONS, **by_label)
def test_a_quaternion_that_is_no_rotation(argument: Argument) -> None:
    assert_refused(argument, pin.Quaternion(0.5, 0.5, 0.5, 0.4))
    assert_refused(argument, pin.Quaternion(np.nan, 0.0, 0.0, 1.0))


def test_knowing_them_imports_nothing() -> None:
    """By duck typing: a thing that offers as_matrix is taken at its word."""
    use = (
        "import thing_kin as tk, numpy\n"
        "class Pose:\n"
        "    def as_matrix(self): return numpy.eye(4)\n"
        "tk.lie.se3_log(Pose())"
    )
    assert foreign(modules_after(use)) == foreign(modules_after("import thing_kin, numpy"))


def test_a_quaternion_of_zeros_is_no_rotation() -> None:
    with pytest.raises(ValueError, match=r"^R: got "):
        tk.lie.so3_log(pin.Quaternion(0.0, 0.0, 0.0, 0.0))


def test_a_rotation_is_no_batch_of_vectors() -> None:
    with pytest.raises(ValueError, match=r"^phi: got "):
        tk.lie.so3_exp(Rotation.identity())
