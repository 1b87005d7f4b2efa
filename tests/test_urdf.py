"""URDF in: which chain is taken from a tree, what is read of it, and where it is looked for.

Agreement with Pinocchio is in test_urdf_robots.py, refusals are in test_urdf_refused.py, hostile
texts in test_urdf_fuzz.py.
"""

import locale
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import thing_kin as tk
from oracles import assert_close
from urdf_trees import TREE, Joint, random_tree, two_links

PI = np.pi
read = tk.Chain.from_urdf


# --- Which chain ----------------------------------------------------------------------------------


def test_from_the_root_to_a_leaf() -> None:
    chain = read(TREE.text(), tip="hand")
    assert chain.name == "octopus"
    assert chain.frames == ("root", "a", "c", "right", "hand")
    assert chain.names == ("ja", "jc", "jhand")
    assert chain.joint_types == ("continuous", "revolute", "revolute")
    assert chain.base_joints is None


def test_a_base_below_the_root_and_its_only_leaf() -> None:
    chain = read(TREE.text(), base="c")
    assert chain.frames == ("c", "right", "hand")
    assert chain.names == ("jhand",)


def test_a_tip_that_is_no_leaf() -> None:
    assert read(TREE.text(), tip="b").frames == ("root", "a", "b")


def test_through_the_common_ancestor() -> None:
    chain = read(TREE.text(), base="left", tip="hand")
    assert chain.frames == ("left", "b", "a", "c", "right", "hand")
    assert chain.names == ("jleft", "jb", "jc", "jhand")
    q = np.array([0.3, -0.4, 0.5, 0.6])
    left, hand = read(TREE.text(), tip="left"), read(TREE.text(), tip="hand")
    expected = np.linalg.inv(left.fk([0.7, q[1], q[0]])) @ hand.fk([0.7, q[2], q[3]])
    assert_close(chain.fk(q), expected, atol=1e-15)


@pytest.mark.parametrize("seed", range(50))
def test_the_other_way_is_the_inverse(seed: int) -> None:
    """And limits stay those of the joint: q has the sign of the URDF either way."""
    robot, base, tip = random_tree(np.random.default_rng(seed))
    there, back = read(robot.text(), base, tip), read(robot.text(), tip, base)
    assert back.names == there.names[::-1]
    assert back.frames == there.frames[::-1]
    for limits in ("lower", "upper", "velocity_limits"):
        assert_array_equal(getattr(back, limits), getattr(there, limits)[::-1])
    q = np.random.default_rng(seed).uniform(-2.0, 2.0, there.n)
    assert_close(back.fk(q[::-1]) @ there.fk(q), np.eye(4), atol=1e-13)


def test_the_name_may_be_given() -> None:
    assert read(TREE.text(), "a", "hand", None, "arm").name == "arm"


# --- What is read ---------------------------------------------------------------------------------


@pytest.mark.parametrize("axis", [*np.eye(3), *-np.eye(3)], ids=str)
@pytest.mark.parametrize("joint", ["revolute", "continuous", "prismatic"])
def test_right_angles_are_exact(axis: np.ndarray, joint: str) -> None:
    """In every frame and in the Jacobian, not only nearly."""
    for rpy in PI / 2 * np.array([[1, 0, 0], [0, 1, 2], [-1, 2, 1], [2, -1, 0]]):
        chain = read(two_links(type=joint, axis=axis, rpy=rpy, xyz=(1.0, 2.0, 3.0)))
        T, J = chain.fk([0.0]), chain.jacobian([0.0])
        assert set(np.abs(T[:3, :3]).ravel()) == {0.0, 1.0}
        rows = slice(0, 3) if joint == "prismatic" else slice(3, 6)
        assert_array_equal(J[rows, 0], T[:3, :3] @ axis)


