"""The common normal of two lines: the notes' example, properties, lines that are almost parallel."""

import math
from fractions import Fraction

import numpy as np
import pytest
from scipy.optimize import minimize

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.lines import FREE, PARALLEL_ANGLE, RELATIVE_LENGTH, Line, common_normal
from armlab.kin.rotations import rotation_about, rotation_from_axis_angle
from armlab.kin.transforms import transform


def random_line(rng):
    return Line(rng.uniform(-1, 1, 3), rng.normal(size=3))


def unit(v):
    return np.asarray(v) / np.linalg.norm(v)


def tilted(line, angle, rng):
    """Return a line through another point whose direction differs by the angle."""
    side = np.cross(line.direction, rng.normal(size=3))
    return Line(rng.uniform(-1, 1, 3), rotation_from_axis_angle(side, angle) @ line.direction)


def exact_distance(first, second):
    """Return |(p2 - p1) . (z1 x z2)| / |z1 x z2| with fractions: not even the last digit is rounded."""
    z1, z2, p1, p2 = (
        [Fraction(x) for x in v.tolist()] for v in (first.direction, second.direction, first.point, second.point)
    )
    n = [z1[k - 2] * z2[k - 1] - z1[k - 1] * z2[k - 2] for k in range(3)]
    along = sum((b - a) * c for a, b, c in zip(p1, p2, n, strict=True))
    return float(abs(along)) / math.sqrt(sum(c * c for c in n))


def carried(found, first):
    """Return the frame at foot1 (x along the normal, z along the first line) after Tx(a) Rx(alpha)."""
    x, z = found.normal, first.direction
    T = transform(np.stack([x, np.cross(z, x), z], axis=-1), found.foot1)
    return T @ transform(rotation_about("x", found.alpha), [found.a, 0.0, 0.0])


def check(found, first, second, tolerance):
    """Check what must hold of every pair of lines."""
    for foot, line in ((found.foot1, first), (found.foot2, second)):
        assert np.linalg.norm(np.cross(foot - line.point, line.direction)) <= tolerance
    np.testing.assert_allclose(found.foot2 - found.foot1, found.a * found.normal, rtol=0, atol=tolerance)
    assert np.linalg.norm(found.normal) == pytest.approx(1.0, abs=1e-15)
    assert found.normal @ first.direction == pytest.approx(0.0, abs=2e-9)
    assert found.normal @ second.direction == pytest.approx(0.0, abs=2e-9)
    assert found.a >= 0.0
    assert -np.pi < found.alpha <= np.pi
    T = carried(found, first)
    np.testing.assert_allclose(T[:3, 2], second.direction, rtol=0, atol=2e-9)
    np.testing.assert_allclose(T[:3, 3], found.foot2, rtol=0, atol=tolerance)


