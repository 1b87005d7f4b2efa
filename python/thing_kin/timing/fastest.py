"""The fastest speed along a curve, rest to rest, by toppra (Pham and Pham 2018)."""

from __future__ import annotations

import logging
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from thing_kin.timing.limits import RateLimits
    from thing_kin.timing.quintic import Quintic

Array = NDArray[np.float64]

MISSING = (
    "giving a path its time needs toppra and SciPy, which are not installed: "
    "pip install thing_kin[timing]"
)
TOP_SPEED = 1e2  # of s, which runs at about 1 at the joints' top speeds
TOP_RATE = 1e6  # of that speed
SLOWEST = 1e-9  # inside the path: toppra's rounding may touch zero, where time would stand still


def fastest(path: Quintic, limits: RateLimits, grid: Array, slower: Array, cap: Array) -> Array:
    """Speeds ds/dt at the grid, (N,), zero at both ends; between, d2s/dt2 is constant.

    Limits are kept as if time ran `slower` (N,) times slower there, and the speed below `cap`.

    toppra never sees what it can't digest: unlimited joints are left out, rows are scaled to 1.
    Where it still finds nothing, the result is slower, but keeps all limits.
    """
    rows, curves, top = _rows(path, limits, grid)
    rows, curves = rows * slower[:, None] ** 2, curves * slower[:, None] ** 2
    top = np.minimum(top / slower**2, cap**2)
    speeds = _toppra(rows, curves, top, grid)
    inner = speeds[1:-1]
    if not np.isfinite(speeds).all() or (inner <= 0.0).any() or speeds[0] or speeds[-1]:
        speeds = _trapezoid(rows, curves, top, grid)
    speeds[1:-1] = np.maximum(speeds[1:-1], SLOWEST)
    return speeds


def _rows(path: Quintic, limits: RateLimits, grid: Array) -> tuple[Array, Array, Array]:
    """|rows u + curves x| <= 1 with u = d2s/dt2, x = (ds/dt)^2 <= top: (N, m), (N, m), (N,)."""
    q, first, second = path(grid, 2)
    limited = np.isfinite(limits.acceleration) & np.any(first != 0.0, axis=0)
    rows = first[:, limited] / limits.acceleration[limited]
    curves = second[:, limited] / limits.acceleration[limited]
    speed = np.full(len(grid), 1.0 / TOP_SPEED)
    limited = np.isfinite(limits.velocity) & np.any(first != 0.0, axis=0)
    speed = np.maximum(
        speed, (np.abs(first[:, limited]) / limits.velocity[limited]).max(axis=1, initial=0.0)
    )
    if limits.wheels is not None:
        base = list(limits.base_joints)
        wheels = np.einsum("mij,mj->mi", limits.wheel_rows(q[:, base[2]]), first[:, base])
        speed = np.maximum(speed, np.abs(wheels).max(axis=1))
    return rows, curves, speed**-2.0


def _toppra(rows: Array, curves: Array, top: Array, grid: Array) -> Array:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            import scipy  # noqa: F401
            import toppra
        except ImportError as error:
            raise ImportError(MISSING) from error
        constraint = _constraint(toppra, rows, curves, top, grid)
        logger = logging.getLogger("toppra")
        level = logger.level
        logger.setLevel(logging.CRITICAL + 1)
        try:
            instance = toppra.algorithm.TOPPRA(
                [constraint], _Path(grid), gridpoints=grid, solver_wrapper="seidel"
            )
            speeds = instance.compute_parameterization(0.0, 0.0)[1]
        finally:
            logger.setLevel(level)
    if speeds is None:
        return np.full(len(grid), np.nan)
    return np.array(speeds, dtype=float).reshape(-1)


class _Path:
    """As much of a path as toppra asks for when the constraint has its numbers already."""

    dof = 1

    def __init__(self, grid: Array) -> None:
        self.path_interval = np.array([grid[0], grid[-1]])


def _constraint(toppra: Any, rows: Array, curves: Array, top: Array, grid: Array) -> Any:
    """Limits as toppra's canonical linear constraint, at both ends of each interval."""
    from toppra.constraint.linear_constraint import canlinear_colloc_to_interpolate

    m = rows.shape[1]
    xbound = np.column_stack([np.zeros_like(top), top])
    ubound = np.tile([-TOP_RATE, TOP_RATE], (len(grid), 1))
    linear: tuple[Any, ...] = (None,) * 5
    if m:
        eye = np.eye(m)
        linear = canlinear_colloc_to_interpolate(
            rows, curves, np.zeros_like(rows), np.concatenate([eye, -eye]), np.ones(2 * m),
            None, None, grid, identical=True,
        )[:5]  # fmt: skip

    class Limits(toppra.constraint.LinearConstraint):  # type: ignore[misc]
        def __init__(self) -> None:
            super().__init__()
            self.dof = 1
            self.identical = m > 0

        def compute_constraint_params(self, path: Any, gridpoints: Any) -> tuple[Any, ...]:
            return (*linear, ubound, xbound)

    return Limits()


def _trapezoid(rows: Array, curves: Array, top: Array, grid: Array) -> Array:
    """Half of each acceleration limit for bends, half for changes of speed: slow but sure."""
    bend = 2.0 * np.abs(curves).max(initial=0.0)
    cruise = min(top.min(), 1.0 / bend if bend > 0 else np.inf)
    push = 2.0 * np.abs(rows).max(initial=0.0)
    change = 1.0 / push if push > 0 else TOP_RATE
    room = np.minimum(grid - grid[0], grid[-1] - grid)
    return np.asarray(np.sqrt(np.minimum(cruise, 2.0 * change * room)))
