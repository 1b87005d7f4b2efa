"""From times to the table that users read."""

import os
import platform
from collections.abc import Iterator
from datetime import date
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from statistics import median
from typing import NamedTuple

import numpy as np

import thing_kin as tk
from problem import Work

HEADER = f"{'work':<46} {'thing_kin':>9}  {'peer':<17} {'median':>8} {'ratio':>6}  >= 1"


class Line(NamedTuple):
    """One work, one peer; thing_kin's own line comes first and has the ratio 1."""

    work: Work
    peer: str
    seconds: float  # median, per item
    ours: float  # thing_kin's, in the same rounds
    wrong: bool = False  # the peer's answers differ, and it was not timed

    @property
    def ratio(self) -> float:
        return self.seconds / self.ours


def lines_of(work: Work, times: dict[str, list[float]]) -> Iterator[Line]:
    medians = {name: median(seconds) / work.items for name, seconds in times.items()}
    ours = medians.pop("thing_kin")
    yield Line(work, "thing_kin", ours, ours)
    for name, seconds in medians.items():
        yield Line(work, name, seconds, ours)


def shown(seconds: float) -> str:
    """With three digits and a unit that fits."""
    for unit, scale in (("ns", 1e9), ("us", 1e6), ("ms", 1e3)):
        if seconds * scale < 1000:
            return f"{seconds * scale:.3g} {unit}"
    return f"{seconds:.3g} s"


def rows(lines: list[Line]) -> Iterator[str]:
    """One row a peer; the work's title and thing_kin's median stand in the first."""
    title, ours = lines[0].work.title, shown(lines[0].seconds)
    peers: list[Line | None] = [*lines[1:]]
    for line in peers or [None]:
        start = f"{title:<46} {ours:>9}"
        title = ours = ""
        if line is None:
            yield f"{start}  no peer here"
        elif line.wrong:
            yield f"{start}  {line.peer:<17} not timed: differs from thing_kin by more than 1e-9"
        else:
            verdict = "yes" if line.ratio >= 1.0 else "NO"
            yield f"{start}  {line.peer:<17} {shown(line.seconds):>8} {line.ratio:6.2f}  {verdict}"


def summary(lines: list[Line]) -> str:
    peers = [line for line in lines if line.peer != "thing_kin"]
    wrong = sum(line.wrong for line in peers)
    lost = sum(line.ratio < 1.0 for line in peers)
    return f"{len(peers)} lines, {lost} below 1, {wrong} not timed"


def version_of(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def machine(cpu: int | None) -> dict[str, str | int | None]:
    """What the figures belong to."""
    info = Path("/proc/cpuinfo")
    text = info.read_text() if info.exists() else ""
    models = [line.split(":")[1].strip() for line in text.splitlines() if "model name" in line]
    return {
        "cpu": models[0] if models else platform.processor(),
        "cpus": os.cpu_count(),
        "pinned_to": cpu,
        "simd_level": tk.simd_level(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "pin": version_of("pin"),
        "rtb": version_of("roboticstoolbox-python"),
        "thing_kin": tk.__version__,
        "date": date.today().isoformat(),
    }
