"""
Search. Private: import its names from thing_kin.search and thing_kin.rmma.
"""
from __future__ import annotations
import numpy
import numpy.random
import numpy.typing
import thing_kin._core
import typing
__all__: list[str] = ['CoveringPlan', 'ManipulatorArm', 'OdometryUse', 'SearchMethod', 'SearchOptions', 'World', 'WorldRun', 'compensate', 'covering', 'drive_key', 'next_fiducial', 'read_seed', 'run_experiment', 'spiral', 'start_run', 'stochastic', 'trace_run']
class CoveringPlan:
    """
    A search in advance, as it goes while nothing is found.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import search
    >>> plan = search.covering((0.0, 0.0), 1e-4 * np.eye(2), radius=0.006)
    >>> bool(plan.found[-1] > 0.99)
    True
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def found(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,): probability that it has been seen by then.
        """
    @property
    def points(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n, 2), m: stops, in their order.
        """
    @property
    def times(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,), s: of the stops; the first is at 0.
        """
class World:
    """
    The numbers of thing_kin.rmma.World.
    """
    def __init__(self, **kwargs) -> None:
        ...
    @property
    def arm_hidden_std(self) -> float:
        ...
    @arm_hidden_std.setter
    def arm_hidden_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def arm_std(self) -> float:
        ...
    @arm_std.setter
    def arm_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def creep(self) -> float:
        ...
    @creep.setter
    def creep(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def curvature_mean(self) -> float:
        ...
    @curvature_mean.setter
    def curvature_mean(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def curvature_std(self) -> float:
        ...
    @curvature_std.setter
    def curvature_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def detection_radius(self) -> float:
        ...
    @detection_radius.setter
    def detection_radius(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def heading_std(self) -> float:
        ...
    @heading_std.setter
    def heading_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def heading_walk(self) -> float:
        ...
    @heading_walk.setter
    def heading_walk(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def map_std(self) -> float:
        ...
    @map_std.setter
    def map_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def move_speed(self) -> float:
        ...
    @move_speed.setter
    def move_speed(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def move_time(self) -> float:
        ...
    @move_time.setter
    def move_time(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def odo_bias_std(self) -> float:
        ...
    @odo_bias_std.setter
    def odo_bias_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def odo_heading_std(self) -> float:
        ...
    @odo_heading_std.setter
    def odo_heading_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def odo_length(self) -> float:
        ...
    @odo_length.setter
    def odo_length(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def odo_std(self) -> float:
        ...
    @odo_std.setter
    def odo_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def odo_white(self) -> float:
        ...
    @odo_white.setter
    def odo_white(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def reach(self) -> float:
        ...
    @reach.setter
    def reach(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def sample_speed(self) -> float:
        ...
    @sample_speed.setter
    def sample_speed(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def sample_std(self) -> float:
        ...
    @sample_std.setter
    def sample_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def sample_time(self) -> float:
        ...
    @sample_time.setter
    def sample_time(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def slip_mean(self) -> float:
        ...
    @slip_mean.setter
    def slip_mean(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def slip_std(self) -> float:
        ...
    @slip_std.setter
    def slip_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def speed_length(self) -> float:
        ...
    @speed_length.setter
    def speed_length(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def speed_std(self) -> float:
        ...
    @speed_std.setter
    def speed_std(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def start_lag(self) -> float:
        ...
    @start_lag.setter
    def start_lag(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def u_max(self) -> float:
        ...
    @u_max.setter
    def u_max(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
class WorldRun:
    """
    One drive along one side of the artifact, as it happens.
    
    Times are in s since the side's first fiducial was registered and may not fall from call to call of
    one method; poses and points are in the side's frame. `rmma.World().start(...)` makes one.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import rmma
    >>> side = np.array([[0.0, 0.6], [0.2, 0.6]])
    >>> run = rmma.World().start(0.02, side, np.random.default_rng(0))
    >>> run.pose(0.0)[:2]
    (-0.2, 0.0)
    """
    def detects(self, tool_xy: numpy.typing.ArrayLike, fiducial: numpy.typing.ArrayLike) -> bool:
        """
        Whether the laser, read with the tool at `tool_xy`, sees the fiducial listed at `fiducial`.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import rmma
        >>> run = rmma.World().start(0.02, [[0.0, 0.6], [0.2, 0.6]], np.random.default_rng(0))
        >>> run.detects((0.0, 0.605), (0.0, 0.6)), run.detects((0.0, 0.65), (0.0, 0.6))
        (True, False)
        """
    def move_time(self, a: numpy.typing.ArrayLike, b: numpy.typing.ArrayLike) -> float:
        """
        s of a move of the arm to another place of work.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import rmma
        >>> run = rmma.World().start(0.02, [[0.0, 0.6], [0.2, 0.6]], np.random.default_rng(0))
        >>> round(run.move_time((0.2, 0.6), (0.2, 0.45)), 9)
        1.5
        """
    def odometry(self, t: typing.SupportsFloat | typing.SupportsIndex) -> tuple:
        """
        (x, y, theta) as the base's localization has it at time t.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import rmma
        >>> run = rmma.World().start(0.02, [[0.0, 0.6], [0.2, 0.6]], np.random.default_rng(0))
        >>> bool(np.allclose(run.odometry(0.0), run.pose(0.0), atol=0.05))
        True
        """
    def place(self, u_command: numpy.typing.ArrayLike) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
        """
        Stop the arm: where the tool is from the base, (2,) m, and where forward kinematics has it, (2,).
        
        After move_time() it has moved to another place of work.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import rmma
        >>> run = rmma.World().start(0.02, [[0.0, 0.6], [0.2, 0.6]], np.random.default_rng(0))
        >>> true, seen = run.place((0.2, 0.6))
        >>> bool(np.linalg.norm(true - seen) < 0.005)
        True
        """
    def pose(self, t: typing.SupportsFloat | typing.SupportsIndex) -> tuple:
        """
        (x, y, theta) of the base, m and rad, at time t.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import rmma
        >>> run = rmma.World().start(0.02, [[0.0, 0.6], [0.2, 0.6]], np.random.default_rng(0))
        >>> run.pose(0.0)[:2]
        (-0.2, 0.0)
        """
    def sample_time(self, a: numpy.typing.ArrayLike, b: numpy.typing.ArrayLike) -> float:
        """
        s from one reading of the laser to the next.
        
        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import rmma
        >>> run = rmma.World().start(0.02, [[0.0, 0.6], [0.2, 0.6]], np.random.default_rng(0))
        >>> round(run.sample_time((0.2, 0.6), (0.2, 0.618)), 9)
        0.26
        """
class ManipulatorArm:
    """
    A real arm for the experiment, instead of the thesis's simplified one.
    
    The tool points down at a fixed height; the arm's inverse kinematics, in closed form, decides where
    it can be, and its joints' velocity and acceleration limits how long a motion takes. What a motion of
    no length takes is the world's own overhead.
    
    Parameters
    ----------
    chain : Chain
        Six joints with a closed form, fixed or on an omnidirectional base: `robots.pioneer_lx_ur5()`.
    height : float
        m of the tool, in the frame of the base.
    turn : float
        rad of the tool about the vertical.
    
    Raises
    ------
    ValueError
        If the chain has no closed form, a joint no limits, or a number is not finite.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import rmma
    >>> arm = rmma.ManipulatorArm(tk.robots.pioneer_lx_ur5())
    >>> arm.reaches((0.2, 0.6)), arm.reaches((0.2, 1.6))
    (True, False)
    """
    def __getstate__(self) -> tuple[thing_kin._core.Chain, float, float]:
        ...
    def __init__(self, chain: thing_kin._core.Chain, height: typing.SupportsFloat | typing.SupportsIndex = 0.7, turn: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> None:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def motion_time(self, a: numpy.typing.ArrayLike, b: numpy.typing.ArrayLike) -> float:
        """
        s from displacement `a`, (2,) m, to `b`, from rest to rest, without overhead.
        
        Raises
        ------
        ValueError
            If one of them is out of reach.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> from thing_kin import rmma
        >>> arm = rmma.ManipulatorArm(tk.robots.pioneer_lx_ur5())
        >>> 0.0 < arm.motion_time((0.2, 0.6), (0.2, 0.605)) < arm.motion_time((0.2, 0.6), (-0.2, 0.6)) < 1.0
        True
        """
    def reaches(self, displacement: numpy.typing.ArrayLike) -> bool:
        """
        Whether the tool can be at `displacement`, (2,) m from the base.
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> from thing_kin import rmma
        >>> arm = rmma.ManipulatorArm(tk.robots.pioneer_lx_ur5())
        >>> arm.reaches((0.2, 0.6))
        True
        """
    @property
    def chain(self) -> thing_kin._core.Chain:
        """
        The arm's chain.
        """
class SearchMethod:
    """
    Members:
    
      spiral
    
      linear_kf
    
      ukf
    
      covering
    """
    __members__: typing.ClassVar[dict[str, SearchMethod]]
    covering: typing.ClassVar[SearchMethod]
    linear_kf: typing.ClassVar[SearchMethod]
    spiral: typing.ClassVar[SearchMethod]
    ukf: typing.ClassVar[SearchMethod]
    @typing.overload
    def __eq__(self, other: SearchMethod) -> bool:
        ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool:
        ...
    def __getstate__(self) -> int:
        ...
    def __hash__(self) -> int:
        ...
    def __index__(self) -> int:
        ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    def __int__(self) -> int:
        ...
    @typing.overload
    def __ne__(self, other: SearchMethod) -> bool:
        ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    def __str__(self) -> str:
        ...
    @property
    def name(self) -> str:
        ...
    @property
    def value(self) -> int:
        ...
class OdometryUse:
    """
    Members:
    
      continuous
    
      failure
    
      none
    """
    __members__: typing.ClassVar[dict[str, OdometryUse]]
    continuous: typing.ClassVar[OdometryUse]
    failure: typing.ClassVar[OdometryUse]
    none: typing.ClassVar[OdometryUse]
    @typing.overload
    def __eq__(self, other: OdometryUse) -> bool:
        ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool:
        ...
    def __getstate__(self) -> int:
        ...
    def __hash__(self) -> int:
        ...
    def __index__(self) -> int:
        ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    def __int__(self) -> int:
        ...
    @typing.overload
    def __ne__(self, other: OdometryUse) -> bool:
        ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    def __str__(self) -> str:
        ...
    @property
    def name(self) -> str:
        ...
    @property
    def value(self) -> int:
        ...
class SearchOptions:
    def __init__(self, *, method: SearchMethod, sample_gap: typing.SupportsFloat | typing.SupportsIndex, q: typing.SupportsFloat | typing.SupportsIndex, r_hit: typing.SupportsFloat | typing.SupportsIndex, r_fail: typing.SupportsFloat | typing.SupportsIndex, p0: typing.SupportsFloat | typing.SupportsIndex, spiral_gap: typing.SupportsFloat | typing.SupportsIndex, spiral_count: typing.SupportsInt | typing.SupportsIndex, odometry: OdometryUse, detection_radius: typing.SupportsFloat | typing.SupportsIndex, u_max: typing.SupportsFloat | typing.SupportsIndex, reach: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
def compensate(points: numpy.typing.ArrayLike, velocity: numpy.typing.ArrayLike, dwell: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Points for a base that goes on while it searches, [X21] (2.2).
    
    `points[k] + velocity * t[k]`, with the time since the first point was meant; the thesis prints the
    time since the point before.
    
    Parameters
    ----------
    points : (n, 2), m
    velocity : (2,), m/s
    dwell : float or (n,), s
        Time from each point to the next, or the time of each point.
    
    Returns
    -------
    (n, 2), m
    
    Raises
    ------
    ValueError
        If an array has another shape or is not finite.
    
    Examples
    --------
    >>> from thing_kin import search
    >>> search.compensate([[0.0, 0.0], [0.0, 0.0]], velocity=(0.02, 0.0), dwell=0.5)
    array([[0.  , 0.  ],
           [0.01, 0.  ]])
    """
def covering(center: numpy.typing.ArrayLike, covariance: numpy.typing.ArrayLike, radius: typing.SupportsFloat | typing.SupportsIndex, *, stop_time: typing.SupportsFloat | typing.SupportsIndex = 0.16, speed: typing.SupportsFloat | typing.SupportsIndex = 0.18, extent: typing.SupportsFloat | typing.SupportsIndex | None = None, within: numpy.typing.ArrayLike | None = None, reach_center: numpy.typing.ArrayLike | None = None, reach_radius: typing.SupportsFloat | typing.SupportsIndex | None = None, velocity: numpy.typing.ArrayLike = (0.0, 0.0), deadline: typing.SupportsFloat | typing.SupportsIndex | None = None, least_rate: typing.SupportsFloat | typing.SupportsIndex = 0.0001, count: typing.Any = None) -> CoveringPlan:
    """
    Stops that cover the plane, those first that find most probability per second.
    
    A hexagonal lattice of discs, and the points between them for a second look. Each stop lowers what
    is believed of where it looked: surely within 0.8 of the radius, less out to 1.1, and never wholly.
    
    Parameters
    ----------
    center : (2,), m
    covariance : (2, 2), m^2
        What is believed of where it is.
    radius : float
        m: how far a stop sees. Better too small than too large.
    stop_time, speed : float
        s for each stop, and m/s between stops.
    extent : float, optional
        m from the center: nothing is looked for beyond; default 5 deviations and 2 radii.
    within : (k, 2), m, optional
        A polygon: stops lie in it.
    reach_center : (2,), m, optional
    reach_radius : float, optional
        m: stops lie within it of `reach_center + velocity * time`; default everywhere.
    velocity : (2,), m/s
        Of what carries the arm.
    deadline : float, optional
        s: no stop is later.
    least_rate : float
        1/s: the search ends where the best stop finds less per second.
    count : int, optional
        Stops at most.
    
    Returns
    -------
    CoveringPlan
    
    Raises
    ------
    ValueError
        If an argument has another shape or is out of its range.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import search
    >>> plan = search.covering((0.0, 0.0), np.diag([4e-4, 1e-4]), radius=0.012, deadline=5.0)
    >>> bool(plan.times[-1] <= 5.0), bool(np.all(np.diff(plan.found) >= 0))
    (True, True)
    """
def drive_key(seed: typing.SupportsInt | typing.SupportsIndex, velocity: typing.SupportsInt | typing.SupportsIndex, run: typing.SupportsInt | typing.SupportsIndex, side: typing.SupportsInt | typing.SupportsIndex) -> int:
    ...
def next_fiducial(x: numpy.typing.ArrayLike, previous: typing.SupportsInt | typing.SupportsIndex, travelled: typing.SupportsFloat | typing.SupportsIndex) -> int:
    ...
def read_seed(rng: int | numpy.random.Generator | None) -> int:
    ...
def run_experiment(sides: list, velocities: numpy.typing.ArrayLike, runs: typing.SupportsInt | typing.SupportsIndex, options: SearchOptions, seed: typing.SupportsInt | typing.SupportsIndex, world: typing.Any, arm: ManipulatorArm | None, threads: typing.SupportsIndex | None) -> numpy.typing.NDArray[numpy.float64]:
    ...
def spiral(center: numpy.typing.ArrayLike, gap: typing.SupportsFloat | typing.SupportsIndex, spacing: typing.SupportsFloat | typing.SupportsIndex | None = None, radius: typing.SupportsFloat | typing.SupportsIndex | None = None, count: typing.Any = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    Evenly spaced points on an Archimedean spiral, [X21] 2.2.
    
    Parameters
    ----------
    center : (2,), m
        The first point.
    gap : float
        m between neighbouring turns.
    spacing : float, optional
        m along the spiral from point to point; default `gap`.
    radius : float, optional
        m from the center: points beyond are dropped.
    count : int, optional
        At most so many points. One of `radius` and `count` is needed.
    
    Returns
    -------
    (n, 2), m
        The center, then counter-clockwise outwards.
    
    Raises
    ------
    ValueError
        If a length is not positive, or neither `radius` nor `count` ends the spiral.
    
    Examples
    --------
    >>> from thing_kin import search
    >>> search.spiral((0.0, 0.0), gap=0.006, count=3).round(4)
    array([[ 0.    ,  0.    ],
           [ 0.0044, -0.0032],
           [ 0.0058,  0.0029]])
    """
def start_run(world: World, velocity: typing.SupportsFloat | typing.SupportsIndex, side: numpy.typing.ArrayLike, key: typing.SupportsInt | typing.SupportsIndex) -> WorldRun:
    ...
def stochastic(center: numpy.typing.ArrayLike, covariance: numpy.typing.ArrayLike, sample_gap: typing.SupportsFloat | typing.SupportsIndex, count: typing.Any = 200, keep: typing.Any = 50, rng: int | numpy.random.Generator | None = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    Draws from a normal distribution on a grid, the most probable first, [X21] (2.1).
    
    Parameters
    ----------
    center : (2,), m
        The mean.
    covariance : (2, 2), m^2
        It may be singular.
    sample_gap : float
        m: pitch of the grid, which lies along the axes about the center.
    count : int
        Draws.
    keep : int
        Points at most.
    rng : int or numpy.random.Generator, optional
        Where the draws come from; None for others each time.
    
    Returns
    -------
    (n, 2), m
        Each cell that was drawn once, by falling density (ties by x, then y). The center is always the
        first.
    
    Raises
    ------
    ValueError
        If an argument has another shape or is out of its range.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import search
    >>> points = search.stochastic((1.0, 2.0), np.diag([4e-6, 1e-6]), sample_gap=5e-4, keep=5, rng=0)
    >>> points.shape, points[0]
    ((5, 2), array([1., 2.]))
    """
def trace_run(sides: list, velocity: typing.SupportsFloat | typing.SupportsIndex, options: SearchOptions, seed: typing.SupportsInt | typing.SupportsIndex, run: typing.SupportsInt | typing.SupportsIndex, world: typing.Any, arm: ManipulatorArm | None) -> tuple[numpy.typing.NDArray[numpy.float64], list]:
    ...
