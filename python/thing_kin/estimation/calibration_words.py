"""Calibrations in words."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

import thing_kin as tk

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from thing_kin.estimation.calibration_base import CalibratedNumber, CalibrationResult
    from thing_kin.estimation.calibration_result import Calibration

__all__ = ["calibration_report"]

MOST_LISTED = 20
SHOWN_AS = {"m": ("mm", 1e3), "rad": ("mrad", 1e3), "s": ("ms", 1e3), "1": ("%", 1e2),
            "rad/(N m)": ("mrad/(N m)", 1e3), "m/N": ("mm/N", 1e3)}  # fmt: skip


def calibration_report(**parts: CalibrationResult) -> str:
    """Return several calibrations of one robot in words, with one table of all numbers.

    Parameters
    ----------
    **parts : CalibrationResult
        By names of one's own, which stand before the parameters'.

    Returns
    -------
    str

    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> from thing_kin import estimation as est
    >>> arm, wheels, t = tk.robots.ur5(), est.MecanumOdometry(0.07, 0.4), np.linspace(0, 20, 401)
    >>> q = arm.random(30, rng=0)
    >>> twists = np.stack([0.3 * np.cos(t), 0.2 * np.sin(2 * t), 0.5 * np.sin(t)], axis=1)
    >>> angles = np.cumsum(wheels.wheel_speeds(twists) * 0.05, axis=0)
    >>> poses = wheels.integrate_angles(t, angles).poses
    >>> text = est.calibration_report(
    ...     arm=est.calibrate(arm, q, arm.fk(q)),
    ...     wheels=est.calibrate_mecanum(t, angles, t, poses, wheel_radius=0.08, k=0.5),
    ... )
    >>> "arm.joint_offsets[1]" in text, "wheels.k" in text
    (True, True)
    """
    lines: list[str] = []
    numbers: list[CalibratedNumber] = []
    for name, result in parts.items():
        lines += [f"--- {name}", *_words(result), ""]
        numbers += [replace(row, name=f"{name}.{row.name}") for row in result.table]
    return "\n".join(lines + _table(tuple(numbers)))


def report(result: CalibrationResult) -> str:
    """All that a reader wants to know, the doubtful first."""
    return "\n".join([*_words(result), "", *_table(result.table)])


def _words(result: CalibrationResult) -> list[str]:
    hints = [f"HINT: {hint}" for hint in result.hints]
    return [result._title(), *hints, *_residuals(result), *result._details(), *_doubts(result)]


def _residuals(result: CalibrationResult) -> list[str]:
    rows = [
        (
            "position",
            result.rms_position_nominal,
            result.rms_position,
            result.cross_validated_rms_position,
            "mm",
        ),
        (
            "rotation",
            result.rms_rotation_nominal,
            result.rms_rotation,
            result.cross_validated_rms_rotation,
            "mrad",
        ),
    ]
    lines = []
    for name, before, after, held_out, unit in rows:
        if np.isfinite(after):
            line = f"rms {name}: {1e3 * after:.4g} {unit} (nominal {1e3 * before:.4g}"
            line += f", held out {1e3 * held_out:.4g})" if np.isfinite(held_out) else ")"
            lines.append(line)
    return lines


def _doubts(result: CalibrationResult) -> list[str]:
    lines = []
    if result.combinations:
        lines.append("not told by the data, so kept near nominal (motions that change nothing):")
        lines += [f"  {line}" for line in result.combinations[:MOST_LISTED]]
        more = len(result.combinations) - MOST_LISTED
        lines += [f"  and {more} more"] if more > 0 else []
    if result.outliers:
        shown = ", ".join(map(str, result.outliers[:MOST_LISTED]))
        more = len(result.outliers) - MOST_LISTED
        lines.append(f"outliers: {shown}" + (f" and {more} more" if more > 0 else ""))
    else:
        lines.append("outliers: none")
    return lines


def details_of_arm(result: Calibration) -> list[str]:
    """Noise, rank, where base and tool are."""
    if np.isfinite(result.noise_position):
        how = "estimated" if result.noise_is_estimated else "assumed: too little data"
        line = f"noise of a coordinate: {1e3 * result.noise_position:.3g} mm"
        if np.isfinite(result.noise_rotation):
            line += f", {1e3 * result.noise_rotation:.3g} mrad"
        line = f"{line} ({how}), {result.dof:.1f} degrees of freedom"
    else:
        line = (
            f"covariances as given; squared residuals for each degree of freedom: "
            f"{result.variance_factor:.3g}, {result.dof:.1f} degrees of freedom"
        )
    lines = [line, *_places(result), f"rank {result.rank} of {len(result.names)} parameters"]
    if result.degenerate:
        lines.append("DEGENERATE: other postures would tell more; see propose_postures()")
    return lines


def _places(result: Calibration) -> list[str]:
    lines = []
    for name, T in (("base", result.base), ("tool", result.tool)):
        xyz, rpy = T[:3, 3], tk.lie.rpy_from_rotation(T[:3, :3])
        lines.append(f"{name}: xyz {_vector(xyz)} m, rpy {_vector(rpy)} rad")
    return lines


def _vector(values: NDArray[np.float64]) -> str:
    return "(" + ", ".join(f"{value:.6f}" for value in values) + ")"


def _table(numbers: tuple[CalibratedNumber, ...]) -> list[str]:
    width = max([20, *(len(row.name) for row in numbers)])
    lines = [
        f"{'parameter':<{width}} {'nominal':>12} {'value':>12} {'change':>12} {'std':>10}  unit"
    ]
    for row in numbers:
        unit, factor = SHOWN_AS[row.unit]
        std = f"{factor * row.std:10.4f}" if np.isfinite(row.std) else f"{'not told':>10}"
        shown = (f"{factor * x:12.4f}" for x in (row.nominal, row.value, row.change))
        lines.append(f"{row.name:<{width}} {' '.join(shown)} {std}  {unit}")
    return lines
