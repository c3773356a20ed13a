"""The page of geometry as a browser gets it."""

import csv
import io
import re

import numpy as np
import pytest

from armlab.benches.motion.space_curve.commands import ChooseCurve, GoTo, SetAngle, SetPoint
from armlab.benches.motion.space_curve.examples import EXAMPLES, ChooseExample
from armlab.benches.motion.space_curve.state import SpaceCurve, curve_of
from armlab.benches.motion.space_curve.ui import turn
from armlab.benches.motion.space_curve.ui.form import curve_form, head, law_form, marks
from armlab.benches.motion.space_curve.ui.frenet import arc
from armlab.benches.motion.space_curve.ui.numbers import at_present, moving, whole
from armlab.benches.motion.space_curve.ui.plots import without_poles
from armlab.benches.motion.space_curve.ui.turn import turn_form
from armlab.benches.motion.space_curve.ui.words import length, lengths
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.html import joined
from armlab.ui.units import Units
from support.forms import BareForm, asked
from support.student import run, student


def opened():
    return State.initial(catalogue()["puma560"])


async def at_geometry(url):
    browser = await student(url)
    await browser.open("space_curve")
    await browser.until(lambda: "κ(0) = 1/10" in browser.html())
    return browser


def frames(browser):
    return {name.rsplit("/", 1)[1]: pose for name, pose in browser.nodes.items() if "/space_curve/" in name}


def test_the_curve_of_the_notes_is_shown_sent_to_a_place_and_refused_nonsense(url):
    async def main():
        browser = await at_geometry(url)
        html = browser.html()
        assert "0.1000 1/m" in html
        assert "✓ Regular" in html
        assert "model 1 :" in html or "drawn as a model 1 : " in html
        assert "6.145 multiply p by the norm instead: corrected" not in html  # for those who have the course notes
        await browser.press("s", "0.3")
        await browser.until(lambda: "0.0879 1/m" in browser.html())
        assert "<td>0.575</td><td>0.287</td><td>−0.766</td>" in browser.html()
        before = frames(browser)["frenet"]["position"]
        await browser.press("s", "1")
        await browser.until(lambda: "0.0354 1/m" in browser.html())
        assert np.linalg.norm(np.subtract(frames(browser)["frenet"]["position"], before)) > 0.05
        await browser.press("f 1", "5 s^")
        await browser.until(lambda: "y(s): the formula breaks off" in browser.html())
        assert 'value="5 s^"' in browser.html()
        assert "0.0354 1/m" in browser.html()
        await browser.press("f 1", "0")
        await browser.until(lambda: "every normal is as good" in browser.html())
        await browser.close()

    run(main())


def test_a_kind_of_path_brings_its_form_and_names_a_wrong_waypoint(url):
    async def main():
        browser = await at_geometry(url)
        await browser.press("example", "overfly")
        await browser.until(lambda: 'data-cell="o-amount"' in browser.html())
        assert "6.118–6.119 want p̈ = 0 at both ends of the blend" not in browser.html()
        assert "<th>2</th><td>0.800</td><td>200.0</td><td>400.0</td>" in browser.html()
        assert "d₁ and d₂ in m" not in browser.html()
        assert re.search('value="200"[^>]*data-cell="o-amount".{0,200}?<i>mm</i>', browser.html())
        assert "the acceleration jumps by up to 1400 mm/s² where" in browser.html()
        await browser.press("o-amount", "5000")
        await browser.until(lambda: 'aria-invalid="true"' in browser.html() and "waypoint 2" in browser.html())
        await browser.press("p 1 0", "0")
        await browser.until(lambda: "waypoint 2: the same as waypoint 1" in browser.html())
        await browser.press("curve", "circle")
        await browser.until(lambda: "radius" in browser.html() and 'data-cell="o-full"' in browser.html())
        await browser.press("length on")
        await browser.until(lambda: 'data-cell="sigma"' in browser.html())
        await browser.press("csv")
        await browser.until(lambda: browser.downloads.get("curvature.csv", b"").count(b"\n") > 300)
        rows = list(csv.reader(io.StringIO(browser.downloads["curvature.csv"].decode())))
        assert rows[0] == ["σ, mm", "kappa, 1/m"]
        assert float(rows[1][1]) == pytest.approx(float(rows[-1][1]))
        await browser.close()

    run(main())


