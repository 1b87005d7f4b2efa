"""The KDL back end: the same chain, computed by orocos KDL."""

import operator
from typing import SupportsIndex

import numpy as np
from numpy.typing import ArrayLike

from thing_kin import Chain, IkBatchResult, IkResult

try:
    from thing_kin import _kdl
    from thing_kin._kdl import KdlChain
except ImportError as error:  # a wheel for machines without KDL
    raise ImportError(
        "thing_kin was built without KDL, or liborocos-kdl is missing; on Debian install "
        "liborocos-kdl-dev, then build with -DTHING_KIN_KDL=ON (the default)"
    ) from error

__all__ = ["KdlChain", "ik"]


def ik(
    chain: Chain,
    target: ArrayLike,
    seed: ArrayLike | None = None,
    *,
    position_tolerance: float = 1e-7,
    rotation_tolerance: float = 1e-6,
    max_iterations: int = 10_000,
    max_restarts: int = 100,
    deadline: float | None = None,
    rng: SupportsIndex | np.random.Generator = 0,
    threads: int | None = None,
) -> IkResult | IkBatchResult:
    """Joint angles that bring the tool to a pose, by KDL's ChainIkSolverPos_LMA.

    A second opinion beside `thing_kin.ik`, with the same results; slower, and without its weights,
    masks and objectives. KDL's Levenberg-Marquardt solver knows no limits: joints that end outside
    are brought back by whole turns, and where that is not enough it begins anew from a
    low-discrepancy sample. Success is judged by thing_kin's own forward kinematics.

    As KDL proves nothing, a failure is called 'unreachable' only where the pose is farther away
    than the links are long, and 'limited' only where a solution beyond the limits was found. In
    other cases the budget has run out.

    Parameters
    ----------
    chain : Chain
    target : (4, 4) or (N, 4, 4)
        Of the last frame, in the root.
    seed : (n,) or (N, n), rad and m, optional
        Where to begin; brought into the limits first. One for all targets, or one a target.
    position_tolerance, rotation_tolerance : float > 0, m and rad
        KDL takes a rotation of less than 1e-6 rad for none: asked for less, it may stop short.
    max_iterations, max_restarts : int
        Of one target, all attempts together; an attempt takes 100 iterations at most.
    deadline : float, s, optional
        For one target. With it, results are no longer the same on any machine.
    rng : int or numpy.random.Generator
        Which restarts are tried.
    threads : int, optional
        At most, for many targets; by default as many as pay. The result does not depend on it.

    Returns
    -------
    IkResult or IkBatchResult

    Raises
    ------
    ValueError
        If an argument does not fit the chain.

    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> from thing_kin import kdl
    >>> arm = tk.robots.ur10()
    >>> T = arm.fk(arm.random(rng=3))
    >>> result = kdl.ik(arm, T, seed=np.zeros(6))
    >>> result.success, bool(np.allclose(arm.fk(result.q), T, atol=1e-6))
    (True, True)
    """
    result: IkResult | IkBatchResult = _kdl.ik(
        chain,
        target,
        seed,
        position_tolerance=position_tolerance,
        rotation_tolerance=rotation_tolerance,
        max_iterations=max_iterations,
        max_restarts=max_restarts,
        deadline=deadline,
        rng=_number(rng),
        threads=threads,
    )
    return result


def _number(rng: SupportsIndex | np.random.Generator) -> int:
    """Read rng: the next number of a generator, or the number itself."""
    if isinstance(rng, np.random.Generator):
        return int(rng.integers(2**63))
    try:
        number = operator.index(rng)
    except TypeError:
        number = -1
    if not 0 <= number < 2**64:
        raise ValueError(
            f"rng: got {rng!r}, expected a whole number from 0 to 2^64 - 1 or a "
            "numpy.random.Generator"
        )
    return number
