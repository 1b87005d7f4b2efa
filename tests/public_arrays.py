"""Every array argument of the public API, for fuzzing: a good value, and a call for others."""

import functools
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import thing_kin as tk
from thing_kin import estimation as est
from thing_kin import interop, kdl, lie, odometry, rmma, search
from thing_kin.kdl import KdlChain

ROBOT = tk.robots.thing()
ARM = tk.robots.ur5()
KDL = KdlChain(ARM)
FREE = tk.Chain.from_dh([tk.DH(a=0.1, joint="continuous") for _ in range(9)])
Q = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.3, -0.2, 0.4])
T = tk.transform(xyz=(0.5, -0.2, 0.3), rpy=(0.1, 0.2, 0.3))
XI = np.array([1.0, 2.0, 3.0, 0.1, 0.2, 0.3])
J = ROBOT.jacobian(Q)
SOLVER = tk.TaskPriority(
    ROBOT,
    [
        tk.PoseTask(),
        tk.BaseTask(),
        tk.PositionTask(of="wrist_1"),
        tk.OrientationTask(),
        tk.PostureTask(),
    ],
)
TARGETS = [T, Q[6:], T[:3, 3], T[:3, :3], Q]
WITHIN = tk.TaskPriority(
    ROBOT,
    [
        tk.BaseObstacleTask(0.5),
        tk.DistanceTask(0.1, 2.0),
        tk.FieldOfViewTask(0.5),
        tk.JointRangeTask(np.full(9, -2.0), np.full(9, 2.0)),
        tk.PoseTask(),
    ],
    limits=True,
    dt=0.01,
)
WITHIN_TARGETS = [Q[6:8], T[:3, 3], T[:3, 3], None, T]


@dataclass(frozen=True)
class Argument:
    """`call(value)` passes the value as the argument `name` and returns what came out of it."""

    label: str
    name: str
    good: Any
    call: Callable[[Any], Any] = field(repr=False)
    infinite: bool = False  # inf is a right answer, or a right value
    moderate: bool = False  # entries of any size: see test_huge_numbers.py

    @property
    def names(self) -> tuple[str, ...]:
        """What a message may begin with: where two arguments don't fit, either may be at fault."""
        pairs = {"lower": "upper", "upper": "lower", "J": "e"}
        pairs |= {"t": "wheel_angles", "t_reference": "poses", "poses": "t_reference"}
        pairs |= {"wheel_angles": "t", "wheel_speeds": "t"}
        pairs |= {"x": "P", "z": "H", "record": "H", "u": "B", "P": "truth"}
        return (self.name, pairs.get(self.name, self.name))


def with_target(i: int) -> Callable[[Any], Any]:
    def call(value: Any) -> Any:
        return SOLVER.step(Q, [value if k == i else target for k, target in enumerate(TARGETS)])

    return call


def within_target(i: int) -> Callable[[Any], Any]:
    def call(value: Any) -> Any:
        goals = [value if k == i else goal for k, goal in enumerate(WITHIN_TARGETS)]
        return WITHIN.step(Q, goals)

    return call


def ranged(name: str) -> Callable[[Any], Any]:
    bounds = {"lower": np.full(9, -np.inf), "upper": np.full(9, np.inf)}
    return lambda value: getattr(tk.JointRangeTask(**{**bounds, name: value}), name)


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
TASK_PRIORITY = [
    Argument("step", "q", Q, lambda v: SOLVER.step(v, TARGETS), moderate=True),
    Argument("solve", "q", Q, lambda v: SOLVER.solve(v, TARGETS).dq, moderate=True),
    Argument("step", "null_motion", Q, lambda v: SOLVER.step(Q, TARGETS, v)),
    *(
        Argument("step", f"targets[{i}]", good, with_target(i), moderate=True)
        for i, good in enumerate(TARGETS)
    ),
    Argument(
        "TaskPriority",
        "step_limit",
        np.full(9, 0.1),
        lambda v: tk.TaskPriority(ROBOT, [tk.PoseTask()], step_limit=v).step(Q, [T]),
        infinite=True,
    ),
]
LIMITS = [
    Argument("limited step", "q", Q, lambda v: WITHIN.step(v, WITHIN_TARGETS), moderate=True),
    Argument("limited solve", "q", Q, lambda v: WITHIN.solve(v, WITHIN_TARGETS).dq, moderate=True),
    Argument("limited step", "null_motion", Q, lambda v: WITHIN.step(Q, WITHIN_TARGETS, v)),
    Argument(
        "limited step",
        "previous",
        0.001 * Q,
        lambda v: WITHIN.step(Q, WITHIN_TARGETS, previous=v),
    ),
    *(
        Argument("limited step", f"targets[{i}]", good, within_target(i), moderate=True)
        for i, good in enumerate(WITHIN_TARGETS)
        if good is not None
    ),
    *(
        Argument("JointRangeTask", name, Q, ranged(name), infinite=True)
        for name in ("lower", "upper")
    ),
    Argument("FieldOfViewTask", "axis", XI[:3], lambda v: tk.FieldOfViewTask(0.3, v).axis),
]


