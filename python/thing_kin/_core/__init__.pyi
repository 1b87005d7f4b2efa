"""
The C++ core of thing_kin. Private: import its names from thing_kin.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.random
import numpy.typing
import os
import thing_kin.path_plan
import typing
from . import lie
from . import robots
from . import terms
__all__: list[str] = ['BaseObstacleTask', 'BaseTask', 'Box', 'Capsule', 'Chain', 'DH', 'Damped', 'DerivativeCheck', 'Disc', 'DistanceTask', 'Exact', 'FieldOfViewTask', 'FollowerStep', 'HalfSpace', 'IkBatchResult', 'IkResult', 'IkSolutions', 'JointRangeTask', 'LimitedStep', 'LinkSpheres', 'MAX_DOF', 'NumericIk', 'OrientationTask', 'PathFollower', 'PosePlan', 'PosePlanner', 'PoseTask', 'PositionTask', 'PostureTask', 'Problem', 'ProblemValue', 'SelectivelyDamped', 'SetTask', 'SingularValueFilter', 'Sphere', 'SqpResult', 'SqpTrace', 'Task', 'TaskPriority', 'TaskPriorityStep', 'WheelLimits', 'check_derivatives', 'filter_singular_values', 'has_closed_form', 'ik', 'ik_all', 'lie', 'null_space', 'null_space_projector', 'on_omni_base', 'pinv', 'plan_path', 'plan_pose', 'pose_error', 'robots', 'selectively_damped_step', 'simd_level', 'sqp', 'terms', 'transform', 'use_simd_level']
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
class Disc:
    """
    Keeps the base's reference point away, [M17] (4.29).
    
    As an obstacle it is an upright cylinder without ends: heights do not count, and only the base is
    concerned, not the arm above it.
    
    Parameters
    ----------
    center : (2,), m
    radius : float, m
    
    Raises
    ------
    ValueError
        If the radius is not positive, or a number not finite.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.Disc(center=(0.6, 0.6), radius=0.4)
    Disc(center=(0.6, 0.6), radius=0.4)
    """
    def __eq__(self, arg0: Disc) -> bool:
        ...
    def __getstate__(self) -> tuple:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, center: numpy.typing.ArrayLike, radius: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def signed_distance(self, points: numpy.typing.ArrayLike) -> float | numpy.typing.NDArray[numpy.float64]:
        """
        Distance of points from the surface, m; negative inside.
        
        Parameters
        ----------
        points : (3,) or (N, 3), m
        
        Returns
        -------
        float or (N,)
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> tk.Sphere(center=(0, 0, 1), radius=0.25).signed_distance([(0, 0, 1), (0, 3, 5)])
        array([-0.25,  4.75])
        """
    @property
    def center(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (x, y), m.
        """
    @property
    def radius(self) -> float:
        """
        Its radius, m.
        """
