"""What a user says of a rigid body, checked."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from thing_kin.interop.arrays import Array, read_vectors

if TYPE_CHECKING:
    from thing_kin import Chain


def checked(robot: Chain, frame: str, body: Any) -> tuple[float, Array, Array]:
    """(mass, center, inertia) of a body on a frame; ValueError if it is none of a rigid body."""
    if frame not in robot.frames:
        known = ", ".join(robot.frames)
        raise ValueError(f"inertias: got a frame {frame!r}, expected some of {known}")
    name = f"inertias[{frame!r}]"
    if not isinstance(body, (tuple, list)) or len(body) != 3:
        raise ValueError(f"{name}: got {body!r}, expected (mass, center, inertia)")
    return _mass(body[0], name), _center(body[1], name), _inertia(body[2], name)


def _mass(mass: Any, name: str) -> float:
    try:
        kg = float(read_vectors([mass], f"{name} mass", 1)[0])
    except ValueError:
        kg = -1.0
    if kg < 0.0:
        raise ValueError(f"{name}: got a mass of {mass!r}, expected a number >= 0")
    return kg


def _center(center: Any, name: str) -> Array:
    vector = read_vectors(center, f"{name} center", 3)
    if vector.ndim != 1:
        raise ValueError(f"{name} center: got shape {vector.shape}, expected (3,)")
    return vector


def _inertia(inertia: Any, name: str) -> Array:
    matrix = read_vectors(inertia, f"{name} inertia", 3)
    if matrix.shape != (3, 3):
        raise ValueError(f"{name} inertia: got shape {matrix.shape}, expected (3, 3)")
    largest = np.abs(matrix).max()
    if np.abs(matrix - matrix.T).max() > 1e-9 * largest:
        raise ValueError(f"{name} inertia: got an unsymmetric matrix, expected a symmetric one")
    moment = np.linalg.eigvalsh(matrix)[0]
    if moment < -1e-9 * largest:
        expected = "principal moments >= 0"
        raise ValueError(
            f"{name} inertia: got a principal moment of {moment:.3g}, expected {expected}"
        )
    return matrix
