"""Methods in other worlds, with the reference simulation's figures."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from thing_kin.rmma.layout import columns, number, percent
from thing_kin.rmma.reference_worlds import METHODS, WORLDS

if TYPE_CHECKING:
    from thing_kin.rmma.sweeps import Sweep


def table_of_worlds(worlds: Sweep) -> str:
    """Rates and times of arrangements #1, #2, #3 by world and method."""
    header = ["world", "method", "rates [%]", "reference", "times [s]", "reference"]
    rows = []
    for name in dict.fromkeys(entry.world for entry in worlds):
        for k, method in enumerate(METHODS):
            entries = worlds.select(world=name, method=method)
            if not len(entries):
                continue
            found = [entry.result for entry in entries]
            reference = WORLDS[name][method]
            rows.append(
                [
                    name if k == 0 else "",
                    method,
                    _joined(percent(r.interception_rate) for r in found),
                    _joined(percent(rate) for rate in reference.rates),
                    _joined(number(r.search_time) for r in found),
                    _joined(number(time) for time in reference.times),
                ]
            )
    runs = max((e.result.runs for e in worlds if e.method in METHODS), default=0)
    title = f"Other worlds, nothing tuned anew: #1 / #2 / #3, {runs} runs at each velocity"
    return f"{title}\n\n{columns(header, rows, left=2)}"


def _joined(cells: Iterable[str]) -> str:
    return " / ".join(cells)
