"""The base localizer."""

from collections.abc import Callable
from typing import Any

import numpy as np

from public_arrays.argument import XI, Argument
from thing_kin import estimation as est


def fresh() -> est.BaseLocalizer:
    return est.BaseLocalizer(covariance=0.1 * np.eye(3), t=0.0)


def numbers(localizer: est.BaseLocalizer) -> np.ndarray:
    e = localizer.estimate()
    return np.concatenate([e.pose, e.covariance.ravel(), e.twist, e.twist_covariance.ravel()])


def heard(method: str, name: str) -> Callable[[Any], Any]:
    """What a localizer makes of a measurement of which one argument is free."""
    key = {"add_twist": "twist", "add_relative_pose": "motion"}.get(method, "pose")
    times = (0.5, 1.0) if method == "add_relative_pose" else (1.0,)

    def call(value: Any) -> np.ndarray:
        localizer = fresh()
        localizer.source("it", covariance=0.2)
        given = {key: 0.1 * XI[3:], "covariance": 0.1 * np.eye(3), name: value}
        getattr(localizer, method)(*times, **given, source="it")
        return numbers(localizer)

    return call


def started(name: str) -> Callable[[Any], Any]:
    return lambda value: numbers(est.BaseLocalizer(**{name: value}, t=0.0))


def declared(value: Any) -> np.ndarray:
    localizer = fresh()
    localizer.source("it", covariance=value)
    if value is not None:
        localizer.add_pose(1.0, (0, 0, 0), source="it")
    return numbers(localizer)


def after_reset(name: str) -> Callable[[Any], Any]:
    def call(value: Any) -> np.ndarray:
        localizer = fresh()
        localizer.reset(**{"pose": (0, 0, 0), "covariance": np.eye(3), name: value}, t=0.0)
        return numbers(localizer)

    return call


LOCALIZER = [
    *(
        Argument("BaseLocalizer", name, good, started(name))
        for name, good in (
            ("pose", XI[:3]),
            ("covariance", np.eye(3)),
            ("process_noise", np.eye(3)),
        )
    ),
    *(
        Argument(f"BaseLocalizer.{method}", name, good, heard(method, name))
        for method, value in (
            ("add_twist", "twist"),
            ("add_pose", "pose"),
            ("add_relative_pose", "motion"),
        )
        for name, good in ((value, 0.1 * XI[3:]), ("covariance", np.eye(3)))
    ),
    Argument("BaseLocalizer.source", "covariance", np.eye(3), declared),
    *(
        Argument("BaseLocalizer.reset", name, good, after_reset(name))
        for name, good in (("pose", XI[:3]), ("covariance", np.eye(3)))
    ),
]  # fmt: skip
