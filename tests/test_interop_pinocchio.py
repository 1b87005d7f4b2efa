"""The Pinocchio model of a chain is that chain: poses, Jacobians, limits, masses."""

from types import SimpleNamespace

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import strategies as st

import thing_kin as tk
from oracles import REFERENCES, assert_close
from strategies import Case, cases, poses
from thing_kin import interop

ROBOTS = [
    tk.robots.thing(),
    tk.robots.thing(order="base_first"),
    tk.robots.pioneer_lx_ur5(tk.transform(xyz=(0.1, 0.2, 0.3), rpy=(0.4, 0.5, 0.6))),
    tk.robots.ur5(),
    tk.robots.ur10().with_tool(tk.transform(xyz=(0.1, 0.0, 0.2), rpy=(0.0, 1.0, 0.0))),
]


def assert_same(robot: tk.Chain, q: np.ndarray) -> None:
    """Of all frames. Some ten metres and ten products, each off by a rounding: below 1e-13."""
    same = interop.to_pinocchio(robot)
    data = same.model.createData()
    pin.framesForwardKinematics(same.model, data, same.q(q))
    assert tuple(same.frames) == robot.frames
    for frame in robot.frames:
        at = same.frame_id(frame)
        assert_close(data.oMf[at].homogeneous, robot.fk(q, frame), atol=1e-12)
        for name, reference in REFERENCES.items():
            J = pin.computeFrameJacobian(same.model, data, same.q(q), at, reference)
            J = same.from_v(J.reshape(6, robot.n))  # of a single joint Pinocchio drops the axis
            assert_close(J, robot.jacobian(q, name, of=frame), atol=1e-12)


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: robot.name)
def test_robots(robot: tk.Chain) -> None:
    for q in [np.zeros(robot.n), *robot.random(5, rng=1)]:
        assert_same(robot, q)


@given(case=cases())
def test_random_chains(case: Case) -> None:
    assert_same(case.chain, case.q)


@given(case=cases(6), mount=poses(), order=st.sampled_from(["arm_first", "base_first"]))
def test_random_arms_on_a_base(case: Case, mount: np.ndarray, order: str) -> None:
    robot = tk.on_omni_base(case.chain, mount, order=order)
    assert_same(robot, np.random.default_rng(0).uniform(-2.0, 2.0, robot.n))


def upper_velocity(model: pin.Model) -> np.ndarray:
    name = "upperVelocityLimit" if hasattr(model, "upperVelocityLimit") else "velocityLimit"
    return getattr(model, name)


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: robot.name)
def test_names_and_limits(robot: tk.Chain) -> None:
    same = interop.to_pinocchio(robot)
    assert [robot.names[place] for place in same.order] == list(same.model.names)[1:]
    np.testing.assert_array_equal(same.from_q(same.model.lowerPositionLimit), robot.lower)
    np.testing.assert_array_equal(same.from_q(same.model.upperPositionLimit), robot.upper)
    np.testing.assert_array_equal(same.from_v(upper_velocity(same.model)), robot.velocity_limits)
    for name, index in same.frames.items():
        frame = same.model.frames[index]
        assert (frame.name, frame.type) == (name, pin.FrameType.OP_FRAME)


@pytest.mark.parametrize("robot", ROBOTS[:2], ids=["arm_first", "base_first"])
def test_orders_there_and_back(robot: tk.Chain) -> None:
    same = interop.to_pinocchio(robot)
    assert list(same.model.names)[1:] == ["x", "y", "theta", *(f"q{i}" for i in range(6))]
    Q = robot.random(4, rng=2)
    for there, back in ((same.q, same.from_q), (same.v, same.from_v)):
        np.testing.assert_array_equal(back(there(Q)), Q)
        np.testing.assert_array_equal(there(Q)[2], there(Q[2]))
        np.testing.assert_array_equal(there(Q)[:, 0], Q[:, robot.names.index("x")])
        assert there(np.empty((0, 9))).shape == (0, 9)


def test_a_continuous_joint_has_its_angle_as_q() -> None:
    arm = tk.robots.ur5()
    free = np.full(6, np.inf)
    public = {name: getattr(arm, name) for name in dir(arm) if not name.startswith("_")}
    public |= {"joint_types": ("continuous",) * 6, "lower": -free, "upper": free}
    same = interop.to_pinocchio(SimpleNamespace(**public))
    assert same.model.nq == same.model.nv == 6
    np.testing.assert_array_equal(same.model.upperPositionLimit, free)
    data, q = same.model.createData(), arm.random(rng=3) + 2000 * np.pi
    pin.framesForwardKinematics(same.model, data, same.q(q))
    assert_close(data.oMf[same.frame_id()].homogeneous, arm.fk(q), atol=1e-12)


