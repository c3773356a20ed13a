"""Formulas as people type them."""

import math

import pytest

from armlab.content.expressions import (
    DEEPEST,
    FUNCTIONS,
    IN_DEGREES,
    LONGEST,
    RESERVED,
    parse,
)
from armlab.content.formula_tokens import LONGEST_TOGETHER
from armlab.errors import InputError

VALUES = {"q1": 0.7, "q2": -1.1, "l1": 2.0, "l2": 0.5, "c": 3.0, "c12": 5.0}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("l1*cos(q1) + l2*cos(q1+q2)", 2 * math.cos(0.7) + 0.5 * math.cos(-0.4)),
        ("2 l1 (1 + l2) c", 18.0),
        ("l1c12 + l2c", 11.5),
        ("l1cos(q1)", 2 * math.cos(0.7)),
        ("l_1 cos(q_1) + l_2sin(q_2)", 2 * math.cos(0.7) + 0.5 * math.sin(-1.1)),
        ("l₁·cos(q₁)²", 2 * math.cos(0.7) ** 2),
        ("-q1^2", -0.49),
        ("2^3^2", 512.0),
        ("2^-2", 0.25),
        ("8/4/2", 1.0),
        ("1/2 l1", 1.0),
        ("5 - 3 - 1", 1.0),
        ("10¹²", 1e12),
        ("2·10⁻³", 0.002),
        ("atan2(1, -1) + min(3, 1, 2) + max(1, 2) + abs(-4)", 0.75 * math.pi + 7.0),
        ("rad(180) + deg(pi)", math.pi + 180.0),
        ("cos(60°) + sin(30 °)", 1.0),
        ("cos(60 deg) + sin(30deg) + 2 rad + rad(180) - pi", 3.0),
        ("180 deg^2 / pi^2", 1.0),
        ("asin(1) + acos(0) - 2 atan(1)", math.pi / 2),
        ("SIN(Pi/2)", 1.0),
        ("sqrt(tan(pi/4))", 1.0),
        ("--1", 1.0),
        ("2(3)(4)", 24.0),
    ],
)
def test_values(text, value):
    assert parse(text, VALUES).value(VALUES) == pytest.approx(value, rel=1e-14)


def test_random_formulas_have_python_s_values(rng):
    """A second implementation as judge: Python's own arithmetic on the same text."""

    def formula(depth):
        if depth == 0:
            return rng.choice(["q1", "q2", "l1", "2", "0.5", "pi"])
        a, b = formula(depth - 1), formula(depth - 1)
        return rng.choice([f"({a} + {b})", f"({a} - {b} * {b})", f"{a} / (1 + {b}**2)", f"-sin({a}) ** 2", f"cos({b})"])

    names = {"sin": math.sin, "cos": math.cos, "pi": math.pi, **VALUES}
    for _ in range(100):
        text = str(formula(3))
        expected = eval(text, {"__builtins__": {}}, names)
        assert parse(text, VALUES).value(VALUES) == pytest.approx(expected, rel=1e-13, abs=1e-13)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("q3", "unknown name 'q3'"),
        ("1/(q1-q1)", "division by zero"),
        ("sqrt(q2)", "not a real number"),
        ("acos(2)", "not a real number"),
        ("(-8)^(1/3)", "not a real number"),
        ("10^400", "too large"),
        ("1e400", "not finite"),
        ("2^100000", "a power of 100000 is too large"),
        ("9^9^9^9", "too large"),
        ("", "got nothing"),
        ("  ", "got nothing"),
        ("q1 +", "breaks off"),
        ("(q1", "a bracket is not closed"),
        ("q1)", r"'\)' cannot stand after 'q1'"),
        ("* 2", r"'\*' cannot stand at the beginning"),
        ("q1 2", "'2' cannot stand after 'q1'"),
        ("q1 + 0,5", "a decimal number is written with a point: 0.5, not 0,5"),
        ("q1,q2", "',' cannot stand after 'q1'"),
        ("1,", "',' cannot stand after '1'"),
        ("1 2", "'2' cannot stand after '1'"),
        ("cos q1", "expected a bracket after cos"),
        ("cos^2(q1)", "write cos"),
        ("atan2(1)", "atan2 takes 2 values in its brackets, got 1"),
        ("sqrt(1, 2)", "sqrt takes one value in its brackets, got 2"),
        ("q1 = 2", "got '= 2'"),
        ("__import__('os').system('ls')", "unknown name '__import__'|got"),
        ("q1.real", "got '.real'"),
        ("[1]", "got"),
        ("lambda: 1", "unknown name 'lambda'"),
        ("(" * (DEEPEST + 1) + "1" + ")" * (DEEPEST + 1), "nested too deep"),
        ("-" * 100 + "1", "nested too deep"),
        ("1^" * 100 + "1", "nested too deep"),
        ("rad 2", "'rad' cannot stand at the beginning"),
        ("1" + "°" * (LONGEST - 1), "'°' cannot stand after '°'"),
        ("1" + "+1" * LONGEST, f"at most {LONGEST} characters"),
        ("³" * LONGEST, "characters"),
        ("q1" * (LONGEST_TOGETHER // 2 + 1), "unknown name"),
    ],
)
def test_what_is_refused_says_why(text, says):
    with pytest.raises(InputError, match=says):
        parse(text, VALUES).value(VALUES)


def test_the_longest_formula_is_no_trouble():
    text = "1" + "+1" * (LONGEST // 2 - 1)
    assert parse(text).value({}) == LONGEST // 2


def test_names_that_could_be_split_in_many_ways_take_no_time():
    assert parse("a" * 59, ["a", "aa", "aaa"]).value({"a": 1.0, "aa": 1.0, "aaa": 1.0}) == 1.0
    with pytest.raises(InputError, match="unknown name"):
        parse("a" * 58 + "b", ["a", "aa", "aaa"])


def test_the_names_in_a_formula():
    assert parse("l1 cos(q1) + pi", VALUES).names == {"l1", "q1"}
    assert parse(" 2 ").text == " 2 "
    with pytest.raises(InputError, match="no value for 'q1'"):
        parse("q1", ["q1"]).value({})
    assert {"pi", "sin", "atan2"} <= RESERVED
    with pytest.raises(InputError, match="unknown name 'sin'"):
        parse("sin(1)", functions=("sqrt",))


def test_functions_in_place_of_others():
    formula = parse("2 sin(q1) cos(q2)", VALUES)
    swapped = formula.with_functions({"sin": "cos", "cos": "sin"})
    assert swapped.value(VALUES) == pytest.approx(2 * math.cos(0.7) * math.sin(-1.1), rel=1e-14)
    assert parse("cos(60)").with_functions(IN_DEGREES).value({}) == pytest.approx(0.5, rel=1e-14)
    assert set(IN_DEGREES) <= set(FUNCTIONS)


def test_exponential_and_logarithm():
    assert parse("ln(exp(2 x))", ("x",)).value({"x": 1.25}) == pytest.approx(2.5)
    assert parse("exp(x) - 3x", ("x",)).value({"x": 0.0}) == 1.0
    for text, says in (("ln(0)", "not a real number"), ("ln(-1)", "not a real number"), ("exp(1000)", "too large")):
        with pytest.raises(InputError, match=says):
            parse(text, ()).value({})
