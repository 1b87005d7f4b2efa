"""Forward kinematics, Jacobian and Hessian of the Thing, one call and batches."""

from pytest_benchmark.fixture import BenchmarkFixture

from peers import Peer
from racing import contenders, race


@contenders("fk")
def test_fk(benchmark: BenchmarkFixture, peer: Peer) -> None:
    race(benchmark, peer, "fk")


@contenders("jacobian")
def test_jacobian(benchmark: BenchmarkFixture, peer: Peer) -> None:
    race(benchmark, peer, "jacobian")


@contenders("hessian")
def test_hessian(benchmark: BenchmarkFixture, peer: Peer) -> None:
    race(benchmark, peer, "hessian")


@contenders("fk_batch")
def test_fk_batch(benchmark: BenchmarkFixture, peer: Peer) -> None:
    race(benchmark, peer, "fk_batch")


@contenders("jacobian_batch")
def test_jacobian_batch(benchmark: BenchmarkFixture, peer: Peer) -> None:
    race(benchmark, peer, "jacobian_batch")
