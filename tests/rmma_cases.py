"""Results of the experiment made up at random, for tests of what is reckoned from them."""

import numpy as np

from thing_kin.rmma import ARRANGEMENTS, CONFIGS, Result
from thing_kin.rmma.traces import SearchTrace, SideTrace, Trace

VELOCITIES = (0.01, 0.015, 0.02, 0.025, 0.03)


def made_up(
    arrangement=1,
    method="ukf",
    *,
    runs=20,
    seed=0,
    rate=0.85,
    velocities=VELOCITIES,
    config=None,
    **options,
) -> Result:
    """Searches that hit at a rate, with times and errors of the right size, some skipped."""
    rng = np.random.default_rng(seed)
    layout = ARRANGEMENTS[arrangement]
    options |= {"config": CONFIGS[config]} if config else {}
    registered = np.asarray(layout.registered)
    shape = (len(velocities), runs, len(registered))
    searched = (rng.random(shape) < 0.97) & ~registered
    hit = searched & (rng.random(shape) < rate)
    samples = np.where(searched, np.where(hit, rng.geometric(0.3, shape), 45), 0)
    return Result(
        arrangement=layout,
        method=method,
        velocities=np.array(velocities),
        registered=registered,
        intercepted=hit | registered,
        searched=searched,
        search_times=np.where(searched, 0.2 * (samples - 1), 0.0),
        position_errors=np.where(searched, rng.exponential(0.01, shape), np.nan),
        samples=samples.astype(np.int64),
        options=options,
    )


def made_up_trace(arrangement=1, *, velocity=0.02, seed=0) -> Trace:
    """Straight drives beside the fiducials, spirals about them, every third one missed."""
    rng = np.random.default_rng(seed)
    layout = ARRANGEMENTS[arrangement]
    sides = []
    for side in layout.sides:
        turn = -1.0 if side[-1, 0] < side[0, 0] else 1.0
        fiducials = turn * np.asarray(side)
        start = fiducials[0] - (0.2, 0.6)
        times = np.linspace(0.0, (np.ptp(fiducials[:, 0]) + 0.3) / velocity, 200)
        base = np.zeros((200, 3))
        base[:, 0] = start[0] + velocity * times
        base[:, 1] = start[1] + 0.01 * np.sin(times / 20)
        searches = []
        for k in range(1, len(fiducials)):
            begin = (fiducials[k, 0] - fiducials[0, 0]) / velocity
            count = int(rng.integers(2, 20))
            stop_times = begin + 0.2 * np.arange(count)
            angle = 0.7 * np.arange(count)[::-1]
            miss = 0.03 if k % 3 == 0 else 0.0
            around = 0.002 * np.sqrt(angle)[:, None] * np.stack([np.cos(angle), np.sin(angle)], 1)
            at = np.stack([np.interp(stop_times, times, column) for column in base.T], axis=1)
            searches.append(
                SearchTrace(
                    fiducial=k,
                    start=begin,
                    end=stop_times[-1],
                    hit=not miss,
                    predicted=fiducials[k] - (0.2, 0.6),
                    covariance=np.diag([1e-4, 3e-5]) if k % 2 else None,
                    stop_times=stop_times,
                    stops=fiducials[k] + around + miss,
                    base_at_stops=at,
                    position_error=0.01,
                )
            )
        rotation = np.pi if turn < 0 else 0.0
        sides.append(SideTrace(fiducials, rotation, times, base, tuple(searches)))
    return Trace(layout, "spiral", velocity, tuple(sides))
