"""Other libraries' types."""

import numpy as np

from public_arrays.argument import ROBOT, XI, Argument, Q, T
from thing_kin import interop

XYZW = np.array([0.5, -0.5, 0.5, 0.5])
PIN_THING = interop.to_pinocchio(ROBOT)
INTEROP = [
    Argument("from_pose", "T", T, interop.from_pose),
    Argument("quaternion", "T", T[:3, :3], lambda v: interop.quaternion(v, order="xyzw")),
    Argument("rotation", "quaternion", XYZW, lambda v: interop.rotation(v, order="xyzw")),
    Argument(
        "pose_from_quaternion",
        "p",
        XI[:3],
        lambda v: interop.pose_from_quaternion(v, XYZW, order="xyzw"),
    ),
    Argument("PinocchioModel", "q", Q, PIN_THING.q),
    Argument("PinocchioModel", "v", Q, PIN_THING.from_v),
]
