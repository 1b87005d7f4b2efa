"""The tables of docs/benchmarks.md from the figures that the benchmarks left.

    python benchmarks/tables.py [--figures DIRECTORY] [--into docs/benchmarks.md]

Without --into they are printed. In the page each stands between `<!-- table NAME -->` and
`<!-- end -->`; a table whose figures are missing stays as it is.
"""

import argparse
import re
from pathlib import Path
from types import ModuleType

import inverse_tables
import markdown
import pose_tables
from figures import Figures

TABLES = {  # the file without which there is none
    "machine": "bench.json",
    "targets": "bench.json",
    "python": "bench.json",
    "levels": "bench.json",
    "cpp": "bench_thing.json",
    "memory": "scaling.json",
    "won_by_peers": "bench.json",
    "inverse": inverse_tables.FILE,
    "inverse_claims": inverse_tables.FILE,
    "inverse_setup": inverse_tables.FILE,
    "inverse_steps": inverse_tables.STEPS,
    "pose": pose_tables.FILE,
    "pose_claims": pose_tables.FILE,
    "pose_setup": pose_tables.FILE,
    "pose_paths": pose_tables.PATHS,
}


def made(figures: Figures) -> dict[str, str]:
    def module(name: str) -> ModuleType:
        found = {"inverse": inverse_tables, "pose": pose_tables}
        return found.get(name.partition("_")[0], markdown)

    return {
        name: getattr(module(name), name)(figures)
        for name, file in TABLES.items()
        if figures.content(file)
    }


def put(page: str, name: str, text: str) -> str:
    """The page with one table in its place."""
    marked = re.compile(rf"(<!-- table {name} -->\n\n?).*?(\n?\n<!-- end -->)", re.DOTALL)
    if not marked.search(page):
        raise SystemExit(f"no place for the table {name}")
    return marked.sub(lambda found: f"<!-- table {name} -->\n\n{text}\n\n<!-- end -->", page)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--figures", type=Path, default=Path("build"), metavar="DIRECTORY")
    parser.add_argument("--into", type=Path, metavar="PAGE")
    options = parser.parse_args()
    tables = made(Figures(options.figures))
    if options.into is None:
        print("\n\n".join(f"{name}\n\n{text}" for name, text in tables.items()))
        return
    page = options.into.read_text()
    for name, text in tables.items():
        page = put(page, name, text)
    options.into.write_text(page)
    print(f"{options.into}: {', '.join(tables)}")


if __name__ == "__main__":
    main()
