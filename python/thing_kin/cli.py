"""The command line: `thing-kin`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import thing_kin as tk

OK, CHECKS_FAILED, USAGE = 0, 1, 2

EPILOG = "exit codes: 0 all went well, 1 the demo's own checks failed, 2 wrong usage"


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return the exit code; default arguments: the process's own."""
    arguments = _parser().parse_args(argv)
    return _demo(arguments)


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
    return parser


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


def _fail(message: str) -> int:
    print(f"thing-kin: {message}", file=sys.stderr)
    return USAGE
