"""Calibrated UR arms: the maker's nominal files are the Denavit-Hartenberg model."""

import copy
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from scipy.spatial.transform import Rotation

import thing_kin as tk
from oracles import assert_close, rotation_x, rotation_z, translation

# Universal_Robots_ROS2_Description, config/ur5 and ur10/default_kinematics.yaml.
NOMINAL = {
    "ur5": """
kinematics:
  shoulder: {x: 0, y: 0, z: 0.089159, roll: 0, pitch: 0, yaw: 0}
  upper_arm: {x: 0, y: 0, z: 0, roll: 1.570796327, pitch: 0, yaw: 0}
  forearm: {x: -0.425, y: 0, z: 0, roll: 0, pitch: 0, yaw: 0}
  wrist_1: {x: -0.39225, y: 0, z: 0.10915, roll: 0, pitch: 0, yaw: 0}
  wrist_2: {x: 0, y: -0.09465, z: -1.941303950897609e-11, roll: 1.570796327, pitch: 0, yaw: 0}
  wrist_3:
    x: 0
    y: 0.0823
    z: -1.688001216681175e-11
    roll: 1.570796326589793
    pitch: 3.141592653589793
    yaw: 3.141592653589793
  hash: calib_209549117540498681
""",
    "ur10": """
kinematics:
  shoulder: {x: 0, y: 0, z: 0.1273, roll: 0, pitch: 0, yaw: 0}
  upper_arm: {x: 0, y: 0, z: 0, roll: 1.570796327, pitch: 0, yaw: 0}
  forearm: {x: -0.612, y: 0, z: 0, roll: 0, pitch: 0, yaw: 0}
  wrist_1: {x: -0.5723, y: 0, z: 0.163941, roll: 0, pitch: 0, yaw: 0}
  wrist_2: {x: 0, y: -0.1157, z: -2.373046667922381e-11, roll: 1.570796327, pitch: 0, yaw: 0}
  wrist_3:
    x: 0
    y: 0.0922
    z: -1.891053610911353e-11
    roll: 1.570796326589793
    pitch: 3.141592653589793
    yaw: 3.141592653589793
  hash: calib_17227329492635474227
""",
}
LINKS = ("shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3")
KEYS = ("x", "y", "z", "roll", "pitch", "yaw")
ROBOTS = {"ur5": tk.robots.ur5, "ur10": tk.robots.ur10}


def mapping_of(*origins: tuple[float, ...]) -> dict[str, Any]:
    links = {link: dict(zip(KEYS, o, strict=True)) for link, o in zip(LINKS, origins, strict=True)}
    return {"kinematics": {**links, "hash": "calib_1"}}


def perturbed(seed: int) -> dict[str, Any]:
    rng = np.random.default_rng(seed)
    origins = rng.uniform(-0.5, 0.5, (6, 6))
    return mapping_of(*(tuple(origin) for origin in origins))


@pytest.fixture(params=ROBOTS)
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_the_nominal_file_is_the_model(name: str, tmp_path: Path) -> None:
    """The maker writes right angles with ten digits: 2e-10 rad over a meter or two."""
    file = tmp_path / "calibration.yaml"
    file.write_text(NOMINAL[name])
    for path in (file, str(file)):
        nominal, calibrated = ROBOTS[name](), ROBOTS[name](calibration=path)
        Q = nominal.random(50, rng=1)
        assert_close(calibrated.fk_all(Q), nominal.fk_all(Q), atol=1e-8)
        assert_close(calibrated.jacobian(Q), nominal.jacobian(Q), atol=1e-8)
        assert (calibrated.fk_all(Q) != nominal.fk_all(Q)).any()


def test_names_and_limits_stay(name: str) -> None:
    nominal, calibrated = ROBOTS[name](), ROBOTS[name](perturbed(1))
    assert calibrated.name == nominal.name
    assert calibrated.names == nominal.names
    assert calibrated.frames == nominal.frames
    for limits in ("lower", "upper", "velocity_limits", "acceleration_limits"):
        assert_array_equal(getattr(calibrated, limits), getattr(nominal, limits))


