"""From rest to rest in a straight line of joint space, by Ruckig (Berscheid and Kroeger 2021)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from thing_kin.timing.quintic import Quintic

Array = NDArray[np.float64]

MISSING = (
    "a motion from point to point needs Ruckig, which is not installed: "
    "pip install thing_kin[timing]"
)


def straight(q0: Array, q1: Array, velocity: Array, acceleration: Array, jerk: Array) -> Quintic:
    """Find the fastest motion along q1 - q0, all finite: seven phases of constant jerk."""
    try:
        import ruckig
    except ImportError as error:
        raise ImportError(MISSING) from error
    way = np.abs(q1 - q0)
    moving = way > 0.0
    given = ruckig.InputParameter(1)
    given.current_position, given.target_position = [0.0], [1.0]
    top = [float((limit[moving] / way[moving]).min()) for limit in (velocity, acceleration, jerk)]
    # Time in units in which nothing is far from 1, or Ruckig's roots lose their digits.
    unit = max(1.0 / top[0], top[1] ** -0.5, top[2] ** (-1.0 / 3.0))
    given.max_velocity, given.max_acceleration, given.max_jerk = (
        [top[0] * unit],
        [top[1] * unit**2],
        [top[2] * unit**3],
    )
    found = ruckig.Trajectory(1)
    result = ruckig.Ruckig(1).calculate(given, found)
    if result not in (ruckig.Result.Working, ruckig.Result.Finished):
        raise ValueError(f"q1: got a motion that Ruckig refuses ({result.name}), expected another")
    t = np.unique(np.concatenate([[0.0], np.cumsum(found.profiles[0][0].t), [found.duration]]))
    t = t[np.concatenate([[True], np.diff(t) > 1e-12 * t[-1]])]
    t[-1] = found.duration
    s, ds, dds = (np.array([found.at_time(float(x))[d][0] for x in t]) for d in range(3))
    s[0], s[-1] = 0.0, 1.0
    ds[[0, -1]] = dds[[0, -1]] = 0.0
    step = (q1 - q0)[None, :]
    y = q0 + s[:, None] * step
    y[-1] = q1
    return Quintic(t * unit, y, ds[:, None] * step / unit, dds[:, None] * step / unit**2)
