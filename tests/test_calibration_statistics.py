"""Calibration: deviations are honest, outliers are found, folds, the report."""

import functools

import numpy as np
import pytest
from numpy.testing import assert_allclose

import thing_kin as tk
from calibration_cases import ARM, EXACT, Q, noisy, simulated
from soak_calibration import soak
from thing_kin import estimation as est


@functools.cache
def noisy_result() -> est.Calibration:
    measured = noisy(EXACT, np.random.default_rng(0), 2e-4, 2e-4)
    return est.calibrate(ARM, Q, measured, folds=5)


@pytest.mark.parametrize("loss", ["linear", "huber", "soft_l1", "cauchy", "tukey"])
def test_deviations_are_honest(loss: str) -> None:
    """Share of identifiable parameters in their own 95 % bands, 40 arms."""
    inside = []
    for seed in range(40):
        rng = np.random.default_rng([seed, 1])
        offsets = rng.normal(0, 3e-3, 6)
        q = ARM.random(30, rng=rng)
        measured = noisy(ARM.fk(q + offsets), rng, 3e-4, 5e-4)
        result = est.calibrate(ARM, q, measured, loss=loss)
        at = [result.names.index(f"joint_offsets[{i}]") for i in range(1, 5)]
        inside.append(np.abs(result.values[at] - offsets[1:5]) < 1.96 * result.std[at])
    share = np.mean(inside)  # of 160, not all independent: four deviations of 0.017 and more
    assert 0.88 < share < 0.995, share


@pytest.mark.parametrize("share", [0.0, 0.1])
def test_a_short_soak(share: float) -> None:
    """See soak_calibration.py: 25 of its arms."""
    judged = soak(25, share)
    inside = np.concatenate([j.inside for j in judged])
    assert inside.size > 200
    assert 0.9 < inside.mean() < 0.99  # parameters of an arm are correlated: 0.02 or so
    assert max(j.calibrated for j in judged) < 4e-4
    assert min(j.nominal for j in judged) > 1e-3
    assert min(j.found for j in judged) == 1.0 or share == 0.0


@pytest.mark.parametrize("loss", ["cauchy", "tukey", "huber"])
def test_outliers_are_found_and_harmless(loss: str) -> None:
    arm = simulated(1, outliers=0.1)
    result = est.calibrate(arm.nominal, arm.q, arm.measured, parameters="all", loss=loss)
    assert set(arm.spoiled) <= set(result.outliers)
    assert len(result.outliers) <= len(arm.spoiled) + 2
    assert result.noise_position == pytest.approx(2e-4, rel=0.25)
    elsewhere = arm.nominal.random(200, rng=8)
    assert np.sqrt(np.mean(arm.tool_error(result.predict(elsewhere), elsewhere) ** 2)) < 4e-4


def test_noise_is_told_apart() -> None:
    result = noisy_result()
    assert result.noise_is_estimated
    # 180 numbers each: a deviation of 5 %, taken thrice.
    assert result.noise_position == pytest.approx(2e-4, rel=0.15)
    assert result.noise_rotation == pytest.approx(2e-4, rel=0.15)
    assert result.dof == pytest.approx(360 - 16, abs=0.1)


def test_folds() -> None:
    result = noisy_result()
    assert len(result.fold_rms) == 5
    # What a parameter takes of 360 numbers it gives back held out: 16 of them, 4.5 %.
    ratio = result.cross_validated_rms_position / result.rms_position
    assert 1.02 < ratio < 1.3
    assert result.rms_position_nominal > 3 * result.rms_position
    with pytest.raises(ValueError, match="folds: got 7, expected at most the 6 distinct"):
        est.calibrate(ARM, np.repeat(Q[:6], 3, axis=0), np.repeat(EXACT[:6], 3, axis=0), folds=7)
    for folds in (-1, 0, 1):
        with pytest.raises(ValueError, match=f"^folds: got {folds}, expected at least 2"):
            result.cross_validated(folds, np.random.default_rng(0))


def test_equal_postures_stay_in_one_fold() -> None:
    """Measurements thrice the same: what is held out must not have been seen."""
    measured = noisy(EXACT[:20], np.random.default_rng(0), 2e-4, 2e-4)
    again = est.calibrate(
        ARM, np.repeat(Q[:20], 3, axis=0), np.repeat(measured, 3, axis=0), folds=5
    )
    assert again.cross_validated_rms_position > 1.1 * again.rms_position


def test_nominal_is_the_chain_with_base_and_tool_that_fit_it() -> None:
    places = est.calibrate(ARM, Q, EXACT, parameters=("base", "tool"))
    result = est.calibrate(ARM, Q, EXACT)
    assert result.rms_position_nominal == pytest.approx(places.rms_position, rel=1e-9)
    assert result.rms_rotation_nominal == pytest.approx(places.rms_rotation, rel=1e-9)


