"""Whatever the text: a chain that computes, or a ValueError that says why; never a crash."""

import random
import subprocess
import sys
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import thing_kin as tk
from urdf_trees import random_tree, two_links

GOOD = [random_tree(np.random.default_rng(seed))[0].text() for seed in range(20)]


def assert_answered(source: str | bytes, base: str | None = None, tip: str | None = None) -> bool:
    """True if it was read."""
    try:
        chain = tk.Chain.from_urdf(source, base=base, tip=tip)
    except ValueError as error:
        said = str(error)
    else:
        assert np.isfinite(chain.fk_all(np.zeros(chain.n))).all()
        assert np.isfinite(chain.jacobian(np.ones(chain.n))).all()
        assert tk.Chain.from_urdf(chain.to_urdf()).names == chain.names
        return True
    assert said.startswith(("source: got", "tip: got", "base: got")), said
    assert ", expected " in said
    return False


# --- XML of the right words in the wrong places ---------------------------------------------------

words = st.sampled_from(
    [
        *("a", "b", "c", "", " ", "j", "revolute", "continuous", "prismatic", "fixed", "planar"),
        *(
            "0 0 1",
            "1 2 3",
            "0",
            "-1",
            "nan",
            "inf",
            "1e400",
            "1e-400",
            "1e308 0 0",
            "0 0",
            "1,2,3",
        ),
        *(
            "%s%s%s%n",
            "%1000000d",
            "&lt;",
            "&#10;",
            "&#0;",
            "&undefined;",
            "\x00",
            "\ud800",
            "é",
            "1.0",
        ),
    ]
)
tags = st.sampled_from(
    [
        *("robot", "link", "joint", "parent", "child", "origin", "axis", "limit", "mimic"),
        *("visual", "inertial", "gazebo", "material", "xacro:if", "dynamics", "a:b", "1", ""),
    ]
)
keys = st.sampled_from(
    ["name", "type", "link", "xyz", "rpy", "lower", "upper", "velocity", "joint"]
)


@st.composite
def elements(draw: st.DrawFn, depth: int = 3) -> str:
    tag = draw(tags)
    attributes = "".join(
        f' {key}="{value}"' for key, value in draw(st.dictionaries(keys, words, max_size=4)).items()
    )
    if depth == 0 or draw(st.booleans()):
        return f"<{tag}{attributes}/>"
    inside = "".join(draw(st.lists(elements(depth - 1), max_size=4)))
    return f"<{tag}{attributes}>{inside}</{tag}>"


@settings(max_examples=300)
@given(st.lists(elements(), max_size=6).map("".join))
def test_elements_of_any_kind(inside: str) -> None:
    assert_answered(f'<robot name="r"><link name="a"/><link name="b"/>{inside}</robot>')


JOINTS = st.builds(
    '<joint name="{}" type="{}"><parent link="{}"/><child link="{}"/><origin xyz="{}" rpy="{}"/>'
    '<axis xyz="{}"/><limit lower="{}" velocity="{}"/></joint>'.format,
    *[words] * 9,
)


@settings(max_examples=300)
@given(st.lists(JOINTS, max_size=4), st.none() | words, st.none() | words)
def test_joints_of_any_kind(inside: list[str], base: str | None, tip: str | None) -> None:
    text = "".join(f'<link name="{name}"/>' for name in "abc") + "".join(inside)
    base, tip = (None if name and "\ud800" in name else name for name in (base, tip))
    assert_answered(f'<robot name="r">{text}</robot>', base, tip)


# --- Good texts spoiled ---------------------------------------------------------------------------


def spoil(rng: random.Random, text: bytes) -> bytes:
    for _ in range(rng.randint(1, 4)):
        at, length = rng.randrange(len(text) + 1), rng.choice([1, 1, 1, 4, 20, 200])
        piece = text[at : at + length]
        new = rng.choice(
            [
                b"",
                piece * 2,
                piece[::-1],
                bytes(rng.randrange(256) for _ in range(rng.choice([1, 3]))),
                rng.choice([b"<", b">", b"&", b'"', b"\0", b"%n", b"1e400", b"-", b"nan", b"]]>"]),
                rng.choice(
                    [b"<!--", b"-->", b"<![CDATA[", b"<?x ?>", b"<!DOCTYPE a>", b"\xff\xfe"]
                ),
            ]
        )
        text = text[:at] + new + text[at + length :]
    return text


@pytest.mark.parametrize("block", range(10))
def test_good_texts_spoiled(block: int) -> None:
    rng = random.Random(block)
    read = [assert_answered(spoil(rng, rng.choice(GOOD).encode())) for _ in range(300)]
    assert 0 < sum(read) < len(read)


@settings(max_examples=200)
@given(st.binary(max_size=200) | st.text(max_size=200).map(lambda text: "<" + text))
def test_anything(source: str | bytes) -> None:
    assert not assert_answered(source)


