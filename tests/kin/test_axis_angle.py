"""Axis and angle by the formulas of the notes: truth cases, errata, and the digits that are kept near 0 and pi."""

import json
import math

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.axis_angle import (
    angle_by_arccos,
    angle_by_atan2,
    eigenvalue_equation,
    frame_about,
    rodrigues_terms,
    sine_vector,
)
from armlab.kin.rotations import axis_angle, rotation_about, rotation_from_axis_angle
from support.sources import TOP

TRUTH = {entry["id"]: entry for entry in json.loads((TOP / "tests/data/truth.json").read_text(encoding="utf-8"))}

AXES = [
    np.array(axis, dtype=float) for axis in ([0, 0, 1], [0, 0, -1], [1, 0, 0], [1, 2, -2], [-3, 1, 5], [1e-9, 0, -1])
]


@pytest.mark.parametrize("axis", AXES)
def test_the_frame_about_an_axis_is_a_rotation_that_carries_z_to_it(axis):
    C = frame_about(axis)
    np.testing.assert_allclose(C.T @ C, np.eye(3), rtol=0, atol=1e-15)
    assert np.linalg.det(C) == pytest.approx(1.0)
    np.testing.assert_allclose(C[:, 2], axis / np.linalg.norm(axis), rtol=0, atol=1e-15)


@pytest.mark.parametrize("axis", AXES)
def test_three_steps_and_rodrigues_make_the_same_rotation(axis):
    C, angle = frame_about(axis), 1.1
    dyad, rest, skewed = rodrigues_terms(C[:, 2])
    n, s, r = C.T
    np.testing.assert_allclose(rest, np.outer(n, n) + np.outer(s, s), rtol=0, atol=1e-15)
    np.testing.assert_allclose(skewed, np.outer(s, n) - np.outer(n, s), rtol=0, atol=1e-15)
    three = C @ rotation_about("z", angle) @ C.T
    np.testing.assert_allclose(three, dyad + rest * math.cos(angle) + skewed * math.sin(angle), rtol=0, atol=1e-15)
    np.testing.assert_allclose(three, rotation_from_axis_angle(r, angle), rtol=0, atol=1e-15)


def test_dyads_of_different_vectors_are_not_zero():
    """Text after 3.35: the mixed products are missing because I has none, and not because they vanish."""
    B = np.random.default_rng(335).normal(size=(3, 3))
    np.testing.assert_allclose(B @ B.T, sum(np.outer(b, b) for b in B.T), rtol=0, atol=1e-14)
    assert np.abs(B.T @ B - B @ B.T).max() > 0.1
    C = frame_about(AXES[3])
    assert np.abs(np.outer(C[:, 0], C[:, 1])).max() > 0.1


def test_the_formula_of_rodrigues_has_the_numbers_of_the_notes():
    case = TRUTH["C3.2-rodrigues"]
    angle, expected = case["inputs"]["theta"], case["expected"]
    dyad, rest, skewed = rodrigues_terms(np.array(case["inputs"]["r"]))
    R = dyad + rest * math.cos(angle) + skewed * math.sin(angle)
    np.testing.assert_allclose(R, expected["R"], rtol=0, atol=case["tol"])
    assert np.trace(R) == pytest.approx(expected["trace"], abs=case["tol"])


def test_the_equation_of_the_eigenvalues():
    case = TRUTH["C3.2-charpoly"]
    angle = case["inputs"]["theta"]
    np.testing.assert_allclose(eigenvalue_equation(angle), case["expected"]["quadratic"], rtol=0, atol=case["tol"])
    value = np.exp(1j * angle)
    assert abs(np.polyval(eigenvalue_equation(angle), value)) < 1e-15
    printed = abs(np.polyval(case["printed_value_if_wrong"], value))
    assert printed == pytest.approx(TRUTH["ERR-3.60"]["printed_value_if_wrong"]["printed_residual"], abs=1e-5)


def test_the_inverse_problem_of_the_notes():
    case = TRUTH["C3.2-inverse-axis-angle"]
    R, one = np.array(case["inputs"]["R"]), case["expected"]["sol1"]
    for angle in (angle_by_arccos(R), angle_by_atan2(R)):
        assert angle == pytest.approx(one["theta"], abs=case["tol"])
    np.testing.assert_allclose(sine_vector(R) / (2 * math.sin(one["theta"])), one["r"], rtol=0, atol=case["tol"])
    two = case["expected"]["sol2"]
    np.testing.assert_allclose(rotation_from_axis_angle(two["r"], two["theta"]), R, rtol=0, atol=1e-12)
    # Equation 3.66 as it is printed.
    printed = angle_by_atan2(R, 0.5)
    assert printed == pytest.approx(case["printed_value_if_wrong"]["theta_3_66"], abs=1e-12)


@pytest.mark.parametrize("key", [key for key in TRUTH if key.startswith("C3.2-inverse-near")])
def test_near_0_and_pi_of_the_notes(key):
    case = TRUTH[key]
    R, expected, tolerance = np.array(case["inputs"]["R"]), case["expected"], case["tol"]
    if "theta" in expected:
        assert angle_by_atan2(R) == pytest.approx(expected["theta"], abs=tolerance)
        if case["printed_value_if_wrong"]:
            assert angle_by_arccos(R) == pytest.approx(case["printed_value_if_wrong"]["arccos_3_63"], abs=1e-12)
    if "r" in expected:
        np.testing.assert_allclose(axis_angle(R)[0], expected["r"], rtol=0, atol=tolerance)


@pytest.mark.parametrize("axis", AXES)
@pytest.mark.parametrize("distance", [1e-8, 3e-9, 1e-10, 1e-12])
def test_within_1e_8_of_0_and_pi_it_is_exact_to_1e_7(axis, distance):
    """The angle near 0 is exact relative to itself; near pi nobody can say more than the last digit of pi."""
    r = axis / np.linalg.norm(axis)
    R = np.asarray(rotation_from_axis_angle(r, distance))
    found, angle = axis_angle(R)
    assert angle == pytest.approx(distance, rel=1e-7)
    assert float(angle_by_atan2(R)) == pytest.approx(distance, rel=1e-7)
    np.testing.assert_allclose(found, r, rtol=0, atol=1e-7)
    assert angle_by_arccos(R) < 0.5 * distance or angle_by_arccos(R) > 2.0 * distance
    R = np.asarray(rotation_from_axis_angle(r, math.pi - distance))
    found, angle = axis_angle(R)
    assert angle == pytest.approx(math.pi - distance, abs=1e-15)
    assert float(angle_by_atan2(R)) == pytest.approx(math.pi - distance, abs=1e-15)
    np.testing.assert_allclose(found * np.sign(found @ r), r, rtol=0, atol=1e-7)


@pytest.mark.parametrize("axis", [(0.0, 0.0, 0.0), (math.nan, 0.0, 1.0), (1.0, 2.0)])
def test_what_is_no_axis_is_refused_in_words(axis):
    with pytest.raises(InputError, match="axis: expected"):
        frame_about(axis)
