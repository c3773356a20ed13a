"""a sin + b cos = c, with every special case, and two such equations."""

import math

import pytest

from armlab.kin.ik.trig import half_tangents, sine_cosine, wrap


def residual(theta, a, b, c):
    return abs(a * math.sin(theta) + b * math.cos(theta) - c)


def test_random_equations_have_the_angle_they_were_made_from(rng):
    for _ in range(500):
        a, b, theta = rng.normal(), rng.normal(), rng.uniform(-math.pi, math.pi)
        found = sine_cosine(a, b, a * math.sin(theta) + b * math.cos(theta))
        assert 1 <= len(found.values) <= 2
        assert min(abs(wrap(value - theta)) for value in found.values) < 1e-6
        assert all(residual(value, a, b, a * math.sin(theta) + b * math.cos(theta)) < 1e-12 for value in found.values)


def test_b_plus_c_zero_is_no_special_case(truth):
    case = truth["C4.3-tan-half-degenerate"]
    a, b, c = (case["inputs"][name] for name in "abc")
    assert sorted(sine_cosine(a, b, c).values) == pytest.approx(sorted(case["expected"]["theta"]), abs=case["tol"])
    tangents = half_tangents(a, b, c)
    assert math.inf in tangents
    assert sorted(2.0 * math.atan(u) for u in tangents) == pytest.approx(sorted(case["expected"]["theta"]), abs=1e-12)


def test_half_tangents_are_those_of_the_angles(rng):
    for _ in range(200):
        a, b, c = rng.normal(size=3)
        angles = sorted(sine_cosine(a, b, c).values)
        assert sorted(2.0 * math.atan(u) for u in half_tangents(a, b, c)) == pytest.approx(angles, abs=1e-9)


@pytest.mark.parametrize(
    ("equation", "tangents"), [((0.0, 1.0, 1.0), (0.0, 0.0)), ((0.0, 1.0, -1.0), (math.inf, math.inf))]
)
def test_both_half_tangents_at_once(equation, tangents):
    assert half_tangents(*equation) == tangents
    assert len(sine_cosine(*equation).values) == 1


def test_no_angle_one_angle_every_angle():
    assert sine_cosine(0.6, 0.8, 1.1).values == ()
    assert sine_cosine(0.6, 0.8, 1.0).values == pytest.approx((math.atan2(0.6, 0.8),))
    assert sine_cosine(0.6, 0.8, -1.0).values == pytest.approx((math.atan2(-0.6, -0.8),))
    assert sine_cosine(0.0, 0.0, 0.0).every
    nothing = sine_cosine(0.0, 0.0, 0.5)
    assert nothing.values == ()
    assert not nothing.every


def test_a_hair_beyond_the_boundary_is_the_boundary():
    assert len(sine_cosine(0.0, 1.0, 1.0 + 1e-13).values) == 1
    assert sine_cosine(0.0, 1.0, 1.0 + 1e-6).values == (0.0,)
    assert sine_cosine(0.0, 1.0, 1.0 + 2e-3).values == ()
