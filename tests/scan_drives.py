"""Scanners, drives and scans with exact truth, in the worlds of scan_worlds."""

from dataclasses import asdict, dataclass, replace

import numpy as np

from ray_casting import cast, distance_to

CLEARANCE = 0.35  # m, from the robot's centre to what it must not touch
PIECE = 0.02  # s in which a drive's twist is constant


@dataclass(frozen=True)
class Sensor:
    """The arguments of odometry.Scanner, and what it does to ranges."""

    angle_min: float
    angle_max: float
    n: int
    range_min: float = 0.06
    range_max: float = 30.0
    mount: tuple[float, float, float] = (0.0, 0.0, 0.0)
    scan_time: float = 0.0
    noise: float = 0.01
    dropouts: float = 0.01  # share of beams without a return

    @property
    def angles(self):
        return np.linspace(self.angle_min, self.angle_max, self.n)

    def arguments(self):
        return {k: v for k, v in asdict(self).items() if k != "dropouts"}

    def scan(self, world, pose_at, t, rng):
        """Ranges as REP 117 has them, beam by beam as the robot moves; the stamp is the first's."""
        times = t + np.linspace(0.0, self.scan_time, self.n)
        beams = compose(pose_at(times), np.array(self.mount))
        ranges = cast(world, beams, self.angles, times, rng)
        ranges = ranges + self.noise * rng.normal(size=self.n)
        ranges[rng.random(self.n) < self.dropouts] = np.inf
        ranges[ranges > self.range_max] = np.inf
        ranges[ranges < self.range_min] = -np.inf
        return ranges


HALF, THREE_QUARTERS = np.pi / 2, 0.75 * np.pi
OFF_CENTRE = (0.25, -0.12, 0.4)
SENSORS = {
    "180 beams, 180 degrees": Sensor(-HALF, HALF, 180),
    "361 beams, 180 degrees": Sensor(-HALF, HALF, 361),
    "270 beams, 270 degrees": Sensor(-THREE_QUARTERS, THREE_QUARTERS, 270, range_max=10.0),
    "1081 beams, 270 degrees": Sensor(
        -THREE_QUARTERS, THREE_QUARTERS, 1081, range_max=10.0, scan_time=0.025 * 0.75
    ),
    "360 beams, whole turn": Sensor(-np.pi, np.pi - np.pi / 180, 360, range_max=12.0, noise=0.015),
    "361 beams, off-centre": Sensor(-HALF, HALF, 361, mount=OFF_CENTRE),
}


def compose(a, b):
    """Planar poses (..., 3): T_a T_b."""
    a, b = np.broadcast_arrays(a, b)
    c, s = np.cos(a[..., 2]), np.sin(a[..., 2])
    x = a[..., 0] + c * b[..., 0] - s * b[..., 1]
    y = a[..., 1] + s * b[..., 0] + c * b[..., 1]
    return np.stack([x, y, wrap(a[..., 2] + b[..., 2])], axis=-1)


def between(a, b):
    """T_a^-1 T_b."""
    a, b = np.broadcast_arrays(a, b)
    c, s = np.cos(a[..., 2]), np.sin(a[..., 2])
    dx, dy = b[..., 0] - a[..., 0], b[..., 1] - a[..., 1]
    return np.stack([c * dx + s * dy, c * dy - s * dx, wrap(b[..., 2] - a[..., 2])], axis=-1)


def wrap(angle):
    return np.arctan2(np.sin(angle), np.cos(angle))


def moved(twist, seconds):
    """The motion of a constant twist (..., 3) held for seconds (...)."""
    turn = twist[..., 2] * seconds
    half = np.sinc(turn / (2 * np.pi))  # chord over arc
    x, y = (twist[..., k] * seconds * half for k in (0, 1))
    c, s = np.cos(turn / 2), np.sin(turn / 2)
    return np.stack([c * x - s * y, s * x + c * y, wrap(turn)], axis=-1)


@dataclass(frozen=True)
class Drive:
    """Poses (N, 3) every PIECE seconds and the constant twists between them: exact at any time."""

    poses: np.ndarray
    twists: np.ndarray

    def __call__(self, t):
        k = np.clip(np.floor(np.asarray(t) / PIECE).astype(int), 0, len(self.twists) - 1)
        return compose(self.poses[k], moved(self.twists[k], t - k * PIECE))

    @property
    def seconds(self):
        return len(self.twists) * PIECE


