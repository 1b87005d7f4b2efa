"""A reference simulation's figures, which this library was asked to meet.

Its world was fitted to the thesis's spiral rows alone; the standard world is that fit, rounded.
Two series were run with it, of 1000 and of 500 runs an entry; `expected` is the mean of what they
have of an entry. Rates are shares of 1, times in s, errors in m.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isnan, nan

from thing_kin.rmma.thesis import Measures

Key = tuple[int, str, int | None]  # arrangement, method, configuration

RATE_TOLERANCE = 0.03
TIME_TOLERANCE, LEAST_TIME_TOLERANCE = 0.15, 0.1  # a share, and s


def _row(percent: float, seconds: float, millimeters: float = nan) -> Measures:
    return Measures(percent / 100, seconds, millimeters / 1000)


READINGS: Mapping[Key, Sequence[Measures]] = {
    (1, "spiral", None): (_row(85.9, 1.92, 11.9), _row(85.98, 1.89, 11.6)),
    (2, "spiral", None): (_row(97.4, 0.75, 6.3), _row(97.13, 0.73, 6.2)),
    (3, "spiral", None): (_row(86.7, 1.73, 11.6), _row(84.73, 1.89, 12.4)),
    (1, "linear_kf", 6): (_row(70.8, 4.02, 15.4), _row(71.44, 3.95, 15.2)),
    (2, "linear_kf", 6): (_row(84.70, 1.54, 9.6),),
    (3, "linear_kf", 6): (_row(70.40, 3.93, 16.8),),
    (1, "ukf", 1): (_row(83.4, 2.55),),
    (1, "ukf", 2): (_row(89.1, 1.48),),
    (1, "ukf", 3): (_row(88.3, 1.18),),
    (1, "ukf", 4): (_row(80.3, 2.68),),
    (1, "ukf", 5): (_row(86.0, 2.40),),
    (1, "ukf", 6): (_row(83.5, 2.64, 13.3), _row(84.5, 2.54), _row(82.80, 2.77, 13.5)),
    (1, "ukf", 7): (_row(89.6, 1.52),),
    (2, "ukf", 1): (_row(88.1, 1.21),),
    (2, "ukf", 2): (_row(90.9, 0.57, 9.2), _row(91.7, 0.53), _row(90.90, 0.54, 9.2)),
    (2, "ukf", 3): (_row(84.8, 0.48),),
    (2, "ukf", 4): (_row(85.1, 1.29),),
    (2, "ukf", 5): (_row(92.1, 1.07),),
    (2, "ukf", 6): (_row(88.7, 1.19), _row(89.50, 1.13, 8.3)),
    (3, "ukf", 1): (_row(83.2, 2.45),),
    (3, "ukf", 2): (_row(87.5, 1.82, 15.3), _row(87.8, 1.80), _row(86.71, 1.95, 15.8)),
    (3, "ukf", 3): (_row(86.3, 1.69),),
    (3, "ukf", 4): (_row(79.7, 2.53),),
    (3, "ukf", 5): (_row(86.3, 2.27),),
    (3, "ukf", 6): (_row(84.1, 2.45), _row(81.64, 2.71, 14.6)),
}

#: The reference simulation's better method: with odometry and heading, and its weaker forms.
COVERING: Mapping[tuple[int, str], Measures] = {
    (1, "covering"): _row(100.00, 0.10, 4.0),
    (2, "covering"): _row(100.00, 0.07, 3.0),
    (3, "covering"): _row(100.00, 0.09, 3.6),
    (1, "covering, odometry on failure"): _row(99.82, 0.58, 11.1),
    (2, "covering, odometry on failure"): _row(100.00, 0.19, 6.1),
    (3, "covering, odometry on failure"): _row(99.71, 0.66, 10.9),
    (1, "covering, no odometry"): _row(99.62, 0.61, 11.3),
    (2, "covering, no odometry"): _row(100.00, 0.19, 6.1),
    (3, "covering, no odometry"): _row(99.51, 0.69, 11.1),
}

#: Rates of the fiducials that are not registered.
BY_FIDUCIAL: Mapping[tuple[int, str], tuple[float, ...]] = {
    (1, "spiral"): (0.94, 0.90, 0.98, 0.82, 0.45, 0.88, 0.76),
    (2, "spiral"): (0.98, 0.97, 0.97, 0.96, 0.97),
    (3, "spiral"): (0.98, 0.94, 0.92, 0.96, 0.38, 0.79, 0.83),
    (1, "ukf"): (0.91, 0.86, 0.93, 0.78, 0.56, 0.73, 0.74),
    (2, "ukf"): (0.90, 0.91, 0.89, 0.88, 0.87),
    (3, "ukf"): (0.92, 0.91, 0.91, 0.90, 0.61, 0.81, 0.82),
}


def expected(arrangement: int, method: str, config: int | None = None) -> Measures:
    """Mean of the reference simulation's readings of an entry."""
    readings = READINGS[arrangement, method, config]
    errors = [r.position_error for r in readings if not isnan(r.position_error)]
    return Measures(
        sum(r.interception_rate for r in readings) / len(readings),
        sum(r.search_time for r in readings) / len(readings),
        sum(errors) / len(errors) if errors else nan,
    )


def is_met(rate: float, time: float, by: Measures) -> bool:
    """Whether a rate is within 3 points, and a time within 15 % or 0.1 s."""
    within = max(TIME_TOLERANCE * by.search_time, LEAST_TIME_TOLERANCE)
    close = abs(rate - by.interception_rate) <= RATE_TOLERANCE
    return close and abs(time - by.search_time) <= within
