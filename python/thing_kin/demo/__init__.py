"""The Thing wipes a wall panel with its whole body, [M17] (4.18); `thing-kin demo` runs it."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

import thing_kin as tk
from thing_kin.demo import follow, wall
from thing_kin.demo.measure import measure
from thing_kin.demo.report import Outcome, summary

__all__ = ["run", "solve"]

POSES, BRIEF_POSES = 600, 200


def solve(poses: int = POSES, advance: Callable[[], object] = lambda: None) -> Outcome:
    """Follow the path with both schemes, from one start; `advance` is called after each pose."""
    robot, path = tk.robots.thing(), wall.wall_path(poses)
    robust, plain = follow.robust_solver(robot), follow.plain_solver(robot)
    first = wall.WallPath(path.hand[:1], path.base[:1], 0.0)
    start = follow.follow(robust, np.r_[wall.HOME, path.base[0]], first).q[0]
    robust_run = follow.follow(robust, start, path, advance)
    plain_run = follow.follow(plain, start, path, advance)
    return Outcome(
        robot=robot,
        path=path,
        beyond_reach=wall.beyond_reach(robot, path),
        robust=robust_run,
        plain=plain_run,
        robust_measures=measure(robust, robust_run, path),
        plain_measures=measure(plain, plain_run, path),
    )


def run(out: Path, *, brief: bool = False, plots: bool = True) -> dict[str, Any]:
    """Run the whole demo; returns what it wrote to `out`/summary.json.

    Parameters
    ----------
    out : Path
        Directory for summary.json and the pictures; made if it does not exist.
    brief : bool
        Fewer poses, no animation and no pictures of the planners.
    plots : bool
        Whether to draw at all (needs the extra `viz`).

    Raises
    ------
    ImportError
        If plots are wanted and matplotlib is missing.
    """
    if plots:
        from thing_kin.viz.style import new_figure

        new_figure()  # says what is missing now, and not after the work
    out.mkdir(parents=True, exist_ok=True)
    poses = BRIEF_POSES if brief else POSES
    with _progress(2 * poses + 5 * plots - (plots and brief)) as advance:
        outcome = solve(poses, advance)
        result = {**summary(outcome), "brief": brief, "files": ["summary.json"]}
        if plots:
            from thing_kin.demo.figures import write_figures

            result["files"] += write_figures(outcome, out, animation=not brief, advance=advance)
    if plots and not brief:
        from thing_kin.demo.plans import write_plans

        result["files"] += write_plans(out)
    (out / "summary.json").write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    return result


@contextlib.contextmanager
def _progress(total: int) -> Iterator[Callable[[], object]]:
    """Show a bar on stderr if tqdm is there; yields what moves it on by one."""
    try:
        from tqdm import tqdm
    except ImportError:
        yield lambda: None
        return
    with tqdm(total=total, desc="wiping", unit="pose", leave=False) as bar:
        yield bar.update
