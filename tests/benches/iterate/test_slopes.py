"""Slopes of formulas: the rules of differentiation against differences, and exact zeros."""

import math

import pytest

from armlab.benches.iterate.runs.slopes import slope_at
from armlab.content.expressions import FUNCTIONS, parse

FORMULAS = (
    "2x - x/3 + 1/x",
    "-x^2 + x^-1.5 + 2^x + x^x",
    "sqrt(x) exp(-x) ln(x + 1)",
    "sin(2x) cos(x)^3 - tan(x/2)",
    "asin(x/2) acos(x/3) atan(x)",
    "atan2(x^2, 1 - x) + atan2(1, x)",
    "abs(x - 2) + abs(x) + min(x, 1, 2x) + max(x^2, 3x, 0)",
    "rad(30 x) + deg(x) + sin(20x°)",
)


@pytest.mark.parametrize("text", FORMULAS)
def test_slopes_are_the_limits_of_differences(text):
    formula = parse(text, ["x"])
    for x in (0.3, 0.8, 1.3):
        difference = (formula.value({"x": x + 1e-5}) - formula.value({"x": x - 1e-5})) / 2e-5
        assert slope_at(formula, x) == pytest.approx(difference, rel=1e-7, abs=1e-7)


def test_every_function_has_its_slope():
    assert all(any(f"{name}(" in text for text in FORMULAS) for name in FUNCTIONS)


@pytest.mark.parametrize(
    ("text", "x"),
    [("x^3 - 3x", 1.0), ("x^3 - 0.03x", 0.1), ("x exp(-x)", 1.0), ("sin(x)", math.pi / 2), ("0^2 + (-2)^2", 5.0)],
)
def test_a_slope_that_is_zero_but_for_rounding_is_zero(text, x):
    assert slope_at(parse(text, ["x"]), x) == 0.0


@pytest.mark.parametrize(("text", "x"), [("sqrt(x)", 0.0), ("ln(x)", -1.0), ("1/x", 0.0), ("exp(x)", 1e3)])
def test_where_there_is_no_slope_none_is_given(text, x):
    with pytest.raises((ValueError, ZeroDivisionError, OverflowError)):
        slope_at(parse(text, ["x"]), x)
