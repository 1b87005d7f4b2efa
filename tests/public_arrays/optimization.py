"""Obstacles, terms, problems, poses."""

from collections.abc import Callable
from typing import Any

import numpy as np

import thing_kin as tk
from public_arrays.argument import ROBOT, XI, Argument, Q, T
from public_arrays.kinematics import POINT

SHAPE = tk.LinkSpheres(ROBOT, [("tool", (0.0, 0.0, 0.1), 0.1), ("forearm", (0.2, 0.0, 0.0), 0.1)])
BALL = tk.Sphere((0.1, 0.2, 0.3), 0.2)


def obstacle(make: Callable[[Any], Any]) -> Callable[[Any], Any]:
    return lambda value: make(value).signed_distance(POINT)


OBSTACLES = [
    Argument("Disc", "center", XI[:2], obstacle(lambda v: tk.Disc(v, 0.1))),
    Argument("Sphere", "center", XI[:3], obstacle(lambda v: tk.Sphere(v, 0.1))),
    Argument("Capsule", "start", XI[:3], obstacle(lambda v: tk.Capsule(v, (0, 0, 0), 0.1))),
    Argument("Capsule", "end", XI[:3], obstacle(lambda v: tk.Capsule((0, 0, 0), v, 0.1))),
    Argument("Box", "size", XI[:3], obstacle(lambda v: tk.Box(size=v))),
    Argument("Box", "center", XI[:3], obstacle(lambda v: tk.Box(size=XI[:3], center=v))),
    Argument("Box", "rpy", XI[3:], obstacle(lambda v: tk.Box(size=XI[:3], rpy=v))),
    Argument("Box", "pose", T, obstacle(lambda v: tk.Box(size=XI[:3], pose=v))),
    Argument("HalfSpace", "normal", XI[:3], obstacle(lambda v: tk.HalfSpace(v, offset=0.5))),
    Argument("HalfSpace", "point", XI[:3], obstacle(lambda v: tk.HalfSpace((0, 3, 4), point=v))),
    Argument("signed_distance", "points", XI[:3], BALL.signed_distance),
    Argument("centers", "q", Q, lambda v: SHAPE.centers(ROBOT, v), moderate=True),
]


def term(make: Callable[[Any], Any]) -> Callable[[Any], Any]:
    def call(value: Any) -> Any:
        made = make(value)
        return np.append(made.evaluate(ROBOT, Q)[0], made.hessian(ROBOT, Q))

    return call


def pose_term(q: Any) -> Any:
    value, J = tk.terms.Pose(T).evaluate(ROBOT, q)
    return np.append(J, value[..., None], axis=-1)


TERMS = [
    Argument("terms.Pose", "target", T, term(tk.terms.Pose)),
    Argument("terms.Position", "target", XI[:3], term(tk.terms.Position)),
    Argument(
        "terms.Position", "point", XI[:3], term(lambda v: tk.terms.Position((0, 0, 0), point=v))
    ),
    Argument("terms.Orientation", "target", T[:3, :3], term(tk.terms.Orientation)),
    Argument("terms.Cone", "axis", XI[:3], term(lambda v: tk.terms.OrientationCone(v, (0, 0, 1)))),
    Argument(
        "terms.Cone", "direction", XI[:3], term(lambda v: tk.terms.OrientationCone((0, 0, 1), v))
    ),
    Argument("terms.BaseDistance", "center", XI[:2], term(tk.terms.BaseDistance)),
    Argument("terms.BasePosition", "target", XI[:2], term(tk.terms.BasePosition)),
    Argument("terms.SeedDistance of", "seed", Q, term(tk.terms.SeedDistance)),
    Argument(
        "terms.SeedDistance", "weights", np.ones(9), term(lambda v: tk.terms.SeedDistance(Q, v))
    ),
    Argument(
        "terms.Dexterity",
        "jacobian",
        np.ones(9),
        term(lambda v: tk.terms.Dexterity(jacobian=v)),
        moderate=True,
    ),
    Argument("terms evaluate", "q", Q, pose_term, moderate=True),
    Argument("terms hessian", "q", Q, lambda v: tk.terms.Pose(T).hessian(ROBOT, v), moderate=True),
    Argument(
        "terms hessian",
        "weights",
        XI,
        lambda v: tk.terms.Pose(T).hessian(ROBOT, Q, v),
        moderate=True,
    ),
]


def pose_with(name: str) -> Callable[[Any], Any]:
    known: dict[str, Any] = {"target": T, "seed": Q, "base_goal": XI[:2] / 4, "base_radius": 0.5}

    def call(value: Any) -> Any:
        return tk.plan_pose(ROBOT, **{**known, name: value}, max_restarts=2).q

    return call


POSE_PLAN = [
    Argument("plan_pose", "target", T, pose_with("target"), moderate=True),
    Argument("plan_pose", "seed", Q, pose_with("seed"), moderate=True),
    Argument("plan_pose", "base_goal", XI[:2] / 4, pose_with("base_goal")),
    Argument("plan_pose", "heading", np.array([-1.0, 1.0]), pose_with("heading")),
    Argument("plan_pose", "jacobian", np.full(9, 0.5), pose_with("jacobian")),
]
SQUARE_OF_3 = tk.terms.Function(lambda x: x**2, lambda x: 2 * np.diag(x), size=3, n=3)
SQUARE = tk.terms.Function(lambda x: x**2, lambda x: 2 * np.diag(x), size=3, name="square")


def problem_with(method: str, name: str, **others: Any) -> Callable[[Any], Any]:
    """What a problem has of a value that a constraint was given."""

    def call(value: Any) -> Any:
        problem = tk.Problem(n=3)
        getattr(problem, method)(SQUARE, **others, **{name: value})
        side = "upper" if name == "upper" else "lower"
        return getattr(problem, f"constraint_{side}")

    return call


def bounded(name: str) -> Callable[[Any], Any]:
    return lambda value: getattr(tk.Problem(n=3, **{name: value}), name)


def solved(value: Any) -> Any:
    problem = tk.Problem(n=3, lower=-1.0)
    problem.minimize(SQUARE)
    return tk.sqp(problem, value, minimizer="qp", max_iterations=3).x


ABC = np.array([0.5, -1.0, 2.0])
PROBLEM = [
    Argument("Problem", "lower", ABC, bounded("lower"), infinite=True),
    Argument("Problem", "upper", ABC, bounded("upper"), infinite=True),
    Argument("equal", "target", ABC, problem_with("equal", "target")),
    Argument("at_most", "upper", ABC, problem_with("at_most", "upper"), infinite=True),
    Argument("at_least", "lower", ABC, problem_with("at_least", "lower"), infinite=True),
    Argument("between", "lower", ABC, problem_with("between", "lower", upper=3.0), infinite=True),
    Argument("evaluate", "x", ABC, lambda v: tk.Problem(n=3).evaluate(v).gradient),
    Argument(
        "check_derivatives",
        "x",
        ABC,
        lambda v: tk.check_derivatives(SQUARE_OF_3, v).jacobian_difference,
        moderate=True,
    ),
    Argument("sqp", "x0", ABC, solved, moderate=True),
]
