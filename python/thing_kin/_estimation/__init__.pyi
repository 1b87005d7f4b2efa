"""
Odometry and estimation. Private: import its names from thing_kin.estimation.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import thing_kin._core
import typing
from . import models
__all__: list[str] = ['BaseEstimate', 'BaseLocalizer', 'DeadReckoning', 'DifferentialDriveOdometry', 'EndEffector', 'ExtendedKalmanFilter', 'FilterRun', 'GaussianFilter', 'KalmanFilter', 'MeasurementModel', 'MecanumIdentification', 'MecanumOdometry', 'MotionModel', 'NisStatistics', 'UnscentedKalmanFilter', 'angles_from_ticks', 'chi_square_quantile', 'dead_reckon', 'end_effector', 'identify_mecanum', 'integrate_twist', 'integrate_twist_jacobians', 'models', 'nees', 'numeric_jacobian', 'pose_difference']
class DeadReckoning:
    """
    Poses along a record, with covariances.
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> path = est.dead_reckon([0.0, 0.0, 0.0], [[1.0, 0.0, 0.0]] * 3, dt=0.1)
    >>> path.poses.shape, path.covariances.shape
    ((4, 3), (4, 3, 3))
    """
    def __repr__(self) -> str:
        ...
    @property
    def covariances(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, 3, 3), in world axes, m^2 and rad^2.
        """
    @property
    def poses(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, 3), m and rad: the first is the start.
        """
class MecanumOdometry:
    """
    Odometry of four mecanum wheels, [M17] (3.20).
    
    Parameters
    ----------
    wheel_radius : float, m
    k : float, m
        Half the wheel base plus half the track.
    order : sequence of str
        Which wheel is which in every array: 'fl' front left, 'rl' rear left, 'rr' rear right,
        'fr' front right. Default: the order of (3.20).
    
    Raises
    ------
    ValueError
        If a length is not positive and finite, or the order is none.
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> wheels = est.MecanumOdometry(0.07, k=0.369, order=("fl", "fr", "rl", "rr"))
    >>> wheels.wheel_speeds([0.0, 0.0, 1.0]).round(2)  # turning left, the right wheels go forwards
    array([-5.27,  5.27, -5.27,  5.27])
    """
    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool:
        ...
    def __init__(self, wheel_radius: typing.SupportsFloat | typing.SupportsIndex, k: typing.SupportsFloat | typing.SupportsIndex, order: typing.Any = ('fl', 'rl', 'rr', 'fr')) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def integrate(self, t: numpy.typing.ArrayLike, wheel_speeds: numpy.typing.ArrayLike, pose: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), covariance: numpy.typing.ArrayLike | None = None, *, twist_covariance: numpy.typing.ArrayLike | None = None, slip_variance: numpy.typing.ArrayLike | None = None) -> DeadReckoning:
        """
        Poses along a record of wheel speeds.
        
        Row i is the mean speed since the stamp before; that of the first row is not used.
        
        Parameters
        ----------
        t : (N,), s
            Not decreasing.
        wheel_speeds : (N, 4), rad/s
        pose : (3,), m and rad
            At t[0].
        covariance : (3, 3), optional
            Of that pose, in world axes; default: zero.
        twist_covariance : (3, 3), optional
            Of each row's twist, in the axes of the body; it enters the pose as R dt^2. Default:
            diag(0.001, 0.001, 0.03), [M17] (3.22).
        slip_variance : (3,), m^2/m and rad^2/m, optional
            Instead of it: variances of x, y and theta in the axes of the body for each metre that the
            rims travel, as identify_mecanum finds them.
        
        Returns
        -------
        DeadReckoning
            N poses.
        
        Raises
        ------
        ValueError
            If a shape does not fit, stamps decrease, a number is not finite or a covariance is none.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> wheels = est.MecanumOdometry(0.07, k=0.369)
        >>> t = np.linspace(0.0, 2.0, 101)
        >>> path = wheels.integrate(t, np.tile(wheels.wheel_speeds([0.2, 0.1, 0.0]), (101, 1)))
        >>> path.poses[-1, :2].round(3)
        array([0.4, 0.2])
        """
    def integrate_angles(self, t: numpy.typing.ArrayLike, wheel_angles: numpy.typing.ArrayLike, pose: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), covariance: numpy.typing.ArrayLike | None = None, *, twist_covariance: numpy.typing.ArrayLike | None = None, slip_variance: numpy.typing.ArrayLike | None = None) -> DeadReckoning:
        """
        Poses along a record of wheel angles.
        
        Of encoders: see angles_from_ticks.
        
        Parameters
        ----------
        t : (N,), s
            Not decreasing.
        wheel_angles : (N, 4), rad
            Whole turns included.
        pose, covariance, twist_covariance, slip_variance
            As for integrate.
        
        Returns
        -------
        DeadReckoning
            N poses.
        
        Raises
        ------
        ValueError
            As integrate.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> wheels = est.MecanumOdometry(0.1, k=0.5)
        >>> path = wheels.integrate_angles([0.0, 1.0], [[0, 0, 0, 0], [2.0, 2.0, 2.0, 2.0]])
        >>> path.poses[-1]
        array([0.2, 0. , 0. ])
        """
    def slip(self, wheel_speeds: numpy.typing.ArrayLike) -> float | numpy.typing.NDArray[numpy.float64]:
        """
        What four wheels say beyond the three numbers of a twist.
        
        R/4 (fl - rl - rr + fr): zero while all wheels roll. If not, each rim slips at least so fast. Of
        angles instead of speeds it is a way in m.
        
        Parameters
        ----------
        wheel_speeds : (4,) or (N, 4), rad/s
        
        Returns
        -------
        float or (N,), m/s
            Positive where the front wheels turn faster.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> wheels = est.MecanumOdometry(0.1, k=0.5)
        >>> wheels.slip(wheels.wheel_speeds([0.3, -0.2, 1.0])).__abs__() < 1e-15
        True
        >>> wheels.slip([1.0, 0.0, 0.0, 1.0])
        0.05
        """
    def twist(self, wheel_speeds: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Twist of the body, [M17] (3.20).
        
        Where the wheels contradict each other it is the one that fits them best (least squares).
        
        Parameters
        ----------
        wheel_speeds : (4,) or (N, 4), rad/s
            In the order of the wheels.
        
        Returns
        -------
        (3,) or (N, 3), m/s and rad/s
            (vx, vy, omega) in the axes of the body.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> est.MecanumOdometry(0.1, k=0.5).twist([1.0, 1.0, 1.0, 1.0])
        array([0.1, 0. , 0. ])
        """
    def wheel_speeds(self, twist: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Wheel speeds that roll without slipping, the inverse of [M17] (3.20).
        
        Parameters
        ----------
        twist : (3,) or (N, 3), m/s and rad/s
            (vx, vy, omega) in the axes of the body.
        
        Returns
        -------
        (4,) or (N, 4), rad/s
            In the order of the wheels.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> est.MecanumOdometry(0.1, k=0.5).wheel_speeds([0.0, 0.1, 0.0])
        array([-1.,  1., -1.,  1.])
        """
    @property
    def k(self) -> float:
        """
        Half the wheel base plus half the track, m.
        """
    @property
    def order(self) -> tuple:
        """
        Names of the wheels in the order of every array.
        """
    @property
    def wheel_radius(self) -> float:
        """
        Radius, m.
        """
class DifferentialDriveOdometry:
    """
    Odometry of two driven wheels on one axle; not in the theses.
    
    Parameters
    ----------
    wheel_radius : float or (2,), m
        Of both wheels, or (left, right).
    track : float, m
        Between the wheels' contact points.
    
    Raises
    ------
    ValueError
        If a length is not positive and finite.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> drive = est.DifferentialDriveOdometry((0.1, 0.101), track=0.4)
    >>> path = drive.integrate([0.0, 1.0, 2.0], np.full((3, 2), 2.0))
    >>> path.poses[-1].round(4)  # the right wheel is larger
    array([0.402, 0.002, 0.01 ])
    """
    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool:
        ...
    def __init__(self, wheel_radius: numpy.typing.ArrayLike, track: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def integrate(self, t: numpy.typing.ArrayLike, wheel_speeds: numpy.typing.ArrayLike, pose: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), covariance: numpy.typing.ArrayLike | None = None, *, twist_covariance: numpy.typing.ArrayLike | None = None, slip_variance: numpy.typing.ArrayLike | None = None) -> DeadReckoning:
        """
        Poses along a record of wheel speeds.
        
        Parameters
        ----------
        t : (N,), s
            Not decreasing.
        wheel_speeds : (N, 2), rad/s
            (left, right); row i is the mean since the stamp before.
        pose, covariance, twist_covariance, slip_variance
            As for MecanumOdometry.integrate.
        
        Returns
        -------
        DeadReckoning
            N poses.
        
        Raises
        ------
        ValueError
            If a shape does not fit, stamps decrease, a number is not finite or a covariance is none.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> drive = est.DifferentialDriveOdometry(0.1, track=0.4)
        >>> drive.integrate([0.0, 1.0], [[0.0, 0.0], [1.0, 1.0]]).poses[-1]
        array([0.1, 0. , 0. ])
        """
    def integrate_angles(self, t: numpy.typing.ArrayLike, wheel_angles: numpy.typing.ArrayLike, pose: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), covariance: numpy.typing.ArrayLike | None = None, *, twist_covariance: numpy.typing.ArrayLike | None = None, slip_variance: numpy.typing.ArrayLike | None = None) -> DeadReckoning:
        """
        Poses along a record of wheel angles.
        
        Parameters
        ----------
        t : (N,), s
            Not decreasing.
        wheel_angles : (N, 2), rad
            (left, right), whole turns included; of encoders: see angles_from_ticks.
        pose, covariance, twist_covariance, slip_variance
            As for MecanumOdometry.integrate.
        
        Returns
        -------
        DeadReckoning
            N poses.
        
        Raises
        ------
        ValueError
            As integrate.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> drive = est.DifferentialDriveOdometry(0.1, track=0.4)
        >>> drive.integrate_angles([0.0, 1.0], [[0.0, 0.0], [1.0, 1.0]]).poses[-1]
        array([0.1, 0. , 0. ])
        """
    def twist(self, wheel_speeds: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Twist of the middle of the axle.
        
        Parameters
        ----------
        wheel_speeds : (2,) or (N, 2), rad/s
            (left, right).
        
        Returns
        -------
        (3,) or (N, 3), m/s and rad/s
            (vx, 0, omega) in the axes of the body.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> est.DifferentialDriveOdometry(0.1, track=0.4).twist([1.0, 3.0])
        array([0.2, 0. , 0.5])
        """
    def wheel_speeds(self, twist: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Wheel speeds of a twist.
        
        Parameters
        ----------
        twist : (3,) or (N, 3), m/s and rad/s
            (vx, 0, omega) in the axes of the body.
        
        Returns
        -------
        (2,) or (N, 2), rad/s
            (left, right).
        
        Raises
        ------
        ValueError
            If vy is not zero.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> est.DifferentialDriveOdometry(0.1, track=0.4).wheel_speeds([0.2, 0.0, 0.5])
        array([1., 3.])
        """
    @property
    def track(self) -> float:
        """
        Between the wheels, m.
        """
    @property
    def wheel_radius(self) -> tuple[float, float]:
        """
        Radii (left, right), m.
        """
class MecanumIdentification:
    """
    What identify_mecanum has found.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> wheels, t = est.MecanumOdometry(0.07, k=0.4), np.linspace(0.0, 20.0, 401)
    >>> angles = np.cumsum(wheels.wheel_speeds(np.tile([0.3, 0.2, 0.0], (401, 1))) * 0.05, axis=0)
    >>> poses = wheels.integrate_angles(t, angles).poses
    >>> found = est.identify_mecanum(t, angles, t, poses, wheel_radius=0.08, k=0.5)
    >>> found.identifiable["k"], found.k  # the robot has never turned
    (False, 0.5)
    """
    def __repr__(self) -> str:
        ...
    def report(self) -> str:
        """
        The result in words.
        
        Returns
        -------
        str
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> wheels, t = est.MecanumOdometry(0.07, k=0.4), np.linspace(0.0, 20.0, 401)
        >>> twists = np.stack([0.3 * np.cos(t), 0.2 * np.sin(2 * t), 0.5 * np.sin(t)], axis=1)
        >>> angles = np.cumsum(wheels.wheel_speeds(twists) * 0.05, axis=0)
        >>> poses = wheels.integrate_angles(t, angles).poses
        >>> found = est.identify_mecanum(t, angles, t, poses, wheel_radius=0.08, k=0.5)
        >>> print(found.report().splitlines()[0])
        converged
        """
    @property
    def aligned_pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,), m and rad: the robot at t[0], place and yaw as fit the whole run best.
        """
    @property
    def clock_offset(self) -> float:
        """
        By how much the wheels' stamps are ahead of the reference's, s.
        """
    @property
    def clock_offset_std(self) -> float:
        """
        Its standard deviation, s.
        """
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (6, 6), in the order of names; what is not identifiable has its prior variance.
        """
    @property
    def identifiable(self) -> dict:
        """
        By name, whether the record shows it: at least half of the prior's deviation is gone.
        """
    @property
    def initial_pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,), m and rad: the robot at t[0], its place as first seen, its yaw as fits the whole run.
        """
    @property
    def iterations(self) -> int:
        """
        Of Gauss-Newton.
        """
    @property
    def k(self) -> float:
        """
        Half the wheel base plus half the track, m.
        """
    @property
    def k_std(self) -> float:
        """
        Its standard deviation, m: the prior's if it is not identifiable.
        """
    @property
    def mount(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,), m and rad: pose of the reference's body on the robot.
        """
    @property
    def names(self) -> tuple:
        """
        What the rows of the covariance are.
        """
    @property
    def nees(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (W,): normalized squared error of dead reckoning from start; 3 degrees of freedom.
        """
    @property
    def nees_inside(self) -> float:
        """
        Fraction of nees below the 95 % bound of chi-square.
        """
    @property
    def odometry(self) -> MecanumOdometry:
        """
        MecanumOdometry with these numbers.
        """
    @property
    def outliers(self) -> int:
        """
        Of these, those that were weighed down.
        """
    @property
    def reference_std(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,), m and rad: deviation of the reference in a window.
        """
    @property
    def rms_aligned(self) -> float:
        """
        Error of position, dead reckoning from aligned_pose, m.
        """
    @property
    def rms_nominal(self) -> float:
        """
        Error of position from the reference's first pose, nominal numbers, m.
        """
    @property
    def rms_unaligned(self) -> float:
        """
        Error of position, dead reckoning from initial_pose, m.
        """
    @property
    def slip_variance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,): variances of x, y (m^2) and theta (rad^2) for each metre of travel.
        """
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,), m and rad: the robot at that time, as the reference saw it there and then.
        """
    @property
    def start_covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3), in world axes.
        """
    @property
    def start_time(self) -> float:
        """
        Of the first window, s.
        """
    @property
    def status(self) -> str:
        """
        'converged', 'not converged' or 'too little motion'.
        """
    @property
    def success(self) -> bool:
        """
        Whether the least squares have converged.
        """
    @property
    def times(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (W,), s: middles of the windows after the first.
        """
    @property
    def wheel_radius(self) -> float:
        """
        Wheel radius, m.
        """
    @property
    def wheel_radius_std(self) -> float:
        """
        Its standard deviation, m.
        """
    @property
    def windows(self) -> int:
        """
        Motions between windows that were used.
        """
class MotionModel:
    """
    How a state moves, with its exact Jacobian and its noise.
    
    Made by the functions of thing_kin.estimation.models. It is passed to a filter in place of a function,
    and then runs in the core; or called, model(x, dt).
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> model = est.models.constant_velocity(2)
    >>> model
    constant_velocity: x, y, vx, vy
    >>> model([0.0, 0.0, 1.0, 0.5], 0.1)
    array([0.1 , 0.05, 1.  , 0.5 ])
    """
    def __call__(self, x: numpy.typing.ArrayLike, dt: typing.SupportsFloat | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
        """
        The state dt seconds later.
        
        Parameters
        ----------
        x : (n,) or (N, n)
        dt : float, s
        
        Returns
        -------
        (n,) or (N, n)
            With angles in (-pi, pi].
        """
    def __repr__(self) -> str:
        ...
    def jacobian(self, x: numpy.typing.ArrayLike, dt: typing.SupportsFloat | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
        """
        The derivative of the moved state with respect to x.
        
        Parameters
        ----------
        x : (n,) or (N, n)
        dt : float, s
        
        Returns
        -------
        (n, n) or (N, n, n)
        
        Raises
        ------
        ValueError
            If an argument has another shape or is not finite, or dt is negative.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> est.models.constant_velocity(1).jacobian([0.0, 1.0], 0.1)
        array([[1. , 0.1],
               [0. , 1. ]])
        """
    def process_noise(self, x: numpy.typing.ArrayLike, dt: typing.SupportsFloat | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
        """
        The covariance that the model's noise adds in dt seconds.
        
        Parameters
        ----------
        x : (n,) or (N, n)
        dt : float, s
        
        Returns
        -------
        (n, n) or (N, n, n)
        
        Raises
        ------
        ValueError
            If an argument has another shape or is not finite, or dt is negative.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> est.models.constant_velocity(1, noise=3.0).process_noise([0.0, 0.0], 1.0)
        array([[1. , 1.5],
               [1.5, 3. ]])
        """
    @property
    def angles(self) -> tuple:
        """
        Which of them are angles: what the filter is made with.
        """
    @property
    def n(self) -> int:
        """
        How many variables the state has.
        """
    @property
    def name(self) -> str:
        """
        What the function that made it is called.
        """
    @property
    def variables(self) -> tuple:
        """
        Their names, in order.
        """
class MeasurementModel:
    """
    What is measured of a state, with its exact Jacobian.
    
    Made by the functions of thing_kin.estimation.models. It is passed to a filter in place of a function,
    and then runs in the core; or called, model(x).
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> est.models.range_bearing((3.0, 4.0))([0.0, 0.0, 0.0]).round(3)
    array([5.   , 0.927])
    """
    def __call__(self, x: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        What is expected at a state.
        
        Parameters
        ----------
        x : (n,)
        
        Returns
        -------
        (m,)
            With angles in (-pi, pi].
        """
    def __repr__(self) -> str:
        ...
    def jacobian(self, x: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Its derivative with respect to the state.
        
        Parameters
        ----------
        x : (n,)
        
        Returns
        -------
        (m, n)
        
        Raises
        ------
        ValueError
            If x has too few entries or is not finite.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> est.models.components((2, 0)).jacobian([0.0, 0.0, 0.0])
        array([[0., 0., 1.],
               [1., 0., 0.]])
        """
    @property
    def angles(self) -> tuple:
        """
        Which of them are angles.
        """
    @property
    def m(self) -> int:
        """
        How many numbers are measured.
        """
    @property
    def name(self) -> str:
        """
        What the function that made it is called.
        """
class GaussianFilter:
    """
    What the filters share: a state, its covariance and the last update.
    
    KalmanFilter, ExtendedKalmanFilter and UnscentedKalmanFilter are made, not this. What is read is a
    copy; x and P can be set and are checked.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> filter = est.KalmanFilter([0.0, 0.0], np.eye(2))
    >>> filter.x = [1.0, 2.0]
    >>> isinstance(filter, est.GaussianFilter), filter.n
    (True, 2)
    """
    @property
    def K(self) -> numpy.typing.NDArray[numpy.float64] | None:
        """
        (n, m), the gain, [X21] (2.4); None before the first update.
        """
    @property
    def S(self) -> numpy.typing.NDArray[numpy.float64] | None:
        """
        (m, m), the innovation's covariance, [X21] (2.4); None before the first update.
        """
    @property
    def accepted(self) -> bool:
        """
        Whether the last update passed its gate and was made; False before the first.
        """
    @property
    def angles(self) -> tuple:
        """
        Which entries of the state are angles.
        """
    @property
    def innovation(self) -> numpy.typing.NDArray[numpy.float64] | None:
        """
        (m,), z minus what was expected, of the last update; None before the first.
        """
    @property
    def log_likelihood(self) -> float | None:
        """
        ln of the innovation's density, of the last update; None before the first.
        """
    @property
    def n(self) -> int:
        """
        How many entries the state has.
        """
    @property
    def nis(self) -> float | None:
        """
        Normalized innovation squared of the last update, chi-square of m; None before.
        """
    @property
    def status(self) -> str:
        """
        What came of the last step: 'ok'; or, with the state as it was, 'rejected' by the gate, 'singular' (the innovation has no positive covariance), 'not_positive' (the covariance would not be) or 'not_finite' (numbers would overflow).
        """
    @property
    def x(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,), the state; angles in (-pi, pi].
        """
    @x.setter
    def x(self, arg1: numpy.typing.ArrayLike) -> None:
        ...
class FilterRun:
    """
    A record of N rows, filtered.
    
    Each row is the state after its prediction and its update. What a filter's run() returns.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> filter = est.KalmanFilter([0.0], [[1.0]])
    >>> run = filter.run([1.0, np.nan, 2.0], F=[[1.0]], Q=[[0.1]], H=[[1.0]], R=[[1.0]])
    >>> run
    FilterRun(3 rows, 2 accepted)
    >>> run.status
    ['ok', 'missing', 'ok']
    >>> bool((run.x[-1] == filter.x).all())
    True
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def P(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, n, n), their covariances.
        """
    @property
    def P_smooth(self) -> numpy.typing.NDArray[numpy.float64] | None:
        """
        (N, n, n), smoothed; None unless asked for.
        """
    @property
    def accepted(self) -> numpy.typing.NDArray[numpy.bool]:
        """
        (N,) of bool: there was an update.
        """
    @property
    def innovations(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, m), z minus what was expected; NaN in rows without a measurement.
        """
    @property
    def log_likelihood(self) -> float:
        """
        The sum over the accepted measurements.
        """
    @property
    def nis(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N,), normalized innovations squared; NaN in rows without a measurement.
        """
    @property
    def status(self) -> list:
        """
        What came of each row: 'ok', 'missing', 'rejected' by the gate, or why a step was not made, as GaussianFilter.status.
        """
    @property
    def x(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (N, n), the states.
        """
    @property
    def x_smooth(self) -> numpy.typing.NDArray[numpy.float64] | None:
        """
        (N, n), smoothed; None unless asked for.
        """
class KalmanFilter(GaussianFilter):
    """
    The linear Kalman filter, [X21] (2.3) to (2.5).
    
    The update is in Joseph's form, (I - K H) P (I - K H)^T + K R K^T, so that P stays symmetric and
    positive. (2.4) misprints the gain, which is P H^T S^-1.
    
    Parameters
    ----------
    x : (n,), n up to 16
        The state.
    P : (n, n)
        Its covariance, positive semidefinite.
    angles : sequence of int
        Which entries of the state are angles: they are kept in (-pi, pi].
    
    Raises
    ------
    ValueError
        If an argument has another shape, is not finite or is no covariance; its name comes first.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> filter = est.KalmanFilter([0.0, 1.0], np.eye(2))
    >>> filter.predict(F=[[1.0, 0.1], [0.0, 1.0]], Q=0.01 * np.eye(2))
    True
    >>> filter.update([0.2], H=[[1.0, 0.0]], R=[[0.5]])
    True
    >>> filter.x.round(4)
    array([0.1671, 1.0066])
    """
    def __init__(self, x: numpy.typing.ArrayLike, P: numpy.typing.ArrayLike, *, angles: collections.abc.Sequence[int] = ()) -> None:
        ...
    def predict(self, F: numpy.typing.ArrayLike, Q: numpy.typing.ArrayLike, B: numpy.typing.ArrayLike | None = None, u: numpy.typing.ArrayLike | None = None) -> bool:
        """
        One step in time: x = F x + B u, P = F P F^T + Q, [X21] (2.3).
        
        Parameters
        ----------
        F : (n, n)
        Q : (n, n)
            Process noise, positive semidefinite.
        B : (n, k), optional
        u : (k,), optional
            An input.
        
        Returns
        -------
        bool
            Whether it was made; if not, the state is as it was, and status says why.
        
        Raises
        ------
        ValueError
            If an argument has another shape, is not finite or is no covariance; the state is as it was.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> filter = est.KalmanFilter([1.0], [[1.0]])
        >>> filter.predict([[1.0]], [[0.5]], B=[[2.0]], u=[3.0])
        True
        >>> filter.x, filter.P
        (array([7.]), array([[1.5]]))
        """
    def run(self, record: numpy.typing.ArrayLike, *, F: numpy.typing.ArrayLike, Q: numpy.typing.ArrayLike, H: numpy.typing.ArrayLike, R: numpy.typing.ArrayLike, B: numpy.typing.ArrayLike | None = None, u: numpy.typing.ArrayLike | None = None, gate: float | None = None, angles: collections.abc.Sequence[int] = (), smooth: bool = False) -> FilterRun:
        """
        Predict, then update, for each row of a record, in the core.
        
        The filter is then where the record ends. Smoothing is that of Rauch, Tung & Striebel.
        
        Parameters
        ----------
        record : (N, m), or (N,) for m = 1
            A row of NaN is no update.
        F : (n, n) or (N, n, n)
        Q : (n, n) or (N, n, n)
        H : (m, n) or (N, m, n)
        R : (m, m) or (N, m, m)
        B : (n, k) or (N, n, k), optional
        u : (k,) or (N, k), optional
        gate : float, optional
            As in update.
        angles : sequence of int
            As in update.
        smooth : bool
            Also estimate each state from the whole record.
        
        Returns
        -------
        FilterRun
        
        Raises
        ------
        ValueError
            As in predict and update, and if a row is NaN in part; the filter is as it was.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> filter = est.KalmanFilter([0.0], [[1.0]])
        >>> run = filter.run([1.0, 2.0], F=[[1.0]], Q=[[0.0]], H=[[1.0]], R=[[1.0]], smooth=True)
        >>> run.x.ravel(), run.x_smooth.ravel()
        (array([0.5, 1. ]), array([1., 1.]))
        """
    def update(self, z: numpy.typing.ArrayLike, H: numpy.typing.ArrayLike, R: numpy.typing.ArrayLike, gate: float | None = None, *, angles: collections.abc.Sequence[int] = ()) -> bool:
        """
        A measurement z = H x + noise, [X21] (2.4), (2.5), P in Joseph's form.
        
        Parameters
        ----------
        z : (m,), m up to 16
        H : (m, n)
        R : (m, m)
            Measurement noise, positive semidefinite.
        gate : float, optional
            A probability: the measurement is rejected if its NIS is beyond what a right one stays below with
            that probability.
        angles : sequence of int
            Which entries of z are angles.
        
        Returns
        -------
        bool
            Whether it was made; if not, the state is as it was, and status says why.
        
        Raises
        ------
        ValueError
            If an argument has another shape, is not finite, is no covariance or no probability; the state is
            as it was.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> filter = est.KalmanFilter([0.0], [[1.0]])
        >>> filter.update([9.0], [[1.0]], [[1.0]], gate=0.99)
        False
        >>> round(filter.nis, 6), filter.status
        (40.5, 'rejected')
        """
    @property
    def P(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n, n), the state's covariance: symmetric and positive definite, but for variances of zero.
        """
    @P.setter
    def P(self, arg1: numpy.typing.ArrayLike) -> None:
        ...
class ExtendedKalmanFilter(GaussianFilter):
    """
    The extended Kalman filter, [M17] (3.24), (3.25), in Joseph's form.
    
    Models are functions of one's own, with their Jacobians or without (then they are differentiated by
    central differences, 2 n calls each), or built in (thing_kin.estimation.models): these run in the core.
    check_jacobian compares a Jacobian of one's own with differences.
    
    Parameters
    ----------
    x : (n,), n up to 16
        The state.
    P : (n, n)
        Its covariance, positive semidefinite.
    angles : sequence of int
        Which entries of the state are angles: they are kept in (-pi, pi], and differences are the short
        way round. A planar pose (x, y, theta) has angles=(2,).
    
    Raises
    ------
    ValueError
        If an argument has another shape, is not finite or is no covariance; its name comes first.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> filter = est.ExtendedKalmanFilter([1.0, 2.0, 0.0], 0.1 * np.eye(3), angles=(2,))
    >>> filter.update([2.2, 0.1], lambda x: [np.hypot(*x[:2]), x[2]], 0.01 * np.eye(2), angles=(1,))
    True
    >>> filter.x.round(3)
    array([0.985, 1.971, 0.091])
    """
    def __init__(self, x: numpy.typing.ArrayLike, P: numpy.typing.ArrayLike, *, angles: collections.abc.Sequence[int] = ()) -> None:
        ...
    def predict(self, f: MotionModel | numpy.typing.ArrayLike | collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike], Q: numpy.typing.ArrayLike | None = None, jacobian: collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike] | None = None, *, dt: float | None = None) -> bool:
        """
        One step in time: x = f(x), P = F P F^T + Q, [M17] (3.24).
        
        Parameters
        ----------
        f : callable, MotionModel or (n, n)
            f(x) -> (n,), the state moved; a built-in model, which runs in the core; or a matrix.
        Q : (n, n), optional
            Process noise, positive semidefinite. Default, for a built-in model: its own over dt.
        jacobian : callable, optional
            jacobian(x) -> (n, n) of a function. Default: differences.
        dt : float, s, optional
            How far a built-in model moves, which needs it.
        
        Returns
        -------
        bool
            Whether it was made; if not, the state is as it was, and status says why.
        
        Raises
        ------
        ValueError
            If an argument or what a function returns has another shape, is not finite or is no covariance.
            What a function raises is raised. The state is as it was.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> filter = est.ExtendedKalmanFilter([0.0, 1.0], np.eye(2))
        >>> filter.predict(lambda x: [x[0] + np.sin(x[1]), x[1]], 0.01 * np.eye(2))
        True
        >>> filter.predict(est.models.constant_velocity(1), dt=0.5)
        True
        >>> filter.x.round(3)
        array([1.341, 1.   ])
        """
    def run(self, record: numpy.typing.ArrayLike, *, f: MotionModel | numpy.typing.ArrayLike | collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike], h: MeasurementModel | numpy.typing.ArrayLike | collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike], R: numpy.typing.ArrayLike, Q: numpy.typing.ArrayLike | None = None, f_jacobian: collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike] | None = None, h_jacobian: collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike] | None = None, dt: numpy.typing.ArrayLike | None = None, gate: float | None = None, angles: collections.abc.Sequence[int] = (), smooth: bool = False) -> FilterRun:
        """
        Predict, then update, for each row of a record; with built-in models, in the core.
        
        The filter is then where the record ends. Smoothing is that of Rauch, Tung & Striebel.
        
        Parameters
        ----------
        record : (N, m), or (N,) for m = 1
            A row of NaN is no update.
        f : callable, MotionModel, (n, n) or (N, n, n)
        h : callable, MeasurementModel, (m, n) or (N, m, n)
        R : (m, m) or (N, m, m)
        Q : (n, n) or (N, n, n), optional
            Default, for a built-in model: its own over dt.
        f_jacobian, h_jacobian : callable, optional
            As jacobian in predict and update.
        dt : float or (N,), s, optional
            How far a built-in model moves before each row.
        gate : float, optional
            As in update.
        angles : sequence of int
            As in update.
        smooth : bool
            Also estimate each state from the whole record.
        
        Returns
        -------
        FilterRun
        
        Raises
        ------
        ValueError
            As in predict and update, and if a row is NaN in part; the filter is as it was.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> filter = est.ExtendedKalmanFilter([0.0, 0.0], np.eye(2))
        >>> run = filter.run([1.0, np.nan, 4.0], f=est.models.constant_velocity(1), dt=[1.0, 1.0, 2.0],
        ...                  h=[[1.0, 0.0]], R=[[0.01]], smooth=True)
        >>> run.x_smooth[:, 0].round(2)
        array([1. , 1.9, 4. ])
        """
    def update(self, z: numpy.typing.ArrayLike, h: MeasurementModel | numpy.typing.ArrayLike | collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike], R: numpy.typing.ArrayLike, jacobian: collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike] | None = None, gate: float | None = None, *, angles: collections.abc.Sequence[int] = ()) -> bool:
        """
        A measurement z = h(x) + noise, [M17] (3.25).
        
        Parameters
        ----------
        z : (m,), m up to 16
        h : callable, MeasurementModel or (m, n)
            h(x) -> (m,), what is expected; a built-in model, which knows its angles; or a matrix.
        R : (m, m)
            Measurement noise, positive semidefinite.
        jacobian : callable, optional
            jacobian(x) -> (m, n) of a function. Default: differences.
        gate : float, optional
            A probability: the measurement is rejected if its NIS is beyond what a right one stays below with
            that probability.
        angles : sequence of int
            Which entries of z are angles.
        
        Returns
        -------
        bool
            Whether it was made; if not, the state is as it was, and status says why.
        
        Raises
        ------
        ValueError
            If an argument or what a function returns has another shape, is not finite or is no covariance,
            or gate is no probability. What a function raises is raised. The state is as it was.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> filter = est.ExtendedKalmanFilter([0.0, 0.0, 0.0], np.eye(3), angles=(2,))
        >>> filter.update([3.0, -0.1], est.models.range_bearing((3.0, 0.0)), 0.01 * np.eye(2))
        True
        >>> filter.status, round(filter.nis, 3)
        ('ok', 0.009)
        """
    @property
    def P(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n, n), the state's covariance: symmetric and positive definite, but for variances of zero.
        """
    @P.setter
    def P(self, arg1: numpy.typing.ArrayLike) -> None:
        ...
class UnscentedKalmanFilter(GaussianFilter):
    """
    The unscented Kalman filter with scaled sigma points, [X21] (2.6) to (2.9).
    
    Sigma points are redrawn after Q is added, from the lower Cholesky factor of P. The sums of (2.6) and
    (2.7) are taken as differences from the central point, in which the weights do not cancel; what may be
    taken away is one down-date of weight beta - alpha^2, and where that costs positivity the status says
    so and the state is as it was. (2.9) leaves the weights open: they are those of [40] there.
    
    Parameters
    ----------
    x : (n,), n up to 16
        The state.
    P : (n, n)
        Its covariance, positive semidefinite.
    alpha : float, optional
        Spread of the points, above 0. Default: 0.1.
    beta : float, optional
        Default: 2, best for Gaussians.
    kappa : float, optional
        Above -n. Default: 3 - n.
    angles : sequence of int
        Which entries of the state are angles: they are kept in (-pi, pi], and means and differences are
        taken the short way round from the central point. A planar pose (x, y, theta) has angles=(2,).
    square_root : bool
        Keep the factor of P rather than P: covariances are never added up.
    
    Raises
    ------
    ValueError
        If an argument has another shape, is not finite, out of range or no covariance; its name comes
        first.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> filter = est.UnscentedKalmanFilter([1.0, 2.0, 0.0], 0.1 * np.eye(3), angles=(2,))
    >>> filter.update([2.2, 0.1], lambda x: [np.hypot(*x[:2]), x[2]], 0.01 * np.eye(2), angles=(1,))
    True
    >>> filter.x.round(3)
    array([0.976, 1.953, 0.091])
    """
    def __init__(self, x: numpy.typing.ArrayLike, P: numpy.typing.ArrayLike, alpha: float | None = None, beta: float | None = None, kappa: float | None = None, *, angles: collections.abc.Sequence[int] = (), square_root: bool = False) -> None:
        ...
    def predict(self, f: MotionModel | numpy.typing.ArrayLike | collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike], Q: numpy.typing.ArrayLike | None = None, *, dt: float | None = None) -> bool:
        """
        One step in time, [X21] (2.6).
        
        Parameters
        ----------
        f : callable, MotionModel or (n, n)
            f(x) -> (n,), the state moved; a built-in model, which runs in the core; or a matrix.
        Q : (n, n), optional
            Process noise, positive semidefinite. Default, for a built-in model: its own over dt.
        dt : float, s, optional
            How far a built-in model moves, which needs it.
        
        Returns
        -------
        bool
            Whether it was made; if not, the state is as it was, and status says why.
        
        Raises
        ------
        ValueError
            If an argument or what a function returns has another shape, is not finite or is no covariance.
            What a function raises is raised. The state is as it was.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> filter = est.UnscentedKalmanFilter([0.0, 1.0], np.eye(2))
        >>> filter.predict(lambda x: [x[0] + np.sin(x[1]), x[1]], 0.01 * np.eye(2))
        True
        >>> filter.predict(est.models.constant_velocity(1), dt=0.5)
        True
        >>> filter.x.round(3)
        array([0.922, 1.   ])
        """
    def run(self, record: numpy.typing.ArrayLike, *, f: MotionModel | numpy.typing.ArrayLike | collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike], h: MeasurementModel | numpy.typing.ArrayLike | collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike], R: numpy.typing.ArrayLike, Q: numpy.typing.ArrayLike | None = None, dt: numpy.typing.ArrayLike | None = None, gate: float | None = None, angles: collections.abc.Sequence[int] = (), smooth: bool = False) -> FilterRun:
        """
        Predict, then update, for each row of a record; with built-in models, in the core.
        
        The filter is then where the record ends. Smoothing is the unscented one of Särkkä 2008.
        
        Parameters
        ----------
        record : (N, m), or (N,) for m = 1
            A row of NaN is no update.
        f : callable, MotionModel, (n, n) or (N, n, n)
        h : callable, MeasurementModel, (m, n) or (N, m, n)
        R : (m, m) or (N, m, m)
        Q : (n, n) or (N, n, n), optional
            Default, for a built-in model: its own over dt.
        dt : float or (N,), s, optional
            How far a built-in model moves before each row.
        gate : float, optional
            As in update.
        angles : sequence of int
            As in update.
        smooth : bool
            Also estimate each state from the whole record.
        
        Returns
        -------
        FilterRun
        
        Raises
        ------
        ValueError
            As in predict and update, and if a row is NaN in part; the filter is as it was.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> filter = est.UnscentedKalmanFilter([0.0, 0.0], np.eye(2))
        >>> run = filter.run([1.0, np.nan, 4.0], f=est.models.constant_velocity(1), dt=[1.0, 1.0, 2.0],
        ...                  h=[[1.0, 0.0]], R=[[0.01]], smooth=True)
        >>> run.x_smooth[:, 0].round(2)
        array([1. , 1.9, 4. ])
        """
    def sigma_points(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        The points that the next step is taken with, [X21] (2.9).
        
        Returns
        -------
        (2 n + 1, n)
            The state; then, for each column of the lower Cholesky factor of (n + lambda) P, the state plus
            it; then minus it.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> est.UnscentedKalmanFilter([1.0], [[4.0]], alpha=1.0, kappa=0.0).sigma_points().ravel()
        array([ 1.,  3., -1.])
        """
    def update(self, z: numpy.typing.ArrayLike, h: MeasurementModel | numpy.typing.ArrayLike | collections.abc.Callable[[numpy.typing.NDArray[numpy.float64]], numpy.typing.ArrayLike], R: numpy.typing.ArrayLike, gate: float | None = None, *, angles: collections.abc.Sequence[int] = ()) -> bool:
        """
        A measurement z = h(x) + noise, [X21] (2.7), (2.8).
        
        Parameters
        ----------
        z : (m,), m up to 16
        h : callable, MeasurementModel or (m, n)
            h(x) -> (m,), what is expected; a built-in model, which knows its angles; or a matrix.
        R : (m, m)
            Measurement noise, positive semidefinite.
        gate : float, optional
            A probability: the measurement is rejected if its NIS is beyond what a right one stays below with
            that probability.
        angles : sequence of int
            Which entries of z are angles.
        
        Returns
        -------
        bool
            Whether it was made; if not, the state is as it was, and status says why.
        
        Raises
        ------
        ValueError
            If an argument or what a function returns has another shape, is not finite or is no covariance,
            or gate is no probability. What a function raises is raised. The state is as it was.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> filter = est.UnscentedKalmanFilter([0.0, 0.0, 0.0], np.eye(3), angles=(2,))
        >>> filter.update([3.0, -0.1], est.models.range_bearing((3.0, 0.0)), 0.01 * np.eye(2))
        True
        >>> filter.status, round(filter.nis, 3)
        ('ok', 0.035)
        """
    @property
    def P(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n, n), the state's covariance: symmetric and positive definite, but for variances of zero.
        """
    @P.setter
    def P(self, arg1: numpy.typing.ArrayLike) -> None:
        ...
    @property
    def alpha(self) -> float:
        """
        Spread of the points.
        """
    @property
    def beta(self) -> float:
        """
        2 for Gaussians.
        """
    @property
    def kappa(self) -> float:
        """
        3 - n by default.
        """
    @property
    def square_root(self) -> bool:
        """
        Whether the factor of P is kept.
        """
class EndEffector:
    """
    The hand, and how well its place is known.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> from thing_kin import estimation as est
    >>> hand = est.end_effector(tk.robots.thing(), np.zeros(6), [1.0, 2.0, 0.0], joint_std=1e-3)
    >>> hand.pose.shape, hand.task_covariance.shape
    ((4, 4), (10, 10))
    """
    def __repr__(self) -> str:
        ...
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (6, 6) or (N, 6, 6), [position, rotation], m and rad, axes of the world: R = exp(phi) R_mean.
        """
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4, 4) or (N, 4, 4), in the world.
        """
    @property
    def task_covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (10, 10) or (N, 10, 10), positive semidefinite: none along the quaternion.
        """
    @property
    def task_vector(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (10,) or (N, 10): [p, quaternion w x y z, x, y, theta], [M17] (3.5).
        """
class BaseEstimate:
    """
    Where the base is at a time, and how sure that is.
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> est.BaseLocalizer(pose=(1, 2, 0.5), t=0.0).estimate().pose
    array([1. , 2. , 0.5])
    """
    def __repr__(self) -> str:
        ...
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3), of the pose, in world axes.
        """
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,): x, y, theta in m and rad, theta in (-pi, pi].
        """
    @property
    def t(self) -> float:
        """
        Time of the estimate, s.
        """
    @property
    def twist(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,): vx, vy, omega in the body, m/s and rad/s.
        
        The mean over the stretch that ends at t; zero in what no source measures.
        """
    @property
    def twist_covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3), of the twist; zero in what no source measures.
        """
class NisStatistics:
    """
    What a source says of its own covariance.
    
    The normalized innovation squared of its accepted measurements. Where model and covariances are
    right, `mean` is `dof` and `within` 0.95; a mean far above says that the source is worse than it
    claims, far below that it is better.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> localizer = est.BaseLocalizer(covariance=np.eye(3))
    >>> localizer.add_pose(0.0, (1.0, 0.0, 0.0), np.eye(3), source="lidar")
    True
    >>> round(localizer.nis["lidar"].mean, 9), localizer.nis["lidar"].dof
    (0.5, 3.0)
    """
    @property
    def count(self) -> int:
        """
        Measurements that there was something to compare with.
        """
    @property
    def dof(self) -> float:
        """
        Mean number of entries compared: what the mean NIS should be.
        """
    @property
    def mean(self) -> float:
        """
        Mean of the NIS; 0 without measurements.
        """
    @property
    def within(self) -> float:
        """
        Share in the central 95 % band.
        """
class BaseLocalizer:
    """
    Fuses what any number of sources say of a planar base, in any order.
    
    What robot_localization is run for, without ROS: wheels, gyros, LIDAR odometry and poses from a map,
    each by name with a covariance and a gate. Measurements may come late and out of order: the last
    seconds are kept, and what follows a late one is computed again, so that the result depends on what
    was measured and not on when it came. [M17] 3.3; the model stands in the chapter "Localizing the
    base".
    
    Parameters
    ----------
    pose : (3,), m and rad
        Where the base is when time begins.
    covariance : (3, 3), optional
        How sure that is, world axes. Default: 1e-6 on the diagonal.
    gate : float
        A pose, motion or yaw whose NIS exceeds this quantile of its distribution is rejected; 1 takes
        everything. Sources may have their own.
    process_noise : (3, 3), optional
        What is added to the pose's covariance each second, world axes: what no source accounts for.
        Default: 1e-4 on the diagonal.
    history : float, s
        How late a measurement may come.
    t : float, optional, s
        When time begins. Default: with the first measurement.
    filter : {'ekf', 'ukf'}
        How uncertain headings are carried: to first order, or by sigma points (alpha = 1, beta = 0,
        kappa = 0).
    sources : dict, optional
        Arguments of `source()` by name.
    
    Raises
    ------
    ValueError
        If an argument is not finite, no covariance or out of its range.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> localizer = est.BaseLocalizer(t=0.0)
    >>> for k in range(1, 51):
    ...     _ = localizer.add_twist(0.02 * k, (0.5, 0.0, 0.0), 1e-3 * np.eye(3), source="wheels")
    >>> localizer.estimate().pose.round(9)
    array([0.5, 0. , 0. ])
    >>> localizer.add_pose(0.5, (0.26, 0.0, 0.0), 1e-6 * np.eye(3), source="lidar")  # half a second late
    True
    >>> localizer.accepted
    {'lidar': 1, 'wheels': 50}
    """
    @staticmethod
    def restore(state: bytes) -> BaseLocalizer:
        """
        Return the localizer that was saved; it goes on to the same bits.
        
        Parameters
        ----------
        state : bytes
            What `save` returned.
        
        Returns
        -------
        BaseLocalizer
        
        Raises
        ------
        ValueError
            If the bytes are no such state, of another version, cut or changed.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> est.BaseLocalizer.restore(est.BaseLocalizer(t=3.0).save()).estimate().t
        3.0
        """
    def __copy__(self) -> BaseLocalizer:
        ...
    def __deepcopy__(self, memo: dict) -> BaseLocalizer:
        ...
    def __getstate__(self) -> bytes:
        ...
    def __init__(self, pose: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), covariance: numpy.typing.ArrayLike | None = None, gate: typing.SupportsFloat | typing.SupportsIndex = 0.999, *, process_noise: numpy.typing.ArrayLike | None = None, history: typing.SupportsFloat | typing.SupportsIndex = 10.0, t: typing.SupportsFloat | typing.SupportsIndex | None = None, filter: str = 'ekf', sources: dict | None = None) -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: bytes) -> None:
        ...
    def add_pose(self, t: typing.SupportsFloat | typing.SupportsIndex, pose: numpy.typing.ArrayLike, covariance: numpy.typing.ArrayLike | None = None, *, source: str) -> bool:
        """
        Take a pose, as of a map, a marker or motion capture.
        
        Parameters
        ----------
        t : float, s
        pose : (3,), m and rad
        covariance : (3, 3), optional
            World axes. Default: the source's.
        source : str
        
        Returns
        -------
        bool
            False if it is older than the history, which `refused` counts.
        
        Raises
        ------
        ValueError
            That names the source; then nothing has changed.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> localizer = est.BaseLocalizer(covariance=np.eye(3))
        >>> localizer.add_pose(1.7e9, (1.0, 0.0, 0.0), np.eye(3), source="lidar")
        True
        >>> localizer.estimate().pose
        array([0.5, 0. , 0. ])
        """
    def add_relative_pose(self, t1: typing.SupportsFloat | typing.SupportsIndex, t2: typing.SupportsFloat | typing.SupportsIndex, motion: numpy.typing.ArrayLike, covariance: numpy.typing.ArrayLike | None = None, *, source: str) -> bool:
        """
        Take a motion between two times: the pose at t2 as the base at t1 saw it.
        
        The pose at t1 is kept, correlated with the present, so that what the twists said of the same way is
        not counted twice. At most eight motions may overlap at any time; one more is rejected.
        
        Parameters
        ----------
        t1, t2 : float, s
            t1 < t2, at most the history apart.
        motion : (3,), m and rad
            As `lie.se2_between(pose1, pose2)`.
        covariance : (3, 3), optional
            In the axes of the base at t1. Default: the source's.
        source : str
        
        Returns
        -------
        bool
            False if t1 is older than the history, which `refused` counts.
        
        Raises
        ------
        ValueError
            That names the source; then nothing has changed.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> localizer = est.BaseLocalizer(t=0.0)
        >>> localizer.add_twist(1.0, (1.0, 0.0, 0.0), 1e-2 * np.eye(3), source="wheels")
        True
        >>> localizer.add_relative_pose(0.0, 1.0, (1.1, 0.0, 0.0), 1e-6 * np.eye(3), source="scan")
        True
        >>> localizer.estimate().pose.round(3)
        array([1.1, 0. , 0. ])
        """
    def add_twist(self, t: typing.SupportsFloat | typing.SupportsIndex, twist: numpy.typing.ArrayLike, covariance: numpy.typing.ArrayLike | None = None, *, source: str) -> bool:
        """
        Take a twist: the mean since the previous stamp of that source.
        
        It is held until the next. Its error is one draw: over T seconds it moves the pose by R T^2.
        
        Parameters
        ----------
        t : float, s
        twist : (3,)
            vx, vy, omega in the body, m/s and rad/s.
        covariance : (3, 3), optional
            Default: the source's.
        source : str
        
        Returns
        -------
        bool
            False if it is older than the history, which `refused` counts.
        
        Raises
        ------
        ValueError
            That names the source; then nothing has changed.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> localizer = est.BaseLocalizer(t=0.0)
        >>> localizer.add_twist(1.0, (1.0, 0.0, np.pi / 2), np.eye(3), source="wheels")
        True
        >>> localizer.estimate().pose.round(4)  # a quarter of a circle
        array([0.6366, 0.6366, 1.5708])
        """
    def add_yaw(self, t: typing.SupportsFloat | typing.SupportsIndex, yaw: typing.SupportsFloat | typing.SupportsIndex, variance: numpy.typing.ArrayLike | None = None, *, source: str) -> bool:
        """
        Take a heading, as of a compass: a pose of which theta counts.
        
        Parameters
        ----------
        t : float, s
        yaw : float, rad
        variance : float, optional, rad^2
            Default: the source's.
        source : str
        
        Returns
        -------
        bool
            False if it is older than the history, which `refused` counts.
        
        Raises
        ------
        ValueError
            That names the source; then nothing has changed.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> localizer = est.BaseLocalizer(pose=(0, 0, 3.0), covariance=np.eye(3))
        >>> localizer.add_yaw(0.0, -3.0, 1.0, source="compass")  # no jump at pi
        True
        >>> float(abs(localizer.estimate().pose[2]).round(6))
        3.141593
        """
    def add_yaw_rate(self, t: typing.SupportsFloat | typing.SupportsIndex, rate: typing.SupportsFloat | typing.SupportsIndex, variance: numpy.typing.ArrayLike | None = None, *, source: str) -> bool:
        """
        Take a yaw rate, as of a gyro: a twist of which omega counts.
        
        Parameters
        ----------
        t : float, s
        rate : float, rad/s
        variance : float, optional, (rad/s)^2
            Default: the source's.
        source : str
        
        Returns
        -------
        bool
            False if it is older than the history, which `refused` counts.
        
        Raises
        ------
        ValueError
            That names the source; then nothing has changed.
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> localizer = est.BaseLocalizer(t=0.0)
        >>> localizer.add_yaw_rate(1.0, 0.25, 1e-4, source="imu")
        True
        >>> localizer.estimate().pose
        array([0.  , 0.  , 0.25])
        """
    def estimate(self, t: typing.SupportsFloat | typing.SupportsIndex | None = None) -> BaseEstimate:
        """
        Estimate pose and twist at a time.
        
        Parameters
        ----------
        t : float, optional, s
            Within the history, or later: then the twist is held, and the uncertainty grows. Default: the
            time of the latest measurement.
        
        Returns
        -------
        BaseEstimate
        
        Raises
        ------
        ValueError
            Before the first measurement, or before the history.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> localizer = est.BaseLocalizer(t=0.0)
        >>> localizer.add_twist(1.0, (1.0, 0.0, 0.0), 1e-4 * np.eye(3), source="wheels")
        True
        >>> ahead = localizer.estimate(3.0)
        >>> ahead.pose, bool(ahead.covariance[0, 0] > localizer.estimate().covariance[0, 0])
        (array([3., 0., 0.]), True)
        """
    def reset(self, pose: numpy.typing.ArrayLike, covariance: numpy.typing.ArrayLike, t: typing.SupportsFloat | typing.SupportsIndex | None = None) -> None:
        """
        Begin anew: picked up and put down. Sources stay, and so do their counts.
        
        Parameters
        ----------
        pose : (3,), m and rad
        covariance : (3, 3)
        t : float, optional, s
            When time begins; what is older is refused from now on. Default: with the next measurement.
        
        Raises
        ------
        ValueError
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import estimation as est
        >>> localizer = est.BaseLocalizer()
        >>> localizer.reset((1.0, 2.0, 0.5), 1e-4 * np.eye(3), t=30.0)
        >>> localizer.estimate().t
        30.0
        """
    def save(self) -> bytes:
        """
        Return everything as bytes of a versioned format, for `restore`. It also pickles.
        
        Returns
        -------
        bytes
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> localizer = est.BaseLocalizer(t=0.0)
        >>> est.BaseLocalizer.restore(localizer.save()).estimate().t
        0.0
        """
    def source(self, name: str, *, fuse: collections.abc.Sequence[str] | None = None, covariance: numpy.typing.ArrayLike | None = None, gate: typing.SupportsFloat | typing.SupportsIndex | None = None) -> None:
        """
        Declare a source, or change it for measurements to come.
        
        A source that is not declared has all variables, the localizer's gate, and must bring a covariance
        with each measurement.
        
        Parameters
        ----------
        name : str
        fuse : sequence of str, optional
            Out of 'x', 'y', 'theta', 'vx', 'vy', 'omega'. Default: all that it measures.
        covariance : (3, 3) or float, optional
            Where a measurement brings none; a float stands for all variables.
        gate : float, optional
            Default: the localizer's, for poses, motions and yaw. Twists are only gated by a source's own:
            they are compared with what other sources measure at the same time.
        
        Raises
        ------
        ValueError
        
        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> localizer = est.BaseLocalizer()
        >>> localizer.source("imu", fuse=["omega", "theta"], covariance=1e-4, gate=0.99)
        >>> localizer.add_yaw_rate(0.0, 0.1, source="imu")
        True
        """
    @property
    def accepted(self) -> dict:
        """
        Measurements that count, by source: the verdict as it stands now.
        """
    @property
    def history(self) -> float:
        """
        How late a measurement may come, s.
        """
    @property
    def latest(self) -> float | None:
        """
        Time of the latest measurement, s; None before the first.
        """
    @property
    def nis(self) -> dict:
        """
        NisStatistics by source.
        """
    @property
    def refused(self) -> dict:
        """
        Measurements that were older than the history when they came, by source.
        """
    @property
    def rejected(self) -> dict:
        """
        Measurements that a gate holds back, by source.
        """
def angles_from_ticks(ticks: numpy.typing.ArrayLike, ticks_per_turn: typing.SupportsFloat | typing.SupportsIndex, *, counter_range: typing.Any = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    Wheel angles from encoder counts.
    
    Parameters
    ----------
    ticks : (N, wheels)
    ticks_per_turn : float
        Of the wheel: an encoder's on the motor times the gear's ratio.
    counter_range : float, optional
        How many values the counter has, if it starts anew after the last one: 65536 for 16 bits. No
        wheel may turn by half of it from one row to the next. Default: it does not overflow.
    
    Returns
    -------
    (N, wheels), rad
        Whole turns included.
    
    Raises
    ------
    ValueError
        If the shape does not fit or a number is not finite, or not positive.
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> est.angles_from_ticks([[65530], [10]], ticks_per_turn=360, counter_range=65536).round(3)
    array([[1143.714],
           [1143.994]])
    """
