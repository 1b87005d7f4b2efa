"""Calibration: what can't be seen is said."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import thing_kin as tk
from calibration_cases import ARM, BASE, EXACT, OFFSETS, TOOL, Array, Q, noisy
from thing_kin import estimation as est


def test_what_no_posture_tells() -> None:
    result = est.calibrate(ARM, Q, EXACT, parameters="all")
    assert not result.degenerate
    for name in ("base.rz", "joint_offsets[0]", "joint_offsets[5]", "dh[1].d", "dh[2].d"):
        assert name in result.unidentifiable
        assert np.isinf(result.std[result.names.index(name)])
    for name in ("joint_offsets[4]", "dh[1].a", "dh[3].alpha", "dh[4].a"):
        assert name not in result.unidentifiable
    # Three parallel axes: where along them the links are can't be told, but for the sum.
    assert any("dh[1].d" in line and "dh[2].d" in line for line in result.combinations)
    motions = len(result.names) - result.rank
    assert len(result.combinations) == motions


def test_one_posture_many_times() -> None:
    rng = np.random.default_rng(0)
    q = np.repeat(Q[:1], 50, axis=0)
    measured = noisy(np.repeat(EXACT[:1], 50, axis=0), rng, 2e-4, 2e-4)
    result = est.calibrate(ARM, q, measured, parameters="all")
    assert result.degenerate
    assert result.rank <= 6
    assert set(result.unidentifiable) >= {f"joint_offsets[{i}]" for i in range(6)}
    assert_allclose(result.joint_offsets, 0.0, atol=0.05)
    assert "DEGENERATE" in result.report()


def test_encoder_noise_does_not_hide_that() -> None:
    rng = np.random.default_rng(0)
    q = Q[0] + rng.normal(0, 1e-4, (50, 6))
    result = est.calibrate(ARM, q, noisy(BASE @ ARM.fk(q) @ TOOL, rng, 2e-4, 2e-4))
    assert result.degenerate
    assert set(result.unidentifiable) >= {f"joint_offsets[{i}]" for i in range(6)}
    assert np.abs(result.joint_offsets).max() < 0.05  # kept near nominal


def test_postures_in_a_plane() -> None:
    q = np.tile([0.3, 0, 0, 0, -np.pi / 2, 0], (40, 1))
    q[:, 1:4] = ARM.random(40, rng=2)[:, 1:4]
    result = est.calibrate(ARM, q, BASE @ ARM.fk(q + OFFSETS) @ TOOL)
    assert result.degenerate
    assert {"joint_offsets[0]", "joint_offsets[4]", "joint_offsets[5]"} <= set(
        result.unidentifiable
    )
    assert result.rms_position < 1e-6


@pytest.mark.parametrize("postures", [1, 2, 3])
def test_fewer_than_the_parameters(postures: int) -> None:
    result = est.calibrate(ARM, Q[:postures], EXACT[:postures], parameters="all")
    assert result.degenerate
    assert result.status == "underdetermined"
    assert not result.success
    assert not result.noise_is_estimated
    assert np.isfinite(result.values).all()


def test_nothing_measured_at_all() -> None:
    nothing = np.full((3, 4, 4), np.nan)
    result = est.calibrate(ARM, Q[:3], nothing)
    assert result.status == "underdetermined"
    assert result.unidentifiable == result.names
    assert_allclose(result.values, 0.0)


def test_priors_tell_what_data_do_not() -> None:
    free = est.calibrate(ARM, Q, EXACT)
    told = est.calibrate(ARM, Q, EXACT, priors={"joint_offsets[0]": 1e-4, "joint_offsets[5]": 0.0})
    at = told.names.index("joint_offsets[0]")
    assert np.isinf(free.std[free.names.index("joint_offsets[0]")])
    assert told.std[at] == pytest.approx(1e-4, rel=1e-3)
    assert "joint_offsets[5]" not in told.names
    assert "tool.rz" not in told.unidentifiable


def test_proposed_postures_tell_more() -> None:
    few, true = Q[:8], ARM.random(300, rng=7)
    measured = noisy(BASE @ ARM.fk(few + OFFSETS) @ TOOL, np.random.default_rng(1), 2e-4, 2e-4)
    result = est.calibrate(ARM, few, measured, parameters="all")
    chosen = result.propose_postures(6, candidates=true)
    assert chosen.shape == (6, 6)
    assert all(any((row == c).all() for c in true) for row in chosen)

    def volume(more: Array) -> float:
        q = np.vstack([few, more])
        covariance = np.diag([4e-8] * 6)
        P = est.calibrate(
            ARM, q, BASE @ ARM.fk(q + OFFSETS) @ TOOL, parameters="all", loss="linear",
            covariance=covariance,
        ).covariance  # fmt: skip
        return float(np.linalg.slogdet(P)[1])

    random = [volume(ARM.random(6, rng=seed)) for seed in range(8)]
    assert volume(chosen) < min(random) - 1.0


def test_combinations_begin_with_a_plus() -> None:
    for parameters in ("all", ("base", "tool", "origins")):
        result = est.calibrate(ARM, Q, EXACT, parameters=parameters)
        lines = [line for line in result.combinations if "," in line]
        assert len(lines) >= 3
        assert all(line.split(",")[0].split()[-1].startswith("+") for line in lines)


def test_proposals_take_into_account_what_is_proposed() -> None:
    """The best of all, chosen again and again, would tell less and less."""
    result = est.calibrate(ARM, Q[:8], EXACT[:8])
    candidates = ARM.random(40, rng=1)
    chosen = result.propose_postures(6, candidates)
    assert len(np.unique(chosen.round(9), axis=0)) >= 4


def test_proposals_for_a_mobile_arm() -> None:
    """Each posture had a covariance of its own; those that are proposed have none."""
    robot = tk.robots.thing()
    q = robot.random(12, rng=0)
    result = est.calibrate(
        robot, q, robot.fk(q), parameters=("mount", "tool"),
        base_covariance=np.tile(1e-6 * np.eye(3), (12, 1, 1)),
    )  # fmt: skip
    assert result.propose_postures(2, 200).shape == (2, 9)
    assert not result.degenerate


@pytest.mark.parametrize("candidates", [np.empty((0, 6)), np.zeros(6), np.zeros((3, 5)), 0])
def test_candidates_that_are_none(candidates: Array | int) -> None:
    result = est.calibrate(ARM, Q, EXACT)
    with pytest.raises(ValueError, match=r"^candidates: got"):
        result.propose_postures(2, candidates)


def test_proposals_for_an_arm_that_sags() -> None:
    result = est.calibrate(ARM, Q, EXACT, sag=(1, 2))
    assert result.propose_postures(2, 50).shape == (2, 6)
