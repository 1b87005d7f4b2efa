"""
Rotations SO(3), planar poses SE(2) and rigid transforms SE(3).
"""
from __future__ import annotations
import numpy
import numpy.typing
import typing
__all__: list[str] = ['as_matrix', 'quaternion_from_rotation', 'rotation_from_quaternion', 'rotation_from_rpy', 'rpy_from_rotation', 'se2_adjoint', 'se2_between', 'se2_compose', 'se2_exp', 'se2_inverse', 'se2_left_jacobian', 'se2_left_jacobian_inverse', 'se2_log', 'se2_right_jacobian', 'se2_right_jacobian_inverse', 'se3_adjoint', 'se3_exp', 'se3_left_jacobian', 'se3_left_jacobian_inverse', 'se3_log', 'se3_right_jacobian', 'se3_right_jacobian_inverse', 'so3_exp', 'so3_left_jacobian', 'so3_left_jacobian_inverse', 'so3_log', 'so3_right_jacobian', 'so3_right_jacobian_inverse']
def as_matrix(argument: typing.Any) -> typing.Any:
    """
    Matrix of a pose or rotation as another library has it; anything else as it is.
    """
def quaternion_from_rotation(R: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Unit quaternion (w, x, y, z) of a rotation matrix, with w >= 0.
    
    At w = 0 the first nonzero component is positive.
    
    Parameters
    ----------
    R : (3, 3) or (N, 3, 3)
    
    Returns
    -------
    (4,) or (N, 4)
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> tk.lie.quaternion_from_rotation(np.eye(3))
    array([1., 0., 0., 0.])
    """
def rotation_from_quaternion(quaternion: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Rotation matrix of a quaternion (w, x, y, z), normalized first.
    
    Parameters
    ----------
    quaternion : (4,) or (N, 4)
    
    Returns
    -------
    (3, 3) or (N, 3, 3)
    
    Raises
    ------
    ValueError
        If the quaternion is zero.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.lie.rotation_from_quaternion([0, 0, 0, 1])  # half a turn about z
    array([[-1.,  0.,  0.],
           [ 0., -1.,  0.],
           [ 0.,  0.,  1.]])
    """
def rotation_from_rpy(rpy: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Rotation matrix Rz(yaw) Ry(pitch) Rx(roll), as in URDF.
    
    Parameters
    ----------
    rpy : (3,) or (N, 3), rad
        Roll, pitch, yaw.
    
    Returns
    -------
    (3, 3) or (N, 3, 3)
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> R = tk.lie.rotation_from_rpy([0.1, 0.2, 0.3])
    >>> np.array_equal(R, tk.transform(rpy=(0.1, 0.2, 0.3))[:3, :3])
    True
    """
def rpy_from_rotation(R: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Roll, pitch, yaw of a rotation matrix: R = Rz(yaw) Ry(pitch) Rx(roll).
    
    The pitch is in [-pi/2, pi/2]. At either end, where only yaw - roll or yaw + roll is determined,
    roll is 0. The three give R back to rounding everywhere.
    
    Parameters
    ----------
    R : (3, 3) or (N, 3, 3)
    
    Returns
    -------
    (3,) or (N, 3), rad
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.lie.rpy_from_rotation(tk.transform(rpy=(0.1, 0.2, 0.3))[:3, :3])
    array([0.1, 0.2, 0.3])
    """
def se2_adjoint(pose: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Adjoint of T_a_b: takes a twist (vx, vy, omega) in b to the same in a.
    
    Parameters
    ----------
    pose : (3,) or (N, 3), m and rad
    
    Returns
    -------
    (3, 3) or (N, 3, 3)
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.lie.se2_adjoint([1.0, 2.0, 0.0])
    array([[ 1., -0.,  2.],
           [ 0.,  1., -1.],
           [ 0.,  0.,  1.]])
    """
def se2_between(a: numpy.typing.ArrayLike, b: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Planar pose T_a_b of T_w_a and T_w_b: b as a sees it.
    
    Parameters
    ----------
    a, b : (3,) or (N, 3), m and rad
    
    Returns
    -------
    (3,) or (N, 3), theta in (-pi, pi]
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> tk.lie.se2_between([1.0, 0.0, np.pi / 2], [1.0, 1.0, np.pi / 2]).round(3)
    array([1., 0., 0.])
    """
def se2_compose(a: numpy.typing.ArrayLike, b: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Planar pose T_w_b of T_w_a and T_a_b.
    
    Parameters
    ----------
    a, b : (3,) or (N, 3), m and rad
        (x, y, theta).
    
    Returns
    -------
    (3,) or (N, 3), theta in (-pi, pi]
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> tk.lie.se2_compose([1.0, 0.0, np.pi / 2], [1.0, 0.0, 0.0]).round(3)
    array([1.   , 1.   , 1.571])
    """
def se2_exp(xi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Planar pose of a twist (vx, vy, omega) held for one second.
    
    Parameters
    ----------
    xi : (3,) or (N, 3), m and rad
    
    Returns
    -------
    (3,) or (N, 3), m and rad
        (x, y, theta), theta in (-pi, pi].
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> np.allclose(tk.lie.se2_exp([np.pi / 2, 0.0, np.pi / 2]), [1.0, 1.0, np.pi / 2])
    True
    """
def se2_inverse(pose: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Planar pose T_b_a of T_a_b.
    
    Parameters
    ----------
    pose : (3,) or (N, 3), m and rad
    
    Returns
    -------
    (3,) or (N, 3), theta in (-pi, pi]
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> tk.lie.se2_inverse([1.0, 0.0, np.pi / 2]).round(3)
    array([-0.   ,  1.   , -1.571])
    """
def se2_left_jacobian(xi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Left Jacobian J: exp(xi + d) = exp(J d) exp(xi) to first order in d.
    
    Parameters
    ----------
    xi : (3,) or (N, 3), m and rad
    
    Returns
    -------
    (3, 3) or (N, 3, 3)
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> np.array_equal(tk.lie.se2_left_jacobian(np.zeros(3)), np.eye(3))
    True
    """
def se2_left_jacobian_inverse(xi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Inverse of the left Jacobian.
    
    Parameters
    ----------
    xi : (3,) or (N, 3), m and rad
    
    Returns
    -------
    (3, 3) or (N, 3, 3)
    
    Raises
    ------
    ValueError
        If omega is a whole number of turns, where the Jacobian is singular.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> xi = [1.0, 2.0, 0.5]
    >>> J = tk.lie.se2_left_jacobian(xi)
    >>> np.allclose(tk.lie.se2_left_jacobian_inverse(xi) @ J, np.eye(3))
    True
    """
def se2_log(pose: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Twist (vx, vy, omega) of a planar pose, omega in (-pi, pi].
    
    Parameters
    ----------
    pose : (3,) or (N, 3), m and rad
    
    Returns
    -------
    (3,) or (N, 3), m and rad
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> xi = np.array([1.0, 2.0, 0.5])
    >>> np.allclose(tk.lie.se2_log(tk.lie.se2_exp(xi)), xi)
    True
    """
def se2_right_jacobian(xi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Right Jacobian J: exp(xi + d) = exp(xi) exp(J d) to first order in d.
    
    Parameters
    ----------
    xi : (3,) or (N, 3), m and rad
    
    Returns
    -------
    (3, 3) or (N, 3, 3)
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> np.array_equal(tk.lie.se2_right_jacobian(np.zeros(3)), np.eye(3))
    True
    """
def se2_right_jacobian_inverse(xi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Inverse of the right Jacobian.
    
    Parameters
    ----------
    xi : (3,) or (N, 3), m and rad
    
    Returns
    -------
    (3, 3) or (N, 3, 3)
    
    Raises
    ------
    ValueError
        If omega is a whole number of turns, where the Jacobian is singular.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> xi = [1.0, 2.0, 0.5]
    >>> J = tk.lie.se2_right_jacobian(xi)
    >>> np.allclose(tk.lie.se2_right_jacobian_inverse(xi) @ J, np.eye(3))
    True
    """
def se3_adjoint(T: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Adjoint of T_a_b: takes a twist [linear, angular] in b to the same in a.
    
    Parameters
    ----------
    T : (4, 4) or (N, 4, 4)
    
    Returns
    -------
    (6, 6) or (N, 6, 6)
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> T, xi = tk.transform(xyz=(1, 0, 0), rpy=(0, 0, 1)), [0, 0, 0, 0, 0, 0.5]
    >>> moved = T @ tk.lie.se3_exp(xi) @ np.linalg.inv(T)
    >>> np.allclose(moved, tk.lie.se3_exp(tk.lie.se3_adjoint(T) @ xi))
    True
    """
def se3_exp(xi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Rigid transform of a twist [linear, angular].
    
    Parameters
    ----------
    xi : (6,) or (N, 6), m and rad
    
    Returns
    -------
    (4, 4) or (N, 4, 4)
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> xi = np.array([1.0, 2.0, 3.0, 0.1, 0.2, 0.3])
    >>> np.allclose(tk.lie.se3_log(tk.lie.se3_exp(xi)), xi)
    True
    """
def se3_left_jacobian(xi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Left Jacobian J: exp(xi + d) = exp(J d) exp(xi) to first order in d.
    
    Parameters
    ----------
    xi : (6,) or (N, 6), m and rad
    
    Returns
    -------
    (6, 6) or (N, 6, 6)
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> np.array_equal(tk.lie.se3_left_jacobian(np.zeros(6)), np.eye(6))
    True
    """
def se3_left_jacobian_inverse(xi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Inverse of the left Jacobian.
    
    Parameters
    ----------
    xi : (6,) or (N, 6), m and rad
    
    Returns
    -------
    (6, 6) or (N, 6, 6)
    
    Raises
    ------
    ValueError
        If the angular part is a whole number of turns, where the Jacobian is singular.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> xi = [1.0, 2.0, 3.0, 0.1, 0.2, 0.3]
    >>> J = tk.lie.se3_left_jacobian(xi)
    >>> np.allclose(tk.lie.se3_left_jacobian_inverse(xi) @ J, np.eye(6))
    True
    """
def se3_log(T: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Twist [linear, angular] of a rigid transform, its angle in [0, pi].
    
    Parameters
    ----------
    T : (4, 4) or (N, 4, 4)
    
    Returns
    -------
    (6,) or (N, 6), m and rad
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.lie.se3_log(tk.transform(xyz=(1, 2, 3)))
    array([1., 2., 3., 0., 0., 0.])
    """
def se3_right_jacobian(xi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Right Jacobian J: exp(xi + d) = exp(xi) exp(J d) to first order in d.
    
    Parameters
    ----------
    xi : (6,) or (N, 6), m and rad
    
    Returns
    -------
    (6, 6) or (N, 6, 6)
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> np.array_equal(tk.lie.se3_right_jacobian(np.zeros(6)), np.eye(6))
    True
    """
def se3_right_jacobian_inverse(xi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Inverse of the right Jacobian.
    
    Parameters
    ----------
    xi : (6,) or (N, 6), m and rad
    
    Returns
    -------
    (6, 6) or (N, 6, 6)
    
    Raises
    ------
    ValueError
        If the angular part is a whole number of turns, where the Jacobian is singular.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> xi = [1.0, 2.0, 3.0, 0.1, 0.2, 0.3]
    >>> J = tk.lie.se3_right_jacobian(xi)
    >>> np.allclose(tk.lie.se3_right_jacobian_inverse(xi) @ J, np.eye(6))
    True
    """
def so3_exp(phi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Rotation matrix of a rotation vector (Rodrigues).
    
    Parameters
    ----------
    phi : (3,) or (N, 3), rad
    
    Returns
    -------
    (3, 3) or (N, 3, 3)
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> tk.lie.so3_exp([0, 0, np.pi / 2]).round(12) + 0.0
    array([[ 0., -1.,  0.],
           [ 1.,  0.,  0.],
           [ 0.,  0.,  1.]])
    """
def so3_left_jacobian(phi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Left Jacobian J: exp(phi + d) = exp(J d) exp(phi) to first order in d.
    
    Parameters
    ----------
    phi : (3,) or (N, 3), rad
    
    Returns
    -------
    (3, 3) or (N, 3, 3)
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> tk.lie.so3_left_jacobian(np.zeros(3))
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]])
    """
def so3_left_jacobian_inverse(phi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Inverse of the left Jacobian.
    
    Parameters
    ----------
    phi : (3,) or (N, 3), rad
    
    Returns
    -------
    (3, 3) or (N, 3, 3)
    
    Raises
    ------
    ValueError
        If phi is a whole number of turns, where the Jacobian is singular.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> phi = [0.1, -0.2, 0.3]
    >>> J = tk.lie.so3_left_jacobian(phi)
    >>> np.allclose(tk.lie.so3_left_jacobian_inverse(phi) @ J, np.eye(3))
    True
    """
def so3_log(R: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Rotation vector of a rotation matrix, its norm in [0, pi], [M17] (4.28).
    
    Exact to rounding everywhere. At pi both signs of the axis are right: the first nonzero component
    is positive.
    
    Parameters
    ----------
    R : (3, 3) or (N, 3, 3)
    
    Returns
    -------
    (3,) or (N, 3), rad
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> tk.lie.so3_log(np.diag([-1.0, -1.0, 1.0]))  # half a turn about z
    array([0.        , 0.        , 3.14159265])
    """
def so3_right_jacobian(phi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Right Jacobian J: exp(phi + d) = exp(phi) exp(J d) to first order in d.
    
    Parameters
    ----------
    phi : (3,) or (N, 3), rad
    
    Returns
    -------
    (3, 3) or (N, 3, 3)
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> phi = np.array([0.1, -0.2, 0.3])
    >>> np.allclose(tk.lie.so3_right_jacobian(phi), tk.lie.so3_left_jacobian(-phi))
    True
    """
def so3_right_jacobian_inverse(phi: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Inverse of the right Jacobian.
    
    Parameters
    ----------
    phi : (3,) or (N, 3), rad
    
    Returns
    -------
    (3, 3) or (N, 3, 3)
    
    Raises
    ------
    ValueError
        If phi is a whole number of turns, where the Jacobian is singular.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> phi = [0.1, -0.2, 0.3]
    >>> J = tk.lie.so3_right_jacobian(phi)
    >>> np.allclose(tk.lie.so3_right_jacobian_inverse(phi) @ J, np.eye(3))
    True
    """
