"""Chains, their motion, Lie groups, linear algebra."""

from collections.abc import Callable
from typing import Any

import numpy as np

import thing_kin as tk
from public_arrays.argument import ARM, FREE, KDL, ROBOT, XI, Argument, J, Q, T
from thing_kin import kdl, lie


def limited(name: str) -> Callable[[Any], Any]:
    return lambda value: getattr(ROBOT.with_limits(**{name: value}), name)


CHAIN = [
    Argument(f"Chain.{method}", "q", Q, getattr(ROBOT, method), infinite, moderate=True)
    for infinite, methods in (
        (False, "fk fk_all jacobian hessian manipulability manipulability_gradient"),
        (False, "condition_number_gradient dexterity_gradient base_pose task_vector"),
        (False, "analytic_jacobian task_jacobian"),
        (True, "condition_number dexterity"),
    )
    for method in methods.split()
]
QD, QDD, POINT = np.linspace(-1.0, 1.0, 9), np.linspace(0.3, -0.7, 9), XI[:3]


def moving(method: str, name: str) -> Callable[[Any], Any]:
    """A call of `method` where `name` is free."""
    known = {"q": Q, "qd": QD} | ({"qdd": QDD} if method == "acceleration" else {})
    if method in ("jacobian", "hessian", "analytic_jacobian"):
        known = {"q": Q}
    return lambda value: getattr(ROBOT, method)(**{**known, name: value})


MOTION = [
    Argument(f"Chain.{method}", name, good, moving(method, name), moderate=name == "q")
    for method, names in (
        ("jacobian", "point"),
        ("hessian", "point"),
        ("analytic_jacobian", "point"),
        ("jacobian_dot", "q qd point"),
        ("velocity", "q qd point"),
        ("drift", "q qd point"),
        ("acceleration", "q qd qdd point"),
    )
    for name, good in {"q": Q, "qd": QD, "qdd": QDD, "point": POINT}.items()
    if name in names.split()
]
LIE = [
    Argument(name, argument, good, getattr(lie, name), moderate=True)
    for name in lie.__all__
    if name not in ("se2_compose", "se2_between")
    for argument, good in [
        ("quaternion", np.array([0.5, 0.5, -0.5, 0.5])) if name == "rotation_from_quaternion"
        else ("R", T[:3, :3])
        if name in ("so3_log", "quaternion_from_rotation", "rpy_from_rotation")
        else ("rpy", XI[3:]) if name == "rotation_from_rpy"
        else ("T", T) if name in ("se3_log", "se3_adjoint")
        else ("pose", XI[3:]) if name in ("se2_log", "se2_adjoint", "se2_inverse")
        else ("phi", XI[3:]) if name.startswith("so3")
        else ("xi", XI[3:]) if name.startswith("se2")
        else ("xi", XI)
    ]
]  # fmt: skip


def composed(name: str, argument: str) -> Callable[[Any], Any]:
    known = {"a": XI[:3], "b": XI[:3]}
    return lambda value: getattr(lie, name)(**{**known, argument: value})


LIE += [
    Argument(name, argument, XI[3:], composed(name, argument), moderate=True)
    for name in ("se2_compose", "se2_between")
    for argument in ("a", "b")
]
LINALG = [
    Argument("pinv", "J", J, tk.pinv),
    Argument("pinv damped", "J", J, lambda v: tk.pinv(v, damping=1e-3)),
    Argument("pinv", "damping", np.full(6, 0.1), lambda v: tk.pinv(J, damping=v)),
    Argument("null_space", "J", J, tk.null_space),
    Argument("null_space_projector", "J", J, tk.null_space_projector),
    Argument("filter", "J", J, lambda v: tk.filter_singular_values(v, sigma0=0.01, nu=10.0)),
    Argument("selectively_damped_step", "J", J, lambda v: tk.selectively_damped_step(v, XI)),
    Argument("selectively_damped_step", "e", XI, lambda v: tk.selectively_damped_step(J, v)),
    Argument("SingularValueFilter()", "s", np.array(0.3), tk.SingularValueFilter(0.01, 2.0)),
]
MODEL = [
    Argument("transform", "xyz", XI[:3], lambda v: tk.transform(xyz=v)),
    Argument("transform", "rpy", XI[3:], lambda v: tk.transform(rpy=v)),
    Argument("transform", "quaternion", np.full(4, 0.5), lambda v: tk.transform(quaternion=v)),
    Argument("pose_error", "T", T, lambda v: tk.pose_error(v, T)),
    Argument("pose_error", "T_goal", T, lambda v: tk.pose_error(T, v)),
    Argument("pose_error body", "T_goal", T, lambda v: tk.pose_error(T, v, frame="body")),
    Argument("on_omni_base", "mount", T, lambda v: tk.on_omni_base(ARM, v).fk(Q)),
    Argument("pioneer", "mount", T, lambda v: tk.robots.pioneer_lx_ur5(v).fk(Q)),
    Argument("with_tool", "tool", T, lambda v: ARM.with_tool(v).fk(Q[:6])),
    *(
        Argument("with_limits", name, getattr(ROBOT, name) / 2, limited(name), infinite=True)
        for name in ("lower", "upper", "velocity_limits", "acceleration_limits")
    ),
    Argument("difference", "q_from", Q, lambda v: FREE.difference(v, Q[::-1]), moderate=True),
    Argument("difference", "q_to", Q, lambda v: FREE.difference(Q[::-1], v), moderate=True),
    Argument("KdlChain.fk", "q", Q[:6], KDL.fk),
    Argument("KdlChain.jacobian", "q", Q[:6], KDL.jacobian),
    Argument("kdl.ik", "target", ARM.fk(Q[:6]), lambda T: kdl.ik(ARM, T, Q[:6]).q),
    Argument("kdl.ik", "seed", Q[:6], lambda q: kdl.ik(ARM, ARM.fk(Q[:6]), q).q),
]
