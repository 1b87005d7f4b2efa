"""What matches the thesis and what does not, worked out from the results."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite, sqrt
from typing import TYPE_CHECKING

import numpy as np

from thing_kin.rmma import reference, thesis
from thing_kin.rmma.intervals import wilson
from thing_kin.rmma.tables import ten_runs

if TYPE_CHECKING:
    from thing_kin.rmma.result import Result
    from thing_kin.rmma.sweeps import Sweep
    from thing_kin.rmma.thesis import Measures

    Results = Mapping[tuple[int, str, int | None], Result]

NOISE = 2.0  # a difference of less standard deviations of ten runs is none
LEVEL = 0.999  # of the intervals that checks allow for
COVERING_RATE, COVERING_TIME = 0.995, 0.25  # in each cell of the standard world
COVERING_RATE_ELSEWHERE = 0.99
CREEP = "creep 0.4 mm/s"
HARD_WORLDS = ("drift x2", CREEP, "map error 5 mm", "map error 10 mm")


@dataclass(frozen=True)
class Finding:
    """A statement, whether it holds, and the numbers it rests on.

    Its kind: "figures" compares with the thesis's numbers, "claims" is what the thesis says of its
    own, "library" what is asked of this library.
    """

    kind: str
    statement: str
    holds: bool
    evidence: str


@dataclass(frozen=True)
class Trend:
    """Change of the rate from the slowest to the fastest velocity, and its standard error."""

    change: float
    error: float

    @property
    def word(self) -> str:
        """Falls, rises, or neither beyond two standard errors."""
        if abs(self.change) <= 2 * self.error:
            return "is level"
        return "falls" if self.change < 0 else "rises"

    def __str__(self) -> str:
        return f"{self.word} ({100 * self.change:+.1f} +- {100 * self.error:.1f} points)"


def trend(result: Result) -> Trend:
    """Fit a line to the rate by velocity, runs being independent."""
    v = result.velocities - result.velocities.mean()
    weights = v / (v @ v) * (result.velocities.max() - result.velocities.min())
    rates = result.intercepted.mean(axis=2)
    runs = result.runs
    variance = rates.var(axis=1, ddof=1) / runs if runs > 1 else np.full(len(v), np.inf)
    return Trend(float(weights @ rates.mean(axis=1)), float(np.sqrt(weights**2 @ variance)))


def discuss(results: Results, worlds: Sweep) -> list[Finding]:
    """Return all findings, kind by kind."""
    return [
        _identity(),
        *_tables_5_1_and_5_2(results),
        *_configurations(results),
        *_fiducials(results),
        _falls(results),
        _rises(results, worlds),
        _gain(results),
        *_against_spiral(results),
        _position_error(results),
        _met(results),
        _covering(results),
        *_elsewhere(worlds),
    ]


def checks(results: Results, worlds: Sweep) -> dict[str, bool]:
    """Return what this library must show; what so few runs cannot tell passes."""
    held = {
        f"reference simulation met: #{key[0]} {key[1]}"
        + (f", configuration {key[2]}" if key[2] else ""): _meets(result, key)
        for key, result in results.items()
        if key in reference.READINGS
    }
    for k in (1, 2, 3):
        t = trend(results[k, "ukf", thesis.TABLE_5_2_CONFIGURATION[k]])
        held[f"the UKF's rate falls with velocity on #{k}"] = t.change - 3 * t.error < 0
        covering = results[k, "covering", None]
        cells = [covering.at_velocity(float(v)) for v in covering.velocities]
        name = f"covering on #{k}: 99.5 % and 0.25 s at each velocity"
        held[name] = all(_reaches(c, COVERING_RATE, COVERING_TIME) for c in cells)
    for entry in worlds.select(method="covering"):
        if entry.world in HARD_WORLDS:
            name = f"covering on {entry.arrangement}: 99 % with {entry.world}"
            held[name] = _reaches(entry.result, COVERING_RATE_ELSEWHERE, np.inf)
    return held


def _identity() -> Finding:
    gaps = [
        abs(thesis.rate_from_fiducials(*key) - row.interception_rate)
        for key, row in thesis.TABLE_5_2.items()
    ]
    return Finding(
        "figures",
        "the thesis's rates count the registered fiducials as intercepted",
        max(gaps) < 5.1e-5,
        "all six rates of Table 5.2 are those of Tables 5.6 to 5.8 with the registered added, "
        f"to {100 * max(gaps):.3f} points",
    )


def _entries(results: Results) -> list[tuple[str, Result, Measures]]:
    """Return what Tables 5.1 and 5.2 have, each once."""
    printed = thesis.TABLE_5_1["linear_kf"]
    entries = [("linear_kf on #1", results[1, "linear_kf", 6], printed)]
    for (arrangement, method), row in thesis.TABLE_5_2.items():
        config = thesis.TABLE_5_2_CONFIGURATION[arrangement] if method == "ukf" else None
        entries.append((f"{method} on #{arrangement}", results[arrangement, method, config], row))
    return entries


def _tables_5_1_and_5_2(results: Results) -> list[Finding]:
    """Return whether each rate and time, and the position errors, are within ten runs' noise."""
    rates, times, errors = [], [], []
    for name, result, printed in _entries(results):
        sd = ten_runs(result)
        rate = result.interception_rate - printed.interception_rate
        time = result.search_time - printed.search_time
        error = result.position_error - printed.position_error
        rates.append(_within(f"rate of {name}", rate, sd[0], f"{100 * rate:+.1f} points"))
        times.append(_within(f"time of {name}", time, sd[1], f"{time:+.2f} s"))
        if isfinite(error):
            errors.append((name, error, sd[2]))
    told = (f"{name} {1e3 * error:+.1f} mm{_in_sd(error, sd)}" for name, error, sd in errors)
    close = all(abs(error) <= NOISE * sd for _, error, sd in errors)
    statement = f"all position errors are the thesis's within {NOISE:g} sd of ten runs"
    return [*rates, *times, Finding("figures", statement, close, ", ".join(told))]


