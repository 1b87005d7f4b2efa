"""Worlds by name: the standard one and what may be different about the real one."""

from __future__ import annotations

from dataclasses import replace
from math import radians

from thing_kin.rmma.world import World

DRIFT = ("slip_std", "speed_std", "heading_std", "curvature_mean", "curvature_std", "heading_walk")
ODOMETRY = ("odo_bias_std", "odo_std", "odo_white", "odo_heading_std")
ARM = ("arm_std", "arm_hidden_std", "sample_std")


def scaled(world: World, names: tuple[str, ...], factor: float) -> World:
    """Return the world with some of its numbers multiplied."""
    return replace(world, **{name: factor * getattr(world, name) for name in names})


def named_worlds() -> dict[str, World]:
    """Return the worlds in which methods are compared, each one change away from the standard.

    Examples
    --------
    >>> from thing_kin import rmma
    >>> rmma.named_worlds()["detection radius 6 mm"].detection_radius
    0.006
    """
    standard = World()
    blind = replace(standard, detection_radius=0.003)
    turning = ("heading_std", "curvature_mean", "curvature_std", "heading_walk")
    return {
        "standard": standard,
        "detection radius 6 mm": replace(standard, detection_radius=0.006),
        "detection radius 3 mm": blind,
        "drift x2": scaled(standard, DRIFT, 2.0),
        "curvature 2 deg/m": replace(standard, curvature_mean=radians(2.0)),
        "slip 5 %": replace(standard, slip_mean=0.05),
        "odometry error x2": scaled(standard, ODOMETRY, 2.0),
        "odometry error x4": scaled(standard, ODOMETRY, 4.0),
        "arm error x2": scaled(standard, ARM, 2.0),
        "slow arm": replace(standard, sample_time=0.4),
        "creep 0.4 mm/s": replace(standard, creep=4e-4, **dict.fromkeys(turning, 0.0)),
        "map error 5 mm": replace(standard, map_std=0.005),
        "map error 10 mm": replace(standard, map_std=0.010),
        "3 mm, quick arm": replace(blind, sample_time=0.04),
        "start lag 0.5 s": replace(standard, start_lag=0.5),
        "3 mm, drift x2, odometry x2": scaled(scaled(blind, DRIFT, 2.0), ODOMETRY, 2.0),
    }
