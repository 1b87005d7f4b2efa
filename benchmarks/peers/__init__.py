"""Everybody who can do some of the works: one file each, which registers itself.

A new peer is a new file in this directory: a subclass of Peer under @register, with a method for
each work of problem.WORKS that it can do.
"""

import importlib
import pkgutil
from collections.abc import Callable
from typing import Any, ClassVar

from problem import WORKS, Problem

REGISTRY: list[type["Peer"]] = []


class Peer:
    """An adapter. Its works are its methods of those names; each takes one prepared input."""

    name: ClassVar[str]
    note: ClassVar[str]  # what exactly is timed

    def __init__(self, problem: Problem) -> None:
        self.robot = problem.robot

    @staticmethod
    def available() -> bool:
        """Whether it can be imported here."""
        return True

    def prepare(self, work: str, x: Any) -> Any:
        """Bring an input into the form that the peer's own users have; not timed."""
        return x

    def answer(self, work: str, result: Any) -> Any:
        """Bring a result into an array for the checker; not timed."""
        return result

    def works(self) -> dict[str, Callable[[Any], Any]]:
        return {w.name: getattr(self, w.name) for w in WORKS if hasattr(self, w.name)}


def register(peer: type[Peer]) -> type[Peer]:
    REGISTRY.append(peer)
    return peer


def gather(problem: Problem) -> list[Peer]:
    """All peers that are available here, thing_kin first."""
    for module in pkgutil.iter_modules(__path__):
        importlib.import_module(f"{__name__}.{module.name}")
    found = sorted(REGISTRY, key=lambda peer: (peer.name != "thing_kin", peer.name))
    return [peer(problem) for peer in found if peer.available()]