class Sphere:
    """
    A ball that the robot's spheres stay clear of.
    
    Parameters
    ----------
    center : (3,), m
    radius : float, m
    
    Raises
    ------
    ValueError
        If the radius is not positive, or a number not finite.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.Sphere(center=(1.0, 0.0, 0.8), radius=0.2)
    Sphere(center=(1.0, 0.0, 0.8), radius=0.2)
    """
    def __eq__(self, arg0: Sphere) -> bool:
        ...
    def __getstate__(self) -> tuple:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, center: numpy.typing.ArrayLike, radius: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def signed_distance(self, points: numpy.typing.ArrayLike) -> float | numpy.typing.NDArray[numpy.float64]:
        """
        Distance of points from the surface, m; negative inside.
        
        Parameters
        ----------
        points : (3,) or (N, 3), m
        
        Returns
        -------
        float or (N,)
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> tk.Sphere(center=(0, 0, 1), radius=0.25).signed_distance([(0, 0, 1), (0, 3, 5)])
        array([-0.25,  4.75])
        """
    @property
    def center(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (x, y, z), m.
        """
    @property
    def radius(self) -> float:
        """
        Its radius, m.
        """
class Capsule:
    """
    All points within a radius of a segment: a post, a pipe.
    
    Parameters
    ----------
    start, end : (3,), m
        Of the segment; equal ends make a sphere.
    radius : float, m
    
    Raises
    ------
    ValueError
        If the radius is not positive, or a number not finite.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> post = tk.Capsule(start=(1, 0, 0), end=(1, 0, 2), radius=0.1)
    >>> post.signed_distance((1.5, 0, 1))
    0.4
    """
    def __eq__(self, arg0: Capsule) -> bool:
        ...
    def __getstate__(self) -> tuple:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, start: numpy.typing.ArrayLike, end: numpy.typing.ArrayLike, radius: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def signed_distance(self, points: numpy.typing.ArrayLike) -> float | numpy.typing.NDArray[numpy.float64]:
        """
        Distance of points from the surface, m; negative inside.
        
        Parameters
        ----------
        points : (3,) or (N, 3), m
        
        Returns
        -------
        float or (N,)
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> tk.Sphere(center=(0, 0, 1), radius=0.25).signed_distance([(0, 0, 1), (0, 3, 5)])
        array([-0.25,  4.75])
        """
    @property
    def end(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (x, y, z), m.
        """
    @property
    def radius(self) -> float:
        """
        Its radius, m.
        """
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (x, y, z), m.
        """
class Box:
    """
    A box of any orientation: a table, a wall.
    
    Outside, the distance is that of the nearest point; inside, that of the nearest face.
    
    Parameters
    ----------
    size : (3,), m
        Its lengths along its own x, y and z.
    pose : (4, 4), optional
        Of its middle; or
    center : (3,), m, optional
        and
    rpy : (3,), rad, optional
        Roll, pitch and yaw. Default: at the origin, along the axes.
    
    Raises
    ------
    ValueError
        If a length is not positive, a number not finite, or the pose no rigid transform.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> table = tk.Box(size=(1.2, 0.8, 0.04), center=(1.0, 0.0, 0.7), rpy=(0.0, 0.0, np.pi / 2))
    >>> round(table.signed_distance((1.0, 0.0, 1.0)), 12)
    0.28
    """
    def __eq__(self, arg0: Box) -> bool:
        ...
    def __getstate__(self) -> tuple:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, *, size: numpy.typing.ArrayLike, pose: numpy.typing.ArrayLike | None = None, center: numpy.typing.ArrayLike | None = None, rpy: numpy.typing.ArrayLike | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def signed_distance(self, points: numpy.typing.ArrayLike) -> float | numpy.typing.NDArray[numpy.float64]:
        """
        Distance of points from the surface, m; negative inside.
        
        Parameters
        ----------
        points : (3,) or (N, 3), m
        
        Returns
        -------
        float or (N,)
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> tk.Sphere(center=(0, 0, 1), radius=0.25).signed_distance([(0, 0, 1), (0, 3, 5)])
        array([-0.25,  4.75])
        """
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Of its middle, (4, 4).
        """
    @property
    def size(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Lengths along its own axes, m.
        """
class HalfSpace:
    """
    All that is behind a plane: a floor, a wall.
    
    Parameters
    ----------
    normal : (3,)
        Points out of it, to where the robot may be. Any length but zero.
    offset : float, m, optional
        How far from the origin the plane is, along the normal; or
    point : (3,), m, optional
        A point of the plane.
    
    Raises
    ------
    ValueError
        If the normal is zero, a number not finite, or not one of offset and point is given.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> floor = tk.HalfSpace(normal=(0, 0, 1), offset=0.0)
    >>> floor.signed_distance((0.3, 0.2, 0.5))
    0.5
    """
    def __eq__(self, arg0: HalfSpace) -> bool:
        ...
    def __getstate__(self) -> tuple:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, normal: numpy.typing.ArrayLike, *, offset: typing.SupportsFloat | typing.SupportsIndex | None = None, point: numpy.typing.ArrayLike | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def signed_distance(self, points: numpy.typing.ArrayLike) -> float | numpy.typing.NDArray[numpy.float64]:
        """
        Distance of points from the surface, m; negative inside.
        
        Parameters
        ----------
        points : (3,) or (N, 3), m
        
        Returns
        -------
        float or (N,)
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> tk.Sphere(center=(0, 0, 1), radius=0.25).signed_distance([(0, 0, 1), (0, 3, 5)])
        array([-0.25,  4.75])
        """
    @property
    def normal(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Of unit length.
        """
    @property
    def offset(self) -> float:
        """
        Of the plane along the normal, m.
        """
class LinkSpheres:
    """
    A robot's shape as balls fixed to its frames, for clearances.
    
    Immutable. The frames are kept by name: the same shape serves the robot with other limits or a
    further tool.
    
    Parameters
    ----------
    robot : Chain
    spheres : sequence of (frame, center, radius)
        A frame's name or index, coordinates in it (3,), m, and m.
    pairs : sequence of (int, int), optional
        Which spheres must not meet each other, by their places in `spheres`. Default: all, but of one
        link or neighboring links; of those that cannot meet, by the triangle inequality over the links
        between them; and of those that overlap in a quarter or more of 256 postures spread within the
        limits, too near each other along the chain for balls to tell.
    
    Raises
    ------
    ValueError
        If a frame does not exist, a radius is not positive, an index is none, or a number not finite.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> robot = tk.robots.ur10()
    >>> shape = tk.LinkSpheres(robot, [("tool", (0, 0, 0.05), 0.1), ("upper_arm", (0.3, 0, 0), 0.1)])
    >>> shape.pairs
    ((0, 1),)
    """
    @staticmethod
    def along_links(robot: Chain, radius: typing.SupportsFloat | typing.SupportsIndex, spacing: typing.SupportsFloat | typing.SupportsIndex | None = None) -> LinkSpheres:
        """
        Balls of one radius along the arm, from each joint's frame straight to the next.
        
        The last link ends at the tool. What a base carries below the arm's first joint is left out: that
        is a Disc's concern, or that of further spheres. Neighboring centers are at most `spacing` apart;
        the default, one radius, leaves notches of 13 % of it between the balls.
        
        Parameters
        ----------
        robot : Chain
        radius : float, m
        spacing : float, m, optional
            At least 0.001; default: the radius.
        
        Returns
        -------
        LinkSpheres
            With the default pairs.
        
        Raises
        ------
        ValueError
            If the radius is not positive, or the spacing too small.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> tk.LinkSpheres.along_links(tk.robots.ur10(), radius=0.08, spacing=0.15)
        LinkSpheres(15 spheres, 33 pairs)
        """
    def __eq__(self, arg0: LinkSpheres) -> bool:
        ...
    def __getstate__(self) -> tuple[tuple, tuple]:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, robot: Chain, spheres: typing.Any, *, pairs: typing.Any = None) -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def centers(self, robot: Chain, q: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Where the spheres' centers are.
        
        Parameters
        ----------
        robot : Chain
        q : (n,) or (N, n), rad and m
        
        Returns
        -------
        (S, 3) or (N, S, 3), m
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> robot = tk.robots.ur10()
        >>> shape = tk.LinkSpheres(robot, [("tool", (0, 0, 0), 0.1)])
        >>> np.allclose(shape.centers(robot, np.zeros(6))[0], robot.fk(np.zeros(6))[:3, 3])
        True
        """
    @property
    def pairs(self) -> tuple:
        """
        Pairs of spheres that must not meet.
        """
    @property
    def spheres(self) -> tuple:
        """
        (frame, (x, y, z), radius) each, m.
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
class PosePlan:
    """
    What plan_pose found, and why not more.
    
    q is always finite and within joint limits, also without success: then it is the best found.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> plan = tk.plan_pose(robot, tk.transform(xyz=(9.0, 0.0, 1.0)), base_goal=(0, 0), base_radius=0.5)
    >>> plan.success, plan.status
    (False, 'infeasible')
    """
    def __repr__(self) -> str:
        ...
    @property
    def constraint_violation(self) -> float:
        """
        The largest of all constraints, m or rad.
        """
    @property
    def iterations(self) -> int:
        """
        Quadratic programs of all descents.
        """
    @property
    def message(self) -> str:
        """
        In a sentence: what is violated most, and by how much.
        """
    @property
    def objective(self) -> float:
        """
        sqrt(kappa/M) at q, [M17] (4.33).
        """
    @property
    def position_error(self) -> float:
        """
        Distance of the hand from the target, m.
        """
    @property
    def q(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,), rad and m.
        """
    @property
    def restarts(self) -> int:
        """
        Descents beside the seed's.
        """
    @property
    def rotation_error(self) -> float:
        """
        Angle between the hand and the target, rad.
        """
    @property
    def status(self) -> str:
        """
        How it ended.
        
        'converged': feasible and stationary. 'infeasible': every descent ended with constraints
        violated. 'budget': iterations ran out.
        """
    @property
    def success(self) -> bool:
        """
        Whether q is a local optimum that keeps all constraints, by forward kinematics of q.
        """
    @property
    def time(self) -> float:
        """
        s, inside the solver.
        """
class PosePlanner:
    """
    Finds dexterous whole-body poses, [M17] (4.34).
    
    Least sqrt(kappa/M) over the configurations that have the hand at the target, the base within a disc
    about its goal and in a window of heading, the joints within limits, and that keep clear of
    obstacles. The pose's six equations are eliminated: each step is one in the null space of the
    Jacobian, of a quadratic program with the exact second derivatives of log sqrt(kappa/M), in a trust
    region; then the hand is brought back. Where the seed's descent fails, others begin at solutions of
    inverse kinematics for base placements within the disc.
    
    Whole-body dexterity is blind to singularities of the arm, since the base fills the lost direction:
    jacobian='arm' sees them.
    
    Immutable: any number of threads may share one.
    
    Parameters
    ----------
    robot : Chain
        At least six joints.
    base_goal : (2,), optional
        Where the base should be, m.
    base_radius : float > 0, optional
        How far from there it may be, m.
    heading : (2,), optional
        Least and greatest theta, rad, taken as given: theta is continuous, a window may cross pi.
    obstacles : sequence of Disc, Sphere, Capsule, Box, HalfSpace
        A Disc keeps the base's reference point out, (4.29); the others the balls of `spheres`.
    spheres : LinkSpheres, optional
        The robot's shape; its pairs must not meet. Needed for obstacles other than discs.
    jacobian : str or (n,)
        Whose dexterity counts: 'whole_body', 'arm' (without the base's columns), or weights of the
        columns, 0 to 1e6.
    frame : str or int, optional
        The frame that is to reach the target; default the last.
    search : str
        'local': the optimum that the seed's descent leads to. 'global': the best of all arm branches
        and base placements, by descents from the best of many samples.
    max_iterations : int
        Of one descent.
    max_restarts : int
        Of a local search, where the seed's descent fails.
    samples, descents : int
        Of a global search: base placements, and how many of the best begin a descent.
    tolerance : float > 0
        A constraint violated by less is kept, m and rad.
    rng : int
        Which base placements are tried.
    
    Raises
    ------
    ValueError
        If an option does not fit the robot.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> planner = tk.PosePlanner(robot, base_goal=(0.6, 0.0), base_radius=0.3)
    >>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
    >>> plan = planner.solve(tk.transform(xyz=(1.2, -0.9, 0.9), rpy=(0.0, np.pi / 2, 0.0)), seed)
    >>> plan.success, bool(np.hypot(*(robot.base_pose(plan.q)[:2] - (0.6, 0.0))) <= 0.3 + 1e-8)
    (True, True)
    """
    def __init__(self, robot: Chain, *, base_goal: numpy.typing.ArrayLike | None = None, base_radius: typing.SupportsFloat | typing.SupportsIndex | None = None, heading: numpy.typing.ArrayLike | None = None, obstacles: collections.abc.Sequence[Disc | Sphere | Capsule | Box | HalfSpace] = (), spheres: LinkSpheres | None = None, jacobian: str | numpy.typing.ArrayLike = 'whole_body', frame: str | int | None = None, search: str = 'local', max_iterations: typing.SupportsInt | typing.SupportsIndex = 60, max_restarts: typing.SupportsInt | typing.SupportsIndex = 100, samples: typing.SupportsInt | typing.SupportsIndex = 128, descents: typing.SupportsInt | typing.SupportsIndex = 32, tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-08, rng: typing.SupportsInt | typing.SupportsIndex = 0) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def solve(self, target: numpy.typing.ArrayLike, seed: numpy.typing.ArrayLike | None = None) -> typing.Any:
        """
        Solves for one target.
        
        Parameters
        ----------
        target : (4, 4)
            In the root.
        seed : (n,), optional
            Where to begin; brought into the limits first. Default zeros.
        
        Returns
        -------
        PosePlan
        
        Raises
        ------
        ValueError
            If a shape does not fit, a number is not finite or the pose is not rigid.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> robot = tk.robots.thing()
        >>> tk.PosePlanner(robot, jacobian="arm").solve(tk.transform(xyz=(1.0, 0.5, 0.9))).success
        True
        """
    @property
    def robot(self) -> typing.Any:
        """
        The robot.
        """
class ProblemValue:
    """
    A problem at one x.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> problem = tk.Problem(n=2, upper=1.0)
    >>> problem.minimize(tk.terms.Function(lambda x: x @ x, lambda x: 2 * x))
    >>> at = problem.evaluate((3.0, 0.0))
    >>> at.objective, at.violation, at.violations
    (9.0, 2.0, {'bound of x[0]': 2.0})
    """
    def __repr__(self) -> str:
        ...
    @property
    def gradient(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,), of the objective.
        """
    @property
    def jacobian(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (m, n), of the constraints.
        """
    @property
    def objective(self) -> float:
        """
        f(x).
        """
    @property
    def values(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (m,), of the constraints, in the order of constraint_names.
        """
    @property
    def violation(self) -> float:
        """
        The largest of a constraint or bound.
        """
    @property
    def violations(self) -> dict:
        """
        Constraints and bounds that do not hold, by name: by how much; the worst first.
        """
class Problem:
    """
    An optimization problem, [M17] (4.19).
    
    Minimize a sum of terms, where other terms are bounded and the variables are. For a robot the
    variables are its joints, bounded by its limits; otherwise there are n of them.
    
    Bounds that cross, such as a lower one above the upper, are kept: a solver says that it is
    infeasible.
    
    Parameters
    ----------
    robot : Chain, optional
    n : int, optional
        How many variables, without a robot.
    lower, upper : float or (n,), optional
        Bounds of the variables, without a robot; default none.
    
    Raises
    ------
    ValueError
        If there is neither a robot nor n, or both; for NaN and wrong shapes.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> problem = tk.Problem(n=2, lower=0.0)
    >>> problem.minimize(tk.terms.Function(lambda x: x @ x, lambda x: 2 * x, name="size"))
    >>> problem.equal(tk.terms.Function(lambda x: x.sum(), np.ones_like, name="sum"), 1.0)
    >>> problem
    Problem(2 variables, 1 objective, 1 constraint)
    >>> tk.sqp(problem, (1.0, 0.0)).x.round(6)
    array([0.5, 0.5])
    """
    def __init__(self, robot: typing.Any = None, *, n: typing.SupportsInt | typing.SupportsIndex | None = None, lower: typing.Any = None, upper: typing.Any = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def at_least(self, term: terms.Term, lower: numpy.typing.ArrayLike, *, name: str = '') -> None:
        """
        Adds a constraint: the term is at least `lower`.
        
        Parameters
        ----------
        term : terms.Term
        lower : float or (m,)
        name : str
            For messages; default the term's.
        
        Raises
        ------
        ValueError
            If the term or the bound does not fit.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> problem = tk.Problem(n=1)
        >>> problem.at_least(tk.terms.Function(lambda x: x**2, lambda x: 2 * x, name="square"), 4.0)
        >>> problem.evaluate([1.0]).violations
        {'square': 3.0}
        """
    def at_most(self, term: terms.Term, upper: numpy.typing.ArrayLike, *, name: str = '') -> None:
        """
        Adds a constraint: the term is at most `upper`.
        
        Parameters
        ----------
        term : terms.Term
        upper : float or (m,)
        name : str
            For messages; default the term's.
        
        Raises
        ------
        ValueError
            If the term or the bound does not fit.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> problem = tk.Problem(n=1)
        >>> problem.at_most(tk.terms.Function(lambda x: x**2, lambda x: 2 * x, name="square"), 4.0)
        >>> problem.evaluate([3.0]).violations
        {'square': 5.0}
        """
    def between(self, term: terms.Term, lower: numpy.typing.ArrayLike, upper: numpy.typing.ArrayLike, *, name: str = '') -> None:
        """
        Adds a constraint: the term is between two bounds.
        
        Parameters
        ----------
        term : terms.Term
        lower, upper : float or (m,)
        name : str
            For messages; default the term's.
        
        Raises
        ------
        ValueError
            If the term or a bound does not fit.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> problem = tk.Problem(n=1)
        >>> problem.between(tk.terms.Function(lambda x: x**2, lambda x: 2 * x, name="square"), 1.0, 4.0)
        >>> problem.evaluate([0.0]).violations
        {'square': 1.0}
        """
    def bound(self, variable: typing.Any, lower: numpy.typing.ArrayLike = ..., upper: numpy.typing.ArrayLike = ...) -> None:
        """
        Bounds a variable anew, in place of what bounded it before.
        
        Parameters
        ----------
        variable : str or int
            A joint by name, or its place.
        lower, upper : float, rad or m
            -inf and inf: none.
        
        Raises
        ------
        ValueError
            If there is no such variable, or a bound is NaN.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> problem = tk.Problem(tk.robots.thing())
        >>> problem.bound("theta", -0.5, 0.5)
        >>> float(problem.upper[problem.names.index("theta")])
        0.5
        """
    def equal(self, term: terms.Term, target: numpy.typing.ArrayLike = 0.0, *, name: str = '') -> None:
        """
        Adds a constraint: the term equals the target.
        
        Parameters
        ----------
        term : terms.Term
        target : float or (m,)
        name : str
            For messages; default the term's.
        
        Raises
        ------
        ValueError
            If the term or the target does not fit.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> problem = tk.Problem(n=1)
        >>> problem.equal(tk.terms.Function(lambda x: x**2, lambda x: 2 * x), 4.0, name="square")
        >>> problem.evaluate([3.0]).violations
        {'square': 5.0}
        """
    def evaluate(self, x: numpy.typing.ArrayLike) -> ProblemValue:
        """
        Objective and constraints at x.
        
        Parameters
        ----------
        x : (n,)
        
        Returns
        -------
        ProblemValue
        
        Raises
        ------
        ValueError
            If x does not fit, or a term does not exist there.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> problem = tk.Problem(n=2, upper=1.0)
        >>> problem.evaluate((3.0, 0.5)).violations
        {'bound of x[0]': 2.0}
        """
    def minimize(self, term: terms.Term, weight: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> None:
        """
        Adds to the objective: the sum of the entries.
        
        Parameters
        ----------
        term : terms.Term
        weight : float
            A negative one maximizes.
        
        Raises
        ------
        ValueError
            If the term does not fit, or the weight is not finite.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> problem = tk.Problem(n=1)
        >>> problem.minimize(tk.terms.Function(lambda x: x**2, lambda x: 2 * x), weight=3.0)
        >>> problem.evaluate([2.0]).objective
        12.0
        """
    def minimize_squares(self, term: terms.Term, weight: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> None:
        """
        Adds to the objective: the sum of the entries' squares.
        
        Parameters
        ----------
        term : terms.Term
        weight : float >= 0
        
        Raises
        ------
        ValueError
            If the term does not fit, or the weight is negative or not finite.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> problem = tk.Problem(n=2)
        >>> problem.minimize_squares(tk.terms.Function(lambda x: x - 1, lambda x: np.eye(2), size=2))
        >>> problem.evaluate([2.0, 3.0]).objective
        5.0
        """
    @property
    def constraint_lower(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (m,): their lower bounds.
        """
    @property
    def constraint_names(self) -> tuple:
        """
        Names of the m numbers that are bounded.
        """
    @property
    def constraint_upper(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (m,): their upper bounds.
        """
    @property
    def lower(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,): lower bounds of the variables.
        """
    @property
    def n(self) -> int:
        """
        How many variables.
        """
    @property
    def names(self) -> tuple:
        """
        Names of the variables.
        """
    @property
    def upper(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,): upper bounds of the variables.
        """
class DerivativeCheck:
    """
    How far a term's derivatives are from differences.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> wrong = tk.terms.Function(lambda x: x[0] ** 2, lambda x: [x[0]])
    >>> check = tk.check_derivatives(wrong, [3.0])
    >>> check.success, round(check.jacobian_difference, 6)
    (False, 0.5)
    """
    def __repr__(self) -> str:
        ...
    @property
    def hessian_difference(self) -> float:
        """
        The same of the Hessians.
        """
    @property
    def hessian_entry(self) -> tuple[int, int, int]:
        """
        Where: (entry of the value, variable, variable).
        """
    @property
    def jacobian_difference(self) -> float:
        """
        Largest difference, relative to the larger of 1 and the largest entry.
        """
    @property
    def jacobian_entry(self) -> tuple[int, int]:
        """
        Where: (entry of the value, variable).
        """
    @property
    def message(self) -> str:
        """
        All of it in a sentence.
        """
    @property
    def success(self) -> bool:
        """
        Whether both differences are at most 1e-5.
        """
class _ConvexMinimizer:
    pass
class SqpTrace:
    """
    What tk.sqp did: an entry a convexified problem.
    
    See viz.plot_trace.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> problem = tk.Problem(n=1)
    >>> problem.minimize(tk.terms.Function(lambda x: x[0] ** 4, lambda x: 4 * x**3))
    >>> trace = tk.sqp(problem, [1.0]).trace
    >>> len(trace) == len(trace.merit), bool(trace.objective[0] > trace.objective[-1])
    (True, True)
    """
    def __len__(self) -> int:
        ...
    @property
    def accepted(self) -> numpy.typing.NDArray[numpy.bool]:
        """
        (N,) bool: whether the step was taken.
        """
    @property
    def merit(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N,): f + penalty sum |violation| where the step was tried from; of the violation alone while that is restored.
        """
    @property
    def objective(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N,).
        """
    @property
    def penalty(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N,): mu.
        """
    @property
    def radius(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N,): of the trust region, in each variable.
        """
    @property
    def violation(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N,): the largest of a constraint.
        """
class SqpResult:
    """
    What tk.sqp found, judged anew at its x.
    
    x is always finite and within bounds that do not cross. Violation and residual are computed from the
    problem at x, not by the solver.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> problem = tk.Problem(n=1, upper=1.0)
    >>> problem.equal(tk.terms.Function(lambda x: x, lambda x: [[1.0]], name="place"), 3.0)
    >>> result = tk.sqp(problem, [0.0])
    >>> result.success, result.status, result.message
    (False, 'infeasible', 'infeasible: place by 2')
    """
    def __repr__(self) -> str:
        ...
    @property
    def bound_multipliers(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,), of the variables' bounds.
        """
    @property
    def constraint_violation(self) -> float:
        """
        The largest of a constraint or bound.
        """
    @property
    def iterations(self) -> int:
        """
        Convexified problems solved.
        """
    @property
    def kkt_residual(self) -> float:
        """
        How far x is from stationary: what is left of the Lagrangian's gradient, relative to the largest of 1, the objective's gradient and the constraints' pulls, or a multiplier times its slack, relative to the first two.
        """
    @property
    def message(self) -> str:
        """
        The status in a sentence: what is violated.
        """
    @property
    def multipliers(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (m,), of the constraints, in the order of Problem.constraint_names; > 0: at the upper bound, < 0: at the lower.
        """
    @property
    def objective(self) -> float:
        """
        f(x).
        """
    @property
    def q(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,): x by its name for a robot, rad and m.
        """
    @property
    def status(self) -> str:
        """
        How it ended.
        
        'converged': feasible and stationary, both within tolerance. 'infeasible': constraints are violated,
        and no step lessens the sum of the violations. 'budget': iterations or time ran out, or no step makes
        progress though x is not stationary; x is the best point found, feasible or not.
        """
    @property
    def success(self) -> bool:
        """
        Whether status is 'converged'.
        """
    @property
    def time(self) -> float:
        """
        Seconds.
        """
    @property
    def trace(self) -> SqpTrace:
        """
        SqpTrace: an entry an iteration.
        """
    @property
    def x(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,).
        """
class FollowerStep:
    """
    One step of a PathFollower.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
    >>> follower = tk.PathFollower(robot, seed, window=10)
    >>> follower.push(robot.fk(seed))
    True
    >>> step = follower.step()
    >>> step.q.shape, step.position_error < 1e-9
    ((9,), True)
    """
    def __repr__(self) -> str:
        ...
    @property
    def position_error(self) -> float:
        """
        m, by forward kinematics.
        """
    @property
    def q(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,), rad and m: where to go next.
        """
    @property
    def rotation_error(self) -> float:
        """
        rad.
        """
    @property
    def settled(self) -> bool:
        """
        Whether the window was at its optimum.
        """
    @property
    def violation(self) -> float:
        """
        Largest of the constraints of q and of the way to it, m or rad.
        """
class PathFollower:
    """
    plan_path for poses that come in one by one.
    
    A window of waypoints is kept optimized with one iteration a step, each warm from the one before;
    the window's first configuration goes out. The objective and the constraints are plan_path's. In a
    step's C++ nothing allocates.
    
    Parameters
    ----------
    robot : Chain
    seed : (n,), rad and m
        Where the robot stands.
    window : int
        How many waypoints to look ahead.
    base : str
        What comes with each pose of the base: nothing ('free'), 'xy' or 'xytheta'.
    frame, base_radius, heading, obstacles, spheres, max_joint_step, joint_weights, jacobian
        See plan_path.
    dexterity_weight : float, optional
        Default 1/window^2.
    
    Raises
    ------
    ValueError
        If an argument does not fit the robot.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
    >>> follower = tk.PathFollower(robot, seed, window=10)
    >>> pose = robot.fk(seed)
    >>> for _ in range(10):  # fill the window, then give and take one by one
    ...     pose[0, 3] += 0.02
    ...     assert follower.push(pose)
    >>> pose[0, 3] += 0.02
    >>> step = follower.step()
    >>> follower.push(pose), step.position_error < 1e-9
    (True, True)
    """
    def __init__(self, robot: Chain, seed: numpy.typing.ArrayLike, *, window: typing.SupportsInt | typing.SupportsIndex = 20, base: str = 'free', frame: str | int | None = None, base_radius: typing.SupportsFloat | typing.SupportsIndex | None = None, heading: numpy.typing.ArrayLike | None = None, obstacles: collections.abc.Sequence[Disc | Sphere | Capsule | Box | HalfSpace] = (), spheres: LinkSpheres | None = None, max_joint_step: numpy.typing.ArrayLike | None = None, joint_weights: numpy.typing.ArrayLike | None = None, jacobian: str | numpy.typing.ArrayLike = 'whole_body', dexterity_weight: typing.SupportsFloat | typing.SupportsIndex | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def push(self, pose: numpy.typing.ArrayLike, base: numpy.typing.ArrayLike | None = None) -> bool:
        """
        Appends a waypoint to the window.
        
        Parameters
        ----------
        pose : (4, 4)
        base : (2,) or (3,), optional
            x, y (m) and theta (rad) of the base path there, as the follower was told.
        
        Returns
        -------
        bool
            False, and nothing changes, if the window is full or the pose can't be reached from the one
            before it.
        
        Raises
        ------
        ValueError
            If a shape does not fit or a number is not finite.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> robot = tk.robots.thing()
        >>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
        >>> follower = tk.PathFollower(robot, seed, window=10)
        >>> follower.push(robot.fk(seed)), follower.pending
        (True, 1)
        """
    def step(self) -> FollowerStep | None:
        """
        One iteration on the window, whose first waypoint goes out.
        
        That is where the robot stands from now on.
        
        Returns
        -------
        FollowerStep or None
            None if the window is empty.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> robot = tk.robots.thing()
        >>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
        >>> follower = tk.PathFollower(robot, seed, window=10)
        >>> follower.step() is None
        True
        >>> follower.push(robot.fk(seed)), follower.step().position_error < 1e-9
        (True, True)
        """
    @property
    def pending(self) -> int:
        """
        How many waypoints are in the window.
        """
    @property
    def robot(self) -> typing.Any:
        """
        The robot.
        """
    @property
    def window(self) -> int:
        """
        How many it has room for.
        """
def check_derivatives(term: terms.Term, x: numpy.typing.ArrayLike, robot: typing.Any = None) -> DerivativeCheck:
    """
    Compares a term's derivatives with differences.
    
    The Jacobian with central differences of the value, the Hessian with central differences of the
    Jacobian: a function's whose Hessian is not given differs by rounding alone.
    
    Parameters
    ----------
    term : terms.Term
    x : (n,)
    robot : Chain, optional
        For terms of a robot.
    
    Returns
    -------
    DerivativeCheck
    
    Raises
    ------
    ValueError
        If x does not fit, or the term does not exist there or next to it.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> term = tk.terms.Function(lambda x: x[0] ** 2, lambda x: [2 * x[0]])
    >>> tk.check_derivatives(term, [3.0]).success
    True
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
def plan_path(robot: Chain, poses: numpy.typing.ArrayLike, *, seed: numpy.typing.ArrayLike, frame: str | int | None = None, base_path: numpy.typing.ArrayLike | None = None, base_radius: typing.SupportsFloat | typing.SupportsIndex | None = None, heading: numpy.typing.ArrayLike | None = None, obstacles: collections.abc.Sequence[Disc | Sphere | Capsule | Box | HalfSpace] = (), spheres: LinkSpheres | None = None, method: str = 'sqp', max_joint_step: numpy.typing.ArrayLike | None = None, joint_weights: numpy.typing.ArrayLike | None = None, jacobian: str | numpy.typing.ArrayLike = 'whole_body', dexterity_weight: typing.SupportsFloat | typing.SupportsIndex | None = None, warm_start: numpy.typing.ArrayLike | thing_kin.path_plan.PathPlan | None = None, max_iterations: typing.SupportsInt | typing.SupportsIndex = 200, position_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-06, rotation_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-06, constraint_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-06) -> thing_kin.path_plan.PathPlan:
    """
    Configurations that take a frame along a path of poses, the whole body at once.
    
    method='sqp' minimizes
    
        sum_k |W (q[k+1] - q[k])|^2 / 2  +  w sum_k log sqrt(kappa/M)(q[k])
    
    with the joint weights W, the dexterity weight w and sqrt(kappa/M) of (4.33), subject to every pose,
    the base within base_radius of the base path, theta within its window, obstacles kept clear of at
    the waypoints and everywhere on the straight lines in joint space between them, joint limits and
    max_joint_step. It is one sequential quadratic program over all waypoints in the null spaces of
    their Jacobians, with exact second derivatives; time grows with the number of waypoints, not its
    square. A local optimum, begun on each side of the Discs that the base path runs through until one
    succeeds.
    
    method='task_priority' goes from pose to pose, hand first, base second, [M17] (4.18), each iterated
    until it rests, within the joints' limits; all else is only checked.
    
    q[0] is the seed where that solves the first pose; else it is near the solution nearest to the seed,
    and the way from the seed to it counts like a step.
    
    Never raises because there is no such path: the plan says which waypoint can't be followed first,
    what fails there, and by how much.
    
    Parameters
    ----------
    robot : Chain
        Of at least six joints.
    poses : (N, 4, 4)
        Of the frame, in the root.
    seed : (n,), rad and m
        Where the robot stands.
    frame : str or int, optional
        Default the last.
    base_path : (N, 2) or (N, 3), optional
        x, y (m) and theta (rad) of the base. Without base_radius it guides only.
    base_radius : float > 0, optional
        m, how far from the base path the base may be.
    heading : float or (2,), optional
        rad: how far theta may be from the base path's, or (lower, upper). theta goes on beyond pi: the
        window is meant up to whole turns and may cross +-pi.
    obstacles : list of Disc, Sphere, Capsule, Box, HalfSpace
        A Disc keeps the base away, the others the spheres.
    spheres : LinkSpheres, optional
        The robot's shape, with the pairs that must not meet.
    method : str
        'sqp' or 'task_priority'.
    max_joint_step : float or (n,), optional
        rad and m, between neighboring waypoints.
    joint_weights : float or (n,), optional
        W; default ones.
    jacobian : str or (n,)
        Whose dexterity: 'whole_body'; 'arm', which the base's columns do not help; or a weight for each
        joint's column. The whole body's is blind to singular arms.
    dexterity_weight : float, optional
        w; default 1/N^2, with which the balance does not depend on how finely a path is sampled.
    warm_start : (N, n) or PathPlan, optional
        Where to begin: the plan of a similar path.
    max_iterations : int
        Of each attempt ('sqp') or each waypoint ('task_priority').
    position_tolerance, rotation_tolerance, constraint_tolerance : float
        m, rad and both: what is missed by more is no success. 'sqp' ends far below.
    
    Returns
    -------
    PathPlan
    
    Raises
    ------
    ValueError
        If an argument does not fit the robot or another one, or is not finite.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
    >>> poses = np.repeat(robot.fk(seed)[None], 20, axis=0)
    >>> poses[:, 0, 3] += np.linspace(0.0, 2.0, 20)
    >>> path = tk.plan_path(robot, poses, seed=seed, obstacles=[tk.Disc((1.0, 0.3), 0.5)])
    >>> path.success, path.q.shape
    (True, (20, 9))
    """
def plan_pose(robot: Chain, target: numpy.typing.ArrayLike, seed: numpy.typing.ArrayLike | None = None, *, base_goal: numpy.typing.ArrayLike | None = None, base_radius: typing.SupportsFloat | typing.SupportsIndex | None = None, heading: numpy.typing.ArrayLike | None = None, obstacles: collections.abc.Sequence[Disc | Sphere | Capsule | Box | HalfSpace] = (), spheres: LinkSpheres | None = None, jacobian: str | numpy.typing.ArrayLike = 'whole_body', frame: str | int | None = None, search: str = 'local', max_iterations: typing.SupportsInt | typing.SupportsIndex = 60, max_restarts: typing.SupportsInt | typing.SupportsIndex = 100, samples: typing.SupportsInt | typing.SupportsIndex = 128, descents: typing.SupportsInt | typing.SupportsIndex = 32, tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-08, rng: typing.SupportsInt | typing.SupportsIndex = 0) -> typing.Any:
    """
    The whole-body pose of least sqrt(kappa/M) for a target, [M17] (4.34).
    
    Never raises because there is none: the result says why.
    
    Parameters
    ----------
    robot : Chain
        At least six joints.
    target : (4, 4)
        Pose of the frame, in the root.
    seed : (n,), optional
        Where to begin; brought into the limits first. Default zeros.
    base_goal, base_radius, heading, obstacles, spheres, jacobian, frame, search, max_iterations, max_restarts, samples, descents, tolerance, rng
        See PosePlanner.
    
    Returns
    -------
    PosePlan
    
    Raises
    ------
    ValueError
        If an argument does not fit the robot.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> T_goal = tk.transform(xyz=(1.2, -0.9, 0.9), rpy=(0.0, np.pi / 2, 0.0))
    >>> seed = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
    >>> wall = tk.Disc(center=(0.6, 0.6), radius=0.4)
    >>> plan = tk.plan_pose(robot, T_goal, seed=seed, base_goal=(0.6, 0.0), base_radius=0.3,
    ...                     heading=(-0.8, 0.8), obstacles=[wall])
    >>> plan.success, bool(np.allclose(robot.fk(plan.q), T_goal, atol=1e-8))
    (True, True)
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
def sqp(problem: Problem, x0: numpy.typing.ArrayLike, *, minimizer: str = 'augmented_lagrangian', c: typing.SupportsFloat | typing.SupportsIndex = 0.1, tau_plus: typing.SupportsFloat | typing.SupportsIndex = 2.0, tau_minus: typing.SupportsFloat | typing.SupportsIndex = 0.25, k: typing.SupportsFloat | typing.SupportsIndex = 10.0, mu0: typing.SupportsFloat | typing.SupportsIndex = 10.0, mu_max: typing.SupportsFloat | typing.SupportsIndex = 1000000000.0, delta0: typing.SupportsFloat | typing.SupportsIndex = 1.0, delta_min: typing.SupportsFloat | typing.SupportsIndex = 1e-12, delta_max: typing.SupportsFloat | typing.SupportsIndex = 10000.0, step_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-12, improvement_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-15, constraint_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-08, optimality_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-06, second_order_correction: bool = True, max_iterations: typing.SupportsInt | typing.SupportsIndex = 500, deadline: typing.SupportsFloat | typing.SupportsIndex | None = None) -> typing.Any:
    """
    Sequential convex optimization, [M17] Algorithm 2.
    
    Three loops: the innermost minimizes a convex model of objective and constraints in a trust region,
    and accepts the step if the exact merit f + mu sum |violation| improves as the model predicts; the
    second makes the model anew; the outermost raises the penalty mu until the constraints hold. Where
    that does not help, the violation alone is minimized. The model has the exact second derivatives of
    the Lagrangian, made convex.
    
    It finds a local optimum. The result is a function of problem, x0 and options alone, unless there is
    a deadline.
    
    Parameters
    ----------
    problem : Problem
    x0 : (n,)
        Where to begin; brought into the bounds first.
    minimizer : str
        Of the convex model. 'augmented_lagrangian': through Ceres' Levenberg-Marquardt, as [M17] 5.3.2.
        'smoothed': the same, of penalties rounded over 1e-9. 'bfgs': an augmented Lagrangian through
        Ceres' BFGS line search. 'qp': a quadratic program with elastic constraints by an interior point
        method of this library, several times faster.
    c : float
        Least ratio of actual to predicted improvement for a step to be taken.
    tau_plus, tau_minus : float
        Growth of the trust region where a step is taken, its shrinking where not.
    k, mu0, mu_max : float
        Growth of the penalty, the first and the largest.
    delta0, delta_min, delta_max : float
        Radius of the trust region in each variable: first, least, largest.
    step_tolerance : float
        A step no entry of which is larger counts as none.
    improvement_tolerance : float
        A predicted improvement of the merit that counts as none, relative to it and to 1.
    constraint_tolerance : float
        Of each constraint, in its own unit. Bounds of the variables always hold.
    optimality_tolerance : float
        Of SqpResult.kkt_residual.
    second_order_correction : bool
        Whether a step that is refused is tried again with the constraints' values at its end. Without
        it, curved constraints can keep the last steps from being full (the Maratos effect).
    max_iterations : int
        Convexified problems solved, in all loops together.
    deadline : float, s, optional
    
    Returns
    -------
    SqpResult
    
    Raises
    ------
    ValueError
        If x0 or an option does not fit; if a function of a term returns what it should not.
    ImportError
        If the minimizer needs Ceres and there is none.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> rosenbrock = tk.terms.Function(
    ...     lambda x: [10 * (x[1] - x[0] ** 2), 1 - x[0]],
    ...     lambda x: [[-20 * x[0], 10], [-1, 0]], size=2)
    >>> disc = tk.terms.Function(lambda x: x @ x, lambda x: 2 * x, lambda x: 2 * np.eye(2))
    >>> problem = tk.Problem(n=2)
    >>> problem.minimize_squares(rosenbrock)
    >>> problem.at_most(disc, 1.0)
    >>> result = tk.sqp(problem, (-1.0, 0.5))
    >>> result.success, result.x.round(4)
    (True, array([0.7864, 0.6177]))
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
