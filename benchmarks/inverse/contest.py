"""Solvers take turns on a course, each in its process, until the targets or its time are used."""

import os
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from multiprocessing import Pipe
from pathlib import Path
from typing import Any

from inverse import Solver
from inverse.field import Course

TURN = 0.25  # seconds
START_UP = 120.0  # seconds in which a process has to answer
ROOT = Path(__file__).parents[1]


class AbsentError(Exception):
    """Not installed, or its process has died."""


@dataclass
class Contender:
    """A solver's process."""

    solver: type[Solver]
    python: str
    versions: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        here = os.environ.get("PYTHONPATH") if self.python == sys.executable else None
        environment = {
            **os.environ,
            "PYTHONPATH": os.pathsep.join([str(ROOT), *([here] if here else [])]),
            # One thread of linear algebra, for all.
            **dict.fromkeys(["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"], "1"),
        }
        self.pipe, theirs = Pipe()
        command = [self.python, "-m", "inverse.worker", self.solver.name, str(theirs.fileno())]
        self.process = subprocess.Popen(command, env=environment, pass_fds=[theirs.fileno()])
        theirs.close()
        versions = self.ask("about", wait=START_UP)
        if versions is None:
            self.close()
            raise AbsentError("not installed")
        self.versions = versions

    def ask(self, method: str, *arguments: Any, wait: float = START_UP) -> Any:
        try:
            self.pipe.send((method, *arguments))
            if not self.pipe.poll(wait):
                raise AbsentError(f"no answer in {wait:g} s")
            return self.pipe.recv()
        except (EOFError, OSError) as error:
            raise AbsentError(f"its process died with status {self.process.wait()}") from error

    def close(self) -> None:
        self.pipe.close()
        self.process.kill()
        self.process.wait()


def race(course: Course, contenders: Sequence[Contender], seconds: float) -> dict[str, list[Any]]:
    """Answers of each solver, to the first of the targets or to all; a dead solver's up to then."""
    answers: dict[str, list[Any]] = {}
    left = dict.fromkeys((c.solver.name for c in contenders), seconds)
    racing = []
    for contender in contenders:
        if contender.solver.can(course.arm):
            try:
                contender.ask("enter", *course.entry)
            except AbsentError as reason:
                print(f"  {course.arm.name}: {contender.solver.name} gave up: {reason}")
                continue
            answers[contender.solver.name] = []
            racing.append(contender)
    while racing:
        for contender in list(racing):
            name = contender.solver.name
            done, turn = answers[name], min(TURN, left[name])
            try:
                done += contender.ask("run", len(done), len(course.targets), turn)
            except AbsentError as reason:
                print(f"  {course.arm.name}: {name} gave up: {reason}")
                racing.remove(contender)
                continue
            left[name] -= turn
            if len(done) >= len(course.targets) or left[name] <= 1e-9:
                racing.remove(contender)
    return answers
