"""Reads the kinematics YAML of Universal Robots' driver."""

from __future__ import annotations

import os
from typing import Any

LARGEST = 1 << 20  # bytes; the driver writes about one thousand


def load(path: str | os.PathLike[str]) -> Any:
    """Return what the YAML file holds; what is in it is checked by the caller."""
    try:
        import yaml
    except ImportError as error:
        raise ImportError(
            "a calibration file is read with PyYAML: pip install 'thing_kin[yaml]', or pass its "
            "content as a mapping"
        ) from error
    text = _text(path)
    try:
        return yaml.safe_load(text)
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        said = " ".join(str(error).split())[:200]
        raise ValueError(f"calibration: got {path!r} ({said}), expected YAML") from error


def _text(path: str | os.PathLike[str]) -> bytes:
    try:
        if not os.path.isfile(path):  # noqa: PTH113 - bytes are paths too; a pipe would block
            raise ValueError(f"calibration: got {path!r}, expected a file")
        with open(path, "rb") as file:  # noqa: PTH123
            text = file.read(LARGEST + 1)
    except OSError as error:
        raise ValueError(f"calibration: got {path!r}, expected a file ({error})") from error
    if len(text) > LARGEST:
        raise ValueError(f"calibration: got {path!r}, expected at most {LARGEST} bytes")
    return text
