"""Measures of the experiment, against loops written out and against known distributions."""

import csv
import math
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

import rmma_cases
from thing_kin.rmma import ARRANGEMENTS, Result
from thing_kin.rmma.intervals import mean_of_runs, student, wilson


def each(result):
    """Every (velocity, run, fiducial)."""
    return np.ndindex(result.intercepted.shape)


def test_measures_are_those_of_a_loop():
    result = rmma_cases.made_up(1, seed=3)
    hits = time = error = tried = found = searches = first = 0
    for k in each(result):
        hits += bool(result.intercepted[k])
        time += result.search_times[k]
        if result.searched[k]:
            searches += 1
            error += result.position_errors[k]
            first += bool(result.intercepted[k] and result.samples[k] == 1)
        if not result.registered[k[2]]:
            tried += 1
            found += bool(result.intercepted[k])
    count = 5 * 20 * 9
    assert (tried, count - tried) == (700, 200)
    assert result.interception_rate == pytest.approx(hits / count, rel=1e-14)
    assert result.interception_rate_searched == pytest.approx(found / tried, rel=1e-14)
    assert result.search_time == pytest.approx(time / count, rel=1e-12)
    assert result.position_error == pytest.approx(error / searches, rel=1e-12)
    assert result.first_stop_rate == pytest.approx(first / tried, rel=1e-14)
    assert 0 < searches < tried  # some were skipped: they count as missed, in no time


def test_registered_and_searched_rates_fit():
    result = rmma_cases.made_up(2)
    n, sides = 6, 1
    rate = (result.interception_rate_by_fiducial[1:].sum() + sides) / n
    assert result.interception_rate == pytest.approx(rate, rel=1e-14)
    assert result.interception_rate_searched == pytest.approx((rate * n - sides) / (n - sides))


def test_parts_add_up():
    result = rmma_cases.made_up(3, seed=8)
    assert result.interception_rate_by_velocity.shape == (5,)
    assert result.interception_rate_by_velocity.mean() == pytest.approx(result.interception_rate)
    assert result.search_time_by_fiducial.mean() == pytest.approx(result.search_time)
    weights = result.searched.sum(axis=(1, 2))
    weighted = np.average(result.position_error_by_velocity, weights=weights)
    assert weighted == pytest.approx(result.position_error)
    assert np.isnan(result.position_error_by_fiducial[[0, 3]]).all()
    for k, velocity in enumerate(result.velocities):
        part = result.at_velocity(velocity)
        assert part.interception_rate == pytest.approx(result.interception_rate_by_velocity[k])
        assert part.search_time == pytest.approx(result.search_time_by_velocity[k])
        np.testing.assert_array_equal(part.samples[0], result.samples[k])
    with pytest.raises(ValueError, match=r"velocity: got 0\.5, expected one of"):
        result.at_velocity(0.5)


def test_nothing_searched_is_no_warning():
    result = rmma_cases.made_up(1, rate=0.0)
    none = Result(
        result.arrangement,
        "ukf",
        result.velocities,
        result.registered,
        result.intercepted,
        np.zeros_like(result.searched),
        np.zeros_like(result.search_times),
        np.full_like(result.position_errors, np.nan),
        np.zeros_like(result.samples),
    )
    assert math.isnan(none.position_error)
    assert none.interception_rate == pytest.approx(2 / 9)
    assert none.interception_rate_searched == 0.0
    assert "-" in none.table()


def test_shapes_must_fit():
    result = rmma_cases.made_up(1)
    with pytest.raises(ValueError, match="samples: got shape"):
        Result(*[getattr(result, name) for name in list(vars(result))[:8]], result.samples[:, 1:])
    with pytest.raises(ValueError, match="intercepted: got shape"):
        rmma_cases.made_up(1, runs=0)


# Statistics ----------------------------------------------------------------------------------


@given(st.integers(1, 400), st.data(), st.floats(0.5, 0.999))
def test_wilson_is_where_the_score_test_turns(trials, data, level):
    hits = data.draw(st.integers(0, trials))
    z = stats.norm.ppf(0.5 + level / 2)
    low, high = wilson(hits, trials, level)
    for bound in (low, high):
        score = (hits / trials - bound) ** 2 * trials
        assert score == pytest.approx(z * z * bound * (1 - bound), abs=1e-9)
    assert 0.0 <= low <= hits / trials + 1e-12
    assert hits / trials - 1e-12 <= high <= 1.0
    assert high - low > 0.0


@pytest.mark.parametrize("freedom", [1, 2, 3, 4, 5, 10, 45, 46, 1000, 4995])
@pytest.mark.parametrize("level", [0.5, 0.9, 0.95, 0.999])
def test_students_quantile(freedom, level):
    assert student(freedom, level) == pytest.approx(stats.t.ppf(0.5 + level / 2, freedom), rel=1e-9)


def test_interval_of_one_velocity_is_students():
    values = np.random.default_rng(5).normal(2.0, 0.3, (1, 12))
    expected = stats.t.interval(0.9, 11, values.mean(), stats.sem(values[0]))
    np.testing.assert_allclose(mean_of_runs(values, 0.9), expected, rtol=1e-10)


def test_intervals_of_runs_cover():
    # Velocities of different means: their differences are no scatter. 600 trials, sd 0.9 points.
    rng = np.random.default_rng(1)
    means = np.array([[0.0], [3.0], [9.0]])
    inside = 0
    for _ in range(600):
        low, high = mean_of_runs(rng.normal(means, [[1.0], [2.0], [1.0]], (3, 20)))
        inside += low < means.mean() < high
    assert 0.92 < inside / 600 < 0.98


