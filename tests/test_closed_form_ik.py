"""ik_all: nothing missing, nothing wrong, nothing twice; and what it says if there is nothing."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import thing_kin as tk
from closed_form_arms import ARMS, KR, PUMA, RIGHT, brute_force, chain, nearest, wrapped
from strategies import seeds

EXACT = 1e-9  # m and rad, what `exact` promises


def assert_right(arm: tk.Chain, T: np.ndarray, found: tk.IkSolutions, atol: float = EXACT) -> None:
    """Solved, every solution by another road than ik_all's own check, and no two alike."""
    assert found.status == "solved"
    assert found.exact.all()
    q = np.asarray(found)
    error = np.abs(arm.fk(q) - T).max() if len(q) else np.inf
    assert error <= atol * max(1.0, np.abs(T).max())
    assert (q >= arm.lower).all()
    assert (q <= arm.upper).all()
    for a, b in itertools.combinations(q, 2):
        assert np.abs(wrapped(a - b)).max() > 1e-7


@pytest.mark.parametrize("kind", ARMS)
@given(seed=seeds)
def test_what_made_the_target_is_among_the_solutions(kind: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    arm = ARMS[kind](rng)
    assert tk.has_closed_form(arm)
    q = rng.uniform(-np.pi, np.pi, 6)
    T = arm.fk(q)
    found = tk.ik_all(arm, T)
    assert_right(arm, T, found)
    # Near a double root the root's error is that of the square root of rounding.
    smallest = np.linalg.svd(arm.jacobian(q), compute_uv=False)[-1]
    assert nearest(q, found.q) < min(1e-6, 1e-10 / smallest) + 1e-11


@pytest.mark.parametrize("kind", ARMS)
def test_brute_force_finds_the_same(kind: str) -> None:
    rng = np.random.default_rng(5)
    for _ in range(3):
        arm = ARMS[kind](rng)
        T = arm.fk(rng.uniform(-np.pi, np.pi, 6))
        found = wrapped(tk.ik_all(arm, T).q)
        known = brute_force(arm, T, rng)
        assert len(known) == len(found)
        for q in known:
            assert nearest(q, found) < 1e-7


def test_eaik_finds_the_same() -> None:
    dh = pytest.importorskip("eaik.IK_DH")
    rng = np.random.default_rng(8)
    d = np.array([0.1273, 0, 0, 0.163941, 0.1157, 0.0922])
    a = np.array([0, -0.612, -0.5723, 0, 0, 0])
    eaik = dh.DhRobot(np.array([1, 0, 0, 1, -1, 0]) * RIGHT, a, d)
    arm = tk.robots.ur10()
    for _ in range(50):
        T = arm.fk(rng.uniform(-np.pi, np.pi, 6))
        theirs = eaik.IK(T)
        good = [np.abs(arm.fk(q) - T).max() < 1e-6 for q in theirs.Q]
        found = tk.ik_all(arm, T)
        assert len(found) == sum(good)
        for q in theirs.Q[good]:
            assert nearest(q, found.q) < 1e-6


@given(seed=seeds, kind=st.sampled_from(("ur5", "puma", "wrist", "parallel_askew")))
def test_rounded_dimensions_are_polished(seed: int, kind: str) -> None:
    """Angles and lengths with the error of a URDF file: of the class but for that."""
    rng = np.random.default_rng(seed)
    arm = ARMS[kind](rng)
    by = tk.transform(xyz=rng.uniform(-1e-8, 1e-8, 3), rpy=rng.uniform(-1e-8, 1e-8, 3))
    bent = bend(arm, by)
    assert tk.has_closed_form(bent)
    q = rng.uniform(-np.pi, np.pi, 6)
    T = bent.fk(q)
    found = tk.ik_all(bent, T)
    assert_right(bent, T, found)
    smallest = np.linalg.svd(bent.jacobian(q), compute_uv=False)[-1]
    if smallest > 1e-2:  # else the branch may have met its neighbor in the idealized arm
        assert nearest(q, found.q) < 1e-6


def bend(arm: tk.Chain, by: np.ndarray) -> tk.Chain:
    """The arm with each joint's frame moved by `by` in the one before: read back from URDF."""
    links = "".join(f'<link name="l{i}"/>' for i in range(14))
    text = ""
    frames = arm.fk_all(np.zeros(6))
    for i, name in enumerate(arm.names):
        step = np.linalg.inv(frames[i]) @ frames[i + 1]
        text += urdf_joint(name, f"l{2 * i}", f"l{2 * i + 1}", "continuous", by)
        text += urdf_joint(f"f{i}", f"l{2 * i + 1}", f"l{2 * i + 2}", "fixed", step)
    text += urdf_joint("end", "l12", "l13", "fixed", np.eye(4))
    return tk.Chain.from_urdf(f'<robot name="bent">{links}{text}</robot>', tip="l13")


def urdf_joint(name: str, parent: str, child: str, kind: str, T: np.ndarray) -> str:
    xyz = " ".join(map(repr, T[:3, 3].tolist()))
    rpy = " ".join(map(repr, tk.lie.rpy_from_rotation(T[:3, :3]).tolist()))
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="0 0 1"/></joint>'
    )


