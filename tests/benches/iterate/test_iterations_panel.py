"""The pages of iterations as a browser gets them."""

import csv
import io
import itertools
import math
import re

import numpy as np
import pytest

from armlab.benches.iterate.runs.commands import ChooseMethod
from armlab.benches.iterate.runs.examples import EXAMPLES, ChooseExample
from armlab.benches.iterate.runs.job import with_films
from armlab.benches.iterate.runs.state import Iterations
from armlab.benches.iterate.runs.ui.page import problem_markup
from armlab.benches.iterate.runs.ui.tangents import View, picture
from armlab.benches.iterate.runs.ui.words import choices, chosen, made, outcome
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.format import scientific
from armlab.ui.small_numbers import small
from armlab.ui.ticks import ticks
from armlab.ui.units import Units
from support.bare_gui import BarePage, words
from support.forms import asked
from support.student import run, student

UNITS = Units(Notation())


async def at_steps(url):
    browser = await student(url)
    await browser.open("iterations")
    await browser.until(lambda: "Converged in" in browser.html())
    return browser


async def choose(browser, key):
    await browser.press("example", key)
    await browser.until(lambda: EXAMPLES[key].says[:30].replace("'", "&#39;") in browser.html())
    await browser.until(lambda: '<p class="dim">…</p>' not in browser.html())


def test_small_numbers_are_written_so_that_something_is_seen():
    assert small(0.0147, False, UNITS) == "14.7"
    assert small(4.2e-9, False, UNITS) == "4.2·10⁻⁶"
    assert small(0.0, True, UNITS) == "0"
    assert [small(math.radians(value), True, UNITS) for value in (0.9996, 0.452, -0.0451, 0.0051)] == [
        "1.00",
        "0.45",
        "−0.045",
        "5.1·10⁻³",
    ]
    assert small(float("nan"), True, UNITS) == "–"
    assert scientific(-2.5e-12) == "−2.5·10⁻¹²"


@pytest.mark.parametrize(
    ("key", "units"), [("cartesian_3p", ("m²/s", "m²/s²")), ("planar_2r", ("1/s", "1/s²")), ("scara", ("1/s", "1/s²"))]
)
def test_the_lyapunov_function_has_the_unit_of_its_error(key, units):
    page = BarePage("iterations", catalogue()[key])
    page.session.apply(ChooseMethod(0, "flow"), 0.0)
    page.session.state = with_films(page.session.state)
    page.show()
    shown = re.sub(r"\s+", " ", words(page))
    assert re.findall(r"T K e , (\S+)", shown) == [units[0]]
    assert re.findall(r"\| 2 , (\S+)", shown) == [units[1]]


@pytest.mark.parametrize("key", ["planar_2r", "planar_3r", "puma560", "scara", "panda", "cartesian_3p"])
def test_every_task_vector_on_offer_can_be_chosen_and_is_recognised(key):
    arm = catalogue()[key].arm
    for choice in choices(arm):
        vector = made(arm, choice, 0.25)
        assert chosen(arm, vector) == choice
        if choice.startswith("q"):
            assert vector.joints == ((int(choice[1:]), 0.25),)
            assert vector.m == arm.n


def test_the_largest_number_of_steps_is_read_as_a_whole_number():
    state = State.initial(catalogue()["planar_2r"])
    (command,) = asked(lambda form: problem_markup(form, state), "most", "17")
    assert apply(state, command)[Iterations].most == 17
    for wrong in ("2.5", "0", "501", "", "many"):
        with pytest.raises(InputError, match="largest number of steps: expected a whole number from 1 to 500, got"):
            asked(lambda form: problem_markup(form, state), "most", wrong)


def test_an_example_is_chosen_played_to_a_row_and_refused_nonsense(url):
    async def main():
        browser = await at_steps(url)
        await choose(browser, "step_size")
        html = browser.html()
        assert "✓ Converged in 30 steps." in html
        assert "✕ Diverged: the step size α = 1.2 m⁻² is above 2/σ_max² = 0.958 m⁻²." in html
        assert "iterate 0 of 30" in html
        await browser.press("row 3")
        await browser.until(lambda: "iterate 3 of 30" in browser.html())
        now = re.search(r'<tr class="now"[^>]*>(.*?)</tr>', browser.html())[1]
        film = with_films(apply(State.initial(catalogue()["planar_2r"]), ChooseExample("step_size")))[Iterations].film
        assert re.findall("<td>([^<]*)</td>", now)[2] == f"{1e3 * film.position_error[3]:.1f}"
        await browser.press("p1-alpha", "much")
        await browser.until(lambda: "expected a number, got &#39;much&#39;" in browser.html())
        await browser.press("p1-alpha", "-1")
        await browser.until(lambda: "step size α: expected 0.0001 to 100, got -1" in browser.html())
        await browser.press("start 0", "NaN")
        await browser.until(lambda: "expected a number in degrees" in browser.html())
        await browser.press("p1-alpha", "0,4")
        await browser.until(lambda: 'value="0.4"' in browser.html())
        await browser.until(lambda: "✕ Diverged" not in browser.html())
        await browser.close()

    run(main())


