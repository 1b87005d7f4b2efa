"""
The KDL back end. Private: use thing_kin.kdl.
"""
from __future__ import annotations
import numpy
import numpy.typing
import thing_kin._core
import typing
__all__: list[str] = ['KdlChain', 'ik']
class KdlChain:
    """
    A chain as KDL sees it, computed by KDL's own solvers.
    
    For users who come from KDL, and as an independent check. Conventions are thing_kin's.
    
    Parameters
    ----------
    chain : Chain
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> from thing_kin.kdl import KdlChain
    >>> robot = tk.robots.thing()
    >>> q = robot.random(rng=0)
    >>> np.allclose(KdlChain(robot).fk(q), robot.fk(q))
    True
    """
    def __init__(self, chain: thing_kin._core.Chain) -> None:
        ...
    def fk(self, q: numpy.typing.ArrayLike, frame: str = '') -> numpy.typing.NDArray[numpy.float64]:
        """
        Pose of a frame by ChainFkSolverPos_recursive.
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        frame : str
            Default: the last, the tool.
        
        Returns
        -------
        (4, 4) or (N, 4, 4)
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> from thing_kin.kdl import KdlChain
        >>> KdlChain(tk.robots.ur5()).fk(np.zeros(6)).shape
        (4, 4)
        """
    def jacobian(self, q: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Jacobian of the tool by ChainJntToJacSolver, axes of the world, [linear; angular].
        
        Parameters
        ----------
        q : (n,) or (N, n), rad and m
        
        Returns
        -------
        (6, n) or (N, 6, n)
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> from thing_kin.kdl import KdlChain
        >>> KdlChain(tk.robots.ur5()).jacobian(np.zeros(6)).shape
        (6, 6)
        """
def ik(chain: thing_kin._core.Chain, target: numpy.typing.ArrayLike, seed: numpy.typing.ArrayLike | None = None, *, position_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-07, rotation_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-06, max_iterations: typing.SupportsInt | typing.SupportsIndex = 10000, max_restarts: typing.SupportsInt | typing.SupportsIndex = 100, deadline: typing.SupportsFloat | typing.SupportsIndex | None = None, rng: typing.SupportsInt | typing.SupportsIndex = 0, threads: typing.SupportsIndex | None = None) -> typing.Any:
    """
    See thing_kin.kdl.ik, which reads rng.
    """