def test_two_links_mass_matrix_and_weight() -> None:
    """Textbook arm in a vertical plane: links a1, a2 with mass centers at c1, c2."""
    a1, a2, c1, c2, m1, m2, i1, i2 = 0.7, 0.5, 0.3, 0.2, 2.0, 1.5, 0.04, 0.03
    upright = tk.DH(alpha=np.pi / 2)  # joints about the horizontal -y
    rows = [upright, *(tk.DH(a=a, joint="revolute", frame=f"link{a}") for a in (a1, a2))]
    arm = tk.Chain.from_dh(rows)
    bodies = {
        f"link{a1}": (m1, (c1 - a1, 0.0, 0.0), np.diag([0.01, i1, i1])),
        f"link{a2}": (m2, (c2 - a2, 0.0, 0.0), np.diag([0.01, i2, i2])),
        "world": (100.0, (0.0, 0.0, 0.0), np.eye(3)),  # moves with nothing
    }
    same = interop.to_pinocchio(arm, inertias=bodies)
    data = same.model.createData()
    for q in arm.random(5, rng=4):
        c = m2 * a1 * c2 * np.cos(q[1])
        m22 = i2 + m2 * c2**2
        m11 = i1 + m1 * c1**2 + m2 * a1**2 + m22 + 2 * c
        M = pin.crba(same.model, data, same.q(q))
        assert_close(np.triu(M), [[m11, m22 + c], [0.0, m22]], atol=1e-13)
        g2 = 9.81 * m2 * c2 * np.cos(q.sum())
        g1 = 9.81 * (m1 * c1 + m2 * a1) * np.cos(q[0]) + g2
        weight = pin.rnea(same.model, data, same.q(q), np.zeros(2), np.zeros(2))
        assert_close(same.from_v(weight), [g1, g2], atol=1e-13)


BODY = (1.0, (0.0, 0.0, 0.0), np.eye(3))


@pytest.mark.parametrize(
    ("inertias", "said"),
    [
        ({"elbow": BODY}, "inertias: got a frame 'elbow'"),
        ({"tool": 1.0}, "inertias['tool']: got 1.0"),
        ({"tool": (-1.0, *BODY[1:])}, "inertias['tool']: got a mass of -1"),
        ({"tool": (np.nan, *BODY[1:])}, "inertias['tool']: got a mass of nan"),
        ({"tool": (1.0, (0.0, 0.0), np.eye(3))}, "inertias['tool'] center: got shape (2,)"),
        ({"tool": (1.0, np.eye(3), np.eye(3))}, "inertias['tool'] center: got shape (3, 3)"),
        ({"tool": (1.0, (0, 0, 0), (1, 1, 1))}, "inertias['tool'] inertia: got shape (3,)"),
        ({"tool": (1.0, (0, 0, 0), -np.eye(3))}, "inertias['tool'] inertia: got a principal"),
        ({"tool": (1.0, (0, 0, 0), np.triu(np.ones((3, 3))))}, "inertias['tool'] inertia: got an"),
        (
            {"tool": (1.0, (0, 0, 0), np.full((3, 3), np.inf))},
            "inertias['tool'] inertia: got NaN or",
        ),
    ],
)
def test_what_is_no_rigid_body(inertias: dict, said: str) -> None:
    with pytest.raises(ValueError, match="expected") as error:
        interop.to_pinocchio(tk.robots.ur5(), inertias=inertias)
    assert str(error.value).startswith(said)


@pytest.mark.parametrize("bad", [np.zeros(8), np.zeros((2, 8)), np.full(9, np.nan), "abc", None])
def test_what_is_no_configuration(bad: object) -> None:
    same = interop.to_pinocchio(tk.robots.thing())
    for call, name in ((same.q, "q"), (same.v, "qd"), (same.from_q, "q"), (same.from_v, "v")):
        with pytest.raises(ValueError, match=rf"^{name}: got .*, expected "):
            call(bad)
    with pytest.raises(ValueError, match=r"^name: got 'elbow', expected one of world, "):
        same.frame_id("elbow")