def ik_with(name: str, **others: Any) -> Callable[[Any], Any]:
    return lambda value: tk.ik(ARM, **{"target": T, **others, name: value}).q


def ik_target(task: str) -> Callable[[Any], Any]:
    return lambda value: tk.ik(ARM, value, task=task).q


IK = [
    Argument("ik", "target", T, ik_target("pose")),
    Argument("ik position", "target", T[:3, 3], ik_target("position")),
    Argument("ik orientation", "target", T[:3, :3], ik_target("orientation")),
    Argument("ik", "seed", Q[:6], ik_with("seed"), moderate=True),
    Argument("ik", "weights", np.ones(6), ik_with("weights")),
    Argument("ik", "joint_weights", np.full(6, 2.0), ik_with("joint_weights")),
    Argument("ik", "max_step", np.full(6, 0.5), ik_with("max_step", seed=Q[:6]), infinite=True),
]
CLOSED_FORM = [
    Argument("ik_all", "target", T, lambda v: tk.ik_all(ARM, v).q, moderate=True),
    Argument("ik_all", "seed", Q[:6], lambda v: tk.ik_all(ARM, T, seed=v).q, moderate=True),
    Argument(
        "ik_all",
        "weights",
        np.ones(6),
        lambda v: tk.ik_all(ARM, T, seed=Q[:6], weights=v).q,
        moderate=True,
    ),
    Argument(
        "ik_all",
        "base",
        Q[6:],
        lambda v: tk.ik_all(ROBOT, T, base=v, respect_limits=False).q,
        moderate=True,
    ),
]
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
XYZW = np.array([0.5, -0.5, 0.5, 0.5])
PIN_THING = interop.to_pinocchio(ROBOT)
INTEROP = [
    Argument("from_pose", "T", T, interop.from_pose),
    Argument("quaternion", "T", T[:3, :3], lambda v: interop.quaternion(v, order="xyzw")),
    Argument("rotation", "quaternion", XYZW, lambda v: interop.rotation(v, order="xyzw")),
    Argument(
        "pose_from_quaternion",
        "p",
        XI[:3],
        lambda v: interop.pose_from_quaternion(v, XYZW, order="xyzw"),
    ),
    Argument("PinocchioModel", "q", Q, PIN_THING.q),
    Argument("PinocchioModel", "v", Q, PIN_THING.from_v),
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
TRAJECTORY = tk.Trajectory(
    ["a", "b"], [0.0, 0.5, 2.0], np.arange(6.0).reshape(3, 2), np.zeros((3, 2)), np.zeros((3, 2))
)


def move_with(name: str) -> Callable[[Any], Any]:
    known = {"q0": Q[:6], "q1": Q[:6] + 0.3}
    return lambda value: tk.move_to(ARM, **{**known, name: value}).positions


TIMING = [
    Argument("Trajectory.sample", "t", XI, lambda t: TRAJECTORY.sample(t)[0], moderate=True),
    Argument("move_to", "q0", Q[:6], move_with("q0"), moderate=True),
    Argument("move_to", "q1", Q[:6], move_with("q1"), moderate=True),
    *(
        Argument("move_to", name, np.full(6, 2.0), move_with(name), infinite=True)
        for name in ("velocity_limits", "acceleration_limits", "jerk_limits")
    ),
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
POSES = np.stack([ROBOT.fk(Q), ROBOT.fk(Q)])
BASE_PATH = np.stack([Q[6:], Q[6:]])


def path_with(name: str) -> Callable[[Any], Any]:
    known: dict[str, Any] = {"poses": POSES, "seed": Q, "base_path": BASE_PATH}
    return lambda value: tk.plan_path(ROBOT, **{**known, "max_iterations": 2, name: value}).q


def follower_with(name: str) -> Callable[[Any], Any]:
    def call(value: Any) -> Any:
        known: dict[str, Any] = {"seed": Q, "max_joint_step": 1.0, name: value}
        if name in ("pose", "base"):
            known.pop(name)
        follower = tk.PathFollower(ROBOT, base="xytheta", **known)
        pushed = {"pose": POSES[0], "base": Q[6:]}
        return follower.push(**(pushed | ({name: value} if name in pushed else {})))

    return call


PATH = [
    Argument("plan_path", "poses", POSES, path_with("poses"), moderate=True),
    Argument("Path seed", "seed", Q, path_with("seed"), moderate=True),
    Argument("plan_path", "base_path", BASE_PATH, path_with("base_path"), moderate=True),
    Argument("plan_path", "heading", np.array([-1.0, 1.0]), path_with("heading"), moderate=True),
    Argument("plan_path", "max_joint_step", np.ones(9), path_with("max_joint_step"), infinite=True),
    Argument("plan_path", "joint_weights", np.ones(9), path_with("joint_weights"), moderate=True),
    Argument("plan_path", "jacobian", np.ones(9), path_with("jacobian"), moderate=True),
    Argument("plan_path", "warm_start", np.stack([Q, Q]), path_with("warm_start"), moderate=True),
    Argument("PathFollower", "seed", Q, follower_with("seed"), moderate=True),
    Argument("PathFollower.push", "pose", POSES[0], follower_with("pose"), moderate=True),
    Argument("PathFollower.push", "base", Q[6:], follower_with("base"), moderate=True),
]
SCANNER = odometry.Scanner(-1.5, 1.5, 9, range_max=30.0)
RANGES = np.array([2.0, 2.1, 2.2, 2.1, 2.0, 1.9, 1.8, 1.9, 2.0])


def matched(name: str) -> Callable[[Any], Any]:
    known = {"guess": XI[3:], "guess_covariance": np.eye(3)}

    def call(value: Any) -> np.ndarray:
        match = odometry.match(SCANNER, RANGES, RANGES, **{**known, name: value})
        return np.append(match.pose, match.covariance)

    return call


def followed(name: str) -> Callable[[Any], Any]:
    def call(value: Any) -> np.ndarray:
        lidar = odometry.LaserOdometry(SCANNER)
        lidar.add(RANGES, t=0.0)
        step = lidar.add(RANGES, t=0.1, **{"motion": XI[3:], name: value})
        return np.append(step.pose, step.covariance)

    return call


LIDAR = [
    Argument("Scanner", "mount", XI[3:], lambda v: odometry.Scanner(0, 1, 9, mount=v).mount),
    Argument(
        "Scanner.points",
        "twist",
        XI[3:],
        lambda v: SCANNER.points(RANGES, twist=v)[0],
        moderate=True,
    ),
    Argument("match", "guess", XI[3:], matched("guess"), moderate=True),
    Argument("match", "guess_covariance", np.eye(3), matched("guess_covariance"), moderate=True),
    Argument("LaserOdometry", "motion", XI[3:], followed("motion"), moderate=True),
    Argument("LaserOdometry", "twists", XI.reshape(2, 3), followed("twists"), moderate=True),
    Argument(
        "LaserOdometry",
        "motion_covariance",
        np.eye(3),
        followed("motion_covariance"),
        moderate=True,
    ),
]
# thing_kin.search and thing_kin.rmma.
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

# thing_kin.estimation, one list for each family of concepts.
ARM_POSTURES = ARM.random(8, rng=0)
ARM_POSES = ARM.fk(ARM_POSTURES)


@functools.cache
def calibrated_arm() -> est.Calibration:
    return est.calibrate(ARM, ARM_POSTURES, ARM_POSES, sag=(1,))


# Two, so that they are not of a rotation's shape.
REFLECTORS = np.array([[0.05, 0.0, 0.1], [-0.03, 0.06, 0.12]])
SEEN_REFLECTORS = np.stack([(ARM_POSES @ [*p, 1.0])[:, :3] for p in REFLECTORS], axis=1)
ROBOT_POSTURES = ROBOT.random(8, rng=0)
ROBOT_POSES = ROBOT.fk(ROBOT_POSTURES)


def calibrated(name: str, **others: Any) -> Callable[[Any], Any]:
    known = {"chain": ARM, "q": ARM_POSTURES, "measured": ARM_POSES, "loss": "linear", **others}

    def call(value: Any) -> np.ndarray:
        found = est.calibrate(**{**known, name: value})
        return np.concatenate([found.values, np.diag(found.covariance)])

    return call


CALIBRATION = [
    Argument("calibrate", "q", ARM_POSTURES, calibrated("q"), moderate=True),
    Argument("calibrate", "measured", ARM_POSES, calibrated("measured"), moderate=True),
    Argument("calibrate", "covariance", 0.1 * np.eye(6), calibrated("covariance"), moderate=True),
    Argument(
        "calibrate", "q_covariance", 0.1 * np.eye(6), calibrated("q_covariance"), moderate=True
    ),
    Argument("readings", "q", ARM_POSTURES, lambda v: calibrated_arm().readings(v), moderate=True),
    Argument("predict", "q", ARM_POSTURES, lambda v: calibrated_arm().predict(v), moderate=True),
    Argument("calibrate", "base", T, calibrated("base"), moderate=True),
    Argument("calibrate", "tool", T, calibrated("tool"), moderate=True),
    Argument(
        "calibrate",
        "points",
        REFLECTORS,
        calibrated("points", measured=SEEN_REFLECTORS),
        moderate=True,
    ),
    Argument(
        "calibrate base_covariance",
        "base_covariance",
        1e-4 * np.eye(3),
        calibrated("base_covariance", chain=ROBOT, q=ROBOT_POSTURES, measured=ROBOT_POSES),
        moderate=True,
    ),
    Argument(
        "calibrate sag",
        "gravity",
        np.array([0.0, 0.0, -9.81]),
        calibrated("gravity", sag=(1, 2)),
        moderate=True,
    ),
]
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


TWISTS = np.stack([XI[:3], -XI[:3], XI[3:], XI[:3], XI[3:]])
STAMPS = np.array([0.0, 0.1, 0.3, 0.4, 0.6])
P3 = np.diag([0.1, 0.2, 0.3])
MECANUM = est.MecanumOdometry(0.07, 0.4)
DRIVE = est.DifferentialDriveOdometry(0.1, 0.4)
WHEELS = MECANUM.wheel_speeds(TWISTS)
RECORD_T = np.linspace(0.0, 8.0, 81)
RECORD_ANGLES = np.cumsum(
    0.1 * MECANUM.wheel_speeds(np.stack([np.cos(RECORD_T), np.sin(RECORD_T), RECORD_T / 8], 1)),
    axis=0,
)
RECORD_POSES = MECANUM.integrate_angles(RECORD_T, RECORD_ANGLES).poses


def reckoned(method: Callable[..., Any], name: str, **others: Any) -> Callable[[Any], Any]:
    return lambda value: method(**{**others, name: value}).covariances


def identified(name: str, identify: Any = est.identify_mecanum) -> Callable[[Any], Any]:
    known = {
        "t": RECORD_T,
        "wheel_angles": RECORD_ANGLES,
        "t_reference": RECORD_T,
        "poses": RECORD_POSES,
    }
    return lambda value: identify(**{**known, name: value}).covariance


def hand_with(name: str) -> Callable[[Any], Any]:
    known = {"robot": ROBOT, "q_arm": Q[:6], "estimate": (Q[6:], P3)}
    return lambda value: est.end_effector(**{**known, name: value}).task_covariance


RECKONING = {"pose": Q[6:], "covariance": P3, "twist_covariance": P3}
ODOMETRY = [
    Argument("integrate_twist", "pose", Q[6:], lambda v: est.integrate_twist(v, Q[6:], 0.1)),
    Argument("integrate_twist", "twist", Q[6:], lambda v: est.integrate_twist(Q[6:], v, 0.1)),
    Argument("jacobians", "pose", Q[6:], lambda v: est.integrate_twist_jacobians(v, Q[6:], 0.1)[0]),
    Argument(
        "jacobians", "twist", Q[6:], lambda v: est.integrate_twist_jacobians(Q[6:], v, 0.1)[0]
    ),
    Argument("pose_difference", "a", Q[6:], lambda v: est.pose_difference(v, Q[6:])),
    Argument("pose_difference", "b", Q[6:], lambda v: est.pose_difference(Q[6:], v)),
    Argument("angles_from_ticks", "ticks", WHEELS, lambda v: est.angles_from_ticks(v, 360)),
    Argument("MecanumOdometry.twist", "wheel_speeds", WHEELS[0], MECANUM.twist),
    Argument("MecanumOdometry.wheel_speeds", "twist", XI[:3], MECANUM.wheel_speeds),
    Argument("MecanumOdometry.slip", "wheel_speeds", WHEELS[0], MECANUM.slip),
    Argument("DifferentialDriveOdometry.twist", "wheel_speeds", XI[:2], DRIVE.twist),
    Argument(
        "DifferentialDriveOdometry.wheel_speeds",
        "twist",
        np.array([0.3, 0.0, 0.2]),
        DRIVE.wheel_speeds,
    ),
    Argument(
        "DifferentialDriveOdometry",
        "wheel_radius",
        np.array([0.1, 0.2]),
        lambda v: np.array(est.DifferentialDriveOdometry(v, 0.4).wheel_radius),
    ),
    *(
        Argument(label, name, good, reckoned(method, name, **{**RECKONING, **record}))
        for label, method, record in (
            ("dead_reckon", est.dead_reckon, {"twists": TWISTS, "dt": 0.1}),
            ("integrate", MECANUM.integrate, {"t": STAMPS, "wheel_speeds": WHEELS}),
            ("integrate_angles", MECANUM.integrate_angles, {"t": STAMPS, "wheel_angles": WHEELS}),
            ("drive integrate", DRIVE.integrate, {"t": STAMPS, "wheel_speeds": WHEELS[:, :2]}),
            (
                "drive integrate_angles",
                DRIVE.integrate_angles,
                {"t": STAMPS, "wheel_angles": WHEELS[:, :2]},
            ),
        )
        for name, good in {**RECKONING, **record}.items()
        if name != "dt"
    ),
    Argument(
        "integrate",
        "slip_variance",
        XI[:3],
        reckoned(MECANUM.integrate, "slip_variance", t=STAMPS, wheel_speeds=WHEELS),
    ),
    *(
        Argument("identify_mecanum", name, good, identified(name))
        for name, good in {
            "t": RECORD_T,
            "wheel_angles": RECORD_ANGLES,
            "t_reference": RECORD_T,
            "poses": RECORD_POSES,
            "mount": XI[3:],
            "mount_std": XI[3:],
        }.items()
    ),
    *(
        Argument("calibrate_mecanum", name, good, identified(name, est.calibrate_mecanum))
        for name, good in {
            "t": RECORD_T,
            "wheel_angles": RECORD_ANGLES,
            "t_reference": RECORD_T,
            "poses": RECORD_POSES,
            "mount": XI[3:],
            "mount_std": XI[3:],
        }.items()
    ),
    *(
        Argument("end_effector", name, good, hand_with(name))
        for name, good in {
            "q_arm": Q[:6],
            "estimate": Q[6:],
            "joint_std": np.full(6, 0.1),
            "joint_covariance": np.eye(6),
            "mount_covariance": np.eye(6),
        }.items()
    ),
]
ARGUMENTS = [
    *LIDAR,
    *SEARCH,
    *CALIBRATION,
    *FILTERS,
    *ODOMETRY,
    *LOCALIZER,
    *POSE_PLAN,
    *TIMING,
    *PROBLEM,
    *INTEROP,
    *CHAIN,
    *MOTION,
    *LIE,
    *LINALG,
    *MODEL,
    *TASK_PRIORITY,
    *LIMITS,
    *CLOSED_FORM,
    *IK,
    *PATH,
    *OBSTACLES,
    *TERMS,
]

# None means "not given" to these.
OPTIONAL = {
    "damping",
    "mount",
    "rpy",
    "null_motion",
    "previous",
    "axis",
    "lower",
    "upper",
    "step_limit",
} | {
    "velocity_limits",
    "acceleration_limits",
    "quaternion",
    "point",
    "seed",
    "weights",
    "joint_weights",
    "max_step",
    "center",
    "pose",
    "jerk_limits",
    "base_path",
    "heading",
    "max_joint_step",
    "warm_start",
    "covariance",
    "twist_covariance",
    "slip_variance",
    "joint_covariance",
    "mount_covariance",
    "guess_covariance",
    "motion",
    "motion_covariance",
    "reach_center",
    "within",
    "q_covariance",
}

# The same, of these labels alone.
OPTIONAL_OF = {
    ("calibrate", "base"),
    ("calibrate", "tool"),
    ("calibrate", "points"),
    ("calibrate base_covariance", "base_covariance"),
}

# Labels where such a name is not optional.
REQUIRED = (
    "Scanner",
    "Path",
    "rotation",
    "JointRange",
    "Disc",
    "Sphere",
    "HalfSpace",
    "terms.Cone",
    "terms.BaseDistance",
    "terms.SeedDistance of",
    "identify_mecanum",
    "calibrate_mecanum",
    "integrate",
    "jacobians",
    "dead_reckon",
    "drive integrate",
    "se2_",
    "at_most",
    "at_least",
    "between",
    "BaseLocalizer",
    "spiral",
    "stochastic",
    "covering of",
)
