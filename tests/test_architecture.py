"""Layers: data flows one way, and what is foreign stays in its one file."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import thing_kin as tk
from thing_kin import estimation, lie, odometry, rmma, robots, search

ROOT = Path(__file__).parents[1]
CPP = ROOT / "cpp"
PYTHON = ROOT / "python" / "thing_kin"

# A layer, and the layers it may use directly. Each comes after all that it uses.
LAYERS: dict[str, tuple[str, ...]] = {
    "core": (),
    "lie": ("core",),
    "linalg": ("core",),
    "model": ("lie",),
    "kinematics": ("model", "linalg"),
    "inverse": ("kinematics",),
    "optimization": ("inverse",),
    "planning": ("optimization",),
    "odometry": ("lie", "linalg"),
    "estimation": ("odometry", "kinematics"),
    "search": ("linalg",),
    "rmma": ("search", "estimation", "inverse"),
}
KDL_SOURCE = CPP / "src" / "model" / "kdl_chain.cpp"
URDF_SOURCE = CPP / "src" / "model" / "urdf.cpp"
EXPAT_SOURCE = CPP / "src" / "model" / "urdf_document.cpp"
CERES_SOURCE = CPP / "src" / "optimization" / "ceres_minimizer.cpp"
CALIBRATION_SOURCE = CPP / "src" / "estimation" / "calibration_descent.cpp"
# Targets of their own, so that only their users link what is foreign.
APART = {
    KDL_SOURCE.name,
    "kdl_ik.cpp",
    "kdl_ik_search.cpp",
    CERES_SOURCE.name,
    "smooth_model.cpp",
}
APART |= {f"urdf{part}.cpp" for part in ("", "_document", "_excerpt", "_source", "_tree")}
APART |= {"rigid_fit.cpp"} | {
    f"calibration{part}.cpp"
    for part in (
        *("", "_analysis", "_descent", "_leverage", "_loss", "_model", "_noise"),
        *("_parameters", "_problem", "_residuals", "_start", "_twists"),
    )
}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
# Of `f(...) {` or `[](...) -> T {`; no aggregate, no initializer in braces.
FUNCTION_BODY = re.compile(r"\)[^;{}=]*\{")


def with_all_below(layer: str) -> set[str]:
    return {layer}.union(*(with_all_below(used) for used in LAYERS[layer]))


def sources(*folders: Path) -> Iterator[Path]:
    for folder in folders:
        yield from (p for p in sorted(folder.rglob("*")) if p.suffix in (".hpp", ".cpp", ".in"))


def layer_of(path: Path) -> str:
    root = CPP / "include" / "thing_kin" if "include" in path.parts else CPP / "src"
    return path.relative_to(root).parts[0]


def includes(path: Path) -> list[str]:
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def has_function_bodies(path: Path) -> bool:
    code = re.sub(r"//.*", "", path.read_text(encoding="utf-8"))
    return FUNCTION_BODY.search(code) is not None


LAYERED = [*sources(CPP / "include"), *sources(CPP / "src")]


def test_layers_come_after_what_they_use() -> None:
    order = list(LAYERS)
    for layer, uses in LAYERS.items():
        assert all(order.index(used) < order.index(layer) for used in uses)
    assert {layer_of(path) for path in LAYERED} == set(LAYERS)


def test_cmake_links_the_same_layers() -> None:
    text = (CPP / "CMakeLists.txt").read_text(encoding="utf-8")
    found = re.findall(r"^thing_kin_layer\((\w+)([^)]*)\)", text, re.MULTILINE)
    links = {layer: tuple(rest.partition("DEPENDS")[2].split()) for layer, rest in found}
    assert links == LAYERS


def test_cmake_builds_every_source() -> None:
    text = (CPP / "CMakeLists.txt").read_text(encoding="utf-8")
    for layer, rest in re.findall(r"^thing_kin_layer\((\w+)([^)]*)\)", text, re.MULTILINE):
        named = set(re.findall(r"\w+\.cpp", rest))
        present = {p.name for p in (CPP / "src").glob(f"{layer}/*.cpp") if p.name not in APART}
        assert named == present


@pytest.mark.parametrize("path", LAYERED, ids=lambda p: str(p.relative_to(CPP)))
def test_a_file_includes_its_own_layer_and_those_below(path: Path) -> None:
    allowed = with_all_below(layer_of(path))
    for name in includes(path):
        if name.startswith("thing_kin/"):
            assert name.split("/")[1] in allowed, name
        assert not name.startswith(("pybind11", "Python")), name


def test_an_upward_include_would_be_seen() -> None:
    assert "inverse" not in with_all_below("kinematics")
    assert "lie" not in with_all_below("linalg")
    assert INCLUDE.findall('#include "thing_kin/inverse/task.hpp"') == [
        "thing_kin/inverse/task.hpp"
    ]


def test_kdl_stays_in_one_file() -> None:
    foreign = ("kdl/", "kdl.hpp", "frames.hpp", "chain.hpp", "orocos")
    users = {
        path
        for path in sources(CPP, ROOT / "bindings", ROOT / "tests" / "cpp")
        if any(name.startswith(foreign) for name in includes(path))
    }
    assert users == {KDL_SOURCE}


@pytest.mark.parametrize(
    ("foreign", "source"),
    [
        (("urdf_", "console_bridge", "tinyxml"), URDF_SOURCE),
        (("expat",), EXPAT_SOURCE),
    ],
)
def test_a_urdf_s_parsers_stay_in_one_file_each(foreign: tuple[str, ...], source: Path) -> None:
    users = {
        path
        for path in sources(CPP, ROOT / "bindings", ROOT / "tests" / "cpp")
        if any(name.startswith(foreign) for name in includes(path))
    }
    assert users == {source}


def test_ceres_stays_in_one_file_of_a_layer() -> None:
    users = {
        path
        for path in sources(CPP, ROOT / "bindings")
        if any(name.startswith(("ceres/", "glog/")) for name in includes(path))
    }
    assert users == {CERES_SOURCE, CALIBRATION_SOURCE}


def test_bindings_mirror_the_core() -> None:
    """One concept, one name: bindings/x/y.cpp binds cpp/include/thing_kin/x/y.hpp."""
    for path in (ROOT / "bindings").glob("*/*.cpp"):
        concept = path.relative_to(ROOT / "bindings").with_suffix(".hpp")
        assert (CPP / "include" / "thing_kin" / concept).exists(), concept


def test_no_module_is_named_like_a_public_function() -> None:
    functions = {
        name
        for module in (tk, lie, robots, estimation, odometry, search)
        for name in module.__all__
        if callable(getattr(module, name)) and not isinstance(getattr(module, name), type)
    }
    assert {"pinv", "transform", "so3_exp", "thing"} <= functions
    modules = {path.stem for path in PYTHON.rglob("*.py")}
    assert not modules & functions
    # `rmma.trace` is a run in detail, `viz.trace` the figure of a solver's.
    beside = {path.stem for package in ("rmma", "search") for path in (PYTHON / package).glob("*")}
    assert not beside & set(rmma.__all__)


@pytest.mark.parametrize("path", sorted(PYTHON.rglob("*.py")), ids=lambda p: p.name)
def test_python_reaches_the_core_through_few_modules(path: Path) -> None:
    """The compiled modules are private: only the modules that re-export them name them."""
    text = path.read_text(encoding="utf-8")
    if path.name not in ("__init__.py", "lie.py", "robots.py", "terms.py"):
        assert "_core" not in text
    if path.name != "kdl.py":
        assert "_kdl" not in text
    if path.parent.name != "estimation":
        assert "_estimation" not in text
    if path.parent.name != "odometry":
        assert "thing_kin._odometry" not in text
    if path.parent.name not in ("search", "rmma"):
        assert "import _search" not in text
        assert "thing_kin._search" not in text
    assert "_ceres" not in text
    if path.parent.name != "estimation":
        assert "_calibration" not in text.replace("plot_calibration", "").replace(
            "_ur_calibration", ""
        )
    assert "_urdf" not in text.replace("to_urdf", "").replace("from_urdf", "")


def test_kernels_share_no_inline_function_with_the_rest() -> None:
    """What is compiled for AVX-512 must not be what the linker keeps for everyone."""
    kernels = CPP / "src" / "kinematics" / "kernels"
    allowed = {
        "thing_kin/core/max_dof.hpp",
        "thing_kin/kinematics/pose_format.hpp",
        "thing_kin/kinematics/reference_frame.hpp",
        "thing_kin/model/skeleton.hpp",
    }
    entry = kernels / "kernels.cpp"
    compiled = {entry}
    queue = [entry]
    while queue:
        for name in includes(queue.pop()):
            path = kernels / name
            if path.is_file() and path not in compiled:
                compiled.add(path)
                queue.append(path)
            assert path.is_file() or name in allowed, name
    for header in allowed:
        path = CPP / "include" / header
        assert set(includes(path)) <= allowed
        assert not has_function_bodies(path), header
    assert has_function_bodies(CPP / "include" / "thing_kin" / "kinematics" / "batch.hpp")
    own = [path for path in compiled if path.name not in ("kernels.hpp",)]
    assert len(own) >= 5
    for path in own:
        assert "namespace thing_kin::THING_KIN_LEVEL {" in path.read_text(encoding="utf-8")