def chi_square_quantile(probability: numpy.typing.ArrayLike, dof: typing.SupportsInt | typing.SupportsIndex) -> float | numpy.typing.NDArray[numpy.float64]:
    """
    What a chi-square variable stays below with a probability.
    
    A gate of 0.99 on a measurement of two numbers is chi_square_quantile(0.99, 2) of its NIS.
    
    Parameters
    ----------
    probability : float, or (N,)
        From 0 to 1.
    dof : int
        Degrees of freedom, 1 to 10^6.
    
    Returns
    -------
    float, or (N,)
        Relative error about 1e-14; inf for 1.
    
    Raises
    ------
    ValueError
        If an argument is out of range.
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> round(est.chi_square_quantile(0.95, 3), 12)
    7.814727903251
    """
def dead_reckon(pose: numpy.typing.ArrayLike, twists: numpy.typing.ArrayLike, dt: numpy.typing.ArrayLike, covariance: numpy.typing.ArrayLike | None = None, twist_covariance: numpy.typing.ArrayLike | None = None) -> DeadReckoning:
    """
    Poses along a whole record of twists, with their covariances.
    
    Errors of successive twists are independent: a twist's covariance R enters the pose as R dt^2.
    
    Parameters
    ----------
    pose : (3,), m and rad
        Where the record begins.
    twists : (N, 3), m/s and rad/s
        In the axes of the body, each held for its dt.
    dt : float or (N,), s
    covariance : (3, 3), optional
        Of the start, in world axes; default: zero.
    twist_covariance : (3, 3), optional
        In the axes of the body; default: diag(0.001, 0.001, 0.03), [M17] (3.22).
    
    Returns
    -------
    DeadReckoning
        N + 1 poses.
    
    Raises
    ------
    ValueError
        If a shape does not fit, a number is not finite or a covariance is none.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> path = est.dead_reckon([0, 0, 0], np.tile([0.5, 0.0, 0.1], (100, 1)), dt=0.1)
    >>> np.allclose(path.poses[-1], est.integrate_twist([0, 0, 0], [0.5, 0.0, 0.1], 10.0))
    True
    >>> np.sqrt(np.diag(path.covariances[-1])).round(3)
    array([0.289, 0.395, 0.173])
    """
