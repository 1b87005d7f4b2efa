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
    assert result.rms_position < result.cross_validated_rms_position < 1.3 * result.rms_position
    assert result.rms_position_nominal > 3 * result.rms_position
    with pytest.raises(ValueError, match="folds: got 7, expected at most the 6 distinct"):
        est.calibrate(ARM, np.repeat(Q[:6], 3, axis=0), np.repeat(EXACT[:6], 3, axis=0), folds=7)


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
