"""IPOPT through CasADi."""

import importlib
from typing import Any

import numpy as np

from pose import Instance, Solver, register
from pose.functions import Functions
from thing_dh import folded


@register
class CasadiIpopt(Solver):
    name = "casadi"
    title = "CasADi + IPOPT"
    note = (
        "MUMPS, tol 1e-8, 300 iterations; pose and discs by CasADi's formulas, kappa/M, which has "
        "none, by thing_kin's Python call: hence a limited-memory BFGS Hessian"
    )
    packages = ("casadi",)

    def __init__(self, instances: list[Instance]) -> None:
        super().__init__(instances)
        self.ca = importlib.import_module("casadi")
        self.functions = Functions(instances[0])
        self.objective = self._callback()
        self.solver = self._made()

    def _callback(self) -> Any:
        ca, functions = self.ca, self.functions

        class Gradient(ca.Callback):  # type: ignore[misc, name-defined]
            def __init__(self) -> None:
                ca.Callback.__init__(self)
                self.construct("gradient", {})

            def get_n_in(self) -> int:
                return 2

            def get_sparsity_in(self, i: int) -> Any:
                return ca.Sparsity.dense(9 if i == 0 else 1, 1)

            def get_sparsity_out(self, i: int) -> Any:
                return ca.Sparsity.dense(1, 9)

            def eval(self, arguments: Any) -> Any:
                return [functions.gradient(np.array(arguments[0]).ravel())[None]]

        class Objective(ca.Callback):  # type: ignore[misc, name-defined]
            def __init__(self) -> None:
                ca.Callback.__init__(self)
                self.gradient = Gradient()
                self.construct("objective", {})

            def get_sparsity_in(self, i: int) -> Any:
                return ca.Sparsity.dense(9, 1)

            def eval(self, arguments: Any) -> Any:
                return [functions.objective(np.array(arguments[0]).ravel())]

            def has_jacobian(self) -> bool:
                return True

            def get_jacobian(self, *_: Any) -> Any:
                return self.gradient

        return Objective()

    def _made(self) -> Any:
        ca = self.ca
        q, p = ca.MX.sym("q", 9), ca.MX.sym("p", 16 + 4)
        to_goal, to_center = q[6:8] - p[16:18], q[6:8] - p[18:20]
        g = ca.vertcat(
            pose_function(ca)(q, p[:16]), ca.dot(to_goal, to_goal), ca.dot(to_center, to_center)
        )
        options = {
            "print_time": False,
            "ipopt.print_level": 0,
            "ipopt.sb": "yes",
            "ipopt.hessian_approximation": "limited-memory",
            "ipopt.tol": 1e-8,
            "ipopt.max_iter": 300,
        }
        return ca.nlpsol(
            "solver", "ipopt", {"x": q, "p": p, "f": self.objective(q), "g": g}, options
        )

    def solve(self, x: Any) -> Any:
        self.functions.__init__(x)  # type: ignore[misc] # the callbacks hold it
        zero = np.zeros(6)
        found = self.solver(
            x0=x.seed,
            p=np.concatenate([x.T.ravel(order="F"), x.goal, x.obstacle.center]),
            lbx=x.lower,
            ubx=x.upper,
            lbg=np.concatenate([zero, [0.0, x.obstacle.radius**2]]),
            ubg=np.concatenate([zero, [x.radius**2, np.inf]]),
        )
        return np.array(found["x"]).ravel(), self.solver.stats()["success"]


def pose_function(ca: Any) -> Any:
    """Position and rotation left of joints (9) and goal (16, column-major): zero at the goal.

    The rotation by phi is tan(phi/2) times its axis: zero at the goal alone.
    """
    q, flat = ca.SX.sym("q", 9), ca.SX.sym("goal", 16)
    goal = ca.reshape(flat, 4, 4)
    T = ca.SX.eye(4)
    joints, tool = folded()
    order = (6, 7, 8, 0, 1, 2, 3, 4, 5)  # from the root
    for (before, kind), i in zip(joints, order, strict=True):
        move = ca.SX.eye(4)
        if kind == "prismatic":
            move[2, 3] = q[i]
        else:
            c, s = ca.cos(q[i]), ca.sin(q[i])
            move[0, 0], move[0, 1], move[1, 0], move[1, 1] = c, -s, s, c
        T = T @ ca.DM(before) @ move
    T = T @ ca.DM(tool)
    E = goal[:3, :3] @ T[:3, :3].T
    twice_sine = ca.vertcat(E[2, 1] - E[1, 2], E[0, 2] - E[2, 0], E[1, 0] - E[0, 1])
    turn = twice_sine / (1.0 + ca.trace(E))  # sin phi / (1 + cos phi)
    return ca.Function("pose", [q, flat], [ca.vertcat(goal[:3, 3] - T[:3, 3], turn)])
