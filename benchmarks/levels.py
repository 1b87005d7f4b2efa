"""compare.py's batches with each lower instruction level of this processor.

    python benchmarks/levels.py [--rounds N] [--figures DIRECTORY]

Writes DIRECTORY/bench_<level>.json; the best level is compare.py's own.
"""

import argparse
import subprocess
import sys
from pathlib import Path

from problem import WORKS
from scaling_lines import available_levels


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=9, help="default %(default)s")
    parser.add_argument("--figures", type=Path, default=Path("build"), metavar="DIRECTORY")
    options = parser.parse_args()
    batches = [work.name for work in WORKS if work.items > 1]
    for level in available_levels()[1:]:
        file = options.figures / f"bench_{level}.json"
        chosen = [f"--level={level}", f"--rounds={options.rounds}", f"--json={file}"]
        script = Path(__file__).with_name("compare.py")
        subprocess.run([sys.executable, script, *batches, *chosen], check=True)


if __name__ == "__main__":
    main()
