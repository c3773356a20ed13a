"""The form of the options of a path: units, symbols, and only what can be used."""

import re

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion.path_types import path_type
from armlab.ui.html import Markup
from armlab.ui.option_form import option_form
from armlab.ui.option_text import Scale, option_value
from armlab.ui.remarks import remarks

DEG, MM = Scale("°", np.pi / 180.0), Scale("mm", 1e-3)


class Form:
    """What is needed of `armlab.ui.form.Form`: cells that show their text."""

    def field(self, cell, text, title, action, off=False):
        return Markup(f"<input {cell}={text}>")

    def area(self, cell, text, title, lines, action):
        return Markup(f"<textarea {cell}={text}>")

    def select(self, cell, title, texts, chosen, action):
        return Markup(f"<select {cell}>")

    def chip(self, cell, text, action, hint, pressed):
        return Markup(f"<button {cell}>")


def form(key, scales, **given):
    return option_form(Form(), "", path_type(key).fields, given, lambda key, value: (), scales)


def cells(markup):
    return re.findall(r"<(?:input|textarea) (\w+)=", markup)


def unit_of(markup, cell):
    return re.search(rf"<input {cell}=[^>]*><i>([^<]*)</i>", markup)[1]


def field(key, name, **given):
    return next(each for each in path_type(key).fields if each.key == name).seen(given)


@pytest.mark.parametrize(
    ("by", "unit", "symbol"),
    [
        ("d1", "mm", '<span class="sym">d<sub>1</sub></span>'),
        ("d2", "mm", '<span class="sym">d<sub>2</sub></span>'),
        ("time", "s", "<span>ΔT</span>"),
    ],
)
def test_the_amount_of_an_over_fly_has_the_unit_of_what_it_is(by, unit, symbol):
    markup = form("overfly", [MM] * 3, by=by, amount=(0.05,))
    assert unit_of(markup, "amount") == unit
    assert f"{symbol}<input amount={'0.05' if by == 'time' else '50'}>" in markup
    typed = option_value(field("overfly", "amount", by=by), "50", None, [MM] * 3)
    assert typed == pytest.approx([50.0 if by == "time" else 0.05])


@pytest.mark.parametrize("scales", [[DEG, MM], [MM, DEG], [DEG, DEG]])
def test_a_length_over_joints_of_both_kinds_is_an_angle(scales):
    markup = form("overfly", scales, amount=(np.radians(5.0),))
    assert (unit_of(markup, "amount"), unit_of(markup, "speed")) == ("°", "°/s")
    assert "<input amount=5>" in markup
    assert option_value(field("overfly", "amount"), "5", None, scales) == pytest.approx([np.radians(5.0)])


def test_lengths_of_sliding_joints_alone_are_lengths():
    assert unit_of(form("overfly", [MM, MM]), "amount") == "mm"


@pytest.mark.parametrize(
    ("given", "shown"),
    [
        ({}, ["v_start", "v_end", "times", "duration"]),
        ({"ends": "natural"}, ["a_start", "a_end", "times", "duration"]),
        ({"ends": "both"}, ["v_start", "v_end", "a_start", "a_end", "virtual", "times", "duration"]),
        ({"ends": "clamped", "times": (0.0, 1.0)}, ["v_start", "v_end", "times"]),
    ],
)
def test_a_form_shows_only_what_can_be_used(given, shown):
    assert cells(form("spline", [DEG, DEG], **given)) == shown


@pytest.mark.parametrize(
    ("text", "value", "said"),
    [
        ("90", 90.0, ["Read as 90 rad. For degrees type 90° or 90 deg."]),
        ("90°", np.pi / 2, []),
        ("−90 deg", -np.pi / 2, []),
        ("90 rad", 90.0, []),
        ("30 pi", 30.0 * np.pi, []),
    ],
)
def test_an_angle_may_have_its_unit_and_one_of_many_turns_without_it_is_remarked_on(text, value, said):
    kind = Field("start", "", "start", "number", 0.0, unit="q")
    with remarks() as heard:
        assert option_value(kind, text.replace(" pi", "*pi"), None, (Scale("rad", 1.0),)) == pytest.approx(value)
        assert option_value(kind, "1.5 rad", None, (Scale("°", np.pi / 180.0),)) == pytest.approx(1.5)
    assert heard == said


@pytest.mark.parametrize(("text", "value"), [("6.2832", 2.0 * np.pi), ("-6.2832", -2.0 * np.pi), ("6.2830", 6.283)])
def test_an_angle_typed_as_a_form_shows_its_bound_is_the_bound(text, value):
    kind = Field("turn", "θ", "turn", "number", 0.0, -2.0 * np.pi, 2.0 * np.pi, unit="q")
    assert option_value(kind, text, None, (Scale("rad", 1.0),)) == value
    with pytest.raises(InputError, match=r"from .6\.2832 to 6\.2832"):
        option_value(kind, "6.2834", None, (Scale("rad", 1.0),))


def test_rows_of_derivatives_are_in_the_unit_on_screen():
    scales, rows = [DEG, MM], ((np.radians(30.0), 0.2), (np.radians(-4.0), 0.0))
    markup = form("polynomial", scales, start=rows)
    assert "<i>°/s, mm/s</i>" in markup
    assert "start=30  200\n−4  0>" in markup
    typed = option_value(field("polynomial", "start"), "30  200\n−4  0", None, scales)
    np.testing.assert_allclose(typed, rows, rtol=0, atol=1e-15)
