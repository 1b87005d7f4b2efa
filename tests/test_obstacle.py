"""Signed distances of obstacles against brute force; obstacles as values."""

import copy
import pickle

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.optimize import lsq_linear, minimize_scalar

import thing_kin as tk
from strategies import lengths, rotation_vectors, seeds
from thing_kin import lie

points = st.tuples(*[st.floats(-3.0, 3.0)] * 3)
sizes = st.tuples(*[st.floats(0.05, 2.0)] * 3)
radii = st.floats(0.05, 1.0)

OBSTACLES = [
    tk.Disc(center=(0.6, 0.6), radius=0.4),
    tk.Sphere(center=(0.1, 0.2, 0.3), radius=0.5),
    tk.Capsule(start=(0, 0, 0), end=(0.3, 0.4, 0.5), radius=0.1),
    tk.Box(size=(1, 2, 3), center=(1, 0, 0), rpy=(0.1, 0.2, 0.3)),
    tk.HalfSpace(normal=(1, 2, 2), offset=0.5),
]


@given(center=points, radius=radii, point=points)
def test_sphere_and_disc(center, radius: float, point) -> None:
    sphere = tk.Sphere(center, radius)
    assert sphere.signed_distance(point) == pytest.approx(
        np.linalg.norm(np.subtract(point, center)) - radius, abs=1e-14
    )
    disc = tk.Disc(center[:2], radius)
    assert disc.signed_distance(point) == pytest.approx(
        np.hypot(point[0] - center[0], point[1] - center[1]) - radius, abs=1e-14
    )


@given(start=points, end=points, radius=radii, point=points)
@example(start=(1, 1, 1), end=(1, 1, 1), radius=0.5, point=(1, 1, 1))
def test_capsule_by_a_search_along_its_axis(start, end, radius: float, point) -> None:
    start, end = np.array(start), np.array(end)

    def distance(t: float) -> float:
        return float(np.linalg.norm(start + t * (end - start) - point))

    best = minimize_scalar(distance, bounds=(0.0, 1.0), method="bounded", options={"xatol": 1e-10})
    nearest = min(best.fun, distance(0.0), distance(1.0))
    # The search stops within 1e-10 of the place, on a segment of at most 11 m.
    assert tk.Capsule(start, end, radius).signed_distance(point) == pytest.approx(
        nearest - radius, abs=3e-9
    )


@given(size=sizes, center=points, phi=rotation_vectors(), point=points)
def test_outside_a_box_by_a_quadratic_program(size, center, phi, point) -> None:
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = lie.so3_exp(phi), center
    box = tk.Box(size=size, pose=pose)
    half = np.array(size) / 2
    nearest = lsq_linear(pose[:3, :3], np.subtract(point, center), bounds=(-half, half), tol=1e-15)
    gap = np.linalg.norm(nearest.fun)
    assert max(box.signed_distance(point), 0.0) == pytest.approx(gap, abs=1e-6)


@given(size=sizes, phi=rotation_vectors(), share=st.tuples(*[st.floats(-0.99, 0.99)] * 3))
def test_inside_a_box_by_points_of_its_surface(size, phi, share) -> None:
    half = np.array(size) / 2
    R = lie.so3_exp(phi)
    center = np.array([0.3, -0.2, 0.5])
    inside = share * half
    grid = np.linspace(-1.0, 1.0, 41)
    u, v = (a.ravel() for a in np.meshgrid(grid, grid))
    faces = [np.insert(np.stack([u, v], 1), k, s, axis=1) for k in range(3) for s in (-1.0, 1.0)]
    nearest = np.linalg.norm(np.concatenate(faces) * half - inside, axis=1).min()
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = R, center
    depth = -tk.Box(size=size, pose=pose).signed_distance(center + R @ inside)
    # The grid's points are at most half a diagonal of a cell from the nearest point.
    assert depth <= nearest + 1e-12
    assert nearest**2 <= depth**2 + 2 * (0.025 * half.max()) ** 2 + 1e-9


