"""Figures: paths, joints, steps, traces, drives, scans, searches, arms' errors, movies.

Needs the extra `viz` (`pip install thing_kin[viz]`); matplotlib is imported when the first figure
is made. Figures are made without a display: save them with `figure.savefig("name.png")`.
"""

from thing_kin.viz.animation import animate
from thing_kin.viz.calibration import plot_calibration
from thing_kin.viz.geometry import plot_path, plot_stick_figures, stick_figure
from thing_kin.viz.lidar import plot_laser_odometry, plot_scan_match
from thing_kin.viz.localization import plot_localization
from thing_kin.viz.plans import plot_dexterity, plot_plan, plot_trajectory
from thing_kin.viz.rmma import plot_rmma_methods, plot_rmma_result
from thing_kin.viz.rmma_animation import animate_rmma_run
from thing_kin.viz.rmma_practice import plot_rmma_practice
from thing_kin.viz.rmma_run import (
    plot_rmma_arrangements,
    plot_rmma_run,
    plot_rmma_run_from_above,
)
from thing_kin.viz.rmma_thesis import plot_rmma_thesis_figure
from thing_kin.viz.series import plot_joint_steps, plot_joints, plot_singular_values
from thing_kin.viz.trace import plot_trace

__all__ = [
    "animate",
    "animate_rmma_run",
    "plot_calibration",
    "plot_dexterity",
    "plot_joint_steps",
    "plot_joints",
    "plot_laser_odometry",
    "plot_localization",
    "plot_path",
    "plot_plan",
    "plot_rmma_arrangements",
    "plot_rmma_methods",
    "plot_rmma_practice",
    "plot_rmma_result",
    "plot_rmma_run",
    "plot_rmma_run_from_above",
    "plot_rmma_thesis_figure",
    "plot_scan_match",
    "plot_singular_values",
    "plot_stick_figures",
    "plot_trace",
    "plot_trajectory",
    "stick_figure",
]
