"""Numbers as people write them."""

import math

import numpy as np
import pytest

from armlab.content.arithmetic import evaluate, shortest, shortest_degrees
from armlab.content.symbols import plain_symbols
from armlab.errors import InputError

H = math.pi / 2


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("-pi/2", -H),
        ("3pi/4", 3 * math.pi / 4),
        ("0.5*pi", H),
        ("2 sqrt(2)", 2 * math.sqrt(2)),
        ("√(2)/2", math.sqrt(2) / 2),
        ("½π", H),
        ("2^-1", 0.5),
        ("007", 7.0),
        ("1.5e-3", 0.0015),
        ("1½", 1.5),
        ("-2 ¾ π", -2.75 * math.pi),
        ("2^½", math.sqrt(2)),
        ("1/½", 2.0),
        ("⅟8", 0.125),
        ("3²", 9.0),
        ("10⁻³", 0.001),
        ("5×10⁻²", 0.05),
        ("2¹⁰", 1024.0),
        ("(1+2)²/3", 3.0),
        ("π²", math.pi**2),
        ("-2²", -4.0),
        ("√2/2", math.sqrt(2) / 2),
        ("-3√ 0.25", -1.5),
        ("√½", math.sqrt(0.5)),
        ("√π", math.sqrt(math.pi)),
    ],
)
def test_arithmetic(text, value):
    assert evaluate(text) == pytest.approx(value, rel=1e-15, abs=0)


@pytest.mark.parametrize("text", ["1.5½", "½1", "2²3", "²", "3⅟8", "0.5₂", "90⁰", "√", "√-1", "3⁻", "∛8"])
def test_what_would_run_together_when_folded_is_refused(text):
    with pytest.raises(InputError, match="expected a number such as"):
        evaluate(text)


@pytest.mark.parametrize("text", ["", "1 2", "1/0", "sqrt(-1)", "1e999", "x", "pi()", "sqrt", "1,2", "(" * 500, "[1]"])
def test_what_is_not_arithmetic(text):
    with pytest.raises(InputError, match="expected a number such as"):
        evaluate(text)


def test_signs_of_print_become_those_of_a_keyboard():
    assert plain_symbols("−½·π, aⱼ₋₁ ≤ 90º") == "-(1/2)*pi, aj-1 ≤ 90°"
    assert plain_symbols("q⁻, q⁺, aⁱ⁻¹, 90⁰") == "q-, q+, ai-1, 90°"


def test_degrees_come_back_as_the_same_radians(rng):
    for value in np.radians(rng.integers(-360, 360, 200)):
        text = shortest_degrees(float(value))
        assert len(text) <= 4
        assert float(np.radians(float(text))) == value
    for value in rng.uniform(-7, 7, 500):
        assert math.isclose(float(np.radians(float(shortest_degrees(value)))), value, rel_tol=3e-16)


def test_shortest_numbers_come_back_the_same(rng):
    for value in [0.1, 1e-300, 1e22, -0.0, *rng.uniform(-2, 2, 100)]:
        assert float(shortest(float(value))) == value
