"""
LIDAR odometry. Private: import its names from thing_kin.odometry.
"""
from __future__ import annotations
import numpy
import numpy.typing
import typing
__all__: list[str] = ['LaserOdometry', 'LaserStep', 'ScanMatch', 'Scanner', 'match']
class Scanner:
    """
    A planar laser scanner: where its beams go, what they can see.
    
    Immutable. Angles in the scanner's frame, from the first beam to the last; they fall for a scanner
    that turns clockwise or hangs upside down.
    
    Parameters
    ----------
    angle_min, angle_max : float, rad
        Of the first and the last beam, at most 4 pi in size.
    n : int
        How many beams, 1 to 65536, evenly spaced from `angle_min` to `angle_max`.
    range_min, range_max : float, m
        What is nearer than `range_min`, or as far as `range_max` or further, is no return.
    mount : (3,), m and rad
        Pose (x, y, yaw) of the scanner in the robot's frame.
    scan_time : float, s
        From the first beam to the last; 0 for scans that are flat in time or corrected already. A
        robot that moves meanwhile is taken into account.
    noise : float, m
        One standard deviation of a range.
    
    Raises
    ------
    ValueError
        If a number is out of its range; the message names it.
    
    Examples
    --------
    >>> from thing_kin import odometry
    >>> scanner = odometry.Scanner(-1.5, 1.5, 4, range_max=30.0)
    >>> scanner.angles
    array([-1.5, -0.5,  0.5,  1.5])
    """
    @staticmethod
    def ust10lx(mount: numpy.typing.ArrayLike = (0, 0, 0)) -> Scanner:
        """
        The Hokuyo UST-10LX of [M17] 3.3.2.
        
        270 degrees in steps of a quarter, 0.06 to 10 m, 40 turns a second, of which the beams take three
        quarters.
        
        Parameters
        ----------
        mount : (3,), m and rad
            Pose (x, y, yaw) of the scanner in the robot's frame.
        
        Returns
        -------
        Scanner
        
        Examples
        --------
        >>> from thing_kin import odometry
        >>> odometry.Scanner.ust10lx().n
        1081
        """
    @typing.overload
    def __eq__(self, arg0: Scanner) -> bool:
        ...
    @typing.overload
    def __eq__(self, arg0: typing.Any) -> bool:
        ...
    def __getstate__(self) -> tuple[float, float, int, float, float, numpy.typing.NDArray[numpy.float64], float, float]:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, angle_min: typing.SupportsFloat | typing.SupportsIndex, angle_max: typing.SupportsFloat | typing.SupportsIndex, n: typing.SupportsInt | typing.SupportsIndex, *, range_min: typing.SupportsFloat | typing.SupportsIndex = 0.0, range_max: typing.SupportsFloat | typing.SupportsIndex = ..., mount: numpy.typing.ArrayLike = (0, 0, 0), scan_time: typing.SupportsFloat | typing.SupportsIndex = 0.0, noise: typing.SupportsFloat | typing.SupportsIndex = 0.01) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def points(self, ranges: numpy.typing.ArrayLike, *, twist: numpy.typing.ArrayLike = (0, 0, 0)) -> tuple:
        """
        The beams that returned, as points.
        
        REP 117: -inf is too near, +inf no return, NaN an error; none of them is a point.
        
        Parameters
        ----------
        ranges : (n,), m
            One for each beam.
        twist : (3,), m/s and rad/s
            (vx, vy, omega) of the robot during the scan, in its own axes; undoes the distortion that
            `scan_time` brings.
        
        Returns
        -------
        points : (k, 2), m
            In the frame that the robot has at the first beam.
        normals : (k, 2)
            Unit normals of the surfaces, towards the scanner; zero where there is no surface to tell.
        beams : (k,) int
            Which beams they are.
        
        Raises
        ------
        ValueError
            If `ranges` has another length or `twist` is not finite.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import odometry
        >>> scanner = odometry.Scanner(0.0, np.pi / 2, 3, mount=(1.0, 0.0, 0.0))
        >>> points, normals, beams = scanner.points([2.0, np.inf, 1.0])
        >>> points.round(3)
        array([[3., 0.],
               [1., 1.]])
        >>> beams.tolist()
        [0, 2]
        """
    @property
    def angle_max(self) -> float:
        """
        Of the last beam, rad.
        """
    @property
    def angle_min(self) -> float:
        """
        Of the first beam, rad.
        """
    @property
    def angles(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,), rad: of each beam, in the scanner's frame.
        """
    @property
    def mount(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,): pose (x, y, yaw) in the robot's frame, m and rad.
        """
    @property
    def n(self) -> int:
        """
        How many beams.
        """
    @property
    def noise(self) -> float:
        """
        One standard deviation of a range, m.
        """
    @property
    def range_max(self) -> float:
        """
        Where returns end, m.
        """
    @property
    def range_min(self) -> float:
        """
        Shortest return, m.
        """
    @property
    def scan_time(self) -> float:
        """
        From the first beam to the last, s.
        """
