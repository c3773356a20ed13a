"""How questions are asked and answered over the wire: options, grids, formulas."""

import asyncio
import re

import numpy as np
import pytest

from armlab.content.question import Choices, Field, Grid
from armlab.content.questions.matrix import MatrixQuestion
from armlab.content.questions.number import NumberQuestion
from armlab.teaching.lesson_commands import Answer
from armlab.ui.asking import CHECK, CHOICE, ENTRY, Draft
from support.lab import running_lab
from support.own_lessons import QUESTIONS, in_lesson, lesson, piece, to_step, write
from support.student import arm_nodes, run, settled


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    folder = write(tmp_path_factory.mktemp("lessons"), questions=lesson(QUESTIONS))
    with running_lab(lessons=folder) as address:
        yield address


def pressed(browser):
    """Return the options that are down."""
    parts = piece(browser, 'class="choices"').split('data-cell="lesson-choice-')[1:]
    return [int(part.split('"')[0]) for part in parts if 'aria-pressed="true"' in part.split(">")[0]]


def entries(browser):
    """Return what the fields of a grid hold."""
    parts = piece(browser, 'class="entries"').split(' value="')[1:]
    return [part.split('"')[0] for part in parts]


# -- options -----------------------------------------------------------------------------------------------------


def test_one_option_answers_at_once_and_its_verdict_is_said(url):
    async def main():
        browser = await in_lesson(url, "questions")
        asked = piece(browser, 'class="choices"')
        assert "two <strong>joints</strong>" in asked
        assert "lesson-check" not in asked
        assert "Two it is" not in browser.html()
        await browser.press("lesson-choice-1")
        await browser.until(lambda: "Count <em>again</em>." in browser.html())
        assert pressed(browser) == [1]
        await browser.press("lesson-choice-2")
        await browser.until(lambda: "✓ Right." in browser.html())
        assert pressed(browser) == [2]
        await browser.until(lambda: "Two it is" in piece(browser, 'class="reveal"'))
        assert "lesson-hint" not in browser.html()  # nothing is left to be helped with
        await browser.close()

    run(main())


def test_several_options_are_gathered_and_handed_in(url):
    async def main():
        browser = await in_lesson(url, "questions")
        await to_step(browser, 2)
        assert "Choose all that apply." in browser.html()
        for option in ("2", "3"):
            await browser.press(f"lesson-choice-{option}")
            await browser.until(lambda option=option: int(option) in pressed(browser))
        assert 'class="verdict' not in piece(browser, 'class="choices"')
        await browser.set_value(browser.slider(1), -10.0)  # a moving arm takes no choice away
        await asyncio.sleep(0.3)
        assert pressed(browser) == [2, 3]
        await browser.press(CHECK)
        await browser.until(lambda: "Three is odd." in browser.html())
        assert pressed(browser) == [2, 3]
        await browser.press("lesson-choice-3")
        await browser.until(lambda: pressed(browser) == [2])
        await browser.press(CHECK)
        await browser.until(lambda: "something is missing" in browser.html())
        await browser.press("lesson-choice-4")
        await browser.press(CHECK)
        await browser.until(lambda: "✓ Right." in browser.html())
        assert pressed(browser) == [2, 4]
        await browser.close()

    run(main())


@pytest.mark.parametrize("cell", [f"{CHOICE}x", f"{CHOICE}-1", f"{CHOICE}99", f"{ENTRY}0", f"{ENTRY}0-x", "nothing"])
def test_a_page_that_is_not_ours_does_no_harm(url, cell):
    async def main():
        browser = await in_lesson(url, "questions")
        channel = piece(browser, 'class="choices"').split('data-chan="')[1].split('"')[0]
        value = f'["{cell}", "1", 1]'
        await browser.send({"type": "GuiUpdateMessage", "uuid": channel, "updates": {"value": value}})
        await browser.press("lesson-choice-2")
        await browser.until(lambda: "✓ Right." in browser.html())
        await browser.close()

    run(main())


# -- grids -------------------------------------------------------------------------------------------------------


def test_a_grid_is_filled_while_the_arm_moves_and_handed_in(url):
    async def main():
        browser = await in_lesson(url, "questions")
        await to_step(browser, 3)
        after = re.findall('data-below="([^"]*)"', piece(browser, 'class="entries"'))
        assert after == [f"{ENTRY}0-1", f"{ENTRY}1-0", f"{ENTRY}1-1", CHECK]  # where Enter leads
        await browser.press(f"{ENTRY}0-0", " 1 / 2 ")
        await browser.until(lambda: entries(browser)[0] == " 1 / 2 ")
        await browser.press(f"{ENTRY}1-1", "0,5")
        for value in (10.0, 20.0, -10.0):
            await browser.set_value(browser.slider(1), value)
            await asyncio.sleep(0.15)
        await browser.until(lambda: entries(browser) == [" 1 / 2 ", "", "", "0,5"])
        await browser.press(CHECK)
        await browser.until(lambda: "✕ Not yet" in browser.html())
        assert "row 1, column 2" in piece(browser, "✕ Not yet").lower()
        assert entries(browser) == [" 1 / 2 ", "", "", "0,5"]
        await browser.press(f"{ENTRY}0-1", "0")
        await to_step(browser, 2)  # to look something up, at a question too
        await to_step(browser, 3)
        await browser.press(f"{ENTRY}1-0", "0")
        await browser.press(CHECK)
        await browser.until(lambda: "✓ Right." in browser.html())
        await browser.close()

    run(main())


