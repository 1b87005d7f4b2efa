"""Distances between meshes and shapes by Coal, where balls are too coarse."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from thing_kin.interop.arrays import Array, read_pose, read_vectors
from thing_kin.interop.peers import peer

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from thing_kin import Chain


def convex_hull(points: ArrayLike) -> Any:
    """Return the convex hull of a mesh's vertices, as Coal has it.

    Parameters
    ----------
    points : (N, 3), m
        At least four, not all in one plane.

    Returns
    -------
    coal.Convex

    Raises
    ------
    ValueError
        If the points span no volume or are no numbers.
    ImportError
        If Coal is not installed.

    Examples
    --------
    >>> from thing_kin import interop
    >>> interop.convex_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]).num_points
    4
    """
    coal = peer("coal", "coal")
    vertices = read_vectors(points, "points", 3)
    if not _spans_a_volume(vertices):
        raise ValueError(
            f"points: got shape {vertices.shape} without volume, expected at least four points "
            "that are not in one plane"
        )
    model = coal.BVHModelOBBRSS()
    model.beginModel(0, len(vertices))
    model.addVertices(vertices)
    model.endModel()
    model.buildConvexHull(True, "Qt")
    return model.convex


def _spans_a_volume(points: Array) -> bool:
    if points.ndim != 2 or len(points) < 4:
        return False
    spread = np.linalg.svd(points - np.mean(points, axis=0), compute_uv=False)
    return bool(spread[2] > 1e-9 * spread[0])


@dataclass(frozen=True)
class _Link:
    frame: str
    geometry: Any
    pose: Array  # in the frame


class MeshClearance:
    """How far a robot's links are from obstacles and each other, m, by Coal's shapes.

    For a term: tk.terms.Function(meshes.value, meshes.jacobian, size=len(meshes), name="meshes").
    Obstacle by obstacle a distance from each link, then that of each pair of links; negative where
    they overlap. The Jacobian is that of the nearest points; it jumps where another pair of points
    becomes the nearest, as between parallel faces.

    Parameters
    ----------
    robot : Chain
    links : sequence of (frame, geometry) or (frame, geometry, pose)
        A frame's name, a convex shape of Coal (coal.Box, coal.Capsule, convex_hull(...)), and its
        pose in the frame, (4, 4); default: the frame's own.
    obstacles : sequence of (geometry, pose)
        Their poses in the world.
    pairs : sequence of (int, int)
        Which links must not meet each other, by their places in `links`.

    Raises
    ------
    ValueError
        If a frame does not exist, a geometry is not convex, a pose is none or an index is wrong.
    ImportError
        If Coal is not installed.

    Examples
    --------
    >>> import coal, numpy as np, thing_kin as tk
    >>> from thing_kin import interop
    >>> robot = tk.robots.ur5()
    >>> table = (coal.Box(2.0, 2.0, 0.1), tk.transform(xyz=(0, 0, -0.05)))
    >>> meshes = interop.MeshClearance(robot, [("tool", coal.Sphere(0.05))], [table])
    >>> q = np.array([0.0, -1.0, 1.2, 0.0, 0.0, 0.0])
    >>> np.allclose(meshes.value(q), robot.fk(q)[2, 3] - 0.05)
    True
    """

    def __init__(
        self,
        robot: Chain,
        links: Sequence[tuple[Any, ...]],
        obstacles: Sequence[tuple[Any, ArrayLike]] = (),
        *,
        pairs: Iterable[tuple[int, int]] = (),
    ) -> None:
        self._coal = peer("coal", "coal")
        self._robot = robot
        self._links = [self._link(entry, f"links[{i}]") for i, entry in enumerate(links)]
        self._obstacles = [
            (self._convex(geometry, f"obstacles[{i}]"), read_pose(pose, f"obstacles[{i}]"))
            for i, (geometry, pose) in enumerate(obstacles)
        ]
        self._pairs = [tuple(pair) for pair in pairs]
        for i, pair in enumerate(self._pairs):
            if len(set(pair)) != 2 or not all(0 <= k < len(links) for k in pair):
                raise ValueError(f"pairs[{i}]: got {pair}, expected two of {len(links)} links")
        self._request = self._coal.DistanceRequest()
        self._request.enable_signed_distance = True

    def __len__(self) -> int:
        return len(self._links) * len(self._obstacles) + len(self._pairs)

    def value(self, q: ArrayLike) -> Array:
        """Return the distances at one configuration.

        Parameters
        ----------
        q : (n,), rad and m

        Returns
        -------
        (m,), m

        Examples
        --------
        >>> import coal, numpy as np, thing_kin as tk
        >>> from thing_kin import interop
        >>> links = [("shoulder", coal.Sphere(0.1)), ("tool", coal.Sphere(0.1))]
        >>> meshes = interop.MeshClearance(tk.robots.ur5(), links, pairs=[(0, 1)])
        >>> meshes.value(np.zeros(6)).shape
        (1,)
        """
        return self._evaluate(q)[0]

    def jacobian(self, q: ArrayLike) -> Array:
        """Return the distances' derivatives at one configuration.

        Parameters
        ----------
        q : (n,), rad and m

        Returns
        -------
        (m, n)

        Examples
        --------
        >>> import coal, numpy as np, thing_kin as tk
        >>> from thing_kin import interop
        >>> links = [("shoulder", coal.Sphere(0.1)), ("tool", coal.Sphere(0.1))]
        >>> meshes = interop.MeshClearance(tk.robots.ur5(), links, pairs=[(0, 1)])
        >>> meshes.jacobian(np.zeros(6)).shape
        (1, 6)
        """
        return self._evaluate(q)[1]

    def _link(self, entry: tuple[Any, ...], name: str) -> _Link:
        if len(entry) not in (2, 3):
            raise ValueError(f"{name}: got {entry}, expected (frame, geometry) or with a pose")
        frame, geometry, pose = (*entry, np.eye(4))[:3]
        if frame not in self._robot.frames:
            raise ValueError(f"{name}: got {frame!r}, expected one of {self._robot.frames}")
        return _Link(frame, self._convex(geometry, name), read_pose(pose, name))

    def _convex(self, geometry: Any, name: str) -> Any:
        if isinstance(geometry, self._coal.ShapeBase):
            return geometry
        got = type(geometry).__name__
        raise ValueError(f"{name}: got {got}, expected a convex shape of coal (convex_hull)")

    def _evaluate(self, q: ArrayLike) -> tuple[Array, Array]:
        x = read_vectors(q, "q", self._robot.n)
        if x.ndim != 1:
            raise ValueError(f"q: got shape {x.shape}, expected ({self._robot.n},)")
        frames = [self._robot.fk(x, link.frame) for link in self._links]
        poses = [T @ link.pose for T, link in zip(frames, self._links, strict=True)]
        value, rows = [], []
        for geometry, pose in self._obstacles:
            for i, link in enumerate(self._links):
                distance, n, p, _ = self._measure(link.geometry, poses[i], geometry, pose)
                value.append(distance)
                rows.append(-n @ self._rate(x, i, frames[i], p))
        for i, k in self._pairs:
            one, other = self._links[i], self._links[k]
            distance, n, p, r = self._measure(one.geometry, poses[i], other.geometry, poses[k])
            value.append(distance)
            rows.append(n @ (self._rate(x, k, frames[k], r) - self._rate(x, i, frames[i], p)))
        return np.array(value), np.array(rows).reshape(len(value), len(x))

    def _measure(self, one: Any, T_one: Array, other: Any, T_other: Array) -> tuple[Any, ...]:
        """Distance, the unit normal from one to the other, and the nearest points."""
        placed = [self._coal.Transform3s(T[:3, :3], T[:3, 3]) for T in (T_one, T_other)]
        result = self._coal.DistanceResult()
        distance = self._coal.distance(one, placed[0], other, placed[1], self._request, result)
        points = (result.getNearestPoint1(), result.getNearestPoint2())
        return distance, np.array(result.normal), *(np.array(p) for p in points)

    def _rate(self, q: Array, link: int, T: Array, point: Array) -> Array:
        """Jacobian of a point of the world that moves with a link."""
        local = T[:3, :3].T @ (point - T[:3, 3])
        return self._robot.jacobian(q, of=self._links[link].frame, point=local)[:3]
