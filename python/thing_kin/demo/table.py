"""The printed report."""

from __future__ import annotations

from typing import Any

from thing_kin.demo import wall

ROWS = (  # label, key of the summary, format
    ("poses with the hand on its target", "poses_reached", "d"),
    ("worst position error [m]", "worst_position_error_m", ".2e"),
    ("worst rotation error [rad]", "worst_rotation_error_rad", ".2e"),
    ("largest joint step between poses [rad, m]", "largest_joint_step_between_poses", ".3g"),
    ("largest joint step of one iteration [rad, m]", "largest_joint_step_of_one_iteration", ".3g"),
    ("base off its path by at most [m]", "base_off_its_path_m", ".1e"),
    ("smallest singular value, arm alone", "smallest_singular_value_arm", ".2g"),
    ("smallest singular value, whole body", "smallest_singular_value_robot", ".2g"),
    ("smallest singular value inverted", "smallest_singular_value_inverted", ".2g"),
    ("  the same after the filter", "smallest_singular_value_inverted_filtered", ".2g"),
    ("iterations per pose, median", "median_iterations", ".0f"),
    ("iterations per pose, most", "most_iterations", "d"),
    ("time per step, median [us]", "median_step_us", ".1f"),
    ("joint limits kept", "limits_kept", ""),
)


def table(summary: dict[str, Any]) -> str:
    """Lay the summary out for a terminal."""
    return "\n\n".join([_job(summary), _schemes(summary), _joints(summary), _checks(summary)])


def _job(s: dict[str, Any]) -> str:
    width, height = wall.WIDTH, wall.TOP - wall.BOTTOM
    return (
        f"{s['robot']} wipes a wall panel of {width:.1f} x {height:.1f} m: {s['poses']} poses, "
        f"{s['path_length_m']:.1f} m of path, the hand perpendicular to the wall,\n"
        f"each pose iterated until the hand is within {s['tolerance']:.0e} m and rad. "
        f"Half-way the base path runs further from the wall: at {s['poses_beyond_reach']} poses\n"
        f"it asks for up to {1e3 * s['base_path_beyond_reach_m']:.1f} mm more than the "
        "stretched arm has."
    )


def _schemes(s: dict[str, Any]) -> str:
    lines = [f"{'':46}{'robust (4.18)':>16}{'plain (4.16)':>16}"]
    for label, key, form in ROWS:
        cells = (_cell(s[name][key], form) for name in ("robust", "plain"))
        lines.append(f"{label:46}" + "".join(f"{cell:>16}" for cell in cells))
    return "\n".join(lines)


def _cell(value: object, form: str) -> str:
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "NO"
    return format(value, form)


def _joints(s: dict[str, Any]) -> str:
    lines = [f"{'joint':8}{'lower':>9}{'least':>9}{'most':>9}{'upper':>9}   to the limit"]
    for name, joint in s["joints"].items():
        numbers = (joint[key] for key in ("lower", "least", "most", "upper", "distance_to_limit"))
        lower, least, most, upper, distance = (f"{round(x, 3) + 0.0:9.3f}" for x in numbers)
        unit = "m" if name in ("x", "y") else "rad"
        lines.append(f"{name:8}{lower}{least}{most}{upper}{distance} {unit}")
    return "\n".join(lines)


def _checks(s: dict[str, Any]) -> str:
    return "\n".join(f"{'ok' if ok else 'FAILED':8}{claim}" for claim, ok in s["checks"].items())
