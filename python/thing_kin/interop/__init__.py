"""Poses, rotations, quaternions and models from and to SciPy, Pinocchio and spatialmath.

Every function of thing_kin takes the poses and rotations of these libraries as they are; this
module is for the way back, for quaternions whose order has a name, for dynamics by Pinocchio and
for distances between meshes by Coal.
No library is imported before a function needs it, and what is missing is named in the error.

Examples
--------
>>> from thing_kin import interop
>>> interop.quaternion([[0, -1, 0], [1, 0, 0], [0, 0, 1]], order="xyzw").round(3)
array([0.   , 0.   , 0.707, 0.707])
"""

from thing_kin.interop.mesh_clearance import MeshClearance, convex_hull
from thing_kin.interop.pinocchio_model import PinocchioModel, to_pinocchio
from thing_kin.interop.poses import from_pose, to_pinocchio_se3, to_scipy, to_spatialmath
from thing_kin.interop.quaternions import (
    pose_from_quaternion,
    position_and_quaternion,
    quaternion,
    rotation,
)

__all__ = [
    "MeshClearance",
    "PinocchioModel",
    "convex_hull",
    "from_pose",
    "pose_from_quaternion",
    "position_and_quaternion",
    "quaternion",
    "rotation",
    "to_pinocchio",
    "to_pinocchio_se3",
    "to_scipy",
    "to_spatialmath",
]
