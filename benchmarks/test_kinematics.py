"""Kinematics of the Thing, one call and batches: all of problem.WORKS but the inverse ones."""

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from peers import Peer
from problem import WORKS
from racing import PEERS, race

PAIRS = [
    pytest.param(work.name, peer, marks=pytest.mark.benchmark(group=work.name))
    for work in WORKS
    if work.name not in ("pinv", "step")
    for peer in PEERS
    if work.name in peer.works()
]


@pytest.mark.parametrize(("work", "peer"), PAIRS, ids=lambda x: getattr(x, "name", x))
def test_kinematics(benchmark: BenchmarkFixture, work: str, peer: Peer) -> None:
    race(benchmark, peer, work)
