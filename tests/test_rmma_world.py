"""The simulated world: each of its numbers does what it says, and nothing else does."""

from dataclasses import fields, replace

import numpy as np
import pytest

from thing_kin import rmma

SIDE = np.array([[1.0, 0.7], [1.4, 0.75], [2.0, 0.65]])
NO_ERRORS = (
    "slip_mean",
    "slip_std",
    "speed_std",
    "heading_std",
    "curvature_mean",
    "curvature_std",
    "heading_walk",
    "start_lag",
    "creep",
    "arm_std",
    "arm_hidden_std",
    "sample_std",
    "odo_bias_std",
    "odo_std",
    "odo_white",
    "odo_heading_std",
    "map_std",
)
IDEAL = replace(rmma.World(), **dict.fromkeys(NO_ERRORS, 0.0))
START = np.array([0.8, 0.1, 0.0])


def start(world: rmma.World, seed: int, velocity: float = 0.02) -> rmma.WorldRun:
    return world.start(velocity, SIDE, np.random.default_rng(seed))


def poses(world: rmma.World, t: float, n: int = 1500) -> np.ndarray:
    return np.array([start(world, seed).pose(t) for seed in range(n)])


def test_an_ideal_world_has_no_errors() -> None:
    run = start(IDEAL, 0)
    np.testing.assert_allclose(run.pose(30.0), START + np.array([0.6, 0, 0]), atol=1e-12)
    np.testing.assert_allclose(run.odometry(30.0), run.pose(30.0), atol=1e-12)
    for placed in run.place((0.1, 0.6)):
        np.testing.assert_allclose(placed, (0.1, 0.6), atol=1e-15)
    assert run.detects(SIDE[1] + (0.0119, 0), SIDE[1])
    assert not run.detects(SIDE[1] + (0.0121, 0), SIDE[1])


def test_times_of_the_arm() -> None:
    run = start(rmma.World(), 0)
    assert run.sample_time((0, 0.6), (0.018, 0.6)) == pytest.approx(0.16 + 0.1, abs=1e-12)
    assert run.move_time((0, 0.6), (0.03, 0.64)) == pytest.approx(0.5 + 0.05 / 0.15, abs=1e-12)


def test_deterministic_drift() -> None:
    lagging = start(replace(IDEAL, start_lag=0.5), 0)
    assert lagging.pose(0.5)[0] == START[0]
    assert lagging.pose(10.5)[0] == pytest.approx(START[0] + 0.2, abs=1e-12)
    assert start(replace(IDEAL, slip_mean=0.05), 0).pose(10.0)[0] == pytest.approx(0.99, abs=1e-12)
    assert start(replace(IDEAL, creep=4e-4), 0).pose(10.0)[1] == pytest.approx(0.104, abs=1e-12)
    bent = start(replace(IDEAL, curvature_mean=0.1), 0).pose(50.0)
    # A circle of 10 m.
    expected = START + np.array([10 * np.sin(0.1), 10 * (1 - np.cos(0.1)), 0.1])
    np.testing.assert_allclose(bent, expected, atol=1e-6)


def test_deviations_of_the_drive() -> None:
    # 1500 drives tell a deviation to 1.8 %: four of that.
    near = {"rtol": 0.075}
    t, way = 30.0, 0.6
    np.testing.assert_allclose(poses(replace(IDEAL, slip_std=0.02), t)[:, 0].std(), 0.012, **near)
    np.testing.assert_allclose(poses(replace(IDEAL, heading_std=0.01), t)[:, 2].std(), 0.01, **near)
    bent = poses(replace(IDEAL, curvature_std=0.02), t)[:, 2]
    np.testing.assert_allclose(bent.std(), 0.02 * way, **near)
    walked = poses(replace(IDEAL, heading_walk=0.005), t)[:, 2]
    np.testing.assert_allclose(walked.std(), 0.005 * np.sqrt(way), **near)
    # Integral of an Ornstein-Uhlenbeck process of length L over the way d.
    L = 0.15
    paced = poses(replace(IDEAL, speed_std=0.03), t)[:, 0]
    variance = 2 * 0.03**2 * L * (way - L * (1 - np.exp(-way / L)))
    np.testing.assert_allclose(paced.std(), np.sqrt(variance), **near)


