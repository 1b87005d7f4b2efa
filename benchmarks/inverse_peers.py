"""Virtual environments for the peers of inverse_race.py.

    python benchmarks/inverse_peers.py [--into DIRECTORY]

One for most, and one for placo, which brings a Pinocchio of its own: the groups `peers` and
`peers-placo` of pyproject.toml. What can't be installed here is reported as absent by the race.
PyKDL is in no package index: with Debian's Python it is found in python3-pykdl, and without it
KDL takes part as thing_kin.kdl.ik.
"""

import argparse
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).parents[1]
GROUPS = {"main": "peers", "placo": "peers-placo"}


def packages(group: str) -> list[str]:
    """Of a group of pyproject.toml; the oldest Python here has no tomllib."""
    lines = (ROOT / "pyproject.toml").read_text().splitlines()
    (line,) = (line for line in lines if line.startswith(f"{group} = "))
    return line.split('"')[1::2]


def make(directory: Path, group: str) -> None:
    """Each package alone, so that one without a wheel for this machine costs no other."""
    if not (directory / "bin" / "python").exists():
        venv.create(directory, with_pip=True, system_site_packages=True)
    for package in packages(group):
        command = [directory / "bin" / "python", "-m", "pip", "install", "-qq", package]
        done = subprocess.run(command, check=False).returncode == 0
        print(f"{directory}: {package} {'is there' if done else 'could not be installed'}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--into", type=Path, default=Path("build/peers"), metavar="DIRECTORY")
    options = parser.parse_args()
    for name, group in GROUPS.items():
        make(options.into / name, group)


if __name__ == "__main__":
    sys.exit(main())