class ScanMatch:
    """
    How one scan lies to another, or in a map.
    
    The pose to go by where `status` is "converged" (or, nearly, "iteration_limit"); with "poor_fit"
    and "too_few_points" it is the guess, and the covariance the guess's.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import odometry
    >>> scanner = odometry.Scanner(-np.pi / 2, np.pi / 2, 181)
    >>> nothing = np.full(181, np.inf)
    >>> match = odometry.match(scanner, nothing, nothing, guess=(0.1, 0.0, 0.0))
    >>> match.status, match.degenerate, match.pose
    ('too_few_points', True, array([0.1, 0. , 0. ]))
    """
    def __repr__(self) -> str:
        ...
    @property
    def ambiguous(self) -> bool:
        """
        Whether another pose fits nearly as well: the covariance spans both. People who walk may make a wrong fit the better one.
        """
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3): of the pose, (x, y, theta) in the first's axes. Along what the scans don't tell it is the guess's.
        """
    @property
    def degenerate(self) -> bool:
        """
        Whether the scans leave a direction untold: a corridor, one wall, a round room.
        """
    @property
    def directions(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (k, 3): directions that the scans don't tell, (x, y, theta) in the first's axes; theta in units in which the mean point moves by a metre.
        """
    @property
    def fitness(self) -> float:
        """
        0 to 1: how well the points agree with the map, on the mean.
        """
    @property
    def inliers(self) -> float:
        """
        Share of the points within 0.1 m of the map.
        """
    @property
    def iterations(self) -> int:
        """
        Steps, over all starts.
        """
    @property
    def points(self) -> int:
        """
        How many points were matched.
        """
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,), m and rad: of the second scan's robot in the first's frame.
        """
    @property
    def residual(self) -> float:
        """
        m: root mean square distance of the inliers from the map.
        """
    @property
    def scan_covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3): the same from the scans alone: variances of 1e4 along what they don't tell. To fuse with what the guess came from.
        """
    @property
    def searched(self) -> bool:
        """
        Whether the fit from the guess was poor and the correlative search was asked.
        """
    @property
    def status(self) -> str:
        """
        'converged', 'iteration_limit', 'poor_fit' or 'too_few_points'.
        """
class LaserStep:
    """
    What one scan said: the motion since the one before.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import odometry
    >>> lidar = odometry.LaserOdometry(odometry.Scanner(-np.pi / 2, np.pi / 2, 181))
    >>> step = lidar.add(1.0 / np.cos(0.9 * lidar.scanner.angles / 2), t=0.0)
    >>> step.status, step.keyframe
    ('first', True)
    """
    def __repr__(self) -> str:
        ...
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3): of the motion, in the axes of the robot before.
        """
    @property
    def degenerate(self) -> bool:
        """
        Whether the scan leaves a direction untold.
        """
    @property
    def keyframe(self) -> bool:
        """
        Whether the scan went into the map.
        """
    @property
    def match(self) -> ScanMatch:
        """
        How the scan lay in the map, in its axes.
        """
    @property
    def motion(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,), m and rad: the pose as the robot before saw it.
        """
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,), m and rad: of the robot when the scan began; the first one's is zero.
        """
    @property
    def scan_covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3, 3): the same from the scans alone, 1e4 along what they don't tell: to fuse with the wheels that the guess came from.
        """
    @property
    def status(self) -> str:
        """
        'first', 'tracking', 'still' (found, and no motion is seen: the pose is held) or 'lost' (not found: the pose goes on with the guess).
        """
    @property
    def t(self) -> float:
        """
        s: when the scan began.
        """
    @property
    def t_from(self) -> float:
        """
        s: when the scan before began.
        """
