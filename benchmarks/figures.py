"""The figures that the benchmarks left in a directory, in one form."""

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

Times = dict[str, dict[str, float]]  # work, contender: seconds


class Lost(NamedTuple):
    """A line where a peer is faster."""

    work: str
    peer: str
    seconds: float
    ours: float


def python_times(content: dict[str, Any]) -> Times:
    times: Times = {}
    for result in content.get("results", []):
        if not result.get("wrong"):
            times.setdefault(result["work"], {})[result["peer"]] = result["seconds"]
    return times


def cpp_times(content: dict[str, Any]) -> Times:
    """Medians of Google Benchmark's own file, in nanoseconds there."""
    times: Times = {}
    for run in content.get("benchmarks", []):
        if run.get("aggregate_name") == "median":
            work, who = run["run_name"].split("/")[:2]
            times.setdefault(work, {})[who] = run["cpu_time"] * 1e-9
    return times


def lost(times: Times) -> list[Lost]:
    return [
        Lost(work, who, seconds, by["thing_kin"])
        for work, by in times.items()
        for who, seconds in by.items()
        if not who.startswith("thing_kin") and seconds < by.get("thing_kin", 0.0)
    ]


@dataclass
class Figures:
    """Empty where a file is missing."""

    directory: Path

    def content(self, name: str) -> dict[str, Any]:
        path = self.directory / name
        content: dict[str, Any] = json.loads(path.read_text()) if path.exists() else {}
        return content

    @cached_property
    def machine(self) -> dict[str, Any]:
        about: dict[str, Any] = self.content("bench.json").get("machine", {})
        return about

    @cached_property
    def titles(self) -> dict[str, str]:
        return {r["work"]: r["title"] for r in self.content("bench.json").get("results", [])}

    @cached_property
    def python(self) -> Times:
        return python_times(self.content("bench.json"))

    @cached_property
    def cpp(self) -> Times:
        return cpp_times(self.content("bench_thing.json"))

    @cached_property
    def scaling(self) -> list[dict[str, Any]]:
        results: list[dict[str, Any]] = self.content("scaling.json").get("results", [])
        return results

    def python_at(self, level: str) -> Times:
        """With certain instructions: those of bench.json, or of a run with --level."""
        if level == self.machine.get("simd_level"):
            return self.python
        return python_times(self.content(f"bench_{level}.json"))