def test_deviations_of_the_localization() -> None:
    near = {"rtol": 0.08}

    def errors(world: rmma.World, times: tuple[float, ...] = (10.0,)) -> np.ndarray:
        runs = [start(world, seed) for seed in range(1200)]
        return np.array([[np.subtract(r.odometry(t), r.pose(t)) for t in times] for r in runs])

    biased = errors(replace(IDEAL, odo_bias_std=0.004), (1.0, 30.0))
    np.testing.assert_allclose(biased[:, :, :2].std((0, 1)), 0.004, **near)
    np.testing.assert_allclose(biased[:, 0], biased[:, 1], atol=1e-12)
    white = errors(replace(IDEAL, odo_white=0.001), (1.0, 1.0))
    np.testing.assert_allclose(white[:, :, :2].std((0, 1)), 0.001, **near)
    assert abs(np.corrcoef(white[:, 0, 0], white[:, 1, 0])[0, 1]) < 0.12
    heading = errors(replace(IDEAL, odo_heading_std=0.005))
    np.testing.assert_allclose(heading[:, 0, 2].std(), 0.005, **near)
    # 0.3 m on, an Ornstein-Uhlenbeck process of that length keeps 1/e.
    wandering = errors(replace(IDEAL, odo_std=0.007), (5.0, 20.0))
    np.testing.assert_allclose(wandering[:, :, :2].std((0, 1)), 0.007, **near)
    kept = np.corrcoef(wandering[:, 0, 0], wandering[:, 1, 0])[0, 1]
    assert kept == pytest.approx(np.exp(-1), abs=0.1)


def test_deviations_of_the_arm_and_the_map() -> None:
    near = {"rtol": 0.08}

    def placed(world: rmma.World) -> np.ndarray:
        out = []
        for seed in range(600):
            run = start(world, seed)
            run.move_time((0, 0.5), (0.1, 0.6))
            first = run.place((0.1, 0.6))
            run.sample_time((0.1, 0.6), (0.1, 0.61))
            out.append([first, np.subtract(run.place((0.1, 0.61)), (0, 0.01))])
        return np.array(out) - (0.1, 0.6)  # (run, stop, (true, seen), axis)

    seen = placed(replace(IDEAL, arm_std=0.003))
    np.testing.assert_allclose(seen.std((0, 1, 2)), 0.003, **near)
    np.testing.assert_allclose(seen[:, 0], seen[:, 1], atol=1e-12)  # persists
    hidden = placed(replace(IDEAL, arm_hidden_std=0.001))
    np.testing.assert_allclose(hidden[:, :, 0].std((0, 1)), 0.001, **near)
    np.testing.assert_allclose(hidden[:, :, 1], 0.0, atol=1e-12)
    each = placed(replace(IDEAL, sample_std=0.001))
    np.testing.assert_allclose(each[:, :, 0].std((0, 1)), 0.001, **near)
    assert abs(np.corrcoef(each[:, 0, 0, 0], each[:, 1, 0, 0])[0, 1]) < 0.15
    shifted = replace(IDEAL, map_std=0.012)
    hits = np.mean([start(shifted, seed).detects(SIDE[1], SIDE[1]) for seed in range(2000)])
    assert hits == pytest.approx(1 - np.exp(-0.5), abs=0.045)  # Rayleigh, at one deviation


def test_readings_do_not_change_the_drive() -> None:
    a, b = start(rmma.World(), 3), start(rmma.World(), 3)
    for t in np.linspace(0, 20, 50):
        a.odometry(t)
        a.place((0.1, 0.6))
    assert a.pose(25.0) == b.pose(25.0)


@pytest.mark.parametrize("field", [field.name for field in fields(rmma.World)])
def test_refuses_what_is_no_number(field: str) -> None:
    for bad in (np.nan, np.inf):
        with pytest.raises(ValueError, match=f"^{field}"):
            replace(rmma.World(), **{field: bad})
    if field not in ("slip_mean", "curvature_mean", "creep"):
        with pytest.raises(ValueError, match=f"^{field}: got -1"):
            replace(rmma.World(), **{field: -1.0})


def test_start_refuses() -> None:
    rng = np.random.default_rng(0)
    with pytest.raises(ValueError, match=r"^velocity"):
        rmma.World().start(0.0, SIDE, rng)
    with pytest.raises(ValueError, match=r"^side"):
        rmma.World().start(0.02, np.zeros((0, 2)), rng)
    with pytest.raises(ValueError, match=r"^side"):
        rmma.World().start(0.02, np.zeros(2), rng)