def end_effector(robot: thing_kin._core.Chain, q_arm: numpy.typing.ArrayLike, estimate: typing.Any, joint_std: numpy.typing.ArrayLike = 0.0, *, joint_covariance: typing.Any = None, mount: typing.Any = None, mount_covariance: typing.Any = None, frame: str | None = None) -> EndEffector:
    """
    Pose of the hand on a base whose pose is estimated, with its covariance.
    
    To first order, J P J^T, for independent errors of the arm's joints, the base and the mount; the
    task vector's is that of [M17] (3.5). With errors of angles of 0.1 rad a tenth of the covariance is
    beyond that, and the mean is off by the sagitta, reach/2 times the variance.
    
    Parameters
    ----------
    robot : Chain
        On an omnidirectional base, or an arm alone that stands on a base at `mount`.
    q_arm : (n,) or (N, n), rad and m
        The arm's joints, in their order in q; those of the base are the estimate's.
    estimate : object, tuple or array
        Of the base: what has `pose` (3,) and `covariance` (3, 3), as BaseLocalizer.estimate() gives,
        covariance in world axes; a tuple of the two; or a pose alone, exactly known. Or N of each.
    joint_std : float or (n,), rad and m
        Standard deviations of the joints.
    joint_covariance : (n, n), optional
        Instead of them.
    mount : (4, 4), optional
        Pose of the arm's root in the base, for an arm alone; default: the identity.
    mount_covariance : (6, 6), optional
        Of the arm's root on the base, [position, rotation], in the axes of the base, the small
        rotation on the left. Default: exactly known.
    frame : str, optional
        Default: the tool.
    
    Returns
    -------
    EndEffector
    
    Raises
    ------
    ValueError
        If a shape does not fit, a number is not finite, a covariance is none, or the frame is not one
        of the arm.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> from thing_kin import estimation as est
    >>> robot, q_arm = tk.robots.thing(), np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0])
    >>> base = ([1.0, 2.0, 0.5], np.diag([1e-4, 1e-4, 1e-6]))
    >>> hand = est.end_effector(robot, q_arm, base, joint_std=1e-3)
    >>> np.sqrt(np.diag(hand.covariance)[:3]).round(4)  # of the position, m
    array([0.01  , 0.0101, 0.0011])
    """
