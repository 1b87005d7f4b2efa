"""The fiducial-interception experiment of [X21], chapters 4 and 5."""

from thing_kin._search import ManipulatorArm, WorldRun
from thing_kin.rmma.arrangement import ARRANGEMENTS, Arrangement
from thing_kin.rmma.experiment import CONFIGS, Config, Method, Odometry, WorldLike, run, trace
from thing_kin.rmma.practices import Practice, practice
from thing_kin.rmma.reproduction import Reproduction, reproduce
from thing_kin.rmma.result import Result, Spread
from thing_kin.rmma.sweeps import Sweep, SweepEntry, sweep
from thing_kin.rmma.traces import SearchTrace, SideTrace, Trace
from thing_kin.rmma.world import World
from thing_kin.rmma.worlds import named_worlds

__all__ = [
    "ARRANGEMENTS",
    "CONFIGS",
    "Arrangement",
    "Config",
    "ManipulatorArm",
    "Method",
    "Odometry",
    "Practice",
    "Reproduction",
    "Result",
    "SearchTrace",
    "SideTrace",
    "Spread",
    "Sweep",
    "SweepEntry",
    "Trace",
    "World",
    "WorldLike",
    "WorldRun",
    "named_worlds",
    "practice",
    "reproduce",
    "run",
    "sweep",
    "trace",
]
