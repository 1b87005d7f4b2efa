"""Scan matchers that users run today, each behind two calls: match two scans, follow many.

All get points of the laser in the plane z = 0. Normals of flat clouds stand upright, and then point
to plane tells nothing: for these the cloud is also offered at three heights ("stood up").
"""

from collections.abc import Iterator
from itertools import product
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

Array = NDArray[np.float64]


def points_of(angles: Array, ranges: Array) -> Array:
    """The returns, (N, 3) with z = 0."""
    seen = np.isfinite(ranges)
    r, a = ranges[seen], angles[seen]
    return np.stack([r * np.cos(a), r * np.sin(a), np.zeros(len(r))], axis=1)


def planar(T: Array) -> Array:
    return np.array([T[0, 3], T[1, 3], np.arctan2(T[1, 0], T[0, 0])])


def spatial(pose: Array) -> Array:
    T = np.eye(4)
    c, s = np.cos(pose[2]), np.sin(pose[2])
    T[:2, :2] = [[c, -s], [s, c]]
    T[:2, 3] = pose[:2]
    return T


class Peer:
    """One matcher with its options; poses are the laser's."""

    name = ""
    grid: dict[str, tuple[Any, ...]] = {}  # noqa: RUF012 what is tried for it

    def __init__(self, sensor: Any, **options: Any) -> None:
        self.sensor, self.options = sensor, options
        self.angles = sensor.angles
        self.__dict__.update(options)

    @classmethod
    def candidates(cls, sensor: Any) -> "Iterator[Peer]":
        for values in product(*cls.grid.values()):
            yield cls(sensor, **dict(zip(cls.grid, values, strict=True)))

    def cloud(self, ranges: Array) -> Any:
        """What a scan is made into before it is matched; kept for the scan after."""
        return points_of(self.angles, ranges)

    def align(self, target: Any, source: Any, guess: Array) -> Array:
        raise NotImplementedError

    def match(self, a: Array, b: Array) -> Array:
        return self.align(self.cloud(a), self.cloud(b), np.zeros(3))

    def follow(self, scans: Array) -> Iterator[Array]:
        """Pose after each scan; constant velocity is the guess."""
        pose, motion, before = np.zeros(3), np.zeros(3), None
        for ranges in scans:
            cloud = self.cloud(ranges)
            if before is not None:
                motion = self.align(before, cloud, motion)
                pose = planar(spatial(pose) @ spatial(motion))
            before = cloud
            yield pose


class PlainIcp(Peer):
    """Point to point by a k-d tree and the closed form, until it no longer moves."""

    name = "plain ICP (SciPy)"
    grid = {"reach": (0.25, 0.5, 1.0)}  # noqa: RUF012

    def cloud(self, ranges: Array) -> Any:
        points = points_of(self.angles, ranges)[:, :2]
        return points, cKDTree(points)

    def align(self, target: Any, source: Any, guess: Array) -> Array:
        T = spatial(guess)[np.ix_((0, 1, 3), (0, 1, 3))]
        (to, tree), (points, _) = target, source
        for _ in range(50):
            at = points @ T[:2, :2].T + T[:2, 2]
            distance, index = tree.query(at, distance_upper_bound=self.options["reach"])
            near = np.isfinite(distance)
            if near.sum() < 3:
                break
            p, q = at[near], to[index[near]]
            u, _, v = np.linalg.svd((p - p.mean(0)).T @ (q - q.mean(0)))
            R = v.T @ np.diag([1.0, np.linalg.det(v.T @ u.T)]) @ u.T
            step = np.eye(3)
            step[:2, :2], step[:2, 2] = R, q.mean(0) - R @ p.mean(0)
            T = step @ T
            if np.abs(step - np.eye(3)).max() < 1e-5:
                break
        return np.array([T[0, 2], T[1, 2], np.arctan2(T[1, 0], T[0, 0])])


