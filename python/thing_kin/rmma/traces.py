"""One run of the experiment, moment by moment, for drawing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from thing_kin.rmma.arrangement import Arrangement

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SearchTrace:
    """One search. Positions are in the side's frame, in which the base drives along +x.

    Parameters
    ----------
    fiducial : int
        Of the side, counted from 0.
    start, end : float, s
        Since the side's registration.
    hit : bool
    predicted : (2,), m
        Position of the base at the start, as the method foresaw it.
    covariance : (2, 2), m^2, or None
        Of that; None for a method without one.
    stop_times : (K,), s
        When the laser was read.
    stops : (K, 2), m
        Where the tool was then, the last one on the fiducial if it was hit.
    base_at_stops : (K, 3), m and rad
        True pose of the base then.
    position_error : float, m
        Observed minus predicted position of the base.

    Examples
    --------
    >>> from thing_kin import rmma
    >>> trace = rmma.trace(arrangement=2, method="spiral", velocity=0.02, rng=0)
    >>> search = trace.sides[0].searches[0]
    >>> search.stops.shape == (len(search.stop_times), 2)
    True
    """

    fiducial: int
    start: float
    end: float
    hit: bool
    predicted: FloatArray
    covariance: FloatArray | None
    stop_times: FloatArray
    stops: FloatArray
    base_at_stops: FloatArray
    position_error: float


@dataclass(frozen=True, eq=False)
class SideTrace:
    """One side of the artifact, driven along.

    Parameters
    ----------
    fiducials : (n, 2), m
        In the side's frame, the first one registered.
    rotation : float, rad
        0 or pi: map coordinates are the side's, turned by it.
    times : (m,), s
    base : (m, 3), m and rad
        True pose of the base at these times, in the side's frame.
    searches : tuple of SearchTrace

    Examples
    --------
    >>> from thing_kin import rmma
    >>> side = rmma.trace(arrangement=1, method="ukf", velocity=0.02, rng=0).sides[1]
    >>> side.to_map(side.fiducials)[0].round(2)
    array([3.09, 2.23])
    """

    fiducials: FloatArray
    rotation: float
    times: FloatArray
    base: FloatArray
    searches: tuple[SearchTrace, ...]

    def to_map(self, points: FloatArray) -> FloatArray:
        """Turn points (…, 2) of the side's frame into the map's.

        Examples
        --------
        >>> from thing_kin import rmma
        >>> side = rmma.trace(arrangement=1, method="ukf", velocity=0.02, rng=0).sides[0]
        >>> bool((side.to_map(side.fiducials) == side.fiducials).all())
        True
        """
        cosine, sine = round(np.cos(self.rotation), 15), round(np.sin(self.rotation), 15)
        turned: FloatArray = np.asarray(points) @ np.array([[cosine, sine], [-sine, cosine]])
        return turned


@dataclass(frozen=True, eq=False, repr=False)
class Trace:
    """One run, as `rmma.trace` records it; `viz.plot_rmma_run` draws it from above.

    Parameters
    ----------
    arrangement : Arrangement
    method : str
    velocity : float, m/s
    sides : tuple of SideTrace

    Examples
    --------
    >>> from thing_kin import rmma
    >>> trace = rmma.trace(arrangement=1, method="ukf", velocity=0.02, rng=0)
    >>> [len(side.fiducials) for side in trace.sides]
    [3, 6]
    """

    arrangement: Arrangement
    method: str
    velocity: float
    sides: tuple[SideTrace, ...]

    def __repr__(self) -> str:
        hits = sum(search.hit for side in self.sides for search in side.searches)
        tried = sum(len(side.searches) for side in self.sides)
        return f"<Trace: {self.title}, {hits} of {tried} searches hit>"

    @property
    def title(self) -> str:
        """Arrangement, method and velocity in words."""
        name = str(self.arrangement.name)
        where = name if "arrangement" in name else f"arrangement {name}"
        return f"{where}, {self.method}, {100 * self.velocity:g} cm/s"
