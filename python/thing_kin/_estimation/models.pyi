"""
Built-in models, which run in the core.
"""
from __future__ import annotations
import collections.abc
import numpy.typing
import thing_kin._estimation
import typing
__all__: list[str] = ['components', 'constant_acceleration', 'constant_twist', 'constant_velocity', 'omnidirectional', 'range_bearing']
def components(indices: collections.abc.Sequence[int], *, angles: collections.abc.Sequence[int] = ()) -> thing_kin._estimation.MeasurementModel:
    """
    Entries of the state as they are.
    
    Parameters
    ----------
    indices : sequence of int
        Which, in the order of the measurement.
    angles : sequence of int
        Which entries of the measurement are angles.
    
    Returns
    -------
    MeasurementModel
    
    Raises
    ------
    ValueError
        If there is no index or one is out of range.
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> pose = est.models.components((0, 1, 2), angles=(2,))
    >>> pose([1.0, 2.0, 3.0, 0.5])
    array([1., 2., 3.])
    """
def constant_acceleration(dimension: typing.SupportsInt | typing.SupportsIndex = 2, *, noise: numpy.typing.ArrayLike = 1.0) -> thing_kin._estimation.MotionModel:
    """
    Positions, velocities, accelerations of one to three axes: x + v dt + a dt^2/2.
    
    Parameters
    ----------
    dimension : int
    noise : float, m^2/s^5
        Spectral density of a white jerk: the process noise where a filter is given no Q.
    
    Returns
    -------
    MotionModel
    
    Raises
    ------
    ValueError
        If an argument is out of range.
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> est.models.constant_acceleration(1)([0.0, 0.0, 2.0], 1.0)
    array([1., 2., 2.])
    """
def constant_twist(*, noise: numpy.typing.ArrayLike = 1.0) -> thing_kin._estimation.MotionModel:
    """
    A planar pose and its body twist, held: the pose moves by exp(twist dt), exact on SE(2).
    
    State (x, y, theta, vx, vy, omega), theta an angle; [M17] (3.20), integrated without error.
    
    Parameters
    ----------
    noise : float or (3,)
        Spectral densities of white accelerations along and about the body's axes, (m/s^2)^2 s twice and
        (rad/s^2)^2 s: the process noise where a filter is given no Q.
    
    Returns
    -------
    MotionModel
    
    Raises
    ------
    ValueError
        If noise is negative or not finite.
    
    Examples
    --------
    >>> import numpy as np
    >>> from thing_kin import estimation as est
    >>> quarter = est.models.constant_twist()([0, 0, 0, np.pi / 2, 0, np.pi / 2], 1.0)
    >>> quarter[:3].round(6)
    array([1.      , 1.      , 1.570796])
    """
def constant_velocity(dimension: typing.SupportsInt | typing.SupportsIndex = 2, *, noise: numpy.typing.ArrayLike = 1.0) -> thing_kin._estimation.MotionModel:
    """
    Positions, then velocities, of one to three axes: x + v dt.
    
    Parameters
    ----------
    dimension : int
    noise : float, m^2/s^3
        Spectral density of a white acceleration: the process noise where a filter is given no Q.
    
    Returns
    -------
    MotionModel
    
    Raises
    ------
    ValueError
        If an argument is out of range.
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> est.models.constant_velocity(2).variables
    ('x', 'y', 'vx', 'vy')
    """
def omnidirectional(*, noise: numpy.typing.ArrayLike | None = None) -> thing_kin._estimation.MotionModel:
    """
    The planar mode of robot_localization: pose, body velocities and accelerations.
    
    State (x, y, theta, vx, vy, omega, ax, ay), theta an angle. The position moves along the heading at
    the beginning of the step, as there; constant_twist turns on the way.
    
    Parameters
    ----------
    noise : float or (8,), optional
        Variance that each variable gains per second. Default: that of robot_localization.
    
    Returns
    -------
    MotionModel
    
    Raises
    ------
    ValueError
        If noise is negative or not finite.
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> est.models.omnidirectional().angles
    (2,)
    """
def range_bearing(landmark: numpy.typing.ArrayLike) -> thing_kin._estimation.MeasurementModel:
    """
    Distance and bearing of a landmark from a planar pose, the state's first three entries.
    
    Parameters
    ----------
    landmark : (2,), m
    
    Returns
    -------
    MeasurementModel
        Of (distance, bearing) in m and rad; the bearing is an angle, zero straight ahead.
    
    Raises
    ------
    ValueError
        If landmark is not two finite numbers.
    
    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> est.models.range_bearing((1.0, 0.0)).angles
    (1,)
    """
