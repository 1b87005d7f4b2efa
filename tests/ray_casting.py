"""Ranges of a scanner in worlds of segments and circles: exact, every beam from its own pose."""

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class World:
    """What beams hit; in metres and seconds.

    segments (S, 4) are x0, y0, x1, y1; a beam passes `clear` (S,) of them with that probability.
    circles (C, 3) are x, y, radius. walkers (M, 6) are discs that go there and back on a line: the
    two ends, the radius, the speed.
    """

    segments: np.ndarray
    circles: np.ndarray = field(default_factory=lambda: np.empty((0, 3)))
    clear: np.ndarray | None = None
    walkers: np.ndarray = field(default_factory=lambda: np.empty((0, 6)))

    def discs_at(self, t: float) -> np.ndarray:
        """Circles and walkers, (C + M, 3)."""
        a, b, radius, speed = np.split(self.walkers, [2, 4, 5], axis=1)
        length = np.linalg.norm(b - a, axis=1, keepdims=True)
        there = np.abs((speed * t / length + 1) % 2 - 1)  # 0 at a, 1 at b
        return np.vstack([self.circles, np.hstack([a + there * (b - a), radius])])


def to_segments(origins, directions, segments):
    """Distances (B, S) along each beam to each segment, inf where it is missed."""
    d = directions[:, None]
    start = segments[:, :2] - origins[:, None]
    along = segments[:, 2:] - segments[:, :2]
    with np.errstate(divide="ignore", invalid="ignore"):
        area = cross(d, along)
        distance, share = cross(start, along) / area, cross(start, d) / area
        hit = (distance > 0) & (share >= 0) & (share <= 1)
    return np.where(hit, distance, np.inf)


def to_circles(origins, directions, circles):
    """Distances (B, C) along each beam to each circle, from outside or inside."""
    center = circles[:, :2] - origins[:, None]
    along = np.sum(center * directions[:, None], axis=2)
    half_chord_2 = circles[:, 2] ** 2 - cross(center, directions[:, None]) ** 2
    half = np.sqrt(np.maximum(half_chord_2, 0.0))
    near, far = along - half, along + half
    distance = np.where(near > 0, near, far)
    return np.where((half_chord_2 >= 0) & (distance > 0), distance, np.inf)


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


STEP_ASIDE = 0.3  # m


def cast(world, poses, angles, times=None, rng=None):
    """Exact ranges (B,) of beams that leave poses (B, 3) at angles (B,) to them, at times (B,).

    Walkers are where they are at the middle of the times: they go a centimetre in a scan. None is
    nearer to the scanner than STEP_ASIDE: who would be is not there.
    """
    origins = poses[:, :2]
    heading = poses[:, 2] + angles
    directions = np.stack([np.cos(heading), np.sin(heading)], axis=1)
    to_walls = to_segments(origins, directions, world.segments)
    if world.clear is not None:
        passes = rng.random(to_walls.shape) < world.clear
        to_walls[passes] = np.inf
    discs = world.discs_at(0.0 if times is None else float(np.mean(times)))
    away = np.linalg.norm(discs[:, :2] - origins.mean(axis=0), axis=1) - discs[:, 2]
    discs = discs[(away > STEP_ASIDE) | (np.arange(len(discs)) < len(world.circles))]
    distances = np.hstack([to_walls, to_circles(origins, directions, discs)])
    return distances.min(axis=1, initial=np.inf)


def distance_to(world, points, t=0.0):
    """From points (N, 2) to what is nearest in the world, (N,); negative inside a disc."""
    a, b = world.segments[:, :2], world.segments[:, 2:]
    along, start = b - a, points[:, None] - a
    share = np.clip(np.sum(start * along, axis=2) / np.sum(along**2, axis=1), 0, 1)
    to_walls = np.linalg.norm(start - share[..., None] * along, axis=2)
    discs = world.discs_at(t)
    to_discs = np.linalg.norm(points[:, None] - discs[:, :2], axis=2) - discs[:, 2]
    return np.hstack([to_walls, to_discs]).min(axis=1, initial=np.inf)
