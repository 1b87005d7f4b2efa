"""The command line: `thing-kin`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

import thing_kin as tk

OK, CHECKS_FAILED, USAGE = 0, 1, 2
LEAST_RUNS = 20  # of `rmma`: as rmma.reproduce has it

EPILOG = "exit codes: 0 all went well, 1 the command's own checks failed, 2 wrong usage"


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return the exit code; default arguments: the process's own."""
    arguments = _parser().parse_args(argv)
    command: Callable[[argparse.Namespace], int] = arguments.command
    return command(arguments)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="thing-kin",
        description="The numerical heart of a mobile manipulator.",
        epilog=EPILOG,
    )
    parser.add_argument("--version", action="version", version=f"thing-kin {tk.__version__}")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    demo = commands.add_parser(
        "demo",
        help="the Thing wipes a wall panel with its whole body",
        description="The Thing (Ridgeback + UR10) wipes a 3 m wall panel by task priority, [M17] "
        "(4.18), through near-singular arm postures; beside it, the plain pseudoinverse.",
        epilog=EPILOG,
    )
    demo.add_argument(
        "--out",
        type=Path,
        metavar="DIR",
        default=Path("thing_kin_demo"),
        help="where summary.json and the pictures go (default: %(default)s)",
    )
    demo.add_argument("--brief", action="store_true", help="fewer poses, no animation")
    demo.add_argument("--no-plots", action="store_true", help="no pictures; needs no matplotlib")
    demo.set_defaults(command=_demo)
    _add_rmma(commands)
    _add_calibrate(commands)
    return parser


