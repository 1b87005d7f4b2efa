"""The arm that is there: its differences from the data sheet, from what was measured of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from thing_kin.estimation import calibration_arguments as arguments
from thing_kin.estimation.calibration_base import check_folds
from thing_kin.estimation.calibration_result import Calibration
from thing_kin.estimation.calibration_run import CalibrationRun

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    import thing_kin as tk

    Array = NDArray[np.float64]
    Load = tuple[str | int | None, ArrayLike, float]

__all__ = ["calibrate"]

MISSING = (
    "thing_kin was built without Ceres, or one of its libraries is missing; on Debian install "
    "libceres-dev, then build with -DTHING_KIN_CERES=ON (the default)"
)


def calibrate(
    chain: tk.Chain,
    q: ArrayLike,
    measured: ArrayLike,
    *,
    parameters: str | Sequence[str] = ("base", "tool", "joint_offsets"),
    kind: str | None = None,
    points: ArrayLike | None = None,
    base: ArrayLike | None = None,
    tool: ArrayLike | None = None,
    covariance: ArrayLike | None = None,
    q_covariance: ArrayLike | None = None,
    base_covariance: ArrayLike | None = None,
    priors: Mapping[str, float] | None = None,
    loss: str = "cauchy",
    loss_scale: float | None = None,
    gate: float = 0.999,
    folds: int = 0,
    rng: int | np.random.Generator = 0,
    sag: Sequence[str | int] = (),
    loads: Sequence[Load] = ((None, (0.0, 0.0, 0.0), 1.0),),
    gravity: ArrayLike = (0.0, 0.0, -9.81),
    max_iterations: int = 100,
) -> Calibration:
    """Estimate what an arm differs by from its model, and say what the data do not tell.

    Least squares under a robust loss, solved by Ceres with exact derivatives, for

        T_world_tool(q) = base  chain(q; errors)  tool.

    Base and tool may be anywhere: where to begin is found from the data (of "hits": from `base`
    and `tool`). A parameter that the data do not tell stays at its nominal value; it is listed,
    with those it can't be told from.

    Parameters
    ----------
    chain : Chain
        Nominal; a mobile manipulator, too, whose q has the base's x, y, theta as localized.
    q : (N, n)
        Joint readings.
    measured : (N, 4, 4), (N, 3) or (N, k, 3)
        Poses of the tool in the world; or places there, m, of one point of the tool or of k. What
        is NaN as a whole (a pose, a point) was not measured.
    parameters : sequence of str
        Groups: "base", "tool", "joint_offsets", "joint_scales" (of the reading, less one), "dh" (d,
        theta, a, alpha of [M17] (3.7), and beta about y after rows with parallel axes: Hayati and
        Mirmirani 1985), "origins" (as URDF: xyz and a rotation vector before each joint), "links"
        (one of these two, as the chain is made), "mount" (of the arm on its mobile base), "points";
        or single ones: "dh[1]", "dh[1].alpha", "tool.z". "all": base, tool, joint_offsets, links.
        The number in brackets is the joint's place in q.
    kind : {"poses", "points", "hits"}, optional
        Default: by the shape of `measured`. "hits": places that the tool's z axis, a laser's line,
        was led through [X21].
    points : (k, 3), m, optional
        Where the measured points are on the tool. Default: one is the tool's origin; several are
        estimated, in the frame of the tool as given, which is not estimated then.
    base, tool : (4, 4), optional
        Nominal pose of the chain's root in the world, and of the tool in the chain's last frame.
    covariance : (6, 6), (3, 3), (2, 2) or one for each measurement, optional
        Of a pose (position, then rotation vector; world axes), a point, a hit (the tool's x, y).
        Default: the noise of position and that of rotation are estimated from the residuals.
    q_covariance : (n, n) or (N, n, n), optional
        Of the joint readings; carried over to the measurements.
    base_covariance : (3, 3) or (N, 3, 3), optional
        Of x, y, theta of a mobile base, world axes, as `BaseLocalizer` gives it.
    priors : mapping of names to float, optional
        Standard deviations of parameters or groups about their nominal values; 0 holds them.
    loss : {"linear", "huber", "soft_l1", "cauchy", "tukey"}
        Of a measurement, by its distance in standard deviations.
    loss_scale : float, optional
        Where the loss leaves the parabola; default: 95 % efficient with normal noise.
    gate : float
        A measurement beyond this quantile of chi-square is listed as an outlier.
    folds : int
        Cross-validation: so many times all is estimated without a part of the postures (equal ones
        stay together) and judged there; 0: not done.
    rng : int or Generator
        Draws the folds.
    sag : sequence of joint names or indices
        Joints that gravity turns, by a compliance (rad for each N m) times its torque, or shifts
        (m for each N).
    loads : sequence of (frame, point, kg)
        What gravity pulls at. Default: one kg at the last frame, so that compliances are for each
        kg there.
    gravity : (3,), m/s^2
        In the chain's root.
    max_iterations : int
        Of Ceres, each time that it is called.

    Returns
    -------
    Calibration

    Raises
    ------
    ValueError
        If a shape does not fit, a number is not finite or a name is none.

    Examples
    --------
    >>> import numpy as np, thing_kin as tk
    >>> from thing_kin import estimation as est
    >>> arm = tk.robots.ur5()
    >>> q, offsets = arm.random(40, rng=0), np.array([0, 2e-3, -3e-3, 1e-3, 2e-3, 0])
    >>> result = est.calibrate(arm, q, arm.fk(q + offsets))
    >>> bool(np.allclose(result.joint_offsets[1:5], offsets[1:5], atol=1e-7))
    True
    >>> result.unidentifiable
    ('base.rz', 'tool.rz', 'joint_offsets[0]', 'joint_offsets[5]')
    """
    check_folds(folds, or_none=True)
    core = _module()
    shape = arguments.shape_of(measured, q, chain.n)
    kind = kind or ("points" if shape[-1:] == (3,) else "poses")
    several = kind == "points" and len(shape) == 3 and shape[1] != 1
    names = arguments.groups_of(parameters)
    free = several and points is None
    place = np.zeros((shape[1], 3)) if free else points
    if kind == "points" and (free or "points" in names):
        names = [n for n in names if n.partition(".")[0] != "tool"]
        names += [] if "points" in names else ["points"]
    joints = [arguments.joint_of(chain, name) for name in sag]
    names += ["sag"] if joints and "sag" not in names else []
    count = shape[0] if shape else 0
    joint_covariance = arguments.joint_covariance(core, chain, count, q_covariance, base_covariance)

    down = core.numbers(gravity, "gravity", (3,), False, False)

    def torques(postures: ArrayLike) -> Array | None:
        return arguments.torques_of(chain, postures, loads, down) if joints else None

    def problem_of(groups: list[str]) -> Any:
        return core.Problem(
            chain, q, kind, measured, place, covariance, joint_covariance, torques(q),
            groups, dict(priors or {}), joints,
        )  # fmt: skip

    problem = problem_of(names)
    options = {
        "loss": loss,
        "loss_scale": loss_scale,
        "gate": gate,
        "max_iterations": max_iterations,
        "base": base,
        "tool": tool,
    }
    postures = np.array(q, dtype=float)
    fit = problem.fit(**options, postures=list(range(len(postures))))
    run = CalibrationRun(
        chain,
        postures,
        problem,
        fit,
        options,
        torques,
        problem_of,
        tuple(names),
        arguments.places_of(measured),
    )
    result = _result(run, covariance is None, place)
    return result.cross_validated(folds, np.random.default_rng(rng)) if folds else result


def _result(run: CalibrationRun, estimates_noise: bool, points: ArrayLike | None) -> Calibration:
    problem, fit = run.problem, run.fit
    names = tuple(problem.names)
    told, known = np.asarray(fit.is_told, dtype=bool), np.asarray(problem.has_prior, dtype=bool)
    k = problem.per_posture
    distances = np.full((len(run.q), k), np.nan)
    distances[fit.postures, fit.points] = fit.distances
    flagged = np.flatnonzero(fit.outliers)
    outliers = [(fit.postures[i], fit.points[i]) for i in flagged]
    nan = float("nan")
    return Calibration(
        status=fit.status,
        chain=problem.chain(fit),
        base=fit.base,
        tool=fit.tool,
        points=_points(names, fit.values, points),
        names=names,
        nominal=problem.nominal,
        values=fit.values,
        std=np.where(told | known, np.sqrt(np.diag(fit.covariance)), np.inf),
        covariance=fit.covariance,
        unidentifiable=tuple(n for n, is_told in zip(names, told, strict=True) if not is_told),
        combinations=tuple(problem.unseen_in_words(fit)),
        rank=fit.rank,
        noise_position=fit.noise[0] if estimates_noise else nan,
        noise_rotation=fit.noise[1] if estimates_noise and problem.rows == 6 else nan,
        noise_is_estimated=fit.noise_is_estimated,
        variance_factor=fit.variance_factor,
        dof=fit.dof,
        errors=run.shaped(fit.errors),
        distances=distances if k > 1 else distances[:, 0],
        outliers=tuple(outliers if k > 1 else (posture for posture, _ in outliers)),
        iterations=fit.iterations,
        _run=run,
    )


def _points(names: tuple[str, ...], values: Array, nominal: ArrayLike | None) -> Array:
    points = np.zeros((1, 3)) if nominal is None else np.array(nominal, dtype=float)
    for name, value in zip(names, values, strict=True):
        if name.startswith("points["):
            index, _, axis = name[len("points[") :].partition("].")
            points[int(index), "xyz".index(axis)] += value
    return points


def _module() -> Any:
    try:
        from thing_kin import _calibration
    except ImportError as error:
        raise ImportError(MISSING) from error
    return _calibration