def test_every_prefix_of_a_text_is_refused() -> None:
    text = two_links()
    assert assert_answered(text)
    assert not any(assert_answered(text[:end].encode()) for end in range(len(text)))


# --- What is meant to hurt ------------------------------------------------------------------------

TWO_LINKS = '<robot name="r"><link name="a"/><link name="b"/>'
BETWEEN = '<joint name="{}" type="{}"><parent link="a"/><child link="b"/>{}</joint></robot>'
MILLION = 10**6


def joint(kind: str = "revolute", inside: str = "", name: str = "j") -> str:
    return TWO_LINKS + BETWEEN.format(name, kind, inside)


def robot(inside: str) -> str:
    return f'<robot name="r">{inside}</robot>'


def chain_of(count: int) -> str:
    """Links 0 to count, with fixed joints between."""
    links = "".join(f'<link name="{i}"/>' for i in range(count + 1))
    fixed = '<joint name="{0}" type="fixed"><parent link="{0}"/><child link="{1}"/></joint>'
    return links + "".join(fixed.format(i, i + 1) for i in range(count))


def laughs() -> str:
    """Ten to the eleventh of them."""
    entities = '<!ENTITY l0 "ha">'
    for i in range(1, 12):
        entities += f'<!ENTITY l{i} "' + f"&l{i - 1};" * 10 + '">'
    return f'<!DOCTYPE r [{entities}]><robot name="&l11;"/>'


def entity(declaration: str, uses: int = 1) -> str:
    return f'<!DOCTYPE r [<!ENTITY a {declaration}>]><robot name="{"&a;" * uses}"/>'


HOSTILE: dict[str, Callable[[], str | bytes]] = {
    "laughs": laughs,
    "quadratic laughs": lambda: entity('"' + "a" * MILLION + '"', 100_000),
    "external entity": lambda: entity('SYSTEM "file:///etc/passwd"'),
    "external document type": lambda: '<!DOCTYPE r SYSTEM "http://localhost/x"><robot/>',
    "a million deep": lambda: "<a>" * MILLION,
    "a million deep and back": lambda: robot("<a>" * MILLION + "</a>" * MILLION),
    "100 MB of text": lambda: robot("x" * 100 * MILLION),
    "60 MB of text": lambda: robot("x" * 60 * MILLION),
    "60 MB of links": lambda: robot('<link name="a"/>' * (4 * MILLION)),
    "a million attributes": lambda: "<robot" + "".join(f" a{i}=''" for i in range(MILLION)) + "/>",
    "an attribute of 60 MB": lambda: f'<robot name="{"x" * 60 * MILLION}"/>',
    "a number of 60 MB": lambda: joint(inside=f'<axis xyz="{"1" * 60 * MILLION}"/>'),
    "a name of 10 MB": lambda: joint("ball", name="é" * 5 * MILLION),
    "a long chain of fixed joints": lambda: robot(chain_of(50_000)),
    "a long chain and a second root": lambda: robot(chain_of(20_000) + '<link name="x"/>'),
    "nul": lambda: joint("continuous", "\0"),
    "half a character": lambda: TWO_LINKS.encode() + b"\xc3",
    "an encoding that is none": lambda: b'<?xml version="1.0" encoding="utf-7"?><robot/>',
    "formats": lambda: joint("continuous", '<origin xyz="%s%s%n 0 0"/>'),
    "formats in names": lambda: joint("ball", name="%s%s%s%n%n"),
    "no numbers of digits": lambda: joint("continuous", '<origin xyz="....... - e"/>'),
    "a version": lambda: joint("fixed").replace("name", 'version="9999999999999999.%n" name', 1),
    "empty": lambda: b"",
    "blanks": lambda: b" " * 10 * MILLION,
    "a byte order mark": lambda: b"\xff\xfe",
}
READ = """
import resource, sys
resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))
resource.setrlimit(resource.RLIMIT_STACK, (1 << 20, 1 << 20))
import thing_kin as tk
try:
    tk.Chain.from_urdf(sys.stdin.buffer.read())
except ValueError as error:
    assert str(error).startswith(('source: got', 'tip: got')), error
    print('refused')
"""


@pytest.mark.parametrize("make", HOSTILE.values(), ids=HOSTILE)
def test_what_is_meant_to_hurt(make: Callable[[], str | bytes]) -> None:
    """In a process of its own, with little stack, memory and time; it says nothing of itself."""
    text = make()
    done = subprocess.run(
        [sys.executable, "-c", READ],
        input=text.encode() if isinstance(text, str) else text,
        capture_output=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, b"refused\n", b"")


def test_long_chains_of_fixed_joints() -> None:
    """The last but one that is taken."""
    for count, taken in ((999, True), (1000, False)):
        text = chain_of(count) + '<link name="tip"/><joint name="turn" type="continuous">'
        text += f'<parent link="{count}"/><child link="tip"/></joint>'
        assert assert_answered(robot(text)) == taken