class TestSingularities:
    """Each at 0 and at three distances, one of which is within rounding of its square root."""

    OFF = (0.0, 1e-12, 1e-9, 1e-6, 1e-3)

    @pytest.mark.parametrize("off", OFF)
    @pytest.mark.parametrize(("joint", "at"), [(4, 0.0), (4, np.pi), (2, 0.0), (2, np.pi)])
    def test_of_wrist_and_elbow(self, joint: int, at: float, off: float) -> None:
        rng = np.random.default_rng(11)
        arm = tk.robots.ur10()
        name = "wrist" if joint == 4 else "elbow"
        for _ in range(20):
            q = rng.uniform(-3, 3, 6)
            q[joint] = at + off
            T = arm.fk(q)
            found = tk.ik_all(arm, T, seed=q)
            assert_right(arm, T, found)
            assert np.abs(wrapped(found[0] - q)).max() < 1e-4
            assert (found.singular[0] == name) == (off < 1e-6) or off == 1e-6

    def test_joint_6_stays_at_the_seed_where_4_and_6_turn_about_one_axis(self) -> None:
        rng = np.random.default_rng(12)
        for arm in (tk.robots.ur5(), chain(PUMA), chain(KR)):
            for _ in range(20):
                q, seed = rng.uniform(-3, 3, (2, 6))
                q[4] = 0.0
                T = arm.fk(q)
                found = tk.ik_all(arm, T, seed=seed)
                assert_right(arm, T, found)
                at = [i for i, s in enumerate(found.singular) if s == "wrist"]
                assert at
                assert nearest(q[[0, 4]], found.q[:, [0, 4]]) < 1e-7
                stretched = np.abs(np.sin(found.q[at, 2])) < 1e-6
                stays = np.abs(found.q[at, 5] - seed[5]) < 1e-9
                # A UR's joint 6 moves the elbow then, and may do so only as far as that goes.
                assert (stays | stretched).all() if arm.name == "ur5" else stays.all()

    @pytest.mark.parametrize("off", OFF)
    def test_of_the_shoulder(self, off: float) -> None:
        """UR: the wrist's center as far from axis 1 as joint 4 stands off it; two branches meet."""
        arm = tk.robots.ur10()
        d4, d6 = 0.163941, 0.0922
        for angle in (0.3, 1.7, -2.0):
            R = tk.lie.so3_exp(np.array([0.4, 1.1, angle]))
            T = np.eye(4)
            T[:3, :3] = R
            radius = d4 + off
            T[:3, 3] = [radius * np.cos(angle), radius * np.sin(angle), 0.6] + d6 * R[:, 2]
            found = tk.ik_all(arm, T)
            assert_right(arm, T, found)
            if off == 0.0:
                assert found.singular[0] == "shoulder"

    def test_joint_1_stays_at_the_seed_where_the_wrist_is_on_its_axis(self) -> None:
        rows = [row[:] for row in KR]
        arm = chain(rows)
        seed = np.array([0.7, 0.1, 0.2, 0.3, 0.4, 0.5])
        T = np.eye(4)
        T[:3, :3] = tk.lie.so3_exp(np.array([0.3, -0.2, 0.9]))
        tool = np.linalg.inv(arm.fk(np.zeros(6))) @ arm.fk(np.zeros(6), frame=5)
        T[:3, 3] = [0.0, 0.0, 2.1] - T[:3, :3] @ tool[:3, 3]
        found = tk.ik_all(arm, T, seed=seed)
        assert_right(arm, T, found)
        assert "shoulder" in found.singular
        assert found[0][0] == pytest.approx(0.7, abs=1e-12)

    def test_folded_elbow_of_equal_links(self) -> None:
        rows = [[0.1, 0, 0, RIGHT], [0, 0, 0.5, 0], [0, 0, 0.5, 0]]
        rows += [[0.1, 0, 0, RIGHT], [0.1, 0, 0, -RIGHT], [0.1, 0, 0, 0]]
        arm = chain(rows)
        seed = np.array([0.2, 0.9, 2.5, 0.1, 0.8, 0.3])
        for off in self.OFF:
            q = np.array([0.2, 0.4, np.pi - off, 0.6, 0.8, 0.1])
            found = tk.ik_all(arm, arm.fk(q), seed=seed)
            assert_right(arm, arm.fk(q), found)
            if off == 0.0:
                folded = found.q[[s == "elbow" for s in found.singular]]
                assert np.abs(folded[:, 1] - seed[1]).min() < 1e-12


