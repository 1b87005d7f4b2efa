"""A calibration's data and fits, kept for what is asked of the result later."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    import thing_kin as tk

Array = NDArray[np.float64]


@dataclass(frozen=True)
class CalibrationRun:
    """The problem as the core has it, and its fit to all postures."""

    chain: tk.Chain
    q: Array
    problem: Any
    fit: Any
    options: dict[str, Any]
    torques: Callable[[ArrayLike], Array | None]
    with_parameters: Callable[[list[str]], Any]  # the same data, other parameters
    groups: tuple[str, ...]  # of parameters, as asked for
    places: Array  # as measured, (N, k, 3)

    @property
    def everything(self) -> list[int]:
        """All postures."""
        return list(range(len(self.q)))

    def read_postures(self, q: ArrayLike, name: str) -> Array:
        """(n,) or (N, n), checked; else ValueError."""
        from thing_kin import _calibration

        return _calibration.numbers(q, name, (self.chain.n,), True, False)

    def told_at(self, q: Array) -> Array:
        """Whether measurements at these postures would tell each parameter."""
        return np.asarray(self.problem.told_at(self.fit, q, self.torques(q)), dtype=bool)

    def most_telling(self, candidates: ArrayLike, count: int) -> Array:
        """Choose the best of the candidates, one after the other."""
        q = self.read_postures(candidates, "candidates")
        if q.ndim != 2 or not len(q):
            n = self.chain.n
            raise ValueError(f"candidates: got shape {q.shape}, expected (N, {n}), N at least 1")
        return np.asarray(q[self.problem.most_telling(self.fit, q, self.torques(q), count)])

    def errors_nominal(self, names: tuple[str, ...]) -> Array:
        """Of the nominal chain, only its places fitted."""
        groups = {name.partition(".")[0].partition("[")[0] for name in names}
        places: list[str] = [name for name in ("base", "tool", "points") if name in groups]
        if not places:
            rows = self.problem.nominal_errors(self.options["base"], self.options["tool"])
        else:
            rows = self.with_parameters(places).fit(**self.options, postures=self.everything).errors
        return self.shaped(rows)

    def shaped(self, rows: Array) -> Array:
        """From what was measured, row after row, to all; NaN for what was not."""
        m, k = self.problem.rows, self.problem.per_posture
        errors = np.full((len(self.q), k, m), np.nan)
        errors[self.fit.postures, self.fit.points] = rows.reshape(-1, m)
        return errors if k > 1 else errors[:, 0]

    def held_out_errors(self, folds: int, rng: np.random.Generator) -> list[Array]:
        """Errors of each fold by what the others tell, a row for each measurement."""
        _, group = np.unique(self.q.round(6), axis=0, return_inverse=True)
        group = group.reshape(-1)
        groups = int(group.max()) + 1
        if folds > groups:
            raise ValueError(f"folds: got {folds}, expected at most the {groups} distinct postures")
        fold_of = (rng.permutation(groups) % folds)[group]
        errors = []
        for fold in range(folds):
            train, test = np.flatnonzero(fold_of != fold), np.flatnonzero(fold_of == fold)
            fit = self.problem.fit(**self.options, postures=train.tolist())
            rows = self.problem.errors(fit, test.tolist())
            errors.append(rows.reshape(-1, self.problem.rows))
        return errors
