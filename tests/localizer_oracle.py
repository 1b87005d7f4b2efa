"""The localizer's model in plain numpy: the whole record at once, nothing kept, nothing clever."""

import cmath
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from thing_kin import estimation as est

Array = NDArray[np.float64]
ORDER = {"twist": 0, "pose": 1, "relative": 1, "yaw": 1}
TAIL = {"relative": 1, "pose": 0, "yaw": 2}


@dataclass(frozen=True)
class Measured:
    kind: str
    t: float
    source: str
    z: Array
    R: Array
    t_from: float = 0.0
    rows: tuple[int, ...] = (0, 1, 2)

    def key(self) -> tuple:
        values = (self.t_from, *self.z, *self.R.ravel())
        return (self.t, ORDER[self.kind], self.source, TAIL.get(self.kind, 0), *values)

    def give(self, localizer: est.BaseLocalizer) -> bool:
        if self.kind == "twist" and self.rows == (2,):
            return localizer.add_yaw_rate(self.t, self.z[2], self.R[2, 2], source=self.source)
        if self.kind == "twist":
            return localizer.add_twist(self.t, self.z, self.R, source=self.source)
        if self.kind == "pose":
            return localizer.add_pose(self.t, self.z, self.R, source=self.source)
        if self.kind == "yaw":
            return localizer.add_yaw(self.t, self.z[2], self.R[2, 2], source=self.source)
        return localizer.add_relative_pose(self.t_from, self.t, self.z, self.R, source=self.source)


def wrap(angle: float) -> float:
    return float(np.arctan2(np.sin(angle), np.cos(angle)))


def rot(theta: float) -> Array:
    return np.array([[np.cos(theta), -np.sin(theta)], [np.sin(theta), np.cos(theta)]])


def moved(pose: Array, xi: Array) -> Array:
    """The pose after the motion xi: in the complex plane, v (exp(i w) - 1)/(i w) is the way."""
    x, y, theta = pose
    vx, vy, w = xi
    turn = 1j * w
    mean = 1 + turn / 2 + turn**2 / 6 + turn**3 / 24 if abs(w) < 1e-4 else cmath.exp(turn) - 1
    step = cmath.exp(1j * theta) * (vx + 1j * vy) * (mean if abs(w) < 1e-4 else mean / turn)
    return np.array([x + step.real, y + step.imag, theta + w])


def seen(past: Array, pose: Array) -> Array:
    return np.array([*(rot(past[2]).T @ (pose[:2] - past[:2])), pose[2] - past[2]])


def numeric(f, x: Array, h: float = 1e-5) -> Array:
    """Central differences."""
    steps = h * np.eye(len(x))
    return np.stack([(f(x + d) - f(x - d)) / (2 * h) for d in steps], axis=1)


def linearized(f, x: Array, P: Array, filter: str) -> tuple[Array, Array, Array]:
    """Mean, slope and what is left over: by the Jacobian, or by 2 n sigma points."""
    n = len(x)
    if filter == "ekf" or not P.any():
        return f(x), numeric(f, x), np.zeros((3, 3))
    order = [2, 0, 1, *range(3, n)]  # heading first
    L = np.zeros((n, n))
    L[order] = np.linalg.cholesky(P[np.ix_(order, order)])
    offsets = np.sqrt(n) * np.concatenate([L.T, -L.T])
    y = np.array([f(x + d) for d in offsets])
    mean = y.mean(axis=0)
    A = np.linalg.lstsq(offsets, y - mean, rcond=None)[0].T
    rest = y - mean - offsets @ A.T
    return mean, A, rest.T @ rest / (2 * n)