def _within(name: str, difference: float, sd: float, told: str) -> Finding:
    statement = f"{name} is the thesis's within {NOISE:g} sd of ten runs"
    holds = abs(difference) <= NOISE * sd
    return Finding("figures", statement, holds, told + _in_sd(difference, sd))


def _in_sd(difference: float, sd: float) -> str:
    return f" ({abs(difference) / sd:.1f} sd)" if isfinite(sd) and sd > 0 else ""


def _configurations(results: Results) -> list[Finding]:
    found = []
    for k in (1, 2, 3):
        rows = {
            config: results[k, "ukf", config].interception_rate - printed.interception_rate
            for (arrangement, config), printed in thesis.TABLES_5_3_TO_5_5.items()
            if arrangement == k
        }
        scatter = max(ten_runs(results[k, "ukf", config])[0] for config in rows)
        low, high = min(rows.values()), max(rows.values())
        one_sided = low > NOISE * scatter or high < -NOISE * scatter
        told = f"differences of {100 * low:+.1f} to {100 * high:+.1f} points"
        if one_sided:
            told += ": all on one side, which no scatter of ten runs explains"
        within = [c for c, difference in rows.items() if abs(difference) <= NOISE * scatter]
        told += f"; within {NOISE:g} sd: " + (", ".join(map(str, within)) or "none")
        statement = f"the UKF's {len(rows)} configurations on #{k} scatter about the thesis's"
        found.append(Finding("figures", statement, not one_sided, told + _at_once(results, k)))
    return found


def _at_once(results: Results, arrangement: int) -> str:
    """How the first search of a drive does, before any update of the filter."""
    key = (arrangement, "ukf", thesis.TABLE_5_2_CONFIGURATION[arrangement])
    ours = results[key].interception_rate_by_fiducial[1]
    printed = thesis.BY_FIDUCIAL[arrangement, "ukf"][0]
    way = thesis.DISTANCES[arrangement][0]
    return f"; of fiducial 2, {way:.2f} m on and before any update, {ours:.2f} (thesis {printed})"


