"""Batches in numpy alone, written to be fast: structure of arrays, in blocks that fit the cache."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from peers import Peer, register
from problem import Problem
from thing_dh import Pose, folded

BLOCK = 2048


def combine(columns: list[Any], weights: Any) -> Any:
    """Sum of weight * column; zeros and ones, which are most weights, cost nothing."""
    terms = [c if w == 1.0 else w * c for c, w in zip(columns, weights, strict=True) if w != 0.0]
    return sum(terms[1:], start=terms[0]) if terms else np.zeros((3, 1))


def place(frame: list[Any], constant: Pose) -> list[Any]:
    """Frame [x, y, z, p], each (3, N), times a constant pose."""
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


@register
class NumpyVectorized(Peer):
    name = "numpy_vectorized"
    note = "hand-written numpy, structure of arrays, blocks of 2048"

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem)
        self.joints, self.tool = folded()

    def _walk(self, q: Any) -> Iterator[list[Any]]:
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

    def fk_batch(self, Q: Any) -> Any:
        poses = np.zeros((len(Q), 4, 4))
        poses[:, 3, 3] = 1.0
        for start in range(0, len(Q), BLOCK):
            block = slice(start, start + BLOCK)
            *_, frame = self._walk(np.ascontiguousarray(Q[block].T))
            for j, column in enumerate(frame):
                poses[block, :3, j] = column.T
        return poses

    def jacobian_batch(self, Q: Any) -> Any:
        jacobians = np.zeros((len(Q), 6, len(self.joints)))
        for start in range(0, len(Q), BLOCK):
            block = slice(start, start + BLOCK)
            *frames, tool = self._walk(np.ascontiguousarray(Q[block].T))
            for i, (frame, (_, kind)) in enumerate(zip(frames, self.joints, strict=True)):
                if kind == "prismatic":
                    jacobians[block, :3, i] = frame[2].T
                else:
                    jacobians[block, :3, i] = cross(frame[2], tool[3] - frame[3]).T
                    jacobians[block, 3:, i] = frame[2].T
        return jacobians