def identify_mecanum(t: numpy.typing.ArrayLike, wheel_angles: numpy.typing.ArrayLike, t_reference: numpy.typing.ArrayLike, poses: numpy.typing.ArrayLike, order: typing.Any = ('fl', 'rl', 'rr', 'fr'), *, wheel_radius: typing.Any = None, k: typing.Any = None, wheel_radius_std: typing.SupportsFloat | typing.SupportsIndex = 0.2, k_std: typing.SupportsFloat | typing.SupportsIndex = 0.2, mount: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), mount_std: numpy.typing.ArrayLike = (0.1, 0.1, 3.0), clock_offset_std: typing.SupportsFloat | typing.SupportsIndex = 0.0, window: typing.SupportsFloat | typing.SupportsIndex = 1.0, longest_gap: typing.SupportsFloat | typing.SupportsIndex = 0.3) -> MecanumIdentification:
    """
    Wheel radius and k of [M17] (3.20) from a record with reference poses.
    
    Errors of odometry add up along the way, so that motions between windows of time are compared, never
    absolute poses. A window's reference is the median of its poses, each carried to the window's middle
    by the wheels; outlying poses and windows hardly count. The noise of both is estimated from the
    record: that of the wheels as a random walk whose variance grows with the way, that of the reference
    as shared by the motions before and after a window. Generalized least squares on SE(2), with priors.
    
    A number is identifiable if the record leaves less than half of its prior's standard deviation. What
    is not keeps its nominal value and its prior variance, and the others' covariance accounts for that.
    
    Parameters
    ----------
    t : (N,), s
        Of the wheels; not decreasing.
    wheel_angles : (N, 4), rad
        Whole turns included; of encoders: see angles_from_ticks; of speeds: their integral.
    t_reference : (M,), s
        Of the reference, by the same clock (see clock_offset_std); not decreasing.
    poses : (M, 3), m and rad
        (x, y, theta) of a body fixed to the robot, in a world of its own.
    order : sequence of str
        Which wheel is which, as in MecanumOdometry.
    wheel_radius, k : float, m, optional
        Nominal values. Default: some 0.1 m within a factor of 3, some 0.4 m within a factor of 2.
    wheel_radius_std, k_std : float
        Standard deviations of these, as fractions of them; 0: exactly known.
    mount : (3,), m and rad
        Nominal pose of the reference's body on the robot: x, y, yaw.
    mount_std : (3,), m and rad
        Standard deviations; 0: exactly known.
    clock_offset_std : float, s
        Standard deviation of the wheels' stamps from the reference's clock; offsets up to three times
        as large are searched, at most 20 s (50 windows, if those are shorter
        than 0.4 s) and half of the record. Default: one clock.
    window : float, s
        Long enough to hold several reference poses, short enough that the wheels lead through it.
    longest_gap : float, s
        A motion during which the wheels' stamps have a longer gap is left out, if they turned.
    
    Returns
    -------
    MecanumIdentification
    
    Raises
    ------
    ValueError
        If a shape does not fit, stamps decrease or share no time, or a number is not finite.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> wheels, t = est.MecanumOdometry(0.07, k=0.4), np.linspace(0.0, 20.0, 401)
    >>> twists = np.stack([0.3 * np.cos(t), 0.2 * np.sin(2 * t), 0.5 * np.sin(t)], axis=1)
    >>> angles = np.cumsum(wheels.wheel_speeds(twists) * 0.05, axis=0)
    >>> poses = wheels.integrate_angles(t, angles).poses
    >>> found = est.identify_mecanum(t, angles, t, poses, wheel_radius=0.08, k=0.5)
    >>> round(found.wheel_radius, 4), round(found.k, 3)
    (0.07, 0.4)
    """
