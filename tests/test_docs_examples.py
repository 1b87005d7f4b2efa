"""README and documentation keep their word: examples run, the equation table leads somewhere."""

import doctest
import re
from functools import reduce
from pathlib import Path

import pytest

import thing_kin as tk
from thing_kin import estimation, odometry, rmma, search

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
TEXTS = {page.name: page.read_text(encoding="utf-8") for page in PAGES}
WITH_EXAMPLES = [name for name, text in TEXTS.items() if ">>>" in text]
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE

EQUATIONS = [
    [cell.strip() for cell in line.strip("|").split("|")]
    for line in TEXTS["architecture.md"].split("## From equation to code")[1].splitlines()
    if line.startswith("| ") and ".hpp`" in line
]


@pytest.mark.parametrize("name", WITH_EXAMPLES)
def test_examples_of(name: str) -> None:
    if name == "interop.md":
        pytest.importorskip("pinocchio")
        pytest.importorskip("scipy", minversion="1.16")  # the first with RigidTransform
    # Fences become blank lines, which end an example's expected output and keep line numbers.
    text = re.sub(r"^\s*```.*$", "", TEXTS[name], flags=re.MULTILINE)
    test = doctest.DocTestParser().get_doctest(text, {}, name, name, 0)
    report: list[str] = []
    result = doctest.DocTestRunner(optionflags=FLAGS).run(test, out=report.append)
    assert result.attempted > 0
    assert result.failed == 0, "".join(report)


def test_every_tutorial_has_examples() -> None:
    assert {"README.md", "model.md", "kinematics.md", "inverse.md", "interop.md"} <= set(
        WITH_EXAMPLES
    )


def names_in(cell: str) -> list[str]:
    return re.findall(r"`([^`]+)`", cell)


@pytest.mark.parametrize("row", EQUATIONS, ids=[f"{row[0]} {row[1]}" for row in EQUATIONS])
def test_the_table_leads_to(row: list[str]) -> None:
    _, _, headers, python, tests = map(names_in, row)
    for header in headers:
        assert (ROOT / "cpp/include/thing_kin" / header).is_file(), header
    for name in python:
        prefix, _, path = name.partition(".")  # of `tk.ik`, `est.KalmanFilter`, `.fk`
        modules = {"est": estimation, "odometry": odometry, "rmma": rmma, "search": search}
        owner = ({"": tk.Chain} | modules).get(prefix, tk)
        if not path.startswith("kdl."):  # an extension of its own, which a build may lack
            assert callable(reduce(getattr, path.split("."), owner)), name
    for test in tests:
        assert (ROOT / "tests" / test).is_file(), test


def test_the_table_names_every_concept_from_kinematics_up() -> None:
    in_table = {header for row in EQUATIONS for header in names_in(row[2])}
    include = ROOT / "cpp/include/thing_kin"
    concepts = {
        str(path.relative_to(include))
        for layer in ("linalg", "kinematics", "inverse")
        for path in (include / layer).glob("*.hpp")
    }
    assert len(concepts) > 10
    assert concepts <= in_table


@pytest.mark.parametrize("name", TEXTS)
def test_pages_link_only_to_what_is_there(name: str) -> None:
    text = TEXTS[name]
    page = next(page for page in PAGES if page.name == name)
    for target in re.findall(r"\]\(((?!https?://|#)[^)#\s]+)\)", text):
        assert (page.parent / target).exists(), target
    for target in re.findall(r"{doc}`([^`]+)`", text):
        assert (ROOT / "docs" / f"{target}.md").is_file(), target
