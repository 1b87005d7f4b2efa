"""Grids: in order, whatever is finished first, and the same on every executor."""

import csv
import sys
import threading
from concurrent.futures import Executor, Future, ThreadPoolExecutor

import numpy as np
import pytest

from thing_kin import rmma
from thing_kin.rmma import sweeps

GRID = {"arrangements": [1, 2], "methods": ["spiral", "ukf"], "runs": 3, "progress": False}


class Backwards(Executor):
    """Begins with what was submitted last, when all are there."""

    def __init__(self, expected):
        self.expected, self.waiting = expected, []

    def submit(self, call, *arguments):
        future = Future()
        self.waiting.append((future, call, arguments))
        if len(self.waiting) == self.expected:
            for future_, call_, arguments_ in reversed(self.waiting):
                future_.set_result(call_(*arguments_))
        return future


def equal(a, b):
    assert [e.seed for e in a] == [e.seed for e in b]
    for one, other in zip(a, b, strict=True):
        np.testing.assert_array_equal(one.result.samples, other.result.samples)
        np.testing.assert_array_equal(one.result.search_times, other.result.search_times)
    return True


@pytest.fixture(scope="module")
def grid():
    with ThreadPoolExecutor(2) as pool:
        return rmma.sweep(**GRID, configs=[1, 6], executor=pool)


def test_order_is_the_grids(grid):
    assert [(e.arrangement, e.method, e.config) for e in grid] == [
        ("#1", "spiral", None),
        ("#1", "ukf", 1),
        ("#1", "ukf", 6),
        ("#2", "spiral", None),
        ("#2", "ukf", 1),
        ("#2", "ukf", 6),
    ]
    assert [e.result.intercepted.shape[2] for e in grid] == [9, 9, 9, 6, 6, 6]
    # The same drives for all methods: see entry_seed.
    assert len({e.seed for e in grid}) == 2
    assert grid[0].seed == grid[2].seed != grid[3].seed


def test_the_executor_does_not_matter(grid):
    assert equal(grid, rmma.sweep(**GRID, configs=[1, 6], executor=Backwards(6)))
    with ThreadPoolExecutor(1) as pool:
        assert equal(grid, rmma.sweep(**GRID, configs=[1, 6], executor=pool))


def test_processes_by_default(grid):
    some = rmma.sweep([2], ["spiral"], runs=3, progress=False)
    assert equal(some, grid.select(arrangement="#2", method="spiral"))


def test_what_else_is_in_the_grid_does_not_matter(grid):
    with ThreadPoolExecutor() as pool:
        other = rmma.sweep(**{**GRID, "arrangements": [2]}, configs=[6], executor=pool)
        again = rmma.sweep(**GRID, configs=[1, 6], rng=1, executor=pool)
    assert equal(other.select(method="ukf"), grid.select(arrangement="#2", config=6))
    assert {e.seed for e in again}.isdisjoint(e.seed for e in grid)


def test_seeds_are_written_down():
    # By `printf '7\\n#1\\nstandard' | sha256sum`, the first eight bytes, lowest first, halved.
    expected = int.from_bytes(bytes.fromhex("5448fd9894a852fe"), "little") // 2
    assert sweeps.entry_seed(7, "#1", "standard") == expected


def test_methods_and_worlds_by_names_of_ones_own():
    worlds = {"near": rmma.World(detection_radius=0.006), "wide": rmma.World()}
    methods = {"blind": {"method": "covering", "odometry": "none"}, "spiral": {}}
    with ThreadPoolExecutor() as pool:
        grid = rmma.sweep([2], methods, worlds=worlds, runs=2, executor=pool, progress=False)
    assert [(e.method, e.world) for e in grid] == [
        ("blind", "near"),
        ("blind", "wide"),
        ("spiral", "near"),
        ("spiral", "wide"),
    ]
    assert grid[0].result.method == "covering"
    assert len(grid.select(world="wide")) == 2


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"arrangements": [4]}, "arrangements: got 4"),
        ({"arrangements": [1, 1]}, "arrangements: got .* twice"),
        ({"methods": "ukf"}, "methods: got 'ukf'"),
        ({"methods": ["ukf"], "configs": [99]}, "config: got 99"),
    ],
)
def test_misuse(wrong, message):
    with ThreadPoolExecutor() as pool, pytest.raises(ValueError, match=message):
        rmma.sweep(**{**GRID, **wrong}, executor=pool)


