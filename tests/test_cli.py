"""The command line: exit codes, messages, and what it imports."""

import json
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

import thing_kin as tk
from thing_kin.cli import main
from thing_kin.demo import wall

ENVIRONMENT = os.environ | {"PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}


def python(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Run this Python with this process's path."""
    return subprocess.run(
        [sys.executable, *arguments], capture_output=True, text=True, env=ENVIRONMENT, timeout=60
    )


@pytest.mark.parametrize(
    ("arguments", "code", "expected"),
    [
        (["--help"], 0, "demo"),
        (["--help"], 0, "exit codes: 0"),
        (["--version"], 0, f"thing-kin {tk.__version__}\n"),
        (["demo", "--help"], 0, "--no-plots"),
        (["demo", "--help"], 0, "thing_kin_demo"),
        ([], 2, "COMMAND"),
        (["wipe"], 2, "wipe"),
        (["demo", "--poses", "3"], 2, "--poses"),
        (["--help"], 0, "rmma"),
        (["rmma", "--help"], 0, "thing_kin_rmma"),
        (["rmma", "--runs", "0"], 2, "--runs: got '0', expected a whole number of at least 20"),
        (["rmma", "--runs", "many"], 2, "--runs: got 'many'"),
        (["rmma", "--seed", "x"], 2, "--seed"),
    ],
)
def test_usage(capsys, arguments, code, expected):
    with pytest.raises(SystemExit) as stopped:
        main(arguments)
    output = capsys.readouterr()
    assert stopped.value.code == code
    assert expected in (output.err if code else output.out)
    assert not (output.out if code else output.err)


def test_module_runs_like_the_command():
    result = python("-m", "thing_kin", "--version")
    assert (result.returncode, result.stdout) == (0, f"thing-kin {tk.__version__}\n")


def test_demo_reports_on_stdout_and_leaves_progress_on_stderr(tmp_path, capsys):
    assert main(["demo", "--brief", "--no-plots", "--out", str(tmp_path / "new" / "out")]) == 0
    output = capsys.readouterr()
    assert "wiping:" in output.err
    assert "wiping:" not in output.out
    assert "worst position error [m]" in output.out
    assert "FAILED" not in output.out
    written = list((tmp_path / "new" / "out").iterdir())
    assert [path.name for path in written] == ["summary.json"]
    assert json.loads(written[0].read_text())["files"] == ["summary.json"]


def test_failed_checks_are_exit_code_1(tmp_path, capsys, monkeypatch):
    # Where the base never steps back the arm stays regular, and the plain scheme does well.
    monkeypatch.setattr(wall, "STEP_BACK", 0.0)
    assert main(["demo", "--brief", "--no-plots", "--out", str(tmp_path)]) == 1
    assert "FAILED  the arm comes near a singular posture" in capsys.readouterr().out


def test_out_that_is_a_file_is_wrong_usage(tmp_path, capsys):
    (tmp_path / "taken").write_text("mine")
    assert main(["demo", "--brief", "--no-plots", "--out", str(tmp_path / "taken")]) == 2
    assert "argument --out:" in capsys.readouterr().err
    assert (tmp_path / "taken").read_text() == "mine"


def test_missing_matplotlib_says_what_to_install(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    assert main(["demo", "--out", str(tmp_path / "out")]) == 2
    message = capsys.readouterr().err
    assert "pip install thing_kin[viz]" in message
    assert "--no-plots" in message
    assert not (tmp_path / "out").exists()  # found out before the work


def test_without_plots_neither_matplotlib_nor_tqdm_is_needed(tmp_path, capsys, monkeypatch):
    for module in ("matplotlib", "matplotlib.figure", "tqdm"):
        monkeypatch.setitem(sys.modules, module, None)
    assert main(["demo", "--brief", "--no-plots", "--out", str(tmp_path)]) == 0
    assert capsys.readouterr().err == ""


def test_rmma_with_a_failed_check_is_exit_code_1(tmp_path, capsys, monkeypatch):
    done = SimpleNamespace(
        report=lambda: "report",
        write=lambda out, **_: ["a", "b"],
        checks={"one": True, "two": False},
    )
    monkeypatch.setattr("thing_kin.rmma.reproduce", lambda *_, **__: done)
    assert main(["rmma", "--no-plots", "--out", str(tmp_path)]) == 1
    assert capsys.readouterr().out == f"report\nwritten to {tmp_path}: a, b\n"


def test_rmma_finds_out_before_the_work(tmp_path, capsys, monkeypatch):
    (tmp_path / "taken").write_text("mine")
    assert main(["rmma", "--no-plots", "--out", str(tmp_path / "taken")]) == 2
    assert "argument --out:" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    assert main(["rmma", "--out", str(tmp_path / "out")]) == 2
    assert "--no-plots" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("module", ["thing_kin.cli", "thing_kin.viz", "thing_kin.demo"])
def test_importing_is_cheap(module):
    heavy = (
        f"import sys, {module}; print(sorted({{'matplotlib', 'tqdm', 'PIL'}} & set(sys.modules)))"
    )
    result = python("-c", heavy)
    assert (result.returncode, result.stdout) == (0, "[]\n"), result.stderr


def test_the_installed_command_is_main():
    pyproject = Path(__file__).parents[1] / "pyproject.toml"
    assert 'thing-kin = "thing_kin.cli:main"' in pyproject.read_text(encoding="utf-8")
