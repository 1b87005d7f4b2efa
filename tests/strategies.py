"""What the property tests draw: Denavit-Hartenberg chains, configurations, rotations, twists."""

from dataclasses import dataclass

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

import thing_kin as tk

Vector = NDArray[np.float64]

# Rotation angles where a formula may change its branch or lose digits.
DEGENERATE_ANGLES = (0.0, 1e-12, 1e-8, 1e-4, 1.0 - 1e-9, 1.0, np.pi / 2, np.pi - 1e-9, np.pi)

# Axes with zeros, signs and ties: what picks a largest or a first component must survive them.
DEGENERATE_AXES = tuple(
    np.array(axis) / np.linalg.norm(axis)
    for axis in (
        (1, 0, 0),
        (0, -1, 0),
        (0, 0, -1),
        (0, -3, 4),
        (-3, 0, 4),
        (1, 1, 1),
        (-1, 1, -1),
        (-1e-3, 2, -1),
        (1e-9, 1, 1),
    )
)

lengths = st.floats(-1.0, 1.0)
angles = st.sampled_from((-np.pi, -np.pi / 2, 0.0, np.pi / 2, np.pi)) | st.floats(-np.pi, np.pi)
seeds = st.integers(0, 2**32 - 1)


@dataclass(frozen=True)
class Case:
    """A chain, the rows it came from, one configuration and the index of one of its frames."""

    rows: tuple[tk.DH, ...]
    chain: tk.Chain
    q: Vector
    frame: int


def dh_rows(joint: st.SearchStrategy[str]) -> st.SearchStrategy[tk.DH]:
    return st.builds(
        tk.DH,
        d=lengths,
        theta=angles,
        a=lengths,
        alpha=angles,
        joint=joint,
    )


@st.composite
def cases(draw: st.DrawFn, max_rows: int = 12) -> Case:
    """Chains of 1 to max_rows turning, sliding and constant rows, one at least a joint."""
    moving = draw(dh_rows(st.sampled_from(("revolute", "continuous", "prismatic"))))
    any_row = dh_rows(st.sampled_from(("revolute", "continuous", "prismatic", "fixed")))
    rows = draw(st.lists(any_row, max_size=max_rows - 1))
    rows.insert(draw(st.integers(0, len(rows))), moving)
    chain = tk.Chain.from_dh(rows)
    q = [draw(lengths if joint == "prismatic" else angles) for joint in chain.joint_types]
    return Case(tuple(rows), chain, np.array(q), draw(st.integers(0, len(rows))))


@dataclass(frozen=True)
class Motion:
    """A case in motion: its rates' absolute values add up to at most one; a point of the frame."""

    case: Case
    qd: Vector
    qdd: Vector
    point: Vector


@st.composite
def rates(draw: st.DrawFn, n: int) -> Vector:
    """Zero, one joint's, or all joints'; the sum of their absolute values is at most one."""
    kind = draw(st.sampled_from(("all", "all", "all", "one", "zero")))
    if kind == "zero":
        return np.zeros(n)
    if kind == "one":
        return draw(st.sampled_from((-1.0, 0.5, 1.0))) * np.eye(n)[draw(st.integers(0, n - 1))]
    return np.random.default_rng(draw(seeds)).uniform(-1.0, 1.0, n) / n


@st.composite
def motions(draw: st.DrawFn, max_rows: int = 12) -> Motion:
    case = draw(cases(max_rows))
    qd, qdd = draw(rates(case.chain.n)), draw(rates(case.chain.n))
    point = np.array(draw(st.just((0.0, 0.0, 0.0)) | st.tuples(lengths, lengths, lengths)))
    return Motion(case, qd, qdd, point)


@st.composite
def unit_vectors(draw: st.DrawFn) -> Vector:
    if draw(st.booleans()):
        return draw(st.sampled_from(DEGENERATE_AXES))
    axis = np.random.default_rng(draw(seeds)).normal(size=3)
    return axis / np.linalg.norm(axis)


@st.composite
def rotation_vectors(draw: st.DrawFn, max_angle: float = np.pi) -> Vector:
    """Rotation vectors of norm 0 to max_angle, the degenerate ones among them often."""
    degenerate = st.sampled_from([a for a in DEGENERATE_ANGLES if a <= max_angle])
    return draw(degenerate | st.floats(0.0, max_angle)) * draw(unit_vectors())


@st.composite
def twists(draw: st.DrawFn, max_angle: float = np.pi) -> Vector:
    linear = draw(st.tuples(*[st.floats(-3.0, 3.0)] * 3))
    return np.concatenate([linear, draw(rotation_vectors(max_angle))])


@st.composite
def planar_twists(draw: st.DrawFn, max_angle: float = np.pi) -> Vector:
    """(vx, vy, omega) of SE(2), degenerate angles of both signs among them often."""
    x, y = draw(st.tuples(*[st.floats(-3.0, 3.0)] * 2))
    degenerate = st.sampled_from([a for a in DEGENERATE_ANGLES if a <= max_angle])
    angle = draw(degenerate | st.floats(0.0, max_angle))
    return np.array([x, y, angle * draw(st.sampled_from((-1.0, 1.0)))])


def planar_poses() -> st.SearchStrategy[Vector]:
    """(x, y, theta) with |theta| <= pi."""
    return planar_twists()


@st.composite
def rotations(draw: st.DrawFn, max_angle: float = np.pi) -> NDArray[np.float64]:
    return rotation_matrix(draw(rotation_vectors(max_angle)))


@st.composite
def poses(draw: st.DrawFn, max_angle: float = np.pi) -> NDArray[np.float64]:
    T = np.eye(4)
    T[:3, :3] = draw(rotations(max_angle))
    T[:3, 3] = draw(st.tuples(*[st.floats(-3.0, 3.0)] * 3))
    return T


def rotation_matrix(phi: Vector) -> NDArray[np.float64]:
    """Rodrigues' formula in half angles, which cancel nothing: not the library's own series."""
    angle = np.linalg.norm(phi)
    x, y, z = phi / angle if angle > 0.0 else phi
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * K + 2.0 * np.sin(angle / 2) ** 2 * (K @ K)