def _add_rmma(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    rmma = commands.add_parser(
        "rmma",
        help="the fiducial-interception experiment, beside the thesis's figures",
        description="All experiments of [X21] chapter 5 once more, tables and figures beside the "
        "thesis's, what matches and what does not; then the search that finds every fiducial, in "
        "other worlds too. Takes minutes on all cores; --brief takes seconds.",
        epilog=EPILOG,
    )
    rmma.add_argument(
        "--out",
        type=Path,
        metavar="DIR",
        default=Path("thing_kin_rmma"),
        help="where report.md, CSV files and pictures go (default: %(default)s)",
    )
    rmma.add_argument(
        "--runs",
        type=_runs,
        metavar="N",
        help="runs of the thesis's methods at each velocity (default: 1000, brief: 60)",
    )
    rmma.add_argument("--seed", type=int, default=0, help="of all randomness (default: 0)")
    rmma.add_argument("--brief", action="store_true", help="fewer runs and worlds, no animation")
    rmma.add_argument("--no-plots", action="store_true", help="no pictures; needs no matplotlib")
    rmma.set_defaults(command=_rmma)


def _add_calibrate(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    calibrate = commands.add_parser(
        "calibrate",
        help="what an arm differs by from its model",
        description="Estimates an arm's errors from a table of joint readings and of what was "
        "measured there. The first line names the columns: those called like the robot's joints "
        "are readings (else the last ones), all others, in their order, measurements: x, y, z, "
        "roll, pitch, yaw; or x, y, z and a quaternion w, x, y, z; or x, y, z of one or several "
        "points on the tool (--points). Meters and radians; an empty or nan measurement was not "
        "made.",
        epilog=EPILOG.replace("the demo's own checks failed", "not converged, or too little data"),
    )
    calibrate.add_argument("table", type=Path, metavar="DATA.csv")
    calibrate.add_argument(
        "--robot",
        default="ur10",
        help="'ur5', 'ur10', 'thing', 'pioneer_lx_ur5' or a URDF file (default: %(default)s)",
    )
    calibrate.add_argument("--base-link", metavar="LINK", help="of the URDF; default: its root")
    calibrate.add_argument("--tip-link", metavar="LINK", help="of the URDF; default: its leaf")
    calibrate.add_argument(
        "--parameters",
        default="base,tool,joint_offsets",
        help="groups or single ones, with commas between, or 'all' (default: %(default)s)",
    )
    calibrate.add_argument("--points", action="store_true", help="places of points, not poses")
    calibrate.add_argument("--loss", default="cauchy", help="default: %(default)s")
    calibrate.add_argument("--folds", type=int, default=5, help="default: %(default)s; 0: none")
    calibrate.add_argument("--seed", type=int, default=0, help="of the folds")
    calibrate.add_argument("--urdf", type=Path, metavar="OUT", help="writes the calibrated chain")
    calibrate.add_argument("--yaml", type=Path, metavar="OUT", help="writes the UR driver's file")
    calibrate.add_argument("--plot", type=Path, metavar="OUT", help="draws residuals and changes")
    calibrate.set_defaults(command=_calibrate)


def _calibrate(arguments: argparse.Namespace) -> int:
    from thing_kin import estimation as est
    from thing_kin.estimation import calibration_table

    try:
        chain = _robot(arguments)
        q, measured = calibration_table.read(arguments.table, chain, arguments.points)
        distinct = len(np.unique(q.round(6), axis=0))  # equal postures stay in one fold
        result = est.calibrate(
            chain,
            q,
            measured,
            parameters=arguments.parameters.split(","),
            loss=arguments.loss,
            folds=min(arguments.folds, distinct if distinct > 1 else 0),
            rng=arguments.seed,
        )
        print(result)
        if arguments.urdf:
            arguments.urdf.write_text(result.to_urdf(), encoding="utf-8")
        if arguments.yaml:
            arguments.yaml.write_text(result.to_yaml(), encoding="utf-8")
        if arguments.plot:
            result.plot().savefig(arguments.plot, dpi=130)
    except (ImportError, OSError, ValueError) as error:
        return _fail(str(error))
    return OK if result.success else CHECKS_FAILED


def _robot(arguments: argparse.Namespace) -> tk.Chain:
    known = {name: getattr(tk.robots, name) for name in ("ur5", "ur10", "thing", "pioneer_lx_ur5")}
    if arguments.robot in known:
        chain: tk.Chain = known[arguments.robot]()
        return chain
    path = Path(arguments.robot)
    return tk.Chain.from_urdf(path, base=arguments.base_link, tip=arguments.tip_link)


def _demo(arguments: argparse.Namespace) -> int:
    from thing_kin import demo
    from thing_kin.demo.table import table

    try:
        result = demo.run(arguments.out, brief=arguments.brief, plots=not arguments.no_plots)
    except ImportError as error:
        return _fail(f"{error}\n(or leave the pictures out: --no-plots)")
    except OSError as error:
        return _fail(f"argument --out: {error}")
    print(table(result))
    print("\nwritten to " + str(arguments.out) + ": " + ", ".join(result["files"]))
    return OK if all(result["checks"].values()) else CHECKS_FAILED


def _rmma(arguments: argparse.Namespace) -> int:
    from thing_kin import rmma

    plots, brief = not arguments.no_plots, arguments.brief
    try:
        if plots:
            from thing_kin.viz.style import new_figure

            new_figure()  # says what is missing now, and not after the work
        arguments.out.mkdir(parents=True, exist_ok=True)
        done = rmma.reproduce(arguments.runs, rng=arguments.seed, brief=brief, progress=True)
        print(done.report())
        files = done.write(arguments.out, plots=plots, animation=not brief)
    except ImportError as error:
        return _fail(f"{error}\n(or leave the pictures out: --no-plots)")
    except OSError as error:
        return _fail(f"argument --out: {error}")
    print("written to " + str(arguments.out) + ": " + ", ".join(files))
    return OK if all(done.checks.values()) else CHECKS_FAILED


def _runs(text: str) -> int:
    """Read how many runs: so many that their scatter is known."""
    if not text.isdecimal() or int(text) < LEAST_RUNS:
        wanted = f"expected a whole number of at least {LEAST_RUNS}"
        raise argparse.ArgumentTypeError(f"got {text!r}, {wanted}")
    return int(text)


def _fail(message: str) -> int:
    print(f"thing-kin: {message}", file=sys.stderr)
    return USAGE
