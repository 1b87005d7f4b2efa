"""Figures: what is drawn is what was given, in the right axes."""

import itertools
import subprocess
import sys

import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

import thing_kin as tk
from thing_kin import viz
from thing_kin.viz.style import CYCLE

ROBOT = tk.robots.thing()
Q = ROBOT.random(12, rng=0)
BODY = (0.96, 0.793, 0.3)


def test_stick_figure_joins_the_frames_from_the_base_on():
    points = viz.stick_figure(ROBOT, Q)
    assert points.shape == (12, len(ROBOT.frames) - ROBOT.frames.index("base"), 3)
    np.testing.assert_array_equal(points[3, -1], ROBOT.fk(Q[3])[:3, 3])
    np.testing.assert_array_equal(points[3, 0, :2], ROBOT.base_pose(Q[3])[:2])
    arm = tk.robots.ur5()
    assert viz.stick_figure(arm, np.zeros(6)).shape == (len(arm.frames), 3)


@pytest.mark.parametrize(("view", "i", "j"), [("above", 0, 1), ("side", 0, 2), ("front", 1, 2)])
def test_views_show_the_right_coordinates(view, i, j):
    T, base = ROBOT.fk(Q), ROBOT.base_pose(Q)
    figure = viz.plot_path(T, base, view=view)
    (axes,) = figure.axes
    hand, ground = (line.get_xydata() for line in axes.lines)
    np.testing.assert_array_equal(hand, T[:, [i, j], 3])
    np.testing.assert_array_equal(ground, (base * [1, 1, 0])[:, [i, j]])
    assert (axes.get_xlabel(), axes.get_ylabel()) == (f"{'xyz'[i]} [m]", f"{'xyz'[j]} [m]")
    assert axes.get_aspect() == 1.0
    assert axes.xaxis.get_inverted() == (view == "front")
    by_position = viz.plot_path(T[:, :3, 3], view=view).axes[0].lines
    assert len(by_position) == 1
    np.testing.assert_array_equal(by_position[0].get_xydata(), hand)


@pytest.mark.parametrize(
    "plot", [viz.plot_path, lambda Q, view: viz.plot_stick_figures(ROBOT, Q, view=view)]
)
def test_unknown_view_is_refused(plot):
    with pytest.raises(ValueError, match="view: got 'below', expected 'above', 'side' or 'front'"):
        plot(np.zeros((2, 9)), view="below")


def test_stick_figures_and_boxes_are_drawn_in_given_axes():
    axes = Figure().add_subplot()
    q = np.array([0.0, 0, 0, 0, 0, 0, 1.0, 2.0, np.pi / 2])
    figure = viz.plot_stick_figures(ROBOT, q, body=BODY, axes=axes)
    assert figure is axes.figure
    np.testing.assert_array_equal(axes.lines[0].get_xydata(), viz.stick_figure(ROBOT, q)[:, :2])
    (box,) = axes.patches
    corners = box.get_xy()
    # Turned by a quarter, the box is long in y.
    np.testing.assert_allclose(np.ptp(corners, axis=0), (0.793, 0.96), atol=1e-12)
    np.testing.assert_allclose(corners[:4].mean(axis=0), (1.0, 2.0), atol=1e-12)
    side = viz.plot_stick_figures(ROBOT, q, body=BODY, view="side").axes[0].patches[0].get_xy()
    np.testing.assert_allclose(side.min(axis=0), (1.0 - 0.793 / 2, 0.0), atol=1e-12)
    np.testing.assert_allclose(side.max(axis=0), (1.0 + 0.793 / 2, 0.3), atol=1e-12)


def test_parts_of_a_figure_return_the_whole():
    whole = Figure()
    part, _ = whole.subfigures(1, 2)
    assert viz.plot_path(np.zeros((3, 3)), axes=part.add_subplot()) is whole


