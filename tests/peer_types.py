"""The poses and rotations of other libraries: how to make them, and the array they stand for."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pinocchio as pin
import pytest
from numpy.typing import NDArray
from scipy.spatial import transform

try:
    import spatialmath as sm
except ImportError:
    sm = None

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Peer:
    """`make` a thing of an array; `array` is what it says of itself, by its own accessor."""

    name: str
    make: Callable[[Array], Any]
    array: Callable[[Any], Array]
    missing: str = ""

    def param(self) -> Any:
        marks = pytest.mark.skip(reason=self.missing) if self.missing else ()
        return pytest.param(self, id=self.name, marks=marks)


# SciPy has RigidTransform since 1.16, which needs a newer Python than ours may be.
NO_RIGID = "" if hasattr(transform, "RigidTransform") else "needs scipy >= 1.16"
NO_SPATIALMATH = "" if sm else "needs spatialmath-python"


def rigid(T: Array) -> Any:
    return transform.RigidTransform.from_matrix(T)


def scipy_rotation(R: Array) -> Any:
    return transform.Rotation.from_matrix(R)


POSES = [
    Peer("scipy", rigid, lambda x: x.as_matrix(), NO_RIGID),
    Peer("pinocchio", pin.SE3, lambda x: x.homogeneous),
    Peer("spatialmath", lambda T: sm.SE3(T, check=False), lambda x: x.A, NO_SPATIALMATH),
]
SEVERAL_POSES = [
    Peer("scipy", rigid, lambda x: x.as_matrix(), NO_RIGID),
    Peer("pinocchio", lambda T: list(map(pin.SE3, T)), lambda x: [i.homogeneous for i in x]),
    Peer("spatialmath", lambda T: sm.SE3(list(T), check=False), lambda x: x.A, NO_SPATIALMATH),
]
ROTATIONS = [
    Peer("scipy", scipy_rotation, lambda x: x.as_matrix()),
    Peer("pinocchio", pin.Quaternion, lambda x: x.matrix()),
    Peer("spatialmath", lambda R: sm.SO3(R, check=False), lambda x: x.A, NO_SPATIALMATH),
]
SEVERAL_ROTATIONS = [
    Peer("scipy", scipy_rotation, lambda x: x.as_matrix()),
    Peer("spatialmath", lambda R: sm.SO3(list(R), check=False), lambda x: x.A, NO_SPATIALMATH),
]


def params(peers: list[Peer]) -> list[Any]:
    return [peer.param() for peer in peers]
