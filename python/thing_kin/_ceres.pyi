"""
The minimizers that use Ceres. Private: use thing_kin.sqp.
"""
from __future__ import annotations
import thing_kin._core
__all__: list[str] = ['minimizer']
def minimizer(name: str) -> thing_kin._core._ConvexMinimizer:
    """
    See thing_kin.sqp.
    """
