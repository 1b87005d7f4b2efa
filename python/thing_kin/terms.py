"""What the objectives and constraints of a Problem are made of, with exact derivatives."""

from thing_kin._core.terms import (
    BaseDistance,
    BasePosition,
    Clearance,
    ConditionNumber,
    Dexterity,
    Function,
    JointCentering,
    Manipulability,
    Orientation,
    OrientationCone,
    Pose,
    Position,
    SeedDistance,
    Term,
)

__all__ = [
    "BaseDistance",
    "BasePosition",
    "Clearance",
    "ConditionNumber",
    "Dexterity",
    "Function",
    "JointCentering",
    "Manipulability",
    "Orientation",
    "OrientationCone",
    "Pose",
    "Position",
    "SeedDistance",
    "Term",
]
