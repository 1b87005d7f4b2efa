"""Poses and rotations from and to the types of other libraries."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from thing_kin.interop.arrays import Array, read_either, read_pose
from thing_kin.interop.peers import peer

if TYPE_CHECKING:
    import pinocchio
    import spatialmath
    from scipy.spatial.transform import RigidTransform, Rotation


def from_pose(T: Any) -> Array:
    """Array of a pose of any library.

    Parameters
    ----------
    T : scipy RigidTransform, pinocchio.SE3, spatialmath.SE3, (4, 4) or (N, 4, 4)
        One, or several; a list of them as well where numpy makes an array of it.

    Returns
    -------
    (4, 4) or (N, 4, 4)
        float64, a copy.

    Raises
    ------
    ValueError
        If it is no rigid transform.

    Examples
    --------
    >>> import pinocchio as pin
    >>> from thing_kin import interop
    >>> interop.from_pose(pin.SE3.Identity())
    array([[1., 0., 0., 0.],
           [0., 1., 0., 0.],
           [0., 0., 1., 0.],
           [0., 0., 0., 1.]])
    """
    return read_pose(T)


def to_scipy(T: Any) -> RigidTransform | Rotation:
    """SciPy's RigidTransform of poses, or its Rotation of rotations.

    Parameters
    ----------
    T : (4, 4), (N, 4, 4), (3, 3) or (N, 3, 3)
        Or any accepted object.

    Returns
    -------
    scipy.spatial.transform.RigidTransform or scipy.spatial.transform.Rotation

    Raises
    ------
    ImportError
        If SciPy is missing, or older than 1.16 where poses are given.
    ValueError
        If it is neither a pose nor a rotation.

    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import interop
    >>> interop.to_scipy(tk.transform(xyz=(1, 2, 3))).translation
    array([1., 2., 3.])
    >>> interop.to_scipy(tk.lie.so3_exp([0.1, 0.2, 0.3])).as_rotvec()
    array([0.1, 0.2, 0.3])
    """
    matrix = read_either(T)
    transform = peer("scipy.spatial.transform", "scipy")
    if matrix.shape[-1] == 3:
        return transform.Rotation.from_matrix(matrix)
    if not hasattr(transform, "RigidTransform"):
        raise ImportError("poses in SciPy need its RigidTransform: pip install 'scipy>=1.16'")
    return transform.RigidTransform.from_matrix(matrix)


def to_pinocchio_se3(T: Any) -> pinocchio.SE3 | list[pinocchio.SE3]:
    """Pinocchio's SE3 of a pose, or a list of them of a batch.

    Parameters
    ----------
    T : (4, 4) or (N, 4, 4)
        Or any accepted object.

    Returns
    -------
    pinocchio.SE3 or list of pinocchio.SE3

    Raises
    ------
    ImportError
        If Pinocchio is missing.
    ValueError
        If it is no rigid transform.

    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import interop
    >>> interop.to_pinocchio_se3(tk.transform(xyz=(1, 2, 3))).translation
    array([1., 2., 3.])
    """
    matrix = read_pose(T)
    se3 = peer("pinocchio", "pin").SE3
    return se3(matrix) if matrix.ndim == 2 else [se3(item) for item in matrix]


def to_spatialmath(T: Any) -> spatialmath.SE3:
    """SE3 of spatialmath, which holds one pose or several.

    Parameters
    ----------
    T : (4, 4) or (N, 4, 4)
        Or any accepted object.

    Returns
    -------
    spatialmath.SE3

    Raises
    ------
    ImportError
        If spatialmath is missing.
    ValueError
        If it is no rigid transform.

    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import interop
    >>> interop.to_spatialmath(tk.transform(xyz=(1, 2, 3))).t
    array([1., 2., 3.])
    """
    matrix = read_pose(T)
    se3 = peer("spatialmath", "spatialmath-python").SE3
    if len(matrix) == 0:
        return se3.Empty()
    # Checked above, within the library's tolerance; spatialmath's own is a few roundings.
    return se3(matrix if matrix.ndim == 2 else list(matrix), check=False)
