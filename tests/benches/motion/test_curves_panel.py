"""The laboratory of curves as a browser gets it."""

import csv
import html
import io
import re

import numpy as np
import pytest

from armlab.benches.motion.curves.commands import (
    AddKnot,
    ChooseLaw,
    ChoosePath,
    SetKnot,
    SetKnots,
    SetLimit,
    SetOption,
)
from armlab.benches.motion.curves.examples import EXAMPLES, ChooseExample
from armlab.benches.motion.curves.state import Curves
from armlab.benches.motion.curves.ui.facts import facts, verdicts
from armlab.benches.motion.curves.ui.listed import _summary, curves_markup, knots_markup, limits_markup
from armlab.benches.motion.curves.ui.solved import rules_markup, solved_markup
from armlab.benches.motion.curves.ui.words import figures, polynomial, read_rows
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.state import State, apply
from armlab.ui.format import lowered
from armlab.ui.option_text import Scale
from support.forms import asked
from support.student import run, student


def part_of(key, *commands):
    state = apply(State.initial(catalogue()["puma560"]), ChooseExample(key))
    for command in commands:
        state = apply(state, command)
    return state[Curves]


def text_of(markup):
    return html.unescape(re.sub(r"<[^>]*>", " ", markup))


async def at_curves(url):
    browser = await student(url)
    await browser.open("curves")
    await browser.until(lambda: "What is solved: curve 1" in browser.html())
    return browser


async def choose(browser, key):
    await browser.press("example", key)
    await browser.until(lambda: EXAMPLES[key].says[:30] in html.unescape(browser.html()))


def plot_of(browser, name):
    """Return the columns of the plot under a heading: time and its curves."""
    await_order = [c["props"] for c in sorted(browser.controls.values(), key=lambda c: c["props"].get("order", 0))]
    headings = [i for i, props in enumerate(await_order) if props.get("content", "").find(f"<h3>{name}<") >= 0]
    return next(props for props in await_order[headings[0] :] if "series" in props)


def test_what_is_typed_and_pressed_becomes_commands():
    part = part_of("ends")

    def typed(cell, text="", as_text=False):
        def page(form):
            knots = knots_markup(form, part, as_text, lambda: None)
            return knots + curves_markup(form, part) + limits_markup(form, part) + rules_markup(form, part)

        return asked(page, cell, text)

    assert typed("q 1", "π/2") == (SetKnot(1, "q", np.pi / 2),)
    assert typed("add-knot 1") == (AddKnot(1),)
    assert typed("rows", "0 0; 1 2") == ()
    assert typed("rows", "0 0; 1 2", as_text=True) == (SetKnots(((0.0, 0.0), (1.0, 2.0))),)
    assert typed("unit mm") == (Set(Curves, "unit", "mm"),)
    assert typed("v_max", " ") == (SetLimit("v_max", None),)
    assert typed("path-1", "polynomial") == (ChoosePath(1, "polynomial"),)
    assert typed("law-0", "cubic") == (ChooseLaw(0, "cubic"),)
    assert typed("path0 ends", "natural") == (SetOption(0, "path", "ends", "natural"),)
    assert typed("path1 ends", "natural") == ()  # only the options of the selected curve are there
    assert typed("degree 7") == (Set(Curves, "degree", 7),)
    for cell, text, says in (
        ("t 2", "soon", "knot 3, t: expected a number in s, got 'soon'"),
        ("a_max", "much", "a_max: expected a number"),
    ):
        with pytest.raises(InputError, match=says):
            typed(cell, text)


def test_numbers_and_polynomials_are_written_as_in_the_notes():
    assert figures(0.0) == "0"
    assert figures(4.49999999999) == "4.5"
    assert figures(-2.5e7) == "−2.5·10⁷"
    assert polynomial((6, -15, 10, 0, 0, 0), "τ") == "6τ⁵ − 15τ⁴ + 10τ³"
    assert polynomial((-1.0, 0.0, 1.0), "t") == "−t² + 1"
    assert polynomial((0.0,), "t") == "0"


def test_knots_are_read_from_lines_and_tables():
    assert read_rows("0 1; 2, 4\n\n3\tπ/2") == ((0.0, 1.0), (2.0, 4.0), (3.0, pytest.approx(np.pi / 2)))


