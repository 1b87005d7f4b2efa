"""Settings of ROS's robot_localization, read for a BaseLocalizer."""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from thing_kin._estimation import BaseLocalizer

__all__ = ["RobotLocalization", "RosSource", "read_robot_localization"]

# The fifteen variables of robot_localization, and those of a planar base among them.
VARIABLES = (
    *("x", "y", "z", "roll", "pitch", "yaw", "vx", "vy", "vz", "vroll", "vpitch", "vyaw"),
    *("ax", "ay", "az"),
)
PLANAR = {"x": "x", "y": "y", "yaw": "theta", "vx": "vx", "vy": "vy", "vyaw": "omega"}
POSE_ROWS = [0, 1, 5]
SOURCE = re.compile(r"^(odom|pose|twist|imu)(\d+)(?:_(\w+))?$")
# What concerns messages, frames and schedules of ROS, or is kept as it is.
PLUMBING = re.compile(
    r"^(use_sim_time|two_d_mode|frequency|sensor_timeout|print_diagnostics|debug|debug_out_file"
    r"|publish_\w+|\w+_frame|transform_\w+|predict_to_current_time|permit_corrected_publication"
    r"|smooth_lagged_data|history_length|initial_state|initial_estimate_covariance"
    r"|process_noise_covariance|reset_on_time_jump|disabled_at_startup)$"
)
SOURCE_PLUMBING = ("queue_size", "nodelay", "config", "differential", "relative")
THRESHOLDS = ("pose_rejection_threshold", "twist_rejection_threshold")
FALSE_IS_NOTHING = ("use_control", "dynamic_process_noise_covariance")


@dataclass(frozen=True)
class RosSource:
    """A sensor of a robot_localization file, or its poses or twists where it has both.

    Parameters
    ----------
    name : str
        What to give as `source=`: as in the file, with `_pose` or `_twist` where it has both.
    topic : str
    fuse : tuple of str
        Variables that count.
    gate : float, optional
        The rejection threshold as a probability; None: the localizer's.
    differential : bool
        Its poses count as motions from one to the next: give them to `add_relative_pose`.
    relative : bool
        Its poses count from where the first one was.

    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> est.RosSource("imu0", "/imu", ("omega",)).gate is None
    True
    """

    name: str
    topic: str
    fuse: tuple[str, ...]
    gate: float | None = field(default_factory=lambda: None)
    differential: bool = field(default_factory=bool)
    relative: bool = field(default_factory=bool)


@dataclass(frozen=True)
class RobotLocalization:
    """What a robot_localization file says of a planar base.

    Parameters
    ----------
    sources : dict of RosSource by name
    pose : (3,), m and rad
    covariance : (3, 3)
    process_noise : (3, 3), per second
    frequency : float, Hz
        How often the file wants an estimate; a BaseLocalizer gives one whenever it is asked.
    sensor_timeout : float, s
        After it the file wants a prediction; a BaseLocalizer predicts whenever it is asked.
    history : float, s
        How late measurements may come.
    filter : {'ekf', 'ukf'}

    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> est.RobotLocalization(sources={}).localizer().history
    10.0
    """

    sources: dict[str, RosSource]
    pose: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    covariance: NDArray[np.float64] = field(default_factory=lambda: 1e-9 * np.eye(3))
    process_noise: NDArray[np.float64] = field(default_factory=lambda: np.diag([0.05, 0.05, 0.06]))
    frequency: float = field(default_factory=lambda: 30.0)
    sensor_timeout: float = field(default_factory=lambda: 1 / 30)
    history: float = field(default_factory=lambda: 10.0)
    filter: str = field(default_factory=lambda: "ekf")

    def localizer(self, **options: Any) -> BaseLocalizer:
        """Make a BaseLocalizer of these settings, its sources declared.

        Parameters
        ----------
        **options
            Arguments of BaseLocalizer that shall be others.

        Returns
        -------
        BaseLocalizer

        Raises
        ------
        ValueError

        Examples
        --------
        >>> from thing_kin import estimation as est
        >>> est.RobotLocalization(sources={}).localizer(t=0.0).estimate().pose
        array([0., 0., 0.])
        """
        sources = {
            name: {"fuse": list(source.fuse), "gate": source.gate}
            for name, source in self.sources.items()
        }
        settings = {
            "pose": self.pose,
            "covariance": self.covariance,
            "process_noise": self.process_noise,
            "history": self.history,
            "filter": self.filter,
            "gate": 1.0,  # as there: no threshold, no gate
            "sources": sources,
        }
        return BaseLocalizer(**{**settings, **options})


