"""
Calibration. Private: use thing_kin.estimation.calibrate.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import thing_kin._core
import typing
__all__: list[str] = ['Fit', 'Problem', 'joint_origins', 'numbers']
class Fit:
    """
    Of a Problem.
    """
    @property
    def base(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def distances(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def dof(self) -> float:
        ...
    @property
    def errors(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def is_told(self) -> list[bool]:
        ...
    @property
    def iterations(self) -> int:
        ...
    @property
    def noise(self) -> tuple[float, float]:
        ...
    @property
    def noise_is_estimated(self) -> bool:
        ...
    @property
    def outliers(self) -> list[bool]:
        ...
    @property
    def points(self) -> list[int]:
        ...
    @property
    def postures(self) -> list[int]:
        ...
    @property
    def rank(self) -> int:
        ...
    @property
    def status(self) -> str:
        ...
    @property
    def tool(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def values(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def variance_factor(self) -> float:
        ...
class Problem:
    """
    Measurements of an arm, and what is to be estimated of it.
    """
    def __init__(self, chain: thing_kin._core.Chain, q: typing.Any, kind: str, measured: typing.Any, points: typing.Any, covariance: typing.Any, q_covariance: typing.Any, torques: typing.Any, parameters: collections.abc.Sequence[str], priors: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex], sagging: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]) -> None:
        ...
    def chain(self, fit: Fit) -> thing_kin._core.Chain:
        ...
    def errors(self, fit: Fit, postures: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]) -> numpy.typing.NDArray[numpy.float64]:
        ...
    def fit(self, loss: str, loss_scale: typing.SupportsFloat | typing.SupportsIndex | None, gate: typing.SupportsFloat | typing.SupportsIndex, max_iterations: typing.SupportsInt | typing.SupportsIndex, base: typing.Any, tool: typing.Any, postures: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]) -> Fit:
        ...
    def most_telling(self, fit: Fit, q: typing.Any, torques: typing.Any, count: typing.SupportsInt | typing.SupportsIndex) -> list[int]:
        ...
    def nominal_errors(self, base: typing.Any, tool: typing.Any) -> numpy.typing.NDArray[numpy.float64]:
        ...
    def told_at(self, fit: Fit, q: typing.Any, torques: typing.Any) -> list[bool]:
        ...
    def unseen_in_words(self, fit: Fit) -> list[str]:
        ...
    @property
    def has_prior(self) -> list[bool]:
        ...
    @property
    def names(self) -> list[str]:
        ...
    @property
    def nominal(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def per_posture(self) -> int:
        ...
    @property
    def rows(self) -> int:
        ...
def joint_origins(chain: thing_kin._core.Chain) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
    """
    Of each joint in the one before, (n, 4, 4), and the last frame in the last joint.
    """
def numbers(argument: typing.Any, name: str, item: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], several: bool, is_covariance: bool) -> numpy.typing.NDArray[numpy.float64]:
    """
    The argument as float64, of shape `item` or, if `several`, (N, *item); else ValueError.
    """