def free_pose(world, rng, half=None, t=0.0):
    """A pose at random that keeps CLEARANCE; of half a room's size, else about the origin."""
    half = np.array([1.5, 1.0] if half is None else half)
    for _ in range(1000):
        pose = np.append(rng.uniform(-1, 1, 2) * half, rng.uniform(-np.pi, np.pi))
        if distance_to(world, pose[None, :2], t)[0] > CLEARANCE:
            return pose
    raise ValueError("world: got no free place, expected one")


def drive(world, rng, seconds, speed=None):
    """Smooth turns at 0.5 to 1 m/s, away from what is ahead; on the spot where it must.

    Walkers are no obstacle: they step aside, and beams see them where they are.
    """
    speed = rng.uniform(0.5, 1.0) if speed is None else speed
    still = replace(world, walkers=np.empty((0, 6)))
    pose, twist, wish = free_pose(still, rng), np.zeros(3), 0.0
    poses, twists = [pose], []
    for k in range(round(seconds / PIECE)):
        if k % 25 == 0:
            wish = rng.choice([0.0, rng.uniform(-1.2, 1.2)])
        ahead = compose(pose, np.array([[0.5, y, 0.0] for y in (0.0, 0.35, -0.35)]))
        free = distance_to(still, np.vstack([ahead, pose])[:, :2])
        slow = np.clip((free[:3].min() - 0.1) / 0.5, 0.0, 1.0)
        away = np.sign(free[1] - free[2]) or 1.0
        if slow < 0.6 and abs(twist[2]) > 0.3:
            away = np.sign(twist[2])  # a turn once begun is ended
        turn = wish if slow >= 0.6 else 1.3 * away
        goal = np.array([speed * slow * (free[3] > 0.15), 0.0, turn])
        step = np.clip(goal - twist, (-1.5 * PIECE, 0, -3 * PIECE), (0.8 * PIECE, 0, 3 * PIECE))
        twist = twist + step
        pose = compose(pose, moved(twist, PIECE))
        poses.append(pose)
        twists.append(twist)
    return Drive(np.array(poses), np.array(twists))


@dataclass(frozen=True)
class Pair:
    """Two scans of a world, standing still, and the pose of b in a."""

    a: np.ndarray
    b: np.ndarray
    truth: np.ndarray


def pair(world, sensor, rng, distance=0.3, turn=0.3):
    """Scans at two free places up to these apart, with nothing between."""
    still = replace(sensor, scan_time=0.0)
    for _ in range(1000):
        a = free_pose(world, rng)
        way, where = rng.uniform(0, distance), rng.uniform(-np.pi, np.pi)
        step = np.array([way * np.cos(where), way * np.sin(where), rng.uniform(-turn, turn)])
        b = compose(a, step)
        line = a[:2] + np.linspace(0, 1, 8)[:, None] * (b[:2] - a[:2])
        if distance_to(world, line).min() > CLEARANCE:
            break
    else:
        raise ValueError("world: got no two free places, expected them")
    # Walkers take their steps in the time that the way needs at 0.7 m/s.
    at = [still.scan(world, lambda t, p=p: np.tile(p, (len(t), 1)), t, rng)
          for p, t in ((a, 0.0), (b, way / 0.7))]  # fmt: skip
    return Pair(at[0], at[1], between(a, b))


@dataclass(frozen=True)
class Record:
    """Scans (K, n) of a drive at times (K,) with the true poses (K, 3) at their stamps."""

    times: np.ndarray
    scans: np.ndarray
    poses: np.ndarray
    drive: Drive

    def motions(self):
        """True motion (K - 1, 3) from each scan to the next."""
        return between(self.poses[:-1], self.poses[1:])

    def wheels(self, rng, share=0.03):
        """Motions as wheels tell them: wrong by a share of the way, and in the turn."""
        true = self.motions()
        way = np.hypot(true[:, 0], true[:, 1]) + 0.3 * np.abs(true[:, 2])
        noise = share * way[:, None] * (1.0, 1.0, 1.0) + 1e-4
        return true + noise * rng.normal(size=true.shape)


def record(world, sensor, rng, seconds=20.0, rate=10.0, speed=None):
    """A drive and its scans."""
    way = drive(world, rng, seconds, speed)
    times = np.arange(0.0, way.seconds - sensor.scan_time, 1.0 / rate)
    scans = np.array([sensor.scan(world, way, t, rng) for t in times])
    return Record(times, scans, way(times), way)
