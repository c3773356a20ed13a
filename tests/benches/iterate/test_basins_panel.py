"""The page of the map of basins: its picture, its choices over the wire, and what is said."""

import io
import math
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from armlab.benches.iterate.basins.job import drawn
from armlab.benches.iterate.basins.state import Basins, DrawBasins, MapMethod, StartInMap
from armlab.benches.iterate.basins.ui.map import here, legend, places, standing
from armlab.benches.iterate.basins.ui.page import WHAT_TO_DO, choices_markup
from armlab.benches.iterate.basins.ui.picture import (
    LEAST_SIDE,
    enlarged,
    palette,
    pixels,
    png,
    scale_of,
    solution_colour,
)
from armlab.benches.iterate.runs.commands import ChooseTask
from armlab.benches.iterate.runs.state import Iterations
from armlab.benches.iterate.runs.worked import run_of
from armlab.content.robots import catalogue
from armlab.kin.ik.iterate import Basins as Found
from armlab.kin.ik.iterate import task_vector
from armlab.kin.ik.iterate.basins import FAILED, NOT_YET
from armlab.session.edits import RemoveJoint
from armlab.session.field_words import SetFields
from armlab.session.fields import Set
from armlab.session.parts.joints import LockJoint, MoveJoint
from armlab.session.state import State, apply
from armlab.ui.colours import BLUE, GREY, ORANGE
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.forms import BareForm, asked
from support.student import run, student


def found_of(index, iterations):
    index, iterations = np.array(index), np.array(iterations)
    rows, columns = index.shape
    return Found(rows, index, iterations, np.zeros((9, 2)), np.arange(columns), np.arange(rows), np.zeros(2))


def seen(data):
    """Return a PNG file as another program reads it, (rows, columns, RGBA)."""
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGBA"))


# -- the picture -------------------------------------------------------------------------------------------------


def test_colours_are_the_solutions_and_white_failed_and_nothing_still_to_come():
    found = found_of([[0, 1, 8], [FAILED, NOT_YET, 0]], [[5, 5, 5], [9, 0, 5]])
    picture = seen(png(pixels(found)))
    # The second row of the grid is the upper one.
    assert picture[1].tolist() == [[*BLUE, 255], [*ORANGE, 255], [*GREY, 255]]
    assert picture[0, 0].tolist() == [255, 255, 255, 255]
    assert picture[0, 1, 3] == 0
    assert picture[0, 2].tolist() == [*BLUE, 255]
    assert solution_colour(7) == solution_colour(30) == GREY


def test_more_steps_are_darker_and_the_scale_is_said():
    steps = np.tile(np.arange(2, 52), (4, 1))
    found = found_of(np.zeros_like(steps), steps)
    brightness = seen(png(pixels(found)))[0, :, :3].sum(axis=1)
    assert np.all(np.diff(brightness.astype(int)) <= 0)
    assert brightness[0] > 2.5 * brightness[-1]
    assert brightness[-1] > 40  # a colour still
    assert scale_of(found) == (2, 50)
    assert scale_of(found_of([[FAILED]], [[3]])) == (0, 0)


