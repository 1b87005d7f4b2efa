"""Quaternions whose order has a name, because mistaking it goes unnoticed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from thing_kin import lie
from thing_kin.interop.arrays import Array, read_either, read_pose, read_vectors

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

Order: TypeAlias = Literal["wxyz", "xyzw"]
# Where w, x, y, z of thing_kin's own order stand.
PLACES = {"wxyz": [0, 1, 2, 3], "xyzw": [3, 0, 1, 2]}


def _places(order: object) -> list[int]:
    if not isinstance(order, str) or order not in PLACES:
        raise ValueError(f"order: got {order!r}, expected 'wxyz' or 'xyzw'")
    return PLACES[order]


def quaternion(T: Any, *, order: Order) -> Array:
    """Quaternion, of unit length, of a rotation or of a pose, in a named order.

    w >= 0; at w = 0 the first nonzero of x, y, z is positive.

    Parameters
    ----------
    T : (3, 3), (N, 3, 3), (4, 4) or (N, 4, 4)
        Or any accepted object.
    order : 'wxyz' or 'xyzw'
        'wxyz': thing_kin, Eigen's constructor, spatialmath. 'xyzw': SciPy's default, ROS, the
        coefficients of Eigen and Pinocchio.

    Returns
    -------
    (4,) or (N, 4)

    Raises
    ------
    ValueError
        If it is neither a rotation nor a pose, or the order is none of the two.

    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import interop
    >>> interop.quaternion(np.eye(3), order="wxyz")
    array([1., 0., 0., 0.])
    >>> interop.quaternion(np.eye(3), order="xyzw")
    array([0., 0., 0., 1.])
    """
    places = _places(order)
    wxyz = lie.quaternion_from_rotation(read_either(T)[..., :3, :3])
    ordered = np.empty_like(wxyz)
    ordered[..., places] = wxyz
    return ordered


def rotation(quaternion: ArrayLike, *, order: Order) -> Array:
    """Rotation matrix of a quaternion in a named order, normalized first.

    Parameters
    ----------
    quaternion : (4,) or (N, 4)
    order : 'wxyz' or 'xyzw'

    Returns
    -------
    (3, 3) or (N, 3, 3)

    Raises
    ------
    ValueError
        If a quaternion is zero, or the order is none of the two.

    Examples
    --------
    >>> from thing_kin import interop
    >>> interop.rotation([0, 0, 1, 0], order="xyzw")  # half a turn about z
    array([[-1.,  0.,  0.],
           [ 0., -1.,  0.],
           [ 0.,  0.,  1.]])
    """
    places = _places(order)
    lie.rotation_from_quaternion(quaternion)  # says what is wrong with it
    return lie.rotation_from_quaternion(np.asarray(quaternion, dtype=np.float64)[..., places])


def position_and_quaternion(T: Any, *, order: Order) -> tuple[Array, Array]:
    """Position and unit quaternion of a pose, the latter in a named order and with w >= 0.

    Parameters
    ----------
    T : (4, 4) or (N, 4, 4)
        Or any accepted object.
    order : 'wxyz' or 'xyzw'

    Returns
    -------
    p : (3,) or (N, 3), m
    q : (4,) or (N, 4)

    Raises
    ------
    ValueError
        If it is no rigid transform, or the order is none of the two.

    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import interop
    >>> interop.position_and_quaternion(tk.transform(xyz=(1, 2, 3)), order="xyzw")
    (array([1., 2., 3.]), array([0., 0., 0., 1.]))
    """
    pose = read_pose(T)
    return pose[..., :3, 3].copy(), quaternion(pose, order=order)


def pose_from_quaternion(p: ArrayLike, quaternion: ArrayLike, *, order: Order) -> Array:
    """Pose of a position and a quaternion in a named order, normalized first.

    Parameters
    ----------
    p : (3,) or (N, 3), m
    quaternion : (4,) or (N, 4)
    order : 'wxyz' or 'xyzw'

    Returns
    -------
    (4, 4) or (N, 4, 4)
        One position goes with every quaternion of a batch, and the other way round.

    Raises
    ------
    ValueError
        If a shape is wrong, a quaternion zero, or the order is none of the two.

    Examples
    --------
    >>> from thing_kin import interop
    >>> interop.pose_from_quaternion((1, 2, 3), (0, 0, 0, 1), order="xyzw")
    array([[1., 0., 0., 1.],
           [0., 1., 0., 2.],
           [0., 0., 1., 3.],
           [0., 0., 0., 1.]])
    """
    R = rotation(quaternion, order=order)
    at = read_vectors(p, "p", 3)
    if R.ndim == 3 and at.ndim == 2 and len(R) != len(at):
        expected = f"{len(R)}, as many as quaternions, or one"
        raise ValueError(f"p: got {len(at)} positions, expected {expected}")
    batch = R.shape[:-2] if R.ndim == 3 else at.shape[:-1]
    T = np.zeros((*batch, 4, 4))
    T[..., :3, :3] = R
    T[..., :3, 3] = at
    T[..., 3, 3] = 1.0
    return T
