"""The same path problem in CasADi, solved by IPOPT: another formulation, another solver.

There the configurations are free variables with the poses as equalities, and the eigenvalues that
kappa is made of are variables with their eigenvectors, so that everything is smooth.
"""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import thing_kin as tk
from oracles import assert_close

casadi = pytest.importorskip("casadi")

Vector = NDArray[np.float64]
ROBOT = tk.robots.thing()
SEED = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
HALF = np.pi / 2
# [M17] Table A.1: d, theta, a, alpha, and which q adds to theta or d.
ROWS = (
    (0.0, HALF, 0.0, HALF, None, ""),
    (0.0, HALF, 0.0, HALF, 6, "d"),
    (0.0, HALF, 0.0, HALF, 7, "d"),
    (0.0, 0.0, 0.0, 0.0, 8, "theta"),
    (0.653, 0.0, 0.27, 0.0, None, ""),
    (0.0, HALF, 0.01, 0.0, None, ""),
    (0.1273, 0.0, 0.0, HALF, 0, "theta"),
    (0.0, 0.0, -0.612, 0.0, 1, "theta"),
    (0.0, 0.0, -0.5723, 0.0, 2, "theta"),
    (0.163941, 0.0, 0.0, HALF, 3, "theta"),
    (0.1157, 0.0, 0.0, -HALF, 4, "theta"),
    (0.0922, 0.0, 0.0, 0.0, 5, "theta"),
)


def kinematics() -> Any:
    """Position, rotation and geometric Jacobian as a function of q."""
    q = casadi.SX.sym("q", 9)
    T = casadi.SX.eye(4)
    axes: list[Any] = [None] * 9
    for d, theta, a, alpha, joint, kind in ROWS:
        if joint is not None:
            axes[joint] = (kind, T[:3, 2], T[:3, 3])
        angle = theta + (q[joint] if kind == "theta" else 0.0)
        shift = d + (q[joint] if kind == "d" else 0.0)
        c, s, ca, sa = casadi.cos(angle), casadi.sin(angle), np.cos(alpha), np.sin(alpha)
        step = casadi.SX.zeros(4, 4)
        step[0, :] = casadi.horzcat(c, -s * ca, s * sa, a * c)
        step[1, :] = casadi.horzcat(s, c * ca, -c * sa, a * s)
        step[2, :] = casadi.horzcat(0, sa, ca, shift)
        step[3, 3] = 1
        T = T @ step
    columns = [
        casadi.vertcat(casadi.cross(z, T[:3, 3] - o), z)
        if kind == "theta"
        else casadi.vertcat(z, casadi.SX.zeros(3))
        for kind, z, o in axes
    ]
    J = casadi.horzcat(*columns)
    return casadi.Function("kinematics", [q], [T[:3, 3], T[:3, :3], J])


def eigenpairs(q: Vector) -> Vector:
    """Largest and smallest eigenvalue of J J^T with their vectors: fourteen numbers."""
    values, vectors = np.linalg.eigh(ROBOT.jacobian(q) @ ROBOT.jacobian(q).T)
    return np.concatenate([values[[-1, 0]], vectors[:, -1], vectors[:, 0]])


def solve(
    poses: Vector, base: Vector, radius: float, disc: tk.Disc, weight: float, start: Vector
) -> tuple[Vector, float]:
    """The configurations and the objective that IPOPT ends with."""
    fk = kinematics()
    count = len(poses)
    q, pairs = casadi.SX.sym("q", 9, count), casadi.SX.sym("pairs", 14, count)
    objective: Any = 0
    zero, positive = [q[:, 0] - start[0]], []
    for k in range(count):
        p, R, J = fk(q[:, k])
        A = J @ J.T
        largest, smallest = pairs[0, k], pairs[1, k]
        for value, u in ((largest, pairs[2:8, k]), (smallest, pairs[8:14, k])):
            zero += [A @ u - value * u, casadi.sumsqr(u) - 1]
        log_det = 2 * casadi.sum1(casadi.log(casadi.diag(casadi.chol(A))))
        objective += weight * 0.25 * (casadi.log(largest / smallest) - log_det)
        if k > 0:
            twist = poses[k, :3, :3].T @ R
            zero += [p - poses[k, :3, 3], twist[2, 1] - twist[1, 2]]
            zero += [twist[0, 2] - twist[2, 0], twist[1, 0] - twist[0, 1]]
            objective += 0.5 * casadi.sumsqr(q[:, k] - q[:, k - 1])
            positive += [radius**2 - casadi.sumsqr(q[6:8, k] - base[k, :2])]
            way = q[6:8, k] - q[6:8, k - 1]
            t = casadi.dot(disc.center - q[6:8, k - 1], way) / casadi.sumsqr(way)
            nearest = q[6:8, k - 1] + casadi.fmin(casadi.fmax(t, 0), 1) * way
            positive += [casadi.sumsqr(nearest - disc.center) - disc.radius**2]
    x = casadi.vertcat(casadi.vec(q), casadi.vec(pairs))
    g = casadi.vertcat(*zero, *positive)
    solver = casadi.nlpsol(
        "ipopt",
        "ipopt",
        {"x": x, "f": objective, "g": g},
        {"print_time": False, "ipopt": {"print_level": 0, "tol": 1e-10, "max_iter": 500}},
    )
    equalities = casadi.vertcat(*zero).numel()
    upper = np.r_[np.zeros(equalities), np.full(len(positive), np.inf)]
    first = np.r_[start.ravel(), np.concatenate([eigenpairs(row) for row in start])]
    found = solver(x0=first, lbg=np.zeros(len(upper)), ubg=upper)
    assert solver.stats()["success"]
    return np.array(found["x"]).ravel()[: 9 * count].reshape(count, 9), float(found["f"])


@pytest.mark.parametrize("weight", [1e-3, 0.02])
def test_ipopt_finds_no_better(weight: float) -> None:
    count = 15
    s = np.linspace(0.0, 1.0, count)
    poses = np.repeat(ROBOT.fk(SEED)[None], count, axis=0)
    poses[:, 0, 3] += 1.5 * s
    base = np.column_stack([1.5 * s, 0.1 * np.sin(np.pi * s), np.zeros_like(s)])
    disc = tk.Disc(center=(0.75, 0.35), radius=0.4)
    plan = tk.plan_path(
        ROBOT,
        poses,
        seed=SEED,
        base_path=base,
        base_radius=0.3,
        obstacles=[disc],
        dexterity_weight=weight,
    )
    assert plan.success, plan.message
    rng = np.random.default_rng(2)
    start = plan.q + 0.03 * rng.normal(size=plan.q.shape)
    start[0] = plan.q[0]
    q, objective = solve(poses, base, 0.3, disc, weight, start)
    assert_close(plan.objective, objective, 1e-6 * (1.0 + abs(objective)))  # 1e-7 m inside
    assert_close(plan.q, q, 1e-3)
