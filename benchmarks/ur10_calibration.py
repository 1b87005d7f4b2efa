"""A real UR arm seen by motion capture: what calibration gains, by held-out postures.

    python benchmarks/ur10_calibration.py RECORD.csv [--out FIGURE.png]

The record is that of thanhndv212/figaroh-examples: a marker's x, y, z (m), roll, pitch, yaw (rad)
and six joint angles, 23 postures. "Held out" predicts each posture by the 22 others. The learning
curve estimates from n postures and predicts all others, 20 draws for each n: the median rms.
"""

import argparse
from pathlib import Path
from typing import Any

import numpy as np

import thing_kin as tk
from thing_kin import estimation as est

Array = np.ndarray[Any, np.dtype[np.float64]]

# Universal_Robots_ROS2_Description, config/ur10e/default_kinematics.yaml.
UR10E = {"d1": 0.1807, "a2": -0.6127, "a3": -0.57155, "d4": 0.17415, "d5": 0.11985, "d6": 0.11655}
SETS = {
    "base, tool": ("base", "tool"),
    "+ joint offsets": ("base", "tool", "joint_offsets"),
    "+ all rows": ("base", "tool", "joint_offsets", "links"),
}


def ur10e() -> tk.Chain:
    g = UR10E
    turn = {"joint": "revolute", "lower": -2 * np.pi, "upper": 2 * np.pi}
    rows = [
        tk.DH(d=g["d1"], alpha=np.pi / 2, **turn),
        tk.DH(a=g["a2"], **turn),
        tk.DH(a=g["a3"], **turn),
        tk.DH(d=g["d4"], alpha=np.pi / 2, **turn),
        tk.DH(d=g["d5"], alpha=-np.pi / 2, **turn),
        tk.DH(d=g["d6"], **turn),
    ]
    return tk.Chain.from_dh(rows, name="ur10e")


def read(path: Path) -> tuple[Array, Array]:
    rows = np.loadtxt(path, delimiter=",", skiprows=1)
    poses = np.stack([tk.transform(xyz=row[:3], rpy=row[3:6]) for row in rows])
    return rows[:, 6:], poses


def table(arm: tk.Chain, q: Array, poses: Array) -> dict[str, Any]:
    results = {}
    for kind, measured in (("poses", poses), ("places", poses[:, :3, 3])):
        for name, parameters in SETS.items():
            result = est.calibrate(arm, q, measured, parameters=parameters, folds=len(q))
            results[f"{kind}, {name}"] = result
            print(
                f"{arm.name:6} {kind:7} {name:16} rank {result.rank:2} of {len(result.names):2}  "
                f"rms {1e3 * result.rms_position:6.2f} mm  held out "
                f"{1e3 * result.cross_validated_rms_position:6.2f} mm "
                f"{1e3 * result.cross_validated_rms_rotation:6.2f} mrad  "
                f"outliers {list(result.outliers)}"
            )
    return results


def learning_curve(arm: tk.Chain, q: Array, poses: Array) -> dict[str, list[float]]:
    curves: dict[str, list[float]] = {}
    counts = (6, 8, 10, 12, 15, 18, 21)
    print("held-out rms [mm] from n postures:", *counts)
    for name, parameters in SETS.items():
        curves[name] = []
        for n in counts:
            errors = []
            for seed in range(20):
                order = np.random.default_rng(seed).permutation(len(q))
                train, test = order[:n], order[n:]
                result = est.calibrate(arm, q[train], poses[train], parameters=parameters)
                miss = (result.predict(q[test]) - poses[test])[:, :3, 3]
                errors.append(np.sqrt(np.mean(np.sum(miss**2, axis=1))))
            curves[name].append(float(np.median(errors)))
        print(f"  {name:16}", *(f"{1e3 * error:6.2f}" for error in curves[name]))
    return curves


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("record", type=Path)
    parser.add_argument("--out", type=Path, help="where the figure goes")
    arguments = parser.parse_args()
    q, poses = read(arguments.record)
    table(tk.robots.ur10(), q, poses)
    results = table(ur10e(), q, poses)
    learning_curve(ur10e(), q, poses)
    best = results["poses, + all rows"]
    print(best)
    print("next postures:", best.propose_postures(3).round(2).tolist(), sep="\n")
    if arguments.out:
        best.plot().savefig(arguments.out, dpi=130)


if __name__ == "__main__":
    main()