def test_one_run_has_no_interval_and_gaps_are_left_out():
    assert mean_of_runs(np.ones((3, 1))) == (-math.inf, math.inf)
    values = np.array([[1.0, 2.0, np.nan, 3.0]])
    np.testing.assert_allclose(mean_of_runs(values), mean_of_runs(values[:, [0, 1, 3]]))
    for bad in (0.0, 1.0, -0.5, math.nan):
        with pytest.raises(ValueError, match="level: got"):
            wilson(1, 2, bad)


def test_intervals_of_a_result():
    result = rmma_cases.made_up(1, runs=50)
    fiducial, run = (result.interception_interval(unit=unit) for unit in ("fiducial", "run"))
    for low, high in (fiducial, run):
        assert low < result.interception_rate < high
    # Made-up searches are independent, so both intervals agree.
    assert fiducial[1] - fiducial[0] == pytest.approx(run[1] - run[0], rel=0.2)
    # The registered are certain: they shift and shrink the interval of the others.
    low, high = stats.binomtest(
        int(result.intercepted[:, :, ~result.registered].sum()), 5 * 50 * 7
    ).proportion_ci(method="wilson")
    np.testing.assert_allclose(fiducial, [(2 + 7 * low) / 9, (2 + 7 * high) / 9], rtol=1e-12)
    assert result.search_time_interval()[0] < result.search_time < result.search_time_interval()[1]
    low, high = result.position_error_interval()
    assert low < result.position_error < high
    with pytest.raises(ValueError, match="unit: got 'side'"):
        result.interception_interval(unit="side")


def test_searches_that_fail_together_widen_the_runs_interval_only():
    result = rmma_cases.made_up(1, runs=40)
    lost = np.random.default_rng(2).random((5, 40, 1)) < 0.3
    hit = np.broadcast_to(~lost, result.intercepted.shape) | result.registered
    parts = {name: getattr(result, name) for name in vars(result)}
    together = Result(**{**parts, "intercepted": hit})
    fiducial, run = (together.interception_interval(unit=unit) for unit in ("fiducial", "run"))
    assert run[1] - run[0] > 2.0 * (fiducial[1] - fiducial[0])  # sqrt(7) = 2.6 in theory


def test_spread_is_that_of_repetitions():
    result = rmma_cases.made_up(2, runs=4000, rate=0.9)
    spread = result.spread(10)
    cut = [slice(10 * k, 10 * k + 10) for k in range(400)]
    for name, values, searched in (
        ("interception_rate", result.intercepted, np.ones_like(result.searched)),
        ("search_time", result.search_times, np.ones_like(result.searched)),
        ("position_error", result.position_errors, result.searched),
    ):
        blocks = [values[:, part][searched[:, part]].mean() for part in cut]
        # A standard deviation of 400 blocks has one of 3.5 %.
        assert getattr(spread, name) == pytest.approx(np.std(blocks, ddof=1), rel=0.12)
    assert spread.runs == 10
    assert result.spread(40).search_time == pytest.approx(spread.search_time / 2, rel=1e-12)
    with pytest.raises(ValueError, match="runs: got 0"):
        result.spread(0)
    with pytest.raises(ValueError, match="runs: got 10 of 1"):
        rmma_cases.made_up(2, runs=1).spread()


# Text and files ------------------------------------------------------------------------------


def test_table_has_every_velocity_and_fiducial():
    result = rmma_cases.made_up(1, config=6)
    text = result.table()
    by_velocity, by_fiducial = text.split("by fiducial")
    assert "arrangement #1, ukf, configuration 6: 5 velocities x 20 runs" in text.splitlines()[0]
    for velocity, rate in zip(result.velocities, result.interception_rate_by_velocity, strict=True):
        (line,) = [x for x in by_velocity.splitlines() if x.startswith(f"{100 * velocity:g} cm/s")]
        assert float(line.split()[2]) == pytest.approx(100 * rate, abs=0.05001)
    rows = [line.split() for line in by_fiducial.splitlines() if line[:1].isdigit()]
    assert [int(row[0]) for row in rows[:9]] == list(range(1, 10))
    assert sum("registered" in row for row in rows) == 2
    assert "0.99" in rows[6]  # from fiducial 6 to 7
    assert max(map(len, text.splitlines())) < 100


def test_one_run_still_has_a_table():
    assert "needs two runs" in rmma_cases.made_up(2, runs=1).table()


def test_repr_is_short():
    assert len(repr(rmma_cases.made_up(1, config=6))) < 90


def test_csv_holds_every_search(tmp_path):
    result = rmma_cases.made_up(3, runs=3)
    with result.to_csv(tmp_path / "searches.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 5 * 3 * 9
    for row, k in zip(rows, each(result), strict=True):
        assert (float(row["velocity_m_s"]), int(row["run"]), int(row["fiducial"])) == (
            result.velocities[k[0]],
            k[1] + 1,
            k[2] + 1,
        )
        assert float(row["search_time_s"]) == result.search_times[k]
        assert bool(int(row["intercepted"])) == result.intercepted[k]
        error = result.position_errors[k]
        assert row["position_error_m"] == ("" if math.isnan(error) else repr(float(error)))


def test_pandas_holds_the_same():
    pytest.importorskip("pandas")
    result = rmma_cases.made_up(1, runs=4)
    frame = result.to_pandas()
    by = frame.groupby("velocity_m_s")["intercepted"].mean()
    np.testing.assert_allclose(by.to_numpy(), result.interception_rate_by_velocity)
    assert frame["position_error_m"].mean() == pytest.approx(result.position_error)


def test_without_pandas_it_says_so(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match="pip install pandas"):
        rmma_cases.made_up(1, runs=1).to_pandas()


def test_arrangements_have_the_thesis_sides():
    assert [ARRANGEMENTS[k].registered.sum() for k in (1, 2, 3)] == [2, 1, 2]
