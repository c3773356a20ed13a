"""The page of runs of kinematic control as a browser gets it."""

import csv
import io
import math
import re

import numpy as np
import pytest

from armlab.benches.control.follow.chosen import setup_of
from armlab.benches.control.follow.commands import (
    ChooseInverse,
    ChooseReference,
    NameRun,
    SetOffset,
    SetOption,
    SetStart,
    SetValue,
    SizePush,
)
from armlab.benches.control.follow.examples import EXAMPLES, ChooseControlExample
from armlab.benches.control.follow.runs import Peak
from armlab.benches.control.follow.state import Control, made_step
from armlab.benches.control.follow.ui.card import card_markup, name_markup, runs_markup, small
from armlab.benches.control.follow.ui.form import (
    ELSEWHERE,
    law_markup,
    plant_markup,
    plant_words,
    reference_markup,
    sigma_unit,
)
from armlab.benches.control.follow.ui.page import clock_markup
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.edits import PasteTable
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.html import joined
from armlab.ui.units import Units
from support.control import done, opened
from support.forms import BareForm, asked
from support.student import run, student

UNITS = Units(Notation())


async def at_runs(url, key="wrong_link"):
    """Open the page with the experiment and wait until all its runs are made."""
    browser = await student(url)
    await browser.open("control")
    await browser.press("example", key)
    await browser.until(lambda: joined(EXAMPLES[key].says[:30]) in browser.html())
    # The plant is the last of the page that is made; until the runs are begun it may be that of the example before.
    missing = ("The runs are being computed", "<td>…</td>")
    await browser.until(
        lambda: 'data-cell="w-step"' in browser.html() and not any(each in browser.html() for each in missing)
    )
    return browser


def row(browser, name):
    """Return what stands in a row of the results; dots where they are not there yet."""
    found = re.search(rf"<tr><td>{re.escape(name)}</td>(.*?)</tr>", browser.html())
    if found is None:
        return ["…"]
    return [re.sub(r"<small>.*?</small>|</?span[^>]*>", "", cell) for cell in re.findall(r"<td>(.*?)</td>", found[1])]


def test_small_values_are_written_so_that_something_is_seen():
    assert small(0.04799, False, UNITS) == "48.0"
    assert small(0.004799, False, UNITS) == "4.80"
    assert small(3e-8, False, UNITS) == "3·10⁻⁵"
    # An error of 6e-12 mm is of rounding, not of the law.
    assert small(6e-15, False, UNITS) == small(0.0, True, UNITS) == '<span class="zero">0</span>'
    assert small(float("nan"), True, UNITS) == "–"
    assert Peak(1.0, 2.0).time == 2.0


def test_the_plant_in_words_and_the_unit_of_sigma():
    robot = catalogue()["planar_2r"]
    assert plant_words(setup_of(robot)) == "ideal"
    words = plant_words(setup_of(robot, saturation="clip", sampling=0.01, counts=500, wrong=0.02, link=2))
    assert words == "speeds limited, T_s = 10 ms, encoder on the motor, link 2 2 % wrong"
    assert plant_words(setup_of(robot, sampling=1e-4)) == "T_s = 1 ms, whole steps of 1 ms"
    assert plant_words(setup_of(robot, sampling=0.025, step=0.02)) == "T_s = 20 ms, whole steps of 20 ms"
    assert (
        plant_words(setup_of(robot, sampling=0.2, step=0.1, duration=0.25))
        == "T_s = 166.667 ms, whole steps of 83.333 ms"
    )
    assert sigma_unit(robot.arm) == "m"
    assert sigma_unit(catalogue()["puma560"].arm) == ""


@pytest.mark.parametrize(
    ("reference", "duration", "step", "sampling"),
    [("line", 0.25, 0.1, 0.14), ("line", 4.0, 0.03, 1.0), ("planned", 4.0, 0.03, 0.2), ("line", 0.3, 0.01, 0.1)],
)
def test_the_sampling_time_that_is_said_is_the_one_that_is_run(reference, duration, step, sampling):
    clock = (SetValue("duration", duration), SetValue("step", step), SetValue("sampling", sampling))
    state = done(opened(), ChooseReference(reference), *clock)
    made = state[Control].outcome.run
    changes = made.t[1:][np.abs(np.diff(made.qdot, axis=0)).max(axis=1) > 1e-9]
    said = plant_words(state[Control].run, made_step(state))
    assert float(re.match(r"T_s = ([\d.]+) ms", said)[1]) == pytest.approx(1000.0 * changes[0], abs=1e-3)


