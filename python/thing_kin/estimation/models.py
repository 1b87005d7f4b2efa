"""Built-in models of motion and of measurement: filters run them in the core, without Python."""

from thing_kin._estimation.models import (
    components,
    constant_acceleration,
    constant_twist,
    constant_velocity,
    omnidirectional,
    range_bearing,
)

__all__ = [
    "components",
    "constant_acceleration",
    "constant_twist",
    "constant_velocity",
    "omnidirectional",
    "range_bearing",
]
