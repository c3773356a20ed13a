"""The pages of the velocity loop and of the matrix exponential as a browser gets them."""

import math
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from armlab.benches.control.exponential.examples import EXAMPLES as MATRICES
from armlab.benches.control.exponential.state import Exponential, SetEntry
from armlab.benches.control.exponential.ui import page as exponential
from armlab.benches.control.exponential.ui.plane import plane
from armlab.benches.control.loop.examples import EXAMPLES, ChooseLoopExample
from armlab.benches.control.loop.state import Loop
from armlab.benches.control.loop.ui import page as loop
from armlab.benches.control.loop.ui.large import Responses
from armlab.benches.control.loop.ui.pictures import bode, diagram
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import OpenClip, Seek
from armlab.session.state import State
from armlab.ui.playing import clock
from armlab.ui.units import Units
from support.done import done
from support.forms import asked
from support.student import run, student


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


@pytest.mark.parametrize("key", list(EXAMPLES))
def test_the_pictures_of_the_loop_are_drawn_of_numbers(key):
    part, units = EXAMPLES[key].part, Units(Notation())
    for t in (0.0, 0.5 * part.end, part.end):
        assert "nan" not in diagram(part, t)
    picture = bode(part, units)
    assert "nan" not in picture
    assert picture.count('class="here"') == (4 if part.kind == "sine" else 0)
    # Both curves begin at zero, which has a number, and fall.
    gains, phases = curves(picture)
    zeros = re.findall(r'y="([\d.]+)" text-anchor="end">0</text>', picture)
    for heights, zero in zip((gains[:, 1], phases[:, 1]), zeros, strict=True):
        assert (np.diff(heights) >= 0.0).all()
        assert 0.0 <= heights[0] + 4.0 - float(zero) < 6.0  # a number stands 4 pixels below its line
    assert phases[-1, 1] <= 80.0


def test_extreme_loops_are_drawn_too():
    for changes in (("gain", 1e6), ("mass", 1e4), ("omega", 1e-3)):
        part = opened(ChooseLoopExample("omega_2"), Set(Loop, "end", 1e-3), Set(Loop, *changes))[Loop]
        assert "nan" not in bode(part, Units(Notation()))


@pytest.mark.parametrize("key", list(MATRICES))
def test_the_plane_is_drawn_of_numbers(key):
    picture = plane(MATRICES[key].part)
    assert "nan" not in picture
    lines = {"decay": 2, "turn": 0, "spiral": 0, "defective": 1}
    assert picture.count("stroke-dasharray") == lines.get(key, 2)


def test_the_diagram_shows_the_numbers_at_the_time():
    part = EXAMPLES["step"].part
    picture = diagram(part, 0.0)
    for text in ("2 m/s", "1.6 m/s", "4.8 N", "0.4 m/s"):
        assert f">{text}<" in picture


def test_fields_become_commands_and_nonsense_is_said():
    state = opened()

    def typed(cell, text):
        return asked(lambda form: loop.form_markup(form, state[Loop]) + clock(form, state, "loop", 6.0), cell, text)

    def matrix(cell, text):
        return asked(lambda form: exponential.head_markup(form, state[Exponential]), cell, text)

    assert typed("l-mass", "2") == (Set(Loop, "mass", 2.0),)
    assert typed("time", "1.5") == (OpenClip("loop"), Seek(1.5))
    assert typed("elsewhere", "1") == ()
    assert matrix("a21", "−1/2") == (SetEntry("a21", -0.5),)
    for call, says in (
        (lambda: typed("l-mass", "heavy"), r"M \(mass\): expected a number in kg from 0.001 to 10000, got 'heavy'"),
        (lambda: typed("time", "9"), "t: expected 0 to 6 s"),
        (lambda: typed("time", "x"), "t: expected seconds"),
        (lambda: matrix("a21", "x"), "a₂₁: expected a number"),
    ):
        with pytest.raises(InputError, match=says):
            call()


async def says(browser, text):
    await browser.until(lambda: text in browser.html())