class LaserOdometry:
    """
    Follows a robot by its laser scans.
    
    Each scan is matched (see `match`) to a map of what was seen on the last metres of the way. No loop
    is closed: what lies further back is forgotten, so that motions stay independent of where the robot
    has been before. Hand the scans of keyframes to a SLAM system for that.
    
    Parameters
    ----------
    scanner : Scanner
    keyframe_distance, keyframe_angle : float, m and rad
        A scan goes into the map after so much motion.
    memory : float, m
        Way after which what was not seen again is forgotten.
    radius : float, m
        Around the robot; what is further away is forgotten.
    still_distance, still_angle : float, m and rad
        Within both, and within its noise, no motion is seen and the pose is held.
    lost_limit : int
        So many scans in a row that are lost begin a new map at the pose that was guessed.
    fitness_min, search_below, degenerate_share, max_iterations, max_points
        As those of `match`.
    
    Raises
    ------
    ValueError
        If an option is out of its range.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import odometry
    >>> scanner = odometry.Scanner(-np.pi / 2, np.pi / 2, 181)
    >>> def square(x):  # what a robot sees that looks along x in a square room of 4 m
    ...     c, s = np.cos(scanner.angles), np.abs(np.sin(scanner.angles))
    ...     return np.minimum((2 - x) / np.maximum(c, 1e-9), 2 / np.maximum(s, 1e-9))
    >>> lidar = odometry.LaserOdometry(scanner)
    >>> for k in range(5):
    ...     step = lidar.add(square(0.05 * k), t=0.1 * k)
    >>> step.status, lidar.poses.shape
    ('tracking', (5, 3))
    >>> bool(np.allclose(lidar.poses[-1], [0.2, 0.0, 0.0], atol=5e-3))
    True
    """
    def __init__(self, scanner: Scanner, *, keyframe_distance: typing.SupportsFloat | typing.SupportsIndex = 0.15, keyframe_angle: typing.SupportsFloat | typing.SupportsIndex = 0.3, memory: typing.SupportsFloat | typing.SupportsIndex = 30.0, radius: typing.SupportsFloat | typing.SupportsIndex = 30.0, still_distance: typing.SupportsFloat | typing.SupportsIndex = 0.005, still_angle: typing.SupportsFloat | typing.SupportsIndex = 0.005, lost_limit: typing.SupportsInt | typing.SupportsIndex = 10, fitness_min: typing.SupportsFloat | typing.SupportsIndex = 0.35, search_below: typing.SupportsFloat | typing.SupportsIndex = 0.75, degenerate_share: typing.SupportsFloat | typing.SupportsIndex = 0.005, max_iterations: typing.SupportsInt | typing.SupportsIndex = 30, max_points: typing.SupportsInt | typing.SupportsIndex = 1200) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def add(self, ranges: numpy.typing.ArrayLike, *, t: typing.SupportsFloat | typing.SupportsIndex, motion: numpy.typing.ArrayLike | None = None, motion_covariance: numpy.typing.ArrayLike | None = None, twists: numpy.typing.ArrayLike | None = None) -> LaserStep:
        """
        Takes the next scan.
        
        Parameters
        ----------
        ranges : (n,), m
            One for each beam; inf and NaN are no returns.
        t : float, s
            When the scan began; later than the one before.
        motion : (3,), m and rad, optional
            Pose now as the robot before saw it, as wheels measured it; else velocity is taken as constant.
        motion_covariance : (3, 3), optional
            Of `motion`, in the axes of the robot before; default diag(0.05^2, 0.05^2, 0.1^2).
        twists : (2, 3), m/s and rad/s, optional
            Of the robot at the first beam and at the last, in its own axes; in between they change evenly.
            Else the mean twist since the scan before is taken to go on, which is wrong for a slow scanner
            (`scan_time`) on a robot that brakes.
        
        Returns
        -------
        LaserStep
        
        Raises
        ------
        ValueError
            If an array has another shape, `t` is not after the scan before, or a covariance is none. The
            state is as it was.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import odometry
        >>> lidar = odometry.LaserOdometry(odometry.Scanner(-np.pi / 2, np.pi / 2, 181))
        >>> first = lidar.add(1.0 / np.cos(0.9 * lidar.scanner.angles / 2), t=0.0)
        >>> blind = lidar.add(np.full(181, np.inf), t=0.1, motion=(0.05, 0.0, 0.0))
        >>> blind.status, blind.pose
        ('lost', array([0.05, 0.  , 0.  ]))
        """
    @property
    def map_normals(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (k, 2): unit normals of the remembered surfaces; zero for places that are none.
        """
    @property
    def map_points(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (k, 2), m: what is remembered, in the first pose's frame.
        """
    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (3,), m and rad: the last.
        """
    @property
    def poses(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (k, 3), m and rad: of the robot at each scan; the first is zero.
        """
    @property
    def scanner(self) -> Scanner:
        """
        The scanner.
        """
def match(scanner: Scanner, ranges_a: numpy.typing.ArrayLike, ranges_b: numpy.typing.ArrayLike, guess: numpy.typing.ArrayLike = (0, 0, 0), *, guess_covariance: numpy.typing.ArrayLike | None = None, fitness_min: typing.SupportsFloat | typing.SupportsIndex = 0.35, search_below: typing.SupportsFloat | typing.SupportsIndex = 0.75, degenerate_share: typing.SupportsFloat | typing.SupportsIndex = 0.005, max_iterations: typing.SupportsInt | typing.SupportsIndex = 30, max_points: typing.SupportsInt | typing.SupportsIndex = 1200) -> ScanMatch:
    """
    The motion between two scans: where the robot of the second was, seen from the first's.
    
    Point to line (Censi 2008) under a robust loss; where the fit from the guess is poor a correlative
    search (Olson 2009) looks through the window that `guess_covariance` spans. Along directions that
    the scans don't tell (a corridor's) the pose stays as guessed, and the covariance says so.
    
    Parameters
    ----------
    scanner : Scanner
    ranges_a, ranges_b : (n,), m
        One range for each beam; inf and NaN are no returns.
    guess : (3,), m and rad
        Pose of b in a, from wheels or a constant velocity.
    guess_covariance : (3, 3), optional
        Of the guess, axes of a; default diag(0.5^2, 0.5^2, 0.8^2). Three deviations are searched.
    fitness_min : float
        Below this fitness (0 to 1) a match is a "poor_fit".
    search_below : float
        Below this fitness the correlative search is asked; 0 never asks it, 1 always.
    degenerate_share : float
        A direction that less than this share of the points tells is taken as untold.
    max_iterations : int
        For each start.
    max_points : int
        A scan of more points is thinned evenly.
    
    Returns
    -------
    ScanMatch
    
    Raises
    ------
    ValueError
        If an array has another shape, a covariance is none, or an option is out of its range.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import odometry
    >>> scanner = odometry.Scanner(-np.pi / 2, np.pi / 2, 181)
    >>> def square(x):  # what a robot sees that looks along x in a square room of 4 m
    ...     c, s = np.cos(scanner.angles), np.abs(np.sin(scanner.angles))
    ...     return np.minimum((2 - x) / np.maximum(c, 1e-9), 2 / np.maximum(s, 1e-9))
    >>> match = odometry.match(scanner, square(0.0), square(0.3))
    >>> match.status, match.degenerate
    ('converged', False)
    >>> bool(np.allclose(match.pose, [0.3, 0.0, 0.0], atol=2e-3))
    True
    """
