"""The page of timing laws as a browser gets it."""

import csv
import io
import math
import re
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.laws.commands import ChooseLaw, SetQuantity, Stretch
from armlab.benches.motion.laws.examples import EXAMPLES, ChooseLawExample
from armlab.benches.motion.laws.facts import FACTS
from armlab.benches.motion.laws.state import Laws
from armlab.benches.motion.laws.timing import Entry
from armlab.benches.motion.laws.ui.form import form_markup
from armlab.benches.motion.laws.ui.plots import LawPlot, grid, race_markup
from armlab.benches.motion.laws.ui.tables import values_markup
from armlab.benches.motion.laws.words import stretch_rows
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.motion import free_law_types
from armlab.session.parts.timeline import OpenClip, Play, Seek
from armlab.session.state import State, apply
from armlab.ui.playing import clock
from support.forms import BareForm, asked
from support.student import run, student


def opened(*commands_):
    state = State.initial(catalogue()["planar_2r"])
    for command in commands_:
        state = apply(state, command)
    return state


class Chart:
    """Takes what a plot sends."""

    def __init__(self):
        self.data, self.scales, self.series = (), {}, ()


class Element:
    def __init__(self):
        self.content = ""

    def show(self, content):
        self.content = content


class Maker:
    """Makes the parts of a plot, without a page."""

    def __init__(self):
        self.chart, self.language = Chart(), "en"

    def form(self, post):
        return BareForm()

    def html(self, content=""):
        return Element()

    def enlarges(self, plot):
        return lambda: None

    def uplot(self, *given):
        return self.chart


def drawn(part, order):
    maker = Maker()
    plot = LawPlot(maker, order)
    plot.show_laws(part, grid(part))
    return plot, maker.chart


# -- the plots ---------------------------------------------------------------------------------------------------------


def test_what_is_above_a_limit_is_drawn_red_and_the_rest_is_not():
    part = opened(ChooseLawExample("slower"))[Laws]
    _, chart = drawn(part, 1)
    t, law, scaled, over, limit, other = (np.array(column, float) for column in chart.data)
    red = np.isfinite(over)
    np.testing.assert_allclose(over[red], law[red], rtol=0, atol=0)
    np.testing.assert_array_equal(red, np.nan_to_num(law) > 2.0 * (1.0 + 1e-6))
    assert red.any()
    assert np.nanmax(scaled) == pytest.approx(2.0, abs=1e-3)
    assert np.all(limit == 2.0)
    assert np.isnan(other).all()
    assert t[0] == 0.0
    assert np.all(np.diff(t) > 0.0)
    assert chart.series[3]["points"]["show"]
    # Within its limits nothing is red.
    assert len(drawn(opened()[Laws], 1)[1].data) == 3 + 2


def test_curves_end_with_their_law_and_show_both_sides_of_a_jump():
    part = opened(ChooseLawExample("bang_coast_bang"), Stretch(2.0))[Laws]
    _, chart = drawn(part, 2)
    t, law = chart.data[:2]
    near = np.abs(t - 1.0) < 1e-6
    assert set(np.round(law[near], 6)) == {1.0, 0.0}
    inside = t <= 3.0
    np.testing.assert_allclose(law[inside], part.laws[0].at(t[inside], 2), rtol=0, atol=0)
    assert np.nansum(np.abs(law[t > 3.0 + 1e-6])) == 0.0
    assert np.isnan(law[t > 3.1]).all()
    assert chart.scales["x"]["range"][1] == pytest.approx(6.0)


def test_a_limit_far_above_the_curves_does_not_press_them_flat():
    part = opened(SetQuantity("speed", 100.0))[Laws]
    _, chart = drawn(part, 1)
    assert np.isnan(chart.data[-1]).all()
    assert np.isnan(chart.data[-2]).all()
    assert chart.scales["y"]["range"][1] < 2.0


def test_the_saved_table_holds_the_laws_there_are():
    plot, _ = drawn(opened(Stretch(2.0))[Laws], 1)
    head, first, *rows = csv.reader(io.StringIO(plot.csv()))
    assert head == ["t, s", "ṡ of law 1, 1/s", "ṡ of law 2, 1/s", "ṡ of law 1 (×k), 1/s"]
    assert [float(cell) for cell in first] == [0.0] * 4
    steps = np.diff([0.0, *(float(row[0]) for row in rows)])
    np.testing.assert_allclose(steps, steps[0], rtol=1e-9)
    assert rows[-1][1] == "", "law 1 has ended"
    assert float(rows[-1][3]) == pytest.approx(0.0, abs=1e-9)


