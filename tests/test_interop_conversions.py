"""Conversions there and back, and quaternions against libraries that name their order."""

import sys

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import transform

import thing_kin as tk
from oracles import assert_close
from peer_types import NO_RIGID, NO_SPATIALMATH, POSES, SEVERAL_POSES, Peer, params
from strategies import poses, rotations
from thing_kin import interop

T = tk.transform(xyz=(1, 2, 3), rpy=(0.1, 0.2, 0.3))
TO = {
    "scipy": interop.to_scipy,
    "pinocchio": interop.to_pinocchio_se3,
    "spatialmath": interop.to_spatialmath,
}
ORDERS = ["wxyz", "xyzw"]
# SciPy makes matrices orthogonal, and keeps a quaternion: a few roundings.
ROUNDINGS = 4e-15


@pytest.mark.parametrize("peer", params(POSES))
@given(pose=poses())
def test_a_pose_there_and_back(peer: Peer, pose: np.ndarray) -> None:
    there = TO[peer.name](pose)
    assert type(there) is type(peer.make(pose))
    assert_close(peer.array(there), pose, atol=ROUNDINGS)
    assert_close(interop.from_pose(there), pose, atol=ROUNDINGS)


@pytest.mark.parametrize("peer", params(SEVERAL_POSES))
@given(several=st.lists(poses(), min_size=1, max_size=3))
def test_several_there_and_back(peer: Peer, several: list) -> None:
    there = TO[peer.name](np.array(several))
    assert len(there) == len(several)
    back = interop.from_pose(there)
    # spatialmath knows no batch of one.
    assert_close(np.reshape(back, (-1, 4, 4)), np.array(several), atol=ROUNDINGS)


@given(R=rotations())
def test_a_rotation_there_and_back(R: np.ndarray) -> None:
    assert isinstance(interop.to_scipy(R), transform.Rotation)
    assert_close(interop.to_scipy(R).as_matrix(), R, atol=ROUNDINGS)
    assert_close(interop.to_scipy(np.stack([R, R])).as_matrix(), np.stack([R, R]), atol=ROUNDINGS)


@pytest.mark.skipif(NO_RIGID != "" or NO_SPATIALMATH != "", reason=NO_RIGID + NO_SPATIALMATH)
def test_from_one_to_another() -> None:
    thing = interop.to_scipy(interop.to_spatialmath(interop.to_pinocchio_se3(T)))
    assert_close(thing.as_matrix(), T, atol=ROUNDINGS)


def test_what_comes_back_is_a_copy() -> None:
    pose = T.copy()
    interop.from_pose(pose)[0, 3] = 7.0
    np.testing.assert_array_equal(pose, T)


@given(R=rotations())
def test_quaternions_are_scipy_s_and_pinocchio_s(R: np.ndarray) -> None:
    ours = {order: interop.quaternion(R, order=order) for order in ORDERS}
    scipy = transform.Rotation.from_quat(ours["xyzw"])  # its default
    assert_close(scipy.as_matrix(), R, atol=ROUNDINGS)
    # scalar_first is in SciPy since 1.14: by hand for all.
    assert_close(scipy.as_quat()[[3, 0, 1, 2]], ours["wxyz"], atol=ROUNDINGS)
    pinocchio = pin.Quaternion(*ours["wxyz"])
    assert_close(pinocchio.matrix(), R, atol=ROUNDINGS)
    assert_close(pinocchio.coeffs(), ours["xyzw"], atol=0.0)
    assert ours["wxyz"][0] >= 0.0


@pytest.mark.parametrize("order", ORDERS)
@given(several=st.lists(poses(), min_size=1, max_size=3))
def test_quaternions_there_and_back(order: str, several: list) -> None:
    batch = np.array(several)
    q = interop.quaternion(batch, order=order)
    np.testing.assert_array_equal(q, [interop.quaternion(T, order=order) for T in several])
    assert_close(interop.rotation(-3.0 * q, order=order), batch[:, :3, :3], atol=ROUNDINGS)
    p, same = interop.position_and_quaternion(batch, order=order)
    np.testing.assert_array_equal(same, q)
    assert_close(interop.pose_from_quaternion(p, q, order=order), batch, atol=ROUNDINGS)
    one = interop.pose_from_quaternion(p[0], q[0], order=order)
    assert_close(one, batch[0], atol=ROUNDINGS)


