"""What `import` costs beyond numpy, each in processes of their own."""

import importlib.util
import subprocess
import sys

MODULES = {"thing_kin": "thing_kin", "pinocchio": "pinocchio", "pykdl": "PyKDL"}

# numpy comes first, so that its time does not count.
PROGRAM = """
import time, numpy
start = time.process_time_ns()
import {module}
print(time.process_time_ns() - start)
"""


def import_seconds(module: str) -> float:
    """CPU seconds of one import in a new process."""
    command = [sys.executable, "-c", PROGRAM.format(module=module)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return int(done.stdout) * 1e-9


def interleaved_imports(rounds: int) -> dict[str, list[float]]:
    """Seconds of each module that is installed, A B A B ..."""
    found = {name: m for name, m in MODULES.items() if importlib.util.find_spec(m)}
    times: dict[str, list[float]] = {name: [] for name in found}
    for _ in range(rounds):
        for name, module in found.items():
            times[name].append(import_seconds(module))
    return times