def test_joints_come_with_their_limits():
    arm, base, heading = viz.plot_joints(ROBOT, Q).axes
    for axes, joints in ((arm, range(6)), (base, (6, 7)), (heading, (8,))):
        lines = [line for line in axes.lines if line.get_linestyle() != ":"]
        assert [line.get_label() for line in lines] == [ROBOT.names[j] for j in joints]
        for line, j in zip(lines, joints, strict=True):
            np.testing.assert_array_equal(line.get_ydata(), Q[:, j])
        limits = sorted(line.get_ydata()[0] for line in axes.lines if line.get_linestyle() == ":")
        np.testing.assert_array_equal(limits, (ROBOT.lower[joints[0]], ROBOT.upper[joints[0]]))


def test_joints_of_long_chains_without_limits():
    chain = tk.Chain.from_dh([tk.DH(a=0.1, joint="revolute")] * 5 + [tk.DH(joint="prismatic")] * 5)
    chain = chain.with_limits(lower=np.full(10, -np.inf), upper=np.full(10, np.inf))
    (axes,) = viz.plot_joints(chain, np.zeros((4, 10))).axes
    assert len(axes.lines) == 10 > len(CYCLE)
    assert axes.get_ylabel() == "joints [rad or m]"


def test_singular_values_with_and_without_the_filter():
    h = tk.SingularValueFilter(sigma0=0.01, nu=10.0)
    values = {"one": np.geomspace(1e-6, 1, 20), "two": np.full(20, 0.5)}
    (axes,) = viz.plot_singular_values(values, singular_value_filter=h).axes
    solid, dashed = axes.lines[0::2], axes.lines[1::2]
    for (name, value), line, lifted in zip(values.items(), solid, dashed, strict=True):
        assert (line.get_label(), lifted.get_label()) == (name, f"{name}, filtered")
        np.testing.assert_array_equal(line.get_ydata(), value)
        np.testing.assert_array_equal(lifted.get_ydata(), h(value))
        assert line.get_color() == lifted.get_color()
    assert axes.get_yscale() == "log"
    assert len(viz.plot_singular_values(values).axes[0].lines) == 2


def test_joint_steps_side_by_side():
    near = np.arange(12) > 8
    figure = viz.plot_joint_steps({"a": Q, "b": 10 * Q}, shade=near, shade_label="near")
    steps = np.abs(np.diff(Q, axis=0)).max(axis=1)
    for axes, scale in zip(figure.axes, (1, 10), strict=True):
        np.testing.assert_allclose(axes.lines[0].get_ydata(), scale * steps, rtol=1e-15)
        np.testing.assert_array_equal(axes.lines[0].get_xdata(), np.arange(1, 12))
        assert len(axes.collections) == 1
    assert figure.axes[0].get_ylim() == figure.axes[1].get_ylim()
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["near"]


@pytest.mark.parametrize(("robot", "body"), [(ROBOT, BODY), (ROBOT, None), (tk.robots.ur5(), BODY)])
def test_animation_moves(tmp_path, robot, body):
    q = np.linspace(np.zeros(robot.n), np.full(robot.n, 0.8), 30)
    path = viz.animate(robot, q, tmp_path / "a.gif", body=body, frames=8, fps=20)
    with Image.open(path) as gif:
        assert gif.n_frames == 8
        assert gif.info["duration"] == 50
        pictures = []
        for k in range(8):
            gif.seek(k)
            pictures.append(np.asarray(gif.convert("RGB")).astype(int))
    moved = [np.abs(b - a).max() for a, b in itertools.pairwise(pictures)]
    assert min(moved) > 50


def test_animation_of_fewer_configurations_than_frames(tmp_path):
    with Image.open(viz.animate(ROBOT, Q[:3], str(tmp_path / "b.gif"), frames=60)) as gif:
        assert gif.n_frames == 3


