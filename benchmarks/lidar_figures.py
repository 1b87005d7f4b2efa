"""The figure of docs/laser_odometry.md: a corridor's match with its ellipse, a drive with its map.

python benchmarks/lidar_figures.py --out docs/laser_odometry.png
"""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from scan_drives import SENSORS, pair, record
from scan_worlds import FAMILIES
from thing_kin import odometry, viz
from thing_kin.viz.style import new_figure


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("laser_odometry.png"))
    out = parser.parse_args().out
    figure = new_figure(figsize=(14, 4.8))
    axes = figure.subplots(1, 3)
    sensor = SENSORS["1081 beams, 270 degrees"]
    scanner = odometry.Scanner(**sensor.arguments())
    for axis, family in zip(axes, ("room", "corridor, plain"), strict=False):
        two = pair(FAMILIES[family](np.random.default_rng(4)), sensor, np.random.default_rng(4))
        match = odometry.match(scanner, two.a, two.b)
        viz.plot_scan_match(scanner, two.a, two.b, match, axes=axis)
    rng = np.random.default_rng(2)
    drive = record(FAMILIES["people"](rng), sensor, rng, 40.0)
    lidar = odometry.LaserOdometry(scanner)
    for t, ranges in zip(drive.times, drive.scans, strict=True):
        lidar.add(ranges, t=t)
    start = drive.poses[0]
    c, s = np.cos(start[2]), np.sin(start[2])
    truth = (drive.poses[:, :2] - start[:2]) @ np.array([[c, -s], [s, c]])
    viz.plot_laser_odometry(scanner, drive.scans, lidar.poses, truth=truth, axes=axes[2])
    for axis in axes:
        axis.legend(loc="upper left", frameon=True, fontsize=7)
    figure.savefig(out, dpi=80)


if __name__ == "__main__":
    main()
