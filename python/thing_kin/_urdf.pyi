"""
The URDF reader. Private: use thing_kin.Chain.from_urdf.
"""
from __future__ import annotations
import collections.abc
import os
import thing_kin._core
import typing
__all__: list[str] = ['from_urdf']
def from_urdf(source: str | bytes | os.PathLike[str], base: str | None, tip: str | None, packages: collections.abc.Mapping[str, str | os.PathLike[str]] | None, name: str | None) -> thing_kin._core.Chain:
    """
    See thing_kin.Chain.from_urdf.
    """
