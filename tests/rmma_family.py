"""Worlds that the search planners were not made for: drawn at random, by one seed each.

The family was written and frozen before any method was run in it. It shares nothing with the
library's own World but the interface: other laws of drift, other shapes of detection, other arms,
other localization, other arrangements, other errors of the map.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thing_kin import rmma

FloatArray = NDArray[np.float64]

DRIFTS = ("wander", "sine", "slips", "creep", "bends", "ramp")
SHAPES = ("disc", "square", "ellipse", "soft disc")
ARMS = ("linear", "trapezoid", "jittery", "slow")
LOCALIZERS = ("wandering", "jumping", "biased", "good")
STEP = 0.02  # s between the drive's nodes, at most


@dataclass(frozen=True)
class Family:
    """One world of the family; `start` begins a drive."""

    seed: int
    drift: str
    shape: str
    arm: str
    localizer: str
    drift_size: float
    detection_radius: float
    lapse: float
    localizer_size: float
    arm_error: float
    arm_persists: bool
    map_error: float
    map_shift: bool

    def start(self, velocity: float, side: FloatArray, rng: np.random.Generator) -> FamilyRun:
        return FamilyRun(self, velocity, np.asarray(side), rng)


def draw(seed: int) -> tuple[Family, rmma.Arrangement]:
    """Return a world of the family and an arrangement to search in it."""
    rng = np.random.default_rng([seed, 2026])
    world = Family(
        seed=seed,
        drift=str(rng.choice(DRIFTS)),
        shape=str(rng.choice(SHAPES)),
        arm=str(rng.choice(ARMS)),
        localizer=str(rng.choice(LOCALIZERS)),
        drift_size=float(rng.uniform(0.5, 2.0)),
        detection_radius=float(rng.uniform(0.005, 0.015)),
        lapse=float(rng.choice([0.0, 0.0, 0.1])),
        localizer_size=float(rng.uniform(0.3, 2.0)),
        arm_error=float(rng.uniform(0.0, 0.005)),
        arm_persists=bool(rng.random() < 0.5),
        map_error=float(rng.choice([0.0, 0.0, 0.003, 0.008])),
        map_shift=bool(rng.random() < 0.5),
    )
    return world, _arrangement(rng, seed)


def _arrangement(rng: np.random.Generator, seed: int) -> rmma.Arrangement:
    sides = []
    for i in range(int(rng.integers(1, 4))):
        count = int(rng.integers(3, 9))
        x = np.cumsum(np.r_[rng.uniform(0, 1), rng.uniform(0.12, 0.6, count - 1)])
        y = 0.6 + rng.uniform(-0.12, 0.12, count)
        sides.append(np.column_stack([x, y]) * (-1.0 if i % 2 else 1.0))
    return rmma.Arrangement(sides, name=f"family {seed}")


class FamilyRun:
    """One drive."""

    def __init__(
        self, world: Family, velocity: float, side: FloatArray, rng: np.random.Generator
    ) -> None:
        self.world, self.velocity, self.rng = world, velocity, rng
        self.listed = side
        shift = rng.normal(0, world.map_error, 2)
        own = rng.normal(0, world.map_error, side.shape)
        self.true = side + (shift if world.map_shift else own)
        self.start_at = np.r_[side[0] - (0.20, 0.60), rng.normal(0, np.radians(0.5))]
        length = float(side[-1, 0] - side[0, 0]) + 1.5
        self.step = min(STEP, 0.005 / velocity)
        self.nodes = self._drive(int(length / velocity / self.step) + 2)
        self.jumps = self._localizer(len(self.nodes))
        self.arm_offset = np.zeros(2)

    # The base.

    def _drive(self, count: int) -> FloatArray:
        world, rng, size = self.world, self.rng, self.world.drift_size
        t = self.step * np.arange(count)
        way = self.velocity * t
        speed = np.full(count, 1 + rng.normal(0, 0.015 * size))
        turn = np.zeros(count)  # rad/m
        side_speed = 0.0
        if world.drift == "wander":
            knots = np.arange(0, way[-1] + 0.2, 0.1)
            speed += np.interp(way, knots, rng.normal(0, 0.03 * size, len(knots)))
            turn += np.interp(way, knots, rng.normal(0, np.radians(1.5) * size, len(knots)))
        elif world.drift == "sine":
            phase, length = rng.uniform(0, 2 * np.pi), rng.uniform(0.3, 1.5)
            turn += np.radians(1.5) * size * np.sin(2 * np.pi * way / length + phase)
            speed += 0.03 * size * np.cos(2 * np.pi * way / length + phase)
        elif world.drift == "slips":
            for _ in range(rng.poisson(1.5 * way[-1])):
                at = rng.uniform(0, way[-1])
                held = (way > at) & (way < at + 0.03)
                speed[held] *= rng.uniform(0.3, 0.9)
                turn[held] += np.radians(rng.normal(0, 8.0)) * size
        elif world.drift == "creep":
            side_speed = rng.normal(0, 0.0003) * size
        elif world.drift == "bends":
            cuts = np.sort(rng.uniform(0, way[-1], 3))
            levels = np.radians(rng.normal(0, 1.0, 4)) * size
            turn += levels[np.searchsorted(cuts, way)]
        else:
            speed *= 1 - np.exp(-t / rng.uniform(0.2, 0.8))
            turn += np.radians(rng.normal(0.0, 0.7)) * size
        theta = self.start_at[2] + np.cumsum(turn * speed) * self.velocity * self.step
        dx = speed * np.cos(theta) * self.velocity * self.step
        dy = (speed * np.sin(theta) * self.velocity + side_speed) * self.step
        poses = np.column_stack([np.cumsum(dx) - dx[0], np.cumsum(dy) - dy[0], theta])
        poses[:, :2] += self.start_at[:2]
        return poses

    def pose(self, t: float) -> tuple[float, float, float]:
        x = min(t / self.step, len(self.nodes) - 2.0)
        i = int(x)
        pose = self.nodes[i] + (x - i) * (self.nodes[i + 1] - self.nodes[i])
        return float(pose[0]), float(pose[1]), float(pose[2])

    # Its localization.

    def _localizer(self, count: int) -> FloatArray:
        rng, size = self.rng, self.world.localizer_size
        error = np.zeros((count, 3))
        way = self.velocity * self.step * np.arange(count)
        if self.world.localizer == "wandering":
            knots = np.arange(0, way[-1] + 0.3, 0.15)
            for k, sigma in enumerate((0.008, 0.008, np.radians(0.3))):
                error[:, k] = np.interp(way, knots, rng.normal(0, sigma * size, len(knots)))
        elif self.world.localizer == "jumping":
            cuts = np.sort(rng.uniform(0, way[-1], int(3 * way[-1]) + 1))
            levels = rng.normal(0, (0.008, 0.008, np.radians(0.3)), (len(cuts) + 1, 3)) * size
            error = levels[np.searchsorted(cuts, way)]
        elif self.world.localizer == "biased":
            error[:] = rng.normal(0, (0.012, 0.012, np.radians(0.4)), 3) * size
        else:
            error[:] = rng.normal(0, (0.002, 0.002, np.radians(0.1)), 3) * size
        return error

    def odometry(self, t: float) -> tuple[float, float, float]:
        i = min(int(t / self.step), len(self.jumps) - 1)
        white = self.rng.normal(0, (0.001, 0.001, np.radians(0.15)))
        seen = np.array(self.pose(t)) + self.jumps[i] + white
        return float(seen[0]), float(seen[1]), float(seen[2])

    # The arm.

    def place(self, u_command: FloatArray) -> tuple[FloatArray, FloatArray]:
        if not self.world.arm_persists:
            self.arm_offset = self.rng.normal(0, self.world.arm_error, 2)
        seen = np.asarray(u_command) + self.arm_offset
        return seen + self.rng.normal(0, 0.0005, 2), seen

    def move_time(self, a: FloatArray, b: FloatArray) -> float:
        self.arm_offset = self.rng.normal(0, self.world.arm_error, 2)
        return 0.6 + 2 * self._way_time(a, b)

    def sample_time(self, a: FloatArray, b: FloatArray) -> float:
        stop = {"linear": 0.12, "trapezoid": 0.15, "jittery": 0.15, "slow": 0.35}[self.world.arm]
        if self.world.arm == "jittery":
            stop += self.rng.exponential(0.05)
        return stop + self._way_time(a, b)

    def _way_time(self, a: FloatArray, b: FloatArray) -> float:
        way = float(np.linalg.norm(np.asarray(b) - np.asarray(a)))
        if self.world.arm == "trapezoid":  # 0.25 m/s, 1 m/s^2
            return 2 * np.sqrt(way) if way < 0.0625 else 0.25 + way / 0.25
        return way / 0.2

    # The laser.

    def detects(self, tool_xy: FloatArray, fiducial: FloatArray) -> bool:
        i = int(np.argmin(np.linalg.norm(self.listed - fiducial, axis=1)))
        d, r = np.asarray(tool_xy) - self.true[i], self.world.detection_radius
        away = float(np.linalg.norm(d))
        chance = 1 - self.world.lapse
        if self.world.shape == "disc":
            inside = away <= r
        elif self.world.shape == "square":
            inside = bool(np.abs(d).max() <= 0.886 * r)  # of the disc's area
        elif self.world.shape == "ellipse":
            inside = bool((d[0] / 1.3) ** 2 + (1.3 * d[1]) ** 2 <= r**2)
        else:
            inside = self.rng.random() < np.clip(1.5 - away / r, 0, 1)
        return inside and self.rng.random() < chance