def typed(state, cell, text=""):
    def page(form):
        return clock_markup(form, state) + reference_markup(form, state) + law_markup(form, state)

    return asked(lambda form: page(form) + runs_markup(form, state) + plant_markup(form, state), cell, text)


def test_what_is_typed_and_pressed_becomes_commands():
    state = State.initial(catalogue()["planar_2r"])
    run = state[Control].run
    assert typed(state, "offset 1", "90") == (SetOffset((run.offset[0], pytest.approx(math.pi / 2))),)
    assert typed(state, "start 0", "0") == (SetStart((0.0, run.start[1])),)
    assert typed(state, "here") == (SetStart(),)
    assert typed(state, "push-size", "20") == (SizePush(0.02),)
    assert typed(state, "inverse", "transpose") == (ChooseInverse("transpose"),)
    (set_step,) = typed(state, "w-step", "0,01")
    assert (set_step.key, set_step.value) == ("step", 0.01)
    # The only run cannot be taken away, and the page does not offer it.
    assert typed(state, "remove 0") == ()
    with pytest.raises(InputError, match="offset of joint 2: expected"):
        typed(state, "offset 1", "much")


def test_a_run_without_a_name_is_called_by_its_law_and_nothing_counts_as_typed():
    state = State.initial(catalogue()["planar_2r"])
    called = state[Control].run.title
    form = BareForm()
    empty = str(name_markup(form, state))
    assert 'value=""' in empty
    assert f'placeholder="{called}"' in empty
    form.show(name_markup(form, state))
    form.press("name", "mine")
    assert form.commands == (NameRun("mine"),)
    named = apply(state, *form.commands)
    assert 'value="mine"' in name_markup(BareForm(), named)
    assert apply(named, NameRun(""))[Control].run.title == called


def test_a_run_that_an_example_has_named_has_one_name_in_list_and_field():
    radians = apply(State.initial(catalogue()["planar_2r"]), Set(Notation, "angle", "rad"))
    example = apply(radians, ChooseControlExample("line_178"))
    field = str(name_markup(BareForm(), example))
    called = re.search(r'placeholder="([^"]*)"', field)[1]
    assert called == "3.11 rad, J⁻¹"
    assert f"<span>{called}</span>" in runs_markup(BareForm(), example)
    assert "178°" not in field


def test_a_run_that_leaves_the_range_of_a_joint_says_where_and_when():
    short = (SetValue("duration", 0.1), SetValue("step", 0.01))
    inside = done(opened("puma560"), *short)
    assert "leaves the range" not in card_markup(inside)
    outside = done(inside, SetOffset((0.0, math.radians(200.0), 0.0, 0.0, 0.0, 0.0)))
    text = card_markup(outside)
    low, high = (UNITS.text(float(limit), True) for limit in outside[Joints].arm.limits[1])
    assert "Run 1 leaves the range of joint 2 at 0.00 s" in text
    assert f"{low} to {high} °" in text


def test_an_option_the_law_does_not_have_is_refused_in_words():
    # The page still showed another law when it was typed.
    with pytest.raises(InputError, match="options of cartesian_tracking: unknown name 'K'"):
        apply(State.initial(catalogue()["planar_2r"]), SetOption("law", "K", 1.0))


def test_an_experiment_is_chosen_and_its_results_are_read(url):
    async def main():
        browser = await at_runs(url)
        errors = [float(text) for text in row(browser, "error at the end, mm")[:2]]
        assert errors == pytest.approx([19.6, 11.3], abs=0.06)
        assert row(browser, "steps") == ["2000"] * 3
        assert "Run 1 cannot be made" not in browser.html()
        drawn = {name.split("/control/", 1)[1] for name in browser.nodes if "/control/" in name}
        assert {"run0", "run1", "run2", "wanted", "strobe"} <= drawn
        await browser.close()

    run(main())