@pytest.mark.parametrize("seed", range(10))
def test_the_tool_is_the_product_of_the_origins(name: str, seed: int) -> None:
    """As a URDF with these six joints has it, each about its z."""
    calibration = perturbed(seed)
    chain = ROBOTS[name](calibration)
    q = np.random.default_rng(seed).uniform(-3.0, 3.0, 6)
    T = np.eye(4)
    for link, angle in zip(LINKS, q, strict=True):
        o = calibration["kinematics"][link]
        origin = translation(o["x"], o["y"], o["z"])
        rpy = (o["roll"], o["pitch"], o["yaw"])
        origin[:3, :3] = Rotation.from_euler("xyz", rpy).as_matrix()
        T = T @ origin @ rotation_z(angle)
    assert_close(chain.fk(q), T, atol=2e-15)


def test_a_frame_stays_on_the_axis_of_the_next_joint(name: str) -> None:
    """Turning that joint turns the frames beyond about the z of the frame before."""
    chain = ROBOTS[name](perturbed(3))
    q = np.linspace(-1.0, 1.0, 6)
    J = chain.jacobian(q)
    for k, frame in enumerate(("shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2"), start=1):
        T = chain.fk(q, frame)
        axis = T[:3, 2]
        assert_close(J[3:, k], axis, atol=1e-15)
        assert_close(J[:3, k], np.cross(axis, chain.fk(q)[:3, 3] - T[:3, 3]), atol=1e-15)


@pytest.mark.parametrize("seed", range(5))
def test_any_denavit_hartenberg_arm_can_be_written_as_a_calibration(name: str, seed: int) -> None:
    """The relation of the two: T_k = Rz(q) Tz(d) Tx(a) Rx(alpha) with the factors regrouped.

    The origin of joint k is row k - 1 without its joint, then row k's Tz(d) and its offset in
    theta, which commute with the joint; the last row's a and alpha remain for a tool.
    """
    rng = np.random.default_rng(seed)
    d, a, alpha, theta = rng.uniform(-0.5, 0.5, (4, 6))
    a[5] = alpha[5] = 0.0
    rows = [tk.DH(*row, "revolute") for row in zip(d, theta, a, alpha, strict=True)]
    origins = []
    for k in range(6):
        before = translation(a[k - 1], 0, 0) @ rotation_x(alpha[k - 1]) if k > 0 else np.eye(4)
        T = before @ translation(0, 0, d[k]) @ rotation_z(theta[k])
        origins.append((*T[:3, 3], *Rotation.from_matrix(T[:3, :3]).as_euler("xyz")))
    chain = ROBOTS[name](mapping_of(*origins))
    Q = rng.uniform(-3.0, 3.0, (10, 6))
    assert_close(chain.fk(Q), tk.Chain.from_dh(rows).fk(Q), atol=5e-15)


def test_on_a_base() -> None:
    mount = tk.transform(xyz=(0.1, 0.2, 0.3), rpy=(0.1, 0.2, 0.3))
    arm = tk.robots.ur10(perturbed(4))
    robot = tk.on_omni_base(arm, mount=mount)
    q = np.linspace(-1.0, 1.0, 9)
    base = translation(q[6], q[7], 0.0) @ rotation_z(q[8])
    assert_close(robot.fk(q), base @ mount @ arm.fk(q[:6]), atol=3e-15)


def test_numbers_that_pyyaml_takes_for_text(tmp_path: Path) -> None:
    file = tmp_path / "calibration.yaml"
    file.write_text(NOMINAL["ur5"].replace("x: 0,", "x: 5e-05,", 1))
    calibration = {"kinematics": {link: dict.fromkeys(KEYS, 0) for link in LINKS}}
    calibration["kinematics"]["shoulder"]["x"] = "5e-05"
    for source in (file, calibration):
        assert tk.robots.ur5(source).fk(np.zeros(6), "shoulder")[0, 3] == 5e-05