def test_the_saved_table_goes_to_the_end_of_a_time_that_has_no_end_in_decimals():
    plot, _ = drawn(opened(SetQuantity("duration", 2.0 / 3.0))[Laws], 0)
    *_, last = csv.reader(io.StringIO(plot.csv()))
    assert [float(cell) for cell in last] == pytest.approx([2.0 / 3.0, 1.0, 1.0])


@pytest.mark.parametrize("key", list(EXAMPLES))
def test_every_example_has_its_plots(key):
    part = opened(ChooseLawExample(key))[Laws]
    for order in range(4):
        _, chart = drawn(part, order)
        assert np.isfinite(chart.data[1]).any()
        low, high = chart.scales["y"]["range"]
        assert low <= np.nanmin(chart.data[1]) <= np.nanmax(chart.data[1]) <= high


def test_the_race_stands_where_the_laws_are():
    state = opened(ChooseLawExample("bang_coast_bang"), OpenClip("laws"), Seek(1.5))
    now = [float(x) for x in re.findall(r'class="now" cx="([\d.]+)"', race_markup(state))]
    assert now == [160.0, 160.0]
    back = race_markup(opened(ChooseLawExample("plus_minus_one"), OpenClip("laws"), Seek(6.0)))
    assert 'class="now" cx="10.0"' in back


def test_a_table_that_stands_still_stands_at_the_beginning():
    part = opened()[Laws]
    still = Entry(Chosen.of(free_law_types(), "table", rows=[[0.0, 1.0, 0.0]]), True)
    state = opened().replace(replace(part, entries=(still,)))
    assert set(re.findall(r' cx="([^"]+)"', str(race_markup(state)))) == {"10.0"}


def test_a_peak_is_infinite_where_the_derivative_below_it_jumps():
    for example, order, texts, fact in (
        ("double_s", 3, ["5", "∞"], 5.0),
        ("double_s", 2, ["1.5", "1.5"], 1.5),
        ("bang_coast_bang", 3, ["∞", "∞"], math.inf),
        ("smoothness", 3, ["1.5", "7.5", "6.562"], 1.5),
    ):
        state = opened(ChooseLawExample(example))
        name, key = {2: ("max |s̈|", "peak_acceleration"), 3: ("max |jerk|", "peak_jerk")}[order]
        row = re.search(rf"<td>{re.escape(name)}.*?</tr>", str(values_markup(state[Laws], 0.0)))[0]
        assert re.findall(r"<td>([^<]*)", row)[1:] == texts
        assert FACTS.facts[key].now(state).value == pytest.approx(fact)
    bang = opened(ChooseLawExample("bang_coast_bang"), Stretch(2.0))[Laws]
    assert [row[2:4] for row in stretch_rows(bang) if row[0] == "max jerk"] == [(math.inf, math.inf)]


# -- what is pressed and typed -----------------------------------------------------------------------------------------


def pressed(state, cell, text=""):
    return asked(lambda form: clock(form, state, "laws", state[Laws].end), cell, text)


def test_play_goes_on_where_the_film_stands():
    state = opened()
    assert pressed(state, "play-laws") == (OpenClip("laws", play=True),)
    on = opened(OpenClip("laws"))
    assert pressed(on, "play-laws") == (Play(True),)
    assert pressed(on, "time", "0,5") == (Seek(0.5),)
    assert pressed(state, "time", "1/2") == (OpenClip("laws"), Seek(0.5))


@pytest.mark.parametrize(("text", "says"), [("soon", "t: expected seconds, got 'soon'"), ("9", "t: expected 0 to")])
def test_a_time_that_the_film_has_not_is_refused_in_words(text, says):
    with pytest.raises(InputError, match=says):
        pressed(opened(), "time", text)


def test_the_options_of_each_law_are_its_own():
    part = opened(ChooseLawExample("bang_coast_bang"))[Laws]

    def typed(cell, text):
        return asked(lambda form: form_markup(form, part), cell, text)

    assert typed("t-distance", "2") == (SetQuantity("distance", 2.0),)
    assert typed("law 1", "septic") == (ChooseLaw(1, "septic"),)
    assert typed("law 1", "no such law") == ()
    assert typed("l9-ramp", "1") == ()


async def at_laws(url):
    browser = await student(url)
    await browser.open("laws")
    await browser.until(lambda: "Uniform time scaling" in browser.html())
    return browser


async def says(browser, text):
    await browser.until(lambda: text in browser.html())


