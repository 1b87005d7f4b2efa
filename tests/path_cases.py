"""Random paths that a witness can follow, and a check of plans that knows Pinocchio and numpy only.

For tests and benchmarks. A case is made from a smooth motion of the joints: its poses are the
path's, its base is within base_radius of the base path, it keeps clear of every obstacle and well
below max_joint_step. So the case has a solution; the planner does not know it.
"""

import itertools
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

import thing_kin as tk
from thing_kin import interop

Vector = NDArray[np.float64]
Obstacle = tk.Disc | tk.Sphere | tk.Capsule | tk.Box | tk.HalfSpace

CLEAR = 0.01  # m, what the witness keeps from obstacles at least
REST = {
    "thing": [0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0],
    "pioneer_lx_ur5": [0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0],
    "panda_on_base": [0.0, -0.5, 0.0, -2.0, 0.0, 1.6, 0.8, 0.0, 0.0, 0.0],
    "panda": [0.0, -0.5, 0.0, -2.0, 0.0, 1.6, 0.8],
    "ur10": [0.0, -1.2, 1.4, -0.6, 1.2, 0.0],
}


@dataclass(frozen=True)
class Case:
    """What plan_path is asked, and a motion that does it."""

    robot: tk.Chain
    poses: Vector
    seed: Vector
    options: dict[str, Any]
    witness: Vector = field(repr=False)

    def plan(self, **changes: Any) -> tk.PathPlan:
        return tk.plan_path(self.robot, self.poses, seed=self.seed, **{**self.options, **changes})


def smooth_motion(rng: np.random.Generator, n: int, count: int, amplitude: Vector) -> Vector:
    """(count, n): a few random waves a joint that begin at zero."""
    s = np.linspace(0.0, 1.0, count)[:, None]
    motion = np.zeros((count, n))
    for wave in range(1, 4):
        size = rng.normal(size=n) * amplitude / wave**2
        phase = rng.uniform(0.0, 2 * np.pi, n)
        motion += size * (np.sin(np.pi * wave * s + phase) - np.sin(phase))
    return motion


def make_case(robot: tk.Chain, seed: int, *, count: int = 50, obstacles: int = 3) -> Case:
    """A random case: base path, heading windows, discs, and shapes in the arm's way."""
    rng = np.random.default_rng(seed)
    rest = np.array(REST[robot.name])
    start = rest + rng.normal(size=robot.n) * 0.1
    base = list(robot.base_joints) if robot.base_joints else []
    amplitude = np.full(robot.n, 0.35)
    if base:
        amplitude[base] = 0.6, 0.6, 0.3
    witness = start + smooth_motion(rng, robot.n, count, amplitude)
    if base:
        along = np.linspace(0.0, 1.0, count)[:, None] * rng.uniform(0.5, 3.0)
        angle = rng.uniform(-np.pi, np.pi)
        witness[:, base[:2]] += along * [np.cos(angle), np.sin(angle)]
    lower, upper = robot.lower, robot.upper
    witness = np.clip(witness, np.maximum(lower, -1e3) + 0.02, np.minimum(upper, 1e3) - 0.02)
    steps = np.abs(np.diff(witness, axis=0)).max(axis=0) if count > 1 else np.ones(robot.n)
    options: dict[str, Any] = {"max_joint_step": 1.5 * steps.max() + 0.01}
    shapes: list[Obstacle] = []
    if base:
        radius = rng.uniform(0.1, 0.5)
        drift = smooth_motion(rng, 2, count, np.full(2, radius)) + rng.normal(size=2) * radius
        away = np.hypot(*drift.T).max()
        drift *= min(1.0, 0.8 * radius / max(away, 1e-9))
        path = witness[:, base] + np.column_stack([drift, np.zeros(count)])
        options |= {"base_path": path, "base_radius": radius}
        if rng.random() < 0.5:
            options["heading"] = rng.uniform(0.05, 0.5)
        shapes += discs(rng, witness[:, base[:2]], path[:, :2], obstacles)
    spheres = tk.LinkSpheres.along_links(robot, 0.06, 0.12)
    solid = solids(rng, robot, spheres, witness, obstacles)
    if solid:
        shapes += solid
    if solid or rng.random() < 0.5:
        options["spheres"] = witnessed(robot, spheres, witness)
    options["obstacles"] = shapes
    return Case(robot, robot.fk(witness), witness[0].copy(), options, witness)


