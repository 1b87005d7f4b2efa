"""
What problems are made of.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import thing_kin._core
import typing
__all__: list[str] = ['BaseDistance', 'BasePosition', 'Clearance', 'ConditionNumber', 'Dexterity', 'Function', 'JointCentering', 'Manipulability', 'Orientation', 'OrientationCone', 'Pose', 'Position', 'SeedDistance', 'Term']
class Term:
    """
    What objectives and constraints are made of: the base of all terms.
    
    A term is a vector function of the configuration with exact first and second derivatives. It is
    made without a robot; a Problem binds it to its own. Immutable.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> isinstance(tk.terms.Dexterity(), tk.terms.Term)
    True
    """
    def evaluate(self, robot: thing_kin._core.Chain | None, q: numpy.typing.ArrayLike) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
        """
        The term's numbers and their derivatives.
        
        Parameters
        ----------
        robot : Chain or None
            None for a term of a problem without a robot.
        q : (n,) or (N, n), rad and m
        
        Returns
        -------
        value : (m,) or (N, m)
        jacobian : (m, n) or (N, m, n)
            d value/dq.
        
        Raises
        ------
        ValueError
            If the term does not fit the robot, a shape is wrong, or the term or its derivative does not
            exist at q, as a condition number at a singular posture.
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> robot = tk.robots.thing()
        >>> value, J = tk.terms.BaseDistance((3.0, 4.0)).evaluate(robot, np.zeros(9))
        >>> value, J[0, 6:8]
        (array([5.]), array([-0.6, -0.8]))
        """
    def hessian(self, robot: thing_kin._core.Chain | None, q: numpy.typing.ArrayLike, weights: numpy.typing.ArrayLike | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        The second derivative of a weighted sum of the term's numbers.
        
        Parameters
        ----------
        robot : Chain or None
        q : (n,) or (N, n), rad and m
        weights : (m,), optional
            Of each number; default: ones.
        
        Returns
        -------
        (n, n) or (N, n, n)
            sum_i weights_i d^2 value_i/dq^2, symmetric.
        
        Raises
        ------
        ValueError
            As evaluate().
        
        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> tk.terms.SeedDistance([0.0, 0.0]).hessian(None, [3.0, 4.0])
        array([[2., 0.],
               [0., 2.]])
        """
    @property
    def name(self) -> str:
        """
        For messages and traces: 'pose'.
        """