def spoiled(change: Any) -> dict[str, Any]:
    calibration = copy.deepcopy(perturbed(0))
    change(calibration["kinematics"])
    return calibration


WRONG = {
    "no mapping": ([], "a calibration that is no mapping: \\[\\]"),
    "a number": (3, "a calibration that is no mapping: 3"),
    "empty": ({}, "a calibration without 'kinematics'"),
    "inside only": (perturbed(0)["kinematics"], "a calibration with 'shoulder'"),
    "no table": ({"kinematics": None}, "kinematics that is no mapping: None"),
    "link missing": (spoiled(lambda k: k.pop("wrist_2")), "kinematics without 'wrist_2'"),
    "link unknown": (spoiled(lambda k: k.update(wrist_4={})), "kinematics with 'wrist_4'"),
    "link no mapping": (spoiled(lambda k: k.update(forearm=1.0)), "forearm that is no mapping"),
    "key missing": (spoiled(lambda k: k["wrist_1"].pop("yaw")), "wrist_1 without 'yaw'"),
    "key unknown": (spoiled(lambda k: k["wrist_1"].update(w=1)), "wrist_1 with 'w'"),
    "key no text": (spoiled(lambda k: k["wrist_1"].update({1: 1})), "wrist_1 with 1"),
    "text": (spoiled(lambda k: k["wrist_1"].update(x="far")), "wrist_1.x = 'far'"),
    "nothing": (spoiled(lambda k: k["wrist_1"].update(x=None)), "wrist_1.x = None"),
    "true": (spoiled(lambda k: k["wrist_1"].update(x=True)), "wrist_1.x = True"),
    "huge": (spoiled(lambda k: k["wrist_1"].update(x=10**400)), "wrist_1.x = 1000"),
    "nan": (spoiled(lambda k: k["wrist_1"].update(x=np.nan)), "nan in 'wrist_1', expected meters"),
    "inf": (spoiled(lambda k: k["shoulder"].update(yaw=np.inf)), "inf in 'shoulder', expected rad"),
    "millimeters": (
        spoiled(lambda k: k["forearm"].update(x=-612.0)),
        "-612 in 'forearm', expected",
    ),
    "degrees": (
        spoiled(lambda k: k["wrist_2"].update(roll=90)),
        "90 in 'wrist_2', expected radian",
    ),
}


@pytest.mark.parametrize(("calibration", "said"), WRONG.values(), ids=WRONG)
def test_what_is_wrong_is_said(name: str, calibration: Any, said: str) -> None:
    with pytest.raises(ValueError, match=f"^calibration: got {said}") as error:
        ROBOTS[name](calibration)
    assert ", expected " in str(error.value)


FILES = {
    "no yaml": b"kinematics: [",
    "a tag that makes an object": b"!!python/object/apply:os.system ['true']",
    "deep": b"[" * 100_000,
    "not utf-8": b"\xff\xfe\xfa",
    "empty": b"",
    "only text": b"kinematics",
    "aliases of aliases": b"a: &a [x, x]\nb: &b [*a, *a]\nkinematics: [*b, *b]",
    "large": b" " * ((1 << 20) + 1),
}


@pytest.mark.parametrize("content", FILES.values(), ids=FILES)
def test_files_that_are_none(content: bytes, tmp_path: Path) -> None:
    file = tmp_path / "calibration.yaml"
    file.write_bytes(content)
    with pytest.raises(ValueError, match=r"^calibration: got .*, expected "):
        tk.robots.ur10(calibration=file)


@pytest.mark.parametrize("path", ["nowhere.yaml", "/dev/zero", "/", "a\0b"])
def test_files_that_are_not_there(path: str) -> None:
    with pytest.raises(ValueError, match=r"^calibration: got .*, expected a file"):
        tk.robots.ur10(calibration=path)


def test_a_mapping_needs_no_yaml(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "yaml", None)
    tk.robots.ur5(perturbed(0))
    with pytest.raises(ImportError, match=r"pip install 'thing_kin\[yaml\]'"):
        tk.robots.ur5(tmp_path)
