"""IPOPT through CasADi, on the whole path at once.

Poses are CasADi's, with exact derivatives; kappa has no formula there, so that dexterity is a
callback (thing_kin's batch) and the Hessian a limited-memory BFGS. It starts at the path of task
priority.
"""

import importlib
from typing import Any

import numpy as np

import thing_kin as tk
from path import RADIUS, Course
from pose.solvers.casadi_ipopt import pose_function

ITERATIONS = 1000
BETWEEN = 8  # parts of each line between waypoints, whose ends are kept out of the disc


def start(course: Course) -> Any:
    """The classical path: poses kept, obstacle ignored."""
    plan = tk.plan_path(
        course.robot,
        course.poses,
        seed=course.seed,
        base_path=course.base_path,
        method="task_priority",
    )
    return np.array(plan.q)


def dexterity(ca: Any, course: Course) -> Any:
    """A CasADi function of (9 N): sum of log sqrt(kappa/M), with its gradient."""
    n, robot = len(course.poses), course.robot

    class Gradient(ca.Callback):  # type: ignore[misc, name-defined]
        def __init__(self) -> None:
            ca.Callback.__init__(self)
            self.construct("gradient", {})

        def get_n_in(self) -> int:
            return 2

        def get_sparsity_in(self, i: int) -> Any:
            return ca.Sparsity.dense(9 * n if i == 0 else 1, 1)

        def get_sparsity_out(self, i: int) -> Any:
            return ca.Sparsity.dense(1, 9 * n)

        def eval(self, arguments: Any) -> Any:
            q = np.array(arguments[0]).reshape(n, 9)
            return [(robot.dexterity_gradient(q) / robot.dexterity(q)[:, None]).reshape(1, -1)]

    class Value(ca.Callback):  # type: ignore[misc, name-defined]
        def __init__(self) -> None:
            ca.Callback.__init__(self)
            self.gradient = Gradient()
            self.construct("dexterity", {})

        def get_sparsity_in(self, i: int) -> Any:
            return ca.Sparsity.dense(9 * n, 1)

        def eval(self, arguments: Any) -> Any:
            q = np.array(arguments[0]).reshape(n, 9)
            return [float(np.log(robot.dexterity(q)).sum())]

        def has_jacobian(self) -> bool:
            return True

        def get_jacobian(self, *_: Any) -> Any:
            return self.gradient

    return Value()


class CasadiIpopt:
    """The program of a course; making it is not timed."""

    def __init__(self, course: Course) -> None:
        self.ca = ca = importlib.import_module("casadi")
        self.course = course
        self.start = start(course)
        n = len(course.poses)
        self.dexterity = dexterity(ca, course)  # CasADi keeps no reference
        x = ca.MX.sym("x", 9 * n)
        q = ca.reshape(x, 9, n)
        steps = q[:, 1:] - q[:, :-1]
        objective = ca.sumsqr(steps) / 2 + course.dexterity_weight * self.dexterity(x)
        base = q[6:8, :]
        to_path = base - ca.DM(course.base_path[:, :2].T)
        parts = [k / BETWEEN for k in range(1, BETWEEN)]
        between = [(1 - u) * base[:, :-1] + u * base[:, 1:] for u in parts]
        center = ca.DM(list(course.obstacle.center))
        goals = ca.DM(np.concatenate([T.T.reshape(-1, 1) for T in course.poses], axis=1))
        residual = pose_function(ca).map(n)(q, goals)
        outside = ca.horzcat(base, *between)
        keep_out = ca.sum1((outside - center) ** 2).T
        g = [ca.vec(residual), ca.vec(steps), ca.sum1(to_path**2).T, keep_out]
        self.sizes = [int(part.numel()) for part in g]
        options = {
            "print_time": False,
            "ipopt.print_level": 0,
            "ipopt.sb": "yes",
            "ipopt.hessian_approximation": "limited-memory",
            "ipopt.tol": 1e-6,
            "ipopt.max_iter": ITERATIONS,
        }
        program = {"x": x, "f": objective, "g": ca.vertcat(*g)}
        self.solver = ca.nlpsol("solver", "ipopt", program, options)

    def solve(self) -> tuple[Any, bool, int]:
        course, n = self.course, len(self.course.poses)
        lower, upper = (
            np.tile(limit, (n, 1)) for limit in (course.robot.lower, course.robot.upper)
        )
        lower[0] = upper[0] = course.seed
        keep, away = course.obstacle.radius**2, np.inf
        low = (0.0, -course.max_step, 0.0, keep)
        high = (0.0, course.max_step, RADIUS**2, away)
        found = self.solver(
            x0=self.start.ravel(),
            lbx=lower.ravel(),
            ubx=upper.ravel(),
            lbg=np.repeat(low, self.sizes),
            ubg=np.repeat(high, self.sizes),
        )
        stats = self.solver.stats()
        return np.array(found["x"]).reshape(n, 9), stats["success"], stats["iter_count"]
