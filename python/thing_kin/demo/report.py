"""What the demo claims, checks and prints."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

import thing_kin as tk
from thing_kin.demo import wall
from thing_kin.demo.follow import FILTER, TOLERANCE, Run

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from thing_kin.demo.measure import Measures

CLAIMED_ERROR = 1e-5  # m and rad
NEAR_SINGULAR = 0.05  # smallest singular value of the arm's Jacobian


@dataclass(frozen=True)
class Outcome:
    """The two runs on one path, and their numbers."""

    robot: tk.Chain
    path: wall.WallPath
    beyond_reach: NDArray[np.float64]  #: (N,), m
    robust: Run
    plain: Run
    robust_measures: Measures
    plain_measures: Measures


def checks(outcome: Outcome) -> dict[str, bool]:
    """Every claim of the demo, and whether it holds."""
    ours, plain = outcome.robust_measures, outcome.plain_measures
    worst = max(ours.position_error.max(), ours.rotation_error.max())
    near = ours.sigma_arm < NEAR_SINGULAR
    growth = outcome.plain.largest_step[near].max(initial=0.0) / ours.joint_step.max()
    return {
        "hand within 1e-5 m and 1e-5 rad of its target at every pose": worst < CLAIMED_ERROR,
        "hand perpendicular to the wall at every pose": ours.tilt.max() < CLAIMED_ERROR,
        "every joint, and the base, within its limits": ours.margin.min() > 0.0,
        "the arm comes near a singular posture": ours.sigma_arm.min() < NEAR_SINGULAR,
        "the whole body stays away from one": ours.sigma_robot.min() > 4 * NEAR_SINGULAR,
        "no joint moves by more than pi/4 from pose to pose": ours.joint_step.max() < np.pi / 4,
        "there the plain pseudoinverse takes steps over 10 times as large": growth > 10.0,
        "and loses the wall": plain.position_error.max() > CLAIMED_ERROR,
    }


def summary(outcome: Outcome) -> dict[str, Any]:
    """All figures, for summary.json. Units are in the names; a joint step is in rad or m."""
    robot, path, short = outcome.robot, outcome.path, outcome.beyond_reach
    q, margin = outcome.robust.q, outcome.robust_measures.margin
    return {
        "version": tk.__version__,
        "robot": robot.name,
        "poses": len(path),
        "path_length_m": path.length,
        "tolerance": TOLERANCE,
        "base_path_beyond_reach_m": float(max(short.max(), 0.0)),
        "poses_beyond_reach": int((short > 0.0).sum()),
        "robust": _figures(outcome.robust, outcome.robust_measures, FILTER),
        "plain": _figures(outcome.plain, outcome.plain_measures, None),
        "joints": {
            name: {
                "lower": float(robot.lower[j]),
                "upper": float(robot.upper[j]),
                "least": float(q[:, j].min()),
                "most": float(q[:, j].max()),
                "distance_to_limit": float(margin[j]),
            }
            for j, name in enumerate(robot.names)
        },
        "checks": {claim: bool(holds) for claim, holds in checks(outcome).items()},
    }


def _figures(run: Run, m: Measures, singular_filter: tuple[float, float] | None) -> dict[str, Any]:
    sigma = float(run.sigma.min())
    filtered = tk.SingularValueFilter(*singular_filter)(sigma) if singular_filter else None
    return {
        "poses_reached": int(m.arrived.sum()),
        "worst_position_error_m": float(m.position_error.max()),
        "worst_rotation_error_rad": float(m.rotation_error.max()),
        "largest_joint_step_between_poses": float(m.joint_step.max()),
        "largest_joint_step_of_one_iteration": float(run.largest_step.max()),
        "base_off_its_path_m": float(m.base_error.max()),
        "smallest_singular_value_arm": float(m.sigma_arm.min()),
        "smallest_singular_value_robot": float(m.sigma_robot.min()),
        "smallest_singular_value_inverted": sigma,
        "smallest_singular_value_inverted_filtered": filtered,
        "median_iterations": float(np.median(run.iterations)),
        "most_iterations": int(run.iterations.max()),
        "median_step_us": run.step_us,
        "limits_kept": bool(m.margin.min() >= 0.0),
    }
