"""Coils in a field: forces and torque from cross products, the ripple in closed form, and a rotor that is let go."""

import math

import numpy as np
import pytest
from scipy.integrate import trapezoid

from armlab.errors import InputError
from armlab.kin.drive import Coil, let_go, ripple, torque
from armlab.kin.drive.coils import AXIS, FIELD, MOST_COILS, UP, extremes, single_torques

COIL = Coil(B=0.5, current=2.0, length=0.05, radius=0.02, turns=50)
ANGLES = np.linspace(-7.0, 7.0, 57)


def test_the_force_is_the_current_times_length_across_field():
    assert COIL.force == pytest.approx(50 * 2.0 * 0.05 * 0.5)
    arms, wires, forces = COIL.sides(0.7)
    np.testing.assert_allclose(forces[0], 50 * 2.0 * np.cross(0.05 * wires[0], 0.5 * FIELD), rtol=0, atol=1e-15)
    np.testing.assert_allclose(forces[0], -forces[1])
    np.testing.assert_allclose(np.linalg.norm(arms, axis=1), 0.02)
    np.testing.assert_allclose(np.cross(FIELD, AXIS), UP)


@pytest.mark.parametrize("switched", [True, False])
def test_the_torque_is_the_sum_of_the_levers_and_lies_along_the_axis(switched):
    for theta in ANGLES:
        arms, _, forces = COIL.sides(theta, switched)
        vector = COIL.torque_vector(theta, switched)
        np.testing.assert_allclose(vector, sum(np.cross(r, f) for r, f in zip(arms, forces, strict=True)), atol=1e-15)
        np.testing.assert_allclose(vector, COIL.peak * float(torque(theta, 1, switched)) * AXIS, rtol=0, atol=1e-15)


def test_without_a_commutator_the_torque_changes_its_sign_and_with_one_it_does_not():
    assert (torque(ANGLES, 1, True) >= 0.0).all()
    np.testing.assert_allclose(torque(ANGLES, 1, False), np.sin(ANGLES), atol=1e-15)
    for k in range(-2, 3):
        assert float(torque(k * math.pi, 1)) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("coils", range(1, MOST_COILS + 1))
def test_the_ripple_in_closed_form_is_that_of_the_sampled_sum(coils):
    theta = np.linspace(0.0, 2.0 * math.pi, 48 * 5 * 7 * 11 * 2 + 1)[:-1]
    sampled = torque(theta, coils)
    least, largest, mean = extremes(coils)
    assert sampled.min() == pytest.approx(least, abs=1e-6)
    assert sampled.max() == pytest.approx(largest, abs=1e-6)
    assert sampled.mean() == pytest.approx(mean, abs=1e-6)
    assert (largest - least) / mean == pytest.approx(ripple(coils), rel=1e-12)
    assert (sampled.max() - sampled.min()) / sampled.mean() == pytest.approx(ripple(coils), abs=1e-6)


def test_more_coils_flatten_the_torque_with_the_square_of_their_number():
    found = [ripple(coils) for coils in range(1, MOST_COILS + 1)]
    assert (np.diff(found) < 0.0).all()
    assert ripple(1) == pytest.approx(math.pi / 2.0)
    assert ripple(12) == pytest.approx(math.pi**2 / (8.0 * 144.0), rel=2e-3)
    np.testing.assert_allclose(single_torques(0.3, 2), [math.sin(0.3), math.cos(0.3)])


def test_a_rotor_without_a_commutator_swings_about_pi_and_comes_to_rest():
    found = let_go(0.1, 5e-3, 4e-3, 0.5, 40.0, switched=False)
    assert found.theta[-1] == pytest.approx(math.pi, abs=1e-4)
    assert found.theta.max() < 2.0 * math.pi
    assert found.omega.min() < -1.0


def test_a_rotor_that_swings_without_friction_keeps_its_energy():
    found = let_go(0.1, 5e-3, 0.0, 0.5, 5.0, switched=False)
    energy = 0.5 * 5e-3 * found.omega**2 + 0.1 * np.cos(found.theta)
    np.testing.assert_allclose(energy, 0.1 * math.cos(0.5), rtol=0, atol=1e-8)


@pytest.mark.parametrize("coils", [1, 3])
def test_a_rotor_with_a_commutator_runs_up_by_the_work_of_its_torque(coils):
    found = let_go(0.1, 5e-3, 4e-3, 0.5, 10.0, coils)
    assert (np.diff(found.theta) > 0.0).all()
    _, _, mean = extremes(coils)
    late = found.omega[-100:].mean()
    assert late == pytest.approx(0.1 * mean / 4e-3, rel=0.05)
    # The work of the torque along the way is the energy of the motion and what friction has taken.
    free = let_go(0.1, 5e-3, 0.0, 0.5, 2.0, coils)
    way = np.linspace(0.5, float(free.theta[-1]), 200001)
    work = 0.1 * trapezoid(torque(way, coils), way)
    assert 0.5 * 5e-3 * free.omega[-1] ** 2 == pytest.approx(work, rel=1e-6)


def test_a_single_coil_at_a_dead_point_stays():
    assert np.abs(let_go(0.1, 5e-3, 4e-3, 0.0, 4.0).theta).max() < 1e-12
    assert let_go(0.1, 5e-3, 4e-3, 0.0, 4.0, 3).theta[-1] > 10.0


def test_what_cannot_be_is_refused():
    with pytest.raises(InputError, match="coils"):
        torque(0.0, 0)
    with pytest.raises(InputError, match="J"):
        let_go(0.1, 0.0, 0.0, 0.5, 1.0)
    with pytest.raises(InputError, match="T"):
        let_go(0.1, 1.0, 0.0, 0.5, math.inf)
