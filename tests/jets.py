"""Numbers that carry their first and second derivatives: an oracle without differences."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Jet:
    """A value, its gradient and its Hessian with respect to the variables."""

    v: float
    g: np.ndarray
    h: np.ndarray

    @staticmethod
    def variables(x: Sequence[float]) -> list[Jet]:
        n = len(x)
        return [Jet(float(xi), e, np.zeros((n, n))) for xi, e in zip(x, np.eye(n), strict=True)]

    def chain(self, f: float, df: float, ddf: float) -> Jet:
        return Jet(f, df * self.g, df * self.h + ddf * np.outer(self.g, self.g))

    def __add__(self, other: Jet | float) -> Jet:
        if isinstance(other, Jet):
            return Jet(self.v + other.v, self.g + other.g, self.h + other.h)
        return Jet(self.v + other, self.g, self.h)

    def __mul__(self, other: Jet | float) -> Jet:
        if isinstance(other, Jet):
            cross = np.outer(self.g, other.g)
            h = self.v * other.h + other.v * self.h + cross + cross.T
            return Jet(self.v * other.v, self.v * other.g + other.v * self.g, h)
        return Jet(self.v * other, self.g * other, self.h * other)

    def __pow__(self, p: int) -> Jet:
        v = self.v
        return self.chain(v**p, p * v ** (p - 1), p * (p - 1) * v ** (p - 2) if p != 1 else 0.0)

    def __rtruediv__(self, other: float) -> Jet:
        return self**-1 * other

    def __truediv__(self, other: Jet | float) -> Jet:
        return self * (other**-1 if isinstance(other, Jet) else 1.0 / other)

    def __neg__(self) -> Jet:
        return self * -1.0

    def __sub__(self, other: Jet | float) -> Jet:
        return self + (-other)

    def __rsub__(self, other: float) -> Jet:
        return -self + other

    __radd__ = __add__
    __rmul__ = __mul__


def exp(x: Jet) -> Jet:
    return x.chain(math.exp(x.v), math.exp(x.v), math.exp(x.v))


def log(x: Jet) -> Jet:
    return x.chain(math.log(x.v), 1 / x.v, -1 / x.v**2)


def sin(x: Jet) -> Jet:
    return x.chain(math.sin(x.v), math.cos(x.v), -math.sin(x.v))


def cos(x: Jet) -> Jet:
    return x.chain(math.cos(x.v), -math.sin(x.v), -math.cos(x.v))


def functions(
    f: Callable[..., Sequence[Jet | float]],
) -> tuple[Callable[[np.ndarray], np.ndarray], ...]:
    """Value, Jacobian and Hessians of a function of separate numbers, as arrays."""

    def jets(x: np.ndarray) -> list[Jet]:
        zero = Jet(0.0, np.zeros(len(x)), np.zeros((len(x), len(x))))
        return [zero + y for y in f(*Jet.variables(x))]

    return (
        lambda x: np.array([y.v for y in jets(x)]),
        lambda x: np.array([y.g for y in jets(x)]),
        lambda x: np.array([y.h for y in jets(x)]),
    )
