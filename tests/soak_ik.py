"""A soak of inverse kinematics: a million random calls, and nothing that should not be.

    python tests/soak_ik.py --calls 1000000

For each solver drawn, many targets in one batch. It is checked that no number is NaN, that no limit
and no max_step is exceeded by even the last bit, that the errors are those of Pinocchio's forward
kinematics, that success is said exactly where they are within tolerance, that every failure has a
status and a message that agree with the errors, that a repeated call gives the same bits, and that
a row of a batch is a call of its own. Case k depends on --seed and k alone: `--first k --calls 1`
repeats the one that failed.
"""

import argparse
import collections
import re
import sys
import time
from typing import Any

import numpy as np
import pinocchio as pin
from scipy.spatial.transform import Rotation

import thing_kin as tk
from ik_soak_cases import Array, SoakCase, random_case
from thing_kin import interop, lie

TARGETS = 100  # a solver
EPSILON = np.finfo(float).eps
SAYS = {
    "success": "reached within ",
    "unreachable": " beyond reach",
    "limited": " limit",
    "step_bound": "no solution within max_step of the seed",
    "budget": "iterations or restarts ran out",
    "deadline": "time ran out",
}
FIELDS = (
    "q",
    "status",
    "position_error",
    "rotation_error",
    "active_limits",
    "iterations",
    "restarts",
    "message",
)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--calls", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first", type=int, default=0, help="the case to begin with")
    parser.add_argument("--seconds", type=float, default=np.inf, help="end after so long")
    parser.add_argument("--verbose", action="store_true", help="name each case before it is run")
    arguments = parser.parse_args()
    begin, calls, case, wrong = time.monotonic(), 0, arguments.first, 0
    statuses: collections.Counter[str] = collections.Counter()
    while calls < arguments.calls and time.monotonic() - begin < arguments.seconds:
        if arguments.verbose:
            print("case", case, flush=True)
        try:
            made, results = soak(np.random.default_rng([arguments.seed, case]))
        except AssertionError as error:
            wrong += 1
            print(f"case {case}: {error}", flush=True)
        else:
            calls += made
            statuses.update(results.status.tolist())
        case += 1
    print(f"cases {arguments.first} to {case - 1}: {calls} calls, {dict(statuses)}, {wrong} wrong")
    return 1 if wrong else 0


def soak(rng: np.random.Generator) -> tuple[int, tk.IkBatchResult]:
    """One solver's targets; how many calls that was."""
    case = random_case(rng, TARGETS)
    solver = tk.NumericIk(case.robot, frame=case.frame, **case.options)
    results = solver.solve(case.targets, seed=case.seeds, threads=1)
    check(case, results)
    calls = len(results)
    if "deadline" not in case.options:
        check_same(results, solver.solve(case.targets, seed=case.seeds, threads=2))
        some = rng.choice(TARGETS, 5, replace=False)
        for i in some:
            seed = None if case.seeds is None else case.seeds[i]
            one = tk.ik(case.robot, case.targets[i], seed, frame=case.frame, **case.options)
            check_same(results[int(i)], one)
        calls += len(results) + len(some)
    return calls, results


def check_same(one: Any, other: Any) -> None:
    for field in FIELDS:
        assert np.array_equal(getattr(one, field), getattr(other, field)), f"{field} differs"


def check(case: SoakCase, results: tk.IkBatchResult) -> None:
    robot = case.robot
    assert np.isfinite(results.q).all(), f"q not finite: {where(~np.isfinite(results.q))}"
    out = (results.q < robot.lower) | (results.q > robot.upper)
    assert not out.any(), f"limits exceeded: {where(out)}"
    if "max_step" in case.options:
        out = np.abs(results.q - inside(robot, case.seeds)) > case.options["max_step"]
        assert not out.any(), f"max_step exceeded: {where(out)}"
    at = np.where(results.q <= robot.lower, -1, np.where(results.q >= robot.upper, 1, 0))
    assert np.array_equal(results.active_limits, at), "active_limits"
    assert (results.iterations >= 0).all(), "iterations"
    assert (results.restarts <= case.options["max_restarts"]).all(), "restarts"
    check_errors(case, results)
    for i in range(len(results)):
        check_message(case, results[i], i)


def check_errors(case: SoakCase, results: tk.IkBatchResult) -> None:
    position, rotation, size = errors(case, results.q)
    slack = 1e-14 * size, 1e-13
    for name, expected, rounding in (
        ("position", position, slack[0]),
        ("rotation", rotation, slack[1]),
    ):
        said = getattr(results, f"{name}_error")
        off = ~(np.abs(said - expected) <= rounding)
        assert not off.any(), f"{name}_error: {where(off)} {said[off]} {expected[off]}"
    tolerance = [case.options.get(f"{part}_tolerance", 1e-7) for part in ("position", "rotation")]
    success = results.success
    far = (position > tolerance[0] + slack[0]) | (rotation > tolerance[1] + slack[1])
    near = (position < tolerance[0] - slack[0]) & (rotation < tolerance[1] - slack[1])
    assert not (success & far).any(), f"no success: {where(success & far)}"
    assert not (~success & near).any(), f"success not said: {where(~success & near)}"