def discs(rng: np.random.Generator, base: Vector, path: Vector, most: int) -> list[tk.Disc]:
    """Discs beside the witness's base, some of them on the base path."""
    found = []
    for _ in range(int(rng.integers(0, most + 1))):
        k = int(rng.integers(0, len(base)))
        center = path[k] + rng.normal(size=2) * 0.3
        room = np.hypot(*(dense(base) - center).T).min() - CLEAR
        if room > 0.02:
            found.append(tk.Disc(center=center, radius=float(min(room, rng.uniform(0.05, 0.6)))))
    return found


def solids(
    rng: np.random.Generator,
    robot: tk.Chain,
    spheres: tk.LinkSpheres,
    witness: Vector,
    most: int,
) -> list[tk.Sphere | tk.Capsule | tk.Box | tk.HalfSpace]:
    """Shapes near the arm that the witness keeps clear of."""
    where = centers(robot, spheres, dense(witness))  # (M, S, 3)
    radii = np.array([radius for _, _, radius in spheres.spheres])
    found: list[tk.Sphere | tk.Capsule | tk.Box | tk.HalfSpace] = []
    for _ in range(int(rng.integers(0, most + 1))):
        place = where[rng.integers(len(where)), rng.integers(len(radii))]
        place = place + rng.normal(size=3) * 0.4
        size = float(rng.uniform(0.03, 0.25))
        shape = random_shape(rng, place, size)
        if (distances(shape, where) - radii).min() > CLEAR:
            found.append(shape)
    return found


def random_shape(
    rng: np.random.Generator, place: Vector, size: float
) -> tk.Sphere | tk.Capsule | tk.Box | tk.HalfSpace:
    kind = rng.integers(4)
    if kind == 0:
        return tk.Sphere(center=place, radius=size)
    if kind == 1:
        return tk.Capsule(place, place + rng.normal(size=3) * 0.3, radius=0.5 * size)
    if kind == 2:
        pose = tk.transform(xyz=place, rpy=rng.uniform(-1.0, 1.0, 3))
        return tk.Box(pose=pose, size=np.full(3, 1.5 * size))
    return tk.HalfSpace(normal=(0.0, 0.0, 1.0), offset=float(place[2] - 0.5))


def witnessed(robot: tk.Chain, spheres: tk.LinkSpheres, witness: Vector) -> tk.LinkSpheres:
    """The spheres with those pairs that the witness keeps apart."""
    where = centers(robot, spheres, dense(witness))
    radii = np.array([radius for _, _, radius in spheres.spheres])
    pairs = []
    for a, b in spheres.pairs:
        gap = np.linalg.norm(where[:, a] - where[:, b], axis=-1) - radii[a] - radii[b]
        if gap.min() > CLEAR:
            pairs.append((a, b))
    return tk.LinkSpheres(robot, spheres.spheres, pairs=pairs)


def dense(q: Vector, between: int = 12) -> Vector:
    """Points on the straight lines between rows, ends included."""
    if len(q) == 1:
        return q
    t = np.linspace(0.0, 1.0, between, endpoint=False)[:, None]
    parts = [a + t * (b - a) for a, b in itertools.pairwise(q)]
    return np.vstack([*parts, q[-1:]])


