"""The experiment of [X21] chapter 5: its filters, its figures, its independence of workers."""

from dataclasses import replace

import numpy as np
import pytest

import thing_kin as tk
from rmma_family import draw
from thing_kin import _search, rmma
from thing_kin import estimation as est
from thing_kin.rmma import reference

# Filter chain by hand: predict over dtb, repredict over dte (each adds Q), update.
P0, Q, R_HIT, R_FAIL = 1e-7, 6e-8, 4e-8, 4e-4
STEPS = [
    (17.5, 0.0, (0.348, 0.006), R_HIT),
    (17.0, 1.2, (0.703, 0.015), R_HIT),
    (10.5, 8.4, (1.05, 0.02), R_FAIL),
]
PREDICTED = [
    (0.35000000000000003, 0.0, 0.02, 0.0),
    (0.6860760887162052, 0.011771733851384168, 0.019886676380119796, 0.0003399708596406022),
    (0.907715659362397, 0.020233583667631203, 0.019496074988565346, 0.0004987025035387607),
]
PREDICTED_VARIANCES = [
    (3.0785000000000004e-05, 1.6e-07),
    (3.510029787922941e-05, 1.808418326048244e-07),
    (1.259227924817944e-05, 1.728802007933996e-07),
]
UPDATED = [
    (0.3480025902541687, 0.00599222923749393, 0.019886676380119796, 0.0003399708596406022),
    (0.7030068719824608, 0.014997207380474217, 0.019496074988565346, 0.0004987025035387607),
    (1.0693189393245608, 0.023977229119715008, 0.01936858510284354, 0.0004724559028613998),
]
UPDATED_COVARIANCE = (4.028825097190505e-05, 2.3738161296505814e-06, 2.172148714495167e-07)


def transition(dt: float) -> np.ndarray:
    F = np.eye(4)
    F[0, 2] = F[1, 3] = dt
    return F


def chain(kind: str) -> list[tuple[np.ndarray, np.ndarray]]:
    """(x, P) after each prediction and each update."""
    x, P, H = np.array([0, 0, 0.02, 0]), P0 * np.eye(4), np.eye(2, 4)
    if kind == "kf":
        kf = est.KalmanFilter(x, P)
    else:
        ukf = est.UnscentedKalmanFilter(x, P, alpha=1.0, beta=2.0, kappa=-1.0)
    out = []
    for dtb, dte, z, r in STEPS:
        for dt in (dtb, dte):
            F = transition(dt)
            if kind == "kf":
                kf.predict(F, Q * np.eye(4))
            else:
                ukf.predict(lambda x, F=F: F @ x, Q * np.eye(4))
            if dt == dtb:
                out.append((kf.x, kf.P) if kind == "kf" else (ukf.x, ukf.P))
        if kind == "kf":
            kf.update(z, H, r * np.eye(2))
        else:
            ukf.update(z, lambda x: x[:2], r * np.eye(2))
        out.append((kf.x, kf.P) if kind == "kf" else (ukf.x, ukf.P))
    return out


def test_filter_chain_to_the_oracles_digits() -> None:
    states = chain("kf")
    for k in range(3):
        x, P = states[2 * k]
        np.testing.assert_allclose(x, PREDICTED[k], rtol=1e-13, atol=1e-18)
        position, velocity = PREDICTED_VARIANCES[k]
        np.testing.assert_allclose(np.diag(P), (position, position, velocity, velocity), rtol=1e-12)
        np.testing.assert_allclose(states[2 * k + 1][0], UPDATED[k], rtol=1e-12, atol=1e-18)
    P = states[-1][1]
    a, b, c = UPDATED_COVARIANCE
    np.testing.assert_allclose(
        P, [[a, 0, b, 0], [0, a, 0, b], [b, 0, c, 0], [0, b, 0, c]], rtol=1e-11
    )


def test_unscented_filter_is_the_linear_one_for_known_intervals() -> None:
    for (x, P), (x_u, P_u) in zip(chain("kf"), chain("ukf"), strict=True):
        np.testing.assert_allclose(x_u, x, rtol=1e-13, atol=1e-17)
        np.testing.assert_allclose(P_u, P, rtol=1e-10, atol=1e-20)


