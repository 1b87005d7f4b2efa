"""Figures of the experiment: what is drawn is what was found, in the right frames."""

import subprocess
import sys

import numpy as np
import pytest
from matplotlib.patches import Circle, Ellipse, Rectangle

import rmma_cases
from thing_kin import rmma, viz
from thing_kin.rmma import thesis
from thing_kin.viz.rmma import error_bars
from thing_kin.viz.rmma_animation import tool_at

PANELS = {"5.1": 2, "5.2": 3, "5.3": 3, "5.4": 3, "5.5": 6, "5.6": 2, "5.7": 3, "5.8": 6}


@pytest.fixture(scope="module")
def results():
    made = {
        (arrangement, "ukf", config): rmma_cases.made_up(arrangement, "ukf", seed=config, runs=30)
        for arrangement, config in thesis.TABLES_5_3_TO_5_5
    }
    for k in (1, 2, 3):
        made[k, "spiral", None] = rmma_cases.made_up(k, "spiral", runs=30, rate=0.9)
        made[k, "linear_kf", 6] = rmma_cases.made_up(k, "linear_kf", runs=30, rate=0.7)
    return made


def lines_of(axes):
    """Data of the lines with at least two points."""
    return [line.get_xydata() for line in axes.lines if len(line.get_xdata()) > 1]


def test_a_result_by_velocity_and_by_fiducial():
    result = rmma_cases.made_up(1, seed=2)
    axes = result.plot().axes
    assert len(axes) == 6
    expected = np.stack([100 * result.velocities, 100 * result.interception_rate_by_velocity], 1)
    np.testing.assert_allclose(lines_of(axes[0])[0], expected)
    heights = [bar.get_height() for bar in axes[4].patches if isinstance(bar, Rectangle)]
    np.testing.assert_allclose(heights, result.search_time_by_fiducial)
    words = [text.get_text() for text in axes[3].texts]
    assert words == ["registered", "registered"]
    assert "arrangement #1" in axes[0].figure.get_suptitle()


def test_one_run_is_drawn_without_bars():
    result = rmma_cases.made_up(2, runs=1)
    assert len(result.plot().axes) == 6  # and no warning


def test_error_bars_have_no_infinite_length():
    bars = error_bars(np.array([0.5, 0.5]), np.array([[0.4, 0.7], [-np.inf, np.inf]]))
    np.testing.assert_allclose(bars, [[0.1, 0.0], [0.2, 0.0]])


def test_methods_side_by_side():
    results = {
        name: rmma_cases.made_up(2, name, seed=k) for k, name in enumerate(("spiral", "ukf"))
    }
    figure = viz.plot_rmma_methods(results)
    for axes in figure.axes:
        assert [line.get_label() for line in axes.containers] == ["spiral", "ukf"]
    rate = [container[0].get_ydata() for container in figure.axes[0].containers]
    np.testing.assert_allclose(rate[1], 100 * results["ukf"].interception_rate_by_velocity)


@pytest.mark.parametrize(
    ("number", "panels"),
    [
        ("5.1", 2),
        ("5.2", 3),
        ("5.3", 3),
        ("5.4", 3),
        ("5.5", 6),
        ("5.6", 2),
        ("5.7", 3),
        ("5.8", 6),
    ],
)
def test_the_thesis_figures(results, number, panels):
    figure = viz.plot_rmma_thesis_figure(number, results)
    assert len(figure.axes) == panels
    assert f"figure {number}:" in figure.get_suptitle()


def test_the_thesis_means_stand_where_they_are_printed(results):
    figure = viz.plot_rmma_thesis_figure("5.2", results)
    units = (100.0, 1.0, 1e3)
    names = ("interception_rate", "search_time", "position_error")
    for axes, unit, name in zip(figure.axes, units, names, strict=True):
        drawn = sorted(
            float(line.get_ydata()[0])
            for line in axes.lines
            if line.get_marker() == "D" and len(line.get_ydata())
        )
        printed = [unit * getattr(thesis.TABLE_5_2[1, m], name) for m in ("spiral", "ukf")]
        np.testing.assert_allclose(drawn, sorted(printed))


