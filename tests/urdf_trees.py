"""URDF texts made for tests, and Pinocchio's reading of them as the oracle."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

Array = NDArray[np.float64]

MOVING = ("revolute", "continuous", "prismatic")
RIGHT_ANGLE = np.pi / 2


@dataclass(frozen=True)
class Joint:
    """One <joint>; `extra` is XML to go into it."""

    name: str
    parent: str
    child: str
    type: str = "revolute"
    xyz: Sequence[float] = (0.0, 0.0, 0.0)
    rpy: Sequence[float] = (0.0, 0.0, 0.0)
    axis: Sequence[float] = (0.0, 0.0, 1.0)
    limit: str = 'lower="-1" upper="1" velocity="1" effort="1"'
    extra: str = ""

    def text(self) -> str:
        return (
            f'<joint name="{self.name}" type="{self.type}"><parent link="{self.parent}"/>'
            f'<child link="{self.child}"/><origin xyz="{numbers(self.xyz)}" '
            f'rpy="{numbers(self.rpy)}"/><axis xyz="{numbers(self.axis)}"/>'
            + (f"<limit {self.limit}/>" if self.limit else "")
            + f"{self.extra}</joint>"
        )


@dataclass(frozen=True)
class Robot:
    """A tree of links and joints."""

    links: list[str]
    joints: list[Joint] = field(default_factory=list)
    name: str = "robot"

    def text(self) -> str:
        links = "".join(f'<link name="{link}"/>' for link in self.links)
        joints = "".join(joint.text() for joint in self.joints)
        return f'<robot name="{self.name}">{links}{joints}</robot>'


#      root - a - b - left
#              \- c - right - hand
TREE = Robot(
    ["root", "a", "b", "left", "c", "right", "hand"],
    [
        Joint("ja", "root", "a", "continuous", xyz=(0, 0, 1)),
        Joint("jb", "a", "b", xyz=(0.5, 0, 0), rpy=(0.1, 0.2, 0.3), axis=(0, 1, 0)),
        Joint("jleft", "b", "left", "prismatic", xyz=(0, 0.2, 0), axis=(1, 1, 0)),
        Joint("jc", "a", "c", xyz=(-0.5, 0, 0), axis=(1, 2, 3)),
        Joint("jright", "c", "right", "fixed", xyz=(0.1, 0.2, 0.3), rpy=(0.3, 0, 0)),
        Joint("jhand", "right", "hand", "revolute", rpy=(0, 0.4, 0)),
    ],
    name="octopus",
)


def numbers(values: Sequence[float]) -> str:
    return " ".join(repr(float(value)) for value in values)


def two_links(**joint: object) -> str:
    """A robot with one joint j from a to b, with other values than Joint's own."""
    return Robot(["a", "b"], [replace(Joint("j", "a", "b"), **joint)]).text()  # type: ignore[arg-type]


def path_between(robot: Robot, base: str, tip: str) -> tuple[list[Joint], list[Joint]]:
    """Joints from base up to the common ancestor, and from there down to tip."""
    above = {joint.child: joint for joint in robot.joints}

    def to_root(link: str) -> list[Joint]:
        joints = []
        while link in above:
            joints.append(above[link])
            link = above[link].parent
        return joints

    up, down = to_root(base), to_root(tip)
    common = set(map(id, up)) & set(map(id, down))
    return [j for j in up if id(j) not in common], [j for j in down if id(j) not in common][::-1]


def random_tree(rng: np.random.Generator) -> tuple[Robot, str, str]:
    """A robot of 2 to 15 links, and two of them with at least one moving joint between.

    What is not between them may be of any kind, also of those that thing_kin refuses.
    """
    count = int(rng.integers(2, 16))
    links = [f"link{i}" for i in range(count)]
    bushy = rng.random()
    joints = []
    for i in range(1, count):
        parent = int(rng.integers(0, i)) if rng.random() < bushy else i - 1
        joints.append(random_joint(rng, f"joint{i}", links[parent], links[i]))
    base, tip = rng.choice(count, size=2, replace=False)
    if rng.random() < 0.5:
        base, tip = 0, count - 1
    robot = Robot(links, joints)
    up, down = path_between(robot, links[base], links[tip])
    between = {joint.name for joint in up + down}
    one = str(rng.choice(sorted(between)))
    for i, joint in enumerate(joints):
        kinds = (*MOVING, "fixed") if joint.name in between else (*MOVING, "planar", "floating")
        kinds = MOVING if joint.name == one else kinds
        joints[i] = replace(joint, type=str(rng.choice(kinds)))
    order = rng.permutation(count - 1)
    return replace(robot, joints=[joints[i] for i in order]), links[base], links[tip]


def random_joint(rng: np.random.Generator, name: str, parent: str, child: str) -> Joint:
    axis = rng.normal(size=3) * 10.0 ** rng.uniform(-3, 3)
    if rng.random() < 0.4:
        axis = rng.choice([-1.0, 1.0]) * np.eye(3)[rng.integers(3)]
    rpy = rng.uniform(-4.0, 4.0, size=3)
    if rng.random() < 0.4:
        rpy = RIGHT_ANGLE * rng.integers(-2, 3, size=3)
    xyz = rng.uniform(-1.0, 1.0, size=3) * (rng.random(3) < 0.7)
    lower, upper = np.sort(rng.uniform(-3.0, 3.0, size=2))
    velocity = rng.uniform(0.1, 3.0)
    limit = f'lower="{float(lower)}" upper="{float(upper)}" velocity="{velocity}" effort="1"'
    return Joint(name, parent, child, "revolute", xyz, rpy, axis, limit)


class PinocchioTree:
    """A URDF as Pinocchio reads it: a chain's tool in its root, and the Jacobian there."""

    def __init__(self, model: pin.Model, base: str, tip: str, names: Sequence[str]) -> None:
        self.model, self.data = model, model.createData()
        self.base, self.tip = (self.model.getFrameId(link, pin.BODY) for link in (base, tip))
        self.joints = [self.model.joints[self.model.getJointId(name)] for name in names]

    def set(self, q: Array) -> None:
        """Pinocchio's own q: a continuous joint is (cos, sin); what is off the chain rests."""
        full = pin.neutral(self.model)
        for joint, value in zip(self.joints, q, strict=True):
            both = (np.cos(value), np.sin(value)) if joint.nq == 2 else (value,)
            full[joint.idx_q : joint.idx_q + joint.nq] = both
        pin.computeJointJacobians(self.model, self.data, full)
        pin.updateFramePlacements(self.model, self.data)

    def fk(self, q: Array, frame: str | None = None) -> Array:
        self.set(q)
        tip = self.tip if frame is None else self.model.getFrameId(frame, pin.BODY)
        return (self.data.oMf[self.base].inverse() * self.data.oMf[tip]).homogeneous

    def jacobian(self, q: Array) -> Array:
        """Of the tip as one sees it who stands on the base, [linear; angular], axes of the base."""
        self.set(q)
        columns = [joint.idx_v for joint in self.joints]
        aligned = pin.LOCAL_WORLD_ALIGNED
        base, tip = (
            pin.getFrameJacobian(self.model, self.data, f, aligned).reshape(6, -1)[:, columns]
            for f in (self.base, self.tip)
        )
        between = self.data.oMf[self.tip].translation - self.data.oMf[self.base].translation
        R = self.data.oMf[self.base].rotation
        linear = tip[:3] - base[:3] - np.cross(base[3:], between, axis=0)
        return np.vstack([R.T @ linear, R.T @ (tip[3:] - base[3:])])


def read_by_pinocchio(text: str) -> pin.Model:
    return pin.buildModelFromXML(text)
