"""The page of the trainer as a browser gets it: choices, cells, and what is said of nonsense."""

import asyncio
import re

import pytest

from armlab.benches.robot.trainer.answers import FIELDS
from armlab.benches.robot.trainer.commands import CheckAxes, CheckTable, ChooseDirection, SetAnswer, StartTrainer
from armlab.benches.robot.trainer.exercise import Exercise
from armlab.benches.robot.trainer.state import Trainer
from armlab.content.robots import catalogue
from armlab.session.parts.display import Show
from armlab.session.state import State, apply
from armlab.ui.fields import SEEN
from armlab.ui.plugin import hidden_layers, layers, panel
from support.student import run, student

AXES = Exercise(catalogue()["planar_2r"]).solution


def node(browser, name):
    """Return what is known of a node of the exercise."""
    return next(props for path, props in browser.nodes.items() if path.endswith(f"/{name}"))


async def at_the_axes(url):
    browser = await student(url, path="/robot/planar_2r")
    await browser.open("trainer")
    await browser.press("trainer-start")
    await browser.until(lambda: 'data-cell="trainer-check"' in browser.html())
    return browser


def field(browser, cell):
    """Return the markup of a field; empty when there is none."""
    found = re.search(rf'<input[^>]*data-cell="{cell}"[^>]*>', browser.html())
    return found[0] if found else ""


def test_a_direction_is_chosen_and_taken_away_again(url):
    async def main():
        browser = await at_the_axes(url)

        def chosen():
            return re.search(r'data-cell="trainer-z-0".*?</select>', browser.html())[0]

        await browser.press("trainer-z-0", "+z")
        await browser.until(lambda: '<option value="+z" selected>' in chosen())
        await browser.press("trainer-z-0", "")
        await browser.until(lambda: '<option value="" selected>' in chosen())
        await browser.press("trainer-z-0", "up")
        await browser.until(lambda: "direction: unknown name" in browser.html())
        await browser.close()

    run(main())


@pytest.mark.usefixtures("reads_at_once")
def test_what_is_no_number_stays_in_its_cell_with_the_reason_below_the_table(url):
    async def main():
        browser = await at_the_axes(url)
        for i, (z, x) in enumerate(AXES):
            await browser.press(f"trainer-z-{i}", z)
            await browser.press(f"trainer-x-{i}", x)
        await browser.press("trainer-check")
        await browser.until(lambda: bool(field(browser, "trainer-cell-1-a")))
        await browser.press("trainer-cell-1-a", "long")
        await browser.until(lambda: 'aria-invalid="true"' in field(browser, "trainer-cell-1-a"))
        assert 'value="long"' in field(browser, "trainer-cell-1-a")
        assert re.search(r'role="alert">✕ row 1, a₁?: expected a number in mm', browser.html())
        await asyncio.sleep(SEEN)
        await browser.press("trainer-cell-1-alpha", "0")
        await browser.until(lambda: "aria-invalid" not in browser.html())
        assert 'value=""' in field(browser, "trainer-cell-1-a")
        assert browser.notices == []
        # A row and a column are asked about, and the rule of their cell is told.
        await browser.press("trainer-row-2")
        await browser.press("trainer-column-d")
        await browser.press("trainer-rule")
        await browser.until(lambda: "Hint for d₂" in browser.html())
        await browser.press("trainer-end")
        await browser.until(lambda: "Exercise: Planar 2R" in browser.html())
        await browser.close()

    run(main())


def test_name_and_arrows_of_the_last_frame_go_with_its_origin(url):
    """With x2 along +y, O2 lies on the axis of joint 2 where O1 is, and no longer at the tip."""

    async def main():
        browser = await at_the_axes(url)
        await browser.until(lambda: "text" in node(browser, "origin_label2"))
        assert node(browser, "origin_label2")["text"] == "{2}"
        assert node(browser, "z2")["scale"] == node(browser, "z1")["scale"]
        for i, (z, x) in enumerate((*AXES[:2], ("+z", "+y"))):
            await browser.press(f"trainer-z-{i}", z)
            await browser.press(f"trainer-x-{i}", x)
        await browser.press("trainer-check")
        await browser.until(lambda: node(browser, "origin_label1")["text"] == "{1, 2}")
        ball, label = (node(browser, f"origin{name}")["position"] for name in ("2", "_label2"))
        assert label == ball == node(browser, "origin1")["position"]
        assert not node(browser, "origin_label2")["visible"]
        assert node(browser, "z2")["scale"] == pytest.approx(0.8 * node(browser, "z1")["scale"])
        await browser.press("trainer-revise")
        await browser.until(lambda: node(browser, "origin_label1")["text"] == "{1}")
        assert node(browser, "origin_label2")["visible"]
        await browser.close()

    run(main())


TELLING = {"frames", "lengths", "angles", "projections"}


def told(state):
    """Return which overlays that tell frames and constants are seen beside the exercise."""
    hidden = hidden_layers(state, [panel("trainer")])
    on = {key for key, layer in layers().items() if layer.switch is not None and layer.switch.on(state)}
    return on & TELLING - hidden


def test_no_overlay_answers_an_exercise_before_it_is_done():
    state = State.initial(catalogue()["cartesian_3p"])
    for name in TELLING:
        state = apply(state, Show(name, True))
    assert told(state) == TELLING
    state = apply(state, StartTrainer())
    for i, (z, x) in enumerate(state[Trainer].exercise.solution):
        state = apply(apply(state, ChooseDirection(i, "z", z)), ChooseDirection(i, "x", x))
    state = apply(state, CheckAxes())
    assert told(state) == set()
    for i, row in enumerate(state[Trainer].assignment.rows):
        for field in FIELDS:
            state = apply(state, SetAnswer(i, field, getattr(row, field)))
    assert told(state) == set()
    state = apply(state, CheckTable())
    assert state[Trainer].done
    assert told(state) == TELLING