def integrate_twist(pose: numpy.typing.ArrayLike, twist: numpy.typing.ArrayLike, dt: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Pose after a constant twist of the body; exact on SE(2), not in steps.
    
    Parameters
    ----------
    pose : (3,) or (N, 3), m and rad
        (x, y, theta) in the world.
    twist : (3,) or (N, 3), m/s and rad/s
        (vx, vy, omega) in the axes of the body.
    dt : float or (N,), s
    
    Returns
    -------
    (3,) or (N, 3), m and rad
        theta in (-pi, pi].
    
    Raises
    ------
    ValueError
        If a shape does not fit, or a number is not finite.
    
    See Also
    --------
    dead_reckon : a whole record, with covariances
    
    Examples
    --------
    A quarter of a circle of radius 1 m:
    
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> pose = est.integrate_twist([0.0, 0.0, 0.0], [np.pi / 2, 0.0, np.pi / 2], 1.0)
    >>> np.allclose(pose, [1.0, 1.0, np.pi / 2])
    True
    """
def integrate_twist_jacobians(pose: numpy.typing.ArrayLike, twist: numpy.typing.ArrayLike, dt: typing.SupportsFloat | typing.SupportsIndex) -> tuple:
    """
    Derivatives of integrate_twist by the pose and by the twist.
    
    With them a covariance goes through: P <- F P F^T + G R G^T, all in world axes but R.
    
    Parameters
    ----------
    pose : (3,), m and rad
    twist : (3,), m/s and rad/s
    dt : float, s
    
    Returns
    -------
    F : (3, 3)
        By the pose.
    G : (3, 3)
        By the twist.
    
    Raises
    ------
    ValueError
        If a shape does not fit, or a number is not finite.
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> F, G = est.integrate_twist_jacobians([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], 0.5)
    >>> F
    array([[ 1. ,  0. , -0. ],
           [ 0. ,  1. ,  0.5],
           [ 0. ,  0. ,  1. ]])
    """
def nees(truth: numpy.typing.ArrayLike, x: numpy.typing.ArrayLike, P: numpy.typing.ArrayLike, *, angles: collections.abc.Sequence[int] = ()) -> float | numpy.typing.NDArray[numpy.float64]:
    """
    Normalized estimation error squared, (truth - x)^T P^-1 (truth - x).
    
    Of a consistent filter it is chi-square with n degrees of freedom; see consistency.
    
    Parameters
    ----------
    truth : (n,) or (N, n), n up to 16
    x : (n,) or (N, n)
    P : (n, n) or (N, n, n)
    angles : sequence of int
        Which entries of the state are angles.
    
    Returns
    -------
    float, or (N,)
    
    Raises
    ------
    ValueError
        If shapes do not fit, a number is not finite or a P has no inverse.
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> est.nees([1.0, 2.0], [0.0, 0.0], [[1.0, 0.0], [0.0, 4.0]])
    2.0
    """
def numeric_jacobian(f: collections.abc.Callable, x: numpy.typing.ArrayLike, *, angles: collections.abc.Sequence[int] = ()) -> numpy.typing.NDArray[numpy.float64]:
    """
    The Jacobian of a function by central differences, as the extended filter takes it.
    
    Parameters
    ----------
    f : callable
        f(x) -> (m,), m up to 16.
    x : (n,), n up to 16
    angles : sequence of int
        Which entries of f(x) are angles, whose differences are the short way round.
    
    Returns
    -------
    (m, n)
        With an error of about 1e-10 of f's size.
    
    Raises
    ------
    ValueError
        If x or what f returns is no vector of finite numbers.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> est.numeric_jacobian(lambda x: [x[0] * x[1], np.sin(x[0])], [0.0, 2.0]).round(6)
    array([[2., 0.],
           [1., 0.]])
    """
def pose_difference(a: numpy.typing.ArrayLike, b: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    The difference a - b of planar poses in world axes, theta wrapped.
    
    Its covariance is that of a plus that of b (both in world axes) if their errors are independent.
    
    Parameters
    ----------
    a, b : (3,) or (N, 3), m and rad
    
    Returns
    -------
    (3,) or (N, 3), m and rad
        theta in (-pi, pi].
    
    Raises
    ------
    ValueError
        If a shape does not fit, or a number is not finite.
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> est.pose_difference([1.0, 2.0, 3.0], [0.5, 2.0, -3.0]).round(3)
    array([ 0.5  ,  0.   , -0.283])
    """
