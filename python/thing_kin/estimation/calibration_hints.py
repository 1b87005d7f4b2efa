"""What looks like a mistake in the data, or too few parameters, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from thing_kin.estimation.calibration_result import Calibration

Array = NDArray[np.float64]

MOST_TURNS = 20.0  # rad: no joint is read so far off
OTHER_UNIT = 30.0  # times as far apart as the arm is long
HAS_MOVED = 1e-3  # of its length
NOT_THIS_ARM = 0.1  # of how far the measured places are apart
FARTHEST_POINT = 10.0  # m
TOO_MANY = 0.25  # of all measurements are outliers
BETTER = 0.8  # of the noise: what more parameters must leave at most
MOST_POSTURES = 20000  # for which it is tried


def hints_of(result: Calibration) -> tuple[str, ...]:
    """Return the gravest first; none where all looks well."""
    seen = np.isfinite(result.distances)
    if not seen.any():
        return ("nothing was measured: all is NaN",)
    run = result._run
    hints = []
    turning = [kind != "prismatic" for kind in run.chain.joint_types]
    most = np.abs(run.q[:, turning]).max(initial=0.0)
    fits = _fits(result)
    if most > MOST_TURNS and not fits:
        hints.append(f"q is up to {most:.3g}: degrees in place of radians?")
    ratio = (
        0.0 if result.errors.shape[-1] == 2 else _extent(run.places) / max(_reach(result), 1e-12)
    )
    if ratio > OTHER_UNIT and not fits:  # it does where no link has a length, but the tool has
        hints.append(
            f"measured places are {ratio:.2g} times as far apart as the arm can have moved: "
            "millimeters in place of meters?"
        )
    if not hints and not fits:
        hints.append(
            "what is left is a tenth of how far the arm has moved, or more: postures or joints in "
            "another order, another arm, poses of the world in the tool?"
        )
    if np.abs(result.points).max() > FARTHEST_POINT:
        hints.append("points are farther from the tool than 10 m: millimeters in place of meters?")
    share = len(result.outliers) / seen.sum()
    if share > TOO_MANY:
        hints.append(f"{100 * share:.0f} % are outliers: points, or rows, in another order?")
    if not hints and result.success:
        hints += _of_parameters(result)
    return tuple(hints)


def _fits(result: Calibration) -> bool:
    extent = _extent(result._run.places)
    if extent < HAS_MOVED * _reach(result):
        return True
    given = np.isnan(result.noise_position)
    return (result.rms_position if given else result.noise_position) < NOT_THIS_ARM * extent


def _extent(places: Array) -> float:
    """Root mean square distance of places (N, k, 3) from the mean of each point's."""
    seen = np.isfinite(places).any(axis=(0, 2))
    away = places[:, seen] - np.nanmean(places[:, seen], axis=0)
    return float(np.sqrt(np.nanmean(np.sum(away**2, axis=-1))))


def _reach(result: Calibration) -> float:
    """Return how long the nominal chain is, m."""
    chain, q = result._run.chain, result._run.q
    frames = np.asarray(chain.fk_all(q))
    length = np.linalg.norm(np.diff(frames[..., :3, 3], axis=-2), axis=-1).sum(axis=-1).max()
    return float(length)


def _of_parameters(result: Calibration) -> list[str]:
    """Whether all links, or points elsewhere, would explain much of what is left."""
    run = result._run
    known = not np.isfinite(result.noise_position)  # the noise: what is left is told by its factor
    if known or not result.dof > 0 or len(run.q) > MOST_POSTURES:
        return []
    groups = [name for name in run.groups if name not in ("joint_offsets", "links")]
    if result.points.shape[0] > 1 and "points" not in groups:
        places = ["points", *(n for n in run.groups if n.partition(".")[0] != "tool")]
        noise = _noise_with(result, places)
        if noise is not None:
            return [
                f"with `points` left out, so that they are found, the noise of a coordinate would "
                f"be {1e3 * noise:.3g} mm in place of {1e3 * result.noise_position:.3g}: another "
                "order, or unit?"
            ]
    if run.chain.base_joints or any(n.startswith(("dh[", "origins[")) for n in result.names):
        return []
    noise = _noise_with(result, [*groups, "joint_offsets", "links"])
    if noise is None:
        return []
    return [
        f"with the links' numbers, too (parameters='all'), the noise of a coordinate would be "
        f"{1e3 * noise:.3g} mm in place of {1e3 * result.noise_position:.3g}"
    ]


def _noise_with(result: Calibration, groups: list[str]) -> float | None:
    """Return the noise under other parameters; None where these are not worth it."""
    run = result._run
    fit = run.with_parameters(groups).fit(**run.options, postures=run.everything)
    if fit.status != "converged" or not fit.noise_is_estimated:
        return None
    gain = result.noise_position / fit.noise[0]
    numbers = max(fit.rank - result.rank, 1)
    # Schwarz's criterion; and so much that it matters.
    worth = 2.0 * fit.dof * np.log(gain) > numbers * np.log(max(fit.dof, 2.0))
    return float(fit.noise[0]) if worth and gain * BETTER > 1.0 else None
