"""Simulated arms with errors of every kind, and what would be measured of them."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

import thing_kin as tk

Array = np.ndarray[Any, np.dtype[np.float64]]


def perturbed(arm: tk.Chain, errors: dict[str, float]) -> tk.Chain:
    """A chain of Denavit-Hartenberg rows with other numbers: written out, apart from the core.

    `errors` has names as "dh[1].alpha"; beta is not for it.
    """
    rows = []
    for i, row in enumerate(rows_of(arm)):
        d, theta, a, alpha = (
            row[k] + errors.get(f"dh[{i}].{k}", 0.0) for k in ("d", "theta", "a", "alpha")
        )
        offset = errors.get(f"joint_offsets[{i}]", 0.0)
        rows.append(tk.DH(d=d, theta=theta + offset, a=a, alpha=alpha, joint="continuous"))
    return tk.Chain.from_dh(rows)


def rows_of(arm: tk.Chain) -> list[dict[str, float]]:
    """The rows of a UR arm, from where its frames are at zero."""
    frames = arm.fk_all(np.zeros(arm.n))
    rows = []
    for before, after in pairwise(frames):
        T = np.linalg.solve(before, after)
        theta = np.arctan2(T[1, 0], T[0, 0])
        alpha = np.arctan2(T[2, 1], T[2, 2])
        a = np.cos(theta) * T[0, 3] + np.sin(theta) * T[1, 3]
        rows.append({"d": T[2, 3], "theta": theta, "a": a, "alpha": alpha})
    return rows


def noisy(T: Array, rng: np.random.Generator, position: float, rotation: float) -> Array:
    """Poses with normal errors, in world axes."""
    measured = T.copy()
    measured[:, :3, 3] += rng.normal(0, position, (len(T), 3))
    turned = tk.lie.so3_exp(rng.normal(0, rotation, (len(T), 3)))
    measured[:, :3, :3] = turned @ T[:, :3, :3]
    return measured


@dataclass(frozen=True)
class SimulatedArm:
    """The true arm, and what was measured."""

    nominal: tk.Chain
    truth: dict[str, float]
    true_chain: tk.Chain
    base: Array
    tool: Array
    q: Array
    measured: Array
    spoiled: Array  # which are outliers

    def tool_error(self, predicted: Array, q: Array) -> Array:
        """Distance of predicted from true places of the tool, m."""
        true = self.base @ self.true_chain.fk(q) @ self.tool
        return np.linalg.norm((predicted - true)[:, :3, 3], axis=1)


def simulated(seed: int, postures: int = 60, outliers: float = 0.0) -> SimulatedArm:
    """A UR10 somewhere, a tool, errors in every row, 0.2 mm and 0.2 mrad of noise."""
    rng = np.random.default_rng([seed, 9])
    nominal = tk.robots.ur10()
    truth = {f"joint_offsets[{i}]": rng.normal(0, 3e-3) for i in range(6)}
    for i in range(6):
        for name, sd in (("d", 5e-4), ("a", 5e-4), ("alpha", 1e-3)):
            truth[f"dh[{i}].{name}"] = rng.normal(0, sd)
    arm = perturbed(nominal, truth)
    base = tk.transform(xyz=rng.normal(0, 1, 3), rpy=rng.uniform(-np.pi, np.pi, 3) / [1, 2, 1])
    tool = tk.transform(xyz=rng.normal(0, 0.1, 3), rpy=rng.uniform(-np.pi, np.pi, 3) / [1, 2, 1])
    q = nominal.random(postures, rng=rng) / 2  # within a turn
    measured = noisy(base @ arm.fk(q) @ tool, rng, 2e-4, 2e-4)
    spoiled = rng.permutation(postures)[: round(outliers * postures)]
    gross = noisy(measured[spoiled], rng, 0.05, 0.05)
    measured[spoiled] = gross
    return SimulatedArm(nominal, truth, arm, base, tool, q, measured, np.sort(spoiled))


ARM = tk.robots.ur10()
BASE = tk.transform(xyz=(0.3, 0.1, 0.7), rpy=(0.01, -0.02, 1.6))
TOOL = tk.transform(xyz=(0.01, -0.02, 0.12), rpy=(0.0, 0.0, 0.26))
OFFSETS = np.array([1e-3, -4e-3, 2e-3, 3e-3, -2e-3, 5e-3])
Q = ARM.random(60, rng=1)
EXACT = BASE @ ARM.fk(Q + OFFSETS) @ TOOL
