"""The localizer: its model against plain numpy, order of arrival, statistics, misuse."""

import copy
import pickle

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.stats import chi2

from localizer_oracle import Measured, Oracle, at_other_times, drawn, moved, rot, seen, wrap
from soak_localizer import soak
from thing_kin import estimation as est

FILTERS = ("ekf", "ukf")
P0, Q0 = np.diag([1e-3, 2e-3, 3e-3]), np.diag([2e-4, 1e-4, 3e-4])
I3 = np.eye(3)


def localizer_for(record, filter="ekf", **options) -> est.BaseLocalizer:
    options = {"process_noise": Q0, "history": 100.0, "filter": filter, **options}
    localizer = est.BaseLocalizer((1.0, -2.0, 3.0), P0, **options)
    for m in record:
        assert m.give(localizer)
    return localizer


def placed(record: list[Measured]) -> list[Measured]:
    """The drive of a record that starts at zero, from where the localizers here start."""
    start, out = np.array([1.0, -2.0, 3.0]), []
    for m in record:
        z = np.array([*(start[:2] + rot(3.0) @ m.z[:2]), wrap(3.0 + m.z[2])])
        out.append(Measured(m.kind, m.t, m.source, z, m.R, m.t_from, m.rows))
    return [new if m.kind in ("pose", "yaw") else m for m, new in zip(record, out, strict=True)]


def bits(localizer: est.BaseLocalizer, times) -> bytes:
    parts = []
    for t in times:
        e = localizer.estimate(t)
        parts += [e.pose, e.covariance, e.twist, e.twist_covariance]
    for name in sorted(localizer.accepted):
        nis = localizer.nis[name]
        counts = localizer.accepted[name], localizer.rejected[name], nis.count, nis.mean, nis.within
        parts.append(np.array(counts, dtype=float))
    return np.concatenate([np.ravel(p) for p in parts]).tobytes()


# The model