def test_one_goes_with_many() -> None:
    Q = interop.quaternion(np.stack([T, np.eye(4), T]), order="xyzw")
    moved = interop.pose_from_quaternion((1, 2, 3), Q, order="xyzw")
    assert moved.shape == (3, 4, 4)
    assert_close(moved[2], T, atol=ROUNDINGS)
    moved = interop.pose_from_quaternion(np.eye(3)[:2], Q[0], order="xyzw")
    np.testing.assert_array_equal(moved[:, :3, 3], np.eye(3)[:2])
    with pytest.raises(ValueError, match=r"^p: got 2 positions, expected 3, as many"):
        interop.pose_from_quaternion(np.eye(3)[:2], Q, order="xyzw")


@pytest.mark.parametrize("order", ["xyz", "WXYZ", "", None, 4, ["wxyz"]])
def test_an_order_that_is_none(order: object) -> None:
    q = [1.0, 0.0, 0.0, 0.0]
    for call in (
        lambda: interop.quaternion(T, order=order),
        lambda: interop.rotation(q, order=order),
        lambda: interop.position_and_quaternion(T, order=order),
        lambda: interop.pose_from_quaternion((0, 0, 0), q, order=order),
    ):
        with pytest.raises(ValueError, match=r"^order: got .*, expected 'wxyz' or 'xyzw'$"):
            call()


def test_the_order_must_be_said() -> None:
    with pytest.raises(TypeError, match="order"):
        interop.quaternion(T)
    with pytest.raises(TypeError):
        interop.rotation([1, 0, 0, 0], "wxyz")


@pytest.mark.parametrize(
    "bad", [np.eye(5), np.zeros(7), 2 * np.eye(4), "pose", None, [[1], [1, 2]]]
)
@pytest.mark.parametrize("call", [interop.from_pose, *TO.values()])
def test_what_is_no_pose(call, bad: object) -> None:
    with pytest.raises(ValueError, match=r"^T: got .*, expected "):
        call(bad)


class HalfAQuaternion:
    def toRotationMatrix(self) -> np.ndarray:
        return np.eye(3)


@pytest.mark.parametrize("bad", [pin.Quaternion(0.0, 0.0, 0.0, 0.0), HalfAQuaternion()])
def test_quaternions_that_are_no_rotation(bad: object) -> None:
    for call in (interop.to_scipy, lambda T: interop.quaternion(T, order="wxyz")):
        with pytest.raises(ValueError, match=r"^T: got .*, expected "):
            call(bad)


def test_errors_name_the_argument() -> None:
    for bad in (np.zeros(4), [np.nan, 0, 0, 1], np.eye(3), "abc"):
        with pytest.raises(ValueError, match=r"^quaternion: got .*, expected "):
            interop.rotation(bad, order="xyzw")
    for bad in (np.zeros(4), [np.nan, 0, 0], "abc", [[1], [1, 2]], 1j * np.ones(3)):
        with pytest.raises(ValueError, match=r"^p: got .*, expected "):
            interop.pose_from_quaternion(bad, [0, 0, 0, 1], order="xyzw")
    for bad in (2 * np.eye(3), np.full((4, 4), np.nan), np.eye(2)):
        with pytest.raises(ValueError, match=r"^T: got .*, expected "):
            interop.quaternion(bad, order="xyzw")


@pytest.mark.parametrize(
    ("module", "package", "call"),
    [
        ("pinocchio", "pin", lambda: interop.to_pinocchio_se3(T)),
        ("pinocchio", "pin", lambda: interop.to_pinocchio(tk.robots.ur5())),
        ("scipy.spatial.transform", "scipy", lambda: interop.to_scipy(T)),
        ("spatialmath", "spatialmath-python", lambda: interop.to_spatialmath(T)),
    ],
)
def test_a_missing_peer_is_named(module, package, call, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match=f"^this needs {module}: pip install {package}$"):
        call()
