"""How a path gets its time: geometry, speed profile, smoothing, proof. For thing_kin.trajectory.

The parts know nothing of each other; `profile` knows their order. toppra is named in `fastest`,
Ruckig in `straight`, and nowhere else.
"""
