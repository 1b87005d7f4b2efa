"""Figures: paths, stick figures, joints, singular values, steps, drives, scans, arms, movies.

Needs the extra `viz` (`pip install thing_kin[viz]`); matplotlib is imported when the first figure
is made. Figures are made without a display: save them with `figure.savefig("name.png")`.
"""

from thing_kin.viz.animation import animate
from thing_kin.viz.calibration import plot_calibration
from thing_kin.viz.geometry import plot_path, plot_stick_figures, stick_figure
from thing_kin.viz.lidar import plot_laser_odometry, plot_scan_match
from thing_kin.viz.localization import plot_localization
from thing_kin.viz.plans import plot_dexterity, plot_plan, plot_trajectory
from thing_kin.viz.series import plot_joint_steps, plot_joints, plot_singular_values
from thing_kin.viz.trace import plot_trace

__all__ = [
    "animate",
    "plot_calibration",
    "plot_dexterity",
    "plot_joint_steps",
    "plot_joints",
    "plot_laser_odometry",
    "plot_localization",
    "plot_path",
    "plot_plan",
    "plot_scan_match",
    "plot_singular_values",
    "plot_stick_figures",
    "plot_trace",
    "plot_trajectory",
    "stick_figure",
]
