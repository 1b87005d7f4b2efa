"""arms.py against the same robots' URDFs: other numbers, other conventions, one kinematics."""

import importlib.metadata
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import thing_kin as tk
from arms import gen3, iiwa14, panda
from oracles import Array, assert_close, rotation_x, rotation_z, translation

HALF, PI = np.pi / 2, np.pi

# Origins of the joints and of the flange as published: xyz, rpy. Every axis is +z.
IIWA14 = [  # iiwa_description; its joint limits are those of the data sheet
    ((0, 0, 0.1575), (0, 0, 0)),
    ((0, 0, 0.2025), (HALF, 0, PI)),
    ((0, 0.2045, 0), (HALF, 0, PI)),
    ((0, 0, 0.2155), (HALF, 0, 0)),
    ((0, 0.1845, 0), (-HALF, PI, 0)),
    ((0, 0, 0.2155), (HALF, 0, 0)),
    ((0, 0.081, 0), (-HALF, PI, 0)),
    ((0, 0, 0.045), (0, 0, 0)),
]
GEN3 = [  # kortex_description, 7dof; its 1.5708 and 3.1416 exact here
    ((0, 0, 0.15643), (PI, 0, 0)),
    ((0, 0.005375, -0.12838), (HALF, 0, 0)),
    ((0, -0.21038, -0.006375), (-HALF, 0, 0)),
    ((0, 0.006375, -0.21038), (HALF, 0, 0)),
    ((0, -0.20843, -0.006375), (-HALF, 0, 0)),
    ((0, 0.00017505, -0.10593), (HALF, 0, 0)),
    ((0, -0.10593, -0.00017505), (-HALF, 0, 0)),
    ((0, 0, -0.061525), (PI, 0, 0)),
]


def rotation_y(angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1]])


def urdf_fk(origins: list[tuple[tuple[float, ...], tuple[float, ...]]], q: Array) -> Array:
    """Fixed-axis roll, pitch, yaw, then the joint."""
    T = np.eye(4)
    for (xyz, (roll, pitch, yaw)), angle in zip(origins, [*q, 0.0], strict=True):
        T = T @ translation(*xyz) @ rotation_z(yaw) @ rotation_y(pitch) @ rotation_x(roll)
        T = T @ rotation_z(angle)
    return T


@pytest.mark.parametrize(
    ("make", "origins"), [(iiwa14, IIWA14), (gen3, GEN3)], ids=["iiwa14", "gen3"]
)
def test_an_arm_is_its_urdf(make, origins):
    chain = make()
    for q in [np.zeros(7), *chain.random(50, rng=1)]:
        assert_close(chain.fk(q), urdf_fk(origins, q), atol=1e-12)


def test_the_continuous_joints_of_the_gen3():
    chain = gen3()
    assert chain.joint_types == ("continuous", "revolute") * 3 + ("continuous",)
    assert_array_equal(chain.upper, [np.inf, 2.41, np.inf, 2.66, np.inf, 2.23, np.inf])
    assert_array_equal(chain.lower, -chain.upper)


def panda_urdf() -> Path | None:
    try:
        files = importlib.metadata.files("example-robot-data") or []
    except importlib.metadata.PackageNotFoundError:
        return None
    return next((Path(f.locate()).resolve() for f in files if f.name == "panda.urdf"), None)


@pytest.mark.skipif(not panda_urdf(), reason="needs example-robot-data: pip install --group robots")
def test_the_panda_is_that_of_example_robot_data():
    chain = panda()
    urdf = tk.Chain.from_urdf(panda_urdf(), base="panda_link0", tip="panda_link8")
    Q = chain.random(50, rng=1)
    assert_close(chain.fk(Q), urdf.fk(Q), atol=1e-9)
    for limits in ("lower", "upper", "velocity_limits"):
        assert_array_equal(getattr(chain, limits), getattr(urdf, limits))


def test_the_panda_s_flange_at_zero():
    """Franka: the arm stretched upwards, its flange 0.107 m below joint 6 and 0.088 m ahead."""
    T = translation(0.088, 0.0, 0.333 + 0.316 + 0.384 - 0.107) @ rotation_x(PI)
    assert_close(panda().fk(np.zeros(7)), T, atol=1e-12)