def centers(robot: tk.Chain, spheres: tk.LinkSpheres, q: Vector) -> Vector:
    """(M, S, 3), m, by Pinocchio."""
    model = interop.to_pinocchio(robot)
    data = model.model.createData()
    frames = [model.frame_id(frame) for frame, _, _ in spheres.spheres]
    points = [np.array(center) for _, center, _ in spheres.spheres]
    rows = []
    for row in q:
        pin.framesForwardKinematics(model.model, data, model.q(row))
        rows.append([data.oMf[f].act(p) for f, p in zip(frames, points, strict=True)])
    return np.array(rows)


def distances(shape: Obstacle, points: Vector) -> Vector:
    """From points (..., 3) to a surface, negative inside; plain numpy."""
    if isinstance(shape, tk.Sphere):
        return np.linalg.norm(points - shape.center, axis=-1) - shape.radius
    if isinstance(shape, tk.Capsule):
        along = np.asarray(shape.end) - shape.start
        t = np.clip((points - shape.start) @ along / (along @ along), 0.0, 1.0)
        return np.linalg.norm(points - shape.start - t[..., None] * along, axis=-1) - shape.radius
    if isinstance(shape, tk.Box):
        pose = np.asarray(shape.pose)
        local = np.abs((points - pose[:3, 3]) @ pose[:3, :3]) - np.asarray(shape.size) / 2
        outside = np.linalg.norm(np.maximum(local, 0.0), axis=-1)
        return outside + np.minimum(local.max(axis=-1), 0.0)
    if isinstance(shape, tk.HalfSpace):
        return points @ np.asarray(shape.normal) - shape.offset
    return np.hypot(*(np.moveaxis(points, -1, 0)[:2] - np.asarray(shape.center)[:, None])) - (
        shape.radius
    )


def worst(case: Case, q: Vector, between: int = 25) -> dict[str, float]:
    """The largest violation of each kind, m or rad, by Pinocchio and brute force."""
    robot, options = case.robot, case.options
    model = interop.to_pinocchio(robot)
    data = model.model.createData()
    hand = model.frame_id()
    found = {"position": 0.0, "rotation": 0.0}
    for row, pose in zip(q, case.poses, strict=True):
        pin.framesForwardKinematics(model.model, data, model.q(row))
        found["position"] = max(
            found["position"], float(np.linalg.norm(data.oMf[hand].translation - pose[:3, 3]))
        )
        turn = pin.log3(data.oMf[hand].rotation.T @ pose[:3, :3])
        found["rotation"] = max(found["rotation"], float(np.linalg.norm(turn)))
    found["limits"] = float(max((robot.lower - q).max(), (q - robot.upper).max(), 0.0))
    if len(q) > 1:
        beyond = np.abs(np.diff(q, axis=0)) - options.get("max_joint_step", np.inf)
        found["step"] = float(max(beyond.max(), 0.0))
    path = dense(q, between)
    if "base_path" in options:
        base = q[:, list(robot.base_joints or ())]
        away = np.hypot(*(base[:, :2] - options["base_path"][:, :2]).T)
        found["base"] = float(max(away.max() - options.get("base_radius", np.inf), 0.0))
        if "heading" in options:
            turned = np.abs(base[:, 2] - options["base_path"][:, 2]) - options["heading"]
            found["heading"] = float(max(turned.max(), 0.0))
    spheres = options.get("spheres")
    where = centers(robot, spheres, path) if spheres else np.zeros((1, 0, 3))
    radii = np.array([radius for _, _, radius in spheres.spheres]) if spheres else np.zeros(0)
    near = np.inf
    for shape in options.get("obstacles", []):
        if isinstance(shape, tk.Disc):
            base = path[:, list(robot.base_joints or ())[:2]]
            near = min(near, float(distances(shape, base).min()))
        else:
            near = min(near, float((distances(shape, where) - radii).min()))
    for a, b in spheres.pairs if spheres else ():
        gap = np.linalg.norm(where[:, a] - where[:, b], axis=-1) - radii[a] - radii[b]
        near = min(near, float(gap.min()))
    return {**found, "clearance": -near if np.isfinite(near) else 0.0}