def test_rates_by_distance_are_those_of_the_fiducials(results):
    axes = viz.plot_rmma_thesis_figure("5.8", results).axes[0]
    labels = [tick.get_text() for tick in axes.get_xticklabels()]
    assert labels[0] == "0.21\n(5)"
    assert labels[-1] == "0.99\n(7)"
    (ours,) = [line for line in axes.lines if line.get_label() == "here"]
    rates = 100 * results[1, "ukf", 6].interception_rate_by_fiducial
    np.testing.assert_allclose(ours.get_ydata()[[0, -1]], [rates[4], rates[6]])


def test_an_unknown_figure_is_refused(results):
    with pytest.raises(ValueError, match=r"number: got '5\.9', expected one of 5\.1, "):
        viz.plot_rmma_thesis_figure("5.9", results)


def test_arrangements_have_their_fiducials():
    figure = viz.plot_rmma_arrangements()
    assert [axes.get_title() for axes in figure.axes] == [f"arrangement #{k}" for k in (1, 2, 3)]
    for axes, arrangement in zip(figure.axes, rmma.ARRANGEMENTS.values(), strict=True):
        numbers = {text.get_text(): text.xy for text in axes.texts if text.get_text()}
        points = np.concatenate(arrangement.sides)
        for k, point in enumerate(points):
            np.testing.assert_allclose(numbers[str(k + 1)], point)
    own = rmma.Arrangement([[[0.0, 0.6]]], name="mine")  # of one fiducial
    assert len(viz.plot_rmma_arrangements([own]).axes) == 1


# A run ---------------------------------------------------------------------------------------


def test_a_run_stands_in_map_coordinates():
    trace = rmma_cases.made_up_trace(1)
    axes = viz.plot_rmma_run_from_above(trace).axes[0]
    squares = [
        x.get_xydata()[0] for x in axes.lines if x.get_marker() == "s" and len(x.get_xdata())
    ]
    np.testing.assert_allclose(squares, [(1.62, 1.51), (3.09, 2.23)], atol=1e-12)
    crosses = [line for line in axes.lines if line.get_marker() == "X" and len(line.get_xdata())]
    missed = [
        side.to_map(side.fiducials[search.fiducial])
        for side in trace.sides
        for search in side.searches
        if not search.hit
    ]
    np.testing.assert_allclose([line.get_xydata()[0] for line in crosses], missed)


def test_each_search_is_enlarged_in_millimeters():
    trace = rmma_cases.made_up_trace(1)
    figure = viz.plot_rmma_run(trace, detection_radius=0.012)
    panels = figure.axes[1:]
    searches = [(side, search) for side in trace.sides for search in side.searches]
    assert len(panels) == len(searches) == 7
    for axes, (side, search) in zip(panels, searches, strict=True):
        stops = 1e3 * (search.stops - side.fiducials[search.fiducial])
        np.testing.assert_allclose(axes.collections[0].get_offsets(), stops)
        (circle,) = [p for p in axes.patches if isinstance(p, Circle)]
        assert circle.get_radius() == 12.0
        ellipses = [p for p in axes.patches if isinstance(p, Ellipse) and not isinstance(p, Circle)]
        assert len(ellipses) == (search.covariance is not None)
        if ellipses:  # two sigma to each side of diag(1e-4, 3e-5) m^2
            size = sorted((ellipses[0].width, ellipses[0].height))
            np.testing.assert_allclose(size, 4e3 * np.sqrt([3e-5, 1e-4]))
        half = axes.get_xlim()[1]
        assert np.abs(stops).max() < half
    assert [axes.get_title().split("\n")[0] for axes in panels] == [
        f"fiducial {k}" for k in (2, 3, 5, 6, 7, 8, 9)
    ]


