"""A table of joint readings and measurements, as `thing-kin calibrate` takes it."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import thing_kin as tk

Array = NDArray[np.float64]


def read(path: Path, chain: tk.Chain, points: bool) -> tuple[Array, Array]:
    """Return q (N, n), and poses (N, 4, 4) or places (N, k, 3)."""
    with path.open(newline="", encoding="utf-8-sig") as file:
        lines = [line for line in csv.reader(file) if line]
    if len(lines) < 2:
        raise ValueError(f"{path}: got {len(lines)} lines, expected names and at least one row")
    names = [name.strip() for name in lines[0]]
    values = np.array([_row(line, len(names), i, path) for i, line in enumerate(lines[1:], 2)])
    joints = _joints(names, chain, path)
    others = [i for i in range(len(names)) if i not in joints]
    measured = values[:, others]
    q = values[:, joints]
    if not np.isfinite(q).all():
        raise ValueError(f"{path}: got a joint reading that is not finite, expected numbers")
    if points:
        if not others or len(others) % 3:
            raise ValueError(f"{path}: got {len(others)} columns of places, expected x, y, z each")
        return q, measured.reshape(len(q), -1, 3)
    return q, _poses(measured, path)


def _row(line: list[str], count: int, number: int, path: Path) -> list[float]:
    try:
        row = [float(cell) if cell.strip() else np.nan for cell in line]
    except ValueError as error:
        raise ValueError(f"{path}: got {error} in line {number}, expected numbers") from error
    if len(row) != count:
        raise ValueError(f"{path}: got {len(row)} cells in line {number}, expected {count}")
    return row


def _joints(names: list[str], chain: tk.Chain, path: Path) -> list[int]:
    """Columns by the joints' names, else the last ones."""
    if set(chain.names) <= set(names):
        return [names.index(name) for name in chain.names]
    if len(names) <= chain.n:
        raise ValueError(f"{path}: got {len(names)} columns, expected more than {chain.n} joints")
    return list(range(len(names) - chain.n, len(names)))


def _poses(rows: Array, path: Path) -> Array:
    if rows.shape[1] not in (6, 7):
        expected = "6 (x, y, z, roll, pitch, yaw) or 7 (x, y, z, qw, qx, qy, qz), or --points"
        raise ValueError(
            f"{path}: got {rows.shape[1]} columns of measurements, expected {expected}"
        )
    poses = np.full((len(rows), 4, 4), np.nan)
    for i, row in enumerate(rows):
        if np.isfinite(row).all():
            turn = {"rpy": row[3:]} if len(row) == 6 else {"quaternion": row[3:]}
            poses[i] = tk.transform(xyz=row[:3], **turn)
        elif not np.isnan(row).all():
            raise ValueError(f"{path}: got half a pose in row {i + 1}, expected all of it or none")
    return poses
