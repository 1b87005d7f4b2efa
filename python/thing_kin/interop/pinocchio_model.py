"""The same robot as a Pinocchio model, for users who need dynamics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from thing_kin.interop.arrays import Array, read_vectors
from thing_kin.interop.inertia import checked
from thing_kin.interop.peers import peer
from thing_kin.interop.structure import structure

if TYPE_CHECKING:
    import pinocchio
    from numpy.typing import ArrayLike

    from thing_kin import Chain

    Inertia: TypeAlias = tuple[float, ArrayLike, ArrayLike]

# By the type of a joint. A continuous joint is JointModelRZ, too: its q is the angle, as here, with
# all its turns. JointModelRUBZ has (cos, sin): no turns, and q would be longer than v.
JOINT_MODELS = {
    "revolute": "JointModelRZ",
    "continuous": "JointModelRZ",
    "prismatic": "JointModelPZ",
}


@dataclass(frozen=True)
class PinocchioModel:
    """A robot as a Pinocchio model, and the way between the two orders of joints.

    Made by `to_pinocchio`. Pinocchio counts joints from the root outwards, thing_kin as the robot
    says. In either one number stands for one joint: also a continuous joint's q is its angle.

    Attributes
    ----------
    model : pinocchio.Model
        Joints and frames (`FrameType.OP_FRAME`) have the names they have in thing_kin.
    order : tuple of int
        For each of Pinocchio's joints, without the universe, its place in thing_kin's q.
    frames : mapping of str to int
        Pinocchio's index of each frame, from the root to the tool.

    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import interop
    >>> pin_thing = interop.to_pinocchio(tk.robots.thing())
    >>> list(pin_thing.model.names)[1:5]
    ['x', 'y', 'theta', 'q0']
    """

    model: pinocchio.Model
    order: tuple[int, ...]
    frames: Mapping[str, int]

    def q(self, q: ArrayLike) -> Array:
        """Pinocchio's configuration of one of thing_kin's.

        Parameters
        ----------
        q : (n,) or (N, n)

        Returns
        -------
        (n,) or (N, n)

        Examples
        --------
        >>> import thing_kin as tk
        >>> from thing_kin import interop
        >>> interop.to_pinocchio(tk.robots.thing()).q([0, 1, 2, 3, 4, 5, 6, 7, 8])
        array([6., 7., 8., 0., 1., 2., 3., 4., 5.])
        """
        return self._to(q, "q")

    def v(self, qd: ArrayLike) -> Array:
        """Pinocchio's joint velocities of thing_kin's; for accelerations and torques as well.

        Parameters
        ----------
        qd : (n,) or (N, n)

        Returns
        -------
        (n,) or (N, n)

        Examples
        --------
        >>> import thing_kin as tk
        >>> from thing_kin import interop
        >>> interop.to_pinocchio(tk.robots.thing()).v([0, 0, 0, 0, 0, 0, 0.1, 0.2, 0.3])
        array([0.1, 0.2, 0.3, 0. , 0. , 0. , 0. , 0. , 0. ])
        """
        return self._to(qd, "qd")

    def from_q(self, q: ArrayLike) -> Array:
        """thing_kin's configuration of one of Pinocchio's.

        Parameters
        ----------
        q : (n,) or (N, n)

        Returns
        -------
        (n,) or (N, n)

        Examples
        --------
        >>> import thing_kin as tk
        >>> from thing_kin import interop
        >>> interop.to_pinocchio(tk.robots.thing()).from_q([6, 7, 8, 0, 1, 2, 3, 4, 5])
        array([0., 1., 2., 3., 4., 5., 6., 7., 8.])
        """
        return self._from(q, "q")

    def from_v(self, v: ArrayLike) -> Array:
        """thing_kin's order of Pinocchio's joint velocities, torques, or rows of a Jacobian.

        Parameters
        ----------
        v : (n,) or (N, n)

        Returns
        -------
        (n,) or (N, n)

        Examples
        --------
        >>> import thing_kin as tk
        >>> from thing_kin import interop
        >>> interop.to_pinocchio(tk.robots.thing()).from_v([0.1, 0.2, 0.3, 0, 0, 0, 0, 0, 0])
        array([0. , 0. , 0. , 0. , 0. , 0. , 0.1, 0.2, 0.3])
        """
        return self._from(v, "v")

    def frame_id(self, name: str | None = None) -> int:
        """Pinocchio's index of a frame.

        Parameters
        ----------
        name : str, optional
            A frame of the robot; default: the tool.

        Raises
        ------
        ValueError
            If there is no such frame.

        Examples
        --------
        >>> import thing_kin as tk
        >>> from thing_kin import interop
        >>> pin_arm = interop.to_pinocchio(tk.robots.ur5())
        >>> pin_arm.model.frames[pin_arm.frame_id("wrist_1")].name
        'wrist_1'
        """
        if name is None:
            name = list(self.frames)[-1]
        if name not in self.frames:
            raise ValueError(f"name: got {name!r}, expected one of {', '.join(self.frames)}")
        return self.frames[name]

    def _to(self, values: ArrayLike, name: str) -> Array:
        return read_vectors(values, name, len(self.order))[..., list(self.order)]

    def _from(self, values: ArrayLike, name: str) -> Array:
        vectors = read_vectors(values, name, len(self.order))
        return vectors[..., np.argsort(self.order)]


def to_pinocchio(robot: Chain, inertias: Mapping[str, Inertia] | None = None) -> PinocchioModel:
    """Pinocchio model of the same chain: joints, frames, limits and, if given, inertias.

    Joints turn about or slide along z (JointModelRZ, also for continuous joints, and JointModelPZ);
    their placements are found from forward kinematics and Jacobians at q = 0. Efforts are
    unlimited; acceleration limits have no place in a Pinocchio model.

    Parameters
    ----------
    robot : Chain
    inertias : mapping of str to (mass, center, inertia), optional
        By frame, for each a rigid body that moves with it: mass in kg; center of mass (3,), m, in
        the frame; inertia (3, 3), kg m^2, about the center of mass along the frame's axes. The
        model has no masses otherwise.

    Returns
    -------
    PinocchioModel

    Raises
    ------
    ImportError
        If Pinocchio is missing.
    ValueError
        If a frame is unknown, or a body's numbers are none of a rigid body.

    Examples
    --------
    >>> import numpy as np, pinocchio as pin, thing_kin as tk
    >>> from thing_kin import interop
    >>> pendulum = tk.Chain.from_dh([tk.DH(a=2.0, alpha=np.pi / 2, joint="revolute")])
    >>> body = {"tool": (3.0, (0, 0, 0), np.zeros((3, 3)))}
    >>> model = interop.to_pinocchio(pendulum, inertias=body).model
    >>> pin.crba(model, model.createData(), np.zeros(1))  # m r^2
    array([[12.]])
    """
    bodies = {frame: checked(robot, frame, body) for frame, body in (inertias or {}).items()}
    return _build(peer("pinocchio", "pin"), robot, bodies)


def _build(pin: Any, robot: Chain, bodies: Mapping[str, Any]) -> PinocchioModel:
    found = structure(robot)
    model = pin.Model()
    model.name = robot.name
    to_joint = [pin.SE3.Identity()]  # from the world, at q = 0; the first is the universe
    for i, joint in enumerate(found.joints):
        pose = pin.SE3(joint.pose)
        _add_joint(pin, model, robot, joint.place, to_joint[i] * pose)
        to_joint.append(pose.inverse())
    frames = {}
    for name, pose, at in zip(robot.frames, found.frames, found.joints_before, strict=True):
        placement = to_joint[at] * pin.SE3(pose)
        frame = pin.Frame(name, at, placement, pin.FrameType.OP_FRAME)
        frames[name] = model.addFrame(frame)
        if name in bodies:
            model.appendBodyToJoint(at, pin.Inertia(*bodies[name]), placement)
    return PinocchioModel(model, tuple(joint.place for joint in found.joints), frames)


def _add_joint(pin: Any, model: Any, robot: Chain, place: int, placement: Any) -> None:
    kind = getattr(pin, JOINT_MODELS[robot.joint_types[place]])
    model.addJoint(
        model.njoints - 1,
        kind(),
        placement,
        robot.names[place],
        np.array([np.inf]),
        *(
            np.array([limits[place]])
            for limits in (robot.velocity_limits, robot.lower, robot.upper)
        ),
    )