@pytest.mark.parametrize("method", ["spiral", "linear_kf", "ukf", "covering"])
def test_real_runs_can_be_drawn(method):
    trace = rmma.trace(3, method, velocity=0.02, rng=4)
    figure = viz.plot_rmma_run(trace)
    assert len(figure.axes) == 1 + sum(len(side.searches) for side in trace.sides)
    for side in trace.sides:
        for search in side.searches:
            if search.hit:  # within the standard world's radius, and its hidden errors
                gap = np.linalg.norm(search.stops[-1] - side.fiducials[search.fiducial])
                assert gap < 0.012 + 1e-9
            np.testing.assert_allclose(
                search.base_at_stops[:, 0],
                np.interp(search.stop_times, side.times, side.base[:, 0]),
                atol=1e-9,
            )


def test_the_arm_follows_its_stops():
    trace = rmma_cases.made_up_trace(1)
    for side in trace.sides:
        np.testing.assert_allclose(tool_at(side, side.times[0]), side.fiducials[0], atol=1e-12)
        for search in side.searches:
            for t, stop in zip(search.stop_times, search.stops, strict=True):
                np.testing.assert_allclose(tool_at(side, t), stop, atol=1e-9)
        # It moves without a jump: never faster than the base and a move of the arm.
        t = np.linspace(side.times[0], side.times[-1], 4000)
        steps = np.linalg.norm(np.diff([tool_at(side, x) for x in t], axis=0), axis=1)
        assert steps.max() < 0.05


def test_the_movie(tmp_path):
    image = pytest.importorskip("PIL.Image")
    trace = rmma_cases.made_up_trace(1)
    path = viz.animate_rmma_run(trace, tmp_path / "run.gif", frames=7, fps=10)
    with image.open(path) as movie:
        assert movie.n_frames == 7
        assert movie.info["duration"] == 100
        first = np.asarray(movie.convert("RGB")).astype(int)
        movie.seek(6)
        last = np.asarray(movie.convert("RGB")).astype(int)
    green = np.array(
        [0, 158, 115]
    )  # what was intercepted: nothing of side 2 at first, most at last
    count = [(np.abs(picture - green).sum(axis=2) < 40).sum() for picture in (first, last)]
    assert count[1] > 3 * count[0] > 0


# Which search when ---------------------------------------------------------------------------


def made_up_practice():
    rates = np.full((6, 2, 2), 0.5)
    rates[1, 0, 0] = 0.995  # the spiral does with little drift and a small radius
    rates[5, 0, 1] = rates[5, 1] = 0.999
    rates[3, 1, 1] = 0.99
    rates[:, 1, 0] = np.linspace(0.5, 0.98, 6)  # here nothing does
    return rmma.Practice(
        tuple(rmma.practices.METHODS),
        np.array([0.006, 0.012]),
        np.array([1.0, 2.0]),
        rates,
        np.full(rates.shape, 1.5),
        10,
    )


def test_the_least_demanding_search_is_taken():
    practice = made_up_practice()
    assert practice.choice(0, 0) == (1, True)
    assert practice.choice(0, 1) == (5, True)
    assert practice.choice(1, 0) == (5, False)
    assert practice.choice(1, 1) == (3, True)
    lines = practice.table().splitlines()[2:]
    assert lines[0].endswith("spiral, gap = radius")
    assert lines[2].endswith("covering (below 99 %)")


def test_the_map_shows_what_to_take(tmp_path):
    practice = made_up_practice()
    figure = viz.plot_rmma_practice(practice)
    cells = figure.axes[-1].texts
    assert [cell.get_text().split("\n")[0] for cell in cells] == [
        "spiral,",
        "covering",
        "covering",
        "covering,",
    ]
    hatched = [patch.get_hatch() for patch in figure.axes[-1].patches]
    assert [bool(hatch) for hatch in hatched] == [False, False, True, False]
    assert len(practice.to_csv(tmp_path / "p.csv").read_text().splitlines()) == 1 + 24


def test_importing_figures_brings_neither_the_experiment_nor_matplotlib():
    code = (
        "import sys, thing_kin.viz; "
        "print(sorted({'thing_kin.rmma', 'thing_kin._search', 'matplotlib'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