def test_the_report_says_it_all() -> None:
    text = str(noisy_result())
    assert "base.rz +1, joint_offsets[0] -1" in text
    assert "rank 16 of 18" in text
    assert "held out" in text
    for name in noisy_result().names:
        assert name in text


def test_equal_input_equal_output() -> None:
    a, b = (est.calibrate(ARM, Q, EXACT, folds=3, rng=2) for _ in range(2))
    np.testing.assert_array_equal(a.values, b.values)
    assert a.fold_rms == b.fold_rms


def test_moving_the_world_changes_the_base_alone() -> None:
    measured = noisy(EXACT, np.random.default_rng(0), 2e-4, 2e-4)
    moved = tk.transform(xyz=(1, 2, 3), rpy=(0.3, -0.2, 1.0))
    a, b = (est.calibrate(ARM, Q, m, loss="linear") for m in (measured, moved @ measured))
    assert_allclose(b.base, moved @ a.base, atol=1e-6)  # noise is estimated to a part in 100
    assert_allclose(b.joint_offsets, a.joint_offsets, atol=1e-6)
    assert_allclose(b.std[12:], a.std[12:], rtol=0.02)


@pytest.mark.parametrize("loss", ["huber", "soft_l1", "cauchy", "tukey"])
def test_what_robustness_costs(loss: str) -> None:
    """With normal noise: as efficient as 95 %, so that deviations are wider by 1/sqrt(0.95)."""
    q = ARM.random(300, rng=3)
    rng = np.random.default_rng(0)
    measured = noisy(ARM.fk(q), rng, 3e-4, 5e-4)
    given = {"covariance": np.diag([3e-4**2] * 3 + [5e-4**2] * 3), "parameters": ("base", "tool")}
    plain = est.calibrate(ARM, q, measured, loss="linear", **given)
    robust = est.calibrate(ARM, q, measured, loss=loss, **given)
    # Of several numbers, losses are a little more efficient.
    assert 1.002 < np.median(robust.std / plain.std) < 1.05


@pytest.mark.parametrize("loss", ["linear", "cauchy"])
def test_noise_is_not_biased(loss: str) -> None:
    """Mean of 60 arms with 92 degrees of freedom each: a deviation of 1.3 %."""
    ratios = []
    for seed in range(60):
        rng = np.random.default_rng([seed, 2])
        q = ARM.random(18, rng=rng)
        measured = noisy(ARM.fk(q), rng, 3e-4, 5e-4)
        result = est.calibrate(ARM, q, measured, loss=loss)
        ratios.append((result.noise_position / 3e-4) ** 2 + (result.noise_rotation / 5e-4) ** 2)
    # Without the degrees of freedom taken it would be 15 % less, without the cut's correction 4 %.
    assert np.mean(ratios) / 2 == pytest.approx(1.0, abs=0.03)


def test_each_measurement_has_its_covariance() -> None:
    """Half of them a hundred times as noisy: as if they were not there."""
    rng = np.random.default_rng(1)
    bad = np.arange(len(Q)) % 2 == 1
    scale = np.where(bad, 2e-2, 2e-4)
    measured = EXACT.copy()
    measured[:, :3, 3] += scale[:, None] * rng.normal(size=(len(Q), 3))
    turned = tk.lie.so3_exp(scale[:, None] * rng.normal(size=(len(Q), 3)))
    measured[:, :3, :3] = turned @ measured[:, :3, :3]
    covariances = scale[:, None, None] ** 2 * np.eye(6)
    result = est.calibrate(ARM, Q, measured, covariance=covariances, loss="linear")
    alone = est.calibrate(ARM, Q[~bad], measured[~bad], covariance=covariances[0], loss="linear")
    np.testing.assert_allclose(result.joint_offsets, alone.joint_offsets, atol=2e-6)
    assert result.variance_factor == pytest.approx(1.0, abs=0.25)
    # Rows that are correlated: the same information in other coordinates.
    mixed = np.eye(6) + 0.5 * np.eye(6, k=1) + 0.5 * np.eye(6, k=-1)
    ours = est.calibrate(ARM, Q, measured, covariance=4e-8 * mixed, loss="linear")
    W = np.linalg.cholesky(np.linalg.inv(4e-8 * mixed)).T
    squares = np.sum((ours.errors @ W.T) ** 2)
    assert squares / ours.dof == pytest.approx(ours.variance_factor, rel=1e-6)


@pytest.mark.parametrize("gate", [0.5, 0.9, 0.999])
def test_the_gate_is_a_quantile(gate: float) -> None:
    q = ARM.random(400, rng=5)
    measured = noisy(ARM.fk(q), np.random.default_rng(3), 3e-4, 5e-4)
    result = est.calibrate(ARM, q, measured, gate=gate)
    share = len(result.outliers) / 400
    assert share == pytest.approx(1 - gate, abs=4 * np.sqrt(gate * (1 - gate) / 400))
