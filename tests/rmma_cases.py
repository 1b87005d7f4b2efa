"""Results of the experiment made up at random, for tests of what is reckoned from them."""

import numpy as np

from thing_kin.rmma import ARRANGEMENTS, Result

VELOCITIES = (0.01, 0.015, 0.02, 0.025, 0.03)


def made_up(
    arrangement=1, method="ukf", *, runs=20, seed=0, rate=0.85, velocities=VELOCITIES, **options
) -> Result:
    """Searches that hit at a rate, with times and errors of the right size, some skipped."""
    rng = np.random.default_rng(seed)
    layout = ARRANGEMENTS[arrangement]
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
