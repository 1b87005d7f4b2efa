"""Where to look for a fiducial, and in which order.

Points are in the plane, (x, y) in metres; [X21] chapter 2 and `docs/search.md`.
"""

from thing_kin._search import CoveringPlan, compensate, covering, spiral, stochastic

__all__ = ["CoveringPlan", "compensate", "covering", "spiral", "stochastic"]