def test_an_empty_grid_names_what_is_missing(url):
    async def main():
        browser = await in_lesson(url, "questions")
        await to_step(browser, 3)
        await browser.press(CHECK)
        await browser.until(lambda: "✕ Not yet" in browser.html())
        assert "row 1, column 1" in piece(browser, "✕ Not yet").lower()
        await browser.close()

    run(main())


def filled(*rows):
    draft = Draft(Grid(len(rows), len(rows[0])), "")
    for i, row in enumerate(rows):
        for j, text in enumerate(row):
            draft.enter(i, j, text)
    return draft.hand_in().text


def test_a_draft_gives_the_whole_answer_as_one_text():
    assert filled(["1", "0"], ["", "sqrt(2) / 2"]) == "1 0; ? sqrt(2)/2"
    choices = Draft(Choices(("a", "b", "c"), several=True), "3")
    assert choices.choose(1) is None
    assert choices.hand_in() == Answer("1,3")
    assert Draft(Choices(("a", "b"), several=False), "").choose(2) == Answer("2")
    assert Draft(Field("m"), "").hand_in() == ()


@pytest.mark.parametrize(
    "rows", [(["0,5", "1"], ["1", "0"]), (["0,5", "0,25"], ["1", "0"]), (["−0,5", "1"], ["1", "0"])]
)
def test_decimal_commas_in_a_grid_are_decimal_points(rows):
    assert "," not in filled(*rows)


def test_an_answer_that_comes_back_has_nothing_in_its_empty_entries():
    assert Draft(Grid(2, 2), "1 0; ? sqrt(2)/2").entries == {(0, 0): "1", (0, 1): "0", (1, 1): "sqrt(2)/2"}


def test_the_entries_of_a_grid_stay_apart():
    assert filled(["1; 2", "atan2(1, 2)"]).count(";") == 0
    assert filled(["atan2(1,2)", "0"]) == "atan2(1,2) 0"


def test_a_unit_stays_with_its_number():
    assert filled(["500 mm", "2 (m)"], ["1 000", "90 °"]) == "500mm 2(m); (1,000) 90°"


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("1/2 sqrt(3)", 0.8660254, ""),
        ("(1/2) √3", 0.8660254, ""),
        ("3 cos(60°)", 1.5, ""),
        ("2 π", 6.2831853, "rad"),
        ("2 π rad", 6.2831853, "rad"),
        ("½ π", 1.5707963, "rad"),
        ("0.5 N·m", 0.5, "Nm"),
        ("0.5 * m", 0.5, "m"),
        ("2 m s^-1", 2.0, "m/s"),
        ("2 m s⁻²", 2.0, "m/s^2"),
        ("3·10⁻²", 0.03, ""),
        ("30 deg s^-1", 0.52359878, "rad/s"),
    ],
)
def test_a_field_of_a_grid_takes_the_products_and_units_of_a_single_field(text, value, unit):
    assert NumberQuestion("", value, unit, 1e-6).judge(text).right
    assert MatrixQuestion("", np.array([[value], [1.0]]), 1e-6, unit).judge(filled([text], ["1"])).right


# -- formulas ----------------------------------------------------------------------------------------------------


def test_a_formula_is_judged_by_its_values(url):
    async def main():
        browser = await in_lesson(url, "questions")
        await to_step(browser, 4)
        await browser.press("lesson-answer", "l1 c1 + l2 cos(q2)")
        await browser.until(lambda: "The second link turns with the first." in browser.html())
        assert 'value="l1 c1 + l2 cos(q2)"' in browser.html()
        await browser.press("lesson-answer", "l1 c1 + ")
        await browser.until(lambda: "turns with the first" not in browser.html())
        assert "✕ Not yet" in browser.html()
        await browser.press("lesson-answer", "l2*c12 + l1*cos(q1)")
        await browser.until(lambda: "✓ Right." in browser.html())
        await browser.close()

    run(main())


def test_a_moving_arm_does_not_touch_the_field_of_an_answer(url):
    async def main():
        browser = await in_lesson(url, "questions")
        await to_step(browser, 4)
        await settled(browser)
        field = next(key for key, c in browser.controls.items() if "lesson-answer" in c["props"].get("content", ""))
        written = []
        browser.on_message = lambda message, _at: written.append(message["uuid"]) if "uuid" in message else None
        for value in (10.0, 20.0, 30.5):
            await browser.set_value(browser.slider(1), value)
            z = np.sin(np.radians(value) / 2)
            await browser.until(lambda z=z: np.isclose(browser.nodes[arm_nodes(browser)[0]]["wxyz"][3], z))
        await browser.until(lambda: bool(written))
        await settled(browser)
        assert field not in written
        await browser.close()

    run(main())


def test_wrong_states_have_their_sentence(url):
    async def main():
        browser = await in_lesson(url, "questions")
        await to_step(browser, 6)
        await browser.set_value(browser.slider(1), 0.0)
        await browser.until(lambda: "The <em>second</em> joint is left." in piece(browser, "◐ Not there yet"))
        await browser.set_value(browser.slider(1), 90.0)
        await browser.until(lambda: "joint is left" not in browser.html())
        assert "◐ Not there yet" in browser.html()
        await browser.set_value(browser.slider(1), 0.0)
        await browser.set_value(browser.slider(2), 0.0)
        await browser.until(lambda: "✓ Done" in browser.html())
        await browser.close()

    run(main())
