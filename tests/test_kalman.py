"""The three filters against filterpy, a plain numpy one, and the statistics they promise."""

from typing import Any

import numpy as np
import pytest
from filterpy.kalman import ExtendedKalmanFilter as PeerExtended
from filterpy.kalman import KalmanFilter as PeerKalman
from filterpy.kalman import MerweScaledSigmaPoints
from filterpy.kalman import UnscentedKalmanFilter as PeerUnscented
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import chi2

from soak_filters import KINDS, soak
from thing_kin import estimation as est

Array = Any
DT = 0.1
F = np.array([[1, 0, DT, 0], [0, 1, 0, DT], [0, 0, 1, 0], [0, 0, 0, 1.0]])
H = np.eye(2, 4)
Q = 1e-3 * np.diag([1.0, 2.0, 3.0, 4.0])
R = np.array([[0.02, 0.005], [0.005, 0.03]])
X0, P0 = np.array([0.0, 0.0, 1.0, 0.5]), np.diag([1.0, 2.0, 0.5, 0.7])
MODELS = [
    est.models.constant_velocity(3),
    est.models.constant_acceleration(2),
    est.models.constant_twist(noise=(0.1, 0.2, 0.3)),
    est.models.omnidirectional(),
]


def f(x: Array) -> Array:
    return np.array([x[0] + 0.1 * x[2], x[1] + 0.1 * np.sin(x[3]), 0.99 * x[2], x[3] + 0.01])


def f_jacobian(x: Array) -> Array:
    J = np.eye(4)
    J[0, 2], J[1, 3], J[2, 2] = 0.1, 0.1 * np.cos(x[3]), 0.99
    return J


def h(x: Array) -> Array:
    return np.array([np.hypot(x[0] - 3, x[1] - 4), x[2] * x[3]])


def h_jacobian(x: Array) -> Array:
    d = np.hypot(x[0] - 3, x[1] - 4)
    return np.array([[(x[0] - 3) / d, (x[1] - 4) / d, 0, 0], [0, 0, x[3], x[2]]])


def measurements(count: int = 60) -> Array:
    return np.random.default_rng(3).normal(size=(count, 2)) * 0.2 + [5.0, 0.5]


def agrees(ours: Any, x: Array, P: Array) -> None:
    np.testing.assert_allclose(ours.x, np.ravel(x), atol=1e-9)
    np.testing.assert_allclose(ours.P, P, atol=1e-9)


