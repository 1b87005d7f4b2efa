"""Every public thing says what it is, and its examples are true."""

import doctest
import inspect
from collections.abc import Iterator

import pytest

import thing_kin as tk
from thing_kin import estimation, interop, kdl, lie, odometry, rmma, robots, search, terms

MODULES = (
    tk,
    lie,
    robots,
    terms,
    kdl,
    interop,
    estimation,
    estimation.models,
    odometry,
    rmma,
    search,
)


def public_things() -> Iterator[tuple[str, object]]:
    for module in MODULES:
        yield module.__name__, module
        for name in module.__all__:
            thing = getattr(module, name)
            if inspect.isclass(thing):
                yield from class_and_members(f"{module.__name__}.{name}", thing)
            elif inspect.isroutine(thing):
                yield f"{module.__name__}.{name}", thing


def class_and_members(path: str, thing: type) -> Iterator[tuple[str, object]]:
    yield path, thing
    # What is inherited, too: a base need not be public itself.
    ours = [base for base in thing.__mro__ if base.__module__.startswith("thing_kin")]
    for name in dict.fromkeys(name for base in ours for name in vars(base)):
        # A field of a dataclass says what it is where it stands; its default here does not.
        if not name.startswith("_") and name not in getattr(thing, "__dataclass_fields__", {}):
            member = inspect.getattr_static(thing, name)
            yield f"{path}.{name}", getattr(thing, name) if callable(member) else member


THINGS = dict(public_things())
PROPERTIES = {path for path, thing in THINGS.items() if isinstance(thing, property)}
MODULES_ALONE = {
    module.__name__
    for module in (lie, robots, terms, kdl, estimation, estimation.models, odometry, rmma, search)
}
WITH_EXAMPLES = sorted(set(THINGS) - PROPERTIES - MODULES_ALONE)


def text_of(path: str) -> str:
    """The docstring, without the signature that pybind11 puts before it."""
    lines = (THINGS[path].__doc__ or "").splitlines()
    signature = bool(lines) and lines[0].startswith(path.rpartition(".")[2] + "(")
    return "\n".join(lines[1:] if signature else lines).strip()


def test_the_walk_finds_the_api() -> None:
    """So that an empty list can't pass: one of each kind."""
    assert {
        "thing_kin",
        "thing_kin.pinv",
        "thing_kin.Chain",
        "thing_kin.Chain.fk",
        "thing_kin.Chain.from_dh",
        "thing_kin.Chain.lower",
        "thing_kin.lie.se3_exp",
        "thing_kin.robots.thing",
        "thing_kin.kdl.KdlChain.jacobian",
        "thing_kin.estimation.Calibration.readings",
    } <= set(THINGS)
    assert "thing_kin.Chain.lower" in PROPERTIES
    assert "thing_kin.Chain.fk" in WITH_EXAMPLES


@pytest.mark.parametrize("path", THINGS)
def test_it_has_a_docstring(path: str) -> None:
    text = text_of(path)
    assert len(text) > 3
    assert text.splitlines()[0].endswith((".", ":", "rad/s or m/s.", "rad/s^2 or m/s^2."))


@pytest.mark.parametrize("path", WITH_EXAMPLES)
def test_its_examples_are_true(path: str) -> None:
    if path == "thing_kin.interop.to_spatialmath":
        pytest.importorskip("spatialmath")
    if "convex_hull" in path or "MeshClearance" in path:
        pytest.importorskip("coal")  # comes with Pinocchio
    if path == "thing_kin.interop.to_scipy":
        pytest.importorskip("scipy", minversion="1.16")  # the first with RigidTransform
    text = text_of(path)
    assert "Examples\n--------\n" in inspect.cleandoc(text)
    examples = doctest.DocTestParser().get_doctest(text, {}, path, None, 0)
    assert examples.examples
    said: list[str] = []
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    results = runner.run(examples, out=said.append)
    assert results.failed == 0, "".join(said)
