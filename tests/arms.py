"""Seven-joint arms that the library does not carry: rows of their makers' own numbers.

For tests and benchmarks. test_arms.py compares them with the same robots' URDFs.
"""

import numpy as np

import thing_kin as tk

PI, HALF = np.pi, np.pi / 2


def panda() -> tk.Chain:
    """Franka Emika Panda up to the flange: Franka Control Interface, DH (Craig) and limits.

    Craig's row is Rx(alpha) Tx(a) Rz(theta) Tz(d): shifted by half a row it is a standard one.
    """
    a = [0.0, 0.0, 0.0, 0.0825, -0.0825, 0.0, 0.088, 0.0]
    alpha = [0.0, -HALF, HALF, HALF, -HALF, HALF, HALF, 0.0]
    d = [0.333, 0.0, 0.316, 0.0, 0.384, 0.0, 0.0]
    lower = [-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973]
    upper = [2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973]
    velocity = [2.175] * 4 + [2.61] * 3
    acceleration = [15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0]
    rows = [
        tk.DH(
            d=d[i],
            a=a[i + 1],
            alpha=alpha[i + 1],
            joint="revolute",
            lower=lower[i],
            upper=upper[i],
            velocity_limit=velocity[i],
            acceleration_limit=acceleration[i],
        )
        for i in range(7)
    ]
    return tk.Chain.from_dh([*rows, tk.DH(d=0.107)], name="panda")


def iiwa14() -> tk.Chain:
    """KUKA LBR iiwa 14 R820 up to the flange: data sheet, lengths, ranges and speeds.

    A shoulder, an elbow and a wrist whose axes meet. Joint 4 turns the other way, as KUKA counts.
    """
    d = [0.36, 0.0, 0.42, 0.0, 0.4, 0.0, 0.126]
    alpha = [-HALF, HALF, HALF, -HALF, -HALF, HALF, 0.0]
    limit = np.deg2rad([170.0, 120.0, 170.0, 120.0, 170.0, 120.0, 175.0])
    velocity = np.deg2rad([85.0, 85.0, 100.0, 75.0, 130.0, 135.0, 135.0])
    rows = [
        tk.DH(
            d=d[i],
            alpha=alpha[i],
            joint="revolute",
            lower=-limit[i],
            upper=limit[i],
            velocity_limit=velocity[i],
        )
        for i in range(7)
    ]
    return tk.Chain.from_dh(rows, name="iiwa14")


def gen3() -> tk.Chain:
    """Kinova Gen3 with seven joints, of which 1, 3, 5 and 7 turn without end.

    Rows as in the user guide, lengths and limits of kortex_description, right angles exact. The z
    axis of the first joint points downwards.
    """
    d = [-0.28481, -0.01175, -0.42076, -0.01275, -0.31436, -0.0003501, -0.167455]
    limit = [None, 2.41, None, 2.66, None, 2.23, None]
    velocity = [1.3963] * 4 + [1.2218] * 3
    rows = [
        _gen3_row(d[i], 0.0 if i == 0 else PI, HALF if i < 6 else PI, limit[i], velocity[i])
        for i in range(7)
    ]
    return tk.Chain.from_dh([tk.DH(alpha=PI), *rows], name="gen3")


def _gen3_row(d: float, theta: float, alpha: float, limit: float | None, velocity: float) -> tk.DH:
    if limit is None:
        return tk.DH(d, theta, 0.0, alpha, "continuous", velocity_limit=velocity)
    return tk.DH(
        d, theta, 0.0, alpha, "revolute", lower=-limit, upper=limit, velocity_limit=velocity
    )
