"""A chain in numpy alone, written to be fast: structure of arrays, in blocks that fit the cache."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from thing_dh import Pose, folded

Columns = list[Any]  # x, y, z and origin of a frame, each (3, N)


def combine(columns: Columns, weights: Any) -> Any:
    """Sum of weight * column; zeros and ones, which are most weights, cost nothing."""
    terms = [c if w == 1.0 else w * c for c, w in zip(columns, weights, strict=True) if w != 0.0]
    return sum(terms[1:], start=terms[0]) if terms else np.zeros((3, 1))


def place(frame: Columns, constant: Pose) -> Columns:
    """A frame times a constant pose."""
    axes, p = frame[:3], frame[3]
    moved = [combine(axes, constant[:3, j]) for j in range(3)]
    offset = constant[:3, 3]
    return [*moved, p + combine(axes, offset) if offset.any() else p]


def cross(a: Any, b: Any) -> Any:
    return np.stack(
        np.broadcast_arrays(
            a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
        )
    )


class NumpyChain:
    """The Thing, its base first."""

    def __init__(self) -> None:
        self.joints, self.tool = folded()

    def walk(self, q: Any) -> Iterator[Columns]:
        """Frame of every joint, then the tool, for a block q of shape (n, N)."""
        frame = [*np.eye(3)[:, :, None], np.zeros((3, 1))]
        for (before, kind), value in zip(self.joints, q, strict=True):
            x, y, z, p = place(frame, before)
            yield [x, y, z, p]
            if kind == "prismatic":
                frame = [x, y, z, p + z * value]
            else:
                c, s = np.cos(value), np.sin(value)
                frame = [c * x + s * y, c * y - s * x, z, p]
        yield place(frame, self.tool)

    def blocks(self, Q: Any, size: int) -> Iterator[tuple[slice, list[Columns], Columns]]:
        """Rows of Q, the joints' frames and the tool's there."""
        for start in range(0, len(Q), size):
            rows = slice(start, start + size)
            *frames, tool = self.walk(np.ascontiguousarray(Q[rows].T))
            yield rows, frames, tool

    def twists(self, frames: list[Columns], tool: Columns) -> Iterator[tuple[Any, Any]]:
        """Linear and angular column of the Jacobian for each joint; None for zero."""
        for (_, _, z, p), (_, kind) in zip(frames, self.joints, strict=True):
            yield (z, None) if kind == "prismatic" else (cross(z, tool[3] - p), z)


def quaternions(tool: Columns) -> Any:
    """(4, N), w first and not negative: the largest row of 4 q q^T, normalized."""
    (r00, r10, r20), (r01, r11, r21), (r02, r12, r22) = np.broadcast_arrays(*tool[:3])
    a, b, c = r21 - r12, r02 - r20, r10 - r01
    d, e, f = r01 + r10, r02 + r20, r12 + r21
    rows = np.array(
        [
            [1.0 + r00 + r11 + r22, a, b, c],
            [a, 1.0 + r00 - r11 - r22, d, e],
            [b, d, 1.0 - r00 + r11 - r22, f],
            [c, e, f, 1.0 - r00 - r11 + r22],
        ]
    )
    largest = rows[range(4), range(4)].argmax(axis=0)
    q = np.take_along_axis(rows, largest[None, None], axis=0)[0]
    return q * (np.where(q[0] < 0.0, -1.0, 1.0) / np.sqrt((q * q).sum(axis=0)))
