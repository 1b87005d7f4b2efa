"""Other arms, measured by a laser tracker: three reflectors somewhere on the tool."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import thing_kin as tk
from calibration_cases import Array
from thing_kin import estimation as est

RIGHT = np.pi / 2
NOISE = 2e-5  # m: of each coordinate


@dataclass(frozen=True)
class Row:
    """Of Denavit-Hartenberg, with what the joint is."""

    d: float
    theta: float
    a: float
    alpha: float
    joint: str = "revolute"

    def off_by(self, e: Array) -> "Row":
        """0.5 mm, 1 mrad, a zero mark of 3 mrad or 1 mm."""
        d, theta = self.d + 5e-4 * e[0], self.theta + 1e-3 * e[3]
        d += 1e-3 * e[4] if self.joint == "prismatic" else 0.0
        theta += 3e-3 * e[4] if self.joint == "revolute" else 0.0
        return replace(
            self, d=d, theta=theta, a=self.a + 5e-4 * e[1], alpha=self.alpha + 1e-3 * e[2]
        )

    def dh(self) -> tk.DH:
        low, high = (-2.5, 2.5) if self.joint == "revolute" else (0.1, 0.9)
        return tk.DH(self.d, self.theta, self.a, self.alpha, self.joint, lower=low, upper=high)


ARMS = {
    "seven axes": [
        Row(d, 0.0, 0.0, alpha)
        for d, alpha in zip(
            (0.36, 0.0, 0.42, 0.0, 0.4, 0.0, 0.126),
            (-RIGHT, RIGHT, RIGHT, -RIGHT, -RIGHT, RIGHT, 0.0),
            strict=True,
        )
    ],
    "industrial": [
        Row(0.78, 0.0, 0.32, -RIGHT),
        Row(0.0, -RIGHT, 1.28, 0.0),
        Row(0.0, 0.0, 0.2, -RIGHT),
        Row(1.142, 0.0, 0.0, RIGHT),
        Row(0.0, 0.0, 0.0, -RIGHT),
        Row(0.2, np.pi, 0.0, 0.0),
    ],
    "gantry": [
        Row(0.0, 0.0, 0.0, -RIGHT, "prismatic"),
        Row(0.0, -RIGHT, 0.0, -RIGHT, "prismatic"),
        Row(0.0, 0.0, 0.0, 0.0, "prismatic"),
        Row(0.1, 0.0, 0.0, RIGHT),
        Row(0.0, 0.0, 0.0, -RIGHT),
        Row(0.1, 0.0, 0.0, 0.0),
    ],
    "four axes": [
        Row(0.3, 0.0, 0.3, 0.0),
        Row(0.0, 0.0, 0.25, np.pi),
        Row(0.1, 0.0, 0.0, 0.0, "prismatic"),
        Row(0.05, 0.0, 0.0, 0.0),
    ],
}


@dataclass(frozen=True)
class Tracked:
    """An arm, its truth, and what the tracker saw."""

    nominal: tk.Chain
    true: tk.Chain
    base: Array
    reflectors: Array  # on the flange
    q: Array
    measured: Array

    def places(self, q: Array) -> Array:
        T = self.base @ self.true.fk(q)
        return np.stack([(T @ [*p, 1.0])[:, :3] for p in self.reflectors], axis=1)

    def error(self, result: est.Calibration) -> float:
        """Rms distance of predicted from true places, at other postures."""
        q = self.nominal.random(200, rng=99)
        predicted = result.predict(q)
        seen = np.stack([(predicted @ [*p, 1.0])[:, :3] for p in result.points], axis=1)
        return float(np.sqrt(np.mean(np.sum((seen - self.places(q)) ** 2, axis=-1))))


def tracked(name: str, urdf: bool = False, postures: int = 40, seed: int = 0) -> Tracked:
    rng = np.random.default_rng([seed, len(name)])
    rows = ARMS[name]
    nominal = tk.Chain.from_dh([row.dh() for row in rows])
    nominal = tk.Chain.from_urdf(nominal.to_urdf()) if urdf else nominal
    true = tk.Chain.from_dh([row.off_by(rng.normal(size=5)).dh() for row in rows])
    base = tk.transform(xyz=rng.normal(0, 4, 3))
    base[:3, :3] = tk.lie.so3_exp(rng.uniform(-2, 2, 3))
    q = nominal.random(postures, rng=rng)
    arm = Tracked(nominal, true, base, rng.uniform(-0.15, 0.15, (3, 3)), q, np.empty(0))
    measured = arm.places(q) + rng.normal(0, NOISE, (postures, 3, 3))
    measured[rng.uniform(size=(postures, 3)) < 0.1] = np.nan  # hidden at times
    return replace(arm, measured=measured)


@pytest.mark.parametrize("known", [False, True], ids=["reflectors anywhere", "reflectors known"])
@pytest.mark.parametrize("urdf", [False, True], ids=["rows", "URDF"])
@pytest.mark.parametrize("name", ARMS)
def test_held_out_places_within_the_noise(name: str, urdf: bool, known: bool) -> None:
    """Of 0.02 mm a coordinate, 0.035 mm a place, at 40 postures; nominal chains miss by 0.5 mm."""
    arm = tracked(name, urdf)
    points = arm.reflectors if known else None
    result = est.calibrate(arm.nominal, arm.q, arm.measured, parameters="all", points=points)
    assert result.success
    assert not result.degenerate
    assert result.hints == ()
    assert result.rms_position_nominal > 4e-4
    assert arm.error(result) < np.sqrt(3) * NOISE
    assert result.noise_position == pytest.approx(NOISE, rel=0.25)
    assert len(result.outliers) <= 2


def test_swapped_reflectors_are_outliers() -> None:
    arm = tracked("seven axes")
    measured = arm.measured.copy()
    measured[:6] = measured[:6][:, [1, 0, 2]]
    result = est.calibrate(arm.nominal, arm.q, measured, parameters="all")
    assert arm.error(result) < 2 * NOISE
    swapped = {(i, j) for i in range(6) for j in (0, 1) if np.isfinite(measured[i, j]).all()}
    assert swapped <= set(result.outliers)


def test_each_place_has_its_covariance() -> None:
    """One reflector a thousand times as noisy as the others: as if it were not there."""
    arm = tracked("seven axes")
    rng = np.random.default_rng(1)
    measured = np.where(np.isnan(arm.measured), arm.places(arm.q), arm.measured)
    measured[:, 1] += rng.normal(0, 1e3 * NOISE, (40, 3))
    variances = np.tile([1.0, 1e6, 1.0], 40) * NOISE**2
    given = {"points": arm.reflectors, "loss": "linear"}
    result = est.calibrate(
        arm.nominal, arm.q, measured, covariance=variances[:, None, None] * np.eye(3), **given
    )
    given["points"] = arm.reflectors[[0, 2]]
    alone = est.calibrate(
        arm.nominal, arm.q, measured[:, [0, 2]], covariance=NOISE**2 * np.eye(3), **given
    )
    assert_allclose(result.joint_offsets[1:6], alone.joint_offsets[1:6], atol=1e-6)
    assert result.variance_factor == pytest.approx(
        (alone.variance_factor * alone.dof + 120) / result.dof, rel=0.1
    )


# --- what a new user gets wrong


def hints(arm: Tracked, **changed: object) -> str:
    given = {"chain": arm.nominal, "q": arm.q, "measured": arm.measured, "parameters": "all"}
    result = est.calibrate(**{**given, **changed})
    for hint in result.hints:
        assert f"HINT: {hint}" in result.report()
    return " | ".join(result.hints)


def test_hints_of_units() -> None:
    arm = tracked("seven axes")
    assert "millimeters in place of meters" in hints(arm, measured=1e3 * arm.measured)
    assert "degrees in place of radians" in hints(arm, q=np.degrees(arm.q))
    assert "points are farther" in hints(arm, points=1e3 * arm.reflectors)


def test_no_hint_of_degrees_for_many_turns() -> None:
    arm = tracked("seven axes")
    assert hints(arm, q=arm.q + 8.0 * np.pi) == ""


def test_hints_of_many_outliers() -> None:
    arm = tracked("seven axes")
    measured = arm.measured.copy()
    measured[::3] += np.random.default_rng(0).normal(0, 0.02, measured[::3].shape)
    assert "% are outliers" in hints(arm, measured=measured)


def test_hints_of_order() -> None:
    arm = tracked("seven axes")
    assert "another order" in hints(arm, q=arm.q[:, ::-1])
    assert "another order" in hints(arm, q=np.roll(arm.q, 1, axis=0))
    said = hints(arm, points=arm.reflectors[[1, 2, 0]])
    assert "with `points` left out" in said
    assert "another order" in said
    inverse = np.linalg.inv(arm.base @ arm.true.fk(arm.q))
    assert "poses of the world in the tool" in hints(arm, measured=inverse)


def test_hints_of_parameters() -> None:
    arm = tracked("industrial")
    said = hints(arm, parameters=("base", "joint_offsets"))
    assert said.startswith("with the links' numbers, too (parameters='all')")
    # An arm whose links are as they should be needs no more.
    offsets = np.full(6, 2e-3)
    q = arm.nominal.random(40, rng=0)
    flange = arm.nominal.fk(q + offsets)
    places = np.stack([(flange @ [*p, 1.0])[:, :3] for p in arm.reflectors], axis=1)
    places += np.random.default_rng(0).normal(0, NOISE, places.shape)
    assert hints(arm, q=q, measured=places, parameters=("base", "joint_offsets")) == ""


def test_no_hints_for_a_head_that_pans_and_tilts() -> None:
    """No link has a length: how far apart places are says nothing of their unit."""
    rows = (Row(0.0, 0.0, 0.0, RIGHT), Row(0.0, 0.0, 0.0, 0.0))
    head = tk.Chain.from_dh([row.dh() for row in rows])
    q = head.random(40, rng=0)
    measured = head.fk(q + np.array([0.01, 0.02])) @ tk.transform(xyz=(0.1, 0.2, 0.3))
    assert est.calibrate(head, q, measured).hints == ()


def test_hints_of_nothing() -> None:
    arm = tracked("four axes")
    assert hints(arm, measured=np.full_like(arm.measured, np.nan)) == (
        "nothing was measured: all is NaN"
    )
    # Degenerate data are no mistake of the user's.
    one = np.repeat(arm.measured[:1], 20, axis=0)
    assert hints(arm, q=np.repeat(arm.q[:1], 20, axis=0), measured=one) == ""
    assert hints(arm, q=arm.q[:1], measured=arm.measured[:1]) == ""


@pytest.mark.parametrize("shape", [(40, 9), (3, 40, 3), (120, 3), (40, 7), (40, 3, 4)])
def test_shapes_are_explained(shape: tuple[int, ...]) -> None:
    arm = tracked("seven axes")
    with pytest.raises(ValueError, match=r"^measured: got shape .* \(40, k, 3\) of k points"):
        est.calibrate(arm.nominal, arm.q, np.zeros(shape))


def test_half_a_point_is_refused_by_its_place() -> None:
    arm = tracked("seven axes")
    measured = np.where(np.isnan(arm.measured), 0.0, arm.measured)
    measured[7, 2, 1] = np.nan
    with pytest.raises(ValueError, match="measured: got NaN or inf at posture 7, point 2"):
        est.calibrate(arm.nominal, arm.q, measured)


# --- data that can't tell


def test_reflectors_on_the_last_axis() -> None:
    """Its joint turns nothing that is seen, but what was seen is predicted."""
    arm = tracked("seven axes")
    places = replace(arm, reflectors=np.array([[0, 0, 0.1], [0, 0, 0.2], [0, 0, 0.3]]))
    measured = places.places(arm.q)
    result = est.calibrate(arm.nominal, arm.q, measured, parameters="all")
    assert "joint_offsets[6]" in result.unidentifiable
    assert places.error(result) < 1e-6


def test_one_reflector_that_was_never_seen() -> None:
    arm = tracked("seven axes")
    measured = arm.measured.copy()
    measured[:, 1] = np.nan
    result = est.calibrate(arm.nominal, arm.q, measured, parameters="all")
    assert {f"points[1].{axis}" for axis in "xyz"} <= set(result.unidentifiable)
    assert_allclose(result.points[1], 0.0, atol=1e-12)
    assert not any(name.startswith("points[0]") for name in result.combinations if "," not in name)


def test_a_known_reflector_that_was_never_seen() -> None:
    """It does not spoil where Ceres begins."""
    arm = tracked("seven axes")
    tool = tk.transform(xyz=(0.1, 0.0, 0.2), rpy=(2.0, -1.0, 1.0))
    points = (np.linalg.inv(tool) @ np.column_stack([arm.reflectors, np.ones(3)]).T)[:3].T
    hidden = np.full((len(arm.q), 1, 3), np.nan)
    three = est.calibrate(arm.nominal, arm.q, arm.measured, points=points)
    four = est.calibrate(
        arm.nominal,
        arm.q,
        np.concatenate([arm.measured, hidden], axis=1),
        points=np.vstack([points, [0.3, 0.3, 0.3]]),
    )
    assert_allclose(four.tool, three.tool, atol=1e-6)
    assert four.iterations == three.iterations


def test_fewer_postures_than_it_takes() -> None:
    arm = tracked("seven axes")
    for postures in (1, 2, 3):
        result = est.calibrate(
            arm.nominal, arm.q[:postures], arm.measured[:postures], parameters="all"
        )
        assert result.degenerate
        assert set(result.unidentifiable) >= {f"joint_offsets[{i}]" for i in range(7)}
        assert np.abs(result.joint_offsets).max() < 0.1
