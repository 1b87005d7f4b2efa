"""Where the fiducials of the artifact are, [X21] Tables 4.1 to 4.3."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]


@dataclass(frozen=True, eq=False, init=False)
class Arrangement:
    """Fiducials in the order in which the robot comes by them, side by side of the artifact.

    Parameters
    ----------
    sides : sequence of (n, 2) arrays, m
        In map coordinates, a row for each fiducial; the first of a side is registered at rest. The
        base drives along +x where the x of a side rise from its first to its last, along -x where
        they fall (for a single fiducial: along +x on even sides, counted from 0).
    name : str

    Raises
    ------
    ValueError
        If there is no side, or one is not (n, 2) with n >= 1, or not finite.

    Examples
    --------
    >>> from thing_kin import rmma
    >>> mine = rmma.Arrangement(sides=[[[0.0, 0.6], [0.3, 0.62]], [[0.3, 1.6], [0.0, 1.58]]])
    >>> mine.fiducials, mine.registered
    (4, array([ True, False,  True, False]))
    >>> mine.rotations
    (0.0, 3.141592653589793)
    """

    sides: tuple[FloatArray, ...]
    name: str
    rotations: tuple[float, ...] = field(repr=False)
    """rad: turns a side's own frame, in which the base drives along +x, into the map's."""

    def __init__(self, sides: Sequence[npt.ArrayLike], name: str = "") -> None:
        arrays = tuple(_read_side(side, i) for i, side in enumerate(sides))
        if not arrays:
            raise ValueError("sides: got none, expected at least one (n, 2) array")
        object.__setattr__(self, "sides", arrays)
        object.__setattr__(self, "name", name)
        object.__setattr__(
            self, "rotations", tuple(_rotation(side, i) for i, side in enumerate(arrays))
        )

    @property
    def fiducials(self) -> int:
        """How many there are."""
        return sum(len(side) for side in self.sides)

    @property
    def registered(self) -> BoolArray:
        """(fiducials,): the first of each side."""
        first = [np.arange(len(side)) == 0 for side in self.sides]
        return np.concatenate(first)

    @property
    def driven(self) -> tuple[FloatArray, ...]:
        """The sides in their own frames: (n, 2) each, turned so that the base drives along +x."""
        signs = (-1.0 if rotation else 1.0 for rotation in self.rotations)
        return tuple(sign * side + 0.0 for sign, side in zip(signs, self.sides, strict=True))


def _read_side(side: npt.ArrayLike, i: int) -> FloatArray:
    array = np.array(side, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 2 or len(array) < 1:
        raise ValueError(f"sides[{i}]: got shape {array.shape}, expected (n, 2), n >= 1")
    if not np.isfinite(array).all():
        raise ValueError(f"sides[{i}]: got NaN or inf, expected finite numbers")
    array.setflags(write=False)
    return array


def _rotation(side: FloatArray, i: int) -> float:
    ahead = side[-1, 0] - side[0, 0]
    backward = ahead < 0 if ahead != 0 else i % 2 == 1
    return float(np.pi) if backward else 0.0


def _table(number: int, *sides: tuple[Sequence[float], Sequence[float]]) -> Arrangement:
    return Arrangement([np.column_stack(side) for side in sides], name=f"#{number}")


ARRANGEMENTS = MappingProxyType(
    {
        1: _table(
            1,
            ((1.62, 1.97, 2.31), (1.51, 1.46, 1.71)),
            ((3.09, 2.88, 2.34, 1.35, 1.11, 0.72), (2.23, 2.40, 2.31, 2.25, 2.33, 2.29)),
        ),
        2: _table(
            2,
            ((0.94, 1.14, 1.37, 1.57, 1.82, 2.00), (0.34, 0.32, 0.37, 0.32, 0.34, 0.32)),
        ),
        3: _table(
            3,
            ((1.16, 1.39, 1.66), (1.64, 1.51, 1.51)),
            ((2.79, 2.41, 2.18, 0.87, 0.50, 0.25), (2.44, 2.49, 2.36, 2.36, 2.51, 2.44)),
        ),
    }
)
"""[X21] Tables 4.1, 4.2 and 4.3."""
