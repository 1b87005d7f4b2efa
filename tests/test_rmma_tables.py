"""The thesis's numbers against each other, and the tables against what they are made of."""

import dataclasses
import math

import numpy as np
import pytest

import rmma_cases
from thing_kin.rmma import ARRANGEMENTS, CONFIGS, World, named_worlds, reference, tables, thesis
from thing_kin.rmma.reference_worlds import METHODS, WORLDS


@pytest.fixture(scope="module")
def results():
    made = {}
    for seed, (arrangement, config) in enumerate(thesis.TABLES_5_3_TO_5_5):
        made[arrangement, "ukf", config] = rmma_cases.made_up(
            arrangement, "ukf", seed=seed, config=config, runs=30
        )
    for arrangement in (1, 2, 3):
        made[arrangement, "spiral", None] = rmma_cases.made_up(arrangement, "spiral", runs=30)
        made[arrangement, "covering", None] = rmma_cases.made_up(arrangement, "covering", rate=1.0)
        made[arrangement, "linear_kf", 6] = rmma_cases.made_up(arrangement, "linear_kf", rate=0.7)
    return made


def rows(text, count):
    """Cells of the last rows before the notes."""
    lines = [line for line in text.split("\n\n", 1)[1].splitlines() if line.strip()]
    start = next(k for k, line in enumerate(lines) if set(line) == {"-"}) + 1
    return [line.split() for line in lines[start : start + count]]


# The thesis ----------------------------------------------------------------------------------


@pytest.mark.parametrize("key", thesis.TABLE_5_2)
def test_rates_count_the_registered_exactly(key):
    # Printed to 0.01 %.
    assert abs(thesis.rate_from_fiducials(*key) - thesis.TABLE_5_2[key].interception_rate) < 5.1e-5


def test_rates_are_whole_numbers_of_searches():
    for (arrangement, _), row in thesis.TABLES_5_3_TO_5_5.items():
        searches = 5 * thesis.RUNS * len(ARRANGEMENTS[arrangement].registered)
        count = row.interception_rate * searches
        assert abs(count - round(count)) < 0.5e-4 * searches
    for rates in thesis.BY_FIDUCIAL.values():
        np.testing.assert_allclose(50 * np.array(rates), np.round(50 * np.array(rates)))


def test_what_errata_say_can_be_reckoned():
    assert thesis.TABLE_5_1["linear_kf"].interception_rate == pytest.approx(322 / 450, abs=5e-5)
    assert abs(0.7155 - 322 / 450) > 5e-5  # as printed: wrong in its last digit
    assert round(0.8911 * 450) / 450 == pytest.approx(0.8911, abs=5e-5)
    assert abs(round(0.8911 * 225) / 225 - 0.8911) > 5e-5  # no multiple of five runs' 1/225
    assert thesis.TABLES_5_3_TO_5_5[2, 6].interception_rate == 0.8667
    assert thesis.TABLES_5_3_TO_5_5[3, 6].interception_rate == 0.6133
    assert thesis.TABLE_5_2[2, "ukf"].position_error > thesis.TABLE_5_2[2, "spiral"].position_error
    for arrangement in (1, 2, 3):
        ukf, spiral = (thesis.TABLE_5_2[arrangement, m] for m in ("ukf", "spiral"))
        assert ukf.search_time > spiral.search_time
    changed = {
        number: sum(
            getattr(config, field.name) != getattr(CONFIGS[1], field.name)
            for field in dataclasses.fields(config)
        )
        for number, config in CONFIGS.items()
    }
    assert [number for number, count in changed.items() if count == 2] == [4, 5, 7]


def test_distances_are_those_of_the_arrangements():
    for arrangement, expected in thesis.DISTANCES.items():
        ways = [np.abs(np.diff(np.asarray(s)[:, 0])) for s in ARRANGEMENTS[arrangement].sides]
        np.testing.assert_allclose(np.concatenate(ways), expected, atol=1e-12)
    printed, right = thesis.PRINTED_DISTANCES[1], thesis.DISTANCES[1]
    assert [k for k in range(7) if printed[k] != right[k]] == [5, 6]


def test_table_5_2_repeats_the_configurations():
    for arrangement, config in thesis.TABLE_5_2_CONFIGURATION.items():
        assert thesis.TABLE_5_2[arrangement, "ukf"] == thesis.TABLES_5_3_TO_5_5[arrangement, config]


# The reference -------------------------------------------------------------------------------


def test_reference_has_every_entry_of_the_thesis():
    for arrangement, config in thesis.TABLES_5_3_TO_5_5:
        assert (arrangement, "ukf", config) in reference.READINGS
    mean = reference.expected(1, "ukf", 6)
    assert mean.interception_rate == pytest.approx((0.835 + 0.845 + 0.828) / 3)
    assert mean.position_error == pytest.approx((0.0133 + 0.0135) / 2)
    assert math.isnan(reference.expected(1, "ukf", 1).position_error)


def test_reference_is_met_at_its_borders():
    slow, quick = thesis.Measures(0.9, 2.0), thesis.Measures(0.9, 0.5)
    assert reference.is_met(0.9299, 2.299, slow)
    assert reference.is_met(0.8701, 0.401, quick)
    assert not reference.is_met(0.9301, 2.0, slow)
    assert not reference.is_met(0.9, 2.301, slow)
    assert not reference.is_met(0.9, 0.601, quick)


