"""A soak of calibration: simulated arms with random errors, noise and outliers.

    python tests/soak_calibration.py --arms 500

For each share of outliers: how many of the parameters that the data tell lie in their own 95 %
bands, and the error of the tool at other postures, nominal (with base and tool fitted) and
calibrated. Combinations are judged, too: what an arm's rows add up to is told even where single
rows are not.
"""

import argparse
from dataclasses import dataclass

import numpy as np

import thing_kin as tk
from calibration_cases import Array, SimulatedArm, simulated
from thing_kin import estimation as est

NINETY_FIVE = 1.959963984540054


@dataclass(frozen=True)
class Judged:
    """Of one arm."""

    inside: Array  # of each parameter that is told and was drawn
    nominal: float  # rms error of the tool, m
    calibrated: float
    found: float  # share of the outliers
    wrong: int  # good measurements called outliers


def judge(arm: SimulatedArm, loss: str = "cauchy") -> Judged:
    """Calibrate and compare with the truth."""
    result = est.calibrate(arm.nominal, arm.q, arm.measured, parameters="all", loss=loss)
    assert np.isfinite(result.values).all()
    told = [n for n in result.names if n in arm.truth and n not in result.unidentifiable]
    at = [result.names.index(name) for name in told]
    truth = np.array([arm.truth[name] for name in told])
    places = est.calibrate(arm.nominal, arm.q, arm.measured, parameters=("base", "tool"), loss=loss)
    elsewhere = arm.nominal.random(100, rng=77)

    def rms(of: est.Calibration) -> float:
        return float(np.sqrt(np.mean(arm.tool_error(of.predict(elsewhere), elsewhere) ** 2)))

    flagged = set(result.outliers)
    return Judged(
        np.abs(result.values[at] - truth) < NINETY_FIVE * result.std[at],
        rms(places),
        rms(result),
        len(flagged & set(arm.spoiled)) / max(len(arm.spoiled), 1),
        len(flagged - set(arm.spoiled)),
    )


def soak(arms: int, outliers: float, first: int = 0) -> list[Judged]:
    """Judge so many arms."""
    return [judge(simulated(seed, outliers=outliers)) for seed in range(first, first + arms)]


def summary(judged: list[Judged], outliers: float) -> str:
    """Return a line."""
    inside = np.concatenate([j.inside for j in judged])
    quantiles = (50, 95, 100)
    nominal = 1e3 * np.percentile([j.nominal for j in judged], quantiles)
    calibrated = 1e3 * np.percentile([j.calibrated for j in judged], quantiles)
    found = np.mean([j.found for j in judged]) if outliers else np.nan
    return (
        f"{100 * outliers:3.0f} % outliers, {len(judged)} arms: {100 * inside.mean():.1f} % of "
        f"{inside.size} parameters in their 95 % bands; tool error rms [mm], median / 95 % / most: "
        f"nominal {nominal.round(2)}, calibrated {calibrated.round(3)}; outliers found "
        f"{100 * found:.1f} %, {sum(j.wrong for j in judged)} good measurements flagged"
    )


def main() -> None:
    """Run the soak."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--arms", type=int, default=500)
    arguments = parser.parse_args()
    print(f"thing_kin {tk.__version__}")
    for outliers in (0.0, 0.05, 0.1):
        print(summary(soak(arguments.arms, outliers), outliers), flush=True)


if __name__ == "__main__":
    main()