class Pose(Term):
    """
    Where a frame should be: six numbers, zero there.
    
    [p_goal - p; log(R_goal R^T)], axes of the world, as tk.pose_error: [M17] (4.26)-(4.28) with the
    signs put right. At half a turn the logarithm jumps to the opposite axis.
    
    Parameters
    ----------
    target : (4, 4)
    frame : str, optional
        Default: the tool.
    
    Raises
    ------
    ValueError
        If the target is no rigid transform.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.ur5()
    >>> term = tk.terms.Pose(robot.fk(np.ones(6)))
    >>> value, J = term.evaluate(robot, np.ones(6))
    >>> np.allclose(value, 0.0), np.allclose(J, -robot.jacobian(np.ones(6)))
    (True, True)
    """
    def __init__(self, target: numpy.typing.ArrayLike, *, frame: str | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def frame(self) -> str | None:
        """
        None: the tool.
        """
    @property
    def target(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        The pose, (4, 4).
        """
class Position(Term):
    """
    Where a point of a frame should be: p_goal - p, m.
    
    Parameters
    ----------
    target : (3,), m
        In the world.
    frame : str, optional
        Default: the tool.
    point : (3,), m, optional
        Coordinates in the frame; default: its origin.
    
    Raises
    ------
    ValueError
        If a shape is wrong or a number not finite.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.ur5()
    >>> value, _ = tk.terms.Position((0, 0, 1), frame="shoulder").evaluate(robot, np.zeros(6))
    >>> value
    array([0.      , 0.      , 0.910841])
    """
    def __init__(self, target: numpy.typing.ArrayLike, *, frame: str | None = None, point: numpy.typing.ArrayLike | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def frame(self) -> str | None:
        """
        None: the tool.
        """
    @property
    def point(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        In the frame, (3,), m.
        """
    @property
    def target(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        In the world, (3,), m.
        """
class Orientation(Term):
    """
    How a frame should be turned: log(R_goal R^T), rad.
    
    Parameters
    ----------
    target : (3, 3)
    frame : str, optional
        Default: the tool.
    
    Raises
    ------
    ValueError
        If the target is no rotation.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> value, _ = tk.terms.Orientation(np.eye(3)).evaluate(tk.robots.ur5(), np.zeros(6))
    >>> value.round(6)
    array([-1.570796,  0.      ,  0.      ])
    """
    def __init__(self, target: numpy.typing.ArrayLike, *, frame: str | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def frame(self) -> str | None:
        """
        None: the tool.
        """
    @property
    def target(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        The rotation, (3, 3).
        """
class OrientationCone(Term):
    """
    The angle between an axis of a frame and a direction, rad, 0 to pi.
    
    For problem.at_most(tk.terms.OrientationCone(...), angle): a glass held upright, a camera that
    looks down. The angle has tips at 0 and pi, where no derivative exists: at 0 zeros are given, at pi
    a derivative that leads away. So ask for at most some angle; where the axis must meet the direction
    exactly, ask for an Orientation.
    
    Parameters
    ----------
    axis : (3,)
        In the frame, of any length but zero.
    direction : (3,)
        In the world.
    frame : str, optional
        Default: the tool.
    
    Raises
    ------
    ValueError
        If axis or direction is zero or not finite.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> term = tk.terms.OrientationCone(axis=(0, 0, 1), direction=(0, 0, -1))
    >>> term.evaluate(tk.robots.ur5(), np.zeros(6))[0].round(4)
    array([1.5708])
    """
    def __init__(self, axis: numpy.typing.ArrayLike, direction: numpy.typing.ArrayLike, *, frame: str | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def axis(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        In the frame, of unit length.
        """
    @property
    def direction(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        In the world, of unit length.
        """
    @property
    def frame(self) -> str | None:
        """
        None: the tool.
        """
class BaseDistance(Term):
    """
    How far the base is from a point of the plane, m, [M17] (4.29).
    
    At most a radius around a goal, at least one around an obstacle. Of the base's reference point, the
    origin of its frame. At the center itself, where no derivative exists, that along x is given, so
    that there is a way out.
    
    Parameters
    ----------
    center : (2,), m
    
    Raises
    ------
    ValueError
        If the shape is wrong or a number not finite; bound to a robot without a base.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> tk.terms.BaseDistance((0.6, 0.8)).evaluate(tk.robots.thing(), np.zeros(9))[0]
    array([1.])
    """
    def __init__(self, center: numpy.typing.ArrayLike) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def center(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (x, y), m.
        """
class BasePosition(Term):
    """
    Where the base should be: target - (x, y), m; zero there.
    
    Parameters
    ----------
    target : (2,), m
    
    Raises
    ------
    ValueError
        If the shape is wrong or a number not finite; bound to a robot without a base.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> tk.terms.BasePosition((0.6, 0.8)).evaluate(tk.robots.thing(), np.zeros(9))[0]
    array([0.6, 0.8])
    """
    def __init__(self, target: numpy.typing.ArrayLike) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def target(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (x, y), m.
        """
class Clearance(Term):
    """
    How far the robot is from obstacles and from itself, m.
    
    Obstacle by obstacle: of each sphere of the robot, or of the base's reference point if the obstacle
    is a Disc. Then of each pair of spheres from each other. Negative where they overlap; for
    problem.at_least(tk.terms.Clearance(...), 0.02).
    
    Parameters
    ----------
    spheres : LinkSpheres, optional
        The robot's shape; without it, Discs are all it can meet.
    obstacles : sequence of Disc, Sphere, Capsule, Box and HalfSpace
    self_collision : bool
        Whether the pairs of `spheres` count.
    
    Raises
    ------
    ValueError
        If an obstacle is none, or there are no spheres to meet it; bound to a robot without the
        spheres' frames, or without a base for a Disc.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> shape = tk.LinkSpheres(robot, [("tool", (0, 0, 0), 0.1)])
    >>> term = tk.terms.Clearance(shape, [tk.HalfSpace((0, 0, 1), offset=0.0), tk.Disc((1, 0), 0.4)])
    >>> term.rows(robot)
    ['sphere 0 (tool) and obstacle 0', 'the base and obstacle 1']
    >>> term.evaluate(robot, np.zeros(9))[0].round(4)
    array([0.5646, 0.6   ])
    """
    def __init__(self, spheres: thing_kin._core.LinkSpheres | None = None, obstacles: collections.abc.Sequence[thing_kin._core.Disc | thing_kin._core.Sphere | thing_kin._core.Capsule | thing_kin._core.Box | thing_kin._core.HalfSpace] = (), self_collision: bool = True) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def rows(self, robot: thing_kin._core.Chain) -> list[str]:
        """
        What each number is the clearance of, in words.
        
        Parameters
        ----------
        robot : Chain
        
        Returns
        -------
        list of str
        
        Examples
        --------
        >>> import thing_kin as tk
        >>> term = tk.terms.Clearance(obstacles=[tk.Disc((1, 0), 0.4)])
        >>> term.rows(tk.robots.thing())
        ['the base and obstacle 0']
        """
class Manipulability(Term):
    """
    Manipulability M = sqrt(det(J J^T)), [M17] (4.30).
    
    For problem.at_least(tk.terms.Manipulability(), 0.05). Where the rank is lost it is 0, and so are
    the derivatives given.
    
    Parameters
    ----------
    jacobian : 'whole_body', 'arm' or (n,)
        Whose columns count: all; all but the base's; or all, each times its joint's weight, 0 to 1e6,
        of which at least six are not zero. The whole body's is blind to singularities of the arm: the
        base's columns fill the lost direction.
    frame : str, optional
        Default: the tool.
    
    Raises
    ------
    ValueError
        If a weight is out of range; bound to a robot with fewer than six joints that count.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.ur5()
    >>> value, J = tk.terms.Manipulability().evaluate(robot, np.ones(6))
    >>> np.allclose(value, robot.manipulability(np.ones(6)))
    True
    """
    def __init__(self, *, jacobian: str | numpy.typing.ArrayLike = 'whole_body', frame: str | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def frame(self) -> str | None:
        """
        None: the tool.
        """
    @property
    def jacobian(self) -> typing.Any:
        """
        'whole_body', 'arm' or the weights of the joints.
        """
class ConditionNumber(Term):
    """
    Condition number kappa = sigma_max/sigma_min, [M17] (4.32).
    
    At a singular posture it does not exist; where the largest or the smallest singular value is not
    simple, its derivative is that of a function next to it.
    
    Parameters
    ----------
    jacobian : 'whole_body', 'arm' or (n,)
        As for Manipulability.
    frame : str, optional
        Default: the tool.
    
    Raises
    ------
    ValueError
        As for Manipulability.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.ur5()
    >>> value, J = tk.terms.ConditionNumber().evaluate(robot, np.ones(6))
    >>> np.allclose(value, robot.condition_number(np.ones(6)))
    True
    """
    def __init__(self, *, jacobian: str | numpy.typing.ArrayLike = 'whole_body', frame: str | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def frame(self) -> str | None:
        """
        None: the tool.
        """
    @property
    def jacobian(self) -> typing.Any:
        """
        'whole_body', 'arm' or the weights of the joints.
        """
class Dexterity(Term):
    """
    sqrt(kappa/M), [M17] (4.33): small where the hand moves well.
    
    The objective of the planning scheme (4.34). At a singular posture it does not exist.
    
    Parameters
    ----------
    jacobian : 'whole_body', 'arm' or (n,)
        As for Manipulability.
    frame : str, optional
        Default: the tool.
    
    Raises
    ------
    ValueError
        As for Manipulability.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> q = np.array([0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0])
    >>> whole = tk.terms.Dexterity().evaluate(robot, q)[0]
    >>> np.allclose(whole, robot.dexterity(q))
    True
    >>> bool(tk.terms.Dexterity(jacobian="arm").evaluate(robot, q)[0] > whole)
    True
    """
    def __init__(self, *, jacobian: str | numpy.typing.ArrayLike = 'whole_body', frame: str | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def frame(self) -> str | None:
        """
        None: the tool.
        """
    @property
    def jacobian(self) -> typing.Any:
        """
        'whole_body', 'arm' or the weights of the joints.
        """
class SeedDistance(Term):
    """
    sum_i w_i (q_i - seed_i)^2, [M17] (4.25).
    
    Continuous joints go the shorter way round. Serves problems without a robot too.
    
    Parameters
    ----------
    seed : (n,), rad and m
    weights : float or (n,), optional
        At least 0; default: 1.
    
    Raises
    ------
    ValueError
        If a weight is negative, the shapes differ, or a number is not finite.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.terms.SeedDistance([1.0, 2.0], weights=[1.0, 10.0]).evaluate(None, [1.0, 2.5])[0]
    array([2.5])
    """
    def __init__(self, seed: numpy.typing.ArrayLike, weights: numpy.typing.ArrayLike | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def seed(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,), rad and m.
        """
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,).
        """
class JointCentering(Term):
    """
    sum_i ((q_i - middle_i)/range_i)^2 over joints with two limits.
    
    A joint at one of its limits adds 1/4.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.ur5()
    >>> tk.terms.JointCentering().evaluate(robot, robot.upper)[0]
    array([1.5])
    """
    def __init__(self) -> None:
        ...
    def __repr__(self) -> str:
        ...
class Function(Term):
    """
    A term of your own.
    
    Parameters
    ----------
    value : callable
        value(x) -> (size,), or a number if size is 1. None says that it does not exist at x: a step that
        leads there is not taken. NaN is an error, as is a wrong shape.
    jacobian : callable
        jacobian(x) -> (size, n), d value / dx, or (n,) if size is 1. See check_derivatives.
    hessian : callable, optional
        hessian(x) -> (size, n, n), or (n, n) if size is 1. Default: central differences of the Jacobian,
        2 n calls each time.
    size : int
        How many numbers it gives.
    n : int, optional
        How many variables it takes; default: as many as the problem has.
    name : str
        For messages.
    
    Raises
    ------
    ValueError
        If an argument is no function or a size is below 1; later, naming the function, if it returns
        what it should not. What a function raises ends the solver and is raised there.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> circle = tk.terms.Function(
    ...     lambda x: x @ x, lambda x: 2 * x, lambda x: 2 * np.eye(2), name="circle")
    >>> problem = tk.Problem(n=2)
    >>> problem.minimize(tk.terms.Function(lambda x: x[0] + x[1], lambda x: [1.0, 1.0]))
    >>> problem.at_most(circle, 2.0)
    >>> tk.sqp(problem, (0.5, -0.5)).x.round(6)
    array([-1., -1.])
    """
    def __init__(self, value: typing.Any, jacobian: typing.Any, hessian: typing.Any = None, *, size: typing.SupportsInt | typing.SupportsIndex = 1, n: typing.SupportsInt | typing.SupportsIndex | None = None, name: str = 'function') -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def size(self) -> int:
        """
        How many numbers it gives.
        """
