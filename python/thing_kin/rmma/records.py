"""Columns of numbers, written as CSV or handed to pandas."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas as pd

    from thing_kin.rmma.result import Result

Columns = Mapping[str, Sequence[Any]]


def search_columns(result: Result) -> Columns:
    """One row for each velocity, run and fiducial, the fiducial running fastest."""
    shape = result.intercepted.shape
    velocity, run, fiducial = (index.ravel() for index in np.indices(shape))
    return {
        "arrangement": [str(result.arrangement.name)] * len(run),
        "method": [result.method] * len(run),
        "velocity_m_s": result.velocities[velocity].tolist(),
        "run": (run + 1).tolist(),
        "fiducial": (fiducial + 1).tolist(),
        "registered": result.registered[fiducial].tolist(),
        "searched": result.searched.ravel().tolist(),
        "intercepted": result.intercepted.ravel().tolist(),
        "search_time_s": result.search_times.ravel().tolist(),
        "position_error_m": result.position_errors.ravel().tolist(),
        "samples": result.samples.ravel().tolist(),
    }


def write_csv(path: str | Path, columns: Columns) -> Path:
    """Write columns under a header; truth is 0 or 1, NaN and None are empty."""
    with Path(path).open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        rows = zip(*columns.values(), strict=True)
        writer.writerows([_cell(value) for value in row] for row in rows)
    return Path(path)


def data_frame(columns: Columns) -> pd.DataFrame:
    """Hand columns to pandas."""
    try:
        import pandas as pd
    except ImportError as error:
        raise ImportError(
            "to_pandas needs pandas, which is not installed: pip install pandas"
        ) from error
    return pd.DataFrame(dict(columns))


def _cell(value: Any) -> Any:
    if isinstance(value, bool):
        return int(value)
    return "" if value is None or value != value else value