@given(normal=points, offset=lengths, point=points)
@example(normal=(0, 0, 5e-324), offset=0.5, point=(0, 0, 1))
@example(normal=(1e308, 1e308, 0), offset=0.5, point=(0, 0, 1))
def test_half_space(normal, offset: float, point) -> None:
    if not np.any(normal):
        with pytest.raises(ValueError, match=r"^normal: got no direction"):
            tk.HalfSpace(normal, offset=offset)
        return
    half = tk.HalfSpace(normal, offset=offset)
    scaled = np.array(normal) / np.abs(normal).max()
    unit = scaled / np.linalg.norm(scaled)
    np.testing.assert_allclose(half.normal, unit, atol=1e-15)
    assert half.signed_distance(point) == pytest.approx(unit @ point - offset, abs=1e-14)
    through = tk.HalfSpace(normal, point=point)
    assert through.signed_distance(point) == pytest.approx(0.0, abs=1e-14)


@pytest.mark.parametrize("obstacle", OBSTACLES, ids=lambda o: type(o).__name__)
@given(seed=seeds)
def test_batches_and_the_longest_way(obstacle, seed: int) -> None:
    """Row by row the same, and no more apart than the points are: 1-Lipschitz."""
    rng = np.random.default_rng(seed)
    p, other = rng.uniform(-2, 2, (2, 10, 3))
    distances = obstacle.signed_distance(p)
    assert distances.shape == (10,)
    assert distances.tolist() == [obstacle.signed_distance(row) for row in p]
    gap = np.abs(obstacle.signed_distance(other) - distances)
    assert np.all(gap <= np.linalg.norm(other - p, axis=1) + 1e-14)


@pytest.mark.parametrize("obstacle", OBSTACLES, ids=lambda o: type(o).__name__)
def test_obstacles_are_values(obstacle) -> None:
    for same in (pickle.loads(pickle.dumps(obstacle)), copy.deepcopy(obstacle)):
        assert same == obstacle
        assert hash(same) == hash(obstacle)
    assert [other == obstacle for other in OBSTACLES].count(True) == 1
    with pytest.raises(AttributeError):
        obstacle.radius = 1.0
    for name in ("center", "start", "normal", "pose", "size"):
        if hasattr(obstacle, name):
            with pytest.raises(ValueError, match="read-only"):
                getattr(obstacle, name)[0] = 1.0


def test_what_they_say_of_themselves() -> None:
    said = [eval(repr(obstacle), vars(tk)) for obstacle in OBSTACLES]
    p = np.array([0.3, -0.4, 0.9])
    for obstacle, same in zip(OBSTACLES, said, strict=True):
        assert type(same) is type(obstacle)
        assert same.signed_distance(p) == pytest.approx(obstacle.signed_distance(p), abs=1e-15)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: tk.Disc((0, 0), 0.0), "radius: got 0"),
        (lambda: tk.Disc((0, 0), -1.0), "radius: got -1"),
        (lambda: tk.Disc((0, 0), np.inf), "radius: got inf"),
        (lambda: tk.Disc((0, 0, 0), 1.0), r"center: got shape \(3,\)"),
        (lambda: tk.Sphere((0, 0, np.nan), 1.0), "center: got nan"),
        (lambda: tk.Sphere((0, 0, 1e60), 1.0), "center: got 1e"),
        (lambda: tk.Sphere((0, 0, 0), np.nan), "radius: got nan"),
        (lambda: tk.Capsule((0, 0, 0), (0, 0), 1.0), "end: got"),
        (lambda: tk.Capsule((0, 0, 0), (0, 0, 0), 0.0), "radius: got 0"),
        (lambda: tk.Box(size=(1, 0, 1)), "size: got 0"),
        (lambda: tk.Box(size=(1, 1, -1)), "size: got -1"),
        (lambda: tk.Box(size=(1, 1, 1), pose=2 * np.eye(4)), "pose: got"),
        (lambda: tk.Box(size=(1, 1, 1), pose=np.eye(4), center=(0, 0, 0)), "pose: got center"),
        (lambda: tk.HalfSpace((0, 0, 0), offset=1.0), "normal: got no direction"),
        (lambda: tk.HalfSpace((0, 0, 1)), "point: got None"),
        (lambda: tk.HalfSpace((0, 0, 1), offset=1.0, point=(0, 0, 1)), "offset: got point"),
        (lambda: tk.HalfSpace((0, 0, 1), offset=np.nan), "offset: got nan"),
        (lambda: OBSTACLES[0].signed_distance((0, 0)), "points: got shape"),
    ],
)
def test_what_is_no_obstacle(make, said: str) -> None:
    with pytest.raises(ValueError, match=f"^{said}.*, expected"):
        make()