def test_runs_are_added_changed_and_removed(url):
    async def main():
        browser = await at_steps(url)
        await browser.press("add-run")
        await browser.until(lambda: 'data-cell="method-2"' in browser.html())
        await browser.press("method-2", "flow")
        await browser.until(lambda: "Lyapunov function" in browser.html())
        await browser.until(lambda: "Instants of run 3" in browser.html())
        await browser.press("remove-2")
        await browser.until(lambda: 'data-cell="method-2"' not in browser.html())
        await browser.until(lambda: "Iterates of run 2" in browser.html())
        await browser.close()

    run(main())


def test_the_curves_are_saved_for_the_runs_there_are(url):
    async def main():
        browser = await at_steps(url)
        await choose(browser, "step_size")
        await browser.press("csv")
        await browser.until(lambda: browser.downloads.get("position_error.csv", b"").count(b"\n") > 60)
        rows = list(csv.reader(io.StringIO(browser.downloads["position_error.csv"].decode())))
        quantity = "log₁₀ of the position error in m"
        assert rows[0] == ["iterate", f"run 1: {quantity}", f"run 2: {quantity}"]
        film = with_films(apply(State.initial(catalogue()["planar_2r"]), ChooseExample("step_size")))[Iterations].film
        assert float(rows[1][1]) == pytest.approx(-0.139, abs=0.2)
        assert 10.0 ** float(rows[4][1]) == pytest.approx(film.position_error[3], rel=1e-12)
        await browser.close()

    run(main())


def test_one_variable_is_typed_played_and_refused(url):
    async def main():
        browser = await student(url)
        await browser.open("newton_1d")
        await browser.until(lambda: "converged to x = 1.414213562" in browser.html())
        await browser.press("f", "x^3 - 2x + 2")
        await browser.until(lambda: "the iterates repeat in a cycle: 0, 1," in browser.html())
        await browser.press("x0", "0")
        await browser.until(lambda: "the iterates repeat in a cycle: 1, 0," in browser.html())
        await browser.press("f", "2 +")
        await browser.until(lambda: "the formula breaks off" in browser.html())
        assert "the iterates repeat in a cycle" in browser.html()
        await browser.press("equation", "near_flat")
        await browser.until(lambda: "19.89675347" in browser.html())
        await browser.press("iterate 1")
        await browser.until(lambda: re.search(r'class="now".*?25\.01166', browser.html()) is not None)
        await browser.close()

    run(main())


def test_an_outcome_says_how_far_it_is():
    state = with_films(apply(State.initial(catalogue()["planar_2r"]), ChooseExample("stretched")))
    said = outcome(state[Iterations].film, UNITS)
    assert "Jᵀe = 0" in said
    assert "Error at the end: 1000.0\N{NO-BREAK SPACE}mm." in said
    assert said.startswith('<p class="no">✕ ')


def test_the_picture_of_every_example_shows_its_iterates():
    from armlab.benches.iterate.newton_1d.clip import Place
    from armlab.benches.iterate.runs.one_equation import solved
    from armlab.kin.ik.iterate import EXAMPLES as EQUATIONS

    for example in EQUATIONS:
        found = solved(example.key, "", example.x0)
        for k in range(found.last + 1):
            place = Place(k, 1.0, 0.5)
            view = View.of(found, place).chart
            assert view.x[0] < found.iterates[k].x < view.x[1]
            drawn = picture(found, place)
            assert "nan" not in drawn
            assert "inf" not in drawn
            assert drawn.count("<circle") >= 1


def test_a_start_at_a_root_shows_the_curve_and_not_a_flat_line():
    from armlab.benches.iterate.newton_1d.clip import Place
    from armlab.benches.iterate.runs.one_equation import solved

    for text, x0 in (("abs(x)", 0.0), ("sin(x)", math.pi)):
        view = View.of(solved("", text, x0), Place(0, 1.0, 0.5)).chart
        assert view.y[1] - view.y[0] > 0.5


def test_however_large_the_iterates_are_the_picture_has_numbers_or_says_so():
    from armlab.benches.iterate.newton_1d.clip import Place
    from armlab.benches.iterate.runs.one_equation import solved

    told = 0
    functions = ("x", "x^2 + 1e308", "exp(x)", "1/x", "sin(x)", "x^2 - 2", "1e-300*x", "abs(x)")
    with np.errstate(all="ignore"):
        for text, x0 in itertools.product(functions, (1.7e308, -1e308, 1e300, 1e154, -1e103, 0.5, 1e-160)):
            try:
                found = solved("", text, x0)
            except InputError:
                continue
            for k in range(min(found.last + 1, 4)):
                drawn = picture(found, Place(k, 1.0, 0.5))
                assert "nan" not in drawn
                assert "inf" not in drawn
                told += "too large to be drawn" in drawn
    assert told > 10


def test_ticks_are_round_and_inside():
    assert ticks(0.0, 2.0) == [0.0, 0.5, 1.0, 1.5, 2.0]
    assert ticks(-1.0, -1.0) == []
    found = ticks(-1575.0, 32.0)
    assert all(-1575.0 <= value <= 32.0 for value in found)
    assert 2 <= len(found) <= 6
