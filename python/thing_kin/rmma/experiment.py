"""The experiment of [X21] chapter 5: intercept every fiducial while the base moves."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from types import MappingProxyType
from typing import Any, Literal, Protocol, get_args

import numpy as np
import numpy.typing as npt

from thing_kin import _search
from thing_kin._search import ManipulatorArm
from thing_kin.rmma.arrangement import ARRANGEMENTS, Arrangement
from thing_kin.rmma.result import Result
from thing_kin.rmma.traces import SearchTrace, SideTrace, Trace
from thing_kin.rmma.world import RunRandom, World

Method = Literal["spiral", "linear_kf", "ukf", "covering"]
Odometry = Literal["continuous", "failure", "none"]
VELOCITIES = (0.01, 0.015, 0.02, 0.025, 0.03)


@dataclass(frozen=True)
class Config:
    """A column of [X21] Tables 5.3 to 5.5; Q, R and P are variances, in m^2 and (m/s)^2.

    Examples
    --------
    >>> from thing_kin import rmma
    >>> rmma.CONFIGS[2].sample_gap
    0.01
    """

    sample_gap: float = 0.005
    """m; the thesis says 0.5, in cm."""
    q: float = 6e-8
    r_interception: float = 4e-8
    r_failure: float = 4e-4
    p: float = 6e-8


CONFIGS: Mapping[int, Config] = MappingProxyType(
    {
        1: Config(),
        2: Config(sample_gap=0.010),
        3: Config(sample_gap=0.015),
        4: Config(q=4e-8, p=4e-8),
        5: Config(q=1e-7, r_interception=4e-7),
        6: Config(p=1e-7),
        7: Config(sample_gap=0.010, p=1e-7),
    }
)
"""[X21] Tables 5.3 to 5.5, by the number of the configuration."""

_DEFAULT_CONFIG = {"#1": 6, "#2": 2, "#3": 2}  # of Table 5.2's rows


class WorldLike(Protocol):
    """What may stand for a World: a drive has the methods of WorldRun.

    Examples
    --------
    >>> from thing_kin import rmma
    >>> class Mine:
    ...     def start(self, velocity, side, rng):
    ...         return rmma.World().start(0.95 * velocity, side, rng)  # 5 % slow
    >>> rmma.run(2, "covering", velocities=(0.02,), runs=2, rng=0, world=Mine()).method
    'covering'
    """

    def start(
        self, velocity: float, side: npt.NDArray[np.float64], rng: np.random.Generator
    ) -> Any:
        """Begin a drive along `side`, (n, 2) in its own frame, at `velocity` m/s.

        The base stands at `side[0] - (0.20, 0.60)` and drives along +x.

        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import rmma
        >>> world: rmma.WorldLike = rmma.World()  # it is one itself
        >>> drive = world.start(0.02, np.array([[0.2, 0.6]]), np.random.default_rng(0))
        >>> drive.pose(0.0)[:2]
        (0.0, 0.0)
        """


def run(
    arrangement: int | Arrangement,
    method: Method,
    velocities: npt.ArrayLike = VELOCITIES,
    runs: int = 10,
    rng: int | np.random.Generator | None = None,
    world: World | WorldLike | None = None,
    workers: int | None = None,
    *,
    config: int | Config | None = None,
    odometry: Odometry = "continuous",
    spiral_gap: float = 0.005,
    spiral_count: int = 45,
    detection_radius: float | None = None,
    arm: ManipulatorArm | None = None,
) -> Result:
    """Drive by the fiducials again and again, and say how many were intercepted.

    Parameters
    ----------
    arrangement : 1, 2, 3 or Arrangement
        [X21] Tables 4.1 to 4.3, or one's own.
    method : str
        "spiral", "linear_kf" and "ukf" are the thesis's three ways to search; "covering" is the
        better one: a bank of extended Kalman filters and a covering of the plane, ordered by
        probability per second.
    velocities : (v,), m/s
        Of the base.
    runs : int
        At each velocity.
    rng : int or numpy.random.Generator, optional
        All that is random hangs on it alone: not on `workers`, and what the world does not on
        `method`. None: other runs each time.
    world : World, optional
        Or any object with `start(velocity, side, rng)`; default the standard world. One of the
        user's own is asked from the calling thread only.
    workers : int, optional
        Threads; default as many as pay. The result does not depend on it.
    config : int or Config, optional
        For "linear_kf" and "ukf": a column of Tables 5.3 to 5.5; default that of Table 5.2, 6 for
        arrangement 1, 2 for 2 and 3, and 6 for one's own.
    odometry : str
        For "covering": "continuous", or only after a "failure", as the thesis's methods do, or
        "none".
    spiral_gap, spiral_count : float, int
        For "spiral": m between turns and between points, and points.
    detection_radius : float, optional
        m: what "covering" is told of how far the laser sees; default what the world has, or half of
        the standard world's where it does not say. Better too small than too large.
    arm : ManipulatorArm, optional
        A real arm: its inverse kinematics decides where the tool can be, and its joints' limits how
        long motions take. Default the thesis's simplified arm, as the world has it.

    Returns
    -------
    Result

    Raises
    ------
    ValueError
        If an argument is out of its range, or a world of one's own returns what it should not.

    Examples
    --------
    >>> from thing_kin import rmma
    >>> result = rmma.run(1, "covering", velocities=(0.01, 0.03), runs=5, rng=0)
    >>> result.intercepted.shape
    (2, 5, 9)
    >>> result.interception_rate > 0.98
    True
    """
    chosen = _arrangement(arrangement)
    speeds = _velocities(velocities)
    count = _whole(runs, "runs")
    place = World() if world is None else world
    options = _options(
        chosen, method, place, config, odometry, (spiral_gap, spiral_count), detection_radius
    )
    columns = _search.run_experiment(
        list(chosen.driven),
        speeds,
        count,
        options.core,
        _search.read_seed(rng),
        _starter(place),
        arm,
        workers,
    )
    intercepted, searched, times, errors, samples = columns
    return Result(
        arrangement=chosen,
        method=method,
        velocities=speeds,
        registered=chosen.registered,
        intercepted=intercepted.astype(bool),
        searched=searched.astype(bool),
        search_times=times,
        position_errors=errors,
        samples=samples.astype(np.int64),
        options=options.record,
    )


def trace(
    arrangement: int | Arrangement,
    method: Method,
    velocity: float = 0.02,
    rng: int | np.random.Generator | None = None,
    world: World | WorldLike | None = None,
    *,
    config: int | Config | None = None,
    odometry: Odometry = "continuous",
    spiral_gap: float = 0.005,
    spiral_count: int = 45,
    detection_radius: float | None = None,
    arm: ManipulatorArm | None = None,
    interval: float = 0.5,
) -> Trace:
    """One run in all detail, for pictures.

    Parameters
    ----------
    arrangement, method, rng, world, config, odometry : as of `run`
    spiral_gap, spiral_count, detection_radius, arm
        As of `run`; with the same seed it is the first run of the first velocity.
    velocity : float
        m/s.
    interval : float
        s between the poses of the base that are kept.

    Returns
    -------
    Trace

    Raises
    ------
    ValueError
        As of `run`.

    Examples
    --------
    >>> from thing_kin import rmma
    >>> one = rmma.trace(2, "spiral", velocity=0.02, rng=0)
    >>> len(one.sides), one.sides[0].fiducials.shape
    (1, (6, 2))
    """
    chosen = _arrangement(arrangement)
    speed = float(_velocities([velocity])[0])
    if not (math.isfinite(interval) and interval > 0):
        raise ValueError(f"interval: got {interval}, expected a positive number of seconds")
    place = World() if world is None else world
    options = _options(
        chosen, method, place, config, odometry, (spiral_gap, spiral_count), detection_radius
    )
    seed = _search.read_seed(rng)
    _, sides = _search.trace_run(
        list(chosen.driven), speed, options.core, seed, 0, _starter(place), arm
    )
    # The same drives once more, only to be looked at.
    begin = _starter(place)
    traces = []
    for i, (fiducials, searches) in enumerate(zip(chosen.driven, sides, strict=True)):
        key = _search.drive_key(seed, 0, 0, i)
        drive = (
            place.start(speed, fiducials, RunRandom(key))
            if callable(begin)
            else _search.start_run(begin, speed, fiducials, key)
        )
        end = max((search[2] for search in searches), default=0.0)
        stops = np.concatenate([search[7] for search in searches]) if searches else np.zeros(0)
        times = np.unique(np.r_[np.arange(0.0, end + interval, interval), stops])
        base = np.array([drive.pose(float(t)) for t in times])
        at = dict(zip(times.tolist(), base, strict=True))
        traces.append(
            SideTrace(
                fiducials=fiducials,
                rotation=chosen.rotations[i],
                times=times,
                base=base,
                searches=tuple(_search_trace(search, at) for search in searches),
            )
        )
    return Trace(arrangement=chosen, method=method, velocity=speed, sides=tuple(traces))


def _search_trace(search: tuple[Any, ...], at: dict[float, Any]) -> SearchTrace:
    fiducial, start, end, hit, error, predicted, covariance, times, tools = search
    return SearchTrace(
        fiducial=fiducial,
        start=start,
        end=end,
        hit=hit,
        predicted=predicted,
        covariance=covariance if covariance.any() else None,
        stop_times=times,
        stops=tools,
        base_at_stops=np.array([at[t] for t in times.tolist()]).reshape(-1, 3),
        position_error=error,
    )


@dataclass(frozen=True)
class _Options:
    core: _search.SearchOptions
    record: Mapping[str, Any]


def _options(
    arrangement: Arrangement,
    method: str,
    world: World | WorldLike,
    config: int | Config | None,
    odometry: str,
    spiral: tuple[float, int],
    radius: float | None,
) -> _Options:
    if method not in get_args(Method):
        raise ValueError(f"method: got {method!r}, expected one of {', '.join(get_args(Method))}")
    if odometry not in get_args(Odometry):
        raise ValueError(
            f"odometry: got {odometry!r}, expected one of {', '.join(get_args(Odometry))}"
        )
    chosen = _config(config, arrangement)
    gap = _positive(spiral[0], "spiral_gap")
    standard = World()
    told = getattr(world, "detection_radius", 0.5 * standard.detection_radius)
    told = _positive(told if radius is None else radius, "detection_radius")
    core = _search.SearchOptions(
        method=getattr(_search.SearchMethod, method),
        sample_gap=_positive(chosen.sample_gap, "config.sample_gap"),
        q=_positive(chosen.q, "config.q"),
        r_hit=_positive(chosen.r_interception, "config.r_interception"),
        r_fail=_positive(chosen.r_failure, "config.r_failure"),
        p0=_positive(chosen.p, "config.p"),
        spiral_gap=gap,
        spiral_count=_whole(spiral[1], "spiral_count"),
        odometry=getattr(_search.OdometryUse, odometry),
        detection_radius=told,
        u_max=_positive(getattr(world, "u_max", standard.u_max), "world.u_max"),
        reach=_positive(getattr(world, "reach", standard.reach), "world.reach"),
    )
    record: dict[str, Any] = {"world": world}
    if method in ("linear_kf", "ukf"):
        record["config"] = chosen
    elif method == "spiral":
        record |= {"spiral_gap": gap, "spiral_count": spiral[1]}
    else:
        record |= {"odometry": odometry, "detection_radius": told}
    return _Options(core, MappingProxyType(record))


def _starter(world: World | WorldLike) -> Any:
    """Return what the core begins drives with: its own world, or a call of the user's."""
    if isinstance(world, World):
        return _search.World(**asdict(world))
    if not callable(getattr(world, "start", None)):
        raise ValueError(f"world: got {world!r}, expected a World or an object with start()")
    return lambda velocity, side, key: world.start(velocity, side, RunRandom(key))


