"""Calibrated arms as Universal Robots' driver has them: an origin for each joint."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import thing_kin as tk

Array = NDArray[np.float64]
Mapping = dict[str, dict[str, dict[str, float]]]

LINKS = ("shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3")
KEYS = ("x", "y", "z", "roll", "pitch", "yaw")
ROUNDING = 1e-9  # m, rad


def mapping_of(chain: tk.Chain) -> Mapping:
    """From the chain's joints; what follows the last one along its axis goes before it."""
    from thing_kin import _calibration

    origins, end = _calibration.joint_origins(chain)
    if len(origins) != len(LINKS) or set(chain.joint_types) - {"revolute", "continuous"}:
        raise ValueError(f"chain: got {chain.name}, expected six turning joints")
    angle = np.arctan2(end[1, 0] - end[0, 1], end[0, 0] + end[1, 1])
    along = tk.transform(xyz=(0.0, 0.0, end[2, 3]), rpy=(0.0, 0.0, angle))
    if np.abs(np.linalg.solve(along, end) - np.eye(4)).max() > ROUNDING:
        raise ValueError(
            "chain: got a last frame off the last joint's axis, expected one on it: hold a and "
            "alpha of the last row (priors of 0), they are part of the tool"
        )
    origins[-1] = origins[-1] @ along
    values = (
        np.concatenate([T[:3, 3], tk.lie.rpy_from_rotation(T[:3, :3])]).tolist() for T in origins
    )
    links = {
        link: dict(zip(KEYS, row, strict=True)) for link, row in zip(LINKS, values, strict=True)
    }
    return {"kinematics": links}


def yaml_of(mapping: Mapping, hash: str) -> str:
    """Write the file: repr gives each number back, and a point, which YAML 1.1 wants."""
    lines = ["kinematics:"]
    for link, numbers in mapping["kinematics"].items():
        lines.append(f"  {link}:")
        lines += [f"    {key}: {_number(value)}" for key, value in numbers.items()]
    lines += [f"  hash: {hash}"] if hash else []
    return "\n".join(lines) + "\n"


def _number(value: float) -> str:
    text = repr(value)
    mantissa, e, exponent = text.partition("e")
    return text if not e or "." in mantissa else f"{mantissa}.0e{exponent}"
