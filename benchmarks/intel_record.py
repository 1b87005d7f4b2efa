"""LIDAR odometry on a real building: errors against hand-corrected relations, maps to look at.

    python benchmarks/intel_record.py INTEL.npz [--increment 1deg|pi/179] [--out FIGURE.png]

The record is the Intel Research Lab's (D. Hähnel, Radish): 180 beams from -90 degrees. Its order
is the order of the drive; stamps only look up the relations of Kümmerle et al. 2009, those whose
two stamps are both met within a millisecond: 350. One that spans over 30 scans is long: 22.
"""

import argparse
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
# Scans (K, 180) and motions since the scan before (K, 3), if there are, to poses and statuses.
Odometer = Callable[[Array, Array | None], tuple[Array, list[str]]]
LONG = 30  # scans
INCREMENTS = {"1deg": np.pi / 180, "pi/179": np.pi / 179}
LOST = (0.5, np.radians(15))  # a step this far from the reference's own is a loss, whatever it says


def compose(a: Array, b: Array) -> Array:
    c, s = np.cos(a[..., 2]), np.sin(a[..., 2])
    x, y = a[..., 0] + c * b[..., 0] - s * b[..., 1], a[..., 1] + s * b[..., 0] + c * b[..., 1]
    return np.stack([x, y, a[..., 2] + b[..., 2]], axis=-1)


def between(a: Array, b: Array) -> Array:
    c, s = np.cos(a[..., 2]), np.sin(a[..., 2])
    dx, dy = b[..., 0] - a[..., 0], b[..., 1] - a[..., 1]
    turn = b[..., 2] - a[..., 2]
    turn = np.arctan2(np.sin(turn), np.cos(turn))
    return np.stack([c * dx + s * dy, c * dy - s * dx, turn], axis=-1)


def chained(motions: Array) -> Array:
    poses = [np.zeros(3)]
    for motion in motions[1:]:
        poses.append(compose(poses[-1], motion))
    return np.array(poses)


@dataclass(frozen=True)
class Record:
    """Stamped scans with their reference and relations (i, j, pose of j in i); raw scans."""

    ranges: Array
    reference: Array
    first: NDArray[np.int64]
    second: NDArray[np.int64]
    relations: Array
    raw_ranges: Array
    raw_odometry: Array
    angles: Array


def read(path: Path, increment: float) -> Record:
    data = np.load(path)
    stamps, relations = data["stamps"], data["relations"]
    order = np.argsort(stamps, kind="stable")
    at = np.empty((2, len(relations)), dtype=int)
    off = np.empty((2, len(relations)))
    for k in (0, 1):
        right = np.clip(np.searchsorted(stamps[order], relations[:, k]), 1, len(stamps) - 1)
        two = order[np.stack([right - 1, right])]
        away = np.abs(stamps[two] - relations[:, k])
        nearest = np.argmin(away, axis=0)
        at[k] = np.take_along_axis(two, nearest[None], axis=0)[0]
        off[k] = away.min(axis=0)
    met = (off <= 1e-3).all(axis=0)
    return Record(
        ranges=data["ranges"].astype(float),
        reference=data["reference_pose"],
        first=at[0, met],
        second=at[1, met],
        relations=relations[met, 2:],
        raw_ranges=data["raw_ranges"].astype(float),
        raw_odometry=data["raw_odometry"],
        angles=-np.pi / 2 + increment * np.arange(180),
    )


@dataclass(frozen=True)
class Judged:
    """Errors of all relations [m], which are long, and steps lost."""

    errors: Array
    turns: Array
    is_long: NDArray[np.bool_]
    lost: NDArray[np.int64]

    def figures(self) -> dict[str, float]:
        local, long = self.errors[~self.is_long], self.errors[self.is_long]
        return {
            "relations": len(self.errors),
            "mean": self.errors.mean(),
            "sd": self.errors.std(),
            "max": self.errors.max(),
            "local mean": local.mean(),
            "local max": local.max(),
            "long": len(long),
            "long mean": long.mean(),
            "long max": long.max(),
            "turn mean [deg]": np.degrees(self.turns.mean()),
            "steps lost": len(self.lost),
        }


def judge(record: Record, poses: Array) -> Judged:
    """Poses (K, 3) of the stamped scans, in any world, by the relations."""
    estimated = between(poses[record.first], poses[record.second])
    rest = between(record.relations, estimated)
    steps = between(poses[:-1], poses[1:])
    truth = between(record.reference[:-1], record.reference[1:])
    away = between(truth, steps)
    lost = (np.hypot(away[:, 0], away[:, 1]) > LOST[0]) | (np.abs(away[:, 2]) > LOST[1])
    return Judged(
        errors=np.hypot(rest[:, 0], rest[:, 1]),
        turns=np.abs(rest[:, 2]),
        is_long=np.abs(record.second - record.first) > LONG,
        lost=np.flatnonzero(lost) + 1,
    )


