"""Cylindrical and spherical coordinates."""

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.coordinates import cylindrical, from_cylindrical, from_spherical, spherical


def test_the_point_of_the_notes(truth):
    case = truth["C3.1-cyl"]
    expected = [case["expected"][name] for name in ("r", "theta", "h")]
    np.testing.assert_allclose(cylindrical(case["inputs"]["xyz"]), expected, rtol=0, atol=case["tol"])
    np.testing.assert_allclose(from_cylindrical(*expected), case["inputs"]["xyz"], rtol=0, atol=case["tol"])


def test_the_azimuth_is_atan2_of_the_notes(truth):
    case = truth["C3.1-atan2"]
    points = [[x, y, 0.3] for y, x in case["inputs"]["yx"]]
    for theta in (cylindrical(points)[1], spherical(points)[1]):
        np.testing.assert_allclose(theta, case["expected"]["theta"], rtol=0, atol=case["tol"])


def test_points_come_back(rng):
    p = rng.normal(size=(20, 30, 3))
    p[0, :10] *= 1e-12
    p[1, :10, :2] *= 1e-12
    for there, back in ((cylindrical, from_cylindrical), (spherical, from_spherical)):
        coordinates = there(p)
        assert [value.shape for value in coordinates] == [(20, 30)] * 3
        np.testing.assert_allclose(back(*coordinates), p, rtol=0, atol=2e-15)


def test_coordinates_come_back(rng):
    r, theta, z = rng.uniform(0.1, 2, 50), rng.uniform(-3.1, 3.1, 50), rng.uniform(-1, 1, 50)
    np.testing.assert_allclose(cylindrical(from_cylindrical(r, theta, z)), [r, theta, z], rtol=0, atol=1e-14)
    phi = rng.uniform(0.01, 3.1, 50)
    np.testing.assert_allclose(spherical(from_spherical(r, theta, phi)), [r, theta, phi], rtol=0, atol=1e-13)


def test_the_angle_from_the_pole_keeps_its_digits():
    """Where arccos(z / r) gives 0."""
    _, _, phi = spherical([1e-9, 0.0, 1.0])
    assert phi == pytest.approx(1e-9, rel=1e-15)
    assert np.arccos(1.0 / np.hypot(1.0, 1e-9)) == 0.0


@pytest.mark.parametrize("zero", [0.0, -0.0])
def test_on_the_axis_the_azimuth_is_zero(zero):
    assert np.ravel(cylindrical([-0.0, zero, -0.7])).tolist() == [0.0, 0.0, -0.7]
    assert np.ravel(spherical([-0.0, zero, -0.7])).tolist() == [0.7, 0.0, np.pi]
    assert np.ravel(spherical([zero, -0.0, 0.7])).tolist() == [0.7, 0.0, 0.0]
    assert np.ravel(spherical([zero, zero, -0.0])).tolist() == [0.0, 0.0, 0.0]


def test_behind_the_axis_the_azimuth_is_plus_pi():
    assert cylindrical([-1.0, -0.0, 0.0])[1] == np.pi
    assert spherical([-1.0, -0.0, 0.0])[1] == np.pi


def test_coordinates_broadcast():
    assert from_cylindrical(1.0, np.linspace(0, 1, 5), [[0.0], [1.0]]).shape == (2, 5, 3)
    assert from_spherical(1.0, np.linspace(0, 1, 5), [[0.0], [1.0]]).shape == (2, 5, 3)


@pytest.mark.parametrize("function", [cylindrical, spherical])
def test_wrong_input_is_named(function):
    with pytest.raises(InputError, match=r"p: expected shape \(\.\.\., 3\), got \(2,\)"):
        function([1.0, 2.0])
    with pytest.raises(InputError, match=r"p: expected points of shape .*, got 'here'"):
        function("here")
