"""Independent sources of the same numbers: plain numpy, finite differences, Pinocchio."""

from collections.abc import Callable, Sequence

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike, NDArray

import thing_kin as tk

Array = NDArray[np.float64]


def assert_close(actual: ArrayLike, expected: ArrayLike, atol: float) -> None:
    """Equal shapes, and entries within atol: numpy's own default adds 1e-7 of the size."""
    assert np.shape(actual) == np.shape(expected)
    np.testing.assert_allclose(actual, expected, rtol=0.0, atol=atol)


def translation(x: float, y: float, z: float) -> Array:
    T = np.eye(4)
    T[:3, 3] = x, y, z
    return T


def rotation_x(angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])


def rotation_z(angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def dh_matrix(d: float, theta: float, a: float, alpha: float) -> Array:
    """[M17] (3.7), factor by factor."""
    return rotation_z(theta) @ translation(0, 0, d) @ translation(a, 0, 0) @ rotation_x(alpha)


def dh_fk_all(rows: Sequence[tk.DH], q: Array) -> Array:
    """Poses of the root and of the frame after each row: q adds to theta or to d."""
    values = iter(q)
    frames = [np.eye(4)]
    for row in rows:
        d, theta = row.d, row.theta
        if row.joint in ("revolute", "continuous"):
            theta += next(values)
        elif row.joint == "prismatic":
            d += next(values)
        frames.append(frames[-1] @ dh_matrix(d, theta, row.a, row.alpha))
    return np.stack(frames)


REFERENCES = {"world_aligned": pin.LOCAL_WORLD_ALIGNED, "body": pin.LOCAL, "world": pin.WORLD}


class PinocchioChain:
    """The rows as a Pinocchio model: joints about or along z, frames where thing_kin has them."""

    def __init__(self, rows: Sequence[tk.DH]) -> None:
        self.model = pin.Model()
        self.frames = [0]  # Pinocchio's frame 0 is the universe
        parent, placement = 0, pin.SE3.Identity()
        joints = {
            "revolute": pin.JointModelRZ,
            "continuous": pin.JointModelRZ,  # one angle, unlike Pinocchio's (cos, sin)
            "prismatic": pin.JointModelPZ,
        }
        for i, row in enumerate(rows):
            if row.joint in joints:
                joint = joints[row.joint]()
                parent = self.model.addJoint(parent, joint, placement, f"joint{i}")
                placement = pin.SE3.Identity()
            placement = placement * pin.SE3(dh_matrix(row.d, row.theta, row.a, row.alpha))
            frame = pin.Frame(f"frame{i}", parent, placement, pin.FrameType.OP_FRAME)
            self.frames.append(self.model.addFrame(frame))
        self.data = self.model.createData()

    def fk_all(self, q: Array) -> Array:
        pin.framesForwardKinematics(self.model, self.data, q)
        return np.stack([self.data.oMf[i].homogeneous for i in self.frames])

    def jacobian(self, q: Array, frame: str = "world_aligned", of: int = -1) -> Array:
        at = self.frames[of]
        J = pin.computeFrameJacobian(self.model, self.data, q, at, REFERENCES[frame])
        return J.reshape(6, self.model.nv).copy()  # of a single joint Pinocchio drops the axis

    def add_point(self, of: int, point: Array) -> int:
        """A frame at a point of another one, with its axes; its index, to be used as `of`."""
        at = self.model.frames[self.frames[of]]
        placement = at.placement * pin.SE3(np.eye(3), point)
        name = f"point{len(self.frames)}"
        frame = pin.Frame(name, at.parentJoint, placement, pin.FrameType.OP_FRAME)
        self.frames.append(self.model.addFrame(frame))
        self.data = self.model.createData()
        return len(self.frames) - 1

    def jacobian_dot(self, q: Array, qd: Array, frame: str, of: int) -> Array:
        pin.computeJointJacobiansTimeVariation(self.model, self.data, q, qd)
        pin.updateFramePlacements(self.model, self.data)
        at = self.frames[of]
        dJ = pin.getFrameJacobianTimeVariation(self.model, self.data, at, REFERENCES[frame])
        return dJ.reshape(6, self.model.nv).copy()

    def velocity(self, q: Array, qd: Array, frame: str, of: int) -> Array:
        pin.forwardKinematics(self.model, self.data, q, qd)
        at = self.frames[of]
        return pin.getFrameVelocity(self.model, self.data, at, REFERENCES[frame]).vector.copy()

    def acceleration(
        self, q: Array, qd: Array, qdd: Array, frame: str, of: int, kind: str
    ) -> Array:
        pin.forwardKinematics(self.model, self.data, q, qd, qdd)
        get = {
            "classical": pin.getFrameClassicalAcceleration,
            "spatial": pin.getFrameAcceleration,
        }[kind]
        return get(self.model, self.data, self.frames[of], REFERENCES[frame]).vector.copy()


def derivative(f: Callable[[Array], Array | float], x: Array, step: float = 1e-3) -> Array:
    """df/dx_k on the last axis, by central differences of fourth order.

    On sums of sines of amplitude A they are off by A step^4/30, and by eps A/step from rounding:
    with A of some ten metres and this step, by less than 1e-10.
    """
    columns = []
    for e in step * np.eye(len(x)):
        near = np.subtract(f(x + e), f(x - e))
        far = np.subtract(f(x + 2 * e), f(x - 2 * e))
        columns.append((8 * near - far) / (12 * step))
    return np.stack(columns, axis=-1)


def time_derivative(f: Callable[[Array], Array], q: Array, qd: Array) -> Array:
    """df(q(t))/dt for rates whose absolute values add up to at most one.

    Then no sine in it turns faster than 1 rad/s, as for derivative().
    """
    return derivative(lambda t: f(q + t[0] * qd), np.zeros(1))[..., 0]


def hat(w: Array) -> Array:
    x, y, z = w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def vee(S: Array) -> Array:
    """The vector of a skew matrix, or the twist [linear, angular] of a (4, 4) velocity."""
    w = np.array([S[2, 1] - S[1, 2], S[0, 2] - S[2, 0], S[1, 0] - S[0, 1]]) / 2
    return w if S.shape == (3, 3) else np.concatenate([S[:3, 3], w])


def jacobian_by_differences(fk: Callable[[Array], Array], q: Array, frame: str) -> Array:
    """Velocity of the pose fk(q) for each joint, read as each reference frame defines it."""
    T = fk(q)
    columns = []
    for dT in np.moveaxis(derivative(fk, q), -1, 0):
        if frame == "body":
            columns.append(vee(np.linalg.inv(T) @ dT))
        elif frame == "world":
            columns.append(vee(dT @ np.linalg.inv(T)))
        else:
            columns.append(np.concatenate([dT[:3, 3], vee(dT[:3, :3] @ T[:3, :3].T)]))
    return np.stack(columns, axis=-1)
