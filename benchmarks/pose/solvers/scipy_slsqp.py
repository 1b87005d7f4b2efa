"""SciPy's SLSQP."""

from typing import Any

import numpy as np
from scipy.optimize import Bounds, minimize

from pose import Solver, register
from pose.functions import Functions


@register
class ScipySlsqp(Solver):
    name = "scipy"
    title = "SciPy SLSQP"
    note = "ftol 1e-10, 200 iterations; functions and Jacobians by thing_kin's Python calls"
    packages = ("scipy",)

    def solve(self, x: Any) -> Any:
        f = Functions(x)
        return minimize(
            f.objective,
            x.seed,
            jac=f.gradient,
            method="SLSQP",
            bounds=Bounds(x.lower, x.upper),
            constraints=[
                {"type": "eq", "fun": f.pose, "jac": f.pose_jacobian},
                {"type": "ineq", "fun": f.room, "jac": f.room_jacobian},
            ],
            options={"maxiter": 200, "ftol": 1e-10},
        )

    def answer(self, result: Any) -> tuple[Any, bool]:
        # It may leave a bound by rounding.
        return np.asarray(result.x), bool(result.success)
