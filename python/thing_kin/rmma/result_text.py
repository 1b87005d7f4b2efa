"""A result as text, by velocity and by fiducial."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from thing_kin.rmma.layout import columns, millimeters, number, percent

if TYPE_CHECKING:
    from thing_kin.rmma.result import Result

MEASURES = ("rate [%]", "searched [%]", "time [s]", "error [mm]")


def table(result: Result) -> str:
    """Lay a result out for a terminal."""
    size = f"{len(result.velocities)} velocities x {result.runs} runs"
    searched = int(result.searched.sum())
    title = f"{result.title}: {size}, {searched} searches"
    return "\n\n".join([title, _by_velocity(result), _by_fiducial(result), _intervals(result)])


def _by_velocity(result: Result) -> str:
    rows = []
    for velocity in result.velocities:
        part = result.at_velocity(float(velocity))
        low, high = part.interception_interval()
        rows.append([f"{100 * velocity:.4g} cm/s", *_measures(part), _range(low, high)])
    low, high = result.interception_interval()
    rows.append(["all", *_measures(result), _range(low, high)])
    header = ["by velocity", *MEASURES, "first stop [%]", "95 % of the rate"]
    return columns(header, rows)


def _measures(part: Result) -> list[str]:
    return [
        percent(part.interception_rate),
        percent(part.interception_rate_searched),
        number(part.search_time),
        millimeters(part.position_error),
        percent(part.first_stop_rate),
    ]


def _by_fiducial(result: Result) -> str:
    side = np.repeat(np.arange(len(result.arrangement.sides)), _lengths(result))
    rates, times = result.interception_rate_by_fiducial, result.search_time_by_fiducial
    errors, way = result.position_error_by_fiducial, distances(result)
    rows = [
        [
            str(k + 1) + (" registered" if result.registered[k] else ""),
            str(side[k] + 1),
            number(way[k]),
            percent(rates[k]),
            number(times[k]),
            millimeters(errors[k]),
        ]
        for k in range(len(rates))
    ]
    header = ["by fiducial", "side", "from the last [m]", *MEASURES[:1], *MEASURES[2:]]
    return columns(header, rows)


def distances(result: Result) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """(N,), m along x from the fiducial before; NaN for the first of a side, [X21] Table 5.6."""
    ways = [
        np.r_[np.nan, np.abs(np.diff(np.asarray(side)[:, 0]))] for side in result.arrangement.sides
    ]
    return np.concatenate(ways)


def _lengths(result: Result) -> list[int]:
    return [len(np.asarray(side)) for side in result.arrangement.sides]


def _intervals(result: Result) -> str:
    low, high = result.interception_interval(unit="run")
    rate = f"rate {_range(low, high)} %"
    if not np.isfinite(low + high) or result.runs < 2:
        return "95 % with the run as the unit needs two runs at each velocity"
    time, error = result.search_time_interval(), result.position_error_interval()
    return (
        f"95 % with the run as the unit: {rate}, time {time[0]:.2f} .. {time[1]:.2f} s, "
        f"error {millimeters(error[0])} .. {millimeters(error[1])} mm"
    )


def _range(low: float, high: float) -> str:
    return f"{percent(low)} .. {percent(high)}"