def test_predicted_deviations() -> None:
    # sigma^2 = p0 (1 + (d / v)^2) + q, in mm, for 1 to 3 cm/s
    table = {
        0.2: (6.34, 4.24, 3.19, 2.56, 2.15),
        0.35: (11.08, 7.39, 5.55, 4.45, 3.71),
        0.99: (31.31, 20.87, 15.66, 12.53, 10.44),
        1.31: (41.43, 27.62, 20.72, 16.58, 13.81),
    }
    for distance, deviations in table.items():
        for velocity, expected in zip(
            rmma.run(2, "spiral", runs=1).velocities, deviations, strict=True
        ):
            kf = est.KalmanFilter(np.array([0, 0, velocity, 0]), P0 * np.eye(4))
            kf.predict(transition(distance / velocity), Q * np.eye(4))
            assert 1e3 * np.sqrt(kf.P[0, 0]) == pytest.approx(expected, abs=0.006)


@pytest.mark.parametrize(("t", "following"), [(14.0, 3), (20.0, 3), (26.0, 4), (30.0, 4)])
def test_which_fiducial_is_next(t: float, following: int) -> None:
    x = [0, 0.2, 0.43, 0.63, 0.88, 1.06]
    assert _search.next_fiducial(x, 2, 0.03 * t) == following
    assert _search.next_fiducial(x, 5, 0.03 * t) == 6


@pytest.mark.parametrize(("arrangement", "method", "config"), list(reference.READINGS))
def test_reproduces_the_reference(
    arrangement: int, method: rmma.Method, config: int | None
) -> None:
    result = rmma.run(arrangement, method, runs=200, rng=11, config=config)
    expected = reference.expected(arrangement, method, config)
    assert reference.is_met(result.interception_rate, result.search_time, expected), result


@pytest.mark.parametrize("arrangement", [1, 2, 3])
def test_the_ukf_falls_with_velocity(arrangement: int) -> None:
    rates = rmma.run(arrangement, "ukf", runs=300, rng=5).intercepted.mean((1, 2))
    assert rates[0] - rates[-1] > 0.05
    assert (np.diff(rates) < 0.02).all()


@pytest.mark.parametrize("arrangement", [1, 2, 3])
def test_the_covering_search_finds_them_all(arrangement: int) -> None:
    result = rmma.run(arrangement, "covering", runs=100, rng=17)
    assert (result.intercepted.mean((1, 2)) >= 0.995).all()
    assert (result.search_times.mean((1, 2)) <= 0.25).all()


@pytest.mark.parametrize(
    "name", ["drift x2", "creep 0.4 mm/s", "map error 5 mm", "map error 10 mm", "odometry error x4"]
)
def test_the_covering_search_in_other_worlds(name: str) -> None:
    world = rmma.named_worlds()[name]
    for arrangement in (1, 2, 3):
        result = rmma.run(arrangement, "covering", runs=30, rng=23, world=world)
        assert result.interception_rate >= 0.99


def test_odometry_seldom_or_never() -> None:
    rates = {}
    for odometry in ("continuous", "failure", "none"):
        result = rmma.run(1, "covering", runs=60, rng=2, odometry=odometry)  # type: ignore[arg-type]
        rates[odometry] = result.interception_rate, result.search_time
    assert min(rate for rate, _ in rates.values()) > 0.99
    assert rates["continuous"][1] < 0.3 * rates["failure"][1]


@pytest.mark.parametrize("method", ["spiral", "linear_kf", "ukf", "covering"])
def test_the_same_for_any_number_of_workers(method: rmma.Method) -> None:
    results = [rmma.run(3, method, runs=7, rng=9, workers=n) for n in (1, 2, 5, None)]
    for other in results[1:]:
        for name in ("intercepted", "searched", "search_times", "position_errors", "samples"):
            np.testing.assert_array_equal(getattr(other, name), getattr(results[0], name))


def test_runs_do_not_hang_on_how_many_there_are() -> None:
    few, many = (rmma.run(1, "ukf", (0.01, 0.02), runs=n, rng=3) for n in (5, 12))
    np.testing.assert_array_equal(few.search_times, many.search_times[:, :5])


class Wrapped:
    """A world of one's own that does what the library's does."""

    detection_radius = 0.012

    def __init__(self, world: rmma.World) -> None:
        self.world = world

    def start(self, velocity: float, side: np.ndarray, rng: np.random.Generator) -> "WrappedRun":
        return WrappedRun(self.world.start(velocity, side, rng))


