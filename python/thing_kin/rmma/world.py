"""What drifts, errs and takes time in the simulated experiment."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass

import numpy as np
import numpy.typing as npt

from thing_kin import _search
from thing_kin._search import WorldRun

_DEGREE = math.pi / 180.0


class RunRandom(np.random.Generator):
    """The generator of one drive, for worlds of one's own; `key` is where its numbers come from."""

    def __init__(self, key: int) -> None:
        super().__init__(np.random.PCG64(key))
        self.key = key


@dataclass(frozen=True)
class World:
    """The simulated world, SI units and radians; the defaults are the standard world.

    Drift is per distance, but for `creep`. `start` makes a drive; any object with such a method may
    stand for a World in `run`.

    Raises
    ------
    ValueError
        If a deviation, length or time is negative, a radius or speed not positive, or a number not
        finite; named by its field.

    Examples
    --------
    >>> from thing_kin import rmma
    >>> rmma.World(detection_radius=0.006).sample_time
    0.16
    """

    slip_mean: float = 0.0
    """Share of the speed that is lost."""
    slip_std: float = 0.017
    """Of it, from side to side."""
    speed_std: float = 0.03
    """Of the speed's share, an Ornstein-Uhlenbeck process over the way."""
    speed_length: float = 0.15
    """m: its correlation length."""
    heading_std: float = 0.4 * _DEGREE
    """rad, when a side begins."""
    curvature_mean: float = 0.3 * _DEGREE
    """rad/m."""
    curvature_std: float = 0.55 * _DEGREE
    """rad/m, from side to side."""
    heading_walk: float = 0.3 * _DEGREE
    """rad/sqrt(m)."""
    start_lag: float = 0.1
    """s before the base moves."""
    creep: float = 0.0
    """m/s to the left."""
    arm_std: float = 0.0032
    """m per axis after a move of the arm; forward kinematics sees it."""
    arm_hidden_std: float = 0.0005
    """m per axis after a move of the arm; unseen."""
    sample_std: float = 0.0005
    """m per axis at each stop; unseen."""
    odo_bias_std: float = 0.004
    """m per axis, from side to side: of the base's localization."""
    odo_std: float = 0.007
    """m per axis, an Ornstein-Uhlenbeck process over the way."""
    odo_length: float = 0.3
    """m: its correlation length."""
    odo_white: float = 0.001
    """m per axis and reading."""
    odo_heading_std: float = 0.3 * _DEGREE
    """rad per reading."""
    detection_radius: float = 0.012
    """m: how near the tool must stop for the laser to see a fiducial."""
    sample_time: float = 0.16
    """s for each stop."""
    sample_speed: float = 0.18
    """m/s from stop to stop."""
    move_time: float = 0.5
    """s for each move to another place of work."""
    move_speed: float = 0.15
    """m/s of such a move."""
    map_std: float = 0.0
    """m per axis: where fiducials are, against where they are listed."""
    u_max: float = 0.2
    """m: how far ahead of the base the arm is placed."""
    reach: float = 0.45
    """m along x: the arm goes no farther."""

    def __post_init__(self) -> None:
        _search.World(**asdict(self))

    def start(self, velocity: float, side: npt.ArrayLike, rng: np.random.Generator) -> WorldRun:
        """Begin a drive along a side: the base stands where its first fiducial is registered.

        Parameters
        ----------
        velocity : float
            m/s, > 0: what the base is told to do.
        side : (n, 2), m
            Fiducials as listed, in the side's frame: the base drives along +x from
            `side[0] - (0.20, 0.60)`.
        rng : numpy.random.Generator
            Where the drive's errors come from.

        Returns
        -------
        WorldRun
            With `pose(t)`, `odometry(t)`, `place(u_command)`, `detects(tool_xy, fiducial)`,
            `move_time(a, b)` and `sample_time(a, b)`.

        Raises
        ------
        ValueError
            If `velocity` or `side` is none.

        Examples
        --------
        >>> import numpy as np
        >>> from thing_kin import rmma
        >>> run = rmma.World().start(0.02, [[1.0, 0.6], [1.3, 0.6]], np.random.default_rng(0))
        >>> bool(run.pose(10.0)[0] > 0.9)
        True
        """
        if not (math.isfinite(velocity) and velocity > 0):
            raise ValueError(f"velocity: got {velocity}, expected a positive number of m/s")
        key = rng.key if isinstance(rng, RunRandom) else int(rng.integers(2**63))
        return _search.start_run(_search.World(**asdict(self)), velocity, side, key)
