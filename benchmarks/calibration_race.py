"""Calibration of a UR10 beside SciPy's least squares: the same residuals, the same optimum.

    python benchmarks/calibration_race.py [--runs 9]

100 postures, full poses, noise of 0.2 mm and 0.2 mrad, covariance known, no robust loss; base, tool
and all Denavit-Hartenberg numbers. SciPy gets the residual in vectorized numpy, our
start for base and tool, our weak knowledge of each parameter (so that its problem has full rank),
and either its own differences or exact derivatives from our geometric Jacobian's columns. The two
optima are compared by what they predict. One process, turns taken, medians.
"""

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

import thing_kin as tk
from thing_kin import estimation as est
from timing import pin_to_one_cpu

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from calibration_cases import rows_of, simulated

Array = Any
SIGMA = 2e-4
COVARIANCE = np.diag([SIGMA**2] * 6)
NAMES = ("d", "theta", "a", "alpha")


def rz_tz(theta: Array, d: Array) -> Array:
    c, s = np.cos(theta), np.sin(theta)
    T = np.zeros((*np.shape(theta), 4, 4))
    T[..., 0, 0], T[..., 0, 1], T[..., 1, 0], T[..., 1, 1] = c, -s, s, c
    T[..., 2, 2] = T[..., 3, 3] = 1
    T[..., 2, 3] = d
    return T


def rx_tx(alpha: float, a: float) -> Array:
    T = tk.transform(rpy=(alpha, 0, 0))
    T[0, 3] = a
    return T


class Numpy:
    """x: base (t, r), tool (t, r), then d, theta, a, alpha for each row."""

    def __init__(self, case: Any, start: Any) -> None:
        self.case, self.rows = case, rows_of(case.nominal)
        self.base, self.tool = start.base, start.tool
        deviations = [10.0] * 12 + [0.02, 0.05, 0.02, 0.05] * 6
        self.weak = np.diag(1 / np.array(deviations))

    def walk(self, x: Array) -> tuple[Array, list[tuple[Array, Array, bool]]]:
        """Poses, and axis, point and kind of each parameter's motion."""
        q = self.case.q
        screws = []

        def motion(T: Array, part: Array, after: bool) -> Array:
            E = np.eye(4)
            E[:3, 3], E[:3, :3] = part[:3], Rotation.from_rotvec(part[3:]).as_matrix()
            moved = T @ E
            turns = T[..., :3, :3] @ tk.lie.so3_left_jacobian(part[3:])
            for k in range(3):
                screws.append((T[..., :3, k], moved[..., :3, 3], False))
            for k in range(3):
                screws.append((turns[..., :, k], moved[..., :3, 3], True))
            return moved

        T = motion(np.broadcast_to(self.base, (len(q), 4, 4)), x[:6], False)
        tool_at = []
        for i, row in enumerate(self.rows):
            d, theta, a, alpha = x[12 + 4 * i : 16 + 4 * i]
            z, o = T[:, :3, 2], T[:, :3, 3]
            T = T @ rz_tz(q[:, i] + row["theta"] + theta, np.full(len(q), row["d"] + d))
            T = T @ rx_tx(row["alpha"] + alpha, row["a"] + a)
            tool_at += [(z, o, False), (z, o, True)]
            tool_at += [(T[:, :3, 0], T[:, :3, 3], False), (T[:, :3, 0], T[:, :3, 3], True)]
        T = motion(T, x[6:12], True) @ self.tool
        return T, screws + tool_at

    def residuals(self, x: Array) -> Array:
        T, _ = self.walk(x)
        R = self.case.measured[:, :3, :3] @ T[:, :3, :3].transpose(0, 2, 1)
        e = np.hstack(
            [self.case.measured[:, :3, 3] - T[:, :3, 3], Rotation.from_matrix(R).as_rotvec()]
        )
        return np.concatenate([(e / SIGMA).ravel(), self.weak @ x])

    def jacobian(self, x: Array) -> Array:
        T, screws = self.walk(x)
        p = T[:, :3, 3]
        J = np.zeros((len(p), 6, len(x)))
        for i, (axis, point, turns) in enumerate(screws):
            J[:, :3, i] = -np.cross(axis, p - point) if turns else -axis
            J[:, 3:, i] = -axis if turns else 0.0
        R = self.case.measured[:, :3, :3] @ T[:, :3, :3].transpose(0, 2, 1)
        turn = tk.lie.so3_right_jacobian_inverse(Rotation.from_matrix(R).as_rotvec())
        J[:, 3:] = turn @ J[:, 3:]
        return np.vstack([J.reshape(-1, len(x)) / SIGMA, self.weak])


def timed(call: Callable[[], Any]) -> tuple[float, Any]:
    start = time.perf_counter()
    result = call()
    return 1e3 * (time.perf_counter() - start), result


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--runs", type=int, default=9)
    runs = parser.parse_args().runs
    pin_to_one_cpu()
    case = simulated(0, postures=100)
    start = est.calibrate(case.nominal, case.q, case.measured, parameters=("base", "tool"))
    numpy = Numpy(case, start)
    x = np.zeros(36)
    options = {"x_scale": "jac", "method": "trf"}
    four = {"dh[1].beta": 0.0, "dh[2].beta": 0.0}
    given = {"parameters": ("base", "tool", "dh"), "priors": four}
    known = {**given, "covariance": COVARIANCE, "loss": "linear"}
    seen = (case.nominal, case.q, case.measured)
    contenders: dict[str, Callable[[], Any]] = {
        "ours, covariance known": lambda: est.calibrate(*seen, **known),
        "ours, noise estimated": lambda: est.calibrate(*seen, **given, loss="linear"),
        "ours, noise estimated, Cauchy": lambda: est.calibrate(*seen, **given),
        "SciPy, exact derivatives": lambda: least_squares(
            numpy.residuals, x, jac=numpy.jacobian, **options
        ),
        "SciPy, differences": lambda: least_squares(numpy.residuals, x, **options),
    }
    times: dict[str, list[float]] = {name: [] for name in contenders}
    found = {}
    for _ in range(runs):
        for name, call in contenders.items():
            took, found[name] = timed(call)
            times[name].append(took)
    ours = found["ours, covariance known"].predict(case.q)
    theirs, _ = numpy.walk(found["SciPy, exact derivatives"].x)
    print(f"largest difference of predicted places: {np.abs(ours - theirs).max():.1e} m")
    for name, each in times.items():
        print(f"{name:32} median {np.median(each):8.2f} ms, least {min(each):8.2f} ms")


if __name__ == "__main__":
    main()