def test_the_turn_is_shown_with_both_ways_and_takes_the_tool(url):
    async def main():
        browser = await at_geometry(url)
        await browser.press("example", "wander")
        await browser.until(lambda: "total angle" in browser.html())
        html = browser.html()
        assert "<td>102.6°</td><td>120.0°</td>" in html
        assert "6.152" not in html
        assert 'data-cell="s"' not in html
        await browser.press("axes", "zyx")
        await browser.until(lambda: "Yaw, pitch, roll" in browser.html())
        await browser.press("a A 0", "much")
        await browser.until(lambda: "angle 1 of A: expected a number in degrees" in browser.html())
        await browser.press("take A tool")
        await browser.until(lambda: "expected a number in degrees" not in browser.html())
        await browser.press("shown curve")
        await browser.until(lambda: 'data-cell="curve"' in browser.html())
        await browser.close()

    run(main())


@pytest.mark.parametrize("key", [key for key, example in EXAMPLES.items() if example.sets["shown"] == "curve"])
def test_the_numbers_of_every_example_have_units_and_no_rounding_errors(key):
    for label in (Set(Notation, "length", "mm"), Set(Notation, "length", "m")):
        state = apply(apply(opened(), label), ChooseExample(key))
        html = joined(at_present(BareForm(), state), moving(state), whole(state))
        assert "nan" not in html
        assert "−0.0<" not in html
        assert f"<small>{label.value}</small>" in html
        assert "1/m" in html


def typed(state, cell, text=""):
    def page(form):
        return head(form, state) + marks(form, state) + curve_form(form, state) + law_form(form, state)

    return asked(lambda form: page(form) + at_present(form, state), cell, text)


@pytest.mark.parametrize(
    ("cell", "says"), [("T", "T: expected a number"), ("s", "s: expected a number"), ("p 1 2", "waypoint 2, z")]
)
def test_what_is_no_number_is_refused_in_words(cell, says):
    state = apply(opened(), ChooseCurve("spline"))
    with pytest.raises(InputError, match=says):
        typed(state, cell, "far")


def test_what_is_typed_and_pressed_becomes_commands():
    state = apply(opened(), ChooseCurve("spline"))
    assert typed(state, "p 0 2", "250") == (SetPoint(0, 2, 0.25),)
    assert typed(state, "T", "3,5") == (Set(SpaceCurve, "duration", 3.5),)
    assert typed(state, "s", "0.25") == (GoTo(0.25),)
    assert apply(state, typed(state, "frame off")[0])[SpaceCurve].frame is False
    by_length = apply(opened(), Set(SpaceCurve, "by_length", True))
    half = 500.0 * by_length.derived(curve_of).arc.length
    assert typed(by_length, "sigma", f"{half}") == (GoTo(pytest.approx(0.5)),)
    assert typed(by_length, "length off") == (Set(SpaceCurve, "by_length", False),)
    turned = asked(lambda form: turn_form(form, state), "a B 1", "90")
    assert turned == (SetAngle("B", 1, pytest.approx(np.pi / 2)),)


def test_the_end_of_a_curve_is_typed_as_its_length_is_shown():
    state = apply(apply(opened(), ChooseCurve("circle")), Set(SpaceCurve, "by_length", True))
    assert 1e3 * state.derived(curve_of).arc.length == pytest.approx(961.0958, abs=1e-4)
    assert typed(state, "sigma", "961.1") == (GoTo(1.0),)
    for wrong in ("961.2", "-1"):
        with pytest.raises(InputError, match=f"σ: expected a length from 0 to 961.1 mm, got '{wrong}'"):
            typed(state, "sigma", wrong)


def test_lengths_that_would_not_fit_are_written_with_a_power_of_ten():
    units = Units(Notation())
    assert length(28.4245, units) == "28424.5"
    assert length(-2842.45, units) == "−2.84·10⁶"
    assert lengths(np.array([3.0, 0.0, 4.0]), units) == ("3000.0", "0.0", "4000.0", "5000.0")


def test_a_part_of_a_circle_begins_at_the_curve_and_poles_are_left_out():
    whole_circle, part = arc(np.pi), arc(0.5)
    np.testing.assert_allclose(np.linalg.norm(part, axis=2), 1.0, rtol=1e-6)
    np.testing.assert_allclose(part[len(part) // 2, 0], (0.0, -1.0, 0.0), atol=1e-6)
    np.testing.assert_allclose(whole_circle[0, 0], whole_circle[-1, 1], atol=1e-6)
    values = np.array([1.0, 1.0, 2.0, 1.0, 500.0])
    assert np.isnan(without_poles(values)).tolist() == [False, False, False, False, True]
    assert not np.isnan(without_poles(np.zeros(4))).any()


def test_a_speed_of_turning_is_no_negative_number_where_the_tool_goes_back(monkeypatch):
    state, shown = opened(), []
    for rate in (2.0, -2.0):
        monkeypatch.setattr(turn, "turn_place", lambda _state, rate=rate: (0.5, rate))
        shown.append(str(joined(turn.turn_numbers(BareForm(), state))))
    assert "|ω| now" in shown[0]
    assert shown[0] == shown[1]
