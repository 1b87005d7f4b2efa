"""The robots of the two theses, with the sources of their limits."""

from thing_kin._core.robots import pioneer_lx_ur5, thing, ur5, ur10

__all__ = ["pioneer_lx_ur5", "thing", "ur5", "ur10"]