def _fiducials(results: Results) -> list[Finding]:
    """Tables 5.6 to 5.8: each rate of the thesis is of 50 searches."""
    found = []
    for method in ("spiral", "ukf"):
        outside, total = [], 0
        for k in (1, 2, 3):
            config = thesis.TABLE_5_2_CONFIGURATION[k] if method == "ukf" else None
            result = results[k, method, config]
            numbers = np.flatnonzero(~result.registered) + 1
            for number, printed in zip(numbers, thesis.BY_FIDUCIAL[k, method], strict=True):
                low, high = wilson(50 * printed, 50)
                total += 1
                if not low <= result.interception_rate_by_fiducial[number - 1] <= high:
                    outside.append(f"#{k} {number}")
        found.append(
            Finding(
                "figures",
                f"nine in ten of the {method}'s rates of single fiducials are within the 95 % of "
                "the thesis's 50 searches",
                len(outside) <= 0.1 * total,
                f"{total - len(outside)} of {total}; not {', '.join(outside) or 'one'}",
            )
        )
    return found


def _falls(results: Results) -> Finding:
    ukf = {k: trend(results[k, "ukf", thesis.TABLE_5_2_CONFIGURATION[k]]) for k in (1, 2, 3)}
    return Finding(
        "claims",
        "the UKF's rate falls with velocity in every arrangement, 5.7",
        all(t.word == "falls" for t in ukf.values()),
        ", ".join(f"#{k} {t}" for k, t in ukf.items()),
    )


def _rises(results: Results, worlds: Sweep) -> Finding:
    here = trend(results[1, "linear_kf", 6])
    told = f"#1 {here} in the standard world, which drifts by the way"
    for entry in worlds.select(method="linear_kf", world=CREEP):
        told += f"; where the base creeps sideways by the time instead it {trend(entry.result)}"
    return Finding(
        "claims", "the linear filter's rate rises with velocity, 5.7", here.word == "rises", told
    )


def _gain(results: Results) -> Finding:
    printed = {name: row.interception_rate for name, row in thesis.TABLE_5_1.items()}
    ukf, linear = (results[1, name, 6] for name in ("ukf", "linear_kf"))
    ours = ukf.interception_rate - linear.interception_rate
    noise = sqrt(ten_runs(ukf)[0] ** 2 + ten_runs(linear)[0] ** 2)
    return Finding(
        "claims",
        "the UKF intercepts more than the linear filter on #1, 5.7",
        ours > NOISE * noise,
        f"{100 * ours:+.1f} points, sd of ten runs {100 * noise:.1f} "
        f"(thesis {100 * (printed['ukf'] - printed['linear_kf']):+.1f})",
    )


def _against_spiral(results: Results) -> list[Finding]:
    found = []
    for k in (1, 2, 3):
        ukf = results[k, "ukf", thesis.TABLE_5_2_CONFIGURATION[k]]
        spiral = results[k, "spiral", None]
        noise = sqrt(ten_runs(ukf)[0] ** 2 + ten_runs(spiral)[0] ** 2)
        printed = (
            thesis.TABLE_5_2[k, "ukf"].interception_rate
            - thesis.TABLE_5_2[k, "spiral"].interception_rate
        )
        ours = ukf.interception_rate - spiral.interception_rate
        found.append(
            Finding(
                "claims",
                f"UKF and spiral differ in the thesis's rate on #{k} by more than ten runs scatter",
                abs(printed) > NOISE * noise,
                f"{100 * printed:+.1f} points, sd {100 * noise:.1f}; here {100 * ours:+.1f}",
            )
        )
    return found


