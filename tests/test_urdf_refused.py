"""URDFs that are refused, and what is said: one of each kind."""

import re
import threading

import numpy as np
import pytest

import thing_kin as tk
from urdf_trees import TREE, Joint, Robot, two_links

read = tk.Chain.from_urdf


MANY = Robot(
    ["hub", *(f"leaf{i}" for i in range(30))],
    [Joint(f"j{i}", "hub", f"leaf{i}") for i in range(30)],
)
LONG = Robot(
    [f"l{i}" for i in range(34)], [Joint(f"j{i}", f"l{i}", f"l{i + 1}") for i in range(33)]
)
LINKS = '<robot name="r"><link name="a"/><link name="b"/>{}</robot>'
REFUSED = {
    "joint without type": (two_links().replace(' type="revolute"', ""), "no known type"),
    "unknown type": (two_links(type="ball"), r"Joint \[j\] has no known type \[ball\]"),
    "planar": (two_links(type="planar"), "joint 'j', which is planar, expected revolute"),
    "floating": (two_links(type="floating"), "joint 'j', which is floating"),
    "mimic": (two_links(extra='<mimic joint="x"/>'), "joint 'j', which mimics another"),
    "zero axis": (two_links(axis=(0, 0, 0)), "joint 'j' with a zero axis"),
    "axis without xyz": (
        re.sub("<axis.*?/>", "<axis/>", two_links()),
        "joint 'j' with a zero axis",
    ),
    "nan axis": (two_links(axis=(0, np.nan, 1)), "joint 'j' with axis xyz '0.0 nan 1.0'"),
    "nan origin": (two_links(xyz=(np.nan, 0, 0)), "joint 'j' with origin xyz 'nan 0.0 0.0'"),
    "inf rpy": (two_links(rpy=(0, np.inf, 0)), "joint 'j' with origin rpy '0.0 inf 0.0'"),
    "far origin": (two_links(xyz=(1e300, 0, 0)), "joint 'j' with an origin that is too far"),
    "overflow": (
        two_links().replace("0.0 0.0 0.0", "1e400 0 0"),
        r"origin element for joint \[j\]",
    ),
    "overflow in a limit": (two_links(limit='upper="1e400"'), r"limit element for joint \[j\]"),
    "two numbers": (two_links(xyz=(1, 2)), r"origin element for joint \[j\]"),
    "a printf format": (two_links().replace("0.0 0.0 0.0", "%s%n 0 0"), "origin xyz '%s%n 0 0'"),
    "hexadecimal": (two_links(limit='upper="0x10"'), "joint 'j' with limit upper '0x10'"),
    "no limits": (two_links(limit=""), r"Joint \[j\] is of type REVOLUTE but"),
    "crossed limits": (two_links(limit='lower="2" upper="1"'), "joint 'j' with lower = 2 and"),
    "nan limit": (two_links(limit='lower="nan"'), "joint 'j' with limit lower 'nan'"),
    "bad velocity": (two_links(limit='velocity="fast"'), "joint 'j' with limit velocity 'fast'"),
    "no moving joint": (two_links(type="fixed"), "0 moving joints between 'a' and 'b', expected 1"),
    "one link": ('<robot name="r"><link name="a"/></robot>', "0 moving joints between 'a' and 'a'"),
    "33 joints": (LONG.text(), "33 moving joints between 'l0' and 'l33', expected 1 to 32"),
    "no link": ('<robot name="r"/>', "a robot without links"),
    "no name": (two_links().replace(' name="robot"', ""), "No name given for the robot"),
    "version 2": (two_links().replace("<robot", '<robot version="2.0"'), "Invalid 'version'"),
    "nameless link": (LINKS.format("<link/>"), "a link without a name"),
    "nameless joint": (LINKS.format("<joint/>"), "a joint without a name"),
    "link twice": (LINKS.format('<link name="a"/>'), "two links 'a'"),
    "joint twice": (
        Robot(["a", "b", "c"], [Joint("j", "a", "b"), Joint("j", "b", "c")]).text(),
        "two joints 'j'",
    ),
    "no parent": (LINKS.format('<joint name="j"><child link="b"/></joint>'), "without a parent"),
    "no child": (LINKS.format('<joint name="j"><parent link="b"/></joint>'), "without a child"),
    "unknown link": (
        Robot(["a"], [Joint("j", "a", "b")]).text(),
        "joint 'j' with child 'b', which is no link",
    ),
    "two parents": (
        Robot(["a", "b", "c"], [Joint("j", "a", "c"), Joint("k", "b", "c")]).text(),
        "link 'c' with two parents",
    ),
    "two roots": (LINKS.format(""), "2 root links: 'a', 'b'"),
    "a cycle": (
        Robot(["a", "b"], [Joint("j", "a", "b"), Joint("k", "b", "a")]).text(),
        "a cycle of joints without a root link",
    ),
    "a joint to itself": (Robot(["a"], [Joint("j", "a", "a")]).text(), "a cycle of joints"),
    "a cycle beside": (
        Robot(["r", "a", "b"], [Joint("j", "a", "b"), Joint("k", "b", "a")]).text(),
        "a cycle of joints through link 'a'",
    ),
    "another document": ("<sdf/>", "the element <sdf> where <robot> should be"),
    "a document type": ("<!DOCTYPE robot><robot/>", "a document type declaration"),
    "xacro": ('<robot name="r"><xacro:arm/></robot>', "xacro, which has to be expanded first"),
    "not closed": ("<robot>\n<link>", r"not well-formed \(line 2: no element found\)"),
    "nothing": (b"", "no element found"),
}


@pytest.mark.parametrize(("source", "said"), REFUSED.values(), ids=REFUSED)
def test_what_is_refused_and_why(
    source: str | bytes, said: str, capfd: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(ValueError, match=said) as error:
        read(source)
    assert str(error.value).startswith("source: got")
    assert ", expected " in str(error.value)
    assert capfd.readouterr() == ("", "")  # urdfdom would print


def test_links_that_are_none() -> None:
    with pytest.raises(
        ValueError, match=r"^base: got 'x', expected one of the links 'root', 'a', "
    ):
        read(TREE.text(), base="x")
    with pytest.raises(ValueError, match=r"^tip: got 'x', expected one of the links 'root', 'a', "):
        read(TREE.text(), tip="x")
    with pytest.raises(ValueError, match=r"^source: got 0 moving joints between 'a' and 'a'"):
        read(TREE.text(), base="a", tip="a")


def test_several_leaves_are_listed() -> None:
    with pytest.raises(ValueError, match=r"^tip: got none, expected .* 2 leaves: 'left', 'hand'$"):
        read(TREE.text())
    with pytest.raises(ValueError, match=r"30 leaves: 'leaf0', .*'leaf19' and 10 more$"):
        read(MANY.text())


def test_errors_of_threads_stay_apart() -> None:
    """urdfdom's messages go through one handler for the whole process."""
    said: dict[int, set[str]] = {}

    def refuse(i: int) -> None:
        text = two_links(type=f"type{i}")
        said[i] = set()
        for _ in range(200):
            try:
                read(text)
            except ValueError as error:
                said[i].add(str(error))

    threads = [threading.Thread(target=refuse, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for i, messages in said.items():
        (message,) = messages
        assert f"has no known type [type{i}]" in message
        assert message.count("[j]") == 1