class TestReach:
    @pytest.mark.parametrize("off", [-1e-6, -1e-9, -1e-12, 0.0, 1e-12])
    def test_up_to_the_boundary(self, off: float) -> None:
        arm = tk.robots.ur10()
        q = np.array([0.3, -0.8, 0.0, -0.6, 1.2, 0.4])
        T = arm.fk(q)
        outward = arm.fk(q, frame="wrist_1")[:3, 3] - arm.fk(q, frame="shoulder")[:3, 3]
        outward -= (
            outward @ arm.fk(q, frame="upper_arm")[:3, 2] * arm.fk(q, frame="upper_arm")[:3, 2]
        )
        T[:3, 3] += off * outward / np.linalg.norm(outward)
        assert_right(arm, T, tk.ik_all(arm, T))

    @pytest.mark.parametrize("off", [1e-7, 1e-3, 0.1, 10.0])
    def test_beyond_the_closest_is_said_to_be_off(self, off: float) -> None:
        arm = tk.robots.ur10()
        q = np.array([0.3, -0.8, 0.0, -0.6, 1.2, 0.4])
        T = arm.fk(q)
        outward = arm.fk(q, frame="wrist_1")[:3, 3] - arm.fk(q, frame="shoulder")[:3, 3]
        outward -= (
            outward @ arm.fk(q, frame="upper_arm")[:3, 2] * arm.fk(q, frame="upper_arm")[:3, 2]
        )
        T[:3, 3] += off * outward / np.linalg.norm(outward)
        found = tk.ik_all(arm, T)
        assert found.status == "unreachable"
        assert len(found) >= 1
        assert not found.exact.any()
        assert "unreachable" in found.message
        error = tk.pose_error(arm.fk(found.q), T)
        np.testing.assert_allclose(
            found.position_error, np.linalg.norm(error[:, :3], axis=1), rtol=1e-6
        )
        assert (np.linalg.norm(error, axis=1) <= off * (1 + 1e-9)).all()

    @pytest.mark.parametrize("kind", ["ur10", "puma", "wrist"])
    def test_the_closest_is_closest(self, kind: str) -> None:
        """Against many starts of SciPy's least squares."""
        least_squares = pytest.importorskip("scipy.optimize").least_squares
        rng = np.random.default_rng(3)
        arm = ARMS[kind](rng)
        for _ in range(2):
            T = arm.fk(rng.uniform(-3, 3, 6))
            T[:3, 3] *= 1.5 * 2.5 / np.linalg.norm(T[:3, 3])
            found = tk.ik_all(arm, T)
            assert found.status == "unreachable"

            def error(q: np.ndarray, T: np.ndarray = T) -> np.ndarray:
                return tk.pose_error(arm.fk(q), T)

            ours = np.linalg.norm(error(found[0]))
            theirs = min(
                np.sqrt(2 * least_squares(error, start).cost)
                for start in rng.uniform(-3, 3, (40, 6))
            )
            assert ours <= theirs * 1.001

    def test_far_away_is_finite(self) -> None:
        for distance in (50.0, 1e6, 1e40):
            found = tk.ik_all(tk.robots.ur5(), tk.transform(xyz=(0, distance, 0)))
            assert found.status == "unreachable"
            assert np.isfinite(found.q).all()


