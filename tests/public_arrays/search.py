"""thing_kin.search and thing_kin.rmma."""

from collections.abc import Callable
from typing import Any

import numpy as np

import thing_kin as tk
from public_arrays.argument import XI, Argument
from thing_kin import rmma, search

POINTS = np.array([[0.0, 0.0], [0.01, 0.0], [0.0, 0.01]])
BELIEF = {"center": XI[:2], "covariance": 1e-4 * np.eye(2)}
COVERED = BELIEF | {
    "within": np.array([[0.5, 1.5], [1.5, 1.5], [1.5, 2.5], [0.5, 2.5]]),
    "reach_center": XI[:2],
    "velocity": np.array([0.01, 0.0]),
}


def covered(name: str) -> Callable[[Any], Any]:
    def call(value: Any) -> np.ndarray:
        known = COVERED | {name: value}
        return search.covering(radius=0.01, reach_radius=0.5, count=9, **known).points

    return call


def drawn(name: str) -> Callable[[Any], Any]:
    return lambda v: search.stochastic(**(BELIEF | {name: v}), sample_gap=0.01, rng=0)


def compensated(name: str) -> Callable[[Any], Any]:
    known = {"points": POINTS, "velocity": XI[:2], "dwell": np.array([0.0, 0.1, 0.3])}
    return lambda v: search.compensate(**(known | {name: v}))


def driven(name: str) -> Callable[[Any], Any]:
    side = np.array([[0.0, 0.6], [0.2, 0.6]])

    def call(value: Any) -> np.ndarray:
        run = rmma.World().start(0.02, value if name == "side" else side, np.random.default_rng(0))
        if name == "u_command":
            return np.concatenate(run.place(value))
        if name in ("tool_xy", "fiducial"):
            known = {"tool_xy": side[0], "fiducial": side[0]}
            return np.array([run.detects(**(known | {name: value}))])
        known = {"a": side[0], "b": side[1]} | {name: value}
        if name == "side":
            return np.array(run.pose(1.0))
        return np.array([run.move_time(**known), run.sample_time(**known)])

    return call


def reached(name: str) -> Callable[[Any], Any]:
    arm = rmma.ManipulatorArm(tk.robots.pioneer_lx_ur5())
    known = {"a": np.array([0.2, 0.6]), "b": np.array([0.1, 0.5])}
    if name == "displacement":
        return lambda v: arm.reaches(v)
    return lambda v: np.array([arm.motion_time(**(known | {name: v}))])


SEARCH = [
    Argument("spiral", "center", XI[:2], lambda v: search.spiral(v, 0.01, count=5)),
    *(Argument("stochastic", name, good, drawn(name)) for name, good in BELIEF.items()),
    Argument("compensate", "points", POINTS, compensated("points")),
    Argument("compensate", "velocity", XI[:2], compensated("velocity")),
    Argument("compensate", "dwell", np.array([0.0, 0.1, 0.3]), compensated("dwell")),
    *(Argument("covering of", k, v, covered(k), moderate=True) for k, v in BELIEF.items()),
    *(
        Argument("covering", k, v, covered(k), moderate=True)
        for k, v in COVERED.items()
        if k not in BELIEF
    ),
    Argument("WorldRun.place", "u_command", np.array([0.1, 0.6]), driven("u_command")),
    Argument("WorldRun.detects", "tool_xy", np.zeros(2), driven("tool_xy"), moderate=True),
    Argument("WorldRun.detects", "fiducial", np.zeros(2), driven("fiducial"), moderate=True),
    Argument("WorldRun.move_time", "a", np.zeros(2), driven("a"), moderate=True),
    Argument("WorldRun.move_time", "b", np.zeros(2), driven("b"), moderate=True),
    Argument("World.start", "side", np.array([[0.0, 0.6], [0.2, 0.6]]), driven("side")),
    Argument("ManipulatorArm", "displacement", np.array([0.2, 0.6]), reached("displacement")),
]
