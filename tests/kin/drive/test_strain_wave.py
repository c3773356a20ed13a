"""Harmonic drives: ratios with their signs, counted teeth, and a flexspline whose teeth fit."""

import math

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.drive.strain_wave import (
    HEIGHT,
    LOBES,
    SLOPE,
    WIDTH,
    counted_teeth,
    strain_wave,
)


@pytest.mark.parametrize("name", ["C2.2-harmonic-160", "C2.2-harmonic-200", "C2.2-harmonic-400"])
def test_the_ratios_of_the_notes_with_their_signs(truth, name):
    case = truth[name]
    teeth, difference = case["inputs"]["N_FS"], case["inputs"]["N_CS"] - case["inputs"]["N_FS"]
    drive = strain_wave(teeth, difference)
    assert abs(drive.ratio) == pytest.approx(case["expected"]["n"], abs=case["tol"])
    assert drive.ratio == pytest.approx(case["expected"]["signed_ratio_CS_fixed"], abs=case["tol"])
    flexible = strain_wave(teeth, difference, "flexible")
    assert flexible.ratio == pytest.approx(case["expected"]["ratio_FS_fixed"], abs=case["tol"])


@pytest.mark.parametrize("difference", LOBES)
@pytest.mark.parametrize("teeth", [40, 160])
def test_counting_teeth_gives_the_ratio_and_its_sign(teeth, difference):
    """Erratum 2.29: the flexspline goes against the wave generator, by the difference of the teeth in each turn."""
    drive = strain_wave(teeth, difference)
    assert counted_teeth(drive) == -difference
    assert counted_teeth(drive, 3) == -3 * difference
    assert 1.0 / drive.ratio == pytest.approx(float(counted_teeth(drive)) / teeth, abs=1e-15)


@pytest.mark.parametrize("fixed", ["circular", "flexible", "generator"])
@pytest.mark.parametrize("difference", LOBES)
def test_seen_from_the_wave_generator_the_splines_roll_on_each_other(fixed, difference):
    drive = strain_wave(60, difference, fixed)
    generator, flexible, circular = drive.angles(1.7)
    rolled = drive.flexspline * (flexible - generator), drive.circular * (circular - generator)
    assert rolled[0] == pytest.approx(rolled[1])
    parts = {"generator": generator, "flexible": flexible, "circular": circular}
    assert parts[fixed] == 0.0
    assert parts[drive.input] == 1.7
    assert parts[drive.input] / parts[drive.output] == pytest.approx(drive.ratio)


def test_the_middle_line_of_the_flexspline_keeps_its_length():
    drive = strain_wave(200)
    beta = np.linspace(0.0, 2.0 * math.pi, 4001)
    radius, angle, tilt = drive.shape(beta)
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    length = float(np.hypot(np.diff(x), np.diff(y)).sum())
    assert length == pytest.approx(2.0 * math.pi * 100.0, rel=2e-4)
    # The inclination is that of the drawn line, which is at right angles to the radius on a circle.
    heading = np.unwrap(np.arctan2(np.gradient(y), np.gradient(x)))
    inclined = heading - (beta + 0.5 * math.pi) - (heading[2000] - beta[2000] - 0.5 * math.pi)
    np.testing.assert_allclose(inclined[5:-5], (tilt - tilt[2000])[5:-5], rtol=0, atol=2e-3)


def overlaps(drive, theta):
    """Return by how much, in modules, teeth of the flexspline reach into those of the circular spline, and how many
    are inside its gaps."""
    generator, flexible, circular = drive.angles(theta)
    own = 2.0 * math.pi * np.arange(drive.flexspline) / drive.flexspline
    lobe = generator - flexible
    radius, angle, tilt = drive.shape(own - lobe)
    place = radius * np.exp(1j * (angle + lobe + flexible))
    outwards = np.exp(1j * (own + flexible + tilt))
    pitch, half = 2.0 * math.pi / drive.circular, 0.5 * drive.circular
    deepest, meshing = -math.inf, np.zeros(drive.flexspline, dtype=bool)
    for up in np.linspace(-HEIGHT, HEIGHT, 15):
        for side in (-1.0, 1.0):
            corner = place + outwards * (up + 1j * side * (WIDTH - SLOPE * up))
            rho = np.abs(corner)
            inside = (rho > half - HEIGHT) & (rho < half + HEIGHT)
            # Teeth of the circular spline stand half a tooth beside those of the flexspline.
            off = (np.angle(corner) - circular) % pitch - 0.5 * pitch
            depth = WIDTH - SLOPE * (half - rho) - np.abs(off) * rho
            deepest = max(deepest, float(depth[inside].max(initial=-math.inf)))
            meshing |= inside
    return deepest, int(meshing.sum())


@pytest.mark.parametrize("fixed", ["circular", "flexible", "generator"])
@pytest.mark.parametrize("difference", LOBES)
@pytest.mark.parametrize("teeth", [40, 60, 200, 400])
def test_the_teeth_fit_into_each_other_wherever_the_generator_stands(teeth, difference, fixed):
    drive = strain_wave(teeth, difference, fixed)
    for theta in (0.0, 0.3, 2.0, 40.0):
        deepest, meshing = overlaps(drive, theta)
        assert deepest < 0.02
        assert 0.05 * teeth < meshing < 0.8 * teeth


def test_between_the_lobes_the_teeth_are_free():
    drive = strain_wave(100)
    radius, _, _ = drive.shape(np.array([0.0, 0.5 * math.pi]))
    assert radius[0] == 0.5 * drive.circular
    assert 0.5 * drive.circular - radius[1] > 2.0 * HEIGHT


@pytest.mark.parametrize(
    ("teeth", "difference", "told"),
    [
        (0, 2, "teeth of the flexspline: expected a whole number from 40 to 400, got 0"),
        (200.5, 2, "teeth of the flexspline: expected a whole number from 40 to 400, got 200.5"),
        (1000, 2, "expected a whole number from 40 to 400, got 1000"),
        (200, 0, "expected 2, 3 or 4 more than the 200 of the flexspline, which fit two, three or two lobes, got 200"),
        (200, 1, "three or two lobes, got 201"),
        (200, -2, "got 198"),
    ],
)
def test_a_drive_that_cannot_be_is_refused_in_words(teeth, difference, told):
    with pytest.raises(InputError, match=told):
        strain_wave(teeth, difference)
    with pytest.raises(InputError, match="fixed part"):
        strain_wave(200, 2, "nothing")
