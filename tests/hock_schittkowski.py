"""Problems of Hock and Schittkowski, Test Examples for Nonlinear Programming Codes, 1981.

Each with its number there, the objective, what is zero, what is at least zero, bounds, the start
and the least objective: closed where there is a closed form, else to all digits of the book.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, log, pi, sqrt

import numpy as np

import jets
import thing_kin as tk
from jets import Jet, cos, exp, functions, sin

Functions = Callable[..., Sequence[Jet | float]]


@dataclass(frozen=True)
class HS:
    number: int
    f: Callable[..., Jet | float]
    x0: tuple[float, ...]
    best: float
    equal: Functions | None = None  # to 0
    at_least: Functions | None = None  # 0
    bounds: tuple[tuple[float, float], ...] = ()

    def problem(self) -> tk.Problem:
        n = len(self.x0)
        lower, upper = np.transpose(self.bounds) if self.bounds else (-inf, inf)
        problem = tk.Problem(n=n, lower=lower, upper=upper)
        problem.minimize(term(lambda *x: [self.f(*x)], self.x0, "f"))
        if self.equal:
            problem.equal(term(self.equal, self.x0, "h"))
        if self.at_least:
            problem.at_least(term(self.at_least, self.x0, "g"), 0.0)
        return problem


def term(f: Functions, x: Sequence[float], name: str) -> tk.terms.Function:
    value, jacobian, hessian = functions(f)
    return tk.terms.Function(value, jacobian, hessian, size=len(value(np.array(x))), name=name)


def box(n: int, lower: float, upper: float = inf) -> tuple[tuple[float, float], ...]:
    return ((lower, upper),) * n


def rosenbrock(a: Jet, b: Jet) -> Jet:
    return 100 * (b - a**2) ** 2 + (1 - a) ** 2


HALF = (-0.5, 0.5)
R3 = sqrt(3)


def sphere_and_products(a: Jet, b: Jet, c: Jet, d: Jet, e: Jet) -> list[Jet]:
    squares = a**2 + b**2 + c**2 + d**2 + e**2
    return [squares - 10, b * c - 5 * d * e, a**3 + b**3 + 1]


# fmt: off
PROBLEMS = [
    HS(1, rosenbrock, (-2, 1), 0.0, bounds=((-inf, inf), (-1.5, inf))),
    HS(3, lambda a, b: b + 1e-5 * (b - a)**2, (10, 1), 0.0, bounds=((-inf, inf), (0, inf))),
    HS(4, lambda a, b: (a + 1)**3 / 3 + b, (1.125, 0.125), 8 / 3, bounds=((1, inf), (0, inf))),
    HS(5, lambda a, b: sin(a + b) + (a - b)**2 - 1.5 * a + 2.5 * b + 1, (0, 0), -R3 / 2 - pi / 3,
       bounds=((-1.5, 4), (-3, 3))),
    HS(6, lambda a, b: (1 - a)**2, (-1.2, 1), 0.0, equal=lambda a, b: [10 * (b - a**2)]),
    HS(7, lambda a, b: jets.log(1 + a**2) - b, (2, 2), -R3,
       equal=lambda a, b: [(1 + a**2)**2 + b**2 - 4]),
    HS(8, lambda a, b: -1.0, (2, 1), -1.0, equal=lambda a, b: [a**2 + b**2 - 25, a * b - 9]),
    HS(9, lambda a, b: sin(pi / 12 * a) * cos(pi / 16 * b), (0, 0), -0.5,
       equal=lambda a, b: [4 * a - 3 * b]),
    HS(10, lambda a, b: a - b, (-10, 10), -1.0,
       at_least=lambda a, b: [1 - 3 * a**2 + 2 * a * b - b**2]),
    HS(11, lambda a, b: (a - 5)**2 + b**2 - 25, (4.9, 0.1), -8.498464223,
       at_least=lambda a, b: [b - a**2]),
    HS(12, lambda a, b: 0.5 * a**2 + b**2 - a * b - 7 * a - 7 * b, (0, 0), -30.0,
       at_least=lambda a, b: [25 - 4 * a**2 - b**2]),
    HS(14, lambda a, b: (a - 2)**2 + (b - 1)**2, (2, 2), 9 - 23 * sqrt(7) / 8,
       equal=lambda a, b: [a - 2 * b + 1], at_least=lambda a, b: [1 - 0.25 * a**2 - b**2]),
    HS(15, rosenbrock, (-2, 1), 306.5, at_least=lambda a, b: [a * b - 1, a + b**2],
       bounds=((-inf, 0.5), (-inf, inf))),
    HS(16, rosenbrock, (-2, 1), 0.25, at_least=lambda a, b: [a + b**2, a**2 + b],
       bounds=(HALF, (-inf, 1))),
    HS(17, rosenbrock, (-2, 1), 1.0, at_least=lambda a, b: [b**2 - a, a**2 - b],
       bounds=(HALF, (-inf, 1))),
    HS(18, lambda a, b: 0.01 * a**2 + b**2, (2, 2), 5.0,
       at_least=lambda a, b: [a * b - 25, a**2 + b**2 - 25], bounds=((2, 50), (0, 50))),
    HS(21, lambda a, b: 0.01 * a**2 + b**2 - 100, (-1, -1), -99.96,
       at_least=lambda a, b: [10 * a - b - 10], bounds=((2, 50), (-50, 50))),
    HS(22, lambda a, b: (a - 2)**2 + (b - 1)**2, (2, 2), 1.0,
       at_least=lambda a, b: [2 - a - b, b - a**2]),
    HS(23, lambda a, b: a**2 + b**2, (3, 1), 2.0, bounds=box(2, -50, 50),
       at_least=lambda a, b: [a + b - 1, a**2 + b**2 - 1, 9 * a**2 + b**2 - 9, a**2 - b, b**2 - a]),
    HS(24, lambda a, b: ((a - 3)**2 - 9) * b**3 / (27 * R3), (1, 0.5), -1.0, bounds=box(2, 0),
       at_least=lambda a, b: [a / R3 - b, a + R3 * b, 6 - a - R3 * b]),
    HS(26, lambda a, b, c: (a - b)**2 + (b - c)**4, (-2.6, 2, 2), 0.0,
       equal=lambda a, b, c: [(1 + b**2) * a + c**4 - 3]),
    HS(27, lambda a, b, c: 0.01 * (a - 1)**2 + (b - a**2)**2, (2, 2, 2), 0.04,
       equal=lambda a, b, c: [a + c**2 + 1]),
    HS(28, lambda a, b, c: (a + b)**2 + (b + c)**2, (-4, 1, 1), 0.0,
       equal=lambda a, b, c: [a + 2 * b + 3 * c - 1]),
    HS(29, lambda a, b, c: -a * b * c, (1, 1, 1), -16 * sqrt(2),
       at_least=lambda a, b, c: [48 - a**2 - 2 * b**2 - 4 * c**2]),
    HS(30, lambda a, b, c: a**2 + b**2 + c**2, (1, 1, 1), 1.0,
       at_least=lambda a, b, c: [a**2 + b**2 - 1], bounds=((1, 10), (-10, 10), (-10, 10))),
    HS(31, lambda a, b, c: 9 * a**2 + b**2 + 9 * c**2, (1, 1, 1), 6.0,
       at_least=lambda a, b, c: [a * b - 1], bounds=((-10, 10), (1, 10), (-10, 1))),
    HS(32, lambda a, b, c: (a + 3 * b + c)**2 + 4 * (a - b)**2, (0.1, 0.7, 0.2), 1.0,
       equal=lambda a, b, c: [1 - a - b - c], bounds=box(3, 0),
       at_least=lambda a, b, c: [6 * b + 4 * c - a**3 - 3]),
    HS(34, lambda a, b, c: -a, (0, 1.05, 2.9), -log(log(10)),
       at_least=lambda a, b, c: [b - exp(a), c - exp(b)], bounds=((0, 100), (0, 100), (0, 10))),
    HS(35, lambda a, b, c: 9 - 8 * a - 6 * b - 4 * c + 2 * a**2 + 2 * b**2 + c**2 + 2 * a * b
       + 2 * a * c, (0.5, 0.5, 0.5), 1 / 9, at_least=lambda a, b, c: [3 - a - b - 2 * c],
       bounds=box(3, 0)),
    HS(36, lambda a, b, c: -a * b * c, (10, 10, 10), -3300.0,
       at_least=lambda a, b, c: [72 - a - 2 * b - 2 * c], bounds=((0, 20), (0, 11), (0, 42))),
    HS(37, lambda a, b, c: -a * b * c, (10, 10, 10), -3456.0, bounds=box(3, 0, 42),
       at_least=lambda a, b, c: [72 - a - 2 * b - 2 * c, a + 2 * b + 2 * c]),
    HS(38, lambda a, b, c, d: rosenbrock(a, b) + 90 * (d - c**2)**2 + (1 - c)**2
       + 10.1 * ((b - 1)**2 + (d - 1)**2) + 19.8 * (b - 1) * (d - 1), (-3, -1, -3, -1), 0.0,
       bounds=box(4, -10, 10)),
    HS(39, lambda a, b, c, d: -a, (2, 2, 2, 2), -1.0,
       equal=lambda a, b, c, d: [b - a**3 - c**2, a**2 - b - d**2]),
    HS(40, lambda a, b, c, d: -a * b * c * d, (0.8,) * 4, -0.25,
       equal=lambda a, b, c, d: [a**3 + b**2 - 1, a**2 * d - c, d**2 - b]),
    HS(41, lambda a, b, c, d: 2 - a * b * c, (2, 2, 2, 2), 52 / 27,
       equal=lambda a, b, c, d: [a + 2 * b + 2 * c - d], bounds=(*box(3, 0, 1), (0, 2))),
    HS(42, lambda a, b, c, d: (a - 1)**2 + (b - 2)**2 + (c - 3)**2 + (d - 4)**2, (1, 1, 1, 1),
       28 - 10 * sqrt(2), equal=lambda a, b, c, d: [a - 2, c**2 + d**2 - 2]),
    HS(43, lambda a, b, c, d: a**2 + b**2 + 2 * c**2 + d**2 - 5 * a - 5 * b - 21 * c + 7 * d,
       (0, 0, 0, 0), -44.0, at_least=lambda a, b, c, d: [
           8 - a**2 - b**2 - c**2 - d**2 - a + b - c + d,
           10 - a**2 - 2 * b**2 - c**2 - 2 * d**2 + a + d,
           5 - 2 * a**2 - b**2 - c**2 - 2 * a + b + d]),
    HS(44, lambda a, b, c, d: a - b - c - a * c + a * d + b * c - b * d, (0, 0, 0, 0), -15.0,
       at_least=lambda a, b, c, d: [8 - a - 2 * b, 12 - 4 * a - b, 12 - 3 * a - 4 * b,
                                    8 - 2 * c - d, 8 - c - 2 * d, 5 - c - d], bounds=box(4, 0)),
    HS(45, lambda a, b, c, d, e: 2 - a * b * c * d * e / 120, (2,) * 5, 1.0,
       bounds=tuple((0, i) for i in range(1, 6))),
    HS(48, lambda a, b, c, d, e: (a - 1)**2 + (b - c)**2 + (d - e)**2, (3, 5, -3, 2, -2), 0.0,
       equal=lambda a, b, c, d, e: [a + b + c + d + e - 5, c - 2 * (d + e) + 3]),
    HS(50, lambda a, b, c, d, e: (a - b)**2 + (b - c)**2 + (c - d)**4 + (d - e)**2,
       (35, -31, 11, 5, -5), 0.0,
       equal=lambda a, b, c, d, e: [a + 2 * b + 3 * c - 6, b + 2 * c + 3 * d - 6,
                                    c + 2 * d + 3 * e - 6]),
    HS(51, lambda a, b, c, d, e: (a - b)**2 + (b + c - 2)**2 + (d - 1)**2 + (e - 1)**2,
       (2.5, 0.5, 2, -1, 0.5), 0.0,
       equal=lambda a, b, c, d, e: [a + 3 * b - 4, c + d - 2 * e, b - e]),
    HS(52, lambda a, b, c, d, e: (4 * a - b)**2 + (b + c - 2)**2 + (d - 1)**2 + (e - 1)**2,
       (2,) * 5, 1859 / 349, equal=lambda a, b, c, d, e: [a + 3 * b, c + d - 2 * e, b - e]),
    HS(53, lambda a, b, c, d, e: (a - b)**2 + (b + c - 2)**2 + (d - 1)**2 + (e - 1)**2,
       (2,) * 5, 176 / 43, equal=lambda a, b, c, d, e: [a + 3 * b, c + d - 2 * e, b - e],
       bounds=box(5, -10, 10)),
    HS(63, lambda a, b, c: 1000 - a**2 - 2 * b**2 - c**2 - a * b - a * c, (2, 2, 2), 961.7151721,
       equal=lambda a, b, c: [8 * a + 14 * b + 7 * c - 56, a**2 + b**2 + c**2 - 25],
       bounds=box(3, 0)),
    HS(64, lambda a, b, c: 5 * a + 50000 / a + 20 * b + 72000 / b + 10 * c + 144000 / c,
       (1, 1, 1), 6299.842428, at_least=lambda a, b, c: [1 - 4 / a - 32 / b - 120 / c],
       bounds=box(3, 1e-5)),
    HS(65, lambda a, b, c: (a - b)**2 + (a + b - 10)**2 / 9 + (c - 5)**2, (-5, 5, 0), 0.9535288567,
       at_least=lambda a, b, c: [48 - a**2 - b**2 - c**2],
       bounds=((-4.5, 4.5), (-4.5, 4.5), (-5, 5))),
    HS(66, lambda a, b, c: 0.2 * c - 0.8 * a, (0, 1.05, 2.9), 0.5181632741,
       at_least=lambda a, b, c: [b - exp(a), c - exp(b)], bounds=((0, 100), (0, 100), (0, 10))),
    HS(71, lambda a, b, c, d: a * d * (a + b + c) + c, (1, 5, 5, 1), 17.0140173,
       equal=lambda a, b, c, d: [a**2 + b**2 + c**2 + d**2 - 40],
       at_least=lambda a, b, c, d: [a * b * c * d - 25], bounds=box(4, 1, 5)),
    HS(76, lambda a, b, c, d: a**2 + 0.5 * b**2 + c**2 + 0.5 * d**2 - a * c + c * d - a - 3 * b
       + c - d, (0.5,) * 4, -103 / 22, bounds=box(4, 0),
       at_least=lambda a, b, c, d: [5 - a - 2 * b - c - d, 4 - 3 * a - b - 2 * c + d,
                                    b + 4 * c - 1.5]),
    HS(78, lambda a, b, c, d, e: a * b * c * d * e, (-2, 1.5, 2, -1, -1), -2.91970041,
       equal=sphere_and_products),
    HS(80, lambda a, b, c, d, e: exp(a * b * c * d * e), (-2, 2, 2, -1, -1), 0.0539498478,
       equal=sphere_and_products, bounds=(*box(2, -2.3, 2.3), *box(3, -3.2, 3.2))),
    HS(100, lambda a, b, c, d, e, f, g: (a - 10)**2 + 5 * (b - 12)**2 + c**4 + 3 * (d - 11)**2
       + 10 * e**6 + 7 * f**2 + g**4 - 4 * f * g - 10 * f - 8 * g, (1, 2, 0, 4, 0, 1, 1),
       680.6300573, at_least=lambda a, b, c, d, e, f, g: [
           127 - 2 * a**2 - 3 * b**4 - c - 4 * d**2 - 5 * e,
           282 - 7 * a - 3 * b - 10 * c**2 - d + e, 196 - 23 * a - b**2 - 6 * f**2 + 8 * g,
           -4 * a**2 - b**2 + 3 * a * b - 2 * c**2 - 5 * f + 11 * g]),
    HS(113, lambda a, b, c, d, e, f, g, h, i, j: a**2 + b**2 + a * b - 14 * a - 16 * b
       + (c - 10)**2 + 4 * (d - 5)**2 + (e - 3)**2 + 2 * (f - 1)**2 + 5 * g**2 + 7 * (h - 11)**2
       + 2 * (i - 10)**2 + (j - 7)**2 + 45, (2, 3, 5, 5, 1, 2, 7, 3, 6, 10), 24.3062091,
       at_least=lambda a, b, c, d, e, f, g, h, i, j: [
           105 - 4 * a - 5 * b + 3 * g - 9 * h, -10 * a + 8 * b + 17 * g - 2 * h,
           8 * a - 2 * b - 5 * i + 2 * j + 12,
           -3 * (a - 2)**2 - 4 * (b - 3)**2 - 2 * c**2 + 7 * d + 120,
           -5 * a**2 - 8 * b - (c - 6)**2 + 2 * d + 40,
           -0.5 * (a - 8)**2 - 2 * (b - 4)**2 - 3 * e**2 + f + 30,
           -(a**2) - 2 * (b - 2)**2 + 2 * a * b - 14 * e + 6 * f,
           3 * a - 6 * b - 12 * (i - 8)**2 + 7 * j]),
]
# fmt: on
