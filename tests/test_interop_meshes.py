"""Distances by Coal: against this library's own where the shapes are the same."""

import numpy as np
import pytest
from hypothesis import given

import thing_kin as tk
from oracles import assert_close, derivative
from strategies import seeds
from test_import import foreign, modules_after
from thing_kin import interop

coal = pytest.importorskip("coal")

ROBOT = tk.robots.thing()
T_BOX = tk.transform(xyz=(0.4, -0.3, 0.6), rpy=(0.1, 0.2, 0.3))
T_POST = tk.transform(xyz=(1.0, 0.5, 0.8), rpy=(0.4, -0.2, 0.0))
BALLS = [("forearm", (0.1, 0.02, 0.0), 0.08), ("tool", (0.0, 0.0, 0.1), 0.05)]
LINKS = [(frame, coal.Sphere(r), tk.transform(xyz=c)) for frame, c, r in BALLS]
POST = coal.Capsule(0.1, 0.9)
OBSTACLES = [(coal.Box(0.6, 0.4, 0.3), T_BOX), (POST, T_POST), (coal.Sphere(0.2), T_BOX)]
HALF = T_POST[:3, :3] @ (0.0, 0.0, 0.45)
SAME = [
    tk.Box(size=(0.6, 0.4, 0.3), pose=T_BOX),
    tk.Capsule(T_POST[:3, 3] - HALF, T_POST[:3, 3] + HALF, 0.1),
    tk.Sphere(T_BOX[:3, 3], 0.2),
]
MESHES = interop.MeshClearance(ROBOT, LINKS, OBSTACLES, pairs=[(0, 1)])
OURS = tk.terms.Clearance(tk.LinkSpheres(ROBOT, BALLS, pairs=[(0, 1)]), SAME)


@given(seed=seeds)
def test_balls_and_shapes_as_in_this_library(seed: int) -> None:
    """Coal's distances of iterated kinds are good to its tolerance, 1e-6."""
    q = ROBOT.random(rng=seed)
    value, J = OURS.evaluate(ROBOT, q)
    assert len(MESHES) == 7
    assert_close(MESHES.value(q), value, 2e-6)
    outside = value > 1e-3  # inside a box the nearest face may be another one
    assert_close(MESHES.jacobian(q)[outside], J[outside], 1e-4)


def test_a_hull_is_the_box_of_its_corners() -> None:
    corners = np.array([(x, y, z) for x in (-0.3, 0.3) for y in (-0.2, 0.2) for z in (-0.15, 0.15)])
    inner = 0.5 * corners  # no part of the hull
    hull = interop.convex_hull(np.vstack([corners, inner]))
    assert hull.num_points == 8
    by_hull = interop.MeshClearance(ROBOT, LINKS, [(hull, T_BOX)])
    for seed in range(20):
        q = ROBOT.random(rng=seed)
        assert_close(by_hull.value(q), MESHES.value(q)[:2], 2e-6)


def test_the_jacobian_of_hulls_is_the_derivative() -> None:
    rng = np.random.default_rng(5)
    hulls = [interop.convex_hull(rng.normal(scale=0.1, size=(20, 3))) for _ in range(3)]
    links = [("upper_arm", hulls[0], tk.transform(xyz=(0.3, 0, 0))), ("tool", hulls[1])]
    meshes = interop.MeshClearance(ROBOT, links, [(hulls[2], T_POST)], pairs=[(0, 1)])
    checked = 0
    for seed in range(20):
        q = ROBOT.random(rng=seed)
        J = meshes.jacobian(q)
        # Where the nearest features are the same nearby; the step is far above Coal's tolerance.
        near = np.abs(meshes.jacobian(q + 2e-3) - J).max(axis=1) < 0.02
        slopes = derivative(meshes.value, q, 1e-3)
        apart = near & (meshes.value(q) > 0.05)
        checked += apart.sum()
        assert_close(J[apart], slopes[apart], 2e-2)
    assert checked > 15


def test_as_a_term() -> None:
    term = tk.terms.Function(MESHES.value, MESHES.jacobian, size=len(MESHES), name="meshes")
    q = ROBOT.random(rng=3)
    value, J = term.evaluate(ROBOT, q)
    assert np.array_equal(value, MESHES.value(q))
    assert np.array_equal(J, MESHES.jacobian(q))


def test_it_is_loaded_on_demand() -> None:
    assert "coal" not in foreign(modules_after("import thing_kin.interop"))


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: interop.MeshClearance(ROBOT, [("no", coal.Sphere(0.1))]), r"links\[0\]: got 'no'"),
        (lambda: interop.MeshClearance(ROBOT, [("tool",)]), r"links\[0\]: got"),
        (lambda: interop.MeshClearance(ROBOT, [("tool", 3)]), r"links\[0\]: got int"),
        (
            lambda: interop.MeshClearance(ROBOT, [("tool", coal.BVHModelOBBRSS())]),
            r"links\[0\]: got BVHModelOBBRSS",
        ),
        (
            lambda: interop.MeshClearance(ROBOT, [], [(coal.Sphere(0.1), 2 * np.eye(4))]),
            r"obstacles\[0\]: got",
        ),
        (lambda: interop.MeshClearance(ROBOT, LINKS, pairs=[(0, 0)]), r"pairs\[0\]: got"),
        (lambda: interop.MeshClearance(ROBOT, LINKS, pairs=[(0, 2)]), r"pairs\[0\]: got"),
        (lambda: MESHES.value(np.zeros(6)), "q: got shape"),
        (lambda: MESHES.value(np.zeros((2, 9))), "q: got shape"),
        (lambda: interop.convex_hull(np.zeros((5, 3))), "points: got shape"),
        (lambda: interop.convex_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]), "points: got"),
        (lambda: interop.convex_hull((1.0, 2.0, 3.0)), "points: got"),
        (lambda: interop.convex_hull("abc"), "points: got"),
    ],
)
def test_what_does_not_fit(make, said: str) -> None:
    with pytest.raises(ValueError, match=f"^{said}.*, expected"):
        make()