@pytest.mark.parametrize("scale", [1e-300, 1e-3, 1.0, 7.0, 1e300])
def test_an_axis_is_normalized(scale: float) -> None:
    chain = read(two_links(axis=scale * np.array([2.0, -1.0, 2.0])))
    assert_close(chain.jacobian([0.3])[3:, 0], np.array([2.0, -1.0, 2.0]) / 3, atol=1e-15)


def test_defaults_of_urdf() -> None:
    """No origin: the identity. No axis: x. No lower or upper: 0."""
    joint = (
        '<joint name="j" type="prismatic"><parent link="a"/><child link="b"/><limit {}/></joint>'
    )
    text = f'<robot name="r"><link name="a"/><link name="b"/>{joint}</robot>'
    chain = read(text.format('effort="1" velocity="2"'))
    assert_array_equal(chain.fk([0.5])[:3, 3], [0.5, 0.0, 0.0])
    assert (chain.lower[0], chain.upper[0], chain.velocity_limits[0]) == (0.0, 0.0, 2.0)
    assert read(text.format("")).velocity_limits[0] == np.inf


@pytest.mark.parametrize(
    ("limit", "expected"),
    [
        ('lower="-2" upper="3" velocity="0.5" effort="9"', (-2.0, 3.0, 0.5)),
        ('lower="-2e-1" upper="+.5" velocity="0"', (-0.2, 0.5, np.inf)),
        ('upper="1" velocity="-1" effort="nonsense"', (0.0, 1.0, np.inf)),
        (f'lower="{-sys.float_info.max}" upper="1"', (-np.inf, 1.0, np.inf)),
        ('lower=" \n\t-1 " upper="1" velocity="1"', (-1.0, 1.0, 1.0)),
    ],
)
def test_limits(limit: str, expected: tuple[float, float, float]) -> None:
    chain = read(two_links(limit=limit))
    assert (chain.lower[0], chain.upper[0], chain.velocity_limits[0]) == expected
    assert chain.acceleration_limits[0] == np.inf


@pytest.mark.parametrize("limit", ["", 'lower="-1" upper="1" velocity="2"', 'velocity="2"'])
def test_a_continuous_joint_has_no_position_limits(limit: str) -> None:
    chain = read(two_links(type="continuous", limit=limit))
    assert (chain.lower[0], chain.upper[0]) == (-np.inf, np.inf)
    assert chain.velocity_limits[0] == (2.0 if limit else np.inf)


def test_what_is_not_kinematics_is_not_read() -> None:
    extra = (
        '<safety_controller/><dynamics/><calibration rising="x"/><origin xyz="9 9 9"/>'
        "<transmission><joint/></transmission><!-- -->"
    )
    text = two_links(extra=extra).replace(
        '<link name="b"/>',
        '<link name="b"><visual><geometry><mesh filename="package://none/x.dae"/></geometry>'
        '</visual><inertial><mass value="heavy"/></inertial></link>'
        '<gazebo><joint name="j"/><link name="a"/></gazebo><material/>',
    )
    assert read(text) == read(two_links())


@pytest.mark.parametrize("extra", ["<mimic/>", '<mimic joint="x" multiplier="nan"/>'])
@pytest.mark.parametrize("kind", ["planar", "floating", "revolute", "nonsense", ""])
def test_what_is_off_the_chain_does_not_matter(extra: str, kind: str) -> None:
    bad = Joint("bad", "a", "other", kind, axis=(0, 0, 0), limit='lower="x"', extra=extra)
    robot = replace(TREE, links=[*TREE.links, "other"], joints=[*TREE.joints, bad])
    assert read(robot.text(), tip="hand") == read(TREE.text(), tip="hand")


NAMES = ["with space", "<&>\"'", "größe", "結節", "%s%n", "tab\there", "line\nbreak", "world", "𝄞"]


def test_names_of_any_kind_come_through() -> None:
    """In both directions; XML's attribute values have blanks for tabs unless those are escaped."""
    rows = [tk.DH(a=1.0, joint="revolute", name=n + "j", frame=n) for n in NAMES if n != "world"]
    chain = tk.Chain.from_dh(rows, name="näme\t<")
    again = read(chain.to_urdf())
    assert again.name == chain.name
    assert again.names == chain.names
    assert set(chain.frames) <= set(again.frames)