@given(st.integers(1, 9), st.integers(1, 4), st.integers(0, 2**32 - 1))
def test_linear_filter_is_the_textbook_s(n: int, m: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    A, C = rng.normal(size=(n, n)) / n, rng.normal(size=(m, n))
    W, V = (rng.normal(size=(k, k)) for k in (n, m))
    W, V = W @ W.T, V @ V.T + 0.1 * np.eye(m)
    x, P = rng.normal(size=n), np.eye(n)
    filter = est.KalmanFilter(x, P)
    for z in rng.normal(size=(5, m)):
        filter.predict(A, W)
        filter.update(z, C, V)
        x, P = A @ x, A @ P @ A.T + W
        S = C @ P @ C.T + V
        K, y = P @ C.T @ np.linalg.inv(S), z - C @ x
        nis = y @ np.linalg.solve(S, y)
        x, P = x + K @ y, (np.eye(n) - K @ C) @ P
        np.testing.assert_allclose(filter.x, x, atol=1e-9)
        np.testing.assert_allclose(filter.P, P, atol=1e-9)
        np.testing.assert_allclose(filter.K, K, atol=1e-9)
        np.testing.assert_allclose(filter.S, S, rtol=1e-9)
        log = -0.5 * (nis + np.linalg.slogdet(2 * np.pi * S)[1])
        np.testing.assert_allclose([filter.nis, filter.log_likelihood], [nis, log], rtol=1e-8)


def test_kalman_and_smoother_are_filterpy_s() -> None:
    peer = PeerKalman(4, 2)
    peer.x, peer.P, peer.F, peer.H, peer.Q, peer.R = X0.copy(), P0.copy(), F, H, Q, R
    x, P, _, _ = peer.batch_filter(measurements())
    xs, Ps, _, _ = peer.rts_smoother(x, P)
    run = est.KalmanFilter(X0, P0).run(measurements(), F=F, Q=Q, H=H, R=R, smooth=True)
    for ours, theirs in ((run.x, x), (run.P, P), (run.x_smooth, xs), (run.P_smooth, Ps)):
        np.testing.assert_allclose(ours, theirs, atol=1e-9)


@pytest.mark.parametrize("given_jacobians", [True, False])
def test_extended_is_filterpy_s(given_jacobians: bool) -> None:
    ours = est.ExtendedKalmanFilter(X0, P0)
    peer = PeerExtended(4, 2)
    peer.x, peer.P, peer.Q, peer.R = X0.copy(), P0.copy(), Q, R
    for z in measurements():
        peer.F = f_jacobian(peer.x)
        peer.predict_x = lambda u=0: setattr(peer, "x", f(peer.x))
        peer.predict()
        peer.update(z, h_jacobian, h)
        ours.predict(f, Q, f_jacobian if given_jacobians else None)
        ours.update(z, h, R, h_jacobian if given_jacobians else None)
        np.testing.assert_allclose(ours.x, peer.x, atol=1e-9 if given_jacobians else 1e-7)
        np.testing.assert_allclose(ours.P, peer.P, atol=1e-9 if given_jacobians else 1e-7)


@pytest.mark.parametrize("root", [False, True])
@pytest.mark.parametrize(("alpha", "beta", "kappa"), [(1, 2, 0), (0.1, 2, -1), (0.7, 0.3, 1)])
def test_unscented_is_filterpy_s(root: bool, alpha: float, beta: float, kappa: float) -> None:
    points = MerweScaledSigmaPoints(4, alpha, beta, kappa)
    peer = PeerUnscented(4, 2, DT, h, lambda x, dt: f(x), points)
    peer.x, peer.P, peer.Q, peer.R = X0.copy(), P0.copy(), Q, R
    ours = est.UnscentedKalmanFilter(X0, P0, alpha, beta, kappa, square_root=root)
    np.testing.assert_allclose(ours.sigma_points(), points.sigma_points(X0, P0), atol=1e-12)
    for z in measurements():
        peer.predict()
        peer.update(z)
        ours.predict(f, Q)
        ours.update(z, h, R)
        agrees(ours, peer.x, peer.P)
        np.testing.assert_allclose(ours.S, peer.S, atol=1e-9)
        np.testing.assert_allclose(ours.K, peer.K, atol=1e-9)


@pytest.mark.parametrize("kind", ["extended", "unscented", "root"])
def test_on_a_linear_model_all_are_one(kind: str) -> None:
    record = measurements()
    record[10:14] = np.nan
    linear = est.KalmanFilter(X0, P0).run(record, F=F, Q=Q, H=H, R=R, gate=0.9, smooth=True)
    if kind == "extended":
        other: Any = est.ExtendedKalmanFilter(X0, P0)
    else:
        other = est.UnscentedKalmanFilter(X0, P0, square_root=kind == "root")
    run = other.run(record, f=F, Q=Q, h=H, R=R, gate=0.9, smooth=True)
    assert run.status == linear.status
    assert "missing" in run.status
    for name in ("x", "P", "innovations", "nis", "x_smooth", "P_smooth"):
        np.testing.assert_allclose(getattr(run, name), getattr(linear, name), atol=1e-9)


def test_a_down_date_that_fails_leaves_the_state() -> None:
    """x^2 with weight beta - alpha^2 = -1: variance 2 (1 + kappa) / 2 ... - 1, negative."""
    for root in (False, True):
        filter = est.UnscentedKalmanFilter([0.0], [[1.0]], 1.0, 0.0, -0.9, square_root=root)
        assert not filter.predict(lambda x: x**2, [[0.01]])
        assert filter.status == "not_positive"
        np.testing.assert_array_equal([filter.x[0], filter.P[0, 0]], [0.0, 1.0])


@pytest.mark.parametrize("model", MODELS, ids=lambda m: m.name)
def test_models_have_exact_jacobians_and_noise(model: Any) -> None:
    x = np.random.default_rng(1).normal(size=model.n)
    check = est.check_jacobian(
        lambda y: model(y, 0.3), lambda y: model.jacobian(y, 0.3), x, angles=model.angles
    )
    assert check.difference < 1e-8
    assert np.linalg.eigvalsh(model.process_noise(x, 0.3)).min() > 0


@pytest.mark.parametrize("dof", [1, 2, 3, 8, 100, 4000])
def test_chi_square_quantile_is_scipy_s(dof: int) -> None:
    p = np.array([1e-12, 1e-3, 0.05, 0.3, 0.5, 0.9, 0.99, 0.999, 1 - 1e-9])
    np.testing.assert_allclose(est.chi_square_quantile(p, dof), chi2.ppf(p, dof), rtol=1e-12)


def started(kind: str, model: Any, P: Array) -> Any:
    x = np.zeros(model.n)
    x[3:5] = 0.5
    if kind == "extended":
        return est.ExtendedKalmanFilter(x, P, angles=model.angles)
    return est.UnscentedKalmanFilter(x, P, angles=model.angles, square_root=kind == "root")


@pytest.mark.parametrize("kind", ["extended", "unscented", "root"])
@pytest.mark.parametrize("model", MODELS, ids=lambda m: m.name)
def test_nees_and_nis_are_in_their_bands(kind: str, model: Any) -> None:
    """500 seeded runs, start drawn from the filter's own P."""
    angles = tuple(a for a in (2,) if a in model.angles)
    pose, P, noise = est.models.components((0, 1, 2), angles=angles), 0.01 * np.eye(model.n), 1e-3
    first = started(kind, model, P)
    drawn = est.simulate(
        model, pose, 40, x0=first.x, P0=P, R=noise * np.eye(3), dt=0.05, rng=5, runs=500
    )
    runs = [
        started(kind, model, P).run(z, f=model, h=pose, R=noise * np.eye(3), dt=0.05)
        for z in drawn.record
    ]
    nees = [
        est.nees(t, r.x, r.P, angles=model.angles) for t, r in zip(drawn.truth, runs, strict=True)
    ]
    for squares, dof in ((nees, model.n), ([r.nis for r in runs], 3)):
        report = est.consistency_report(squares, dof)
        assert report.consistent, str(report)


def test_nees_and_nis_of_the_linear_filter_are_in_their_bands() -> None:
    """500 seeded runs of a textbook model, drawn by numpy alone."""
    rng, steps = np.random.default_rng(8), 40
    nees, nis = [], []
    for _ in range(500):
        truth, record = [rng.multivariate_normal(X0, P0)], []
        for _ in range(steps):
            truth.append(rng.multivariate_normal(F @ truth[-1], Q))
            record.append(rng.multivariate_normal(H @ truth[-1], R))
        run = est.KalmanFilter(X0, P0).run(np.array(record), F=F, Q=Q, H=H, R=R)
        nees.append(est.nees(np.array(truth[1:]), run.x, run.P))
        nis.append(run.nis)
    for squares, dof in ((nees, 4), (nis, 2)):
        report = est.consistency_report(squares, dof)
        assert report.consistent, str(report)


def test_steps_that_depend_on_each_other_are_no_reason_for_doubt() -> None:
    """NEES of a filter that is right, its errors correlated by 0.9 from step to step."""

    def squares(rng: np.random.Generator, correlation: float) -> Array:
        errors = rng.standard_normal((500, 40, 6))
        for k in range(1, 40):
            new = np.sqrt(1.0 - correlation**2) * errors[:, k]
            errors[:, k] = correlation * errors[:, k - 1] + new
        return np.sum(errors**2, axis=2)

    drawn = [squares(np.random.default_rng(seed), 0.9) for seed in range(100)]
    reports = [est.consistency_report(d, 6) for d in drawn]
    assert sum(r.consistent for r in reports) >= 97
    # Of squares: their correlation is 0.9^2, and (1 + r)/(1 - r) is 9.5.
    assert 3.5 < np.median([r.independent for r in reports]) < 6.0
    assert not any(est.consistency_report(scale * d, 6).consistent for d in drawn[:20]
                   for scale in (0.85, 1.15))  # fmt: skip
    alone = est.consistency_report(squares(np.random.default_rng(0), 0.0), 6)
    assert 33 < alone.independent <= 40
    missing = np.where(np.random.default_rng(1).random((500, 40)) < 0.3, np.nan, drawn[0])
    missing[7] = np.nan
    assert est.consistency_report(missing, 6).consistent
    assert est.consistency_report(drawn[0][0], 6).independent == 40


def test_errors_without_a_finite_square_are_no_fault_of_the_covariance() -> None:
    for name in ("truth", "x"):
        known = {"truth": X0, "x": X0, "P": P0} | {name: np.full(4, 8e153)}
        with pytest.raises(ValueError, match=f"^{name}: got"):
            est.nees(**known)
    with pytest.raises(ValueError, match=r"^P: got a matrix without an inverse"):
        est.nees(X0, X0, np.zeros((4, 4)))


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_bad_numbers_are_refused_and_change_nothing(bad: float) -> None:
    filter = est.KalmanFilter(X0, P0)
    spoiled = {"F": F, "Q": Q, "H": H, "R": R, "z": np.zeros(2)}
    for name, good in spoiled.items():
        value = good.copy()
        value.flat[0] = bad
        arguments = {**spoiled, name: value}
        step, names = (filter.predict, "FQ") if name in "FQ" else (filter.update, "zHR")
        with pytest.raises(ValueError, match=f"^{name}: got"):
            step(*(arguments[each] for each in names))
    for call, name in (
        (lambda: filter.predict(F, np.diag([1.0, 1.0, 1.0, -1.0])), "Q"),
        (lambda: filter.update([0, 0], H, [[1.0, 2.0], [2.0, 1.0]]), "R"),
        (lambda: filter.update([0, 0], H, R, gate=1.5), "gate"),
    ):
        with pytest.raises(ValueError, match=f"^{name}: got"):
            call()
    np.testing.assert_array_equal(filter.x, X0)
    np.testing.assert_array_equal(filter.P, P0)


@pytest.mark.parametrize("kind", KINDS)
def test_covariance_stays_positive(kind: str) -> None:
    """Noise from 1e-12 to 1e6, huge gaps, outliers; soak_filters.py makes 10^6 such steps."""
    assert soak(kind, steps=2000, seed=2) == 0