def test_a_failure_cancels_what_has_not_begun():
    begun, go = [], threading.Event()

    class Slow(ThreadPoolExecutor):
        def submit(self, call, entry):
            def work():
                begun.append(1)
                if entry.get("config") == 99:
                    raise ValueError("config: got 99")
                go.wait(10)
                return call(entry)

            return super().submit(work)

    with Slow(1) as pool:
        with pytest.raises(ValueError, match="99"):
            rmma.sweep([1], ["ukf"], configs=[99, 1, 2, 3, 4], executor=pool, progress=False)
        go.set()
    assert len(begun) <= 2


def test_unknown_names_are_not_silently_nothing(grid):
    with pytest.raises(ValueError, match="methods: expected one of"):
        grid.select(methods="ukf")


def test_tables(grid, tmp_path):
    lines = grid.table().splitlines()
    assert len(lines) == 2 + len(grid)
    assert "95 % by run" in lines[0]
    with grid.to_csv(tmp_path / "sweep.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row, entry in zip(rows, grid, strict=True):
        assert float(row["interception_rate"]) == entry.result.interception_rate
        assert row["config"] == ("" if entry.config is None else str(entry.config))
        assert int(row["seed"]) == entry.seed
    assert str(len(grid)) in repr(grid)


def test_pandas(grid):
    pytest.importorskip("pandas")
    frame = grid.to_pandas()
    assert list(frame["method"]) == [e.method for e in grid]


def test_progress_on_stderr_only_and_only_with_tqdm(capsys, monkeypatch):
    with ThreadPoolExecutor() as pool:
        rmma.sweep([2], ["spiral"], runs=1, executor=pool)
        output = capsys.readouterr()
        assert "searching" in output.err
        assert not output.out
        monkeypatch.setitem(sys.modules, "tqdm", None)
        rmma.sweep([2], ["spiral"], runs=1, executor=pool)
        assert not capsys.readouterr().err


# Which search when ---------------------------------------------------------------------------


def test_practice_is_the_mean_over_arrangements():
    with ThreadPoolExecutor(2) as pool:
        options = {"runs": 2, "velocities": (0.02,), "arrangements": (1, 2), "executor": pool}
        practice = rmma.practice(radii=(0.012, 0.006), drifts=(1.0, 2.0), **options)
        rough = rmma.named_worlds()["drift x2"]
        grid = rmma.sweep(
            [1, 2],
            {"covering": {}, "wide": {"method": "spiral", "spiral_gap": 0.012}},
            worlds={"2": rough},  # as it is called there: the seed hangs on it
            runs=2,
            velocities=(0.02,),
            executor=pool,
            progress=False,
        )
    for method, label in (("covering", "covering"), ("wide", "spiral, gap = radius")):
        entries = grid.select(method=method)
        m = practice.methods.index(label)
        rate = np.mean([entry.result.interception_rate for entry in entries])
        assert practice.rates[m, 0, 1] == pytest.approx(rate, rel=1e-12)
        time = np.mean([entry.result.search_time for entry in entries])
        assert practice.times[m, 0, 1] == pytest.approx(time, rel=1e-12)


@pytest.mark.parametrize("name", ["radii", "drifts"])
@pytest.mark.parametrize("bad", [(), (0.0,), (-1.0,), (np.nan,), (np.inf,), (1.0, 1.0), ((1.0,),)])
def test_practice_refuses(name, bad):
    with pytest.raises(ValueError, match=f"{name}: got "):
        rmma.practice(**{name: bad})