def read_robot_localization(source: str | Path, *, node: str | None = None) -> RobotLocalization:
    """Read a parameter file of ROS's robot_localization (1 or 2); needs pyyaml.

    odomN, poseN, twistN and imuN with their variables, thresholds, differential and relative; the
    initial state, the process noise of the pose, the history. What concerns only ROS is passed
    over; what is not taken over, such as accelerations, is said in a warning that names the key.

    Parameters
    ----------
    source : str or Path
        A path, or the text itself.
    node : str, optional
        Which node's parameters, if there are several in the file.

    Returns
    -------
    RobotLocalization

    Raises
    ------
    ValueError
        That names the key.
    ImportError
        Without pyyaml (`pip install thing_kin[yaml]`).

    Examples
    --------
    >>> from thing_kin import estimation as est
    >>> text = '''
    ... ekf_filter_node:
    ...   ros__parameters:
    ...     two_d_mode: true
    ...     odom0: /wheels/odometry
    ...     odom0_config: [false, false, false, false, false, false, true, true, false,
    ...                    false, false, true, false, false, false]
    ...     odom0_twist_rejection_threshold: 3.0
    ... '''
    >>> settings = est.read_robot_localization(text)
    >>> settings.sources["odom0"].fuse
    ('vx', 'vy', 'omega')
    >>> round(settings.sources["odom0"].gate, 4)
    0.9707
    """
    parameters = _parameters(_load(source), node)
    if not parameters.get("two_d_mode", False):
        _warn("two_d_mode", "not set, but only the planar part is taken over")
    sources = {s.name: s for s in _sources(parameters)}
    _warn_of_the_rest(parameters)
    settings: dict[str, Any] = {"sources": sources}
    for key, name in (("frequency", "frequency"), ("sensor_timeout", "sensor_timeout")):
        if key in parameters:
            settings[name] = _number(parameters, key)
    settings.setdefault("sensor_timeout", 1 / settings.get("frequency", 30.0))
    if parameters.get("smooth_lagged_data") and _number(parameters, "history_length") > 0:
        settings["history"] = _number(parameters, "history_length")
    if "initial_state" in parameters:
        state = _numbers(parameters, "initial_state", 15)
        settings["pose"] = state[POSE_ROWS]
        if np.any(np.delete(state, POSE_ROWS)):
            _warn("initial_state", "only x, y and yaw are taken over")
    for key, name in (
        ("initial_estimate_covariance", "covariance"),
        ("process_noise_covariance", "process_noise"),
    ):
        if key in parameters:
            settings[name] = _matrix(parameters, key)[np.ix_(POSE_ROWS, POSE_ROWS)]
    return RobotLocalization(**settings)


def _load(source: str | Path) -> Any:
    try:
        import yaml
    except ImportError as error:
        raise ImportError(
            "reading YAML needs pyyaml, which is not installed: pip install thing_kin[yaml]"
        ) from error
    is_path = isinstance(source, Path) or ("\n" not in source and ":" not in source)
    text = Path(source).read_text(encoding="utf-8") if is_path else str(source)
    try:
        return yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise ValueError(f"source: got no YAML ({error}), expected a parameter file") from error


def _parameters(loaded: Any, node: str | None) -> dict[str, Any]:
    """Return the parameters of a node, from a file of ROS 1 or 2, or with no node at all."""
    if not isinstance(loaded, Mapping):
        raise ValueError(f"source: got {type(loaded).__name__}, expected a mapping of parameters")
    nodes = {
        str(name): value.get("ros__parameters", value)
        for name, value in loaded.items()
        if isinstance(value, Mapping)
    }
    if node is not None and node not in nodes:
        raise ValueError(f"node: got '{node}', expected one of {sorted(nodes)}")
    if not nodes:
        return {str(k): v for k, v in loaded.items()}
    if node is None and len(nodes) > 1:
        raise ValueError(f"node: got None, expected one of {sorted(nodes)}")
    chosen = nodes[node if node is not None else next(iter(nodes))]
    return {str(k): v for k, v in chosen.items()}


