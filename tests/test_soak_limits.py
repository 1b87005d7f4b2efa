"""The soak of soak_limits.py, scaled down: 2 000 steps."""

import soak_limits


def test_two_thousand_random_steps() -> None:
    report = soak_limits.run(2_000, seed=1)
    assert report.violation == 0.0
    assert report.leak < 1e-9
    assert report.differing == 0
    assert report.status == {"optimal": 2_000}
    assert report.compared > 80
    assert report.unanswered < 5
    assert 500 < report.limited < 2_000