def _arrangement(arrangement: int | Arrangement) -> Arrangement:
    if isinstance(arrangement, Arrangement):
        return arrangement
    if arrangement not in ARRANGEMENTS:
        raise ValueError(f"arrangement: got {arrangement!r}, expected 1, 2, 3 or an Arrangement")
    return ARRANGEMENTS[arrangement]


def _config(config: int | Config | None, arrangement: Arrangement) -> Config:
    if isinstance(config, Config):
        return config
    number = _DEFAULT_CONFIG.get(arrangement.name, 6) if config is None else config
    if number not in CONFIGS:
        raise ValueError(f"config: got {config!r}, expected 1 to 7 or a Config")
    return CONFIGS[number]


def _velocities(velocities: npt.ArrayLike) -> npt.NDArray[np.float64]:
    speeds = np.array(velocities, dtype=np.float64)
    if speeds.ndim != 1 or not len(speeds):
        raise ValueError(f"velocities: got shape {speeds.shape}, expected (v,), v >= 1")
    if not (np.isfinite(speeds).all() and (speeds > 0).all()):
        raise ValueError(f"velocities: got {speeds}, expected positive numbers of m/s")
    return speeds


def _positive(value: Any, name: str) -> float:
    if not (isinstance(value, (int, float, np.number)) and math.isfinite(value) and value > 0):
        raise ValueError(f"{name}: got {value!r}, expected a positive number")
    return float(value)


def _whole(value: Any, name: str) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < 1:
        raise ValueError(f"{name}: got {value!r}, expected a whole number >= 1")
    return int(value)
