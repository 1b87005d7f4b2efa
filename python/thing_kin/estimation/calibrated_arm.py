"""An arm as calibrated: its numbers by joint, where its tool is, and files of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thing_kin.estimation import ur_yaml
from thing_kin.estimation.calibration_base import CalibrationResult
from thing_kin.estimation.calibration_run import CalibrationRun

if TYPE_CHECKING:
    import thing_kin as tk

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class CalibratedArm(CalibrationResult):
    """What a `Calibration` says of the arm; its numbers are explained there."""

    chain: tk.Chain
    base: Array
    tool: Array
    points: Array
    _run: CalibrationRun

    @property
    def joint_offsets(self) -> Array:
        """(n,), rad or m: what is added to the readings; 0 where not estimated."""
        return self._by_joint("joint_offsets")

    @property
    def joint_scales(self) -> Array:
        """(n,): true motion over what is read; 1 where not estimated."""
        return 1.0 + self._by_joint("joint_scales")

    @property
    def compliances(self) -> Array:
        """(n,), rad for each N m of the loads' torque, m for each N; 0 where not estimated."""
        return self._by_joint("sag")

    def readings(self, q: ArrayLike) -> Array:
        """Joint positions for `chain` where q is read: with scales and sag, without offsets.

        Parameters
        ----------
        q : (n,) or (N, n)

        Returns
        -------
        (n,) or (N, n)

        Examples
        --------
        >>> import thing_kin as tk
        >>> from thing_kin import estimation as est
        >>> arm = tk.robots.ur5()
        >>> q = arm.random(30, rng=0)
        >>> result = est.calibrate(arm, q, arm.fk(q), parameters=("base", "tool"))
        >>> bool((result.readings(q) == q).all())
        True
        """
        q = self._run.read_postures(q, "q")
        sag = self._run.torques(q)
        corrected: Array = q * self.joint_scales
        return corrected if sag is None else corrected + self.compliances * sag

    def predict(self, q: ArrayLike) -> Array:
        """Pose of the tool in the world where q is read, scales and sag included.

        Parameters
        ----------
        q : (n,) or (N, n)

        Returns
        -------
        (4, 4) or (N, 4, 4)

        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> from thing_kin import estimation as est
        >>> arm = tk.robots.ur5()
        >>> q = arm.random(30, rng=0)
        >>> result = est.calibrate(arm, q, arm.fk(q), parameters=("base", "tool"))
        >>> bool(np.allclose(result.predict(q), arm.fk(q)))
        True
        """
        return np.asarray(self.base @ self.chain.fk(self.readings(q)) @ self.tool)

    def to_urdf(self, name: str | None = None) -> str:
        """Return the calibrated chain as URDF, as `Chain.to_urdf`; base and tool are not in it.

        Parameters
        ----------
        name : str, optional
            Of the robot; default: the chain's.

        Returns
        -------
        str

        Examples
        --------
        >>> import thing_kin as tk
        >>> from thing_kin import estimation as est
        >>> arm = tk.robots.ur5()
        >>> q = arm.random(30, rng=0)
        >>> est.calibrate(arm, q, arm.fk(q)).to_urdf().startswith("<?xml")
        True
        """
        return self.chain.to_urdf(name)

    def to_ur_calibration(self) -> dict[str, dict[str, dict[str, float]]]:
        """Return the calibrated chain as Universal Robots' driver wants it, for `tk.robots.ur5`.

        Returns
        -------
        dict
            {"kinematics": {"shoulder": {"x", "y", "z", "roll", "pitch", "yaw"}, ...}}

        Raises
        ------
        ValueError
            If the chain is not six turning joints, or ends in a turn or shift off the last axis,
            which the driver's format can't say: hold those of the last row by priors of 0.

        Examples
        --------
        >>> import numpy as np, thing_kin as tk
        >>> from thing_kin import estimation as est
        >>> arm = tk.robots.ur5()
        >>> q = arm.random(30, rng=0)
        >>> mapping = est.calibrate(arm, q, arm.fk(q)).to_ur_calibration()
        >>> bool(np.allclose(tk.robots.ur5(mapping).fk(q), arm.fk(q)))
        True
        """
        return ur_yaml.mapping_of(self.chain)

    def to_yaml(self, hash: str = "") -> str:
        """Return the same as the text of the driver's YAML file.

        Parameters
        ----------
        hash : str
            Of the controller's own calibration, which the driver compares; "": left out.

        Returns
        -------
        str

        Examples
        --------
        >>> import thing_kin as tk
        >>> from thing_kin import estimation as est
        >>> arm = tk.robots.ur5()
        >>> q = arm.random(30, rng=0)
        >>> est.calibrate(arm, q, arm.fk(q)).to_yaml().splitlines()[:2]
        ['kinematics:', '  shoulder:']
        """
        return ur_yaml.yaml_of(self.to_ur_calibration(), hash)

    def _by_joint(self, group: str) -> Array:
        known = self.parameters
        n = self._run.chain.n
        return np.array([known.get(f"{group}[{i}]", 0.0) for i in range(n)])

    def _unit(self, name: str) -> str:
        group, _, last = name.partition(".")
        group, _, place = group.rstrip("]").partition("[")
        if group == "joint_scales":
            return "1"
        if group in ("joint_offsets", "sag"):
            slides = self.chain.joint_types[int(place)] == "prismatic"
            units = ("m", "m/N") if slides else ("rad", "rad/(N m)")
            return units[group == "sag"]
        return "m" if last in ("x", "y", "z", "d", "a") else "rad"