class WrappedRun:
    def __init__(self, run: rmma.WorldRun) -> None:
        self.run = run

    def pose(self, t: float) -> np.ndarray:
        return np.array(self.run.pose(t))

    def odometry(self, t: float) -> list[float]:
        return list(self.run.odometry(t))

    def place(self, u_command: np.ndarray) -> list[np.ndarray]:
        return list(self.run.place(u_command))

    def detects(self, tool_xy: np.ndarray, fiducial: np.ndarray) -> np.bool_:
        return np.bool_(self.run.detects(tool_xy, fiducial))

    def move_time(self, a: np.ndarray, b: np.ndarray) -> float:
        return self.run.move_time(a, b)

    def sample_time(self, a: np.ndarray, b: np.ndarray) -> np.float64:
        return np.float64(self.run.sample_time(a, b))


@pytest.mark.parametrize("method", ["spiral", "linear_kf", "ukf", "covering"])
def test_a_world_of_ones_own_gives_the_same_for_the_same_numbers(method: rmma.Method) -> None:
    world = rmma.World(map_std=0.002, creep=1e-4)
    own = rmma.run(3, method, (0.01, 0.03), runs=3, rng=4, world=world)
    foreign = rmma.run(3, method, (0.01, 0.03), runs=3, rng=4, world=Wrapped(world))
    for name in ("intercepted", "searched", "search_times", "position_errors", "samples"):
        np.testing.assert_array_equal(getattr(foreign, name), getattr(own, name))


def test_worlds_that_nobody_tuned_for() -> None:
    """A few of the frozen family; benchmarks/rmma_family.py runs hundreds."""
    covering, spiral = [], []
    for seed in range(1000, 1010):
        world, arrangement = draw(seed)
        for method, rates in (("covering", covering), ("spiral", spiral)):
            result = rmma.run(arrangement, method, (0.02,), runs=2, rng=seed, world=world)
            rates.append(result.interception_rate_searched)
    assert np.mean(covering) > 0.97
    assert np.mean(covering) > 0.05 + np.mean(spiral)


def test_a_real_arm() -> None:
    arm = rmma.ManipulatorArm(tk.robots.pioneer_lx_ur5())
    # The slowest joint's trapezoid, by hand.
    robot = arm.chain

    def joints(u: tuple[float, float], q: np.ndarray) -> np.ndarray:
        target = tk.transform(xyz=(*u, 0.7), rpy=(np.pi, 0.0, 0.0))
        return tk.ik_all(robot, target, seed=q, base=(0, 0, 0)).q[0]

    a = joints((0.2, 0.6), np.zeros(robot.n))
    way = np.abs(joints((-0.1, 0.5), a) - a)[:6]
    v, acc = robot.velocity_limits[:6], robot.acceleration_limits[:6]
    times = np.where(way < v**2 / acc, 2 * np.sqrt(way / acc), way / v + v / acc)
    assert arm.motion_time((0.2, 0.6), (-0.1, 0.5)) == pytest.approx(times.max(), rel=1e-9)
    assert not arm.reaches((0.2, 1.2))
    assert not arm.reaches((0.08, 0.0))
    with pytest.raises(ValueError, match=r"^b: out of"):
        arm.motion_time((0.2, 0.6), (0.2, 1.6))
    slow = rmma.run(1, "spiral", (0.02,), runs=30, rng=0, arm=arm)
    box = rmma.run(1, "spiral", (0.02,), runs=30, rng=0)
    assert slow.search_time > 1.1 * box.search_time
    assert rmma.run(1, "covering", (0.02,), runs=20, rng=0, arm=arm).interception_rate > 0.99
    same = rmma.run(1, "spiral", (0.02,), runs=30, rng=0, arm=arm, workers=1)
    np.testing.assert_array_equal(same.search_times, slow.search_times)
    # A table too far away: the first fiducial of a side is never seen, and the result says so.
    far = [[[0.0, 0.0], [0.3, 0.9]]]
    missed = rmma.run(rmma.Arrangement(far), "covering", (0.02,), runs=2, rng=0, arm=arm)
    assert not missed.intercepted[..., 1].any()


def test_an_arm_without_closed_form_is_refused() -> None:
    with pytest.raises(ValueError, match=r"^chain"):
        rmma.ManipulatorArm(tk.Chain.from_dh([tk.DH(a=0.1, joint="revolute")] * 7))
    with pytest.raises(ValueError, match=r"^height"):
        rmma.ManipulatorArm(tk.robots.pioneer_lx_ur5(), height=np.nan)


