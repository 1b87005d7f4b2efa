"""The KDL back end: the same chain, computed by orocos KDL."""

try:
    from thing_kin._kdl import KdlChain
except ImportError as error:  # a wheel for machines without KDL
    raise ImportError(
        "thing_kin was built without KDL, or liborocos-kdl is missing; on Debian install "
        "liborocos-kdl-dev, then build with -DTHING_KIN_KDL=ON (the default)"
    ) from error

__all__ = ["KdlChain"]
