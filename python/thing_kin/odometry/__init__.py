"""LIDAR odometry: the motion between two scans, and a robot's way from a stream of them.

Planar poses are (x, y, theta), in metres and radians; the covariance of a motion is in the axes of
where it began. The odometry of wheels is in `thing_kin.estimation`.
"""

from thing_kin._odometry import LaserOdometry, LaserStep, ScanMatch, Scanner, match

__all__ = ["LaserOdometry", "LaserStep", "ScanMatch", "Scanner", "match"]
