"""The thesis's tables with this library's figures beside its own."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import isnan, nan
from typing import TYPE_CHECKING

from thing_kin.rmma import reference, thesis
from thing_kin.rmma.experiment import CONFIGS
from thing_kin.rmma.layout import columns, millimeters, number, percent
from thing_kin.rmma.result_text import distances

if TYPE_CHECKING:
    from thing_kin.rmma.result import Result, Spread
    from thing_kin.rmma.thesis import Measures

    #: By arrangement (1, 2, 3), method and configuration (None where there is none).
    Results = Mapping[tuple[int, str, int | None], Result]

HEADER = (
    *("rate [%]", "thesis", "diff", "sd"),
    *("time [s]", "thesis", "diff", "sd"),
    *("error [mm]", "thesis", "diff", "sd"),
)


def table_5_1(results: Results) -> str:
    """Table 5.1: linear Kalman filter and UKF on arrangement #1."""
    rows = [
        (f"{method}, configuration 6", results[1, method, 6], printed)
        for method, printed in thesis.TABLE_5_1.items()
    ]
    return _titled("Table 5.1, arrangement #1", _side_by_side(rows))


def table_5_2(results: Results) -> str:
    """Table 5.2: spiral search and UKF, each arrangement with its own configuration."""
    rows = []
    for (arrangement, method), printed in thesis.TABLE_5_2.items():
        config = thesis.TABLE_5_2_CONFIGURATION[arrangement] if method == "ukf" else None
        name = f"#{arrangement} {method}" + (f", configuration {config}" if config else "")
        rows.append((name, results[arrangement, method, config], printed))
    return _titled("Table 5.2", _side_by_side(rows))


def table_of_configurations(results: Results, arrangement: int) -> str:
    """Table 5.3, 5.4 or 5.5: the UKF's configurations on one arrangement."""
    rows = [
        (_configuration(config), results[arrangement, "ukf", config], printed)
        for (where, config), printed in thesis.TABLES_5_3_TO_5_5.items()
        if where == arrangement
    ]
    title = f"Table 5.{2 + arrangement}, UKF on arrangement #{arrangement}"
    return _titled(title, _side_by_side(rows))


def table_of_distances(results: Results, arrangement: int) -> str:
    """Table 5.6, 5.7 or 5.8: rates by fiducial, with the distance from the one before."""
    config = thesis.TABLE_5_2_CONFIGURATION[arrangement]
    ukf, spiral = results[arrangement, "ukf", config], results[arrangement, "spiral", None]
    searched = [k for k, registered in enumerate(ukf.registered) if not registered]
    ways = distances(ukf)
    rows = []
    for row, k in enumerate(searched):
        cells = [f"{k} to {k + 1}", number(float(ways[k]))]
        for method, result in (("ukf", ukf), ("spiral", spiral)):
            ours = float(result.interception_rate_by_fiducial[k])
            printed = thesis.BY_FIDUCIAL[arrangement, method][row]
            cells += [number(ours), number(printed), number(ours - printed, sign=True)]
        rows.append(cells)
    header = ["fiducials", "distance [m]", "UKF", "thesis", "diff", "spiral", "thesis", "diff"]
    title = f"Table 5.{5 + arrangement}, arrangement #{arrangement}, rates of 1 by fiducial"
    return _titled(title, columns(header, rows))


def table_of_reference(results: Results) -> str:
    """Every entry that the reference simulation has, and whether this library meets it."""
    rows = []
    for (arrangement, method, config), result in results.items():
        if (arrangement, method, config) not in reference.READINGS:
            continue
        by = reference.expected(arrangement, method, config)
        rate, time = result.interception_rate, result.search_time
        rows.append(
            [
                f"#{arrangement} {method}" + (f", configuration {config}" if config else ""),
                *(percent(rate), percent(by.interception_rate)),
                number(100 * (rate - by.interception_rate), 1, sign=True),
                *(number(time), number(by.search_time)),
                number(time - by.search_time, sign=True),
                *(millimeters(result.position_error), millimeters(by.position_error)),
                "yes" if reference.is_met(rate, time, by) else "NO",
            ]
        )
    header = ["entry", "rate [%]", "reference", "diff", "time [s]", "reference", "diff"]
    header += ["error [mm]", "reference", "met"]
    title = "Reference simulation: met within 3 points, and 15 % or 0.1 s"
    return _titled(title, columns(header, rows))