def test_every_entry_of_the_palette_has_one_byte_and_the_file_holds_each_pixel():
    assert len(palette()) <= 256
    rng = np.random.default_rng(3)
    entries = rng.integers(0, len(palette()), (37, 53)).astype(np.uint8)
    data = png(entries)
    image = Image.open(io.BytesIO(data))
    assert image.size == (53, 37)
    np.testing.assert_array_equal(np.asarray(image), entries)
    large = enlarged(entries)
    assert max(large.shape) >= LEAST_SIDE
    np.testing.assert_array_equal(large[:: large.shape[0] // 37, :: large.shape[1] // 53], entries)


# -- what is said ------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def state():
    begun = apply(State.initial(catalogue()["planar_2r"]), SetFields.of(Basins, points=64, most=50))
    return drawn(apply(begun, DrawBasins()))


def test_the_shares_of_the_legend_are_those_of_the_pixels(state):
    found = state[Basins].map
    text = joined(legend(found, units_of(state)))
    assert "Elbow down" in text
    assert "Elbow up" in text
    for value in (0, 1):
        assert f"{100 * np.mean(found.found.index == value):.1f} %" in text
    assert "not reached in 50 steps" in text
    assert "limits not kept" in text
    shares = [float(np.mean(found.found.index == value)) for value in (0, 1, FAILED)]
    assert sum(shares) == pytest.approx(1.0, abs=1e-12)


def test_one_step_is_in_the_singular_and_what_few_runs_do_is_not_said_of_every_run(state):
    found = state[Basins].map
    for steps, told in ((1, "1 step"), (2, "2 steps")):
        every = found_of(np.zeros((10, 10), dtype=int), np.full((10, 10), steps))
        every.iterations[0, 0] = 9
        text = joined(legend(replace(found, found=every), units_of(state)))
        assert f"Nearly every run that arrived took {told}." in text
        same = replace(found, found=replace(found.found, iterations=np.full_like(found.found.iterations, steps)))
        begun = apply(state.replace(replace(state[Basins], map=same)), StartInMap(0.25, 0.5))
        assert here(begun).endswith(f" after {told}.")
    assert scale_of(found_of([[0, 0]], [[1, 3]])) == (1, 3)
    text = joined(legend(replace(found, found=found_of([[0, 0]], [[1, 3]])), units_of(state)))
    assert "Bright: 1 step or fewer. Dark: 3 or more." in text


def test_marks_follow_the_arm_and_the_map_of_another_target_says_so(state):
    before = places(state)
    moved = apply(state, MoveJoint(0, 1.5))
    assert places(moved) != before
    assert ".ba-arm{--x:73.87%" in places(moved)  # 1.5 rad of a turn from -pi
    assert joined(standing(state)) == ""
    begun = apply(moved, StartInMap(0.25, 0.5))
    assert ".ba-start{--x:25.78%" in places(begun)  # the middle of the pixel


def test_the_end_of_the_film_is_told_only_where_the_map_answers_the_same_question(state):
    begun = apply(state, StartInMap(0.25, 0.5))
    run, question = state[Basins].map.question.run, state[Basins].map.question
    same = begun.replace(
        replace(begun[Iterations], runs=(run,), selected=0, limits=question.limits, most=question.most)
    )
    assert "The film's start: ends in" in here(same)
    others = (
        replace(same[Iterations], runs=(run_of("gradient"),)),
        replace(same[Iterations], limits="none" if question.limits == "clamp" else "clamp"),
        replace(same[Iterations], most=question.most - 1),
        replace(same[Iterations], target=same[Iterations].target + 1e-3),
    )
    for other in others:
        assert "As the map was asked for, a start there: ends in" in here(same.replace(other))


def test_of_a_start_between_those_of_the_map_only_the_end_of_the_nearest_is_told(state):
    begun = apply(state, StartInMap(0.75, 0.625))
    part = begun[Iterations]
    assert "The film's start: " in here(begun)
    between = replace(part, start=(math.radians(90.0), math.radians(45.0)))
    assert "The film's start. The nearest start of the map: ends in" in here(begun.replace(between))
    other = replace(between, most=part.most - 1)
    assert "As the map was asked for, the nearest start of the map: ends in" in here(begun.replace(other))


def test_what_to_do_is_said_only_where_there_are_joints_to_spare():
    def said(key, command):
        state = apply(State.initial(catalogue()[key]), command)
        return joined(choices_markup(BareForm(), state, units_of(state)))

    arm = catalogue()["planar_3r"].arm
    assert WHAT_TO_DO in said("planar_3r", ChooseTask(task_vector(arm, "xy")))
    for command, why in ((RemoveJoint(1), "A map needs two joints that move"), (LockJoint(0, True), "not locked")):
        text = said("planar_2r", command)
        assert why in text
        assert WHAT_TO_DO not in text


@pytest.mark.parametrize(
    ("cell", "text", "expected"),
    [
        ("method", "newton", MapMethod("newton")),
        ("parameter-alpha", "0,25", MapMethod("gradient", "alpha", 0.25)),
        ("points 256", "", Set(Basins, "points", 256)),
        ("most 200", "", Set(Basins, "most", 200)),
        ("limits clamp", "", Set(Basins, "limits", "clamp")),
        ("draw", "", DrawBasins()),
        ("rest-99", "1", None),
        ("across", "x", None),
    ],
)
def test_what_is_pressed_and_typed_becomes_a_command(state, cell, text, expected):
    state = apply(state, MapMethod("gradient"))
    found = asked(lambda form: choices_markup(form, state, units_of(state)), cell, text)
    assert found == (() if expected is None else (expected,))


# -- over the wire -----------------------------------------------------------------------------------------------


def piece(browser, mark):
    """Return the markup that holds a mark; empty without."""
    return next((c["props"]["content"] for c in browser.controls.values() if mark in c["props"].get("content", "")), "")


def test_a_map_is_drawn_clicked_and_begins_a_film(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("joints")
        await browser.open("joints", "basins")
        await browser.until(lambda: 'data-cell="draw"' in browser.html())
        assert "ba-map" not in browser.html()
        await browser.press("points 64")
        await browser.press("method", "dls_error")
        await browser.until(lambda: 'data-cell="parameter-g"' in browser.html())
        await browser.press("draw")
        await browser.until(lambda: "Save as PNG" in browser.html())
        await browser.until(lambda: "Elbow up" in browser.html())
        assert "data:image/png;base64," in piece(browser, "ba-map")
        # A moving joint moves the mark; the picture is not sent again.
        marks, sent = lambda: piece(browser, ".ba-arm{"), browser.bytes
        before = marks()
        await browser.set_value(browser.slider(1), 75.0)
        await browser.until(lambda: marks() != before)
        assert browser.bytes - sent < len(piece(browser, "ba-map"))
        await browser.press("start", "0.5,0.25")
        await browser.press("start", "nan,0")
        await browser.press("start", "x")
        await browser.until(lambda: "Converged in" in browser.html())
        await browser.close()

    run(main())


def test_a_click_on_a_map_of_other_locks_is_refused_below_the_map(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("joints", "basins")
        await browser.press("points 64")
        await browser.press("draw")
        await browser.until(lambda: "Save as PNG" in browser.html())
        await browser.press("0")  # the chip that holds joint 1
        await browser.until(lambda: "held: click to release it" in browser.html())
        await browser.press("start", "0.5,0.25")
        await browser.until(lambda: 'role="alert">✕ the held joints have changed' in piece(browser, "ba-map"))
        assert "Iterates of run" not in browser.html()
        await browser.close()

    run(main())


def test_position_only_of_the_3r_says_what_to_do_and_nonsense_changes_nothing(url):
    async def main():
        browser = await student(url, path="/robot/planar_3r")
        await browser.open("basins")
        await browser.until(lambda: 'data-cell="task"' in browser.html())
        await browser.press("task", "position")
        await browser.until(lambda: "a redundant arm has infinitely many solutions" in browser.html())
        await browser.press("task", "q3")
        await browser.until(lambda: "q₃ wanted" in browser.html())
        assert "redundant" not in browser.html()
        await browser.press("rest-2", "two")
        await browser.until(lambda: "expected a number in degrees, got" in browser.html())
        await browser.press("task", "\ud800")
        await browser.press("across", "99999")
        await browser.press("rest-2", "30")
        await browser.until(lambda: 'value="30.0"' in browser.html())
        await browser.close()

    run(main())
