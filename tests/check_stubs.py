"""Compare the stubs of the extension modules with what their docstrings generate.

python tests/check_stubs.py          exits with 1 if a stub is out of date
python tests/check_stubs.py --write  brings them up to date
"""

import filecmp
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent.parent / "python" / "thing_kin"
MODULES = tuple(
    f"thing_kin._{name}"
    for name in (
        "calibration",
        "ceres",
        "core",
        "estimation",
        "kdl",
        "odometry",
        "search",
        "urdf",
    )
)


def generate(directory: Path) -> Path:
    for module in MODULES:
        command = [sys.executable, "-m", "pybind11_stubgen", module, "-o", str(directory)]
        subprocess.run(command, check=True, cwd=directory)
    return directory / "thing_kin"


def main() -> int:
    write = sys.argv[1:] == ["--write"]
    stale = []
    with tempfile.TemporaryDirectory() as scratch:
        generated = generate(Path(scratch))
        for stub in sorted(generated.rglob("*.pyi")):
            kept = PACKAGE / stub.relative_to(generated)
            if kept.exists() and filecmp.cmp(stub, kept, shallow=False):
                continue
            stale.append(str(kept.relative_to(PACKAGE)))
            if write:
                kept.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(stub, kept)
    for name in stale:
        print(f"{name}: {'written' if write else 'out of date; run tests/check_stubs.py --write'}")
    return 1 if stale and not write else 0


if __name__ == "__main__":
    sys.exit(main())
