"""`import thing_kin` loads nothing but itself and, at most, numpy."""

import json
import subprocess
import sys

import pytest


def modules_after(statement: str) -> set[str]:
    """Modules that the statement loads in a fresh interpreter."""
    code = (
        "import sys, json; before = set(sys.modules)\n"
        f"{statement}\n"
        "print(json.dumps(sorted(set(sys.modules) - before)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stderr == ""
    return set(json.loads(done.stdout))


def foreign(modules: set[str]) -> set[str]:
    return {name.partition(".")[0] for name in modules} - set(sys.stdlib_module_names)


def test_it_loads_numpy_only() -> None:
    numpys_own = foreign(modules_after("import numpy, numpy.random, numpy.typing"))
    loaded = modules_after("import thing_kin")
    assert foreign(loaded) - numpys_own == {"thing_kin"}
    for heavy in (
        "matplotlib",
        "tqdm",
        "scipy",
        "yaml",
        "toppra",
        "ruckig",
        "thing_kin._kdl",
        "thing_kin.kdl",
        "thing_kin._urdf",
        "thing_kin._ceres",
        "thing_kin._calibration",
        "thing_kin._estimation",
        "thing_kin.estimation",
        "thing_kin._odometry",
        "thing_kin.odometry",
        "thing_kin._search",
        "thing_kin.search",
        "thing_kin.rmma",
    ):
        assert heavy not in loaded


def test_kdl_is_loaded_on_demand() -> None:
    assert "thing_kin._kdl" in modules_after("import thing_kin.kdl")


def test_estimation_is_loaded_on_demand() -> None:
    loaded = modules_after("from thing_kin import estimation as est")
    assert "thing_kin._estimation" in loaded
    assert "yaml" not in loaded
    assert foreign(loaded) == foreign(modules_after("import thing_kin, numpy, numpy.typing"))


def test_calibration_is_loaded_on_demand() -> None:
    use = "import thing_kin as tk; from thing_kin import estimation as est; arm = tk.robots.ur5()"
    assert "thing_kin._calibration" not in modules_after(use)
    loaded = modules_after(f"{use}; q = arm.random(9, rng=0); est.calibrate(arm, q, arm.fk(q))")
    assert "thing_kin._calibration" in loaded
    assert foreign(loaded) == foreign(modules_after("import thing_kin, numpy.random, numpy.typing"))


def test_odometry_is_loaded_on_demand() -> None:
    loaded = modules_after("from thing_kin import odometry")
    assert "thing_kin._odometry" in loaded
    assert "thing_kin._estimation" not in loaded
    assert foreign(loaded) == foreign(modules_after("import thing_kin, numpy, numpy.typing"))


def test_search_is_loaded_on_demand() -> None:
    loaded = modules_after("from thing_kin import rmma, search")
    assert "thing_kin._search" in loaded
    for heavy in ("thing_kin._estimation", "matplotlib", "pandas", "tqdm"):
        assert heavy not in loaded
    assert "thing_kin.rmma" not in modules_after("from thing_kin import search")


def test_ceres_is_loaded_on_demand() -> None:
    use = "import thing_kin as tk; problem = tk.Problem(n=1)"
    assert "thing_kin._ceres" not in modules_after(f"{use}; tk.sqp(problem, [0.0], minimizer='qp')")
    loaded = modules_after(f"{use}; tk.sqp(problem, [0.0])")
    assert "thing_kin._ceres" in loaded
    assert foreign(loaded) == foreign(modules_after("import thing_kin"))


def test_the_urdf_reader_is_loaded_on_demand() -> None:
    write = "import thing_kin as tk; text = tk.robots.ur5().to_urdf()"
    assert "thing_kin._urdf" not in modules_after(write)
    read = modules_after(f"{write}; tk.Chain.from_urdf(text)")
    assert "thing_kin._urdf" in read
    assert foreign(read) == foreign(modules_after("import thing_kin"))


@pytest.mark.parametrize("order", ["{0}; {1}", "{1}; {0}"])
def test_two_urdfdoms_in_one_process(order: str) -> None:
    """Pinocchio brings its own, and console_bridge under the same name."""
    ours = "import thing_kin as tk; text = tk.robots.ur5().to_urdf(); tk.Chain.from_urdf(text)"
    theirs = "import pinocchio as pin"
    use = "assert pin.buildModelFromXML(text).nq == tk.Chain.from_urdf(text).n"
    modules_after(f"{order.format(ours, theirs)}; {use}")


def test_using_it_loads_no_more() -> None:
    use = (
        "import thing_kin as tk; robot = tk.robots.thing(); q = robot.random(rng=0)\n"
        "tk.pinv(robot.jacobian(q)); print(end='')\n"
        "tk.TaskPriority(robot, [tk.PoseTask()]).step(q, [robot.fk(q)])"
    )
    assert foreign(modules_after(use)) == foreign(modules_after("import thing_kin, numpy.random"))


def test_interop_loads_no_peer() -> None:
    assert "thing_kin.interop" not in modules_after("import thing_kin")
    loaded = foreign(modules_after("import thing_kin.interop"))
    assert loaded == foreign(modules_after("import thing_kin, numpy, numpy.typing"))
