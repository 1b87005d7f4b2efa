"""A model's truth and its measurements, drawn from a generator."""

from __future__ import annotations  # numpy.random is loaded when it is used

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thing_kin._estimation import MeasurementModel, MotionModel

Array = NDArray[np.float64]
Function = Callable[[Array], ArrayLike]


@dataclass(frozen=True)
class Simulation:
    """What was, and what was measured of it.

    Parameters
    ----------
    truth : (N, n), or (runs, N, n)
        The states after each step.
    record : (N, m), or (runs, N, m)
        The measurements of them, as a filter's run takes it.

    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> one = est.simulate([[1.0]], [[1.0]], 5, x0=[0.0], Q=[[1.0]], R=[[1.0]], rng=1)
    >>> one.truth.shape, one.record.shape
    ((5, 1), (5, 1))
    """

    truth: Array
    record: Array


def simulate(
    f: MotionModel | ArrayLike | Function,
    h: MeasurementModel | ArrayLike | Function,
    steps: int,
    *,
    x0: ArrayLike,
    R: ArrayLike,
    Q: ArrayLike | None = None,
    P0: ArrayLike | None = None,
    dt: float | None = None,
    rng: np.random.Generator | int | None = None,
    runs: int | None = None,
    angles: Sequence[int] = (),
    measured_angles: Sequence[int] = (),
) -> Simulation:
    """Draw a truth that moves by a model with its noise, and noisy measurements of it.

    Parameters
    ----------
    f : MotionModel, (n, n) or callable
        As a filter's: f(x) -> (n,).
    h : MeasurementModel, (m, n) or callable
        As a filter's: h(x) -> (m,).
    steps : int
    x0 : (n,)
        The state before the first step, or its mean.
    R : (m, m)
        Measurement noise.
    Q : (n, n), optional
        Process noise of a step. Default, for a built-in model: its own over dt.
    P0 : (n, n), optional
        Covariance of the state before the first step, which is then drawn.
    dt : float, s
        The step of a built-in model.
    rng : numpy.random.Generator or seed, optional
    runs : int, optional
        So many at once, in a leading axis.
    angles, measured_angles : sequence of int
        Which entries of a state, of a measurement are angles; built-in models know.

    Returns
    -------
    Simulation

    Raises
    ------
    ValueError
        If a shape does not fit, or dt or Q is missing.

    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> pose = est.models.components((0, 1, 2), angles=(2,))
    >>> drive = est.simulate(est.models.constant_twist(), pose, 100, x0=[0, 0, 0, 1, 0, 0.2],
    ...                      R=np.diag([1e-4, 1e-4, 1e-6]), dt=0.1, rng=7, runs=3)
    >>> drive.truth.shape, drive.record.shape
    ((3, 100, 6), (3, 100, 3))
    """
    generator = np.random.default_rng(rng)
    start = np.atleast_1d(np.asarray(x0, dtype=np.float64))
    n, count = start.size, 1 if runs is None else int(runs)
    state_angles = list(f.angles if isinstance(f, MotionModel) else angles)
    seen_angles = list(h.angles if isinstance(h, MeasurementModel) else measured_angles)
    if isinstance(f, MotionModel) == (dt is None):
        raise ValueError(f"dt: got {dt}, expected seconds for a built-in model, else None")
    if Q is None and not isinstance(f, MotionModel):
        raise ValueError("Q: got None, expected a covariance: only built-in models have their own")
    x = np.tile(start, (count, 1))
    if P0 is not None:
        x = x + _drawn(generator, _root(P0, n, "P0"), count)
    fixed = None if Q is None else _root(Q, n, "Q")
    truth = np.empty((count, int(steps), n))
    for k in range(int(steps)):
        own = _noise_root(f, x, dt) if fixed is None else fixed
        x = _wrapped(_moved(f, x, dt) + _drawn(generator, own, count), state_angles)
        truth[:, k] = x
    clean = np.stack([_seen(h, states) for states in truth])
    spread = _root(R, clean.shape[2], "R")
    noise = generator.standard_normal(clean.shape) @ spread.T
    record = _wrapped(clean + noise, seen_angles)
    return Simulation(truth, record) if runs is not None else Simulation(truth[0], record[0])


def _root(covariance: ArrayLike, size: int, name: str) -> Array:
    """Give the G = G^T with G G the covariance, which may be semidefinite."""
    matrix = np.asarray(covariance, dtype=np.float64)
    if matrix.shape != (size, size) or not np.isfinite(matrix).all():
        raise ValueError(f"{name}: got shape {matrix.shape}, expected finite ({size}, {size})")
    return _spectral_root(matrix)


def _spectral_root(matrix: Array) -> Array:
    """Give the symmetric one: unlike eigenvectors' signs it is the same by every LAPACK."""
    values, vectors = np.linalg.eigh(matrix)
    scaled = vectors * np.sqrt(np.maximum(values, 0.0))[..., None, :]
    root: Array = scaled @ np.swapaxes(vectors, -1, -2)
    return root


def _noise_root(f: object, x: Array, dt: float | None) -> Array:
    assert isinstance(f, MotionModel)
    assert dt is not None
    return _spectral_root(np.asarray(f.process_noise(x, dt)))


def _drawn(rng: np.random.Generator, factor: Array, count: int) -> Array:
    numbers = rng.standard_normal((count, factor.shape[-1]))
    return np.asarray((factor @ numbers[..., None])[..., 0])


def _moved(f: MotionModel | ArrayLike | Function, x: Array, dt: float | None) -> Array:
    if isinstance(f, MotionModel):
        assert dt is not None
        return np.asarray(f(x, dt))
    if callable(f):
        return np.stack([np.asarray(f(state.copy()), dtype=np.float64) for state in x])
    return x @ np.asarray(f, dtype=np.float64).T


def _seen(h: MeasurementModel | ArrayLike | Function, x: Array) -> Array:
    if isinstance(h, MeasurementModel) or callable(h):
        rows = [np.atleast_1d(np.asarray(h(state.copy()), dtype=np.float64)) for state in x]
        return np.stack(rows)
    return x @ np.asarray(h, dtype=np.float64).T


def _wrapped(values: Array, angles: list[int]) -> Array:
    """Angles in (-pi, pi]."""
    if angles:
        turns = np.ceil(values[..., angles] / (2 * np.pi) - 0.5)
        values[..., angles] -= 2 * np.pi * turns
    return values