class SmallGicp(Peer):
    kind = "ICP"
    heights: tuple[float, ...] = (0.0,)

    def cloud(self, ranges: Array) -> Any:
        import small_gicp

        points = points_of(self.angles, ranges)
        points = np.vstack([points + np.array([0.0, 0.0, z]) for z in self.heights])
        return small_gicp.preprocess_points(points, self.options["voxel"], num_neighbors=10)

    def align(self, target: Any, source: Any, guess: Array) -> Array:
        import small_gicp

        found = small_gicp.align(
            target[0],
            source[0],
            target[1],
            init_T_target_source=spatial(guess),
            registration_type=self.kind,
            max_correspondence_distance=self.options["reach"],
            max_iterations=50,
        )
        return planar(found.T_target_source)


SMALL_GRID = {"voxel": (0.02, 0.05, 0.1, 0.2), "reach": (0.3, 0.6, 1.2)}


class SmallIcp(SmallGicp):
    name, kind, grid = "small_gicp ICP", "ICP", SMALL_GRID


class SmallFlat(SmallGicp):
    name, kind, grid = "small_gicp GICP", "GICP", SMALL_GRID


class SmallPlane(SmallGicp):
    name, kind, grid = "small_gicp plane, stood up", "PLANE_ICP", SMALL_GRID
    heights = (-0.05, 0.0, 0.05)


class SmallStood(SmallGicp):
    name, kind, grid = "small_gicp GICP, stood up", "GICP", SMALL_GRID
    heights = (-0.05, 0.0, 0.05)


def kiss_config(voxel: float, reach: float) -> Any:
    """What KissICP reads; a namespace spares its reader of files."""
    return SimpleNamespace(
        data=SimpleNamespace(max_range=reach, min_range=0.0, deskew=False),
        mapping=SimpleNamespace(voxel_size=voxel, max_points_per_voxel=20),
        registration=SimpleNamespace(
            max_num_iterations=500, convergence_criterion=1e-4, max_num_threads=1
        ),
        adaptive_threshold=SimpleNamespace(
            fixed_threshold=None, initial_threshold=1.0, min_motion_th=0.05
        ),
    )


class Kiss(Peer):
    """Its registration of one scan to a voxel map of the other; its own odometry over a drive."""

    name = "kiss-icp"
    grid = {"voxel": (0.05, 0.1, 0.2, 0.4), "sigma": (0.1, 0.3)}  # noqa: RUF012

    def config(self) -> Any:
        return kiss_config(self.options["voxel"], self.sensor.range_max)

    def match(self, a: Array, b: Array) -> Array:
        from kiss_icp.mapping import get_voxel_hash_map
        from kiss_icp.registration import get_registration
        from kiss_icp.voxelization import voxel_down_sample

        config, sigma = self.config(), self.options["sigma"]
        voxels = get_voxel_hash_map(config)
        voxels.add_points(voxel_down_sample(self.cloud(a), 0.5 * config.mapping.voxel_size))
        source = voxel_down_sample(self.cloud(b), 0.5 * config.mapping.voxel_size)
        T = get_registration(config).align_points_to_map(
            source, voxels, np.eye(4), 3 * sigma, sigma
        )
        return planar(T)

    def follow(self, scans: Array) -> Iterator[Array]:
        from kiss_icp.kiss_icp import KissICP

        config = self.config()
        config.adaptive_threshold.initial_threshold = self.options["sigma"]
        odometry = KissICP(config)
        for ranges in scans:
            odometry.register_frame(self.cloud(ranges), np.empty(0))
            yield planar(odometry.last_pose)


PEERS = (PlainIcp, SmallIcp, SmallFlat, SmallPlane, SmallStood, Kiss)


class Ours(Peer):
    """thing_kin with its defaults; poses are those of the robot."""

    name = "thing_kin"

    def __init__(self, sensor: Any) -> None:
        from thing_kin import odometry

        super().__init__(sensor)
        self.odometry, self.scanner = odometry, odometry.Scanner(**sensor.arguments())
        self.unsure: list[bool] = []  # of each match, whether it said that it is not to be believed

    def match(self, a: Array, b: Array) -> Array:
        match = self.odometry.match(self.scanner, a, b)
        self.unsure.append(match.degenerate or match.ambiguous or match.status != "converged")
        return np.asarray(match.pose)

    def follow(self, scans: Array) -> Iterator[Array]:
        lidar = self.odometry.LaserOdometry(self.scanner)
        for k, ranges in enumerate(scans):
            yield np.asarray(lidar.add(ranges, t=k * self.period).pose)

    period = 0.1