def _sources(parameters: dict[str, Any]) -> list[RosSource]:
    found = []
    for key, topic in parameters.items():
        match = SOURCE.match(key)
        if match is None or match[3]:
            continue
        wanted = _config(parameters, key)
        parts = {
            "pose": tuple(PLANAR[v] for v in ("x", "y", "yaw") if v in wanted),
            "twist": tuple(PLANAR[v] for v in ("vx", "vy", "vyaw") if v in wanted),
        }
        both = all(parts.values())
        for part, fuse in parts.items():
            if fuse:
                name = f"{key}_{part}" if both else key
                found.append(
                    RosSource(
                        name,
                        str(topic),
                        fuse,
                        _gate(parameters, key, part, len(fuse)),
                        part == "pose" and bool(parameters.get(f"{key}_differential", False)),
                        part == "pose" and bool(parameters.get(f"{key}_relative", False)),
                    )
                )
        if not any(parts.values()):
            _warn(f"{key}_config", "no variable of a planar base is true; not taken over")
    return found


def _config(parameters: dict[str, Any], name: str) -> set[str]:
    """Return the names of the variables that are true."""
    key = f"{name}_config"
    if key not in parameters:
        raise ValueError(f"{key}: got nothing, expected 15 booleans for {name}")
    flags = _flat(parameters[key])
    if len(flags) != 15 or not all(isinstance(flag, bool) for flag in flags):
        raise ValueError(f"{key}: got {len(flags)} entries, expected 15 booleans")
    wanted = {variable for variable, flag in zip(VARIABLES, flags, strict=True) if flag}
    lost: list[str] = [v for v in ("ax", "ay") if v in wanted]
    if not parameters.get("two_d_mode", False):
        lost += [v for v in VARIABLES if v in wanted and v not in PLANAR and v not in lost]
    if lost:
        _warn(key, f"{', '.join(lost)} not taken over")
    return wanted


def _gate(parameters: dict[str, Any], name: str, part: str, dof: int) -> float | None:
    """Turn a Mahalanobis distance into the probability to be nearer."""
    key = f"{name}_{part}_rejection_threshold"
    if key not in parameters and not name.startswith(("odom", "imu")):
        key = f"{name}_rejection_threshold"
    if key not in parameters:
        return None
    d = _number(parameters, key)
    if not d > 0:
        raise ValueError(f"{key}: got {d}, expected a distance > 0")
    tail = math.exp(-d * d / 2)
    one = math.erf(d / math.sqrt(2))
    return (one, 1 - tail, one - math.sqrt(2 / math.pi) * d * tail)[dof - 1]


def _warn_of_the_rest(parameters: dict[str, Any]) -> None:
    for key, value in parameters.items():
        match = SOURCE.match(key)
        if match is None and not PLUMBING.match(key):
            if key not in FALSE_IS_NOTHING or value:
                _warn(key, "not taken over")
        elif match is not None and match[3]:
            known = (*SOURCE_PLUMBING, "rejection_threshold", *THRESHOLDS)
            if f"{match[1]}{match[2]}" not in parameters:
                raise ValueError(f"{key}: got no {match[1]}{match[2]}, expected its topic, too")
            if match[3] not in known and (value or not isinstance(value, bool)):
                _warn(key, "not taken over")


def _warn(key: str, what: str) -> None:
    warnings.warn(f"{key}: {what}", UserWarning, stacklevel=4)


def _flat(value: Any) -> list[Any]:
    if not isinstance(value, list):
        return [value]
    return [entry for item in value for entry in _flat(item)]


def _number(parameters: dict[str, Any], key: str) -> float:
    return float(_numbers(parameters, key, 1)[0])


def _numbers(parameters: dict[str, Any], key: str, *counts: int) -> NDArray[np.float64]:
    values = _flat(parameters.get(key))
    try:
        numbers = np.array([float(v) for v in values])
    except (TypeError, ValueError):
        raise ValueError(f"{key}: got {values[:3]}, expected numbers") from None
    if len(numbers) not in counts or not np.isfinite(numbers).all():
        expected = " or ".join(map(str, counts))
        raise ValueError(f"{key}: got {len(numbers)} numbers, expected {expected}, finite")
    return numbers


def _matrix(parameters: dict[str, Any], key: str) -> NDArray[np.float64]:
    """Read fifteen by fifteen numbers, or a diagonal."""
    numbers = _numbers(parameters, key, 225, 15)
    return np.diag(numbers) if len(numbers) == 15 else numbers.reshape(15, 15)