class TestLimits:
    def test_images_are_complete(self) -> None:
        rng = np.random.default_rng(2)
        limits = {"lower": [-6, -4, -7, -1, -6.5, -2], "upper": [6, 5, 1, 6.2, 6.5, 9]}
        arm = tk.robots.ur5().with_limits(**limits)
        turns = 2 * np.pi * np.array(list(itertools.product((-2, -1, 0, 1, 2), repeat=6)))
        for _ in range(10):
            T = arm.fk(rng.uniform(-np.pi, np.pi, 6))
            branches = tk.ik_all(arm, T, respect_limits=False).q
            every = (wrapped(branches)[:, None] + turns).reshape(-1, 6)
            every = every[((every >= arm.lower) & (every <= arm.upper)).all(axis=1)]
            found = tk.ik_all(arm, T, images=True)
            assert len(found) == len(every)
            assert found.exact.all()
            order = [np.lexsort(q.round(6).T) for q in (found.q, every)]
            np.testing.assert_allclose(found.q[order[0]], every[order[1]], atol=1e-9)

    def test_512_of_a_ur(self) -> None:
        arm = tk.robots.ur10()
        T = arm.fk(np.array([0.1, -1.2, 1.4, -0.6, 1.2, 0.3]))
        found = tk.ik_all(arm, T, images=True, seed=np.zeros(6))
        assert len(found) == 512
        far = np.linalg.norm(found.q, axis=1)
        assert (np.diff(far) >= -1e-12).all()

    def test_another_turn_is_tried_before_a_branch_is_left_out(self) -> None:
        q = np.array([4.0, -1.2, 1.4, -0.6, 1.2, 0.3])
        arm = tk.robots.ur10().with_limits(lower=q - 0.1, upper=q + 0.1)
        found = tk.ik_all(arm, arm.fk(q))
        assert len(found) == 1
        np.testing.assert_allclose(found[0], q, atol=1e-9)
        assert found.message == "1 solution, 7 more beyond limits"

    def test_at_a_limit_exactly(self) -> None:
        rng = np.random.default_rng(4)
        for _ in range(100):
            q = rng.uniform(-3, 3, 6)
            arm = tk.robots.ur10().with_limits(lower=q, upper=q + rng.uniform(0, 1, 6))
            found = tk.ik_all(arm, arm.fk(q))
            assert_right(arm, arm.fk(q), found)

    def test_beyond_every_limit_says_so(self) -> None:
        q = np.array([4.0, -1.2, 1.4, -0.6, 1.2, 0.3])
        arm = tk.robots.ur10().with_limits(lower=q + 0.25, upper=q + 1.0)
        found = tk.ik_all(arm, arm.fk(q))
        assert len(found) == 0
        assert found.q.shape == (0, 6)
        assert found.status == "outside_limits"
        assert "0.25 rad beyond a limit of joint 'q" in found.message
        assert len(tk.ik_all(arm, arm.fk(q), respect_limits=False)) == 8

    def test_continuous_joints_stay_near_the_seed(self) -> None:
        arm = chain(PUMA)
        q = np.array([0.1, 0.4, 1.4, -0.6, 1.2, 0.3])
        seed = q + 2 * np.pi * np.array([3, -2, 0, 5, 1, -7])
        found = tk.ik_all(arm, arm.fk(q), seed=seed)
        np.testing.assert_allclose(found[0], seed, atol=1e-9)

    @given(seed=seeds)
    def test_sorted_by_the_distance_to_the_seed(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        arm = tk.robots.ur5()
        q, near = rng.uniform(-np.pi, np.pi, (2, 6))
        weights = rng.uniform(0, 2, 6)
        found = tk.ik_all(arm, arm.fk(q), seed=near)
        assert (np.diff(np.linalg.norm(found.q - near, axis=1)) >= -1e-12).all()
        found = tk.ik_all(arm, arm.fk(q), seed=near, weights=weights)
        assert (np.diff((weights * (found.q - near) ** 2).sum(axis=1)) >= -1e-12).all()


class TestBase:
    @pytest.mark.parametrize("order", ["arm_first", "base_first"])
    @pytest.mark.parametrize("away", [0.0, 10.0, 100.0])
    def test_the_thing(self, order: str, away: float) -> None:
        rng = np.random.default_rng(6)
        limits = [(-200.0, 200.0), (-200.0, 200.0), (-np.pi, np.pi)]
        robot = tk.robots.thing(order=order, base_limits=limits)
        base = slice(6, 9) if order == "arm_first" else slice(0, 3)
        for _ in range(20):
            q = rng.uniform(-np.pi, np.pi, 9)
            q[base][:2] += away
            T = robot.fk(q)
            found = tk.ik_all(robot, T, base=q[base], seed=q)
            assert found.q.shape[1] == 9
            assert (found.q[:, base] == q[base]).all()
            assert_right(robot, T, found, atol=1e-13)
            assert np.abs(found[0] - q).max() < 1e-7

    def test_moving_base_and_target_changes_nothing(self) -> None:
        rng = np.random.default_rng(7)
        robot = tk.robots.thing()
        q = rng.uniform(-1, 1, 9)
        here = tk.ik_all(robot, robot.fk(q), base=q[6:])
        moved = np.array([0.7, -1.3, 0.9])
        by = tk.robots.thing().fk(np.r_[np.zeros(6), moved], frame="base")
        back = robot.fk(np.r_[np.zeros(6), q[6:]], frame="base")
        there = tk.ik_all(robot, by @ np.linalg.inv(back) @ robot.fk(q), base=moved)
        np.testing.assert_allclose(here.q[:, :6], there.q[:, :6], atol=1e-9)

    def test_of_a_tool_and_mount(self) -> None:
        rng = np.random.default_rng(9)
        tool = tk.transform(xyz=(0.1, -0.2, 0.3), rpy=(1, 2, 3))
        for kind in ("ur5", "kr", "spherical_shoulder", "parallel_345"):
            arm = ARMS[kind](rng).with_tool(tool)
            robot = tk.on_omni_base(arm, tk.transform(xyz=(0.3, 0.1, 0.5), rpy=(0.1, 0.2, 3)))
            q = rng.uniform(-3, 3, 9)
            found = tk.ik_all(robot, robot.fk(q), base=q[6:])
            assert_right(robot, robot.fk(q), found)
            assert nearest(q[:6], found.q[:, :6]) < 1e-7


class TestTarget:
    def test_seven_digits_of_a_rotation_do(self) -> None:
        arm = tk.robots.ur10()
        T = arm.fk(np.array([0.1, -1.2, 1.4, -0.6, 1.2, 0.3])).round(7)
        found = tk.ik_all(arm, T)
        assert len(found) == 8
        assert found.exact.all()
        assert np.abs(arm.fk(found.q) - T).max() < 2e-7

    def test_another_frame_of_the_last_link(self) -> None:
        arm = tk.robots.ur5().with_tool(tk.transform(xyz=(0, 0, 0.2)), frame="gripper")
        q = np.array([0.1, -1.2, 1.4, -0.6, 1.2, 0.3])
        inner = tk.ik_all(arm, arm.fk(q, frame="tool"), frame="tool")
        outer = tk.ik_all(arm, arm.fk(q), frame="gripper")
        np.testing.assert_allclose(inner.q, outer.q, atol=1e-9)


class TestRefused:
    T = tk.transform()

    @pytest.mark.parametrize(
        ("rows", "why"),
        [
            (7, "7 arm joints: more than six"),
            (5, "5 arm joints: fewer than six"),
        ],
    )
    def test_the_number_of_joints(self, rows: int, why: str) -> None:
        arm = chain([[0.1, 0, 0.2, RIGHT]] * rows)
        assert not tk.has_closed_form(arm)
        with pytest.raises(ValueError, match=f"^chain: got {why}"):
            tk.ik_all(arm, self.T)

    def test_what_is_of_no_class_says_by_how_much(self) -> None:
        arm = chain([[0.1, 0.0, 0.2, 1.0]] * 6)
        with pytest.raises(ValueError, match=r"^chain: got axes 2, 3, 4 off parallel by 0\.9"):
            tk.ik_all(arm, self.T)

    def test_a_prismatic_joint(self) -> None:
        rows = [tk.DH(a=0.1, alpha=1.0, joint="revolute") for _ in range(5)]
        arm = tk.Chain.from_dh([*rows, tk.DH(joint="prismatic")])
        with pytest.raises(ValueError, match=r"^chain: got a prismatic arm joint"):
            tk.ik_all(arm, self.T)

    @pytest.mark.parametrize(
        "change",
        [
            {(2, 2): 0.0},  # axes 3 and 4 the same
            {(4, 3): 0.0, (4, 2): 0.0},  # axes 5 and 6 the same
            {(0, 3): 0.0},  # axes 1-4 parallel
            {(3, 3): 0.0},  # axes 2-5 parallel
        ],
    )
    def test_what_is_singular_everywhere(self, change: dict[tuple[int, int], float]) -> None:
        rows = [[0.1273, 0, 0, RIGHT], [0, 0, -0.612, 0], [0, 0, -0.5723, 0]]
        rows += [[0.163941, 0, 0, RIGHT], [0.1157, 0, 0, -RIGHT], [0.0922, 0, 0, 0]]
        for (row, column), value in change.items():
            rows[row][column] = value
        arm = chain(rows)
        q = np.random.default_rng(1).uniform(-3, 3, 6)
        assert np.linalg.svd(arm.jacobian(q), compute_uv=False)[-1] < 1e-12
        assert not tk.has_closed_form(arm)

    def test_a_calibrated_arm_is_of_no_class(self) -> None:
        nominal = {
            "shoulder": (0, 0, 0.0892, 0, 0, 0),
            "upper_arm": (0, 0, 0, RIGHT, 0, 0),
            "forearm": (-0.425, 0, 0, 0, 0, 0),
            "wrist_1": (-0.392, 0, 0.109, 0, 0, 0),
            "wrist_2": (0, -0.0947, 0, RIGHT, 0, 0),
            "wrist_3": (0, 0.0823, 0, RIGHT, np.pi, np.pi),
        }
        keys = ("x", "y", "z", "roll", "pitch", "yaw")

        def calibration(error: float) -> dict[str, dict[str, dict[str, float]]]:
            origins = {link: dict(zip(keys, o, strict=True)) for link, o in nominal.items()}
            origins["forearm"]["roll"] += error
            return {"kinematics": origins}

        assert tk.has_closed_form(tk.robots.ur5(calibration(0.0)))
        assert tk.has_closed_form(tk.robots.ur5(calibration(1e-7)))
        with pytest.raises(ValueError, match=r"^chain: got axes 2, 3, 4 off parallel by 0\.001 "):
            tk.ik_all(tk.robots.ur5(calibration(1e-3)), self.T)

    def test_arguments(self) -> None:
        arm, robot = tk.robots.ur5(), tk.robots.thing()
        for call, name in [
            (lambda: tk.ik_all(arm, np.eye(3)), "target"),
            (lambda: tk.ik_all(arm, 2 * np.eye(4)), "target"),
            (lambda: tk.ik_all(arm, self.T, seed=np.zeros(5)), "seed"),
            (lambda: tk.ik_all(arm, self.T, base=(0, 0, 0)), "base"),
            (lambda: tk.ik_all(robot, self.T), "base"),
            (lambda: tk.ik_all(robot, self.T, base=(0, 0)), "base"),
            (lambda: tk.ik_all(robot, self.T, base=(7, 0, 0)), "base"),
            (lambda: tk.ik_all(arm, self.T, frame="nowhere"), "frame"),
            (lambda: tk.ik_all(arm, self.T, weights=-np.ones(6)), "weights"),
            (lambda: tk.ik_all(arm, self.T, images=True, respect_limits=False), "images"),
        ]:
            with pytest.raises(ValueError, match=f"^{name}: got .*expected"):
                call()
        wide = arm.with_limits(lower=[-1e4] * 6, upper=[1e4] * 6)
        with pytest.raises(ValueError, match=r"^images: got"):
            tk.ik_all(wide, arm.fk(np.ones(6)), images=True)


def test_the_result_is_a_sequence() -> None:
    arm = tk.robots.ur5()
    found = tk.ik_all(arm, arm.fk(np.ones(6)))
    assert len(found) == len(list(found)) == len(found.q)
    np.testing.assert_array_equal(np.array(list(found)), np.asarray(found))
    np.testing.assert_array_equal(found[-1], found.q[-1])
    np.testing.assert_array_equal(found[1:3], found.q[1:3])
    assert np.asarray(found, dtype=np.float32).dtype == np.float32
    assert found.position_error.shape == found.exact.shape == (len(found),)
    assert repr(found) == f"IkSolutions({found.message})"
    with pytest.raises(IndexError):
        found[len(found)]
    with pytest.raises(ValueError, match=r"^copy: got"):
        np.array(found, copy=False)


def test_the_same_every_time() -> None:
    arm = tk.robots.ur5()
    T = arm.fk(np.ones(6))
    np.testing.assert_array_equal(tk.ik_all(arm, T).q, tk.ik_all(arm, T).q)