@pytest.mark.parametrize("filter", FILTERS)
@pytest.mark.parametrize("seed", range(3))
def test_it_is_the_textbook_s_filter(filter: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    record = placed(drawn(rng, 1.25))
    outlier = Measured("pose", 1.0, "lidar", np.array([9.0, 9, 0]), 1e-3 * I3)
    record.append(outlier)
    options = {} if seed else {"t": 0.0}
    localizer = localizer_for(record, filter, **options)
    for until in (1.1, 1.25, 2.0):
        oracle = Oracle(np.array([1.0, -2.0, 3.0]), P0, Q0, filter, t0=options.get("t"))
        oracle.run(record, until)
        e = localizer.estimate(until)
        # The Jacobians of the oracle are differences: 1e-10 each, some hundred in a row.
        np.testing.assert_allclose(e.pose[:2], oracle.x[:2], atol=3e-9)
        assert abs(wrap(e.pose[2] - oracle.x[2])) < 3e-9
        np.testing.assert_allclose(e.covariance, oracle.joint[:3, :3], rtol=1e-6, atol=1e-10)
    assert localizer.rejected["lidar"] == oracle.rejected["lidar"] >= 1
    assert {k: v for k, v in localizer.accepted.items() if v} == oracle.accepted


def test_a_twist_enters_as_r_dt_squared() -> None:
    R = np.diag([1e-3, 2e-3, 3e-3])
    localizer = est.BaseLocalizer(covariance=np.zeros((3, 3)), process_noise=np.zeros((3, 3)), t=0)
    dt = np.array([0.02, 0.5, 3.0])
    for t in dt.cumsum():
        localizer.add_twist(t, np.zeros(3), R, source="wheels")
    np.testing.assert_allclose(localizer.estimate().covariance, R * (dt**2).sum(), rtol=1e-12)
    # Held for as long again, it counts as one more of this length.
    ahead = localizer.estimate(localizer.latest + 2.0)
    np.testing.assert_allclose(ahead.covariance, R * (4.0 + (dt**2).sum()), rtol=1e-12)


@pytest.mark.parametrize("filter", FILTERS)
def test_prediction_is_as_if_the_twist_were_repeated(filter: str) -> None:
    twist, R = np.array([0.5, 0.1, 0.3]), np.diag([1e-3, 1e-3, 1e-2])
    localizer = localizer_for([Measured("twist", 0.5, "wheels", twist, R)], filter, t=0.0)
    ahead = localizer.estimate(2.75)
    localizer.add_twist(2.75, twist, R, source="wheels")
    np.testing.assert_allclose(ahead.pose, localizer.estimate().pose, atol=1e-14)
    np.testing.assert_allclose(ahead.covariance, localizer.estimate().covariance, rtol=1e-12)
    np.testing.assert_array_equal(localizer.estimate().twist, twist)
    np.testing.assert_array_equal(localizer.estimate().twist_covariance, R)


def test_uncertainty_grows_through_a_gap_as_the_noise_says() -> None:
    """Brownian motion of the heading on a straight line: v^2 q T^3 / 3 across."""
    q, v, T = 1e-6, 0.5, 40.0
    localizer = est.BaseLocalizer(
        covariance=np.zeros((3, 3)), process_noise=np.diag([0, 0, q]), t=0.0
    )
    localizer.add_twist(1e-3, (v, 0, 0), 1e-20 * I3, source="wheels")
    whole = localizer.estimate(T).covariance
    np.testing.assert_allclose(whole[1, 1], v**2 * q * T**3 / 3, rtol=1e-3)
    np.testing.assert_allclose(whole[1, 2], v * q * T**2 / 2, rtol=1e-3)
    for t in np.linspace(1.0, T, 30):  # knots that say nothing
        localizer.add_yaw(t, 0.0, 1e15, source="nothing")
    np.testing.assert_allclose(localizer.estimate(T).covariance, whole, rtol=1e-8, atol=1e-15)
    traces = [np.trace(localizer.estimate(t).covariance) for t in np.linspace(T, 10 * T, 20)]
    assert (np.diff(traces) > 0).all()


def test_several_twists_weigh_by_their_noise() -> None:
    """Over one second: four samples of one source, one of another, and a gyro."""
    localizer = est.BaseLocalizer(
        covariance=np.zeros((3, 3)), process_noise=np.zeros((3, 3)), t=0.0
    )
    localizer.source("fast", fuse=["vx"])
    localizer.source("slow", fuse=["vx", "vy"])
    for name in ("fast", "slow", "gyro"):  # from here on
        localizer.add_twist(0.0, (0, 0, 0), I3, source=name)
    fast = [1.0, 1.2, 0.9, 1.3]
    for k, vx in enumerate(fast):
        localizer.add_twist((k + 1) / 4, (vx, 9.0, 9.0), 4e-3 * I3, source="fast")
    localizer.add_twist(1.0, (1.4, 0.2, 9.0), 2e-3 * I3, source="slow")
    localizer.add_yaw_rate(1.0, 0.0, 1e-12, source="gyro")
    e = localizer.estimate()
    # The mean of four has 1e-3, the other 2e-3.
    np.testing.assert_allclose(e.pose, [(2 * np.mean(fast) + 1.4) / 3, 0.2, 0.0], atol=1e-12)
    np.testing.assert_allclose(np.diag(e.covariance)[:1], [2e-3 / 3], rtol=1e-9)
    np.testing.assert_allclose(e.covariance[2, 2], 1e-12, rtol=1e-9)


def test_a_dead_source_gives_way_to_a_live_one() -> None:
    localizer = est.BaseLocalizer(t=0.0)
    localizer.add_twist(1.0, (1.0, 0, 0), 1e-6 * I3, source="wheels")
    for k in range(11, 60):
        localizer.add_twist(k / 10, (0, 0, 0), 1e-2 * I3, source="visual")
    np.testing.assert_allclose(localizer.estimate().pose, [1.1, 0, 0], atol=0.011)
    np.testing.assert_allclose(localizer.estimate().twist, 0, atol=1e-12)


def test_a_motion_is_not_counted_twice() -> None:
    """Without heading errors all is linear: a joint Gaussian says what the answer is."""
    rng = np.random.default_rng(5)
    R, S, E = 1e-2, 3e-3, 1e-4
    localizer = est.BaseLocalizer(covariance=I3 * E, process_noise=np.zeros((3, 3)), t=0.0)
    u = rng.normal(1, 0.1, 6)
    z = {(0, 2): 2.1, (1, 4): 2.8, (2, 6): 4.2, (4, 5): 1.05}
    for k in range(6):
        localizer.add_twist(k + 1.0, (u[k], 0, 0), np.diag([R, 1e-9, 1e-9]), source="wheels")
    for (i, j), motion in z.items():
        localizer.add_relative_pose(
            float(i), float(j), (motion, 0, 0), np.diag([S, 1, 1]), source="scan"
        )
    steps = np.concatenate([[0.0], u])  # start, then each way
    C = np.diag([E, *[R] * 6])
    H = np.array([[float(i < k <= j) for k in range(7)] for i, j in z])
    gain = C @ H.T @ np.linalg.inv(H @ C @ H.T + S * np.eye(4))
    mean = steps + gain @ (np.array(list(z.values())) - H @ steps)
    cov = C - gain @ H @ C
    e = localizer.estimate()
    assert localizer.accepted["scan"] == 4
    np.testing.assert_allclose(e.pose[0], mean.sum(), rtol=1e-9)
    np.testing.assert_allclose(e.covariance[0, 0], cov.sum(), rtol=1e-6)


def test_more_than_eight_motions_at_a_time_are_rejected() -> None:
    localizer = est.BaseLocalizer(t=0.0, history=50.0)
    localizer.add_twist(1.0, (1, 0, 0), 1e-2 * I3, source="wheels")
    for k in range(10):
        localizer.add_relative_pose(k, 20 + k, (20, 0, 0), I3, source="scan")
    assert localizer.accepted["scan"] == 8
    assert localizer.rejected["scan"] == 2
    localizer.add_relative_pose(30, 31, (1, 0, 0), I3, source="scan")
    assert localizer.accepted["scan"] == 9


@pytest.mark.parametrize("filter", FILTERS)
def test_no_jump_at_pi(filter: str) -> None:
    rng = np.random.default_rng(2)
    record = drawn(rng, 2.0)
    turned = localizer_for(placed(record), filter).estimate()
    start = est.BaseLocalizer((1.0, -2.0, 3.0 - 2 * np.pi), P0, process_noise=Q0, filter=filter)
    for m in placed(record):
        if m.kind in ("pose", "yaw"):
            m = Measured(m.kind, m.t, m.source, m.z + 4 * np.pi * I3[2], m.R, 0.0, m.rows)
        m.give(start)
    np.testing.assert_allclose(start.estimate().pose, turned.pose, atol=1e-12)
    np.testing.assert_allclose(start.estimate().covariance, turned.covariance, rtol=1e-9)
    assert -np.pi < turned.pose[2] <= np.pi


@pytest.mark.parametrize("filter", FILTERS)
def test_moving_the_world_moves_the_estimate(filter: str) -> None:
    """What the world's axes are is nobody's business but the noise's, which is round here."""
    record = drawn(np.random.default_rng(3), 2.0)
    record = [Measured(**{**m.__dict__, "R": np.diag([2e-3, 2e-3, 1e-3])}) for m in record]
    Q = np.diag([1e-4, 1e-4, 2e-4])
    here = est.BaseLocalizer((0, 0, 0), 1e-3 * I3, process_noise=Q, filter=filter)
    there = est.BaseLocalizer((1.0, -2.0, 3.0), 1e-3 * I3, process_noise=Q, filter=filter)
    for m, n in zip(record, placed(record), strict=True):
        m.give(here)
        n.give(there)
    a, b = here.estimate(), there.estimate()
    T = np.eye(3)
    T[:2, :2] = rot(3.0)
    np.testing.assert_allclose(b.pose[:2], [1, -2] + rot(3.0) @ a.pose[:2], atol=1e-9)
    np.testing.assert_allclose(b.covariance, T @ a.covariance @ T.T, rtol=1e-6, atol=1e-12)


def test_unix_stamps_lose_no_digits() -> None:
    record = drawn(np.random.default_rng(4), 2.0)  # stamps are binary fractions
    now, then = localizer_for(record), localizer_for(at_other_times(record, 1.7e9))
    for t in (1.0, 2.0, 2.25):
        a, b = now.estimate(t), then.estimate(1.7e9 + t)
        assert a.pose.tobytes() == b.pose.tobytes()
        assert a.covariance.tobytes() == b.covariance.tobytes()


# Order of arrival

RECORD = placed(drawn(np.random.default_rng(7), 1.5))
TIES = [Measured("pose", m.t, "a" if k % 2 else "lidar", m.z, m.R) for k, m in enumerate(RECORD)
        if m.kind == "pose" for _ in range(2)]  # fmt: skip
TIES += [Measured("twist", 1.0, s, np.array([x, 0, 0]), 1e-2 * I3) for s in "ba" for x in (2, 1, 1)]
ALL = RECORD + TIES
TIMES = (0.25, 0.4, 1.0, 1.5, 1.6)


@pytest.mark.parametrize("filter", FILTERS)
@settings(max_examples=25)
@given(order=st.permutations(range(len(ALL))))
@example(order=list(range(len(ALL)))[::-1])
def test_shuffled_arrival_gives_the_same_bits(filter: str, order: list[int]) -> None:
    in_order = localizer_for(sorted(ALL, key=Measured.key), filter)
    shuffled = localizer_for([ALL[i] for i in order], filter)
    assert bits(shuffled, TIMES) == bits(in_order, TIMES)


@settings(max_examples=15)
@given(seed=st.integers(0, 10**6), lag=st.floats(0.0, 0.9))
def test_late_arrival_within_a_short_history_gives_the_same_bits(seed: int, lag: float) -> None:
    """While the front of the record is folded away, and across a gap longer than the history."""
    rng = np.random.default_rng(seed)
    record = drawn(rng, 4.0) + at_other_times(drawn(rng, 4.0), 8.0)
    record.sort(key=Measured.key)
    delay = rng.uniform(0, lag, len(record)) * (rng.random(len(record)) < 0.5)
    arrival = np.argsort([m.t + d for m, d in zip(record, delay, strict=True)], kind="stable")
    in_order, late = (est.BaseLocalizer(process_noise=Q0, history=1.25) for _ in range(2))
    late.source("gyro", gate=0.95)
    in_order.source("gyro", gate=0.95)
    for m in record:
        assert m.give(in_order)
    for i in arrival:
        assert record[i].give(late)
    assert len(late) < len(record)
    assert bits(late, (11.0, 12.0, 13.0)) == bits(in_order, (11.0, 12.0, 13.0))


def test_verdicts_are_final_after_replay() -> None:
    """Rejected by itself; not any more when what came late has moved the base there."""
    localizer = est.BaseLocalizer(t=0.0, covariance=1e-6 * I3)
    localizer.add_pose(2.0, (5, 0, 0), 1e-4 * I3, source="lidar")
    assert (localizer.accepted["lidar"], localizer.rejected["lidar"]) == (0, 1)
    localizer.add_twist(2.0, (2.5, 0, 0), 1e-4 * I3, source="wheels")
    assert (localizer.accepted["lidar"], localizer.rejected["lidar"]) == (1, 0)


def test_what_is_older_than_the_history_is_refused_and_counted() -> None:
    localizer = est.BaseLocalizer(history=1.0)
    assert localizer.add_yaw(10.0, 0.0, 1.0, source="compass")
    before = bits(localizer, (10.0,))
    assert not localizer.add_pose(8.9, (9, 9, 9), I3, source="lidar")
    assert not localizer.add_relative_pose(8.9, 9.5, (9, 9, 9), I3, source="lidar")
    assert not localizer.add_relative_pose(9.5, 11.0, (9, 9, 9), I3, source="lidar")
    assert localizer.refused == {"compass": 0, "lidar": 3}
    assert bits(localizer, (10.0,))[: len(before) - 40] == before[: len(before) - 40]
    assert localizer.add_pose(9.0, (0, 0, 0), I3, source="lidar")


def test_memory_is_bounded() -> None:
    localizer = est.BaseLocalizer(history=0.5)
    sizes = []
    for k in range(1, 2001):
        localizer.add_twist(k / 100, (1, 0, 0), 1e-3 * I3, source="wheels")
        localizer.add_relative_pose((k - 1) / 100, k / 100, (0.01, 0, 0), I3, source="scan")
        sizes.append(len(localizer))
    assert max(sizes) <= 3 * 102
    assert len(pickle.dumps(localizer)) < 200_000
    assert sum(localizer.accepted.values()) + sum(localizer.rejected.values()) == 4000
    with pytest.raises(ValueError, match=r"^t: got .*within the history"):
        localizer.estimate(15.0)


# Statistics


def draw_from_the_model(rng: np.random.Generator, localizer: est.BaseLocalizer) -> np.ndarray:
    """A second of driving as the model says; the end of it arrives in disorder."""
    R, RL, RM = np.diag([0.04, 0.02, 0.05]), np.diag([4e-3, 4e-3, 2e-3]), np.diag([1e-3] * 3)
    Q, dt = np.diag([1e-3, 1e-3, 4e-3]), 0.1
    x = moved(np.zeros(3), np.zeros(3)) + rng.multivariate_normal(np.zeros(3), P0)
    truth = [x]
    arrivals = []
    for k in range(1, 11):
        u = np.array([0.8, 0.2 * np.sin(k), 0.7])
        for _ in range(4):
            x = moved_fast(x, u * dt / 4) + rng.normal(0, np.sqrt(np.diag(Q) * dt / 4))
        truth.append(x)
        z = u + rng.normal(0, np.sqrt(np.diag(R)))
        arrivals.append((k, Measured("twist", k * dt, "wheels", z, R)))
        if k % 3 == 0:
            z = x + rng.normal(0, np.sqrt(np.diag(RL)))
            arrivals.append((k + 2.5, Measured("pose", k * dt, "lidar", z, RL)))
        if k % 2 == 0:
            z = seen(truth[k - 2], x) + rng.normal(0, np.sqrt(np.diag(RM)))
            motion = Measured("relative", k * dt, "scan", z, RM, (k - 2) * dt)
            arrivals.append((k + 0.5 + rng.integers(0, 3), motion))
    for _, m in sorted(arrivals, key=lambda a: a[0]):
        m.give(localizer)
    return x


def moved_fast(pose: np.ndarray, xi: np.ndarray) -> np.ndarray:
    """As moved(), for steps so small that the second order does."""
    return np.array([*(pose[:2] + rot(pose[2] + xi[2] / 2) @ xi[:2]), pose[2] + xi[2]])


@pytest.mark.parametrize("filter", FILTERS)
def test_nees_and_nis_over_500_runs(filter: str) -> None:
    rng = np.random.default_rng(11)
    runs, nees, nis = 500, 0.0, {"lidar": [], "scan": []}
    for _ in range(runs):
        localizer = est.BaseLocalizer(
            covariance=P0, process_noise=np.diag([1e-3, 1e-3, 4e-3]), filter=filter, gate=1, t=0.0
        )
        truth = draw_from_the_model(rng, localizer)
        e = localizer.estimate(1.0)
        error = np.array([*(e.pose[:2] - truth[:2]), wrap(e.pose[2] - truth[2])])
        nees += error @ np.linalg.solve(e.covariance, error)
        for name, values in nis.items():
            values.append((localizer.nis[name].mean, localizer.nis[name].count))
    low, high = chi2.ppf([0.025, 0.975], 3 * runs) / runs
    assert low < nees / runs < high
    for values in nis.values():
        count = sum(n for _, n in values)
        mean = sum(m * n for m, n in values) / count
        low, high = chi2.ppf([0.025, 0.975], 3 * count) / count
        assert low < mean < high


def test_nis_tells_a_source_that_boasts() -> None:
    rng = np.random.default_rng(0)
    localizer = est.BaseLocalizer(gate=1.0, covariance=1e-12 * I3, process_noise=1e-12 * I3)
    for k in range(400):
        localizer.add_pose(k / 100, rng.normal(0, 0.1, 3), 1e-2 * I3, source="honest")
        localizer.add_pose(k / 100, rng.normal(0, 0.1, 3), 1e-3 * I3, source="boaster")
        localizer.add_yaw(k / 100, rng.normal(0, 0.1), 1e-2, source="one")
    nis = localizer.nis
    assert 2.7 < nis["honest"].mean < 3.3
    assert 0.92 < nis["honest"].within < 0.98
    assert nis["boaster"].mean > 25
    assert nis["boaster"].within < 0.2
    assert (nis["one"].dof, nis["one"].count) == (1.0, 400)


def test_a_source_s_own_gate_holds_twists_back() -> None:
    localizer = est.BaseLocalizer(t=0.0)
    localizer.source("wheels", gate=0.999)
    for k in range(1, 11):
        localizer.add_yaw_rate(k / 10, 0.1, 1e-4, source="imu")
        slip = 5.0 if k == 5 else 0.1
        localizer.add_twist(k / 10, (0.5, 0, slip), 1e-3 * I3, source="wheels")
    assert localizer.rejected == {"imu": 0, "wheels": 1}
    np.testing.assert_allclose(localizer.estimate().pose[2], 0.1, atol=1e-3)


# Keeping it


@pytest.mark.parametrize("keep", [pickle.dumps, copy.copy, copy.deepcopy, est.BaseLocalizer.save])
@pytest.mark.parametrize("history", [0.25, 100.0])
def test_what_is_saved_goes_on_to_the_same_bits(keep, history: float) -> None:
    record = sorted(drawn(np.random.default_rng(9), 3.0), key=Measured.key)
    half = len(record) // 2
    localizer = est.BaseLocalizer(process_noise=Q0, history=history, filter="ukf")
    localizer.source("gyro", gate=0.9)
    for m in record[:half]:
        m.give(localizer)
    kept = keep(localizer)
    if isinstance(kept, bytes):
        kept = pickle.loads(kept) if keep is pickle.dumps else est.BaseLocalizer.restore(kept)
    for m in record[half:]:
        assert m.give(kept) == m.give(localizer)
    t = record[-1].t
    assert bits(kept, (t, t + 1)) == bits(localizer, (t, t + 1))
    assert kept.save() == localizer.save()


def test_other_bytes_are_refused() -> None:
    state = localizer_for(RECORD[:5]).save()
    wrong_version = state[:4] + b"\x02" + state[5:]
    for bad in (b"", b"abc", state[:-1], state + b"x", state[:90] + b"\x99" + state[91:]):
        with pytest.raises(ValueError, match=r"^state: got"):
            est.BaseLocalizer.restore(bad)
    with pytest.raises(ValueError, match="version 2, expected version 1"):
        est.BaseLocalizer.restore(wrong_version)


def test_reset() -> None:
    localizer = localizer_for(RECORD)
    accepted = localizer.accepted
    localizer.reset((1.0, 2.0, 0.5), 1e-4 * I3, t=30.0)
    np.testing.assert_array_equal(localizer.estimate().pose, [1.0, 2.0, 0.5])
    assert localizer.accepted == accepted
    assert not localizer.add_pose(29.9, (0, 0, 0), I3, source="lidar")
    later = localizer.estimate(31.0)
    np.testing.assert_allclose(later.pose, [1, 2, 0.5])  # what moved it before is forgotten
    np.testing.assert_allclose(later.covariance, 1e-4 * I3 + Q0)
    localizer.reset((0, 0, 0), I3)
    with pytest.raises(ValueError, match=r"^t: got None, expected a measurement first"):
        localizer.estimate()


# Misuse

NAN = float("nan")
BAD = {
    "twist: got": lambda x: x.add_twist(9.0, (NAN, 0, 0), I3, source="new"),
    "covariance: got a variance of -1": lambda x: x.add_twist(9.0, (0, 0, 0), -I3, source="new"),
    "covariance: got": lambda x: x.add_pose(9.0, (0, 0, 0), [[1, 2, 0], [2, 1, 0], [0, 0, 1]],
                                            source="new"),
    "covariance: got shape": lambda x: x.add_pose(9.0, (0, 0, 0), np.eye(2), source="new"),
    "covariance: got a variance of 0": lambda x: x.add_pose(9.0, (0, 0, 0), 0 * I3, source="new"),
    "covariance: got None": lambda x: x.add_pose(9.0, (0, 0, 0), source="new"),
    "t: got nan": lambda x: x.add_pose(NAN, (0, 0, 0), I3, source="new"),
    "t2: got": lambda x: x.add_relative_pose(9.0, 9.0, (0, 0, 0), I3, source="new"),
    "motion: got": lambda x: x.add_relative_pose(8.0, 9.0, (0, 0), I3, source="new"),
    "rate: got": lambda x: x.add_yaw_rate(9.0, NAN, 1e-2, source="new"),
    "variance: got": lambda x: x.add_yaw(9.0, 0.0, -1.0, source="new"),
    "fuse: got 'vz'": lambda x: x.source("new", fuse=["vx", "vz"]),
    "fuse: got no name": lambda x: x.source("new", fuse=[]),
    "gate: got 1.5": lambda x: x.source("new", gate=1.5),
}  # fmt: skip


@pytest.mark.parametrize("message", BAD)
def test_misuse_names_the_source_and_changes_nothing(message: str) -> None:
    localizer = localizer_for(RECORD)
    before = localizer.save()
    with pytest.raises(ValueError, match=r"^(?s:.*)\(source 'new'\)") as error:
        BAD[message](localizer)
    assert str(error.value).startswith(message)
    assert localizer.save() == before


def test_what_a_source_does_not_measure_is_refused() -> None:
    localizer = est.BaseLocalizer(sources={"imu": {"fuse": ["omega"], "covariance": 1e-4}})
    with pytest.raises(ValueError, match=r"^source: got .* 'x', 'y' or 'theta'.*'imu'"):
        localizer.add_yaw(0.0, 0.1, source="imu")
    assert localizer.add_twist(0.0, (9, 9, 0.5), source="imu")
    np.testing.assert_array_equal(localizer.estimate().twist, [0, 0, 0.5])


@pytest.mark.parametrize(
    ("name", "value"),
    [("gate", 0.0), ("history", -1.0), ("history", np.inf), ("t", NAN), ("filter", "pf"),
     ("process_noise", -I3), ("covariance", np.ones((2, 2))), ("sources", {"a": 3})],
)  # fmt: skip
def test_bad_options(name: str, value) -> None:
    with pytest.raises(ValueError, match=f"^{name}: got .*, expected"):
        est.BaseLocalizer(**{name: value})


def test_asking_before_the_first() -> None:
    localizer = est.BaseLocalizer()
    with pytest.raises(ValueError, match="time has not begun"):
        localizer.estimate()
    localizer.add_pose(5.0, (0, 0, 0), I3, source="lidar")
    with pytest.raises(ValueError, match=r"^t: got .*, expected no time before the first"):
        localizer.estimate(4.9)
    localizer.add_pose(4.0, (0, 0, 0), I3, source="lidar")  # the first, after all
    assert localizer.estimate(4.5).t == 4.5


# A short form of soak_localizer.py


@pytest.mark.parametrize("filter", FILTERS)
def test_a_short_soak(filter: str) -> None:
    soak(800, 1, filter)
