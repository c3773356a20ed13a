"""Two formulas compared at points: what agrees, where it does not, and hostile input; and formulas as LaTeX."""

import math
import time

import numpy as np
import pytest

from armlab.content.expressions import LONGEST
from armlab.content.identity import (
    DRAWN,
    POINTS,
    compare,
    draws,
    read_formula,
    usual_kind,
    values_of,
    variables_of,
)
from armlab.errors import InputError


def compared(left, right, kinds=(), seed=1):
    return compare(read_formula(left), read_formula(right), dict(kinds), seed)


def value(text, **given):
    """Return the value of a formula at one point."""
    found, well = values_of(read_formula(text), {name: np.array([each + 0j]) for name, each in given.items()})
    assert well[0]
    return complex(found[0])


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("2 x^2 - x/4", 17.25),
        ("sqrt(-4)", 2j),
        ("sqrt(-x^2)", 3j),
        ("ln(-1)", math.pi * 1j),
        ("e^(i π)", -1.0),
        ("abs(3 + 4i)", 5.0),
        ("conj(1 + 2i) + re(1 + 2i) + 10 im(1 + 2i)", 22 - 2j),
        ("arg(-1 - i)", -0.75 * math.pi),
        ("atan2(-1, -1)", -0.75 * math.pi),
        ("atan2(0, -x)", math.pi),
        ("min(x, 2) + max(x, 7, 1)", 9.0),
        ("sin(30°) + deg(π)", 180.5),
        ("cosh(1)^2 - sinh(1)^2 + tanh(0)", 1.0),
        ("sec(π) + csc(π/2) + cot(π/4)", 1.0),
        ("(-2)^3 + 2^-1", -7.5),
        ("x_1 + θ2", 4.0),
    ],
)
def test_values_by_hand(text, expected):
    assert value(text, x=3.0, x1=1.0, theta2=3.0) == pytest.approx(expected, rel=0, abs=1e-12)


def test_real_formulas_have_the_values_that_lessons_give_them(rng):
    for text in ("2 x cos(y) + sqrt(2)/2", "atan2(y, x)^2 - abs(x - y)", "exp(-x^2) tan(y)", "min(x, y) sinh(x)"):
        formula = read_formula(text)
        for x, y in rng.uniform(-2.0, 2.0, (20, 2)):
            assert value(text, x=x, y=y) == pytest.approx(formula.value({"x": x, "y": y}), rel=1e-12)


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("sin(2x)", "2 sin(x) cos(x)"),
        ("(cos(x) + i sin(x))^n", "cos(n x) + i sin(n x)"),
        ("abs(z)^2", "z conj(z)"),
        ("arg(x + i y)", "atan2(y, x)"),
        ("a^2 - b^2", "(a - b) (a + b)"),
        ("φ", "phi"),
        ("1", "sin(1)^2 + cos(1)^2"),
    ],
)
def test_identities_agree(left, right):
    found = compared(left, right)
    assert found.agrees
    assert len(found.left) == POINTS
    assert found.difference.max() < 1e-12


def test_where_two_formulas_differ_most():
    found = compared("sin(x) + y^3", "sin(x) + y^2")
    assert not found.agrees
    x, y = found.points[found.worst].real
    assert found.difference.max() == pytest.approx(abs(y**3 - y**2))
    assert found.left[found.worst] == pytest.approx(math.sin(x) + y**3)
    half = compared("abs(x)", "x")
    assert 10 < half.close.sum() < 40
    assert compared("x + 1", "-x - 1").opposite
    assert not half.opposite
    # A small difference counts, however large the values are beside it.
    assert not compared("x + 1e-6", "x").agrees
    assert compared("x + 1e-12", "x").agrees


def test_kinds_decide_where_it_is_compared():
    assert not compared("sqrt(x^2)", "x").agrees
    assert compared("sqrt(x^2)", "x", {"x": "positive"}).agrees
    assert compared("arg(e^(i t))", "t", {"t": "angle"}).agrees
    assert not compared("arg(e^(i t))", "t").agrees
    assert compared("sin(n π)", "0").agrees
    assert not compared("sin(n π)", "0", {"n": "real"}).agrees
    assert not compared("conj(z)", "z").agrees
    assert compared("conj(z)", "z", {"z": "real"}).agrees
    assert [usual_kind(name) for name in ("n", "k2", "z", "w1", "x", "theta")] == [
        *("whole", "whole", "complex", "complex", "real", "real"),
    ]


def test_points_are_those_of_the_seed_and_of_the_kind():
    kinds = dict(zip("abcdf", ("real", "positive", "angle", "whole", "complex"), strict=True))
    points = draws(tuple("abcdf"), kinds, 3)
    np.testing.assert_array_equal(points, draws(tuple("abcdf"), kinds, 3))
    assert np.abs(points - draws(tuple("abcdf"), kinds, 4)).max() > 0.1
    real, positive, angle, whole, complex_ = points.T
    assert -6.0 <= real.real.min() < -5.0 < 5.0 < real.real.max() <= 6.0
    assert 0.0 < positive.real.min() < 1.0
    assert np.abs(angle).max() < math.pi
    assert set(whole.real) == set(range(-4, 5))
    assert np.abs(complex_.imag).max() > 1.5
    assert np.abs(points[:, :4].imag).max() == 0.0


def test_points_without_a_value_are_left_out_and_told():
    found = compared("1/n", "n/n^2")
    assert found.agrees
    assert found.drawn > POINTS
    none = compared("1/0", "1")
    assert (len(none.left), none.drawn, none.agrees, none.opposite) == (0, DRAWN, False, False)
    few = compared("exp(exp(x^2))", "1")
    assert len(few.left) == POINTS
    assert few.drawn > POINTS


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("9^9^9", "a power of .* is too large; at most 1000"),
        ("x^2000", "a power of 2000 is too large"),
        ("x" * 1_000_000, f"at most {LONGEST} characters, got 1000000"),
        ("(" * 200 + "x" + ")" * 200, "nested too deep"),
        ("-" * 300 + "x", "nested too deep"),
        ("sin x", r"expected a bracket after sin, as in sin\(x\)"),
        ("cos2x", r"expected a bracket after cos, as in cos\(2x\)"),
        ("sin^2(x)", "the power stands behind the bracket"),
        ("__import__('os')", "expected numbers, names"),
        ("x.__class__", "expected numbers, names"),
        ("foo + 1; import os", "expected numbers, names"),
        ("1 +", "breaks off"),
        ("", "got nothing"),
        ("x\x00y", "expected numbers, names"),
        (5, "expected a formula"),
    ],
)
def test_hostile_and_broken_text_gets_a_sentence_at_once(text, told):
    began = time.perf_counter()
    with pytest.raises(InputError, match=told):
        compare(read_formula(text), read_formula("1"), {})
    assert time.perf_counter() - began < 1.0


def test_a_formula_of_the_greatest_length_is_compared():
    long = "+".join(["x"] * (LONGEST // 2))
    assert compared(long, f"{LONGEST // 2} x").agrees


def test_too_many_variables_and_unknown_kinds_are_refused():
    with pytest.raises(InputError, match="expected at most 6 variables, got 7: a, b, c, d, f, g, h"):
        variables_of(read_formula("a+b+c+d"), read_formula("f+g+h"))
    with pytest.raises(InputError, match="imaginary"):
        compared("x", "x", {"x": "imaginary"})
