"""NLopt's SLSQP from Python."""

import importlib
from typing import Any

import numpy as np

from pose import Instance, Solver, register
from pose.functions import Functions


@register
class NloptPython(Solver):
    name = "nlopt_python"
    title = "NLopt SLSQP, Python"
    note = "xtol 1e-9, 500 evaluations; functions and Jacobians by thing_kin's Python calls"
    packages = ("nlopt",)

    def __init__(self, instances: list[Instance]) -> None:
        super().__init__(instances)
        self.nlopt = importlib.import_module("nlopt")

    def solve(self, x: Any) -> Any:
        f = Functions(x)

        def objective(q: Any, gradient: Any) -> float:
            if gradient.size:
                gradient[:] = f.gradient(q)
            return f.objective(q)

        def pose(result: Any, q: Any, jacobian: Any) -> None:
            if jacobian.size:
                jacobian[:] = f.pose_jacobian(q)
            result[:] = f.pose(q)

        def room(result: Any, q: Any, jacobian: Any) -> None:  # at most 0
            if jacobian.size:
                jacobian[:] = -f.room_jacobian(q)
            result[:] = -f.room(q)

        solver = self.nlopt.opt(self.nlopt.LD_SLSQP, 9)
        solver.set_lower_bounds(x.lower)
        solver.set_upper_bounds(x.upper)
        solver.set_min_objective(objective)
        solver.add_equality_mconstraint(pose, np.full(6, 1e-8))
        solver.add_inequality_mconstraint(room, np.full(2, 1e-8))
        solver.set_xtol_rel(1e-9)
        solver.set_maxeval(500)
        last = [x.seed]
        try:
            return solver.optimize(x.seed), solver.last_optimize_result() > 0
        except Exception:  # its own classes differ from version to version
            return last[0], False
