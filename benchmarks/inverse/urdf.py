"""The joints of an arm's URDF, for solvers that read none: what `Chain.to_urdf` writes."""

from typing import Any, NamedTuple
from xml.etree import ElementTree

import numpy as np

from inverse import Arm


class Joint(NamedTuple):
    before: Any  # (4, 4), constant, from the last joint's frame (or the root)
    slides: bool  # along its z axis; else it turns about it


def numbers(element: Any, key: str) -> Any:
    return np.array([float(x) for x in element.get(key).split()])


def rotation_to(axis: Any) -> Any:
    """The rotation that turns z into one of the axes +-x, +-y, +-z."""
    other = np.eye(3)[np.argmin(np.abs(axis))]
    return np.stack([np.cross(other, axis), np.cross(axis, np.cross(other, axis)), axis], axis=1)


def pose(xyz: Any, R: Any) -> Any:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, xyz
    return T


def rpy(angles: Any) -> Any:
    """Fixed-axis roll, pitch, yaw; right angles give exact zeros and ones."""
    (cr, cp, cy), (sr, sp, sy) = np.round([np.cos(angles), np.sin(angles)], 15)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def path(arm: Arm) -> list[Any]:
    """Elements of the joints from the base to the tip."""
    by_child = {
        joint.find("child").get("link"): joint  # type: ignore[union-attr]
        for joint in ElementTree.parse(arm.urdf).getroot().findall("joint")
    }
    found: list[Any] = []
    link = arm.tip
    while link != arm.base:
        found.append(by_child[link])
        link = found[-1].find("parent").get("link")
    return found[::-1]


def joints(arm: Arm) -> tuple[list[Joint], Any]:
    """Moving joints, fixed ones folded away, and the tool in the last joint's frame."""
    result: list[Joint] = []
    before = np.eye(4)
    for element in path(arm):
        origin = element.find("origin")
        before = before @ pose(numbers(origin, "xyz"), rpy(numbers(origin, "rpy")))
        if element.get("type") != "fixed":
            turned = pose(np.zeros(3), rotation_to(numbers(element.find("axis"), "xyz")))
            result.append(Joint(before @ turned, element.get("type") == "prismatic"))
            before = turned.T
    return result, before
