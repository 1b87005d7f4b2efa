"""What `calibrate` is given, checked and put in order."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    import thing_kin as tk

    Load = tuple[str | int | None, ArrayLike, float]

Array = NDArray[np.float64]

ALL = ("base", "tool", "joint_offsets", "links")
LARGEST = 1e6


def torques_of(chain: tk.Chain, q: ArrayLike, loads: Sequence[Load], gravity: Array) -> Array:
    """Of the loads about the nominal joints, (N, n)."""
    total = np.zeros(np.shape(q))
    for frame, point, mass in loads:
        if not 0.0 <= mass < LARGEST:
            raise ValueError(f"loads: got {mass!r} kg, expected masses")
        J = chain.jacobian(q, of=frame, point=point)[..., :3, :]
        total = total + mass * np.einsum("...ij,i->...j", J, gravity)
    return total


def shape_of(measured: ArrayLike, q: ArrayLike, n: int) -> tuple[int, ...]:
    """As it is where q is no (N, n): the core says so."""
    shape = _shape(measured, "measured")
    of_q = _shape(q, "q")
    fits = shape[1:] in ((4, 4), (3,)) or (len(shape) == 3 and shape[2] == 3)
    is_known = len(of_q) == 2 and of_q[1] == n and of_q[0] > 0
    if is_known and not (fits and shape[0] == of_q[0]):
        count = of_q[0]
        expected = f"({count}, 4, 4) poses, ({count}, 3) places or ({count}, k, 3) of k points"
        raise ValueError(
            f"measured: got shape {shape}, expected one for each of {count} postures: {expected}"
        )
    return shape


def _shape(argument: ArrayLike, name: str) -> tuple[int, ...]:
    try:
        return np.shape(argument)
    except ValueError as error:  # lists of several lengths
        kind = type(argument).__name__
        raise ValueError(f"{name}: got {kind}, expected an array of real numbers") from error


def places_of(measured: ArrayLike) -> Array:
    """Of poses and points alike, (N, k, 3)."""
    array = np.asarray(measured, dtype=float)
    if array.shape[1:] == (4, 4):
        return array[:, None, :3, 3]
    return array if array.ndim == 3 else array[:, None]


def groups_of(parameters: str | Iterable[str]) -> list[str]:
    """Return names, "all" spelled out."""
    names = [parameters] if isinstance(parameters, str) else list(parameters)
    if not all(isinstance(name, str) for name in names):
        raise ValueError(f"parameters: got {names!r}, expected names")
    expanded = [part for name in names for part in (ALL if name == "all" else (name,))]
    if not expanded:
        raise ValueError("parameters: got none, expected at least one")
    return expanded


def joint_of(chain: tk.Chain, name: str | int) -> int:
    """Return its place in q."""
    known = list(chain.names)
    if isinstance(name, str) and name in known:
        return known.index(name)
    if isinstance(name, int) and 0 <= name < chain.n:
        return name
    raise ValueError(f"sag: got {name!r}, expected joints of {known}")


def joint_covariance(
    core: Any, chain: tk.Chain, count: int, joints: ArrayLike | None, base: ArrayLike | None
) -> ArrayLike | None:
    """One covariance of all joints, or `count`: that of the base's three stands in its place."""
    if base is None:
        return joints
    where = list(chain.base_joints or ())
    if not where:
        raise ValueError(f"base_covariance: got one for {chain.name}, expected a mobile base")
    given = _covariances(core, base, "base_covariance", 3, count)
    whole = np.zeros((*given.shape[:-2], chain.n, chain.n))
    if joints is not None:
        whole = whole + _covariances(core, joints, "q_covariance", chain.n, count)
    whole[..., np.ix_(where, where)[0], np.ix_(where, where)[1]] += given
    return whole


def _covariances(core: Any, argument: ArrayLike, name: str, size: int, count: int) -> Array:
    """One, or one for each posture: then they can be added to others."""
    given: Array = core.numbers(argument, name, (size, size), True, True)
    if given.ndim == 3 and len(given) != count:
        raise ValueError(f"{name}: got {len(given)} covariances, expected one, or {count}")
    return given
