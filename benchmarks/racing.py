"""What the pytest benchmarks share.

Every peer's answers are checked before it is timed: without --benchmark-enable the directory is a
quick test that all adapters still work and agree.
"""

from collections.abc import Callable
from itertools import cycle
from typing import Any

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from peers import Peer, gather
from problem import Problem, agree

CHECKED = 8
PROBLEM = Problem()
PEERS = gather(PROBLEM)


def contenders(work: str) -> Callable[[Any], Any]:
    """Parametrize a test over the peers that can do a work, as one group of the report."""
    able = [peer for peer in PEERS if work in peer.works()]
    named = pytest.mark.parametrize("peer", able, ids=[peer.name for peer in able])
    return lambda test: pytest.mark.benchmark(group=work)(named(test))


def race(benchmark: BenchmarkFixture, peer: Peer, work: str) -> None:
    """Check a peer's answers against thing_kin's, then time it on ever new inputs."""
    function, expected = peer.works()[work], PEERS[0].works()[work]
    inputs = PROBLEM.inputs[work]
    for x in inputs[:CHECKED]:
        got = peer.answer(work, function(peer.prepare(work, x)))
        assert agree(expected(x), got), f"{peer.name}: {work} differs by more than 1e-9"
    turns = cycle([peer.prepare(work, x) for x in inputs])
    benchmark(lambda: function(next(turns)))
