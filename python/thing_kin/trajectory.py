"""A motion over time: how a path gets its time, and what it is then.

Needs the extra `timing` (`pip install thing_kin[timing]`): toppra for paths, Ruckig from point to
point; imported when the first trajectory is made. A Trajectory itself needs numpy only.
"""

from __future__ import annotations

import csv
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thing_kin.timing import arguments as read
from thing_kin.timing.limits import RateLimits
from thing_kin.timing.quintic import Quintic

if TYPE_CHECKING:
    from thing_kin import Chain, WheelLimits
    from thing_kin.path_plan import PathPlan

Array = NDArray[np.float64]

RATES = ("position", "velocity", "acceleration")
TUBE_SHARE = 0.98  # of the tolerance for the curve; the rest for its quintics in time
SOFT_RAMP = 0.02  # of a motion's duration: how fast acceleration changes where jerk is unlimited
EVEN_MOST = 100  # limits of jerk or acceleration over that of the rate below, 1/s: where none is


class Trajectory:
    """Joints over time: quintic polynomials between knots, with continuous acceleration.

    A controller that joins the points of a trajectory message by quintics, as the usual ones do,
    follows exactly this. Before the first and after the last knot the robot rests.

    Parameters
    ----------
    joint_names : sequence of str
        Of the n joints.
    times : (K,), s
        Of the knots: from 0, increasing.
    positions, velocities, accelerations : (K, n), rad and m, per s and per s^2
    path_deviation : float, optional
        See the attribute.

    Attributes
    ----------
    path_deviation : float or None
        No joint is ever farther than this from the straight lines between the waypoints that the
        trajectory was made from, rad or m.

    Raises
    ------
    ValueError
        If shapes do not match, a number is not finite, or times do not increase from 0.

    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> rest = np.zeros((2, 1))
    >>> trajectory = tk.Trajectory(["slide"], [0.0, 2.0], [[0.0], [1.0]], rest, rest)
    >>> trajectory
    Trajectory(2.000 s, 1 joint, 2 knots)
    >>> q, qd, qdd = trajectory.sample(1.0)
    >>> q, qd
    (array([0.5]), array([0.9375]))
    """

    def __init__(
        self,
        joint_names: Sequence[str],
        times: ArrayLike,
        positions: ArrayLike,
        velocities: ArrayLike,
        accelerations: ArrayLike,
        *,
        path_deviation: float | None = None,
    ) -> None:
        self._names = tuple(str(name) for name in joint_names)
        t = read.finite(read.read_array(times, "times", "(K,)"), "times")
        if t.ndim != 1 or len(t) == 0:
            raise ValueError(f"times: got shape {t.shape}, expected (K,) with K >= 1")
        if t[0] != 0.0 or (np.diff(t) <= 0.0).any():
            raise ValueError("times: got what does not increase from 0, expected that it does")
        shape = (len(t), len(self._names))
        rows = {"positions": positions, "velocities": velocities, "accelerations": accelerations}
        arrays = {name: read.read_array(rows[name], name, f"{shape}") for name in rows}
        for name, array in arrays.items():
            if array.shape != shape:
                raise ValueError(f"{name}: got shape {array.shape}, expected {shape}")
            read.finite(array, name)
        self._shape = Quintic(t, *arrays.values())
        for array in (t, *arrays.values()):
            array.flags.writeable = False
        self.path_deviation = path_deviation

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Names of the joints, in the order of the columns."""
        return self._names

    @property
    def duration(self) -> float:
        """From rest to rest, s."""
        return float(self._shape.x[-1])

    @property
    def times(self) -> Array:
        """Of the knots, (K,), s, read-only."""
        return self._shape.x

    @property
    def positions(self) -> Array:
        """At the knots, (K, n), rad and m, read-only."""
        return self._shape.y

    @property
    def velocities(self) -> Array:
        """At the knots, (K, n), rad/s and m/s, read-only."""
        return self._shape.dy

    @property
    def accelerations(self) -> Array:
        """At the knots, (K, n), rad/s^2 and m/s^2, read-only."""
        return self._shape.ddy

    def sample(self, t: ArrayLike, derivatives: int = 2) -> tuple[Array, ...]:
        """Position, velocity, acceleration (and jerk) at any time.

        Parameters
        ----------
        t : float or (N,), s
            Before 0 and after the duration the robot rests where it begins and ends.
        derivatives : int
            How many, 0 to 3; at a knot the jerk is that of the piece that begins there.

        Returns
        -------
        tuple of (n,) or (N, n)
            q, and as many derivatives as asked for: by default (q, qd, qdd).

        Raises
        ------
        ValueError
            If a time is not finite or of a wrong shape, or there is no such number of derivatives.

        Examples
        --------
        >>> import thing_kin as tk
        >>> robot = tk.robots.ur5()
        >>> trajectory = tk.move_to(robot, [0.0] * 6, [1.0, 0.5, 0.0, 0.0, 0.0, 0.0])
        >>> q, qd, qdd, jerk = trajectory.sample([-1.0, 0.3, 1e6], derivatives=3)
        >>> q.shape, q[-1].tolist(), qd[-1].tolist()
        ((3, 6), [1.0, 0.5, 0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        """
        when = read.read_array(t, "t", "a number or (N,)")
        if when.ndim > 1:
            raise ValueError(f"t: got shape {when.shape}, expected a number or (N,)")
        if not np.isfinite(when).all():
            raise ValueError("t: got NaN or inf, expected finite numbers")
        if derivatives not in (0, 1, 2, 3):
            raise ValueError(f"derivatives: got {derivatives!r}, expected 0, 1, 2 or 3")
        flat = when.reshape(-1)
        resting = (flat < 0.0) | (flat > self.duration)
        inside = np.clip(flat, 0.0, self.duration)
        if self.duration == 0.0:
            found = [np.repeat(self.positions[:1], len(flat), axis=0)]
            found += [np.zeros_like(found[0]) for _ in range(derivatives)]
        else:
            found = self._shape(inside, derivatives)
        at_end = inside == self.duration
        at_knots = (self.positions, self.velocities, self.accelerations)
        for value, knots in zip(found, at_knots, strict=False):
            value[at_end] = knots[-1]
        for rate in found[1:]:
            rate[resting] = 0.0
        return tuple(rate.reshape(*when.shape, len(self._names)) for rate in found)

    def to_message(self) -> dict[str, Any]:
        """In the usual layout of a joint trajectory message, of plain dicts and lists.

        Returns
        -------
        dict
            `joint_names`, and `points`: for each knot `positions`, `velocities`, `accelerations`
            and `time_from_start`, in seconds.

        Examples
        --------
        >>> import thing_kin as tk
        >>> robot = tk.robots.ur5()
        >>> message = tk.move_to(robot, [0.0] * 6, [1.0] * 6).to_message()
        >>> message["joint_names"]
        ['q0', 'q1', 'q2', 'q3', 'q4', 'q5']
        >>> sorted(message["points"][-1])
        ['accelerations', 'positions', 'time_from_start', 'velocities']
        """
        columns = (self.positions, self.velocities, self.accelerations)
        return {
            "joint_names": list(self._names),
            "points": [
                {
                    "positions": q.tolist(),
                    "velocities": v.tolist(),
                    "accelerations": a.tolist(),
                    "time_from_start": float(t),
                }
                for t, q, v, a in zip(self.times, *columns, strict=True)
            ],
        }

    def to_csv(self, path: str | PathLike[str]) -> None:
        """Write the knots: a column of times, then positions, velocities, accelerations.

        Parameters
        ----------
        path : str or path
            A header names the columns: `time`, `q0 position` and so on. Numbers are written in
            full, so that from_csv gives the same trajectory.

        Examples
        --------
        >>> import os, tempfile, thing_kin as tk
        >>> trajectory = tk.move_to(tk.robots.ur5(), [0.0] * 6, [1.0] * 6)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     trajectory.to_csv(os.path.join(folder, "move.csv"))
        ...     same = tk.Trajectory.from_csv(os.path.join(folder, "move.csv"))
        >>> same.duration == trajectory.duration
        True
        """
        header = ["time"] + [f"{name} {rate}" for rate in RATES for name in self._names]
        rows = np.column_stack([self.times, self.positions, self.velocities, self.accelerations])
        with Path(path).open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(header)
            writer.writerows([repr(x) for x in row] for row in rows.tolist())

    @classmethod
    def from_csv(cls, path: str | PathLike[str]) -> Trajectory:
        r"""Read what to_csv wrote.

        Parameters
        ----------
        path : str or path

        Returns
        -------
        Trajectory
            Its path_deviation is None.

        Raises
        ------
        ValueError
            If the file is no such table.

        Examples
        --------
        >>> import os, tempfile, thing_kin as tk
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     name = os.path.join(folder, "one.csv")
        ...     with open(name, "w") as file:
        ...         _ = file.write("time,x position,x velocity,x acceleration\n0,1,0,0\n")
        ...     tk.Trajectory.from_csv(name).sample(0.0)[0]
        array([1.])
        """
        with Path(path).open(newline="", encoding="utf-8") as file:
            header, *rows = list(csv.reader(file)) or [[]]
        n = (len(header) - 1) // 3
        names = [column.removesuffix(" position") for column in header[1 : n + 1]]
        if header != ["time"] + [f"{name} {rate}" for rate in RATES for name in names]:
            raise ValueError(f"path: got a table with columns {header}, expected those of to_csv")
        try:
            table = np.array([[float(x) for x in row] for row in rows]).reshape(-1, 3 * n + 1)
        except ValueError as error:
            raise ValueError(f"path: got {error}, expected a number in each column") from error
        return cls(names, table[:, 0], *np.split(table[:, 1:], 3, axis=1))

    def __repr__(self) -> str:
        n, k = len(self._names), len(self.times)
        joints, knots = "joint" + "s" * (n != 1), "knot" + "s" * (k != 1)
        return f"Trajectory({self.duration:.3f} s, {n} {joints}, {k} {knots})"


def time_path(
    robot: Chain,
    q: ArrayLike,
    *,
    velocity_limits: ArrayLike | None = None,
    acceleration_limits: ArrayLike | None = None,
    jerk_limits: ArrayLike | None = None,
    wheel_limits: WheelLimits | None = None,
    tolerance: float = 2e-3,
) -> Trajectory:
    """Fast motion along a path, from rest to rest, within limits that are proved.

    A smooth curve runs through the waypoints and stays within `tolerance` of the straight lines
    between them, and within the joints' limits. toppra finds the fastest speed along it; that is
    smoothed over a short window of time, so that acceleration is continuous, and the whole is
    stretched until no rate exceeds its limit anywhere, between knots too.

    Parameters
    ----------
    robot : Chain
    q : (N, n), rad and m
        Waypoints, at least one. Repeated ones are passed once.
    velocity_limits, acceleration_limits : (n,) or float, optional
        Per s and s^2; default: the robot's. inf is unlimited; 0 allows no motion of that joint.
    jerk_limits : (n,) or float, per s^3, optional
        Default: unlimited, though finite.
    wheel_limits : WheelLimits, optional
        Of the robot's base.
    tolerance : float, rad and m
        A wider one lets the motion take corners faster.

    Returns
    -------
    Trajectory
        With `path_deviation`, at most the tolerance.

    Raises
    ------
    ValueError
        If a waypoint is not finite or outside the joints' limits, a limit is negative or forbids
        the motion, or nothing limits it; if there are wheel limits, but no base.
    ImportError
        If the extra `timing` is not installed.

    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.ur5()
    >>> corner = np.zeros((3, 6))
    >>> corner[1:, 0], corner[2:, 1] = 1.0, -1.0
    >>> trajectory = tk.time_path(robot, corner, tolerance=1e-2)
    >>> q, qd, qdd = trajectory.sample(np.linspace(0.0, trajectory.duration, 1000))
    >>> bool(np.all(np.abs(qd) <= robot.velocity_limits))
    True
    >>> trajectory.path_deviation < 1e-2
    True
    """
    from thing_kin.timing.geometry import smooth_curve, without_repetitions
    from thing_kin.timing.profile import retimed

    lower, upper = np.array(robot.lower), np.array(robot.upper)
    waypoints = read.within(read.read_path(q, robot.n), "q", lower, upper)
    limits = _read_rates(robot, velocity_limits, acceleration_limits, jerk_limits, wheel_limits)
    tube = read.read_tolerance(tolerance)
    points = _without_blocked(without_repetitions(waypoints), limits)
    if len(points) == 1:
        return _standing(robot, points[0])
    speed = _sensible_speed(points, limits)
    box = np.minimum(lower, points.min(axis=0)), np.maximum(upper, points.max(axis=0))
    curve = smooth_curve(points, speed, TUBE_SHARE * tube, *box)
    motion, error = retimed(curve, limits)
    return _trajectory(robot, motion, curve.deviation_bound + 2.0 * error)


def move_to(
    robot: Chain,
    q0: ArrayLike,
    q1: ArrayLike,
    *,
    velocity_limits: ArrayLike | None = None,
    acceleration_limits: ArrayLike | None = None,
    jerk_limits: ArrayLike | None = None,
    wheel_limits: WheelLimits | None = None,
) -> Trajectory:
    """Fastest motion between two configurations along the straight line of joint space.

    Found by Ruckig: from rest to rest in at most seven phases of constant jerk.

    Parameters
    ----------
    robot : Chain
    q0, q1 : (n,), rad and m
    velocity_limits, acceleration_limits : (n,) or float, optional
        As for time_path.
    jerk_limits : (n,) or float, per s^3, optional
        Default: such that acceleration is reached within about 2 % of the duration.
    wheel_limits : WheelLimits, optional
        Kept by stretching the whole motion.

    Returns
    -------
    Trajectory

    Raises
    ------
    ValueError
        As for time_path.
    ImportError
        If the extra `timing` is not installed.

    Examples
    --------
    >>> import thing_kin as tk
    >>> robot = tk.robots.ur5()
    >>> trajectory = tk.move_to(robot, [0.0] * 6, [1.0] * 6, jerk_limits=50.0)
    >>> _, _, _, jerk = trajectory.sample(0.01, derivatives=3)
    >>> jerk.round(3)
    array([50., 50., 50., 50., 50., 50.])
    """
    from thing_kin.timing.profile import within_limits
    from thing_kin.timing.straight import straight

    lower, upper = np.array(robot.lower), np.array(robot.upper)
    begin, end = (
        read.within(read.read_configuration(value, name, robot.n), name, lower, upper)
        for value, name in ((q0, "q0"), (q1, "q1"))
    )
    limits = _read_rates(robot, velocity_limits, acceleration_limits, jerk_limits, wheel_limits)
    points = np.stack([begin, end])
    if np.abs(end - begin).max() <= 1e-9:
        return _standing(robot, begin)
    points = _without_blocked(points, limits)
    motion = straight(points[0], points[1], *_all_finite(points, limits))
    return _trajectory(robot, within_limits(motion, limits), 0.0)


def timed(plan: PathPlan, **kwargs: Any) -> Trajectory:
    """Give a path its time.

    Parameters
    ----------
    plan : PathPlan
    **kwargs
        As for time_path.

    Returns
    -------
    Trajectory

    Raises
    ------
    ValueError
        If the plan is no success, and as for time_path.
    """
    if not plan.success:
        raise ValueError(f"plan: got one that failed ({plan.message}), expected a success")
    return time_path(plan.robot, plan.q, **kwargs)


def _trajectory(robot: Chain, motion: Quintic, deviation: float) -> Trajectory:
    return Trajectory(
        robot.names, motion.x, motion.y, motion.dy, motion.ddy, path_deviation=deviation
    )


def _standing(robot: Chain, q: Array) -> Trajectory:
    rest = np.zeros((1, robot.n))
    return Trajectory(robot.names, [0.0], q[None, :], rest, rest, path_deviation=0.0)


def _read_rates(
    robot: Chain, velocity: Any, acceleration: Any, jerk: Any, wheels: WheelLimits | None
) -> RateLimits:
    n = robot.n
    base = tuple(robot.base_joints or ())
    if wheels is not None and not base:
        raise ValueError(f"wheel_limits: got {wheels!r}, expected None: the robot has no base")
    return RateLimits(
        read.read_limits(velocity, "velocity_limits", n, robot.velocity_limits),
        read.read_limits(acceleration, "acceleration_limits", n, robot.acceleration_limits),
        read.read_limits(jerk, "jerk_limits", n),
        wheels,
        base,
    )


def _without_blocked(points: Array, limits: RateLimits) -> Array:
    """Joints that may not move stand exactly still; a ValueError if they would have to move."""
    for name in ("velocity", "acceleration", "jerk"):
        for joint in np.flatnonzero(getattr(limits, name) == 0.0):
            way = np.ptp(points[:, joint])
            if way > 1e-9:
                raise ValueError(
                    f"{name}_limits: got 0 for joint {joint}, which moves by {way:g}, expected > 0"
                )
            points[:, joint] = points[0, joint]
    return points


def _sensible_speed(points: Array, limits: RateLimits) -> Array:
    """(n,): the speed that each joint may reach on this path, finite and positive."""
    way = np.abs(np.diff(points, axis=0)).sum(axis=0)
    with np.errstate(invalid="ignore"):
        speed = np.minimum(limits.velocity, np.sqrt(limits.acceleration * way))
        speed = np.minimum(speed, np.cbrt(limits.jerk * way**2))
    if limits.wheels is not None:
        wheel = limits.wheels.radius * limits.wheels.speed
        reach = [wheel, wheel, wheel / limits.wheels.k]
        base = list(limits.base_joints)
        speed[base] = np.fmin(speed[base], reach)
    moving = (way > 0.0) & np.isfinite(speed)
    if not moving.any():
        raise ValueError("velocity_limits: got none for the joints that move, expected one finite")
    fastest = float(speed[moving].max())
    return np.where(moving, speed, fastest)


def _all_finite(points: Array, limits: RateLimits) -> tuple[Array, Array, Array]:
    """Limits for Ruckig, which wants each to be finite: far above what the others allow."""
    way = np.abs(points[1] - points[0])
    still = way == 0.0
    speed = _sensible_speed(points, limits)
    slowest = float((way / speed).max())  # s: a little less than the whole will take
    velocity = np.where(np.isfinite(limits.velocity), limits.velocity, EVEN_MOST * way / slowest)
    soft = way / (slowest**2 * SOFT_RAMP)
    acceleration = np.where(np.isfinite(limits.acceleration), limits.acceleration, soft)
    soft = np.minimum(acceleration, 4.0 * way / slowest**2 / SOFT_RAMP) / (SOFT_RAMP * slowest)
    jerk = np.where(np.isfinite(limits.jerk), limits.jerk, soft)
    return tuple(np.where(still, 1.0, x) for x in (velocity, acceleration, jerk))  # type: ignore[return-value]
