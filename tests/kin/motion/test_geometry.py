"""Length, curvature, torsion, Frenet frame and the parametrisation by length of curves whose values are known."""

import math

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.motion.geometry import ArcLength, ByLength, curvature, frenet, standstills
from armlab.kin.motion.law_types import law_type
from armlab.kin.motion.path_types import path_type
from armlab.kin.motion.trajectory import Trajectory

S = np.linspace(0, 1, 201)


@pytest.mark.parametrize("turns", [3.0, -2.0])
def test_a_helix_has_constant_curvature_and_torsion(turns):
    r, rise = 0.3, 1.4
    path = path_type("helix").path([[1, 2, 3], [1, 2, 3 + rise]], radius=r, turns=turns)
    h = rise / (2 * math.pi * turns)
    found = frenet(path, S)
    np.testing.assert_allclose(found.curvature, r / (r * r + h * h), rtol=1e-12)
    np.testing.assert_allclose(found.torsion, h / (r * r + h * h), rtol=1e-11)
    assert ArcLength(path).length == pytest.approx(math.hypot(rise, 2 * math.pi * turns * r), rel=1e-13)
    trihedron = np.stack([found.tangent, found.normal, found.binormal], axis=-1)
    np.testing.assert_allclose(np.linalg.det(trihedron), 1.0, rtol=0, atol=1e-12)
    np.testing.assert_allclose(np.swapaxes(trihedron, 1, 2) @ trihedron, np.eye(3) + 0 * trihedron, rtol=0, atol=1e-12)


def test_the_frenet_formulas_hold(rng):
    """dt/ds = L kappa n, dn/ds = L (-kappa t + tau b), dB/ds = -L tau n, by central differences."""
    path = path_type("quintic").path(rng.normal(size=(2, 3)), v_start=rng.normal(size=3), v_end=rng.normal(size=3))
    s, step = np.linspace(0.1, 0.9, 31), 1e-5
    here, after, before = (frenet(path, s + shift) for shift in (0.0, step, -step))
    speed = np.linalg.norm(path.at(s, 1), axis=1)[:, None]
    kappa, tau = here.curvature[:, None] * speed, here.torsion[:, None] * speed
    changes = [(getattr(after, k) - getattr(before, k)) / (2 * step) for k in ("tangent", "normal", "binormal")]
    expected = [kappa * here.normal, -kappa * here.tangent + tau * here.binormal, -tau * here.normal]
    for change, exact in zip(changes, expected, strict=True):
        np.testing.assert_allclose(change, exact, rtol=0, atol=1e-6 * (np.abs(exact).max() + 1))


@pytest.mark.parametrize("kind", ["quintic", "cubic", "polynomial"])
def test_a_straight_path_that_rests_at_its_ends_bends_nowhere(rng, kind):
    """Not even where p' is so small that its direction, and p'' over its square, are rounding."""
    near = 10.0 ** rng.uniform(-6.0, -1.0, 200)
    places = np.concatenate([S, near, 1.0 - near])
    for _ in range(30):
        start, change = rng.normal(size=3) * 10.0 ** rng.uniform(-2, 2), rng.normal(size=3) * 10.0 ** rng.uniform(-2, 2)
        found = frenet(path_type(kind).path([start, start + change]), places)
        assert not found.bends.any()
        assert not found.curvature.any()
        assert not found.normal.any()


def test_a_path_that_bends_does_so_close_to_its_rest_too(rng):
    """With p' = a s + j s^2/2 about s = 0 the curvature is |a x j| / (2 |a|^3 s)."""
    for _ in range(20):
        a = rng.normal(size=3)
        path = path_type("quintic").path(rng.normal(size=(2, 3)), a_start=a)
        s = np.array([1e-6, 3e-6, 1e-5])
        found = frenet(path, s)
        assert found.bends.all()
        expected = np.linalg.norm(np.cross(a, path.at(0.0, 3))) / (2.0 * np.linalg.norm(a) ** 3 * s)
        np.testing.assert_allclose(found.curvature, expected, rtol=1e-2)
        np.testing.assert_allclose(np.linalg.norm(found.normal, axis=1), 1.0, rtol=1e-12)


def test_a_clothoid_bends_in_proportion_to_its_length():
    path = path_type("clothoid").path([[0, 0, 0], [1, 1, 0]], turn=2.0)
    found = frenet(path, S)
    np.testing.assert_allclose(found.curvature[1:], 2 * 2.0 * S[1:] / path.length, rtol=1e-9)
    assert not found.bends[0]
    assert ArcLength(path).length == pytest.approx(path.length, rel=1e-12)
    heading = math.acos(found.tangent[0] @ found.tangent[-1])
    assert heading == pytest.approx(2.0, abs=1e-9)


def test_a_circle(rng):
    knots = rng.normal(size=(3, 3))
    path = path_type("circle").path(knots)
    distances = np.linalg.norm(path.at(S) - path.centre, axis=1)
    np.testing.assert_allclose(distances, path.radius, rtol=1e-12)
    np.testing.assert_allclose(frenet(path, S).curvature, 1 / path.radius, rtol=1e-11)
    middle = np.linalg.norm(path.at(np.linspace(0, 1, 100001)) - knots[1], axis=1)
    assert middle.min() < 1e-4 * path.radius