def errors(case: SoakCase, q: Array) -> tuple[Array, Array, Array]:
    """Position and rotation errors by Pinocchio and SciPy, and what rounding is in proportion to.

    A target of few digits means the rotation of the quaternion read from it.
    """
    task, options = case.options["task"], case.options
    T = poses(case, q)
    goal = np.tile(np.eye(4), (len(q), 1, 1))
    if task == "position":
        goal[:, :3, 3] = case.targets
    elif task == "orientation":
        goal[:, :3, :3] = case.targets
    else:
        goal[:] = case.targets
    quaternions = lie.quaternion_from_rotation(goal[:, :3, :3])
    goal[:, :3, :3] = lie.rotation_from_quaternion(quaternions)
    weights = np.asarray(options.get("weights", np.ones(6))) > 0
    weights = weights & np.repeat([task != "orientation", task != "position"], 3)
    way = goal[:, :3, 3] - T[:, :3, 3]
    turn = goal[:, :3, :3] @ np.swapaxes(T[:, :3, :3], 1, 2)
    log = Rotation.from_matrix(turn).as_rotvec()
    if options["weight_axes"] == "target":
        way = np.einsum("nji,nj->ni", goal[:, :3, :3], way)
        log = np.einsum("nji,nj->ni", goal[:, :3, :3], log)
    size = 1 + np.abs(goal[:, :3, 3]).max(axis=1) + np.abs(T[:, :3, 3]).max(axis=1) + reach(case, q)
    return norm(way * weights[:3]), norm(log * weights[3:]), size


def norm(v: Array) -> Array:
    return np.linalg.norm(v, axis=-1)


def poses(case: SoakCase, q: Array) -> Array:
    same = interop.to_pinocchio(case.robot)
    data, frame = same.model.createData(), same.frame_id(case.frame)
    T = np.empty((len(q), 4, 4))
    for i, configuration in enumerate(same.q(q)):
        pin.forwardKinematics(same.model, data, configuration)
        T[i] = pin.updateFramePlacement(same.model, data, frame).homogeneous
    return T


def reach(case: SoakCase, q: Array) -> Array:
    """No joint is farther from the root."""
    robot = case.robot
    slides = np.array([joint == "prismatic" for joint in robot.joint_types])
    frames = robot.fk_all(np.zeros(robot.n))[:, :3, 3]
    return np.abs(q[:, slides]).sum(axis=1) + norm(np.diff(frames, axis=0)).sum()


def inside(robot: tk.Chain, seeds: Array | None) -> Array:
    """Seeds brought into the limits: joints with a whole turn by turns."""
    assert seeds is not None
    turn = 2 * np.pi
    rotary = np.array([joint != "prismatic" for joint in robot.joint_types])
    past = np.where(seeds < robot.lower, robot.lower - seeds, 0.0)
    past = np.where(seeds > robot.upper, robot.upper - seeds, past)
    with np.errstate(over="ignore"):
        endless = rotary & (robot.upper - robot.lower >= turn)
    turned = seeds + np.copysign(turn * np.ceil(np.abs(past) / turn), past)
    wound = np.where(endless & (past != 0), turned, seeds)
    return np.clip(wound, robot.lower, robot.upper)


def check_message(case: SoakCase, result: tk.IkResult, i: int) -> None:
    told = f"target {i}: {result.status}, {result.message!r}"
    assert result.message, told
    assert SAYS[result.status] in result.message, told
    assert result.success == (result.status == "success"), told
    said = {unit: float(number) for number, unit in re.findall(r"(\S+) (m|rad)\b", result.message)}
    assert said, told
    for unit, error in (("m", result.position_error), ("rad", result.rotation_error)):
        if unit in said:
            assert abs(said[unit] - error) <= 1e-5 * error, told
        else:
            assert error <= max(1e-9, *said.values()), told
    if not result.success:
        assert max(said.values()) > 0, told
    if result.status == "limited":
        assert result.active_limits.any(), told
        for joint, side in zip(case.robot.names, result.active_limits, strict=True):
            named = f"joint '{joint}' at its {'lower' if side < 0 else 'upper'} limit"
            assert (named in result.message) == (side != 0), told
    assert result.status != "step_bound" or "max_step" in case.options, told
    assert result.status != "deadline" or "deadline" in case.options, told


def where(mask: Array) -> str:
    return f"{np.argwhere(mask)[:3].tolist()} of {int(mask.sum())}"


if __name__ == "__main__":
    sys.exit(main())
