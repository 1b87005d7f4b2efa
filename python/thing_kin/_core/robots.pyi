"""
The robots of the two theses.
"""
from __future__ import annotations
import collections.abc
import os
import thing_kin._core
import typing
__all__: list[str] = ['pioneer_lx_ur5', 'thing', 'ur10', 'ur5']
def pioneer_lx_ur5(mount: typing.Any = None, *, order: str = 'arm_first', base_limits: typing.Any = None) -> thing_kin._core.Chain:
    """
    Pioneer LX + UR5, the robot of [X21], on a virtual omnidirectional base.
    
    The real base has two driven wheels: it turns on the spot but cannot move sideways. A path for it
    must keep the base's velocity along its heading; this model does not.
    
    Base rates: 1.8 m/s, 0.5 m/s^2, 180 deg/s, 150 deg/s^2 (ARIA, params/pioneer-lx.p); sideways the
    same, which is ours, as is the base's range. Arm limits: see ur5.
    
    Parameters
    ----------
    mount : (4, 4), optional
        Pose of the arm's root in the base frame. No source states it: the default, ours, is the middle
        of the deck, (0.075, 0, 0.448) m, not turned (deck from the maker's URDF, amr-ros-config).
    order, base_limits
        As for thing.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> tk.robots.pioneer_lx_ur5().fk(np.zeros(9), frame="mount")[:3, 3]
    array([0.075, 0.   , 0.448])
    """
def thing(*, order: str = 'arm_first', base_limits: typing.Any = None) -> thing_kin._core.Chain:
    """
    The Thing: Clearpath Ridgeback + UR10, [M17] Table A.1.
    
    Base rates: 1.1 m/s, 2.5 m/s^2, 2 rad/s, 1 rad/s^2 (Clearpath's ridgeback_control,
    config/control.yaml; 1.1 m/s also in the user manual). The base's range is ours: a base has none.
    Arm limits: see ur10.
    
    Parameters
    ----------
    order : 'arm_first' or 'base_first'
        q = [q0 ... q5, x, y, theta], [M17] (3.6), or [x, y, theta, q0 ... q5].
    base_limits : three pairs (lower, upper), optional
        Of x (m), y (m), theta (rad); default +-5 m and +-pi.
    
    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> robot = tk.robots.thing()
    >>> robot.names
    ('q0', 'q1', 'q2', 'q3', 'q4', 'q5', 'x', 'y', 'theta')
    >>> robot.fk(np.zeros(9))[:3, 3]
    array([ 0.526141, -1.1743  ,  0.6646  ])
    """
def ur10(calibration: str | os.PathLike[str] | collections.abc.Mapping[str, typing.Any] | None = None) -> thing_kin._core.Chain:
    """
    Universal Robots UR10 (CB3), the arm of [M17].
    
    Limits: +-2 pi for every joint, 120 deg/s for base and shoulder, 180 deg/s for the others (UR10/CB3
    user manual 3.13, as in the maker's Universal_Robots_ROS2_Description,
    config/ur10/joint_limits.yaml; [M17] Table 2.1). 5 rad/s^2 as in the maker's ur_moveit_config.
    
    Parameters
    ----------
    calibration : path or mapping, optional
        As for ur5.
    
    Raises
    ------
    ValueError
        As for ur5.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.robots.ur10().velocity_limits.round(3)
    array([2.094, 2.094, 3.142, 3.142, 3.142, 3.142])
    """
def ur5(calibration: str | os.PathLike[str] | collections.abc.Mapping[str, typing.Any] | None = None) -> thing_kin._core.Chain:
    """
    Universal Robots UR5 (CB3), the arm of [X21].
    
    Limits: +-2 pi and 180 deg/s for every joint (UR5/CB3 user manual 3.13, as in the maker's
    Universal_Robots_ROS2_Description, config/ur5/joint_limits.yaml, which halves the elbow's range for
    one planner's sake; this model does not). The maker states no joint acceleration: 5 rad/s^2 is what
    its driver's ur_moveit_config uses.
    
    Parameters
    ----------
    calibration : path or mapping, optional
        The arm as measured in the factory: the YAML that the maker's ur_robot_driver extracts
        (ur_calibration), which needs the extra `yaml`, or a mapping of the same shape, {'kinematics':
        {'shoulder': {'x': ..., 'y', 'z', 'roll', 'pitch', 'yaw'}, 'upper_arm', 'forearm', 'wrist_1',
        'wrist_2', 'wrist_3'}}; m and rad. Joints, limits and frames stay, the frames where their axes
        are measured to be. Default: the maker's nominal dimensions.
    
    Raises
    ------
    ValueError
        If the calibration cannot be read, a key is missing or unknown, or a number is out of range.
    
    Examples
    --------
    >>> import thing_kin as tk
    >>> tk.robots.ur5().n
    6
    """