def test_the_arc_goes_through_the_second_point_whichever_way_round(rng):
    for _ in range(200):
        angles = rng.uniform(0, 2 * np.pi, 3)
        knots = np.column_stack([np.cos(angles), np.sin(angles)]) * 2 + [3, 4]
        path = path_type("circle").path(knots)
        np.testing.assert_allclose(path.centre, [3, 4], rtol=0, atol=1e-5)
        s = np.array([(knots[k] - path.centre) @ np.stack([path.x, path.y], axis=1) for k in range(3)])
        turned = np.arctan2(s[:, 1], s[:, 0]) % (2 * np.pi)
        assert turned[1] < path.angle + 1e-9
        assert turned[2] == pytest.approx(path.angle, abs=1e-6)


def test_a_full_circle_closes(rng):
    path = path_type("circle").path(rng.normal(size=(3, 3)), full=True)
    for order in range(4):
        np.testing.assert_allclose(path.at(0.0, order), path.at(1.0, order), rtol=0, atol=1e-9)


def test_on_a_straight_line_there_is_no_frenet_frame_and_it_is_said():
    found = frenet(path_type("line").path([[0, 0, 0], [1, 2, 3]]), S)
    assert found.moves.all()
    assert not found.bends.any()
    assert np.isfinite(found.normal).all()
    assert "the Frenet frame is not defined there" in found.remark


def test_where_the_path_stands_still_there_is_no_tangent():
    path = path_type("harmonic").path([[0, 0, 0], [1, 2, 3]])
    assert frenet(path, [0.0, 0.5]).moves.tolist() == [False, True]
    np.testing.assert_allclose(standstills(path), [0.0, 1.0], rtol=0, atol=1e-9)


def test_a_bounded_curvature_does_not_make_a_path_regular():
    """(s^3, s^3) about 0, here about s = 0.5: straight, and it stands still in the middle (6.12)."""
    path = path_type("polynomial").path([[-1, -1], [1, 1]], start=[[6, 6], [-24, -24]])
    np.testing.assert_allclose(standstills(path), [0.5], rtol=0, atol=1e-4)
    assert np.abs(frenet(path, S).curvature).max() == 0.0


def test_curvature_does_not_cancel():
    """Nearly parallel p' and p'': the formula with squares would have no digit left."""
    assert float(curvature([1.0, 0.0], [1e5, 1e-5])) == pytest.approx(1e-5, rel=1e-9)


@pytest.mark.parametrize("key", ["circle", "clothoid", "helix", "interpolating", "polyline", "overfly", "exponential"])
def test_by_length_the_speed_is_constant_and_the_curve_the_same(key, rng):
    kind = path_type(key)
    knots = rng.normal(size=(max(kind.least, 2 if kind.most == 2 else 3), 3))
    path = kind.path(knots)
    again = ByLength(path)
    s = rng.uniform(0, 1, 300)
    np.testing.assert_allclose(np.linalg.norm(again.at(s, 1), axis=1), again.arc.length, rtol=1e-10)
    np.testing.assert_allclose(again.at(s), path.at(again.arc.s(s * again.arc.length)), rtol=0, atol=1e-12)
    # The second derivative is the curvature (6.17), and across the first.
    kappa = frenet(path, again.arc.s(s * again.arc.length)).curvature
    np.testing.assert_allclose(
        np.linalg.norm(again.at(s, 2), axis=1) / again.arc.length**2, kappa, rtol=0, atol=1e-7 * (kappa.max() + 1)
    )
    assert again.continuity == path.continuity
    s = s[np.abs(s[:, None] - again.pieces).min(axis=1, initial=1) > 1e-4]
    for order in range(1, 4):
        differences = (again.at(s + 1e-5, order - 1) - again.at(s - 1e-5, order - 1)) / 2e-5
        size = max(np.abs(again.at(s, k)).max() for k in range(order + 1))
        np.testing.assert_allclose(again.at(s, order), differences, rtol=0, atol=1e-5 * size)


def test_length_and_its_inverse(rng):
    path = path_type("spline").path(rng.normal(size=(8, 3)), ends="natural")
    arc = ArcLength(path)
    s = np.sort(rng.uniform(0, 1, 500))
    np.testing.assert_allclose(arc.s(arc.sigma(s)), s, rtol=0, atol=1e-11)
    chords = np.linalg.norm(np.diff(path.at(np.linspace(0, 1, 200001)), axis=0), axis=1).sum()
    assert arc.length == pytest.approx(chords, rel=1e-8)


def test_a_curve_that_stands_still_has_no_length_parameter():
    with pytest.raises(InputError, match="p' = 0 at s = 0"):
        ByLength(path_type("cubic").path([[0, 0], [1, 2]]))


def test_centripetal_and_tangential_acceleration(rng):
    """By length: acceleration = s'' t + kappa s'^2 n (6.134-6.135)."""
    path = ByLength(path_type("circle").path(rng.normal(size=(3, 3))))
    trajectory = Trajectory(path, law_type("double_s").law(2.0))
    t = np.linspace(0.1, 1.9, 19)
    s, ds, dds = (trajectory.law.at(t, k) * path.arc.length for k in range(3))
    found = frenet(path, s / path.arc.length)
    expected = dds[:, None] * found.tangent + (found.curvature * ds**2)[:, None] * found.normal
    np.testing.assert_allclose(trajectory.at(t, 2), expected, rtol=0, atol=1e-9)
