"""A Jacobian of one's own against differences."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thing_kin._estimation import numeric_jacobian

Array = NDArray[np.float64]


@dataclass(frozen=True)
class JacobianCheck:
    """The largest difference between a Jacobian and differences of the function.

    Parameters
    ----------
    difference : float
        Relative to the larger of 1 and the largest entry of the row.
    row, col : int
        Where.
    given, expected : float
        The entry there, and what differences say.

    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> check = est.check_jacobian(lambda x: x**2, lambda x: [[2 * x[0]]], [3.0])
    >>> check.difference < 1e-8
    True
    """

    difference: float
    row: int
    col: int
    given: float
    expected: float


def check_jacobian(
    f: Callable[[Array], ArrayLike],
    jacobian: Callable[[Array], ArrayLike],
    x: ArrayLike,
    *,
    angles: Sequence[int] = (),
) -> JacobianCheck:
    """Compare a Jacobian of one's own with central differences of its function.

    Parameters
    ----------
    f : callable
        f(x) -> (m,)
    jacobian : callable
        jacobian(x) -> (m, n)
    x : (n,)
        Where; a point without symmetry tells most.
    angles : sequence of int
        Which entries of f(x) are angles.

    Returns
    -------
    JacobianCheck
        A right Jacobian differs by about 1e-9; 1e-6 or more is a mistake.

    Raises
    ------
    ValueError
        If what a function returns has another shape or is not finite.

    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> wrong = est.check_jacobian(np.sin, lambda x: np.diag(-np.cos(x)), [0.3, 0.7])
    >>> wrong.row, wrong.col, round(wrong.given, 3), round(wrong.expected, 3)
    (0, 0, -0.955, 0.955)
    """
    expected = numeric_jacobian(f, x, angles=angles)
    given = np.asarray(jacobian(np.array(x, dtype=np.float64)), dtype=np.float64)
    if given.shape != expected.shape or not np.isfinite(given).all():
        raise ValueError(
            f"jacobian(x): got shape {given.shape} or a number that is not finite, "
            f"expected finite numbers of shape {expected.shape}"
        )
    scale = np.maximum(1.0, np.abs(expected).max(axis=1, keepdims=True))
    off = np.abs(given - expected) / scale
    row, col = np.unravel_index(int(off.argmax()), off.shape)
    return JacobianCheck(
        difference=float(off[row, col]),
        row=int(row),
        col=int(col),
        given=float(given[row, col]),
        expected=float(expected[row, col]),
    )
