"""
The C++ core of thing_kin. Private: import its names from thing_kin.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.random
import numpy.typing
import os
import typing
from . import lie
from . import robots
__all__: list[str] = ['BaseObstacleTask', 'BaseTask', 'Chain', 'DH', 'Damped', 'DistanceTask', 'Exact', 'FieldOfViewTask', 'IkBatchResult', 'IkResult', 'IkSolutions', 'JointRangeTask', 'LimitedStep', 'MAX_DOF', 'NumericIk', 'OrientationTask', 'PoseTask', 'PositionTask', 'PostureTask', 'SelectivelyDamped', 'SetTask', 'SingularValueFilter', 'Task', 'TaskPriority', 'TaskPriorityStep', 'WheelLimits', 'filter_singular_values', 'has_closed_form', 'ik', 'ik_all', 'lie', 'null_space', 'null_space_projector', 'on_omni_base', 'pinv', 'pose_error', 'robots', 'selectively_damped_step', 'simd_level', 'transform', 'use_simd_level']
class SingularValueFilter:
    """
    Lifts small singular values to at least sigma0, [M17] (4.12).
    
    h(s) = (s^3 + nu s^2 + 2 s + 2 sigma0)/(s^2 + nu s + 2), after Colome & Torras: h(0) = sigma0,
    h(s) > s, and h(s) tends to s for large s. It composes with every inverse.
    
    Parameters
    ----------
    sigma0 : float, >= 0
        What a zero singular value becomes.
    nu : float, >= 0
        Shape: a larger nu changes the others less.
    
    Raises
    ------
    ValueError
        If the filter is not increasing in s.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> h = tk.SingularValueFilter(sigma0=0.01, nu=10.0)
    >>> h(0.0)
    0.01
    """
    def __call__(self, s: numpy.typing.ArrayLike) -> float | numpy.typing.NDArray[numpy.float64]:
        """
        Filtered singular values, elementwise; a number or (N,).
        """
    def __eq__(self, arg0: SingularValueFilter) -> bool:
        ...
    def __getstate__(self) -> tuple[float, float]:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, sigma0: typing.SupportsFloat | typing.SupportsIndex, nu: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    @property
    def nu(self) -> float:
        """
        Shape.
        """
    @property
    def sigma0(self) -> float:
        """
        Image of zero.
        """
class DH:
    """
    One standard (distal) Denavit-Hartenberg row, [M17] (3.7).
    
    Rz(theta) Tz(d) Tx(a) Rx(alpha). A revolute joint's variable adds to theta, a prismatic one's to d.
    
    Parameters
    ----------
    d, a : float, m
    theta, alpha : float, rad
    joint : 'revolute', 'continuous', 'prismatic' or None
        Continuous: revolute without limits. None (or 'fixed'): a constant row, which has no joint
        variable.
    name : str
        Of the joint; default q0, q1, ... along the chain.
    frame : str
        Of the frame after the row; default frame1, frame2, ..., and tool for the last.
    lower, upper : float, rad or m
        Default +-pi for a revolute joint, unlimited for a prismatic one; none for a continuous one.
    velocity_limit, acceleration_limit : float > 0, rad/s, rad/s^2 (m/s, m/s^2)
        Default unlimited (inf).
    
    Raises
    ------
    ValueError
        If a number is not finite, limits are crossed or rates are not positive, or a continuous joint
        has a position limit.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.DH(a=-0.425, joint="revolute").upper
    3.141592653589793
    """
    def __init__(self, d: typing.SupportsFloat | typing.SupportsIndex = 0.0, theta: typing.SupportsFloat | typing.SupportsIndex = 0.0, a: typing.SupportsFloat | typing.SupportsIndex = 0.0, alpha: typing.SupportsFloat | typing.SupportsIndex = 0.0, joint: str | None = None, *, name: str = '', frame: str = '', lower: typing.SupportsFloat | typing.SupportsIndex | None = None, upper: typing.SupportsFloat | typing.SupportsIndex | None = None, velocity_limit: typing.SupportsFloat | typing.SupportsIndex | None = None, acceleration_limit: typing.SupportsFloat | typing.SupportsIndex | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def a(self) -> float:
        """
        Length along x, m.
        """
    @property
    def acceleration_limit(self) -> float:
        """
        rad/s^2 or m/s^2.
        """
    @property
    def alpha(self) -> float:
        """
        Twist about x, rad.
        """
    @property
    def d(self) -> float:
        """
        Offset along z, m.
        """
    @property
    def frame(self) -> str:
        """
        Name of the frame after the row; empty: numbered.
        """
    @property
    def joint(self) -> str:
        """
        'revolute', 'continuous', 'prismatic' or 'fixed'.
        """
    @property
    def lower(self) -> float:
        """
        Lower limit, rad or m.
        """
    @property
    def name(self) -> str:
        """
        Name of the joint; empty: numbered.
        """
    @property
    def theta(self) -> float:
        """
        Angle about z, rad.
        """
    @property
    def upper(self) -> float:
        """
        Upper limit, rad or m.
        """
    @property
    def velocity_limit(self) -> float:
        """
        rad/s or m/s.
        """
class Chain:
    """
    An immutable serial chain of joints, and its kinematics.
    
    Made by Chain.from_dh, Chain.from_urdf, on_omni_base or the functions of thing_kin.robots.
    Configurations q are (n,) in the order of `names`, rad and m; a leading axis is a batch. Two chains
    of equal content are equal; a chain can be hashed, copied, pickled and shared between threads.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> robot = tk.robots.ur5()
    >>> robot
    Chain('ur5', n=6)
    >>> robot.names
    ('q0', 'q1', 'q2', 'q3', 'q4', 'q5')
    """
    @staticmethod
    def from_dh(rows: collections.abc.Sequence[DH], *, name: str = 'chain') -> Chain:
        """
        Chain from standard Denavit-Hartenberg rows, [M17] (3.7), (3.8).
        
        Parameters
        ----------
        rows : sequence of DH
            At least one joint, at most 32.
        name : str
        
        Raises
        ------
        ValueError
            If there is no row or no joint, or two joints or frames have one name.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> arm = tk.Chain.from_dh([tk.DH(a=1.0, joint="revolute"), tk.DH(a=0.5, joint="revolute")])
        >>> arm.fk([0.0, 0.0])[:3, 3]
        array([1.5, 0. , 0. ])
        """
    @staticmethod
    def from_urdf(source: str | bytes | os.PathLike[str], base: str | None = None, tip: str | None = None, packages: collections.abc.Mapping[str, str | os.PathLike[str]] | None = None, name: str | None = None) -> Chain:
        """
        Chain between two links of a URDF.
        
        Its frames are the links from base to tip, its joints the revolute, continuous and prismatic ones
        between them, in that order, with any axis and origin. Where the way leads up to a common ancestor
        first, joints are run through backwards; they keep the sign of q and their limits.
        
        A velocity limit that is absent, zero or negative means unlimited, and so does any limit of the
        largest double. Efforts, soft limits, inertias, meshes and what is not on the chain are not read.
        
        Parameters
        ----------
        source : path, str or bytes
            A file, `package://name/rest`, or the XML itself: bytes, or a str that begins with '<'.
        base, tip : str, optional
            Names of links; default: the root, and the only leaf below the base.
        packages : mapping from str to path, optional
            Folders of ROS packages by name; others are looked for in ROS_PACKAGE_PATH and
            AMENT_PREFIX_PATH.
        name : str, optional
            Of the chain; default: the robot's.
        
        Returns
        -------
        Chain
        
        Raises
        ------
        ValueError
            If there is no such file, the text is no URDF, it leaves base or tip open, a joint of the chain
            mimics another, is planar or floating or has a limit or axis that is none, or there are none or
            more than 32 joints.
        ImportError
            If thing_kin was built without urdfdom.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> arm = tk.Chain.from_urdf('''
        ... <robot name="turntable">
        ...   <link name="floor"/> <link name="plate"/>
        ...   <joint name="turn" type="continuous">
        ...     <parent link="floor"/> <child link="plate"/>
        ...     <origin xyz="0 0 0.2"/> <axis xyz="0 0 1"/>
        ...   </joint>
        ... </robot>''')
        >>> arm.names, arm.joint_types, arm.frames
        (('turn',), ('continuous',), ('floor', 'plate'))
        """
    def __copy__(self) -> Chain:
        ...
    def __deepcopy__(self, arg0: dict) -> Chain:
        ...
    def __eq__(self, arg0: Chain) -> bool:
        ...
    def __getstate__(self) -> tuple:
        ...
    def __hash__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def __str__(self) -> str:
        ...
    def acceleration(self, q: numpy.typing.ArrayLike, qd: numpy.typing.ArrayLike, qdd: numpy.typing.ArrayLike, frame: str = 'world_aligned', of: str | int | None = None, kind: str = 'classical', point: numpy.typing.ArrayLike | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Acceleration of a frame, or of a point fixed to it, [linear, angular].
        
        'classical', the default, is what an accelerometer at the point feels besides gravity: the second
        derivative of its position. 'spatial' is the derivative of the twist, which rigid-body dynamics
        transforms like a twist. Their angular parts are equal, and with the velocity [v, w] in the same
        frame the linear parts are: classical = spatial + w x v.
        
        The derivative of J qd, jacobian(q) @ qdd + drift(q, qd), is the classical one in 'world_aligned'
        and the spatial one in 'body' and 'world'.
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        qd : (n,) or (N, n), rad/s and m/s
        qdd : (n,) or (N, n), rad/s^2 and m/s^2
            A single vector, here, in q or in qd, goes with every item of a batch.
        frame : str
            'world_aligned': of the point, axes of the world. 'body': the same, axes of the frame. 'world':
            of the point of the moving body that is now at the world's origin.
        of, point
            As for jacobian.
        kind : str
            'classical' or 'spatial'.
        out : (6,) or (N, 6) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (6,) or (N, 6), m/s^2 and rad/s^2
        
        Raises
        ------
        ValueError
            If q, qd, qdd or point has a wrong shape, is not finite or beyond 1e50, or there is no such
            frame or kind.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> arm = tk.Chain.from_dh([tk.DH(a=2.0, joint="revolute")])
        >>> arm.acceleration([0.0], [3.0], [0.5])
        array([-18. ,   1. ,   0. ,   0. ,   0. ,   0.5])
        >>> arm.acceleration([0.0], [3.0], [0.5], kind="spatial")
        array([0. , 1. , 0. , 0. , 0. , 0.5])
        """
    def analytic_jacobian(self, q: numpy.typing.ArrayLike, orientation: str = 'quaternion', of: str | int | None = None, point: numpy.typing.ArrayLike | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Derivative of position and orientation in coordinates: d[p, orientation]/dq.
        
        The geometric Jacobian's angular rows are a velocity, the derivative of no coordinates; these are
        derivatives of numbers, [M17] (3.9) of (3.3), as (3.10) and (3.11) need them.
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        orientation : str
            'quaternion': (w, x, y, z) with w >= 0, as in task_vector. At w = 0, where it jumps to its
            opposite, the derivative is that of the branch taken. 'rpy': roll, pitch, yaw as in transform.
        of, point
            As for jacobian; p is the position of the point.
        out : (7, n), (6, n) or batched float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (7, n) or (6, n), or a batch (N, 7, n) or (N, 6, n)
        
        Raises
        ------
        ValueError
            With 'rpy' at a pitch within 1e-9 rad of +-pi/2, where roll and yaw have no rates: which, and
            in which item of a batch (what `out` holds is undefined then). If q or point has a wrong shape or is not finite, or there is no such
            frame.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> arm = tk.Chain.from_dh([tk.DH(a=2.0, joint="revolute")])
        >>> arm.analytic_jacobian([0.0])[:, 0] + 0.0
        array([0. , 2. , 0. , 0. , 0. , 0. , 0.5])
        >>> arm.analytic_jacobian([0.0], orientation="rpy")[:, 0]
        array([0., 2., 0., 0., 0., 1.])
        """
    def base_pose(self, q: numpy.typing.ArrayLike, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Planar pose of the base (x, y, theta), as it stands in q, [M17] (3.4).
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        out : (3,) or (N, 3) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (3,) or (N, 3), m and rad
            theta is not wrapped.
        
        Raises
        ------
        ValueError
            If the robot has no omnidirectional base.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> tk.robots.thing().base_pose([0, 0, 0, 0, 0, 0, 1.0, 2.0, 0.5])
        array([1. , 2. , 0.5])
        """
    def condition_number(self, q: numpy.typing.ArrayLike, of: str | int | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> float | numpy.typing.NDArray[numpy.float64]:
        """
        Condition number kappa = sigma_max/sigma_min of the Jacobian, [M17] (4.32).
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        of : str or int, optional
            The frame that moves; default: the tool.
        out : () or (N,) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        float or (N,)
            inf with fewer than six joints or a lost rank.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> robot = tk.robots.thing()
        >>> q = robot.random(rng=0)
        >>> bool(np.isclose(robot.condition_number(q), np.linalg.cond(robot.jacobian(q))))
        True
        """
    def condition_number_gradient(self, q: numpy.typing.ArrayLike, of: str | int | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Gradient of the condition number (4.32).
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        of : str or int, optional
            The frame that moves; default: the tool.
        out : (n,) or (N, n) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (n,) or (N, n)
        
        Raises
        ------
        ValueError
            Where the largest or smallest singular value is repeated or zero: no gradient exists there.
            What `out` holds is undefined then.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> tk.robots.thing().condition_number_gradient([0, -1, 1, 0, 1, 0, 0, 0, 0]).shape
        (9,)
        """
    def dexterity(self, q: numpy.typing.ArrayLike, of: str | int | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> float | numpy.typing.NDArray[numpy.float64]:
        """
        The combined measure sqrt(kappa/M), [M17] (4.33): small is good.
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        of : str or int, optional
            The frame that moves; default: the tool.
        out : () or (N,) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        float or (N,)
            inf with fewer than six joints or a lost rank.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> robot = tk.robots.thing()
        >>> q = robot.random(rng=0)
        >>> f = np.sqrt(robot.condition_number(q) / robot.manipulability(q))
        >>> bool(np.isclose(robot.dexterity(q), f))
        True
        """
    def dexterity_gradient(self, q: numpy.typing.ArrayLike, of: str | int | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Gradient of sqrt(kappa/M), [M17] (4.33).
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        of : str or int, optional
            The frame that moves; default: the tool.
        out : (n,) or (N, n) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (n,) or (N, n)
        
        Raises
        ------
        ValueError
            Where the largest or smallest singular value is repeated or zero: no gradient exists there.
            What `out` holds is undefined then.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> tk.robots.thing().dexterity_gradient([0, -1, 1, 0, 1, 0, 0, 0, 0]).shape
        (9,)
        """
    def difference(self, q_from: numpy.typing.ArrayLike, q_to: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        The way from one configuration to another: q_to - q_from, the shorter way round.
        
        The difference of a continuous joint, for which q and q + 2 pi are the same place, is in [-pi, pi),
        exact to rounding after thousands of turns too. Other joints have limits, and cannot take the other
        way round: theirs is the plain difference. Where both are batches, row by row.
        
        Parameters
        ----------
        q_from, q_to : (n,) or (N, n), rad and m
        
        Returns
        -------
        (n,) or (N, n)
        
        Raises
        ------
        ValueError
            If a shape is wrong, the batches' lengths differ, or an entry is not finite.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> arm = tk.Chain.from_dh([tk.DH(joint="continuous"), tk.DH(a=1.0, joint="revolute")])
        >>> arm.difference([3.0, 3.0], [-3.0, -3.0]).round(4)
        array([ 0.2832, -6.    ])
        """
    def drift(self, q: numpy.typing.ArrayLike, qd: numpy.typing.ArrayLike, frame: str = 'world_aligned', of: str | int | None = None, point: numpy.typing.ArrayLike | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        The drift dJ/dt qd: the acceleration that is there without any qdd.
        
        J qdd + drift is the derivative of J qd, so that qdd = J^+ (a - drift) is what an acceleration a
        asks of the joints. It is jacobian_dot(q, qd) @ qd, without that matrix.
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        qd : (n,) or (N, n), rad/s and m/s
            A single vector, here or in q, goes with every item of a batch.
        frame, of, point
            As for jacobian.
        out : (6,) or (N, 6) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (6,) or (N, 6), m/s^2 and rad/s^2
            [linear, angular]. With 'world_aligned' its linear part is a classical acceleration, else a
            spatial one (see acceleration).
        
        Raises
        ------
        ValueError
            If q, qd or point has a wrong shape, is not finite or beyond 1e50, or there is no such frame.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> arm = tk.Chain.from_dh([tk.DH(a=2.0, joint="revolute")])
        >>> arm.drift([0.0], [3.0])  # centripetal
        array([-18.,   0.,   0.,   0.,   0.,   0.])
        """
    def fk(self, q: numpy.typing.ArrayLike, frame: str | int | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Forward kinematics: pose of a frame, [M17] (3.8).
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        frame : str or int, optional
            Name (or index) from `frames`; default: the last, the tool.
        out : (4, 4) or (N, 4, 4) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (4, 4) or (N, 4, 4)
            Pose in the root: T maps coordinates in the frame to the world.
        
        Raises
        ------
        ValueError
            If q or out has a wrong shape, q is not finite, or there is no such frame.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> tk.robots.thing().fk(np.zeros(9), frame="mount")[:3, 3]
        array([0.27 , 0.01 , 0.653])
        """
    def fk_all(self, q: numpy.typing.ArrayLike, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Poses of all frames, in the order of `frames`.
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        out : (F, 4, 4) or (N, F, 4, 4) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (F, 4, 4) or (N, F, 4, 4)
        
        Raises
        ------
        ValueError
            If q or out has a wrong shape or q is not finite.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> robot = tk.robots.ur5()
        >>> robot.fk_all(np.zeros(6)).shape == (len(robot.frames), 4, 4)
        True
        """
    def fk_and_jacobian(self, q: numpy.typing.ArrayLike, frame: str = 'world_aligned', of: str | int | None = None, *, out: tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]] | None = None, threads: typing.SupportsIndex | None = None) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
        """
        Pose and Jacobian of a frame, for little more than the price of one.
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        frame : str
            As in jacobian: 'world_aligned', 'body' or 'world'.
        of : str or int, optional
            The frame, from `frames`; default: the last, the tool.
        out : tuple of two float64 arrays in C order, shaped as T and J, optional
            Where the results go, and what is returned then; they share no memory.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        T : (4, 4) or (N, 4, 4)
        J : (6, n) or (N, 6, n)
        
        Raises
        ------
        ValueError
            If q has a wrong shape or is not finite, there is no such frame, or `out` is no such tuple or
            its arrays share memory.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> T, J = tk.robots.ur5().fk_and_jacobian([0.0, -1.0, 1.0, 0.0, 1.0, 0.0])
        >>> T.shape, J.shape
        ((4, 4), (6, 6))
        """
    def fk_quaternion(self, q: numpy.typing.ArrayLike, frame: str | int | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Forward kinematics as position and quaternion: less than half the memory of a matrix.
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        frame : str or int, optional
            Name (or index) from `frames`; default: the last, the tool.
        out : (7,) or (N, 7) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (7,) or (N, 7)
            [x, y, z, qw, qx, qy, qz] in the root, m; unit quaternion with qw >= 0. The first seven numbers
            of task_vector, [M17] (3.3), (3.5).
        
        Raises
        ------
        ValueError
            If q or out has a wrong shape, q is not finite, or there is no such frame.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> tk.robots.thing().fk_quaternion(np.zeros(9), frame="base") + 0.0
        array([0., 0., 0., 1., 0., 0., 0.])
        """
    def hessian(self, q: numpy.typing.ArrayLike, frame: str = 'world_aligned', of: str | int | None = None, point: numpy.typing.ArrayLike | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Exact derivative of the Jacobian: H[:, :, k] = dJ/dq_k.
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        frame, of, point
            As for jacobian.
        out : (6, n, n) or (N, 6, n, n) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (6, n, n) or (N, 6, n, n)
        
        Raises
        ------
        ValueError
            If q or point has a wrong shape or is not finite, or there is no such frame.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> robot, q = tk.robots.ur5(), np.full(6, 0.3)
        >>> step = 1e-6 * np.eye(6)[2]
        >>> central = (robot.jacobian(q + step) - robot.jacobian(q - step)) / 2e-6
        >>> np.allclose(robot.hessian(q)[:, :, 2], central, atol=1e-8)
        True
        """
    def jacobian(self, q: numpy.typing.ArrayLike, frame: str = 'world_aligned', of: str | int | None = None, point: numpy.typing.ArrayLike | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Geometric Jacobian, [M17] (3.12)-(3.15): [linear; angular] velocity = J qd.
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        frame : str
            'world_aligned': velocity of the point, axes of the world. 'body': the same, axes of the frame
            `of`. 'world': spatial twist, at the world's origin, whatever the point.
        of : str or int, optional
            The frame that moves, from `frames`; default: the last, the tool.
        point : (3,), m, optional
            A point fixed to that frame, by its coordinates in it; default: its origin.
        out : (6, n) or (N, 6, n) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (6, n) or (N, 6, n)
        
        Raises
        ------
        ValueError
            If q, point or out has a wrong shape, q or point is not finite, or there is no such frame.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> arm = tk.Chain.from_dh([tk.DH(a=2.0, joint="revolute")])
        >>> arm.jacobian([0.0])[:, 0]
        array([0., 2., 0., 0., 0., 1.])
        """
    def jacobian_dot(self, q: numpy.typing.ArrayLike, qd: numpy.typing.ArrayLike, frame: str = 'world_aligned', of: str | int | None = None, point: numpy.typing.ArrayLike | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Time derivative of the Jacobian, dJ/dt = sum_k dJ/dq_k qd_k, without the Hessian.
        
        It is the derivative of the numbers in `jacobian(q, frame, of, point)`. Not in the theses.
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        qd : (n,) or (N, n), rad/s and m/s
            A single vector, here or in q, goes with every item of a batch.
        frame, of, point
            As for jacobian.
        out : (6, n) or (N, 6, n) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (6, n) or (N, 6, n)
        
        Raises
        ------
        ValueError
            If q, qd or point has a wrong shape, is not finite or beyond 1e50, or there is no such frame.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> robot, q, qd = tk.robots.ur5(), np.full(6, 0.3), np.linspace(-1.0, 1.0, 6)
        >>> np.allclose(robot.jacobian_dot(q, qd), robot.hessian(q) @ qd)
        True
        """
    def manipulability(self, q: numpy.typing.ArrayLike, of: str | int | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> float | numpy.typing.NDArray[numpy.float64]:
        """
        Manipulability M = sqrt(det(J J^T)), [M17] (4.30).
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        of : str or int, optional
            The frame that moves; default: the tool.
        out : () or (N,) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        float or (N,)
            0 with fewer than six joints or a lost rank.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> robot = tk.robots.thing()
        >>> q = robot.random(rng=0)
        >>> J = robot.jacobian(q)
        >>> bool(np.isclose(robot.manipulability(q), np.sqrt(np.linalg.det(J @ J.T))))
        True
        """
    def manipulability_gradient(self, q: numpy.typing.ArrayLike, of: str | int | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Gradient of the manipulability, [M17] (4.31): (M/2) tr((J J^T)^-1 d(J J^T)/dq).
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        of : str or int, optional
            The frame that moves; default: the tool.
        out : (n,) or (N, n) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (n,) or (N, n)
            Zero with fewer than six joints or a lost rank.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> tk.robots.thing().manipulability_gradient([0, -1, 1, 0, 1, 0, 0, 0, 0]).shape
        (9,)
        """
    def random(self, n: typing.SupportsInt | typing.SupportsIndex | None = None, rng: typing.Any = None) -> typing.Any:
        """
        Configurations drawn uniformly within the limits.
        
        Exactly np.random.default_rng(rng).uniform(lower, upper, size); a joint that turns without limits,
        as a continuous one does, is drawn in +-pi, one with a single limit in the turn next to it.
        
        Parameters
        ----------
        n : int, optional
            How many; default: one, without a batch axis.
        rng : int or numpy.random.Generator, optional
            Seed or generator.
        
        Returns
        -------
        (dof,) or (n, dof)
        
        Raises
        ------
        ValueError
            If a prismatic joint has no limits.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> tk.robots.ur5().random(3, rng=0).shape
        (3, 6)
        """
    def task_jacobian(self, q: numpy.typing.ArrayLike, orientation: str = 'quaternion', *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Derivative ds/dq of the task vector, [M17] (3.9) of (3.5).
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        orientation : str
            'quaternion' or 'rpy', as for task_vector.
        out : (10, n), (9, n) or batched float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (10, n) or (9, n), or a batch (N, 10, n) or (N, 9, n)
        
        Raises
        ------
        ValueError
            If the robot has no omnidirectional base; with 'rpy' at a pitch within 1e-9 rad of +-pi/2, as
            for analytic_jacobian.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> robot = tk.robots.thing()
        >>> q = robot.random(rng=0)
        >>> step = 1e-6 * np.eye(9)[3]
        >>> central = (robot.task_vector(q + step) - robot.task_vector(q - step)) / 2e-6
        >>> np.allclose(robot.task_jacobian(q)[:, 3], central, atol=1e-8)
        True
        """
    def task_vector(self, q: numpy.typing.ArrayLike, orientation: str = 'quaternion', *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Task vector [p, quaternion w x y z, x, y, theta], [M17] (3.3)-(3.5).
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        orientation : str
            'quaternion': w >= 0. 'rpy': roll, pitch, yaw as in transform, in place of the quaternion (not
            in the theses); at a pitch of +-pi/2, where only one combination of roll and yaw is determined,
            roll is 0.
        out : (10,), (9,) or batched float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (10,) or (N, 10), with 'rpy' (9,) or (N, 9)
        
        Raises
        ------
        ValueError
            If the robot has no omnidirectional base.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> tk.robots.thing().task_vector(np.zeros(9)).shape
        (10,)
        """
    def to_urdf(self, name: str | None = None) -> str:
        """
        The chain as the text of a URDF: joints, limits and frames.
        
        Chain.from_urdf gives its kinematics back to rounding. Each frame is a link of its name; where a
        joint's frame is not on its axis, as in most Denavit-Hartenberg rows, there is one more link,
        '<frame>_joint'. A URDF cannot say everything: q is in the order of the joints from the root
        outwards, acceleration limits are left out, a base is three joints like any others, and a revolute
        joint without limits becomes continuous. Other infinite limits are written as the largest double.
        
        Parameters
        ----------
        name : str, optional
            Of the robot; default: the chain's.
        
        Returns
        -------
        str
        
        Raises
        ------
        ValueError
            If a name has control characters, which XML cannot hold.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> ur5 = tk.robots.ur5()
        >>> again = tk.Chain.from_urdf(ur5.to_urdf())
        >>> again.names == ur5.names, np.allclose(again.fk(np.ones(6)), ur5.fk(np.ones(6)), atol=1e-14)
        (True, True)
        """
    def velocity(self, q: numpy.typing.ArrayLike, qd: numpy.typing.ArrayLike, frame: str = 'world_aligned', of: str | int | None = None, point: numpy.typing.ArrayLike | None = None, *, out: numpy.typing.NDArray[numpy.float64] | None = None, threads: typing.SupportsIndex | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Velocity of a frame, or of a point fixed to it: J qd, [linear, angular].
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        qd : (n,) or (N, n), rad/s and m/s
            A single vector, here or in q, goes with every item of a batch.
        frame, of, point
            As for jacobian.
        out : (6,) or (N, 6) float64 array in C order, optional
            Where the result goes, and what is returned then.
        threads : int, optional
            At most so many; default: one, and for large batches all processors. The result is the same.
        
        Returns
        -------
        (6,) or (N, 6), m/s and rad/s
        
        Raises
        ------
        ValueError
            If q, qd or point has a wrong shape, is not finite or beyond 1e50, or there is no such frame.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> arm = tk.Chain.from_dh([tk.DH(a=2.0, joint="revolute")])
        >>> arm.velocity([0.0], [3.0])
        array([0., 6., 0., 0., 0., 3.])
        """
    def with_limits(self, *, lower: typing.Any = None, upper: typing.Any = None, velocity_limits: typing.Any = None, acceleration_limits: typing.Any = None) -> Chain:
        """
        The same chain with other limits.
        
        Parameters
        ----------
        lower, upper, velocity_limits, acceleration_limits : (n,), optional
            Each replaces the chain's own; inf means unlimited.
        
        Raises
        ------
        ValueError
            If a shape is wrong, limits are crossed, rates are not positive or a continuous joint is given
            a position limit.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> tk.robots.ur5().with_limits(upper=np.full(6, 3.0)).upper
        array([3., 3., 3., 3., 3., 3.])
        """
    def with_tool(self, tool: numpy.typing.ArrayLike, *, frame: str = 'tool') -> Chain:
        """
        The same chain with a fixed frame added at its end.
        
        A frame of the same name at the old end becomes 'flange' (flange2, ... if there is one).
        
        Parameters
        ----------
        tool : (4, 4)
            Pose of the tool in the last frame.
        frame : str
            Name of the new frame.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> robot = tk.robots.ur5().with_tool(tk.transform(xyz=(0, 0, 0.1)))
        >>> robot.frames[-2:]
        ('flange', 'tool')
        """
    @property
    def acceleration_limits(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Acceleration limits, (n,), rad/s^2 or m/s^2; inf: unlimited.
        """
    @property
    def base_joints(self) -> tuple[int, int, int] | None:
        """
        Places in q of the base's x, y and theta; None without an omnidirectional base.
        """
    @property
    def frames(self) -> tuple:
        """
        Names of all frames, from the root to the tool.
        """
    @property
    def joint_types(self) -> tuple:
        """
        'revolute', 'continuous' or 'prismatic', in the order of q.
        """
    @property
    def lower(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Lower position limits, (n,), rad or m.
        """
    @property
    def n(self) -> int:
        """
        Number of joints.
        """
    @property
    def name(self) -> str:
        """
        Name of the robot.
        """
    @property
    def names(self) -> tuple:
        """
        Names of the joints, in the order of q.
        """
    @property
    def upper(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Upper position limits, (n,), rad or m.
        """
    @property
    def velocity_limits(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Velocity limits, (n,), rad/s or m/s; inf: unlimited.
        """
class Exact:
    """
    Moore-Penrose inverse, [M17] (4.6), (4.9), for TaskPriority.
    
    Exact, and unbounded near singularities.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.Exact()
    Exact()
    """
    def __eq__(self, arg0: Exact) -> bool:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self) -> None:
        ...
    def __repr__(self) -> str:
        ...
class Damped:
    """
    Damped inverse J^T (J J^T + lambda I)^-1, [M17] (4.7), for TaskPriority.
    
    Parameters
    ----------
    damping : float, >= 0
        lambda itself, not its square.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.Damped(1e-3).damping
    0.001
    """
    def __eq__(self, arg0: Damped) -> bool:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, damping: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def damping(self) -> float:
        """
        lambda.
        """
class SelectivelyDamped:
    """
    Selectively damped inverse, [M17] (4.11), for TaskPriority.
    
    Buss & Kim (2005): each singular direction is damped by how far it would move the joints.
    
    Parameters
    ----------
    gamma_max : float, rad (m for prismatic joints)
        Largest absolute entry of a task's step; default pi/4.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.SelectivelyDamped(gamma_max=0.5).gamma_max
    0.5
    """
    def __eq__(self, arg0: SelectivelyDamped) -> bool:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, gamma_max: typing.SupportsFloat | typing.SupportsIndex = 0.7853981633974483) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def gamma_max(self) -> float:
        """
        Largest absolute entry of a step.
        """
class Task:
    """
    What TaskPriority can be asked to do: the base of all tasks.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> isinstance(tk.PoseTask(), tk.Task)
    True
    """
    @property
    def gain(self) -> float:
        """
        The step asks for gain * error, [M17] (4.3).
        """
    @property
    def of(self) -> str | None:
        """
        The frame it is about; None: the tool.
        """
class PoseTask(Task):
    """
    Bring a frame to a pose; target (4, 4).
    
    Parameters
    ----------
    gain : float > 0
        1 asks for the whole error in one step.
    of : str, optional
        The frame; default: the tool.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.PoseTask(gain=0.5)
    PoseTask(gain=0.5)
    """
    def __init__(self, gain: typing.SupportsFloat | typing.SupportsIndex = 1.0, *, of: str | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
class PositionTask(Task):
    """
    Bring a frame's origin to a point; target (3,), m.
    
    Parameters
    ----------
    gain : float > 0
    of : str, optional
        The frame; default: the tool.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.PositionTask(of="wrist_1")
    PositionTask(gain=1.0, of='wrist_1')
    """
    def __init__(self, gain: typing.SupportsFloat | typing.SupportsIndex = 1.0, *, of: str | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
class OrientationTask(Task):
    """
    Turn a frame to an orientation; target (3, 3).
    
    Parameters
    ----------
    gain : float > 0
    of : str, optional
        The frame; default: the tool.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.OrientationTask()
    OrientationTask(gain=1.0)
    """
    def __init__(self, gain: typing.SupportsFloat | typing.SupportsIndex = 1.0, *, of: str | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
class BaseTask(Task):
    """
    Bring the base to a planar pose; target (x, y, theta).
    
    The error of theta is wrapped to (-pi, pi].
    
    Parameters
    ----------
    gain : float > 0
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.BaseTask(gain=0.5)
    BaseTask(gain=0.5)
    """
    def __init__(self, gain: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> None:
        ...
    def __repr__(self) -> str:
        ...
class PostureTask(Task):
    """
    Bring all joints to a configuration; target (n,).
    
    The theta of a base and continuous joints go the short way round.
    
    Parameters
    ----------
    gain : float > 0
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.PostureTask(gain=0.1)
    PostureTask(gain=0.1)
    """
    def __init__(self, gain: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> None:
        ...
    def __repr__(self) -> str:
        ...
class SetTask(Task):
    """
    What TaskPriority with limits can be asked to keep in an interval: the base of those tasks.
    
    After Moe, Antonelli, Teel, Pettersen and Schrimpf (2016). Inside its interval it asks for nothing;
    a step may go to its end, and no further. Outside, the step takes away `gain` of the excess. An
    interval is kept to first order: one with a curved bound may be missed by the square of a step, and
    the next step takes that back.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> isinstance(tk.BaseObstacleTask(0.5), tk.SetTask)
    True
    """
class DistanceTask(SetTask):
    """
    Keep a frame's origin at a distance from a point; target (3,), m.
    
    Parameters
    ----------
    lower, upper : float, m
        The interval of the distance; upper may be inf (the default), lower 0.
    gain : float in (0, 1]
        The share of an excess that one step takes away.
    of : str, optional
        The frame; default: the tool.
    
    Raises
    ------
    ValueError
        If not 0 <= lower <= upper, or the gain is out of range.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.DistanceTask(lower=0.3, of="forearm")
    DistanceTask(lower=0.3, upper=inf, gain=1.0, of='forearm')
    """
    def __init__(self, lower: typing.SupportsFloat | typing.SupportsIndex = 0.0, upper: typing.SupportsFloat | typing.SupportsIndex = ..., gain: typing.SupportsFloat | typing.SupportsIndex = 1.0, *, of: str | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def lower(self) -> float:
        """
        The least distance, m.
        """
    @property
    def upper(self) -> float:
        """
        The largest distance, m.
        """
class BaseObstacleTask(SetTask):
    """
    Keep the base away from an obstacle; target: its center (x, y), m.
    
    ||p_base - p_obstacle|| >= R, [M17] (4.29) with its sign put right. The distance is a convex function
    of q, so that no step crosses the circle.
    
    Parameters
    ----------
    radius : float, m
        The least distance of the base's origin from the center.
    gain : float in (0, 1]
        The share of an excess that one step takes away.
    
    Raises
    ------
    ValueError
        If the radius is not positive, or the gain is out of range.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.BaseObstacleTask(radius=0.8)
    BaseObstacleTask(radius=0.8, gain=1.0)
    """
    def __init__(self, radius: typing.SupportsFloat | typing.SupportsIndex, gain: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def radius(self) -> float:
        """
        The least distance, m.
        """
class FieldOfViewTask(SetTask):
    """
    Keep a point in a camera's view; target: the point (3,), m.
    
    The angle between an axis of a frame and the direction from its origin to the point stays within a
    limit.
    
    Parameters
    ----------
    limit : float in (0, pi), rad
        Half the cone's opening.
    axis : (3,), optional
        Where the camera looks, in the frame; default: z.
    gain : float in (0, 1]
        The share of an excess that one step takes away.
    of : str, optional
        The frame; default: the tool.
    
    Raises
    ------
    ValueError
        If the limit, the axis or the gain is out of range.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.FieldOfViewTask(0.5).axis
    array([0., 0., 1.])
    """
    def __init__(self, limit: typing.SupportsFloat | typing.SupportsIndex, axis: typing.Any = None, gain: typing.SupportsFloat | typing.SupportsIndex = 1.0, *, of: str | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def axis(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        In the frame, of unit length.
        """
    @property
    def limit(self) -> float:
        """
        The largest angle, rad.
        """
class JointRangeTask(SetTask):
    """
    Keep joints in ranges narrower than their limits; target: None.
    
    Unlike the limits, which always hold, it has the priority of its place among the tasks.
    
    Parameters
    ----------
    lower, upper : (n,), rad and m
        -inf and inf for joints that are free.
    gain : float in (0, 1]
        The share of an excess that one step takes away.
    
    Raises
    ------
    ValueError
        If lower exceeds upper, or the gain is out of range.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> task = tk.JointRangeTask(np.full(9, -1.0), np.full(9, 1.0))
    >>> task.upper[0]
    np.float64(1.0)
    """
    def __init__(self, lower: numpy.typing.ArrayLike, upper: numpy.typing.ArrayLike, gain: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def lower(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        The ranges' lower ends, rad and m.
        """
    @property
    def upper(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        The ranges' upper ends, rad and m.
        """
class WheelLimits:
    """
    Speed limit of a mecanum base's wheels, for TaskPriority with limits.
    
    The wheels' speeds are the inverse of [M17] (3.20): (v_x - v_y - k omega)/R front left,
    (v_x + v_y - k omega)/R rear left, (v_x - v_y + k omega)/R rear right and (v_x + v_y + k omega)/R
    front right, v and omega the base's velocity in its own axes.
    
    Parameters
    ----------
    radius : float, m
        R, of a wheel.
    k : float, m
        Half the wheel base plus half the track.
    speed : float, rad/s
        The fastest that a wheel may turn, either way.
    
    Raises
    ------
    ValueError
        If one of them is not positive or not finite.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.WheelLimits(radius=0.1, k=0.5, speed=10.0)
    WheelLimits(radius=0.1, k=0.5, speed=10.0)
    """
    def __eq__(self, arg0: WheelLimits) -> bool:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, radius: typing.SupportsFloat | typing.SupportsIndex, k: typing.SupportsFloat | typing.SupportsIndex, speed: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def k(self) -> float:
        """
        Half the wheel base plus half the track, m.
        """
    @property
    def radius(self) -> float:
        """
        R of a wheel, m.
        """
    @property
    def speed(self) -> float:
        """
        The largest speed, rad/s.
        """
class LimitedStep:
    """
    One step of TaskPriority with limits, explained.
    
    A level is a task, highest priority first.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> solver = tk.TaskPriority(robot, [tk.BaseTask()], limits=True, dt=0.1, step_limit=0.05)
    >>> step = solver.solve(np.zeros(9), [(0.1, 0.02, 0.0)])
    >>> step.active_limits
    array([0, 0, 0, 0, 0, 0, 1, 0, 0], dtype=int8)
    >>> step.limit_kinds[6], step.residuals[0].round(3) + 0.0, step.status
    ('step', array([-0.05,  0.  ,  0.  ]), 'optimal')
    """
    def __repr__(self) -> str:
        ...
    @property
    def active_intervals(self) -> list:
        """
        Of each set-based task's rows, int8: 1 where the step leads to the upper end or beyond, -1 the lower; empty for other tasks.
        """
    @property
    def active_limits(self) -> numpy.typing.NDArray[numpy.int8]:
        """
        (n,), int8: 1 where dq is at its upper bound, -1 at its lower, 0 between.
        """
    @property
    def active_wheels(self) -> numpy.typing.NDArray[numpy.int8]:
        """
        (4,), int8: 1 or -1 where a wheel is at its limit; front left, rear left, rear right, front right.
        """
    @property
    def dq(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        The step, (n,).
        """
    @property
    def errors(self) -> list:
        """
        Error of each task before its gain; of a set-based task what leads back into its interval, zero inside.
        """
    @property
    def iterations(self) -> int:
        """
        Of the active set, all levels together; 0 if nothing was in the way.
        """
    @property
    def limit_kinds(self) -> list:
        """
        What each of these bounds comes from: 'position', 'velocity', 'acceleration', 'step', or '' between them.
        """
    @property
    def residuals(self) -> list:
        """
        What each level misses: J dq - gain * error; of a set-based task how far J dq is outside of what the interval allows, below negative.
        """
    @property
    def status(self) -> str:
        """
        'optimal', or 'iteration_limit': limits and priorities hold, but a level may not be at its best.
        """
class TaskPriorityStep:
    """
    One step of TaskPriority, explained.
    
    A level is a task, highest priority first; the free null-space motion, if any, comes last.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> solver = tk.TaskPriority(robot, [tk.BaseTask()])
    >>> step = solver.solve(np.zeros(9), [(0.1, 0.2, 0.3)])
    >>> step.errors[0]
    array([0.1, 0.2, 0.3])
    """
    def __repr__(self) -> str:
        ...
    @property
    def contributions(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (levels, n), each in the null space of the levels above it, before the step limit.
        """
    @property
    def dq(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        The step, (n,): the sum of scale * contribution.
        """
    @property
    def errors(self) -> list:
        """
        Error of each task before its gain; empty for the null-space motion.
        """
    @property
    def limited(self) -> bool:
        """
        Whether the step limit took anything away.
        """
    @property
    def scales(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (levels,): what the step limit left of each, 0 to 1.
        """
    @property
    def singular_values(self) -> list:
        """
        Of the matrix that each level inverted, before any filter.
        """
class TaskPriority:
    """
    Prioritized inverse differential kinematics, [M17] 4.3.
    
    The first task is met as well as it can be; each further one moves only in what the tasks before it
    leave free, so that it never disturbs them, also when the inverse is damped or filtered. With tasks
    [PoseTask(), BaseTask()] and scheme 'chiaverini' this is the motion scheme (4.18).
    
    With limits=True each step is a bounded least-squares problem in strict order: it keeps the robot's
    position, velocity and acceleration limits, the wheels' speeds and the intervals of set-based tasks,
    and each task is met as well as these and the tasks before it allow. Without, limits are not looked
    at.
    
    A solver is immutable: any number of threads may share it.
    
    Parameters
    ----------
    robot : Chain
    tasks : sequence of Task
        Highest priority first, at most 16 (two for 'nakamura').
    scheme : str
        'nakamura': (4.16). 'siciliano': the same recursion for any number of tasks; exact, but unbounded
        where a lower task conflicts with a higher one. 'chiaverini': (4.17); stays bounded there, and
        converges more slowly. Default 'chiaverini', with limits 'siciliano', which is least squares.
    inverse : Exact, Damped or SelectivelyDamped
        Default SelectivelyDamped(pi/4), with limits Damped(1e-4); SelectivelyDamped is none for limits.
    singular_value_filter : SingularValueFilter, optional
        Applied to each inverted matrix first.
    step_limit : float or (n,), optional
        Largest |dq| of each joint, rad or m. Scales each task's contribution, lowest priority first, and
        never the sum: the direction in which a higher task moves does not change. With limits one more
        bound of the least squares, which may change that direction to come nearer.
    limits : bool
        Default False.
    dt : float, s
        Duration of a step, with limits: a joint moves by at most velocity limit * dt.
    wheel_limits : WheelLimits, optional
        With limits, for a mecanum base.
    
    Raises
    ------
    ValueError
        If a task, frame, scheme or limit does not fit the robot, or an option the others.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> q = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
    >>> T_goal = robot.fk(q + 0.1)
    >>> solver = tk.TaskPriority(robot, tasks=[tk.PoseTask(), tk.BaseTask(gain=0.5)])
    >>> for _ in range(100):
    ...     q = q + solver.step(q, [T_goal, (0.2, 0.0, 0.1)])
    >>> bool(np.linalg.norm(tk.pose_error(robot.fk(q), T_goal)) < 1e-6)
    True
    """
    def __init__(self, robot: Chain, tasks: collections.abc.Sequence[Task], *, scheme: str | None = None, inverse: Exact | Damped | SelectivelyDamped | None = None, singular_value_filter: SingularValueFilter | None = None, step_limit: typing.Any = None, limits: bool = False, dt: typing.SupportsFloat | typing.SupportsIndex | None = None, wheel_limits: WheelLimits | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def solve(self, q: numpy.typing.ArrayLike, targets: collections.abc.Sequence, null_motion: typing.Any = None, previous: typing.Any = None) -> TaskPriorityStep | LimitedStep:
        """
        As step, with what each task contributed.
        
        Parameters
        ----------
        q, targets, null_motion, previous
            As for step.
        
        Returns
        -------
        TaskPriorityStep
            With limits a LimitedStep.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> robot = tk.robots.thing()
        >>> q = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
        >>> solver = tk.TaskPriority(robot, [tk.PoseTask(), tk.BaseTask()], step_limit=0.05)
        >>> step = solver.solve(q, [robot.fk(q), (1.0, 0.0, 0.0)])
        >>> step.limited, bool(abs(step.dq).max() <= 0.05)
        (True, True)
        """
    def step(self, q: numpy.typing.ArrayLike, targets: collections.abc.Sequence, null_motion: typing.Any = None, previous: typing.Any = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        One step dq towards the targets; q + dq is the next configuration.
        
        Allocates no memory in the core and releases the GIL.
        
        Parameters
        ----------
        q : (n,), rad and m
        targets : sequence
            One a task: (4, 4) for a pose, (3, 3) for an orientation, (3,) for a position or a base pose,
            (n,) for a posture; None where a task has no target.
        null_motion : (n,), optional
            The z of (4.16), (4.17): motion wanted where all tasks leave the robot free.
        previous : (n,), optional
            With limits, the step before this one: the acceleration, (dq - previous)/dt^2, is limited too, and
            speeds to what can still be stopped before a position limit. Default: the acceleration is free.
        
        Returns
        -------
        (n,)
        
        Raises
        ------
        ValueError
            If a shape does not fit, a number is not finite or a pose is not rigid.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> robot = tk.robots.thing()
        >>> q = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
        >>> solver = tk.TaskPriority(robot, [tk.PositionTask()])
        >>> solver.step(q, [robot.fk(q)[:3, 3]]) + 0.0  # there already
        array([0., 0., 0., 0., 0., 0., 0., 0., 0.])
        """
    @property
    def limits(self) -> bool:
        """
        Whether steps are bounded.
        """
    @property
    def robot(self) -> Chain:
        """
        The chain.
        """
    @property
    def scheme(self) -> str:
        """
        'nakamura', 'siciliano' or 'chiaverini'.
        """
class IkSolutions:
    """
    What ik_all found: a sequence of configurations.
    
    len(), iteration and indexing are those of q, and numpy takes it for q. Which solutions are worth
    having, and why there are none, is said beside it.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> arm = tk.robots.ur5()
    >>> solutions = tk.ik_all(arm, arm.fk([0.1, -1.2, 1.4, -0.6, 1.2, 0.0]))
    >>> solutions
    IkSolutions(8 solutions)
    >>> np.asarray(solutions).shape, solutions.exact.all().item()
    ((8, 6), True)
    """
    def __array__(self, dtype: typing.Any = None, copy: typing.Any = None) -> typing.Any:
        ...
    def __getitem__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __iter__(self) -> collections.abc.Iterator:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def exact(self) -> numpy.typing.NDArray[numpy.bool]:
        """
        (k,) bool: whether both errors are at most 1e-9.
        """
    @property
    def message(self) -> str:
        """
        The same in words, with numbers.
        """
    @property
    def position_error(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (k,), m: distance from the target, by forward kinematics.
        """
    @property
    def q(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (k, n), rad and m: one solution a row.
        """
    @property
    def rotation_error(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (k,), rad: angle from the target, by forward kinematics.
        """
    @property
    def singular(self) -> list[str | None]:
        """
        For each solution 'shoulder', 'elbow' or 'wrist' where two branches meet, within 1e-6 rad or so; else None.
        """
    @property
    def status(self) -> str:
        """
        'solved'; 'outside_limits': reached, but only beyond joint limits, and so empty; 'unreachable': what is here comes closest.
        """
class IkResult:
    """
    What an inverse kinematics solver found, and why not more.
    
    q is always finite and within the limits, also without success: then it is the best that was found.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> arm = tk.robots.ur10()
    >>> result = tk.ik(arm, tk.transform(xyz=(0.0, 0.0, 5.0)))
    >>> result.success, result.status
    (False, 'unreachable')
    >>> bool(result.position_error > 3.5)
    True
    """
    def __repr__(self) -> str:
        ...
    @property
    def active_limits(self) -> numpy.typing.NDArray[numpy.int8]:
        """
        (n,) int8: -1 where the joint is at its lower limit, 1 at its upper.
        """
    @property
    def iterations(self) -> int:
        """
        Of all attempts together.
        """
    @property
    def message(self) -> str:
        """
        The status in a sentence.
        """
    @property
    def position_error(self) -> float:
        """
        Distance from the target, m, of the coordinates that count.
        """
    @property
    def q(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,), rad and m.
        """
    @property
    def restarts(self) -> int:
        """
        Attempts after the first.
        """
    @property
    def rotation_error(self) -> float:
        """
        Angle from the target, rad, of the coordinates that count.
        """
    @property
    def status(self) -> str:
        """
        How it ended.
        
        'success'; 'unreachable': no pose found is nearer, and no limit holds the robot back; 'limited': joint
        limits do; 'step_bound': max_step does; 'budget' or 'deadline': ran out.
        """
    @property
    def success(self) -> bool:
        """
        Whether the target is met within tolerance and limits, by forward kinematics of q.
        """
    @property
    def time(self) -> float:
        """
        Seconds.
        """
class IkBatchResult:
    """
    The results for many targets: an array a field.
    
    len(results) targets; results[i] is the IkResult of target i.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> arm = tk.robots.ur5()
    >>> results = tk.ik(arm, arm.fk(arm.random(3, rng=0)))
    >>> results.q.shape, bool(results.success.all()), results[0].status
    ((3, 6), True, 'success')
    """
    def __getitem__(self, i: typing.SupportsInt | typing.SupportsIndex) -> IkResult:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def active_limits(self) -> numpy.typing.NDArray[numpy.int8]:
        """
        (N, n) int8, -1, 0 or 1.
        """
    @property
    def iterations(self) -> numpy.typing.NDArray[numpy.int32]:
        """
        (N,).
        """
    @property
    def message(self) -> list:
        """
        A list of N sentences.
        """
    @property
    def position_error(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N,), m.
        """
    @property
    def q(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, n), rad and m.
        """
    @property
    def restarts(self) -> numpy.typing.NDArray[numpy.int32]:
        """
        (N,).
        """
    @property
    def rotation_error(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N,), rad.
        """
    @property
    def status(self) -> typing.Any:
        """
        (N,) str: see IkResult.
        """
    @property
    def success(self) -> numpy.typing.NDArray[numpy.bool]:
        """
        (N,) bool.
        """
    @property
    def time(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N,), seconds.
        """
class NumericIk:
    """
    Numerical inverse kinematics of any chain.
    
    A damped Gauss-Newton descent (Levenberg-Marquardt with the damping in proportion to the cost,
    Sugihara 2011) on the exact Jacobian of the log error (4.28). It never leaves the joint limits, gives
    up early where it stalls and begins anew, from the best of a few low-discrepancy samples. What it
    calls a success is checked by forward kinematics. The result depends on target, seed and options
    alone.
    
    Immutable: any number of threads may share one. For a control loop: tk.ik makes one a call.
    
    Parameters
    ----------
    chain : Chain
    frame : str or int, optional
        The frame that is to reach the target; default the last.
    task : str
        'pose': targets (4, 4). 'position': targets (3,), m, any orientation. 'orientation': targets
        (3, 3), any position.
    weights : (6,), optional
        How much each coordinate [x, y, z, rx, ry, rz] matters; 0: it is free. Default ones.
    weight_axes : str
        The axes they are of: 'target' or 'world'. Weights (1, 1, 1, 1, 1, 0) of the target leave the
        hand's turn about its own z free.
    position_tolerance, rotation_tolerance : float > 0
        m and rad, of the coordinates that count.
    joint_weights : float or (n,), optional
        Cost of each joint's motion, 1e-6 to 1e6: a joint with a larger weight moves less. Default ones.
    max_step : float or (n,), optional
        How far from the seed each joint may be, rad and m. Fails rather than jumps. Needs a seed.
    nearest : bool
        Search on for the solution nearest to the seed, by joint_weights. Needs a seed.
    objective : str
        What to do with freedom that is left: 'none'; 'seed': stay near it; 'limits': keep to the middle
        of the joint ranges; 'manipulability': (4.30). A local optimum.
    max_iterations, max_restarts : int
        Of one target, all attempts together.
    deadline : float, optional
        Seconds for one target. With it, results are no longer the same on any machine.
    rng : int or numpy.random.Generator
        Which restarts are tried.
    closed_form : bool
        Whether an arm that has a closed form (see ik_all) restarts from its solutions.
    
    Raises
    ------
    ValueError
        If an option does not fit the chain.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> arm = tk.robots.ur10()
    >>> solver = tk.NumericIk(arm, max_step=0.1)
    >>> q = np.array([0.1, -1.0, 1.2, -0.5, 0.8, 0.0])
    >>> result = solver.solve(arm.fk(q + 0.05), seed=q)
    >>> result.success, bool(np.abs(result.q - q).max() < 0.1)
    (True, True)
    """
    def __init__(self, chain: Chain, *, frame: str | int | None = None, task: str = 'pose', weights: numpy.typing.ArrayLike | None = None, weight_axes: str = 'target', position_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-07, rotation_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-07, joint_weights: numpy.typing.ArrayLike | None = None, max_step: numpy.typing.ArrayLike | None = None, nearest: bool = False, objective: str = 'none', max_iterations: typing.SupportsInt | typing.SupportsIndex = 12000, max_restarts: typing.SupportsInt | typing.SupportsIndex = 400, deadline: typing.SupportsFloat | typing.SupportsIndex | None = None, rng: typing.SupportsIndex | numpy.random.Generator = 0, closed_form: bool = True) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def solve(self, target: numpy.typing.ArrayLike, seed: numpy.typing.ArrayLike | None = None, *, threads: typing.SupportsIndex | None = None) -> typing.Any:
        """
        Solves one target or many.
        
        Parameters
        ----------
        target : (4, 4), (3,) or (3, 3), or N of them
            As the task says, in the root.
        seed : (n,) or (N, n), optional
            Where to begin; brought into the limits first. One for all targets, or one a target.
        threads : int, optional
            At most; by default as many as pay. The result does not depend on it.
        
        Returns
        -------
        IkResult or IkBatchResult
        
        Raises
        ------
        ValueError
            If a shape does not fit, a number is not finite or a pose is not rigid; if the options need a
            seed and there is none.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> robot = tk.robots.thing()
        >>> targets = robot.fk(robot.random(4, rng=1))
        >>> tk.NumericIk(robot).solve(targets)
        IkBatchResult(4 of 4 reached)
        """
    @property
    def chain(self) -> typing.Any:
        """
        The chain.
        """
def filter_singular_values(J: numpy.typing.ArrayLike, sigma0: typing.SupportsFloat | typing.SupportsIndex, nu: typing.SupportsFloat | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
    """
    The matrix with its singular values lifted, [M17] (4.13).
    
    Parameters
    ----------
    J : (m, n) or (N, m, n)
    sigma0, nu : float
        See SingularValueFilter.
    
    Returns
    -------
    The same shape; no singular value is below sigma0.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> rank_one = np.array([[3.0, 0.0], [0.0, 0.0]])
    >>> tk.filter_singular_values(rank_one, sigma0=0.01, nu=10.0).round(3)
    array([[3.  , 0.  ],
           [0.  , 0.01]])
    """
def has_closed_form(chain: Chain, frame: str | int | None = None) -> bool:
    """
    Whether ik_all takes this chain.
    
    Parameters
    ----------
    chain : Chain
    frame : str or int, optional
        Name (or index) from `frames`; default: the last, the tool.
    
    Returns
    -------
    bool
    
    Raises
    ------
    ValueError
        If there is no such frame.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.has_closed_form(tk.robots.ur10()), tk.has_closed_form(tk.robots.ur10(), "forearm")
    (True, False)
    """
def ik(chain: Chain, target: numpy.typing.ArrayLike, seed: numpy.typing.ArrayLike | None = None, *, frame: str | int | None = None, task: str = 'pose', weights: numpy.typing.ArrayLike | None = None, weight_axes: str = 'target', position_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-07, rotation_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-07, joint_weights: numpy.typing.ArrayLike | None = None, max_step: numpy.typing.ArrayLike | None = None, nearest: bool = False, objective: str = 'none', max_iterations: typing.SupportsInt | typing.SupportsIndex = 12000, max_restarts: typing.SupportsInt | typing.SupportsIndex = 400, deadline: typing.SupportsFloat | typing.SupportsIndex | None = None, rng: typing.SupportsIndex | numpy.random.Generator = 0, closed_form: bool = True, threads: typing.SupportsIndex | None = None) -> typing.Any:
    """
    Joint angles that bring a frame to a target.
    
    Never raises because there is no solution: the result says why, and is as near as could be.
    
    Parameters
    ----------
    chain : Chain
    target : (4, 4) or (N, 4, 4)
        In the root; (3,) for task='position', (3, 3) for task='orientation'.
    seed : (n,) or (N, n), optional
        Where to begin; brought into the limits first.
    frame, task, weights, weight_axes, position_tolerance, rotation_tolerance, joint_weights, max_step, nearest, objective, max_iterations, max_restarts, deadline, rng, closed_form
        See NumericIk.
    threads : int, optional
        At most, for many targets; by default as many as pay. The result does not depend on it.
    
    Returns
    -------
    IkResult or IkBatchResult
    
    Raises
    ------
    ValueError
        If an argument does not fit the chain; if nearest, max_step or objective='seed' have no seed.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> T = robot.fk(robot.random(rng=5))
    >>> result = tk.ik(robot, T, seed=np.zeros(9))
    >>> result.success, bool(np.allclose(robot.fk(result.q), T, atol=1e-6))
    (True, True)
    >>> tk.ik(robot, (1.0, 2.0, 50.0), task="position").status
    'unreachable'
    """
def ik_all(chain: Chain, target: numpy.typing.ArrayLike, *, seed: typing.Any = None, base: typing.Any = None, frame: str | int | None = None, respect_limits: bool = True, images: bool = False, weights: typing.Any = None) -> IkSolutions:
    """
    Every configuration of a six-joint arm for a pose, in closed form.
    
    For arms with three parallel axes (2, 3, 4 or 3, 4, 5), such as those of Universal Robots, and arms
    with a spherical wrist (axes 4, 5, 6 meet) or shoulder (1, 2, 3), on a base or not; their axes decide,
    not their names. Up to eight branches by subproblems after Pieper (1968), Paden (1986), and Elias and
    Wen (2022), each checked by forward kinematics, and polished where rounded dimensions ask for it.
    
    A joint stands at the turn that is within its limits and nearest to the seed's, or without a seed to
    the middle of its range (0 if it has none). Where a joint is free, at a singularity, it stays there:
    the last of the wrist (in an arm that is solved from its hand, the first), as far as the elbow reaches
    if that moves it; joint 1 where the wrist's center is on its axis, joint 2 where it is on that.
    
    Parameters
    ----------
    chain : Chain
    target : (4, 4)
        Pose of the frame in the root.
    seed : (n,), rad and m, optional
        Solutions come nearest first. Without it: in a fixed order, by shoulder, then wrist, then elbow,
        or for a spherical wrist by shoulder, elbow, wrist.
    base : (3,), optional
        x, y (m) and theta (rad) of the base, for a chain on one: solutions are for this place.
    frame : str or int, optional
        Name (or index) from `frames`, behind the last joint; default: the last, the tool.
    respect_limits : bool
        Leave out what is beyond joint limits in every turn.
    images : bool
        All turns of all joints that are within limits, not only the nearest. At most 100 000.
    weights : (n,), optional
        Of the squared differences in the distance to the seed; default 1.
    
    Returns
    -------
    IkSolutions
        Where the arm can't reach the target, the closest it comes (m and rad count alike), marked as
        not exact; where it only can beyond its limits, nothing; the message says so.
    
    Raises
    ------
    ValueError
        If the arm has no closed form here, an argument has a wrong shape or is not finite, the target is
        not rigid, or the base is missing or beyond its limits.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> q = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.3, -0.2, 0.4])
    >>> solutions = tk.ik_all(robot, robot.fk(q), seed=q, base=q[6:])
    >>> len(solutions), np.allclose(solutions[0], q, atol=1e-9)
    (8, True)
    >>> tk.ik_all(robot, tk.transform(xyz=(0, 0, 3)), base=(0, 0, 0)).status
    'unreachable'
    """
def null_space(J: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Orthonormal basis of the null space of a matrix.
    
    Singular values up to max(m, n) eps sigma_1 count as zero.
    
    Parameters
    ----------
    J : (m, n), at most 32 on a side
    
    Returns
    -------
    (n, n - rank)
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> abs(tk.null_space(np.array([[1.0, 0.0]])))
    array([[0.],
           [1.]])
    """
def null_space_projector(J: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    The exact orthogonal projector I - J^+ J onto the null space, [M17] (4.15).
    
    Built from the null space itself: I - J# J with a damped or filtered inverse is no projector.
    
    Parameters
    ----------
    J : (m, n) or (N, m, n), at most 32 on a side
    
    Returns
    -------
    (n, n) or (N, n, n)
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> tk.null_space_projector(np.array([[1.0, 0.0]])) + 0.0
    array([[0., 0.],
           [0., 1.]])
    """
def on_omni_base(arm: Chain, mount: typing.Any = None, *, base_limits: typing.Any = None, order: str = 'arm_first', base_velocity_limits: typing.Any = None, base_acceleration_limits: typing.Any = None, name: str = '') -> Chain:
    """
    An arm on an omnidirectional base: three virtual joints x, y, theta, [M17] 3.2.
    
    Parameters
    ----------
    arm : Chain
        Without a base of its own.
    mount : (4, 4), optional
        Pose of the arm's root in the base frame; default: the identity.
    base_limits : three pairs (lower, upper), optional
        Of x (m), y (m), theta (rad); default +-5 m and +-pi.
    order : 'arm_first' or 'base_first'
        q = [q0 ..., x, y, theta], [M17] (3.6), or [x, y, theta, q0 ...].
    base_velocity_limits, base_acceleration_limits : three floats, optional
        Default: unlimited.
    name : str
    
    Raises
    ------
    ValueError
        If the arm has a base, the mount is no rigid transform, or a name or limit is wrong.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> robot = tk.on_omni_base(tk.robots.ur5(), mount=tk.transform(xyz=(0.1, 0, 0.5)))
    >>> robot.names
    ('q0', 'q1', 'q2', 'q3', 'q4', 'q5', 'x', 'y', 'theta')
    """
def pinv(J: numpy.typing.ArrayLike, *, damping: typing.Any = None, singular_value_filter: SingularValueFilter | None = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    Pseudoinverse of a matrix: exact, damped or selectively damped.
    
    Exact, [M17] (4.9): singular values up to max(m, n) eps sigma_1 count as zero. Damped, (4.10):
    sigma/(sigma^2 + lambda), which is J^T (J J^T + lambda I)^-1 of (4.7). Selectively damped in matrix
    form, (4.11): one lambda for each singular value, largest first. For the step of Buss & Kim, which
    chooses them by the error, see selectively_damped_step.
    
    Parameters
    ----------
    J : (m, n) or (N, m, n), at most 32 on a side
    damping : float or (min(m, n),), >= 0, optional
        lambda. Note: lambda itself, not its square.
    singular_value_filter : SingularValueFilter, optional
        Applied to the singular values first.
    
    Returns
    -------
    (n, m) or (N, n, m)
    
    Raises
    ------
    ValueError
        If J or damping has a wrong shape, is not finite or damping is negative.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> tk.pinv(np.array([[2.0, 0.0], [0.0, 0.0]]))
    array([[0.5, 0. ],
           [0. , 0. ]])
    >>> tk.pinv(np.array([[2.0, 0.0], [0.0, 0.0]]), damping=1.0)
    array([[0.4, 0. ],
           [0. , 0. ]])
    """
def pose_error(T: numpy.typing.ArrayLike, T_goal: numpy.typing.ArrayLike, *, frame: str = 'world_aligned', method: str = 'log') -> numpy.typing.NDArray[numpy.float64]:
    """
    What is missing from one pose to another, [linear, angular], [M17] (3.16)-(3.18), (4.28).
    
    pose_error(fk(q), fk(q + dq)) is J dq to first order, with the default Jacobian.
    
    Parameters
    ----------
    T, T_goal : (4, 4) or (N, 4, 4)
        A single pose goes with every one of a batch.
    frame : str
        'world_aligned': [p_goal - p; log(R_goal R^T)], axes of the world. 'body': log(T^-1 T_goal) on
        SE(3), axes of T.
    method : str
        'log': valid up to half a turn, where the sign of the axis is chosen as in so3_log. 'cross':
        (3.18) as printed, tan(angle) axis, only below a quarter turn; in the body frame its parts are
        turned into the axes of T.
    
    Returns
    -------
    (6,) or (N, 6), m and rad
    
    Raises
    ------
    ValueError
        If a pose is not rigid, or 'cross' is asked for a quarter turn or more.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.pose_error(tk.transform(), tk.transform(xyz=(1, 0, 0), rpy=(0, 0, 0.5)))
    array([1. , 0. , 0. , 0. , 0. , 0.5])
    """
def selectively_damped_step(J: numpy.typing.ArrayLike, e: numpy.typing.ArrayLike, gamma_max: typing.SupportsFloat | typing.SupportsIndex = 0.7853981633974483, *, blocks: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex] | None = None, singular_value_filter: SingularValueFilter | None = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    Selectively damped least-squares step for J dq = e, [M17] (4.11), Buss & Kim (2005).
    
    Each singular direction is clamped by how much it would move the joints for what it moves the task.
    
    Parameters
    ----------
    J : (m, n), at most 32 on a side
    e : (m,)
    gamma_max : float, rad (m for prismatic joints)
        Largest absolute entry of the step.
    blocks : sequence of int, optional
        Rows of each end-effector block. Default: (3, 3), linear and angular, for six rows, else one.
    singular_value_filter : SingularValueFilter, optional
        Applied to the singular values first.
    
    Returns
    -------
    (n,)
    
    Raises
    ------
    ValueError
        If a shape does not fit, a number is not finite or gamma_max is not positive.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> nearly_singular = np.diag([1.0, 1e-9])  # its pseudoinverse would ask for 1e8
    >>> tk.selectively_damped_step(nearly_singular, [0.1, 0.1], gamma_max=0.5)
    array([0.1, 0.5])
    """
def simd_level() -> str:
    """
    Which instructions the kinematics use: 'baseline', 'avx2' or 'avx512'.
    
    The best of this processor, unless use_simd_level() chose another.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.simd_level() in ("baseline", "avx2", "avx512")
    True
    """
def transform(xyz: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), rpy: typing.Any = None, quaternion: typing.Any = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    Homogeneous matrix of a position and an orientation.
    
    Parameters
    ----------
    xyz : (3,), m
    rpy : (3,), rad, optional
        Roll, pitch, yaw as in URDF: R = Rz(yaw) Ry(pitch) Rx(roll).
    quaternion : (4,), optional
        (w, x, y, z), instead of rpy.
    
    Returns
    -------
    (4, 4)
    
    Raises
    ------
    ValueError
        If both rpy and quaternion are given, or one is malformed.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.transform(xyz=(1, 2, 3))
    array([[1., 0., 0., 1.],
           [0., 1., 0., 2.],
           [0., 0., 1., 3.],
           [0., 0., 0., 1.]])
    """
def use_simd_level(level: str) -> None:
    """
    Choose the instructions that the kinematics use, in all threads.
    
    For comparing results and speeds; all levels agree to a few units in the last place.
    
    Parameters
    ----------
    level : str
        'baseline', 'avx2' or 'avx512'.
    
    Raises
    ------
    ValueError
        If this processor does not have it.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> best = tk.simd_level()
    >>> tk.use_simd_level("baseline")
    >>> tk.simd_level()
    'baseline'
    >>> tk.use_simd_level(best)
    """
MAX_DOF: int = 32
__version__: str = '0.1.0'