def test_exceeded_limits_are_said_with_numbers_and_units():
    said = text_of(verdicts(part_of("one_to_four")))
    assert "✓ Curve 1 keeps the limits." in said
    assert "✕ Curve 2: velocity above 2.5 rad/s from 0.76 to 1.24 s; up to 2.812 rad/s." in said
    assert verdicts(part_of("ends")) is None
    assert "acceleration above 4 rad/s²" in text_of(verdicts(part_of("one_to_four", SetLimit("a_max", 4.0))))


def test_the_table_tells_class_peaks_overshoot_and_bending():
    said = text_of(facts(part_of("one_to_four")))
    for row in (
        "Class from rest C1 C2",
        "max |q̇|, rad/s 2.25 2.812",
        "max |q̈|, rad/s² 4.5 4.33",
        "∫q̈² dt, rad²/s³ 13.5",
    ):
        assert row in " ".join(said.split())
    blends = " ".join(text_of(facts(part_of("blends"))).split())
    assert "max |q⃛|, rad/s³ ∞ ∞ 1.758" in blends
    assert "Overshoot, rad 0.959 0" in " ".join(text_of(facts(part_of("wandering"))).split())


@pytest.mark.parametrize("key", EXAMPLES)
def test_every_example_shows_what_is_solved_for_it(key):
    said = text_of(solved_markup(part_of(key)))
    assert {
        "hermite": "Doubly normalised",
        "quintic": "With derivatives given at the ends",
        "one_to_four": "✓ zero up to degree 1",
        "degree_15": "polynomial of degree 3 · 5 = 15",
        "courses": "Notes 6.60",
        "lts": "6 + 4 + 4 = 14 equations",
        "blends": "Notes 6.86–6.88",
        "wandering": "Degree 10: 11 conditions",
        "ends": "3 cubics with 4(N−1) = 4·3 = 12 coefficients",
        "fastest": "20.743",
    }[key] in said
    assert "waypoint" not in said


def test_a_spline_of_one_piece_is_one_cubic():
    said = text_of(solved_markup(part_of("ends", SetKnots(((0.0, 0.0), (1.0, 1.0))))))
    assert "1 cubic with 4(N−1) = 4·1 = 4 coefficients" in said
    said = text_of(solved_markup(part_of("ends", SetKnots(((0.0, 0.0), (1.0, 1.0), (2.0, 0.0))))))
    assert "2 cubics with 4(N−1) = 4·2 = 8 coefficients" in said
    assert "the unknown is the velocity v₂." in said


def test_a_curve_that_does_not_take_the_knots_has_nothing_to_solve():
    part = part_of("hermite", AddKnot(0))
    assert "There is no curve to look at." in solved_markup(part)
    assert facts(part) is None


def test_examples_options_and_kinds_are_chosen(url):
    async def main():
        browser = await at_curves(url)
        assert "Three knots" not in browser.html()
        await choose(browser, "hermite")
        assert 'aria-label="Velocity at the start" inputmode="decimal" value="0.7"' in browser.html()
        assert "Cubic with end velocities</option>" in browser.html()
        off = re.search(r'<option value="lts_434" disabled>([^<]*)', browser.html())
        assert off[1] == "Lift-off, travel, set-down (4-3-4) (exactly 4 knots)"
        await browser.press("path0 v_start", "0")
        await browser.press("path0 v_end", "")
        await browser.until(lambda: "✓ zero up to degree 1" in text_of(browser.html()))
        await browser.press("law-0", "quintic")
        await browser.until(lambda: "polynomial of degree 3 · 5 = 15" in text_of(browser.html()))
        await browser.press("show-1")
        await browser.until(lambda: "What is solved: curve 2" in text_of(browser.html()))
        await browser.press("add-knot 0")
        await browser.until(
            lambda: "Not drawn: knots: Cubic with end velocities takes exactly 2, got 3" in browser.html()
        )
        await browser.press("undo")
        await browser.until(lambda: "Not drawn" not in browser.html())
        await browser.press("degree 7")
        await browser.until(lambda: "−20τ⁷ + 70τ⁶ − 84τ⁵ + 35τ⁴" in browser.html())
        await browser.close()

    run(main())


