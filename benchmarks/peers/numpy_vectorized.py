"""Batches in numpy alone, as a competent user writes them."""

from typing import Any

import numpy as np

from numpy_chain import Columns, NumpyChain, cross, quaternions
from peers import Peer, register
from problem import BATCH, Problem

BLOCK = 2048
HESSIAN_BLOCK = 256  # of a hundred times as many numbers a row


def new_poses(count: int) -> Any:
    poses = np.zeros((count, 4, 4))
    poses[:, 3, 3] = 1.0
    return poses


def write_pose(out: Any, tool: Columns) -> None:
    for j, column in enumerate(tool):
        out[:, :3, j] = column.T


@register
class NumpyVectorized(Peer):
    name = "numpy_vectorized"
    note = f"hand-written numpy, structure of arrays, blocks of {BLOCK}"

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem)
        self.chain = NumpyChain()
        self.poses = new_poses(BATCH)

    def _fk(self, Q: Any, out: Any) -> Any:
        for rows, _, tool in self.chain.blocks(Q, BLOCK):
            write_pose(out[rows], tool)
        return out

    def fk_batch(self, Q: Any) -> Any:
        return self._fk(Q, new_poses(len(Q)))

    def fk_batch_out(self, Q: Any) -> Any:
        return self._fk(Q, self.poses)

    def fk_quaternion_batch(self, Q: Any) -> Any:
        out = np.empty((len(Q), 7))
        for rows, _, tool in self.chain.blocks(Q, BLOCK):
            out[rows, :3] = tool[3].T
            out[rows, 3:] = quaternions(tool).T
        return out

    def _write_jacobian(self, out: Any, frames: list[Columns], tool: Columns) -> None:
        for i, (linear, angular) in enumerate(self.chain.twists(frames, tool)):
            out[:, :3, i] = linear.T
            if angular is not None:
                out[:, 3:, i] = angular.T

    def jacobian_batch(self, Q: Any) -> Any:
        J = np.zeros((len(Q), 6, len(self.chain.joints)))
        for rows, frames, tool in self.chain.blocks(Q, BLOCK):
            self._write_jacobian(J[rows], frames, tool)
        return J

    def fk_and_jacobian_batch(self, Q: Any) -> Any:
        T, J = new_poses(len(Q)), np.zeros((len(Q), 6, len(self.chain.joints)))
        for rows, frames, tool in self.chain.blocks(Q, BLOCK):
            write_pose(T[rows], tool)
            self._write_jacobian(J[rows], frames, tool)
        return T, J

    def hessian_batch(self, Q: Any) -> Any:
        """Column k turns what comes after it: w_k x v_i, which is symmetric, and w_k x w_i."""
        n = len(self.chain.joints)
        H = np.empty((len(Q), 6, n, n))
        for rows, frames, tool in self.chain.blocks(Q, HESSIAN_BLOCK):
            block = np.zeros((6, n, n, len(Q[rows])))
            twists = list(self.chain.twists(frames, tool))
            for k in (k for k in range(n) if twists[k][1] is not None):
                for i in range(k, n):
                    v, w = twists[i]
                    block[:3, i, k] = block[:3, k, i] = cross(twists[k][1], v)
                    if i > k and w is not None:
                        block[3:, i, k] = cross(twists[k][1], w)
            H[rows] = block.transpose(3, 0, 1, 2)
        return H
