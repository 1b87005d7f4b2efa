"""Markdown tables from figures: one function for each table of docs/benchmarks.md."""

from collections.abc import Iterable
from typing import Any

import targets as kinematics_targets
from figures import Figures, Times, lost
from report import shown

PYTHON_PEERS = {
    "Pinocchio": ("pinocchio",),
    "KDL": ("kdl", "pykdl"),
    "numpy": ("numpy_vectorized", "numpy_linalg"),
    "RTB": ("rtb",),
}
CPP_PEERS = {
    "Pinocchio": ("pinocchio", "pinocchio_frame", "pinocchio_cod", "pinocchio_svd"),
    "KDL": ("kdl",),
    "Eigen": ("eigen_cod", "eigen_svd"),
    "eiquadprog": ("eiquadprog",),
}
CPP_TITLES = {
    "fk": "forward kinematics",
    "fk_and_jacobian": "pose and Jacobian",
    "fk_batch": "forward kinematics, batch",
    "fk_and_jacobian_batch": "pose and Jacobian, batch",
    "jacobian_dot": "time derivative of the Jacobian",
    "drift": "dJ/dt qd",
    "pinv_6x9": "pseudoinverse",
    "velocity": "the Jacobian's inverse times a twist",
    "step": "task priority (4.18), exact",
    "step_regularized": "the same, filtered and selectively damped",
    "step_limited": "hand, base and posture within limits",
    "qp_9_6_18": "quadratic program: 9 variables, 6 equations, 18 sides",
    "ik_all_ur10": "all eight solutions of a UR10 in closed form",
}
NONE = "\N{EN DASH}"
LEVELS = ("avx512", "avx2", "baseline")


def table(header: list[str], rows: Iterable[list[str]]) -> str:
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def time(seconds: float | None) -> str:
    return NONE if seconds is None else shown(seconds).replace("us", "µs")


def against(by: dict[str, float], names: tuple[str, ...]) -> str:
    """Times of a peer's variants, each with its ratio to thing_kin's; bold where it wins."""
    cells = []
    for who in (name for name in names if name in by):
        ratio = by[who] / by["thing_kin"]
        variant = who.partition("_")[2]
        tag = f"{variant} " if variant in ("cod", "svd", "frame") else ""
        text = f"{tag}{time(by[who])} ({ratio:.{0 if ratio >= 9.95 else 1}f})"
        cells.append(text if ratio >= 1.0 else f"**{text}**")
    return ", ".join(cells) or NONE


def machine(figures: Figures) -> str:
    about = figures.machine
    rows = [
        ["CPU", f"{about['cpu']}, {about['cpus']} processors, `{about['simd_level']}`"],
        ["Python, numpy, pin", f"{about['python']}, {about['numpy']}, {about['pin']}"],
        ["Robotics Toolbox (RTB)", about.get("rtb") or "not installed"],
        ["date, version", f"{about['date']}, {about['thing_kin']}"],
    ]
    return table(["", ""], rows)


def python(figures: Figures) -> str:
    rows = [
        [figures.titles[work], time(by["thing_kin"])]
        + [against(by, names) for names in PYTHON_PEERS.values()]
        for work, by in figures.python.items()
    ]
    return table(["work", "thing_kin", *PYTHON_PEERS], rows)


def levels(figures: Figures) -> str:
    """Batches at each level; in brackets the ratio to numpy in the same run."""
    by_level = {level: figures.python_at(level) for level in LEVELS}

    def cell(times: Times, work: str) -> str:
        by = times.get(work, {})
        if "numpy_vectorized" not in by:
            return time(by.get("thing_kin"))
        return f"{time(by['thing_kin'])} ({by['numpy_vectorized'] / by['thing_kin']:.0f})"

    batches = [work for work in figures.python if "batch" in work]
    rows = [[figures.titles[w], *(cell(t, w) for t in by_level.values())] for w in batches]
    return table(["work", *LEVELS], rows)


def cpp(figures: Figures) -> str:
    best = figures.content("bench_thing.json")["context"]["simd_level"]
    names = {level: f"thing_kin_{level}" if level != best else "thing_kin" for level in LEVELS}
    rows = [
        [f"`{work}`: {title}", *(time(by.get(name)) for name in names.values())]
        + [against(by, peers) for peers in CPP_PEERS.values()]
        for work, title in CPP_TITLES.items()
        if (by := figures.cpp.get(work))
    ]
    return table(["work", *LEVELS, *CPP_PEERS], rows)


def won_by_peers(figures: Figures) -> str:
    lines = [("Python", x) for x in lost(figures.python)] + [("C++", x) for x in lost(figures.cpp)]
    return (
        "\n".join(
            f"- {side}, `{x.work}`: {x.peer} {time(x.seconds)}, thing_kin {time(x.ours)}"
            for side, x in lines
        )
        or "No line is lost to a peer in this run."
    )


def targets(figures: Figures) -> str:
    return table(["target", "bound", "measured", "met"], kinematics_targets.rows(figures))


def memory(figures: Figures) -> str:
    """The largest batch at the best level: wall time of a pose."""
    ours = [r for r in figures.scaling if r["who"] == "thing_kin"]
    best = figures.content("scaling.json")["machine"]["simd_level"]
    largest = max(r["size"] for r in ours)

    def cell(work: str, out: bool, threads: int | None) -> str:
        wanted: dict[str, Any] = {"work": work, "out": out, "threads": threads, "level": best}
        wanted["size"] = largest
        found = [r for r in ours if all(r[key] == value for key, value in wanted.items())]
        return time(found[0]["seconds"] if found else None)

    rows = [
        [f"`{work}`{', `out=`' if out else ''}", cell(work, out, 1), cell(work, out, None)]
        for work in ("fk", "fk_quaternion")
        for out in (False, True)
    ]
    rows.append(["`fk_and_jacobian`", *(cell("fk_and_jacobian", False, n) for n in (1, None))])
    return table([f"{largest} poses, {best}", "one thread", "all threads"], rows)
