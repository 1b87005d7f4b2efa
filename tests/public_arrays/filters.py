"""Kalman filters."""

from collections.abc import Callable
from typing import Any

import numpy as np

from public_arrays.argument import Argument
from thing_kin import estimation as est

STATE = {"x": np.array([0.5, 1.0, 0.2, -0.1]), "P": np.eye(4) + 0.1}
MOVED = {"F": np.eye(4) + np.eye(4, k=2), "Q": 0.1 * np.eye(4)}
DRIVEN = {"B": np.eye(4, 2), "u": np.array([0.1, 0.2])}
SEEN = {"z": np.array([0.4, 1.1]), "H": np.eye(2, 4), "R": 0.1 * np.eye(2)}
RECORD = {"record": np.array([[0.4, 1.1], [0.6, 0.9], [0.7, 0.8]])}
SIGHT = {"H": SEEN["H"], "R": SEEN["R"]}
NONLINEAR = {"f": MOVED["F"], "Q": MOVED["Q"], "h": SEEN["H"], "R": SEEN["R"]}


def filtered(kind: Any, method: str, name: str) -> Callable[[Any], Any]:
    """What is left in a filter after a step, or the states of a run, with one argument free."""
    linear = kind is est.KalmanFilter
    known = {
        "predict": MOVED | DRIVEN if linear else {k: NONLINEAR[k] for k in ("f", "Q")},
        "update": SEEN if linear else {k: (SEEN | NONLINEAR)[k] for k in ("z", "h", "R")},
        "run": RECORD | (MOVED | DRIVEN | SIGHT if linear else NONLINEAR),
    }

    def call(value: Any) -> np.ndarray:
        filter = kind(**STATE)
        result = getattr(filter, method)(**known[method] | {name: value})
        x, P = (result.x, result.P) if method == "run" else (filter.x, filter.P)
        return np.concatenate([x.ravel(), P.ravel()])

    return call


def begun(kind: Any, name: str, set_later: bool) -> Callable[[Any], Any]:
    """A filter made with one argument free, or given it afterwards."""

    def call(value: Any) -> np.ndarray:
        filter = kind(**STATE if set_later else STATE | {name: value})
        if set_later:
            setattr(filter, name, value)
        return np.concatenate([filter.x, filter.P.ravel()])

    return call


ALL_FILTERS = (est.KalmanFilter, est.ExtendedKalmanFilter, est.UnscentedKalmanFilter)
FILTERS = [
    *(
        Argument(
            f"{kind.__name__}{'.' + name if later else ''}", name, good, begun(kind, name, later)
        )
        for kind in ALL_FILTERS
        for later in (False, True)
        for name, good in STATE.items()
    ),
    *(
        Argument(f"KalmanFilter.{method}", name, good, filtered(est.KalmanFilter, method, name))
        for method, arguments in (
            ("predict", MOVED | DRIVEN),
            ("update", SEEN),
            ("run", RECORD | MOVED | DRIVEN | SIGHT),
        )
        for name, good in arguments.items()
    ),
    *(
        Argument(f"{kind.__name__}.{method}", name, NONLINEAR[name], filtered(kind, method, name))
        for kind in ALL_FILTERS[1:]
        for method, names in (("predict", "fQ"), ("update", "hR"), ("run", "fQhR"))
        for name in names
    ),
    *(
        Argument(
            "nees",
            name,
            good,
            lambda v, n=name: est.nees(**{"truth": STATE["x"] + 0.1, **STATE, n: v}),
        )
        for name, good in {"truth": STATE["x"] + 0.1, **STATE}.items()
    ),
]