@pytest.mark.usefixtures("reads_at_once")
def test_an_example_a_law_and_its_options(url):
    async def main():
        browser = await at_laws(url)
        # Every kind of law is on offer.
        for kind in free_law_types().values():
            assert f">{kind.title}</option>" in browser.html()
        await browser.press("example", "triangle")
        await says(browser, "Triangle: L = 0.5 &lt; V²/A = 1")
        await browser.press("t-distance", "2")
        await says(browser, "T = (L A + V²)/(A V) = 3 s")
        await browser.press("l0-sdot_start", "0.5")
        await says(browser, "Trapezoid of speed: speeds up for 0.5 s")
        await browser.press("add")
        await says(browser, 'data-cell="law 1"')
        await browser.press("law 1", "double_s")
        await says(browser, "limit of jerk: Double S (bounded jerk) needs one")
        await browser.press("t-jerk", "10")
        await browser.until(lambda: "needs one" not in browser.html())
        await browser.press("law 1", "double_s")
        await says(browser, 'data-cell="l1-rounding"')
        await browser.press("remove 0")
        await browser.until(lambda: 'data-cell="l1-rounding"' not in browser.html())
        await says(browser, 'data-cell="l0-rounding"')
        await browser.close()

    run(main())


def test_bad_input_stays_marked_and_the_old_state_stays(url):
    async def main():
        browser = await at_laws(url)
        await browser.press("example", "plus_minus_one")
        await says(browser, 'data-cell="l0-rows"')
        await browser.press("l0-rows", "0 1 1\n2 3 -1")
        await says(browser, "row 2: it must begin at 1 s")
        area = re.search(r'<textarea[^>]*data-cell="l0-rows"[^>]*>([^<]*)<', browser.html())
        assert area[1] == "0 1 1\n2 3 -1"
        assert 'aria-invalid="true"' in area[0]
        await browser.press("l0-rows", "0 1 1; 1 2 -1")
        await says(browser, ">0  1  1\n1  2  −1</textarea>")
        for cell, text, why in (
            ("t-duration", "0", "T (duration): expected a number in s greater than 0, got &#39;0&#39;"),
            ("t-speed", "0", "V (limit of speed): expected a number in 1/s greater than 0"),
            ("t-acceleration", "nan", "A (limit of acceleration): expected a number in 1/s² greater than 0"),
            ("t-duration", "", "expected a positive number, got nothing"),
            ("time", "soon", "t: expected seconds, got &#39;soon&#39;"),
            ("time", "1e9", "t: expected 0 to 2 s"),
        ):
            await browser.press(cell, text)
            await says(browser, why)
            field = re.search(rf'<input[^>]*data-cell="{cell}"[^>]*>', browser.html())[0]
            assert 'aria-invalid="true"' in field
        await browser.press("law 0", "trapezoidal")
        await says(browser, 'data-cell="l0-ramp"')
        await browser.press("l0-ramp", "0.6")
        await says(browser, "expected a number greater than 0 and at most 0.5, got &#39;0.6&#39;")
        assert "speeds up for 2.667 s" in browser.html()
        await browser.close()

    run(main())


def test_scaling_and_bounds(url):
    async def main():
        browser = await at_laws(url)
        await browser.press("example", "faster")
        await says(browser, "Optimal k = 0.4688 (faster)")
        await browser.press("unscaled")
        await says(browser, "<th>k = 1</th>")
        assert "×k" not in browser.html()
        await browser.press("t-speed", "0.5")
        await says(browser, "Optimal k = 1.875 (slower)")
        await browser.press("optimal")
        await says(browser, "<th>k = 1.875</th>")
        slider = next(c for c in browser.controls.values() if c["props"].get("label") == "k")
        assert slider["value"] == 1.875
        await browser.send({"type": "GuiUpdateMessage", "uuid": slider["uuid"], "updates": {"value": 2.0}})
        await says(browser, "<th>k = 2</th>")
        assert "joint 2 decides" not in browser.html()
        await browser.press("view bounds")
        await says(browser, "V = 0.5 1/s, joint 2 decides.")
        await browser.press("b-a_max", "1 1")
        await says(browser, "Lower |ṡ| below 0.4082 1/s first")
        await browser.press("take")
        await says(browser, "leaves no acceleration; lower V first")
        await browser.press("lower")
        await says(browser, "no joint exceeds its limits")
        await browser.press("take")
        await browser.until(lambda: 'data-cell="t-duration"' not in browser.html())
        await browser.press("b-knots", "0 0 0\n1 2 3")
        await says(browser, "<td>3</td>")
        await browser.press("b-v_max", "1 0 1")
        await says(browser, "v_max (limits of speed, a joint each): expected numbers")
        await browser.close()

    run(main())


def test_the_film_is_played_and_paused(url):
    async def main():
        browser = await at_laws(url)
        await browser.press("example", "cosine")
        await browser.press("play-laws")
        await says(browser, "❚❚ Pause")
        await says(browser, "<b>Timing laws</b>")
        await browser.press("pause-laws")
        await says(browser, "▶ Play")
        await browser.close()

    run(main())
