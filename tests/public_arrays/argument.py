"""One array argument of a public call, and what many calls share."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import thing_kin as tk
from thing_kin.kdl import KdlChain

ROBOT = tk.robots.thing()
ARM = tk.robots.ur5()
KDL = KdlChain(ARM)
FREE = tk.Chain.from_dh([tk.DH(a=0.1, joint="continuous") for _ in range(9)])
Q = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.3, -0.2, 0.4])
T = tk.transform(xyz=(0.5, -0.2, 0.3), rpy=(0.1, 0.2, 0.3))
XI = np.array([1.0, 2.0, 3.0, 0.1, 0.2, 0.3])
J = ROBOT.jacobian(Q)


@dataclass(frozen=True)
class Argument:
    """`call(value)` passes the value as the argument `name` and returns what came out of it."""

    label: str
    name: str
    good: Any
    call: Callable[[Any], Any] = field(repr=False)
    infinite: bool = False  # inf is a right answer, or a right value
    moderate: bool = False  # entries of any size: see test_huge_numbers.py

    @property
    def names(self) -> tuple[str, ...]:
        """What a message may begin with: where two arguments don't fit, either may be at fault."""
        pairs = {"lower": "upper", "upper": "lower", "J": "e"}
        pairs |= {"t": "wheel_angles", "t_reference": "poses", "poses": "t_reference"}
        pairs |= {"wheel_angles": "t", "wheel_speeds": "t"}
        pairs |= {"x": "P", "z": "H", "record": "H", "u": "B", "P": "truth"}
        return (self.name, pairs.get(self.name, self.name))
