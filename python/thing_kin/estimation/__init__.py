"""Where the base is, where the hand is, and how sure we are.

Filters, wheel odometry, the localizer of the base and the pose of the hand, each with its
covariance. Planar poses are (x, y, theta), their covariances in world axes; twists (vx, vy, omega)
in the body; metres, radians, seconds.
"""

from thing_kin import _estimation

__all__: list[str] = []

del _estimation  # whose names come here one by one
