"""What the soak of inverse kinematics draws: chains, options, seeds and targets of every kind."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import thing_kin as tk
from ik_cases import ROBOTS
from strategies import rotation_matrix

Array = NDArray[np.float64]
Generator = np.random.Generator

TASKS = ("pose", "position", "orientation")
OBJECTIVES = ("none", "none", "seed", "limits", "manipulability")


@dataclass(frozen=True)
class SoakCase:
    """One solver and what it is asked for."""

    robot: tk.Chain
    frame: str
    options: dict[str, Any]
    seeds: Array | None
    targets: Array


def random_case(rng: Generator, targets: int) -> SoakCase:
    robot = random_chain(rng)
    if rng.random() < 0.3:
        robot = ROBOTS[str(rng.choice(list(ROBOTS)))]()
        robot = with_random_limits(rng, robot) if rng.random() < 0.3 else robot
    frames = robot.frames
    frame = frames[-1] if rng.random() < 0.7 else str(rng.choice(frames))
    options = random_options(rng, robot.n)
    needs_seed = "max_step" in options or options["nearest"] or options.get("objective") == "seed"
    seeds = None
    if needs_seed or rng.random() < 0.7:
        seeds = random_seeds(rng, robot, targets)
    poses = random_targets(rng, robot, frame, seeds, targets)
    part = {"pose": np.s_[:], "position": np.s_[:, :3, 3], "orientation": np.s_[:, :3, :3]}
    asked = poses[part[options["task"]]]
    return SoakCase(robot, frame, options, seeds, np.ascontiguousarray(asked))


def random_chain(rng: Generator) -> tk.Chain:
    """Up to twelve rows; lengths of none to a hundred meters, right angles often."""
    scale = rng.choice([0.0, 1e-17, 1e-3, 0.3, 0.3, 0.3, 1.0, 100.0])
    rows = [random_row(rng, scale) for _ in range(rng.integers(1, 13))]
    if all(row.joint == "fixed" for row in rows):
        rows.append(tk.DH(a=scale, joint="revolute"))
    return tk.Chain.from_dh(rows)


def random_row(rng: Generator, scale: float) -> tk.DH:
    joint = str(rng.choice(["revolute"] * 5 + ["continuous", "prismatic", "prismatic", "fixed"]))
    d, a = scale * rng.uniform(-1, 1, 2) * rng.integers(0, 2, 2)
    right = np.pi / 2 * rng.integers(-2, 3, 2)
    theta, alpha = np.where(rng.random(2) < 0.7, right, rng.uniform(-np.pi, np.pi, 2))
    if joint not in ("revolute", "prismatic"):
        return tk.DH(d, theta, a, alpha, joint)
    lower, upper = random_limits(rng)
    return tk.DH(d, theta, a, alpha, joint, lower=lower, upper=upper)


def random_limits(rng: Generator) -> tuple[float, float]:
    middle, half = rng.uniform(-2, 2), 10 ** rng.uniform(-3, 1)
    match rng.integers(0, 9):
        case 0:
            return -np.inf, np.inf
        case 1:
            return middle, np.inf
        case 2:
            return -np.inf, middle
        case 3:
            return middle, middle
        case 4:
            return -2 * np.pi, 2 * np.pi
        case 5:
            wide = float(rng.choice([1e3, 1e6, 1e16, 1e300, 1.7e308]))
            return -wide, wide * rng.choice([1.0, 1e-3])
        case _:
            return middle - half, middle + half


def with_random_limits(rng: Generator, robot: tk.Chain) -> tk.Chain:
    lower, upper = robot.lower.copy(), robot.upper.copy()
    for j, joint in enumerate(robot.joint_types):
        if joint != "continuous" and rng.random() < 0.5:
            lower[j], upper[j] = random_limits(rng)
    return robot.with_limits(lower=lower, upper=upper)


def random_options(rng: Generator, n: int) -> dict[str, Any]:
    options: dict[str, Any] = {
        "task": str(rng.choice(TASKS, p=[0.6, 0.2, 0.2])),
        "weight_axes": str(rng.choice(["target", "world"])),
        "nearest": bool(rng.random() < 0.1),
        "max_iterations": int(10 ** rng.uniform(0, 2.5)),
        "max_restarts": int(rng.choice([0, 1, 5, 100, 2**31 - 1])),
        "rng": int(rng.integers(0, 2**63)),
        "closed_form": bool(rng.random() < 0.8),
    }
    for name in ("position_tolerance", "rotation_tolerance"):
        if rng.random() < 0.5:
            options[name] = 10 ** rng.uniform(-12, 0)
    if rng.random() < 0.3:
        options["weights"] = random_weights(rng, options["task"])
    if rng.random() < 0.3:
        options["joint_weights"] = 10 ** (rng.uniform(-1, 1, n) * rng.choice([0, 1, 6]))
    if rng.random() < 0.25:
        options["max_step"] = 10 ** rng.uniform(-6, 1, n)
        options["max_step"][rng.random(n) < 0.1] = np.inf
    if rng.random() < 0.25:
        options["objective"] = str(rng.choice(OBJECTIVES))
    if rng.random() < 0.03:
        options["deadline"] = 10 ** rng.uniform(-9, -3)
    return options


def random_weights(rng: Generator, task: str) -> Array:
    weights = 10 ** (rng.uniform(-1, 1, 6) * rng.choice([0, 1, 6]))
    weights[rng.random(6) < 0.3] = 0.0
    counted = {"pose": slice(0, 6), "position": slice(0, 3), "orientation": slice(3, 6)}[task]
    if not weights[counted].any():
        weights[counted.start] = 1.0
    return weights


def configurations(rng: Generator, robot: tk.Chain, count: int) -> Array:
    """Within the limits; where there are none, or wide ones, within half a turn or half a meter."""
    lower, upper = np.maximum(robot.lower, -np.pi), np.minimum(robot.upper, np.pi)
    lower, upper = np.minimum(lower, robot.upper), np.maximum(upper, robot.lower)
    q = lower + rng.random((count, robot.n)) * (upper - lower)
    side = rng.random(q.shape)
    q = np.where(side < 0.03, lower, np.where(side > 0.97, upper, q))
    return np.clip(q, robot.lower, robot.upper)


def random_seeds(rng: Generator, robot: tk.Chain, count: int) -> Array:
    q = configurations(rng, robot, count)
    match rng.integers(0, 8):
        case 0:
            q = q + rng.normal(size=q.shape) * 10 ** rng.uniform(-12, 3)
        case 1:
            q[::3] *= 10 ** rng.uniform(3, 40)
        case 2:
            q[:] = np.where(rng.random(q.shape) < 0.5, robot.lower, robot.upper)
            q[~np.isfinite(q) | (np.abs(q) > 1e40)] = 0.0
    return np.clip(q, -1e49, 1e49)


def random_targets(
    rng: Generator, robot: tk.Chain, frame: str, seeds: Array | None, count: int
) -> Array:
    """Most within reach; the others far, turned by exactly a half, at the seed, of few digits."""
    T = robot.fk(configurations(rng, robot, count), frame)
    kind = rng.integers(0, 12, count)
    size = np.linalg.norm(T[:, :3, 3], axis=1)
    T[kind == 0, :3, 3] += rng.normal(size=(count, 3))[kind == 0]
    far = kind == 1
    T[far, :3, 3] = rng.normal(size=(count, 3))[far] * 10 ** rng.uniform(-3, 9, (count, 1))[far]
    for i in np.flatnonzero(kind == 2):
        axis = rng.normal(size=3)
        T[i, :3, :3] = T[i, :3, :3] @ rotation_matrix(axis * np.pi / np.linalg.norm(axis))
    for i in np.flatnonzero(kind == 3):
        T[i, :3, :3] = T[i, :3, :3] @ np.diag(rng.permutation([1.0, -1.0, -1.0]))
    if seeds is not None:
        near = kind == 4
        T[near] = robot.fk(np.clip(seeds, robot.lower, robot.upper), frame)[near]
    T[kind == 5, :3, :3] = np.round(T[kind == 5, :3, :3], 7)
    T[kind == 6] = np.eye(4)
    T[kind == 7, :3, 3] *= 1.0 + rng.uniform(-1e-6, 1e-6)
    T[(kind == 8) & (size > 0), :3, 3] *= 1e9
    return np.clip(T, -1e49, 1e49)