def test_other_encodings() -> None:
    body = two_links().replace('name="j"', 'name="größe"')
    for encoding in ("utf-8", "utf-16", "iso-8859-1"):
        text = f'<?xml version="1.0" encoding="{encoding}"?>{body}'
        assert read(text.encode(encoding)).names == ("größe",)
        assert read(text).names == ("größe",)  # a str is what it is, whatever it declares
    assert read("\ufeff \n" + body).names == ("größe",)
    assert read(body.encode("utf-8-sig")).names == ("größe",)


def test_the_locale_does_not_matter() -> None:
    before = locale.setlocale(locale.LC_ALL)
    for name in ("de_DE.UTF-8", "fr_FR.UTF-8"):
        try:
            locale.setlocale(locale.LC_ALL, name)
        except locale.Error:
            continue
        try:
            chain = read(two_links(xyz=(1.5, 0.25, 0.0)))
            assert_array_equal(chain.fk([0.0])[:3, 3], [1.5, 0.25, 0.0])
            assert "1.5 0.25" in chain.to_urdf()
        finally:
            locale.setlocale(locale.LC_ALL, before)


# --- Where it is ----------------------------------------------------------------------------------


def test_files_and_packages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    expected = read(two_links())
    folder = tmp_path / "share" / "my_robot" / "urdf"
    folder.mkdir(parents=True)
    file = folder / "größe.urdf"
    file.write_text(two_links(), encoding="utf-8")
    uri = "package://my_robot/urdf/größe.urdf"
    for source in (file, str(file), f"file://{file}"):
        assert read(source) == expected
    for package in (folder.parent, str(folder.parent)):
        assert read(uri, packages={"my_robot": package, "other": "nowhere"}) == expected
    for variable in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"):
        monkeypatch.delenv(variable, raising=False)
    with pytest.raises(ValueError, match=r"^source: got 'package://my_robot/urdf/gr"):
        read(uri)
    for variable, path in (
        ("ROS_PACKAGE_PATH", tmp_path / "share"),
        ("ROS_PACKAGE_PATH", folder.parent),
        ("AMENT_PREFIX_PATH", tmp_path),
    ):
        with monkeypatch.context() as environment:
            environment.setenv(variable, f"/nowhere::{path}")
            assert read(uri) == expected
            with pytest.raises(ValueError, match="source: got 'package://my_robot/none'"):
                read("package://my_robot/none")


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    (tmp_path / "robot.urdf.xacro").write_text(two_links())
    empty = tmp_path / "empty.urdf"
    empty.touch()
    for source, said in (
        (tmp_path / "none.urdf", "which is not there"),
        (tmp_path, "which is no regular file"),
        ("/dev/zero", "which is no regular file"),
        (tmp_path / "robot.urdf.xacro", "xacro has to expand first"),
        (empty, "no element found"),
        ("", "which is no path"),
        ("robot\0.urdf", "which is no path|, expected a path"),
        (None, "NoneType, expected a path"),
        (3, "int, expected a path"),
        ("x" * 5000, "which is not there|can't be read"),
    ):
        with pytest.raises(ValueError, match=said) as error:
            read(source)  # type: ignore[arg-type]
        assert str(error.value).startswith("source: got")


@pytest.mark.parametrize("packages", [3, ["a"], {"a": 1}, {1: "a"}])
def test_packages_that_are_none(packages: object) -> None:
    with pytest.raises(ValueError, match=r"^packages: got .*, expected a "):
        read(two_links(), packages=packages)  # type: ignore[arg-type]


def test_without_urdfdom_the_error_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "thing_kin._urdf", None)
    with pytest.raises(ImportError, match=r"install liburdfdom-dev and libexpat1-dev, then build"):
        read(two_links())
    assert tk.robots.ur5().to_urdf()
