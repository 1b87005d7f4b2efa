"""Finite numbers whose squares are not: a right answer or a ValueError, never NaN or nonsense."""

import subprocess
import sys

import numpy as np
import pytest

import thing_kin as tk
from thing_kin import lie

HUGE = [1e100, 1e160, 1e300]
TWISTS = [name for name in lie.__all__ if "exp" in name or "jacobian" in name]


def refused_or(call, right) -> None:
    try:
        result = call()
    except ValueError as error:
        said = str(error)
    else:
        assert right(result), result
        return
    assert "got" in said
    assert "expected" in said


@pytest.mark.parametrize("size", HUGE)
@pytest.mark.parametrize("name", TWISTS)
def test_rotation_vectors_and_twists(name: str, size: float) -> None:
    for count in (1, 3 if name.startswith("so3") else 6):
        argument = np.full(3 if name.startswith("so3") else 6, 0.1)
        argument[-count:] = size
        refused_or(lambda v=argument: getattr(lie, name)(v), lambda M: np.isfinite(M).all())


@pytest.mark.parametrize("size", [1e-11, 1.0, *HUGE])
def test_quaternions_are_normalized(size: float) -> None:
    quaternion = size * np.array([1.0, 2.0, -3.0, 4.0])
    right = lie.rotation_from_quaternion([1.0, 2.0, -3.0, 4.0])
    for call in (
        lambda: lie.rotation_from_quaternion(quaternion),
        lambda: tk.transform(quaternion=quaternion)[:3, :3],
    ):
        refused_or(call, lambda R: np.allclose(R, right, atol=1e-14))


@pytest.mark.parametrize("size", HUGE)
def test_inverses(size: float) -> None:
    A = size * np.array([[1.0, 1.0], [1.0, -1.0]])
    inverse = np.array([[0.5, 0.5], [0.5, -0.5]])
    np.testing.assert_allclose(tk.pinv(A) * size, inverse, atol=1e-15)
    np.testing.assert_allclose(tk.pinv(A, damping=1.0) * size, inverse, atol=1e-15)
    np.testing.assert_allclose(
        tk.filter_singular_values(A, sigma0=0.01, nu=10.0) / size, A / size, rtol=1e-15
    )
    step = tk.selectively_damped_step(A, [0.2 * size, 0.1 * size])
    np.testing.assert_allclose(step, [0.15, 0.05], rtol=1e-14)


@pytest.mark.parametrize("size", [1e6, *HUGE])
@pytest.mark.parametrize(
    "method", ["fk", "jacobian", "hessian", "task_vector", "analytic_jacobian", "task_jacobian"]
)
def test_configurations(method: str, size: float) -> None:
    call = getattr(tk.robots.thing(), method)
    refused_or(lambda: call(np.full(9, size)), lambda result: np.isfinite(result).all())


@pytest.mark.parametrize("frame", ["world_aligned", "body", "world"])
@pytest.mark.parametrize("size", [1e6, 1e50, *HUGE])
@pytest.mark.parametrize("method", ["jacobian_dot", "velocity", "drift", "acceleration"])
def test_motions(method: str, size: float, frame: str) -> None:
    robot, right = tk.robots.thing(), lambda result: np.isfinite(result).all()
    count = 3 if method == "acceleration" else 2
    good = [np.full(9, 0.3)] * count
    for huge in range(count):
        motion = [np.full(9, size) if i == huge else x for i, x in enumerate(good)]
        refused_or(lambda m=motion: getattr(robot, method)(*m, frame), right)
    everything = [np.full(9, size)] * count
    refused_or(lambda: getattr(robot, method)(*everything, frame, point=[size] * 3), right)


@pytest.mark.parametrize("size", [1e6, *HUGE])
def test_task_priority(size: float) -> None:
    robot = tk.robots.thing()
    for gain, base in ((1.0, [size, 0.0, 0.0]), (1e6, [0.1, 0.0, 0.0])):
        tasks = [tk.PoseTask(gain=gain), tk.BaseTask()]
        for scheme in ("nakamura", "chiaverini"):
            solver = tk.TaskPriority(robot, tasks, scheme=scheme)
            step = solver.step(np.linspace(-1, 1, 9), [np.eye(4), base])
            assert np.abs(step).max() <= 2 * np.pi / 4 * (1 + 1e-12)


@pytest.mark.parametrize("size", HUGE)
def test_gains_end_where_products_would_overflow(size: float) -> None:
    with pytest.raises(ValueError, match=r"^gain: got .*, expected a number > 0, at most 1e6"):
        tk.PoseTask(gain=size)


def test_extended_precision_beyond_double_is_no_crash() -> None:
    """The conversion to double overflows, which numpy reports as a warning, here an exception."""
    code = (
        "import warnings, numpy as np, thing_kin as tk\n"
        "warnings.simplefilter('error')\n"
        "try: tk.robots.ur5().fk(np.full(6, np.longdouble('1e4000')))\n"
        "except ValueError as error: assert str(error).startswith('q: got'), error\n"
        "else: raise AssertionError('taken')\n"
    )
    if np.finfo(np.longdouble).max < np.longdouble("1e4000"):
        pytest.skip("long double is double here")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
