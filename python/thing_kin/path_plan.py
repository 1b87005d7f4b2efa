"""A path of the whole body, waypoint by waypoint."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from thing_kin import Chain
    from thing_kin.trajectory import Trajectory


@dataclass(frozen=True)
class PathPlan:
    """What plan_path found: a configuration for each waypoint, checked once more at the end.

    `success` is the word of that check, not of the solver: poses by forward kinematics, every
    constraint at every waypoint, obstacles on the straight lines in joint space between them.

    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> arm = tk.robots.ur10()
    >>> q = np.array([0.0, -1.0, 1.2, -0.5, 1.0, 0.0])
    >>> path = tk.plan_path(arm, arm.fk(np.stack([q, q + 0.02])), seed=q)
    >>> path.success, path.q.shape, len(path)
    (True, (2, 6), 2)
    """

    robot: Chain = field(repr=False)
    q: NDArray[np.float64] = field(repr=False)  #: (N, n), rad and m
    position_error: NDArray[np.float64] = field(repr=False)  #: (N,), m
    rotation_error: NDArray[np.float64] = field(repr=False)  #: (N,), rad
    success: bool
    status: str  #: "converged", "infeasible" or "budget"
    message: str
    failed_waypoint: int | None  #: the first that can't be followed
    failed_constraint: str | None  #: what fails there
    objective: float
    dexterity: NDArray[np.float64] = field(repr=False)  #: (N,), sqrt(kappa/M), (4.33)
    constraint_violation: float  #: the largest, m or rad
    iterations: int
    time: float  #: s

    def __len__(self) -> int:
        """How many waypoints."""
        return len(self.q)

    def timed(self, **kwargs: Any) -> Trajectory:
        """Give the path time; see thing_kin.trajectory.timed.

        Parameters
        ----------
        **kwargs
            As thing_kin.trajectory.timed takes them.

        Returns
        -------
        Trajectory

        Raises
        ------
        ValueError
            If the path was not a success.

        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> arm = tk.robots.ur10()
        >>> q = np.array([0.0, -1.0, 1.2, -0.5, 1.0, 0.0])
        >>> path = tk.plan_path(arm, arm.fk(np.stack([q, q + 0.1, q + 0.2])), seed=q)
        >>> bool(path.timed().duration > 0.0)
        True
        """
        from thing_kin.trajectory import timed

        return timed(self, **kwargs)
