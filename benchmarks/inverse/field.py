"""The robots of the race, their targets and seeds, and the checker: thing_kin's side of it."""

import sys
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin

import thing_kin as tk
from inverse import POSITION_TOLERANCE, ROTATION_TOLERANCE, Arm

sys.path.append(str(Path(__file__).parents[2] / "tests"))
from arms import gen3, iiwa14, panda

ROBOTS = {
    "ur10": ("UR10, 6 joints", tk.robots.ur10),
    "ur5": ("UR5, 6 joints", tk.robots.ur5),
    "panda": ("Panda, 7 joints", panda),
    "iiwa14": ("iiwa 14, 7 joints", iiwa14),
    "gen3": ("Gen3, 7 joints, 4 of them continuous", gen3),
    # The base first: the order in which every peer counts joints from the root.
    "thing": ("The Thing, 9 joints", lambda: tk.robots.thing(order="base_first")),
}
LIMIT_SLACK = 1e-6  # rad or m: what a quadratic program may leave
WARM_UP = 3


@dataclass
class Course:
    """One robot, its targets on disk, and who judges the answers."""

    arm: Arm
    file: Path
    targets: Any
    judge: "Judge"

    @property
    def entry(self) -> tuple[dict[str, Any], str]:
        return asdict(self.arm), str(self.file)


class Judge:
    """Pinocchio on the URDF: neither thing_kin's kinematics nor the solver's."""

    def __init__(self, arm: Arm) -> None:
        self.arm = arm
        self.model = pin.buildModelFromUrdf(arm.urdf)
        self.data = self.model.createData()
        self.tip = self.model.getFrameId(arm.tip)
        self.lower, self.upper = np.array(arm.lower), np.array(arm.upper)
        self.joints = [self.model.joints[self.model.getJointId(name)] for name in arm.joints]

    def fk(self, q: Any) -> Any:
        full = np.zeros(self.model.nq)
        for joint, value in zip(self.joints, q, strict=True):
            if joint.nq == 2:  # continuous
                full[joint.idx_q : joint.idx_q + 2] = np.cos(value), np.sin(value)
            else:
                full[joint.idx_q] = value
        pin.forwardKinematics(self.model, self.data, full)
        return pin.updateFramePlacement(self.model, self.data, self.tip)

    def is_right(self, q: Any, T: Any) -> bool:
        """Whether the pose is reached and the limits are kept; None is no answer."""
        if q is None or not np.all(np.isfinite(q)):
            return False
        q = np.asarray(q)
        if np.any(q < self.lower - LIMIT_SLACK) or np.any(q > self.upper + LIMIT_SLACK):
            return False
        found, goal = self.fk(q), pin.SE3(T)
        position = np.linalg.norm(found.translation - goal.translation)
        rotation = np.linalg.norm(pin.log3(found.rotation.T @ goal.rotation))
        return bool(position <= POSITION_TOLERANCE and rotation <= ROTATION_TOLERANCE)


def course(name: str, count: int, directory: Path) -> Course:
    """Poses of random configurations, hence reachable; seeds drawn apart from them."""
    title, make = ROBOTS[name]
    chain = make()
    urdf, file = directory / f"{name}.urdf", directory / f"{name}.npz"
    urdf.write_text(chain.to_urdf())
    limits = chain.lower.tolist(), chain.upper.tolist()
    ends = chain.frames[0], chain.frames[-1]
    arm = Arm(name, title, str(urdf), *ends, list(chain.names), list(chain.joint_types), *limits)
    targets = chain.fk(chain.random(count + WARM_UP, rng=0))
    np.savez(file, targets=targets, seeds=chain.random(count + WARM_UP, rng=1))
    return Course(arm, file, targets[:count], Judge(arm))


def courses(names: list[str], count: int, directory: Path) -> Iterator[Course]:
    for name in names:
        yield course(name, count, directory)