def points_of(ranges: Array, poses: Array, angles: Array, reach: float = 12.0) -> Array:
    """Of all returns nearer than reach, in the world of the poses: (N, 2)."""
    scan, beam = np.nonzero(np.isfinite(ranges) & (ranges < reach))
    heading = poses[scan, 2] + angles[beam]
    way = ranges[scan, beam]
    return poses[scan, :2] + way[:, None] * np.stack([np.cos(heading), np.sin(heading)], axis=1)


def occupied(points: Array, cell: float = 0.05) -> int:
    """Cells with at least two returns: the fewer, the crisper is the map of the same scans."""
    cells, counts = np.unique(np.floor(points / cell).astype(int), axis=0, return_counts=True)
    return int(np.sum(counts >= 2)) if len(cells) else 0


def loop_end(poses: Array) -> Array:
    """The last pose in the first: the robot came back to about where it began."""
    return between(poses[0], poses[-1])


def plot(maps: dict[str, tuple[Array, Array]], out: Path) -> None:
    """Points and path of each, side by side."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(
        1, len(maps), figsize=(6 * len(maps), 6), layout="constrained", squeeze=False
    )
    for (name, (points, poses)), axis in zip(maps.items(), axes[0], strict=True):
        axis.plot(*points.T, ",", color="black", alpha=0.25)
        axis.plot(*poses[:, :2].T, color="tab:blue", lw=0.6)
        axis.plot(*poses[0, :2], "o", color="tab:green", ms=5)
        axis.plot(*poses[-1, :2], "x", color="tab:red", ms=7)
        axis.set(title=name, aspect="equal", xlabel="x [m]", ylabel="y [m]")
    figure.savefig(out, dpi=90)


def laser_odometry(record: Record) -> Odometer:
    """Odometry of thing_kin, wheels as guess if there are."""
    from thing_kin import odometry

    def run(ranges: Array, motions: Array | None) -> tuple[Array, list[str]]:
        scanner = odometry.Scanner(
            angle_min=record.angles[0], angle_max=record.angles[-1], n=180, range_max=30.0
        )
        lidar = odometry.LaserOdometry(scanner)
        status = []
        for k, scan in enumerate(ranges):
            motion = None if motions is None or k == 0 else motions[k]
            status.append(lidar.add(scan, t=float(k), motion=motion).status)
        return lidar.poses, status

    return run


def evaluate(record: Record, odometer: Odometer, out: Path | None = None) -> Judged:
    """Print figures of the stamped scans and of the raw ones; draw both maps."""
    start = time.process_time()
    poses, status = odometer(record.ranges, None)
    took = (time.process_time() - start) / len(poses)
    judged = judge(record, poses)
    told = {s: status.count(s) for s in sorted(set(status))}
    print("stamped scans alone:", {k: round(float(v), 4) for k, v in judged.figures().items()})
    print(f"  {1e6 * took:.0f} µs a scan; says {told}; lost at {judged.lost.tolist()[:20]}")
    raw_poses, raw_status = odometer(record.raw_ranges, record.raw_odometry)
    told = {s: raw_status.count(s) for s in sorted(set(raw_status))}
    wheels = chained(record.raw_odometry)
    maps = {}
    for name, path in (("raw scans, odometry as guess", raw_poses), ("wheels alone", wheels)):
        points = points_of(record.raw_ranges, path, record.angles)
        maps[name] = (points, path)
        print(f"{name}: end seen from start {loop_end(path).round(3)}, {occupied(points)} cells")
    print(f"  says {told}")
    points = points_of(record.ranges, poses, record.angles)
    known = points_of(record.ranges, record.reference, record.angles)
    print(f"cells of the stamped scans: {occupied(points)}, by the reference {occupied(known)}")
    if out:
        plot({"stamped scans alone": (points, poses), **maps}, out)
    return judged


def default_record() -> Path:
    return Path(__file__).resolve().parents[2] / "shared" / "data" / "intel.npz"


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("record", type=Path, nargs="?", default=default_record())
    parser.add_argument("--increment", choices=INCREMENTS, default="1deg")
    parser.add_argument("--out", type=Path, help="where the figure goes")
    parser.add_argument("--reference", action="store_true", help="judge the reference instead")
    arguments = parser.parse_args()
    record = read(arguments.record, INCREMENTS[arguments.increment])
    if arguments.reference:
        figures = judge(record, record.reference).figures()
        print({k: round(float(v), 4) for k, v in figures.items()})
        return
    evaluate(record, laser_odometry(record), arguments.out)


if __name__ == "__main__":
    main()
