"""What objectives and constraints of a Problem are made of."""

from thing_kin._core.terms import (
    Function,
    Term,
)

__all__ = [
    "Function",
    "Term",
]