@dataclass
class Oracle:
    """A joint Gaussian of the present pose and of the past ones that are still needed."""

    pose: Array
    P: Array
    Q: Array
    filter: str = "ekf"
    gate: float = 0.999
    t0: float | None = None
    history: float = np.inf
    accepted: dict[str, int] = field(default_factory=dict)
    rejected: dict[str, int] = field(default_factory=dict)

    def run(self, record: list[Measured], until: float) -> "Oracle":
        record = sorted(record, key=Measured.key)
        motions = [m for m in record if m.kind == "relative"]
        times = sorted({m.t for m in record} | {m.t_from for m in motions})
        origin = times[0] if self.t0 is None else self.t0
        self.x, self.joint, self.clones = self.pose.astype(float), self.P.copy(), []
        a = origin
        for b in [*(t for t in times if t <= until), until]:
            if b > a:
                self.predict(record, a, b, origin)
            if b in times and not (b == until and a == until):
                for m in record:
                    if m.t == b and m.kind != "twist":
                        self.update(m)
                    elif m.t == b:
                        self.accepted[m.source] = self.accepted.get(m.source, 0) + 1
                for m in motions:
                    if m.t_from == b:
                        self.clone(m)
            a = b
        self.x[2] = wrap(self.x[2])
        return self

    def predict(self, record: list[Measured], a: float, b: float, origin: float) -> None:
        twist, covariance = self.twist(record, a, b, origin)
        d = b - a
        xi, now = twist * d, self.x[:3].copy()
        mean, A, rest = linearized(lambda p: moved(p, xi), now, self.joint[:3, :3], self.filter)
        G = numeric(lambda v: moved(now, v), xi)
        end, middle = moved(now, xi), moved(now, xi / 2)
        noise = np.zeros((3, 3))
        for weight, start in ((1, now), (4, middle), (1, end)):
            F = np.eye(3)
            F[:2, 2] = [start[1] - end[1], end[0] - start[0]]
            noise += weight / 6 * F @ (self.Q * d) @ F.T
        big = np.eye(len(self.joint))
        big[:3, :3] = A
        self.joint = big @ self.joint @ big.T
        self.joint[:3, :3] += rest + G @ covariance @ G.T + noise
        self.x[:3] = mean

    def twist(self, record: list[Measured], a: float, b: float, origin: float):
        """Weighted least squares over what the sources say of (a, b]."""
        said = []
        for name in {m.source for m in record if m.kind == "twist"}:
            mine = [m for m in record if m.kind == "twist" and m.source == name]
            before = [m for m in mine if m.t <= a]
            after = [m for m in mine if m.t > a]
            if before and after:
                T = after[0].t - before[-1].t
                said.append((2, after[0], T, T * (b - a)))
            elif before:
                m = before[-1]
                T = m.t - (before[-2].t if len(before) > 1 else origin)
                s = (b - m.t) ** 2 - (a - m.t) ** 2
                said.append((1, m, max(T, (a - m.t) + (b - m.t)), s))
            elif after:
                T = after[0].t - origin
                said.append((0, after[0], T, T * (b - a)))
        rows, values, weights, scale = [], [], [], []
        for k in range(3):
            best = max((rank for rank, m, *_ in said if k in m.rows), default=None)
            rows += [(i, k) for i, (rank, m, *_) in enumerate(said) if k in m.rows and rank == best]
        rows.sort()
        if not rows:
            return np.zeros(3), np.zeros((3, 3))
        H = np.array([np.eye(3)[k] for _, k in rows])
        values = np.array([said[i][1].z[k] for i, k in rows])
        weights = np.zeros((len(rows), len(rows)))
        scale = np.zeros_like(weights)
        for p, (i, k) in enumerate(rows):
            for q, (j, n) in enumerate(rows):
                if i == j:
                    weights[p, q] = said[i][1].R[k, n] * said[i][2]
                    scale[p, q] = said[i][1].R[k, n] * said[i][3]
        W = np.linalg.inv(weights)
        gain = np.linalg.pinv(H.T @ W @ H) @ H.T @ W
        return gain @ values, gain @ scale @ gain.T

    def update(self, m: Measured) -> None:
        rows = list(m.rows)
        n = len(self.x)
        if m.kind == "relative":
            k = next((k for k, c in enumerate(self.clones) if c is m), None)
            if k is None:
                self.rejected[m.source] = self.rejected.get(m.source, 0) + 1
                return
            at = [3 + 3 * k, 4 + 3 * k, 5 + 3 * k, 0, 1, 2]
            expected, A, rest = linearized(
                lambda s: seen(s[:3], s[3:]), self.x[at], self.joint[np.ix_(at, at)], self.filter
            )
            H = np.zeros((3, n))
            H[:, at] = A
        else:
            expected, rest = self.x[:3], np.zeros((3, 3))
            H = np.eye(3, n)
        r = m.z - expected
        r[2] = wrap(r[2])
        S = (H @ self.joint @ H.T + m.R + rest)[np.ix_(rows, rows)]
        nis = r[rows] @ np.linalg.solve(S, r[rows])
        good = self.gate >= 1 or nis <= chi2.ppf(self.gate, len(rows))
        verdicts = self.accepted if good else self.rejected
        verdicts[m.source] = verdicts.get(m.source, 0) + 1
        if good:
            K = self.joint @ H[rows].T @ np.linalg.inv(S)
            self.x = self.x + K @ r[rows]
            self.joint = self.joint - K @ S @ K.T
        if m.kind == "relative":
            keep = [i for i in range(n) if i not in (3 + 3 * k, 4 + 3 * k, 5 + 3 * k)]
            self.x, self.joint = self.x[keep], self.joint[np.ix_(keep, keep)]
            del self.clones[k]

    def clone(self, m: Measured) -> None:
        n = len(self.x)
        J = np.vstack([np.eye(n), np.eye(3, n)])
        self.x, self.joint = J @ self.x, J @ self.joint @ J.T
        self.clones.append(m)


def drawn(rng: np.random.Generator, seconds: float, *, motions: bool = True) -> list[Measured]:
    """A drive that several sources follow: wheels, a gyro, a compass, poses and motions."""

    def covariance(scale: float) -> Array:
        A = rng.normal(size=(3, 3))
        return scale * (A @ A.T + 3 * np.eye(3))

    twist = np.array([0.5, 0.1, 0.4])
    record = []
    steps = round(seconds * 32)  # stamps in binary fractions: sums are exact
    for k in range(1, steps + 1):
        t = k / 32
        if k % 2 == 0:
            R = covariance(1e-3)
            z = twist + rng.multivariate_normal(np.zeros(3), R)
            record.append(Measured("twist", t, "wheels", z, R))
        if k % 3 == 0 and k > steps // 4:
            z = np.array([0, 0, twist[2] + rng.normal(0, 0.01)])
            R = np.diag([1, 1, 1e-4])
            record.append(Measured("twist", t, "gyro", z, R, rows=(2,)))
        if k % 7 == 0:
            z = moved(np.zeros(3), twist * t) + rng.normal(0, 0.05, 3)
            record.append(Measured("pose", t, "lidar", z, covariance(5e-4)))
        if k % 11 == 0:
            yaw = wrap(twist[2] * t + rng.normal(0, 0.05))
            R = np.diag([1, 1, 2.5e-3])
            record.append(Measured("yaw", t, "compass", np.array([0, 0, yaw]), R, rows=(2,)))
        if motions and k % 5 == 0 and k > 8:
            z = moved(np.zeros(3), twist * 8 / 32) + rng.normal(0, 0.01, 3)
            record.append(Measured("relative", t, "scan", z, covariance(1e-4), t - 8 / 32))
    return record


def at_other_times(record: list[Measured], shift: float) -> list[Measured]:
    return [replace(m, t=m.t + shift, t_from=m.t_from + shift) for m in record]
