"""The targets of the library's kinematics beside what was measured."""

from collections.abc import Callable, Iterator
from typing import NamedTuple

from figures import Figures, Times

Measure = Callable[[Figures], float]


class Target(NamedTuple):
    """A ratio that is to be reached at least, a time (seconds) at most."""

    title: str
    bound: float
    unit: str
    measure: Measure

    def is_met(self, value: float) -> bool:
        return value <= self.bound if self.unit == "ms" else value >= self.bound

    def shown(self, value: float) -> str:
        return f"{value * 1e3:.1f} ms" if self.unit == "ms" else f"{value:.1f} times"


def over_best(times: Times, work: str, peer: str) -> float:
    """The peer's best time over thing_kin's."""
    by = times[work]
    return min(s for who, s in by.items() if who.startswith(peer)) / by["thing_kin"]


def cpp(work: str, peer: str) -> Measure:
    return lambda figures: over_best(figures.cpp, work, peer)


def python(work: str, peer: str, level: str | None = None) -> Measure:
    return lambda figures: over_best(
        figures.python_at(level) if level else figures.python, work, peer
    )


def batch_over_calls(figures: Figures) -> float:
    return (
        figures.cpp["fk_and_jacobian"]["thing_kin"]
        / (figures.cpp["fk_and_jacobian_batch"]["thing_kin"])
    )


NUMPY = "numpy_vectorized"
TARGETS = (
    Target("fk, C++, over Pinocchio", 2.2, "x", cpp("fk", "pinocchio")),
    Target("fk and Jacobian, C++, over Pinocchio", 3.0, "x", cpp("fk_and_jacobian", "pinocchio")),
    Target("fk, one Python call, over Pinocchio", 2.0, "x", python("fk", "pinocchio")),
    Target("Jacobian, one Python call, over Pinocchio", 1.2, "x", python("jacobian", "pinocchio")),
    Target("fk batch, avx512, over numpy", 30.0, "x", python("fk_batch", NUMPY, "avx512")),
    Target("fk batch, avx2, over numpy", 18.0, "x", python("fk_batch", NUMPY, "avx2")),
    Target(
        "fk and Jacobian batch, C++, over a Pinocchio loop",
        10.0,
        "x",
        cpp("fk_and_jacobian_batch", "pinocchio"),
    ),
    Target("fk and Jacobian batch, C++, over single calls", 10.0, "x", batch_over_calls),
    Target("import, beyond numpy", 0.05, "ms", lambda f: f.python["import"]["thing_kin"]),
)


def rows(figures: Figures) -> Iterator[list[str]]:
    """Title, target, measured, met; what was not run is left out of the last two."""
    for target in TARGETS:
        is_time = target.unit == "ms"
        bound = f"≤ {target.bound * 1e3:g} ms" if is_time else f"≥ {target.bound:g} times"
        try:
            value = target.measure(figures)
        except (KeyError, ValueError):
            yield [target.title, bound, "…", "…"]
            continue
        met = "yes" if target.is_met(value) else "**no**"
        yield [target.title, bound, target.shown(value), met]