def table_of_methods(results: Results) -> str:
    """All methods on all arrangements: rate / time / error; the worst cell and fiducial."""
    rows = []
    for label, keys in _by_method(results).items():
        found = {key[0]: results[key] for key in keys}
        cells = [_three(found[k]) if k in found else "-" for k in (1, 2, 3)]
        worst = min(float(r.interception_rate_by_velocity.min()) for r in found.values())
        fiducial = min(float(r.interception_rate_by_fiducial.min()) for r in found.values())
        slowest = max(float(r.search_time_by_velocity.max()) for r in found.values())
        first = sum(r.first_stop_rate for r in found.values()) / len(found)
        extremes = [percent(worst), number(slowest), percent(fiducial), percent(first)]
        rows.append([label, *cells, *extremes])
    header = ["rate [%] / time [s] / error [mm]", "#1", "#2", "#3"]
    header += ["least rate", "longest time", "worst fiducial", "first stop [%]"]
    note = "least rate and longest time: over the pairs of arrangement and velocity"
    return _titled("Methods", columns(header, rows) + "\n" + note)


def table_of_velocities(results: Results) -> str:
    """Rates by velocity, and how they change from the slowest to the fastest."""
    velocities = next(iter(results.values())).velocities
    rows = []
    for (arrangement, method, config), result in results.items():
        name = f"#{arrangement} {method}" + (f", configuration {config}" if config else "")
        rates = [float(rate) for rate in result.interception_rate_by_velocity]
        change = number(100 * (rates[-1] - rates[0]), 1, sign=True)
        rows.append([name, *(percent(rate) for rate in rates), change])
    header = ["rate [%] at", *(f"{100 * v:g} cm/s" for v in velocities), "change"]
    return _titled("Velocities", columns(header, rows))


def _configuration(config: int) -> str:
    c = CONFIGS[config]
    values = f"gap {1e3 * c.sample_gap:g} mm, Q {c.q:g}, R {c.r_interception:g}, P {c.p:g}"
    return f"{config}: {values}"


def _side_by_side(rows: Iterable[tuple[str, Result, Measures]]) -> str:
    """Three measures, each with the thesis's, the difference and the ten-run protocol's sd."""
    laid = []
    for name, result, printed in rows:
        sd = ten_runs(result)
        triples = (
            (result.interception_rate, printed.interception_rate, sd[0], 100.0, 1),
            (result.search_time, printed.search_time, sd[1], 1.0, 2),
            (result.position_error, printed.position_error, sd[2], 1e3, 1),
        )
        cells = [name]
        for ours, theirs, scatter, unit, digits in triples:
            cells += [number(unit * ours, digits), number(unit * theirs, digits)]
            cells += [number(unit * (ours - theirs), digits, sign=True)]
            cells += [number(unit * scatter, digits)]
        laid.append(cells)
    note = f"sd: of one repetition of {thesis.RUNS} runs at each velocity, as here simulated"
    return columns(["", *HEADER], laid) + "\n" + note


def ten_runs(result: Result) -> tuple[float, float, float]:
    """Return the ten-run protocol's standard deviations; NaN with one run."""
    if result.runs < 2:
        return nan, nan, nan
    spread: Spread = result.spread(thesis.RUNS)
    return spread.interception_rate, spread.search_time, spread.position_error


def _three(result: Result) -> str:
    error = result.position_error
    tail = "" if isnan(error) else f" / {millimeters(error)}"
    return f"{percent(result.interception_rate, 2)} / {number(result.search_time)}{tail}"


def _by_method(results: Results) -> dict[str, list[tuple[int, str, int | None]]]:
    """Keys of a method together; the UKF both with the thesis's configurations and with one."""
    groups: dict[str, list[tuple[int, str, int | None]]] = {}
    for arrangement, method, config in results:
        labels = [method]
        if method == "linear_kf":
            labels = [f"linear_kf, configuration {config}"]
        elif method == "ukf":
            own = thesis.TABLE_5_2_CONFIGURATION.get(arrangement) == config
            labels = ["ukf, Table 5.2's configurations"] if own else []
            labels += ["ukf, configuration 6"] if config == 6 else []
        for label in labels:
            groups.setdefault(label, []).append((arrangement, method, config))
    return groups


def _titled(title: str, body: str) -> str:
    return f"{title}\n\n{body}"
