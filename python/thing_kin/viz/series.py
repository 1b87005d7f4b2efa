"""What changes along a path: joints, singular values, joint steps."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import cycle
from typing import TYPE_CHECKING

import numpy as np

from thing_kin.viz.style import BLACK, CYCLE, RED, axes_or_new, figure_of, new_figure, tidy

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike, NDArray

    from thing_kin import Chain, SingularValueFilter


def plot_joints(robot: Chain, Q: ArrayLike) -> Figure:
    """Joints along a path with their position limits, the base's own in panels of their own.

    Parameters
    ----------
    robot : Chain
    Q : (N, n), rad and m

    Examples
    --------
    >>> import thing_kin as tk
    >>> from thing_kin import viz
    >>> robot = tk.robots.thing()
    >>> figure = viz.plot_joints(robot, robot.random(20, rng=0))
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['arm [rad]', 'base [m]', 'heading [rad]']
    """
    Q = np.asarray(Q, dtype=float)
    base: tuple[int, ...] = robot.base_joints or ()
    arm = [j for j in range(robot.n) if j not in base]
    unit = "rad or m" if any(robot.joint_types[j] == "prismatic" for j in arm) else "rad"
    groups = [(f"{'arm' if base else 'joints'} [{unit}]", arm)]
    if base:
        groups += [("base [m]", list(base[:2])), ("heading [rad]", list(base[2:]))]
    heights = [2.4, 1.0, 0.7][: len(groups)]
    figure = new_figure(figsize=(9, 1.8 * sum(heights)))
    panels = figure.subplots(
        len(groups), 1, sharex=True, squeeze=False, gridspec_kw={"height_ratios": heights}
    )[:, 0]
    for axes, (label, joints) in zip(panels, groups, strict=True):
        _plot_group(axes, robot, Q, joints)
        tidy(axes, ylabel=label)
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    panels[-1].set_xlabel("pose")
    return figure


def plot_singular_values(
    values: Mapping[str, ArrayLike],
    *,
    singular_value_filter: SingularValueFilter | None = None,
    axes: Axes | None = None,
) -> Figure:
    """Singular values along a path, on a log scale; dashed: what a filter makes of them.

    Parameters
    ----------
    values : mapping of names to (N,)
    singular_value_filter : SingularValueFilter, optional
    axes : matplotlib Axes, optional
        Where to draw; default: a new figure.

    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> from thing_kin import viz
    >>> robot = tk.robots.thing()
    >>> sigma = np.linalg.svd(robot.jacobian(robot.random(30, rng=0)), compute_uv=False)
    >>> h = tk.SingularValueFilter(sigma0=0.01, nu=10.0)
    >>> figure = viz.plot_singular_values({"J": sigma[:, -1]}, singular_value_filter=h)
    >>> figure.axes[0].get_yscale()
    'log'
    """
    axes = axes_or_new(axes, figsize=(9, 4))
    for (name, value), color in zip(values.items(), cycle(CYCLE), strict=False):
        sigma = np.asarray(value, dtype=float)
        axes.plot(sigma, color=color, linewidth=1.3, label=name)
        if singular_value_filter is not None:
            lifted = singular_value_filter(sigma)
            axes.plot(lifted, "--", color=color, linewidth=1.3, label=f"{name}, filtered")
    axes.set_yscale("log")
    tidy(axes, xlabel="pose", ylabel="singular value")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    return figure_of(axes)


def plot_joint_steps(
    runs: Mapping[str, ArrayLike], *, shade: NDArray[np.bool_] | None = None, shade_label: str = ""
) -> Figure:
    """Largest joint step from each pose to the next, runs side by side on one log scale.

    Parameters
    ----------
    runs : mapping of names to (N, n), rad and m
    shade : (N,) of bool, optional
        Poses to mark, such as those near a singular posture.
    shade_label : str

    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import viz
    >>> t = np.linspace(0, 1, 50)[:, None]
    >>> figure = viz.plot_joint_steps({"slow": t * np.ones(9), "fast": 5 * t * np.ones(9)})
    >>> len(figure.axes)
    2
    """
    figure = new_figure(figsize=(5.0 * len(runs), 4.2))
    panels = figure.subplots(1, len(runs), sharey=True, squeeze=False)[0]
    for axes, (name, Q), color in zip(panels, runs.items(), cycle(CYCLE), strict=False):
        step = np.abs(np.diff(np.asarray(Q, dtype=float), axis=0)).max(axis=1)
        axes.plot(np.arange(1, len(step) + 1), step, color=color, linewidth=1.0)
        axes.set_yscale("log")
        tidy(axes, title=name, xlabel="pose")
        if shade is not None:
            _shade(axes, shade, shade_label)
    panels[0].set_ylabel("largest joint step [rad or m]")
    if shade is not None and shade_label:
        handles, labels = panels[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", frameon=False)
    return figure


def _plot_group(axes: Axes, robot: Chain, Q: NDArray[np.float64], joints: list[int]) -> None:
    for joint, color in zip(joints, cycle(CYCLE), strict=False):
        axes.plot(Q[:, joint], color=color, linewidth=1.3, label=robot.names[joint])
    limits = {*robot.lower[joints], *robot.upper[joints]}
    for k, limit in enumerate(sorted(limit for limit in limits if np.isfinite(limit))):
        label = "limit" if k == 0 else None
        axes.axhline(limit, color=BLACK, linestyle=":", linewidth=1.2, label=label)


def _shade(axes: Axes, marked: NDArray[np.bool_], label: str) -> None:
    poses = np.arange(len(marked))
    axes.fill_between(
        poses,
        0,
        1,
        where=marked,
        step="mid",
        transform=axes.get_xaxis_transform(),
        color=RED,
        alpha=0.18,
        linewidth=0,
        label=label or None,
    )