def test_a_trace_is_the_first_run() -> None:
    result = rmma.run(3, "covering", (0.02,), runs=1, rng=6)
    trace = rmma.trace(3, "covering", 0.02, rng=6)
    searches = [search for side in trace.sides for search in side.searches]
    times = [search.end - search.start for search in searches]
    np.testing.assert_allclose(times, result.search_times[0, 0][result.searched[0, 0]])
    assert [s.hit for s in searches] == result.intercepted[0, 0][result.searched[0, 0]].tolist()
    for side in trace.sides:
        for search in side.searches:
            if search.hit:  # the last stop's tool is on the fiducial, in its own frame
                away = np.linalg.norm(search.stops[-1] - side.fiducials[search.fiducial])
                assert away <= 0.012
            # A tool is where the base has it: the arm is between 0.4 and 0.9 m long.
            arm = np.linalg.norm(search.stops - search.base_at_stops[:, :2], axis=1)
            assert ((arm > 0.4) & (arm < 0.9)).all()


def test_arrangements() -> None:
    first = rmma.ARRANGEMENTS[1]
    assert first.fiducials == 9
    assert first.registered.tolist() == [1, 0, 0, 1, 0, 0, 0, 0, 0]
    assert [a.fiducials for a in rmma.ARRANGEMENTS.values()] == [9, 6, 9]
    for arrangement in rmma.ARRANGEMENTS.values():
        for driven in arrangement.driven:
            assert (np.diff(driven[:, 0]) > 0).all()
    np.testing.assert_array_equal(first.driven[1], -first.sides[1])
    single = rmma.Arrangement([[[0, 1]], [[2, 3]]])
    assert single.rotations == (0.0, np.pi)
    assert rmma.run(single, "ukf", runs=2, rng=0).interception_rate == 1.0


class Broken(Wrapped):
    def __init__(self, **methods: object) -> None:
        super().__init__(rmma.World())
        self.methods = methods

    def start(self, velocity: float, side: np.ndarray, rng: np.random.Generator) -> WrappedRun:
        run = super().start(velocity, side, rng)
        for name, result in self.methods.items():
            setattr(run, name, lambda *_, result=result: result)
        return run


@pytest.mark.parametrize(
    ("methods", "message"),
    [
        ({"pose": (0.0, np.nan, 0.0)}, r"world: pose\(t\)"),
        ({"pose": (0.0, 0.0)}, r"world: pose\(t\)"),
        ({"pose": (9.0, 9.0, 0.0)}, r"world: pose\(0\)"),
        ({"odometry": (0.0, 0.0, np.inf)}, r"world: odometry\(t\)"),
        ({"place": (0.1, 0.2)}, "world: u_true"),
        ({"place": 3.0}, "world: place"),
        ({"sample_time": -1.0}, "world: sample_time"),
        ({"move_time": np.nan}, "world: move_time"),
    ],
)
def test_a_broken_world_is_named(methods: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=f"^{message}"):
        rmma.run(1, "covering", (0.02,), runs=1, rng=0, world=Broken(**methods))


def test_an_error_in_a_world_comes_through() -> None:
    class Failing:
        def start(self, *_: object) -> object:
            raise RuntimeError("no robot today")

    with pytest.raises(RuntimeError, match="no robot today"):
        rmma.run(1, "ukf", runs=1, world=Failing())


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"arrangement": 4}, "arrangement: got 4"),
        ({"method": "kalman"}, "method: got 'kalman'"),
        ({"velocities": ()}, "velocities"),
        ({"velocities": (0.01, -0.02)}, "velocities"),
        ({"velocities": (np.nan,)}, "velocities"),
        ({"runs": 0}, "runs: got 0"),
        ({"runs": 1.5}, "runs"),
        ({"rng": -3}, "rng"),
        ({"world": 3}, "world"),
        ({"workers": 0}, "threads|workers"),
        ({"config": 8}, "config: got 8"),
        ({"odometry": "always"}, "odometry: got 'always'"),
        ({"spiral_gap": 0.0}, "spiral_gap"),
        ({"spiral_count": 0}, "spiral_count"),
        ({"detection_radius": 0.0}, "detection_radius"),
        ({"config": replace(rmma.CONFIGS[1], q=-1.0)}, "config.q"),
    ],
)
def test_refuses(arguments: dict[str, object], message: str) -> None:
    good: dict[str, object] = {"arrangement": 1, "method": "ukf", "runs": 1, "rng": 0}
    with pytest.raises(ValueError, match=f"^({message})"):
        rmma.run(**(good | arguments))  # type: ignore[arg-type]


@pytest.mark.parametrize("sides", [[], [[[0, 1, 2]]], [np.zeros((0, 2))], [[[0, np.nan]]]])
def test_refuses_sides(sides: object) -> None:
    with pytest.raises(ValueError, match=r"^sides"):
        rmma.Arrangement(sides)  # type: ignore[arg-type]