def test_the_example_of_the_notes(truth):
    case = truth["C4.0-common-normal"]
    given, expected = case["inputs"], case["expected"]
    first, second = Line(given["p1"], given["v1"]), Line(given["p2"], given["v2"])
    found = common_normal(first, second)
    assert found.kind == "skew"
    assert found.a == pytest.approx(expected["length"], abs=case["tol"])
    assert abs(found.alpha) == pytest.approx(expected["twist_abs"], abs=case["tol"])
    np.testing.assert_allclose(found.foot1, expected["foot1"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(found.foot2, expected["foot2"], rtol=0, atol=case["tol"])
    # About +x, z goes to y by a quarter turn backwards.
    np.testing.assert_allclose(found.normal, [1, 0, 0], rtol=0, atol=case["tol"])
    assert found.alpha < 0.0


def test_random_lines(rng):
    for _ in range(200):
        first, second = random_line(rng), random_line(rng)
        found = common_normal(first, second)
        assert found.kind == "skew"
        sine = np.linalg.norm(np.cross(first.direction, second.direction))
        check(found, first, second, 2e-15 / sine + 1e-15)
        assert found.normal @ (second.point - first.point) > 0.0


def test_no_segment_is_shorter(rng):
    for _ in range(20):
        first, second = random_line(rng), random_line(rng)
        found = common_normal(first, second)

        def squared(t, first=first, second=second):
            gap = second.point + t[1] * second.direction - first.point - t[0] * first.direction
            return gap @ gap

        best = minimize(squared, [0.0, 0.0], tol=1e-14)
        assert found.a == pytest.approx(np.sqrt(best.fun), abs=1e-6)
        assert found.a <= np.sqrt(best.fun) + 1e-12


def test_seen_from_the_other_line_it_is_turned_around(rng):
    for _ in range(50):
        first, second = random_line(rng), random_line(rng)
        found, other = common_normal(first, second), common_normal(second, first)
        assert other.a == pytest.approx(found.a, rel=1e-12)
        assert other.alpha == pytest.approx(found.alpha, abs=1e-12)
        np.testing.assert_allclose(other.normal, -found.normal, rtol=0, atol=1e-12)
        np.testing.assert_allclose(other.foot1, found.foot2, rtol=0, atol=1e-11)


@pytest.mark.parametrize("angle", [1e-2, 1e-4, 1e-6, 1e-8, 2e-9])
@pytest.mark.parametrize("flipped", [False, True])
def test_almost_parallel_lines_keep_their_digits(angle, flipped, rng):
    """The feet are about 1 / angle away; their rounding is relative to that, never to its square."""
    for _ in range(40):
        first = random_line(rng)
        second = tilted(first, np.pi - angle if flipped else angle, rng)
        found = common_normal(first, second)
        assert found.kind == "skew"
        check(found, first, second, 2e-15 / angle)
        assert found.a == pytest.approx(exact_distance(first, second), rel=0, abs=1e-14)
        assert abs(np.sin(found.alpha)) == pytest.approx(math.sin(angle), rel=0, abs=1e-15)


@pytest.mark.parametrize("angle", [0.0, 1e-12, 0.9 * PARALLEL_ANGLE])
@pytest.mark.parametrize("flipped", [False, True])
def test_parallel_lines_take_the_first_lines_point(angle, flipped, rng):
    for _ in range(20):
        first = random_line(rng)
        second = tilted(first, np.pi - angle if flipped else angle, rng)
        found = common_normal(first, second)
        assert found.kind == "parallel"
        assert found.alpha == (np.pi if flipped else 0.0)
        np.testing.assert_array_equal(found.foot1, first.point)
        check(found, first, second, 3e-15)
        assert found.a == pytest.approx(
            np.linalg.norm(np.cross(second.point - first.point, second.direction)), abs=1e-14
        )


def test_lines_that_meet(rng):
    for _ in range(100):
        p, u, v = rng.uniform(-1, 1, 3), unit(rng.normal(size=3)), unit(rng.normal(size=3))
        first, second = Line(p + rng.normal() * u, u), Line(p + rng.normal() * v, v)
        found = common_normal(first, second)
        assert found.kind == "intersecting"
        assert found.a == 0.0
        assert 0.0 < found.alpha < np.pi
        np.testing.assert_allclose(found.normal, unit(np.cross(u, v)), rtol=0, atol=1e-12)
        np.testing.assert_allclose(found.foot1, p, rtol=0, atol=1e-12)
        check(found, first, second, 1e-12)


@pytest.mark.parametrize("flipped", [1.0, -1.0])
def test_the_same_line_twice_has_a_normal_that_does_not_depend_on_the_points(flipped, rng):
    for _ in range(50):
        first = random_line(rng)
        second = Line(first.point + rng.uniform(-9, 9) * first.direction, flipped * first.direction)
        found = common_normal(first, second)
        assert found.kind == "coincident"
        assert found.a == 0.0
        assert found.alpha == (0.0 if flipped > 0 else np.pi)
        check(found, first, second, 1e-14)
        again = common_normal(Line(first.point + first.direction, first.direction), second)
        np.testing.assert_allclose(found.normal, again.normal, rtol=0, atol=1e-15)


def test_the_normal_of_the_z_axis_with_itself_is_x():
    z = Line([0, 0, 0], [0, 0, 3])
    np.testing.assert_array_equal(common_normal(z, z).normal, [1, 0, 0])


def test_lengths_are_judged_relative_to_the_scale():
    for scale in (1e-3, 1.0, 1e3):
        for factor, kinds in ((0.9, ("intersecting", "coincident")), (1.1, ("skew", "parallel"))):
            gap = factor * RELATIVE_LENGTH * scale
            z = Line([0, 0, 0], [0, 0, 1])
            found = [common_normal(z, Line([gap, 0, 0], v), scale=scale).kind for v in ([0, 1, 1], [0, 0, 1])]
            assert tuple(found) == kinds


def test_tolerances_may_be_given():
    z, leaning = Line([0, 0, 0], [0, 0, 1]), Line([1e-3, 0, 0], [0, 1e-4, 1])
    assert common_normal(z, leaning).kind == "skew"
    assert common_normal(z, leaning, angle_tolerance=1e-3).kind == "parallel"
    assert common_normal(z, leaning, length_tolerance=1e-2).kind == "intersecting"
    assert common_normal(z, leaning, angle_tolerance=1e-3, length_tolerance=1e-2).kind == "coincident"


def test_a_table_comes_back_from_its_axes(rng):
    """The axes z_{i-1} and z_i of a standard table have the common normal |a_i|, alpha_i."""
    rows = [("R", a, alpha, d, theta) for a, alpha, d, theta in rng.uniform(0.1, 1.2, (6, 4))]
    frames = Arm.from_dh(rows).frames(rng.uniform(-3, 3, 6))
    for i, (_, a, alpha, _, _) in enumerate(rows):
        first, second = (Line(frames[k, :3, 3], frames[k, :3, 2]) for k in (i, i + 1))
        found = common_normal(first, second)
        assert (found.a, found.alpha) == pytest.approx((a, alpha), abs=1e-13)
        np.testing.assert_allclose(found.normal, frames[i + 1, :3, 0], rtol=0, atol=1e-13)
        np.testing.assert_allclose(found.foot2, frames[i + 1, :3, 3], rtol=0, atol=1e-13)


def test_every_kind_says_what_is_free():
    z = Line([0, 0, 0], [0, 0, 1])
    others = {
        "skew": Line([1, 0, 0], [0, 1, 0]),
        "parallel": Line([1, 0, 0], [0, 0, 1]),
        "intersecting": Line([0, 0, 1], [1, 0, 0]),
        "coincident": Line([0, 0, 1], [0, 0, -1]),
    }
    assert set(others) == set(FREE)
    for kind, line in others.items():
        found = common_normal(z, line)
        assert found.kind == kind
        assert found.free == FREE[kind]
        assert found.free.endswith(".")
    assert FREE["skew"].endswith("only the direction of x is free.")


@pytest.mark.parametrize("size", [1e-200, 1e-3, 7.0, 1e200])
def test_directions_of_any_length_become_unit_vectors(size):
    line = Line([0, 0, 0], [3 * size, 0, 4 * size])
    np.testing.assert_allclose(line.direction, [0.6, 0, 0.8], rtol=0, atol=1e-15)
    assert not line.direction.flags.writeable
    assert not line.point.flags.writeable


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda z: Line([0, 0], [0, 0, 1]), r"point: expected three finite numbers, metres, got \[0, 0\]"),
        (lambda z: Line([0, 0, 0], [0, 0, np.inf]), "direction: expected three finite numbers, got"),
        (lambda z: Line([0, 0, 0], [0, 0, 0]), "direction: expected a vector that is not zero"),
        (lambda z: common_normal(z, z, scale=0.0), "scale: expected a positive number of metres, got 0$"),
        (lambda z: common_normal(z, z, scale=float("nan")), "scale: expected a positive number of metres, got nan"),
    ],
)
def test_wrong_input_is_named(call, text):
    with pytest.raises(InputError, match=text):
        call(Line([0, 0, 0], [0, 0, 1]))