def test_the_page_of_the_loop(url):
    async def main():
        browser = await student(url)
        await browser.open("loop")
        await says(browser, "Error that stays: 0.1961 m/s, 19.6 % of v<sub>d</sub>")
        await says(browser, "11.3°, 98.7 ms, later")
        await browser.press("example", "omega_20")
        await says(browser, "89.4 % of v<sub>d</sub>")
        await browser.press("kind step")
        await says(browser, "The error dies out")
        await browser.press("l-gain", "-1")
        await says(browser, "K (gain of the controller): expected a number in N s/m from 0.001")
        await browser.press("l-gain", "20")
        await says(browser, "20 rad/s = 3.183 Hz")
        await browser.press("play-loop")
        await says(browser, "<b>Velocity loop</b>")
        await browser.close()

    run(main())


def test_the_page_of_the_exponential(url):
    async def main():
        browser = await student(url)
        await browser.open("exponential")
        await says(browser, "largest error")
        await browser.press("example", "defective")
        await says(browser, "A is not diagonalisable")
        await says(browser, "cond(T) = ∞")
        await browser.press("a21", "x")
        await says(browser, "a₂₁: expected a number")
        await browser.press("a21", "1/4")
        await browser.until(lambda: "not diagonalisable" not in browser.html())
        await says(browser, 'value="0.25"')
        sliders = {c["props"].get("label"): c for c in browser.controls.values()}
        await browser.set_value(sliders["t, s"], 2.0)
        await says(browser, "at t = 2 s")
        await browser.press("end", "1")
        await says(browser, "at t = 1 s")
        await browser.close()

    run(main())


def test_random_and_degenerate_systems_are_drawn_of_numbers(rng):
    matrices = [((0.0, 0.0), (0.0, 0.0)), ((1.0, 0.0), (0.0, 1.0)), ((0.0, 1.0), (0.0, 0.0)), ((1e-9, 0.0), (0.0, 0.0))]
    matrices += [tuple(map(tuple, rng.normal(size=(2, 2)) * 10.0 ** rng.uniform(-3, 0.5))) for _ in range(20)]
    for A in matrices:
        for x0 in ((0.0, 0.0), (1.0, -2.0), (1e-6, 0.0)):
            part = replace(Exponential(), A=A, x0=x0, t=float(rng.choice([0.0, 1.0, 3.0])), terms=3)
            part.check()
            page = plane(part) + exponential.results_markup(part)
            assert not re.search(r"\bnan\b|\binf\b", page)


def curves(picture):
    """Return the pixels of the gain's and the phase's curve."""
    found = re.findall(r'd="M([^"]+)" fill="none" stroke="[^"]+" stroke-width="1.8"', picture)
    return [np.array([point.split() for point in each.split("L")], dtype=float) for each in found]


def test_the_frequency_response_is_drawn_from_edge_to_edge():
    part = Loop()
    picture = bode(part, Units(Notation()))
    for points in curves(picture):
        assert (points[0, 0], points[-1, 0]) == (36.0, 320.0)
    # 0.1 to 100 rad/s: the cutoff of 10 rad/s is at two thirds, the 2 rad/s of the sine at log 20 / 3.
    assert f'd="M36.0 23.1L{36 + 284 * 2 / 3:.1f} 23.1L320.0 ' in picture
    assert picture.count(f'class="here" d="M{36 + 284 * math.log10(20.0) / 3:.1f} 0V') == 2
    assert [name in picture for name in (">dB<", ">°<", ">ω, rad/s<")] == [True] * 3
    assert ">−90<" in picture
    assert ">−1.57<" in bode(part, Units(Notation(angle="rad")))


def test_the_line_at_the_cutoff_frequency_says_what_it_is():
    part, units, charts = Loop(), Units(Notation()), []
    Responses(SimpleNamespace(enlarges=charts.append), units).show(part)
    assert bode(part, units).count(">cutoff K/M<") == len(charts) == 2
    for chart in charts:
        assert chart.picture().described(100)[0]["marks"] == [{"name": "cutoff 10 rad/s", "value": 10.0}]
