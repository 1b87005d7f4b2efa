"""What a chain is made of, read off its kinematics at q = 0.

A chain tells where its frames are and how its joints move them. That is all there is to know, by
the product of exponentials: with S_i the screw of joint i at q = 0 and M_f the pose of frame f,

    T_f(q) = exp(S_1 q_1) ... exp(S_k q_k) M_f,    k the last joint before f,

and S_i is column i of the Jacobian at q = 0 in "world" coordinates: [v; w] of a revolute joint is
its axis w and the velocity v = w x (0 - o) that it gives the origin, with o any point of the
axis; so w x v is the point of the axis next to the origin. A prismatic joint has [v; 0], with v
its axis.

Which joints are before a frame shows in its Jacobian, too: those beyond have zero columns. Each
joint has a frame of its own, so the one that moves more frames is nearer to the root.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from thing_kin import lie
from thing_kin.interop.arrays import Array

if TYPE_CHECKING:
    from thing_kin import Chain


@dataclass(frozen=True)
class Joint:
    """A joint that turns about or slides along the z axis of its own frame."""

    place: int  # in q
    pose: Array  # of its frame in the world at q = 0, (4, 4)


@dataclass(frozen=True)
class Structure:
    """Joints from the root outwards; for each frame the pose at q = 0 and how many are before."""

    joints: tuple[Joint, ...]
    frames: Array  # (number of frames, 4, 4)
    joints_before: tuple[int, ...]


def structure(robot: Chain) -> Structure:
    """Joints and frames of a chain."""
    zero = np.zeros(robot.n)
    screws = robot.jacobian(zero, "world")
    moved = np.array([robot.jacobian(zero, of=name).any(axis=0) for name in robot.frames])
    outwards = np.argsort(-moved.sum(axis=0))
    return Structure(
        tuple(Joint(int(j), frame_on_axis(screws[:, j])) for j in outwards),
        robot.fk_all(zero),
        tuple(int(count) for count in moved.sum(axis=1)),
    )


def frame_on_axis(screw: Array) -> Array:
    """Pose of a frame whose z axis is that of a screw [v, w]."""
    v, w = screw[:3], screw[3:]
    revolute = w @ w > 0.5  # one of the two has length one
    T = np.eye(4)
    T[:3, :3] = rotation_from_z_to(w if revolute else v)
    T[:3, 3] = np.cross(w, v) if revolute else 0.0
    return T


def rotation_from_z_to(axis: Array) -> Array:
    """Rotate the z axis to another unit vector the short way; at half a turn, about x."""
    x, y, z = axis
    sine = np.hypot(x, y)  # z cross axis = (-y, x, 0)
    normal = np.array([-y, x, 0.0]) / sine if sine > 0.0 else np.array([1.0, 0.0, 0.0])
    return lie.so3_exp(np.arctan2(sine, z) * normal)
