"""A calibration in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import thing_kin as tk

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from thing_kin.estimation.calibration_result import Calibration

MOST_LISTED = 20


def report(result: Calibration) -> str:
    """All that a reader wants to know, the doubtful first."""
    lines = [_headline(result), *_residuals(result), *_doubts(result), *_places(result)]
    lines += ["", *_table(result)]
    return "\n".join(lines)


def _headline(result: Calibration) -> str:
    measured = int(np.isfinite(result.distances).sum())
    return (
        f"Calibration of {result.chain.name}: {result.status}, {measured} measurements at "
        f"{len(result.errors)} postures"
    )


def _residuals(result: Calibration) -> list[str]:
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
            line = f"rms {name}: {1e3 * after:.4g} {unit} (nominal chain {1e3 * before:.4g}"
            line += f", held out {1e3 * held_out:.4g})" if np.isfinite(held_out) else ")"
            lines.append(line)
    if np.isfinite(result.noise_position):
        how = "estimated" if result.noise_is_estimated else "assumed: too little data"
        line = f"noise of a coordinate: {1e3 * result.noise_position:.3g} mm"
        if np.isfinite(result.noise_rotation):
            line += f", {1e3 * result.noise_rotation:.3g} mrad"
        lines.append(f"{line} ({how}), {result.dof:.1f} degrees of freedom")
    else:
        lines.append(
            f"covariances as given; squared residuals for each degree of freedom: "
            f"{result.variance_factor:.3g}, {result.dof:.1f} degrees of freedom"
        )
    return lines


def _doubts(result: Calibration) -> list[str]:
    lines = [f"rank {result.rank} of {len(result.names)} parameters"]
    if result.degenerate:
        lines.append("DEGENERATE: other postures would tell more; see propose_postures()")
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


def _places(result: Calibration) -> list[str]:
    lines = []
    for name, T in (("base", result.base), ("tool", result.tool)):
        xyz, rpy = T[:3, 3], tk.lie.rpy_from_rotation(T[:3, :3])
        lines.append(f"{name}: xyz {_vector(xyz)} m, rpy {_vector(rpy)} rad")
    return lines


def _vector(values: NDArray[np.float64]) -> str:
    return "(" + ", ".join(f"{value:.6f}" for value in values) + ")"


def _table(result: Calibration) -> list[str]:
    lines = [f"{'parameter':<20} {'change':>12} {'std':>10}  unit"]
    for name, value, std in zip(result.names, result.values, result.std, strict=True):
        unit, factor = _unit(name, result)
        shown = f"{factor * std:10.4f}" if np.isfinite(std) else f"{'not told':>10}"
        lines.append(f"{name:<20} {factor * value:12.4f} {shown}  {unit}")
    return lines


def _unit(name: str, result: Calibration) -> tuple[str, float]:
    group, _, last = name.partition(".")
    if group.startswith("joint_offsets"):
        joint = int(group.partition("[")[2].rstrip("]"))
        return ("mm", 1e3) if result.chain.joint_types[joint] == "prismatic" else ("mrad", 1e3)
    if group.startswith("joint_scales"):
        return "%", 1e2
    if group.startswith("sag"):
        return "mrad/(N m)", 1e3
    return ("mm", 1e3) if last in ("x", "y", "z", "d", "a") else ("mrad", 1e3)