def test_what_makes_no_sense_stays_typed_and_is_marked(url):
    async def main():
        browser = await at_curves(url)
        for cell, text, says in (
            ("t 2", "1", "knot 3: its time 1 s must be later than the 1 s of knot 2"),
            ("q 1", "NaN", "knot 2, q: expected a number in rad, got 'NaN'"),
            (
                "path0 v_start",
                "soon",
                "v_1 (velocity at the start): expected numbers in rad/s, separated by blanks, got 'soon'",
            ),
            ("v_max", "-1", "v_max: expected a positive number, or nothing for no limit; got -1"),
        ):
            await browser.press(cell, text)
            await browser.until(lambda says=says: says in html.unescape(browser.html()))
            assert re.search(rf'<input [^>]*aria-invalid[^>]*value="{text}"[^>]*data-cell="{cell}"', browser.html()), (
                cell
            )
        await browser.press("as-text")
        await browser.until(lambda: 'data-cell="rows"' in browser.html())
        many, more = ("\n".join(f"{k} 0" for k in range(count)) for count in (2_000, 10_000))
        for text, says in (
            (many, "knots: expected 2 to 31, got 2000"),
            (more, f"expected at most 20000 characters, got {len(more)}"),
            ("0 0\n1 x", "knot 2: expected a number, got 'x'"),
            ("0 0", "knots: expected 2 to 31, got 1 (add one)"),
        ):
            await browser.press("rows", text)
            await browser.until(lambda says=says: says in html.unescape(browser.html()))
        assert ">0 0</textarea>" in browser.html()
        await browser.press("rows", "0 0\n1 2\n3 1")
        await browser.press("as-text")
        await browser.until(lambda: 'data-cell="t 2"' in browser.html() and 'data-cell="t 3"' not in browser.html())
        await browser.close()

    run(main())


def test_the_fastest_intervals_are_found_and_taken(url):
    async def main():
        browser = await at_curves(url)
        await browser.press("fastest")
        await browser.until(lambda: "need both v_max and a_max" in browser.html())
        await choose(browser, "fastest")
        await browser.press("fastest")
        await browser.until(lambda: "With h<sub>k</sub> in proportion" in browser.html())
        assert "T = Σh 4 3.932" in " ".join(text_of(browser.html()).split())
        await browser.press("take-fastest")
        await browser.until(lambda: "✓ Curve 1 keeps the limits." in text_of(browser.html()))
        assert 'data-cell="take-fastest"' not in browser.html()
        await browser.close()

    run(main())


def test_the_curves_are_plotted_with_their_knots_and_saved(url):
    async def main():
        browser = await at_curves(url)
        await choose(browser, "one_to_four")
        names = [series.get("label") for series in plot_of(browser, "q, rad")["series"]]
        assert names == ["t, s", "curve 1", "curve 2", "curve 3", "knots"]
        names = [series.get("label") for series in plot_of(browser, "q̇, rad/s")["series"]]
        assert names == ["t, s", *(f"curve {i}" for i in (1, 2, 3)), *["beyond the limit"] * 3, *["limit"] * 2]
        await browser.press("csv")
        await browser.until(lambda: browser.downloads.get("q.csv", b"").count(b"\n") > 400)
        rows = list(csv.reader(io.StringIO(browser.downloads["q.csv"].decode())))
        names = "Cubic with end velocities", "Quintic with end velocities and accelerations"
        assert rows[0] == ["t, s", *(f"{name}: q, rad" for name in names)]
        middle = min(rows[1:], key=lambda row: abs(float(row[0]) - 1.0))
        np.testing.assert_allclose([float(value) for value in middle], [1.0, 2.5, 2.5], rtol=0, atol=0.02)
        await browser.close()

    run(main())


def test_what_was_given_to_a_curve_is_said_with_units():
    scale = Scale("rad")
    blends, law = part_of("blends").curves[1], part_of("degree_15").curves[0]
    assert "blend time: 1.6 s; at the first and last knot: already moving⟦, as in the notes⟧" in lowered(
        text_of(_summary(blends, scale)).strip()
    )
    assert "Velocity at the start: 0.7 rad/s; velocity at the end: −0.4 rad/s" in _summary(
        part_of("hermite").curves[1], scale
    )
    assert "Law s(t): quintic" in _summary(law, scale)