def _position_error(results: Results) -> Finding:
    told, lower = [], []
    for k in (1, 2, 3):
        ukf = results[k, "ukf", thesis.TABLE_5_2_CONFIGURATION[k]].position_error
        spiral = results[k, "spiral", None].position_error
        printed = thesis.TABLE_5_2[k, "ukf"].position_error, thesis.TABLE_5_2[k, "spiral"]
        thesis_gap = printed[0] - printed[1].position_error
        lower.append(ukf < spiral)
        told.append(f"#{k} {1e3 * (ukf - spiral):+.1f} mm (thesis {1e3 * thesis_gap:+.1f})")
    return Finding(
        "claims",
        "the UKF's position error is below the spiral's in every arrangement, 5.7",
        all(lower),
        ", ".join(told) + f"; failed searches count too: {_failed(results)}",
    )


def _failed(results: Results) -> str:
    """Position errors of the UKF's hits and failures on #1, apart."""
    result = results[1, "ukf", thesis.TABLE_5_2_CONFIGURATION[1]]
    hits, misses = (
        result.position_errors[result.searched & (result.intercepted == hit)].mean()
        for hit in (True, False)
    )
    return f"on #1 {1e3 * hits:.1f} mm with hits, {1e3 * misses:.1f} mm without"


def _met(results: Results) -> Finding:
    known = {key: result for key, result in results.items() if key in reference.READINGS}
    missed = [
        f"#{key[0]} {key[1]}" + (f" {key[2]}" if key[2] else "")
        for key, result in known.items()
        if not reference.is_met(
            result.interception_rate, result.search_time, reference.expected(*key)
        )
    ]
    return Finding(
        "library",
        "the reference simulation's figures are met within 3 points and 15 % or 0.1 s",
        not missed,
        f"{len(known) - len(missed)} of {len(known)}"
        + (f"; not {', '.join(missed)}" if missed else ""),
    )


def _covering(results: Results) -> Finding:
    found = [results[k, "covering", None] for k in (1, 2, 3)]
    rate = min(float(r.interception_rate_by_velocity.min()) for r in found)
    time = max(float(r.search_time_by_velocity.max()) for r in found)
    return Finding(
        "library",
        "the covering search has 99.5 % and 0.25 s in each of the arrangement-velocity cells",
        rate >= COVERING_RATE and time <= COVERING_TIME,
        f"at least {100 * rate:.2f} %, at most {time:.2f} s",
    )


def _elsewhere(worlds: Sweep) -> list[Finding]:
    found = []
    for name in dict.fromkeys(entry.world for entry in worlds):
        rows = [entry.result for entry in worlds.select(method="covering", world=name)]
        rate = min(r.interception_rate for r in rows)
        time = max(r.search_time for r in rows)
        found.append(
            Finding(
                "library",
                f"the covering search has 99 % on every arrangement in the world '{name}'",
                rate >= COVERING_RATE_ELSEWHERE,
                f"at least {100 * rate:.1f} %, at most {time:.2f} s",
            )
        )
    return found


def _meets(result: Result, key: tuple[int, str, int | None]) -> bool:
    """Whether the reference's tolerance and this result's interval meet."""
    by = reference.expected(*key)
    within = max(reference.TIME_TOLERANCE * by.search_time, reference.LEAST_TIME_TOLERANCE)
    rates, times = (
        result.interception_interval(LEVEL, unit="run"),
        result.search_time_interval(LEVEL),
    )
    return _meet(rates, by.interception_rate, reference.RATE_TOLERANCE) and _meet(
        times, by.search_time, within
    )


def _meet(interval: Sequence[float], middle: float, half: float) -> bool:
    return interval[0] <= middle + half and interval[1] >= middle - half


def _reaches(result: Result, rate: float, time: float) -> bool:
    """Whether a rate and a time may well be reached: by the intervals' better ends."""
    high = wilson(int(result.intercepted.sum()), result.intercepted.size, LEVEL)[1]
    return high >= rate and result.search_time_interval(LEVEL)[0] <= time
