"""Mecanum wheels beside motion capture: identification and dead reckoning on a real record.

    python benchmarks/mecanum_record.py WHEELS.csv[.gz] OPTITRACK.csv[.gz] [--out FIGURE.png]

The records are those of davide-giacomini/omnidirectional-robot-odometry: the wheels' are
t, four encoder counts, four motor speeds (rad per minute), the wheels in the order fl, fr, rl, rr;
the reference's are t, x, y, z, qx, qy, qz, qw. Both by one clock.

Errors are of position, root mean square over all stamps of the wheels. "nominal" begins at the
first captured pose; "unaligned" at its place with the yaw that identification finds; "aligned"
where the whole path fits best. All with the radius identified but the first.
"""

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import thing_kin as tk
from thing_kin import estimation as est

Array = NDArray[np.float64]
ORDER = ("fl", "fr", "rl", "rr")
RADIUS, K = 0.07, 0.369  # nominal, m
TICKS_PER_MOTOR_TURN, GEAR = 42, 5
CHI_SQUARE = {2: 5.991, 3: 7.815}  # 95 %


@dataclass(frozen=True)
class Record:
    """Wheel angles by two ways, and the reference, whose yaw is unwrapped."""

    t: Array
    angles: dict[str, Array]
    t_reference: Array
    poses: Array

    def reference_at(self, t: Array) -> Array:
        return np.stack([np.interp(t, self.t_reference, c) for c in self.poses.T], axis=1)


def yaw_of(quaternions: Array) -> Array:
    """Of rows (x, y, z, w)."""
    x, y, z, w = quaternions.T
    return np.unwrap(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))


def read(wheels: Path, reference: Path) -> Record:
    w = np.loadtxt(wheels, delimiter=",", skiprows=1)
    o = np.loadtxt(reference, delimiter=",", skiprows=1)
    t = w[:, 0]
    speeds = w[1:, 5:] / 60 / GEAR  # rad/s of the wheel, mean since the stamp before
    integrals = np.cumsum(speeds * np.diff(t)[:, None], axis=0)
    angles = {
        "ticks": est.angles_from_ticks(w[:, 1:5], TICKS_PER_MOTOR_TURN * GEAR),
        "speed": np.vstack([np.zeros(4), integrals]),
    }
    poses = np.column_stack([o[:, 1:3], yaw_of(o[:, 4:])])
    return Record(t, angles, o[:, 0], poses)


def rms(poses: Array, reference: Array) -> float:
    return float(np.sqrt(np.mean(np.sum((poses - reference)[:, :2] ** 2, axis=1))))


def nominal_error(record: Record, source: str, covered: Array) -> float:
    nominal = est.MecanumOdometry(RADIUS, K, ORDER)
    path = nominal.integrate_angles(record.t, record.angles[source], record.poses[0]).poses
    return rms(path[covered], record.reference_at(record.t)[covered])


@dataclass(frozen=True)
class Judged:
    found: Any
    path: Any  # dead reckoning from found.start, with the slip that was identified
    errors: Array
    nees: Array
    figures: dict[str, float]


def judge(record: Record, source: str) -> Judged:
    t, angles = record.t, record.angles[source]
    found = est.identify_mecanum(
        t, angles, record.t_reference, record.poses, ORDER, wheel_radius=RADIUS, k=K
    )
    seen = record.reference_at(t)
    covered = (t >= record.t_reference[0]) & (t <= record.t_reference[-1])

    def error_from(pose: Array, odometry: Any) -> float:
        path = odometry.integrate_angles(t, angles, pose).poses
        return rms(tk.lie.se2_compose(path, found.mount)[covered], seen[covered])

    begun = (t - t[0]) >= found.start_time - t[0]
    path = found.odometry.integrate_angles(
        t[begun],
        angles[begun],
        found.start,
        # Where on the robot the captured body is does not matter: it is compared with itself.
        np.diag(found.reference_std**2 + [0.0, 0.0, found.covariance[4, 4]]),
        slip_variance=found.slip_variance,
    )
    errors = est.pose_difference(tk.lie.se2_compose(path.poses, found.mount), seen[begun])
    # A single captured pose is noisier than the median of a window.
    noise = np.diag([1e-3, 1e-3, 1.2e-2]) ** 2
    nees = np.einsum("ni,nij,nj->n", errors, np.linalg.inv(path.covariances + noise), errors)
    figures = {
        "nominal": nominal_error(record, source, covered),
        "unaligned": error_from(found.initial_pose, found.odometry),
        "aligned": error_from(found.aligned_pose, found.odometry),
        "fraction of NEES inside": float(np.mean(nees < CHI_SQUARE[3])),
    }
    return Judged(found, path, errors, nees, figures)


def plot(record: Record, judged: dict[str, Judged], out: Path) -> None:
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 3, figsize=(15, 4.8), constrained_layout=True)
    covered = (record.t >= record.t_reference[0]) & (record.t <= record.t_reference[-1])
    seen = record.reference_at(record.t)[covered]
    axes[0].plot(*seen[:, :2].T, color="black", lw=2.5, alpha=0.5, label="motion capture")
    for source, color in (("ticks", "tab:blue"), ("speed", "tab:orange")):
        here = judged[source]
        angles = record.angles[source]
        for pose, style, label in (
            (here.found.initial_pose, "--", "yaw identified"),
            (here.found.aligned_pose, "-", "aligned"),
        ):
            path = here.found.odometry.integrate_angles(record.t, angles, pose).poses[covered]
            path = tk.lie.se2_compose(path, here.found.mount)
            axes[0].plot(*path[:, :2].T, style, color=color, lw=1, label=f"{source}, {label}")
        seconds = record.t[len(record.t) - len(here.nees) :] - record.t[0]
        distance = np.hypot(*here.errors[:, :2].T)
        band = 2 * np.sqrt(here.path.covariances[:, 0, 0] + here.path.covariances[:, 1, 1])
        axes[1].plot(seconds, 1e3 * distance, color=color, lw=1, label=f"{source}, error")
        axes[1].plot(seconds, 1e3 * band, "--", color=color, lw=1, label=f"{source}, 2 sigma")
        axes[2].semilogy(seconds, here.nees, color=color, lw=0.7, label=source)
    axes[0].set(xlabel="x [m]", ylabel="y [m]", title="Path", aspect="equal")
    axes[1].set(xlabel="time [s]", ylabel="position [mm]", title="Dead reckoning from the start")
    axes[2].axhline(CHI_SQUARE[3], color="black", lw=1, label="95 % bound, 3 degrees")
    axes[2].set(xlabel="time [s]", ylabel="NEES", title="Error over its covariance")
    for axis in axes:
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.savefig(out, dpi=130)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("wheels", type=Path)
    parser.add_argument("reference", type=Path)
    parser.add_argument("--out", type=Path, help="where the figure goes")
    arguments = parser.parse_args()
    record = read(arguments.wheels, arguments.reference)
    judged = {source: judge(record, source) for source in record.angles}
    for source, here in judged.items():
        print(f"--- {source}\n{here.found.report()}")
        print("rms over all stamps [m]:", {k: round(v, 4) for k, v in here.figures.items()})
    if arguments.out:
        plot(record, judged, arguments.out)


if __name__ == "__main__":
    main()
