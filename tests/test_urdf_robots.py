"""URDFs as Pinocchio reads them: random trees, and every robot of example-robot-data."""

import importlib.metadata
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

import thing_kin as tk
from oracles import assert_close
from urdf_trees import PinocchioTree, path_between, random_tree, read_by_pinocchio

# Up to 32 products of rounded matrices with entries of some metres.
ATOL = 1e-12


def configurations(chain: tk.Chain, rng: np.random.Generator, count: int) -> np.ndarray:
    """Some within +-3, continuous joints up to 1000 turns either way, and zero."""
    Q = rng.uniform(-3.0, 3.0, size=(count, chain.n))
    turns = 2 * np.pi * rng.integers(-1000, 1001, size=Q.shape)
    Q += turns * (np.array(chain.joint_types) == "continuous")
    Q[0] = 0.0
    return Q


def assert_as_pinocchio(chain: tk.Chain, oracle: PinocchioTree, Q: np.ndarray) -> None:
    """At every level of instructions, as a batch and one by one."""
    T = np.stack([oracle.fk(q) for q in Q])
    J = np.stack([oracle.jacobian(q) for q in Q])
    best = tk.simd_level()
    levels = ("baseline", "avx2", "avx512")
    try:
        for level in levels[: levels.index(best) + 1]:
            tk.use_simd_level(level)
            assert_close(chain.fk(Q), T, atol=ATOL)
            assert_close(chain.jacobian(Q), J, atol=ATOL)
            assert_close(np.stack([chain.fk(q) for q in Q]), T, atol=ATOL)
            assert_close(np.stack([chain.jacobian(q) for q in Q]), J, atol=ATOL)
    finally:
        tk.use_simd_level(best)


@pytest.mark.parametrize("block", range(10))
def test_fifty_random_trees(block: int) -> None:
    for seed in range(50 * block, 50 * block + 50):
        rng = np.random.default_rng(seed)
        robot, base, tip = random_tree(rng)
        text = robot.text()
        chain = tk.Chain.from_urdf(text, base=base, tip=tip)
        up, down = path_between(robot, base, tip)
        moving = [joint for joint in up + down if joint.type != "fixed"]
        assert chain.names == tuple(joint.name for joint in moving), seed
        assert chain.joint_types == tuple(joint.type for joint in moving), seed
        links = [base, *(j.parent for j in up), *(j.child for j in down)]
        assert chain.frames == tuple(links), seed
        oracle = PinocchioTree(read_by_pinocchio(text), base, tip, chain.names)
        Q = configurations(chain, rng, 4)
        assert_as_pinocchio(chain, oracle, Q)
        for frame in chain.frames:
            assert_close(chain.fk(Q[1], frame), oracle.fk(Q[1], frame), atol=ATOL)


@pytest.mark.parametrize("block", range(5))
def test_what_is_written_is_read_by_pinocchio_too(block: int) -> None:
    for seed in range(20 * block, 20 * block + 20):
        rng = np.random.default_rng(seed)
        robot, base, tip = random_tree(rng)
        chain = tk.Chain.from_urdf(robot.text(), base=base, tip=tip)
        oracle = PinocchioTree(read_by_pinocchio(chain.to_urdf()), base, tip, chain.names)
        assert_as_pinocchio(chain, oracle, configurations(chain, rng, 3))


@pytest.mark.parametrize("robot", [tk.robots.ur5(), tk.robots.thing(order="base_first")], ids=repr)
def test_denavit_hartenberg_chains_are_read_by_pinocchio_too(robot: tk.Chain) -> None:
    model = read_by_pinocchio(robot.to_urdf())
    oracle = PinocchioTree(model, robot.frames[0], robot.frames[-1], robot.names)
    assert_as_pinocchio(robot, oracle, robot.random(20, rng=1))


# --- example-robot-data: not in the test group, for its wheel has 131 MB, unpacked 415 MB ---------

PACKAGE = "example-robot-data"
# Not read, and why: no robot in it at all (ur3.urdf is what xacro makes of a file of macros).
NOT_READ = {"ur3.urdf"}
WITHOUT_JOINTS = {"quadrotor_base.urdf", "iris_simple.urdf"}


def example_urdfs() -> list[Path]:
    try:
        files = importlib.metadata.files(PACKAGE) or []
    except importlib.metadata.PackageNotFoundError:
        return []
    return sorted(
        Path(file.locate()).resolve()
        for file in files
        if file.suffix == ".urdf" and file.name not in NOT_READ
    )


EXAMPLES = example_urdfs()
# Of each kind one that has to be there, so that a changed package can't make the test empty.
SINGLE_CHAINS = {
    *("ur5_robot.urdf", "ur10_robot.urdf", "ur3_robot.urdf", "panda.urdf", "kinova.urdf"),
    *("tiago_no_hand.urdf", "talos_left_arm.urdf", "xarm7.urdf", "z1.urdf", "so101.urdf"),
}


@pytest.mark.skipif(not EXAMPLES, reason=f"needs {PACKAGE}: pip install --group robots")
def test_the_robots_are_there() -> None:
    assert {path.name for path in EXAMPLES} >= SINGLE_CHAINS
    assert len(EXAMPLES) > 60


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_chain_of_a_robot(path: Path) -> None:
    """From the root to every leaf; what is refused has a joint that is."""
    model = pin.buildModelFromUrdf(str(path))
    rng = np.random.default_rng(1)
    compared = 0
    refused = set()
    for root, leaf in ends_of(path):
        try:
            chain = tk.Chain.from_urdf(path, base=root, tip=leaf)
        except ValueError as error:
            refused.add(str(error))
            continue
        oracle = PinocchioTree(model, root, leaf, chain.names)
        assert_as_pinocchio(chain, oracle, configurations(chain, rng, 3))
        for i, name in enumerate(chain.names):
            assert_limits(chain, i, model, model.getJointId(name))
        compared += 1
    reasons = (
        "got 0 moving joints",
        "which mimics another",
        "which is planar",
        "which is floating",
    )
    assert all(any(reason in said for reason in reasons) for said in refused), refused
    assert (compared > 0) == (path.name not in WITHOUT_JOINTS)


def ends_of(path: Path) -> list[tuple[str, str]]:
    """The root and each leaf, as the error lists them if there are several; by ElementTree."""
    from xml.etree import ElementTree

    robot = ElementTree.parse(path).getroot()
    links = [link.attrib["name"] for link in robot.findall("link")]
    ends = {
        end: {joint.find(end).attrib["link"] for joint in robot.findall("joint")}  # type: ignore[union-attr]
        for end in ("parent", "child")
    }
    (root,) = (link for link in links if link not in ends["child"])
    return [(root, link) for link in links if link not in ends["parent"]]


def assert_limits(chain: tk.Chain, i: int, model: pin.Model, joint: int) -> None:
    at = model.joints[joint]
    if chain.joint_types[i] != "continuous":
        assert chain.lower[i] == model.lowerPositionLimit[at.idx_q]
        assert chain.upper[i] == model.upperPositionLimit[at.idx_q]
    velocity = model.velocityLimit[at.idx_v]
    assert chain.velocity_limits[i] == (velocity if velocity > 0 else np.inf)