def test_worlds_are_those_of_the_reference():
    worlds = named_worlds()
    assert list(worlds) == list(WORLDS)
    assert worlds["standard"] == World()
    for name, world in worlds.items():
        changed = [
            f.name
            for f in dataclasses.fields(World)
            if getattr(world, f.name) != getattr(World(), f.name)
        ]
        assert bool(changed) == (name != "standard"), name
    assert worlds["drift x2"].slip_std == 2 * World().slip_std
    assert all(tuple(rows) == METHODS for rows in WORLDS.values())


# Tables --------------------------------------------------------------------------------------


def test_table_5_1(results):
    linear, ukf = rows(tables.table_5_1(results), 2)
    assert (linear[0], ukf[0]) == ("linear_kf,", "ukf,")
    ours = 100 * results[1, "linear_kf", 6].interception_rate
    values = [float(x) for x in linear[3:] if x != "-"]
    assert values[0] == pytest.approx(ours, abs=0.0501)
    assert values[1:3] == [71.6, pytest.approx(ours - 71.56, abs=0.0501)]


def test_table_5_2_has_differences_and_the_protocols_spread(results):
    text = tables.table_5_2(results)
    for row, (arrangement, method) in zip(rows(text, 6), thesis.TABLE_5_2, strict=True):
        config = thesis.TABLE_5_2_CONFIGURATION[arrangement] if method == "ukf" else None
        result, printed = (
            results[arrangement, method, config],
            thesis.TABLE_5_2[arrangement, method],
        )
        values = [float(x) for x in row[-12:]]
        spread = result.spread(10)
        expected = []
        for unit, name, sd in (
            (100.0, "interception_rate", spread.interception_rate),
            (1.0, "search_time", spread.search_time),
            (1000.0, "position_error", spread.position_error),
        ):
            ours, theirs = unit * getattr(result, name), unit * getattr(printed, name)
            expected += [ours, theirs, ours - theirs, unit * sd]
        np.testing.assert_allclose(values, expected, atol=0.0501)


def test_few_runs_have_no_spread():
    assert all(math.isnan(sd) for sd in tables.ten_runs(rmma_cases.made_up(1, runs=1)))


@pytest.mark.parametrize(("arrangement", "count"), [(1, 7), (2, 6), (3, 6)])
def test_tables_5_3_to_5_5(results, arrangement, count):
    laid = rows(tables.table_of_configurations(results, arrangement), count)
    assert [row[0] for row in laid] == [f"{k}:" for k in range(1, count + 1)]
    for config, row in enumerate(laid, start=1):
        printed = thesis.TABLES_5_3_TO_5_5[arrangement, config]
        assert float(row[-11]) == pytest.approx(100 * printed.interception_rate, abs=0.0501)
        assert float(row[-7]) == pytest.approx(printed.search_time)


@pytest.mark.parametrize("arrangement", [1, 2, 3])
def test_tables_5_6_to_5_8(results, arrangement):
    printed = thesis.BY_FIDUCIAL[arrangement, "spiral"]
    laid = rows(tables.table_of_distances(results, arrangement), len(printed))
    assert [float(row[-2]) for row in laid] == list(printed)
    assert [float(row[3]) for row in laid] == list(thesis.DISTANCES[arrangement])
    for row in laid:
        assert row[1] == "to"
        k = int(row[2]) - 1
        ours = results[arrangement, "spiral", None].interception_rate_by_fiducial[k]
        assert float(row[-3]) == pytest.approx(ours, abs=0.00501)


def test_table_of_reference_tells_what_is_met(results):
    text = tables.table_of_reference(results)
    for key in reference.READINGS:
        by, result = reference.expected(*key), results[key]
        name = f"#{key[0]} {key[1]}" + (f", configuration {key[2]} " if key[2] else " ")
        (line,) = [line for line in text.splitlines() if line.startswith(name)]
        met = reference.is_met(result.interception_rate, result.search_time, by)
        assert line.split()[-1] == ("yes" if met else "NO")


def test_table_of_methods_names_extremes(results):
    text = tables.table_of_methods(results)
    (line,) = [line for line in text.splitlines() if line.startswith("spiral")]
    spirals = [results[k, "spiral", None] for k in (1, 2, 3)]
    least = 100 * min(r.interception_rate_by_velocity.min() for r in spirals)
    longest = max(r.search_time_by_velocity.max() for r in spirals)
    assert float(line.split()[-4]) == pytest.approx(least, abs=0.0501)
    assert float(line.split()[-3]) == pytest.approx(longest, abs=0.00501)
    assert "ukf, Table 5.2's configurations" in text
    assert "ukf, configuration 6" in text


def test_table_of_velocities(results):
    text = tables.table_of_velocities(results)
    (line,) = [x for x in text.splitlines() if x.startswith("#2 ukf, configuration 5")]
    rates = 100 * results[2, "ukf", 5].interception_rate_by_velocity
    np.testing.assert_allclose([float(x) for x in line.split()[4:9]], rates, atol=0.0501)
    assert float(line.split()[-1]) == pytest.approx(rates[-1] - rates[0], abs=0.0501)