def test_a_plan_from_above():
    T = ROBOT.fk(Q)
    disc = tk.Disc(center=(1.0, 2.0), radius=0.4)
    base = ROBOT.base_pose(Q)
    figure = viz.plot_plan(
        ROBOT, Q, poses=T, base_goal=base, base_radius=0.3, heading=(-0.5, 0.5), obstacles=[disc]
    )
    (axes,) = figure.axes
    keep_out, *tube, wedge = axes.patches
    assert (keep_out.center, keep_out.radius) == ((1.0, 2.0), 0.4)
    assert [patch.center for patch in tube] == [tuple(row) for row in base[:, :2]]
    assert {patch.radius for patch in tube} == {0.3}
    assert (wedge.center, wedge.theta1) == (tuple(base[-1, :2]), np.degrees(-0.5))
    lines = {line.get_label(): line.get_xydata() for line in axes.lines}
    np.testing.assert_allclose(lines["hand"], T[:, :2, 3], atol=1e-14)
    np.testing.assert_array_equal(lines["hand, as asked"], T[:, :2, 3])
    np.testing.assert_array_equal(lines["base"], base[:, :2])
    one = viz.plot_plan(ROBOT, Q[0], poses=T[0]).axes[0]
    assert "base" not in {line.get_label() for line in one.lines}
    assert not one.patches


def test_dexterity_of_paths():
    (axes,) = viz.plot_dexterity(ROBOT, {"a": Q, "b": Q[::-1]}).axes
    for line, q in zip(axes.lines, (Q, Q[::-1]), strict=True):
        np.testing.assert_allclose(line.get_ydata(), ROBOT.dexterity(q), rtol=1e-14)
    assert axes.lines[0].get_label().startswith("a, mean ")


def test_a_trajectory_beside_its_limits():
    trajectory = tk.move_to(ROBOT, Q[0], Q[1])
    figure = viz.plot_trajectory(ROBOT, trajectory, velocity_limits=np.arange(1.0, 10.0))
    positions, velocities, accelerations = figure.axes
    t = positions.lines[4].get_xdata()
    assert (t[0], t[-1]) == (0.0, trajectory.duration)
    q, qd, qdd = trajectory.sample(t)
    np.testing.assert_array_equal(positions.lines[4].get_ydata(), q[:, 4])
    np.testing.assert_array_equal(velocities.lines[4].get_ydata(), qd[:, 4] / 5.0)
    share = qdd[:, 4] / ROBOT.acceleration_limits[4]
    np.testing.assert_array_equal(accelerations.lines[4].get_ydata(), share)
    assert np.ptp(accelerations.get_ylim()) > 2.0


def test_figures_need_no_display_and_no_pyplot(tmp_path):
    code = (
        "import sys, numpy as np; sys.path[:] = eval(sys.argv[1])\n"
        "from thing_kin import viz\n"
        "viz.plot_path(np.zeros((2, 3))).savefig(sys.argv[2])\n"
        "assert 'matplotlib.pyplot' not in sys.modules\n"
    )
    target = tmp_path / "figure.png"
    subprocess.run(
        [sys.executable, "-c", code, repr(sys.path), str(target)], check=True, timeout=60
    )
    assert target.stat().st_size > 1000


def test_missing_matplotlib_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(ImportError, match=r"pip install thing_kin\[viz\]"):
        viz.plot_path(np.zeros((2, 3)))


def test_a_trace_shows_what_happened():
    value, slope = (lambda x: x @ x - 1, lambda x: 2 * x)
    circle = tk.terms.Function(value, slope, lambda x: 2 * np.eye(2))
    problem = tk.Problem(n=2)
    problem.minimize(tk.terms.Function(lambda x: 100 * x[0], lambda x: [100.0, 0.0]))
    problem.equal(circle)
    trace = tk.sqp(problem, (2.0, 1.0)).trace
    assert 0 < (~trace.accepted).sum() < len(trace)
    figure = viz.plot_trace(trace)
    above, middle, below = figure.axes
    iteration = np.arange(1, len(trace) + 1)
    for axes, drawn in ((above, trace.objective), (middle, np.maximum(trace.violation, 1e-16))):
        np.testing.assert_array_equal(axes.lines[0].get_xydata(), np.c_[iteration, drawn])
    np.testing.assert_array_equal(above.lines[1].get_xdata(), iteration[~trace.accepted])
    for line, drawn in zip(below.lines, (trace.radius, trace.penalty), strict=True):
        np.testing.assert_array_equal(line.get_ydata(), drawn)
    assert (middle.get_yscale(), below.get_yscale()) == ("log", "log")