def test_values_are_typed_and_refused_and_a_copy_is_compared(url):
    async def main():
        browser = await at_runs(url)
        await browser.press("w-speed", "fast")
        await browser.until(lambda: "expected a number in mm/s from 0 to 20000, got &#39;fast&#39;" in browser.html())
        await browser.press("w-speed", "-3")
        await browser.until(lambda: "from 0 to 20000, got &#39;-3&#39;" in browser.html())
        await browser.press("remove 2")
        await browser.press("remove 1")
        await browser.until(lambda: 'data-cell="remove 1"' not in browser.html())
        await browser.press("add")
        await browser.until(lambda: 'data-cell="remove 1"' in browser.html())
        await browser.press("w-wrong", "4")
        await browser.until(lambda: "link 2 4 % wrong" in browser.html())
        await browser.until(lambda: "…" not in row(browser, "steps"))
        first, second = (float(text) for text in row(browser, "error at the end, mm"))
        assert second == pytest.approx(2.0 * first, rel=0.05)
        await browser.press("law-Kp", "1 2 3")
        await browser.until(lambda: "K_p: expected one gain, or 2" in browser.html())
        await browser.press("law-Kp", "")
        await browser.until(lambda: "cannot be made" not in browser.html())
        await browser.press("law", "joint_tracking")
        await browser.until(lambda: 'data-cell="law-K"' in browser.html())
        assert 'data-cell="inverse"' not in browser.html()
        await browser.press("start 0", "20")
        await browser.until(lambda: 'value="20"' in browser.html())
        await browser.close()

    run(main())


def test_pushes_are_made_and_taken_away(url):
    async def main():
        browser = await at_runs(url, "push")
        assert "✕ 1" in browser.html()
        await browser.press("push-size", "20 mm")
        await browser.until(lambda: not re.search('<button[^>]*data-cell="push"[^>]* disabled', browser.html()))
        await browser.press("push")
        await browser.until(lambda: "✕ 2" in browser.html())
        await browser.press("drop")
        await browser.until(lambda: 'data-cell="drop"' not in browser.html())
        await browser.until(lambda: "…" not in row(browser, "steps"))
        assert float(row(browser, "largest error, mm")[0].split("·")[0]) < 10.0
        await browser.close()

    run(main())


def test_plots_change_with_the_view_and_are_saved(url):
    async def main():
        browser = await at_runs(url, "joint_tracking")
        assert "Error of the position, and" in browser.html()
        await browser.press("speed")
        await browser.until(lambda: "Fastest joint of all runs" in browser.html())
        await browser.press("csv", "")
        await browser.until(lambda: bool(browser.downloads))
        name, content = next(iter(browser.downloads.items()))
        rows = list(csv.reader(io.StringIO(content.decode())))
        assert name.endswith(".csv")
        assert rows[0][:2] == ["t, s", "run 1: Error of the position, mm"]
        assert len(rows) > 100
        await browser.close()

    run(main())


def test_the_page_opens_on_every_kind_of_arm(url):
    async def main():
        for key in ("scara", "panda", "cartesian_3p"):
            browser = await student(url, path=f"/robot/{key}")
            await browser.open("control")
            await browser.until(
                lambda b=browser: "cannot be made" in b.html() or bool(re.search(r"steps</td><td>4000", b.html()))
            )
            assert "cannot be made" not in browser.html()
            assert "has failed" not in browser.html()
            arm = catalogue()[key].arm
            assert ("turn error at the end" in browser.html()) == (arm.task.rotation != "none")
            assert len(State.initial(catalogue()[key])[Control].runs) == 1
            await browser.close()

    run(main())


def test_a_start_beside_a_singular_home_is_told():
    arm = apply(opened("puma560"), PasteTable("a,alpha,d,theta\n250,0,0,q1\n200,0,0,q2"))
    assert ELSEWHERE in reference_markup(BareForm(), arm)
    assert ELSEWHERE not in reference_markup(BareForm(), apply(arm, SetStart((0.0, 0.0))))
    assert ELSEWHERE not in reference_markup(BareForm(), opened("puma560"))
