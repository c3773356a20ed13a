"""Answers as students type them."""

import math

import pytest

from armlab.content.questions import Question, Wrong, read_quantity
from armlab.errors import InputError

LENGTH = Question("", 0.5, "m", 0.001, (Wrong(0.7, "Told."),))
ANGLE = Question("", math.pi / 2, "rad", 0.01)
DEGREES = Question("", 90.0, "deg", 0.1)


@pytest.mark.parametrize("text", ["0.5", "0,5", ".5", "50 cm", "500 mm", "500mm", "1/2 m", "0.5010", "5e-1"])
def test_right_lengths(text):
    assert LENGTH.judge(text).right


@pytest.mark.parametrize("text", ["pi/2", "π/2", "90 deg", "90°", "1.57", "1.57 rad", "90 degrees", "pi/2 rad"])
def test_right_angles(text):
    assert ANGLE.judge(text).right
    assert DEGREES.judge(text).right is (text not in ("pi/2", "π/2", "1.57"))


@pytest.mark.parametrize(
    ("question", "text", "says"),
    [
        (LENGTH, "-0.5", "The size is right, the sign is not."),
        (LENGTH, "500", "The number is right in mm; write its unit, or give it in m."),
        (LENGTH, "50", "The number is right in cm; write its unit, or give it in m."),
        (LENGTH, "0.7", "Told."),
        (LENGTH, "70 cm", "Told."),
        (LENGTH, "0.52", "This is not the answer yet."),
        (LENGTH, "500 m", "This is not the answer yet."),
        (LENGTH, "0.5 rad", "This is an angle; the question asks for a length in m."),
        (ANGLE, "90", "The number is right in deg; write its unit, or give it in rad."),
        (DEGREES, "1.5708", "The number is right in rad; write its unit, or give it in deg."),
        (DEGREES, "-270", "The direction is right, but it is a whole turn away."),
        (LENGTH, "half", "I cannot read 'half': write a number such as 0.5, 50 cm, pi/2 or 90 deg."),
        (LENGTH, "<b>1</b>", "I cannot read '&lt;b&gt;1&lt;/b&gt;': write a number"),
        (LENGTH, "0.5 rad^2", "The unit rad^2 is not known; there are m, cm, mm,"),
        (LENGTH, "", "I cannot read ''"),
        (LENGTH, "1,234.5", "I cannot read '1,234.5'"),
        (LENGTH, "__import__('os')", "I cannot read"),
    ],
)
def test_wrong_answers_are_named(question, text, says):
    verdict = question.judge(text)
    assert not verdict.right
    assert verdict.says.startswith(says)


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [("2 m/s", 2.0, "m/s"), ("3 deg / s", 3.0, "deg/s"), ("4 m²", 4.0, "m^2"), ("5 ms", 5.0, "ms"), ("−6", -6.0, None)],
)
def test_quantities(text, value, unit):
    assert read_quantity(text) == (value, unit)


def test_a_quantity_that_cannot_be_read():
    with pytest.raises(InputError, match="I cannot read 'm'"):
        read_quantity("m")
