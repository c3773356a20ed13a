"""How questions are asked and answered over the wire: options, grids, formulas, predictions."""

import asyncio

import numpy as np
import pytest

from armlab.content.question import Choices, Field, Grid
from armlab.teaching.lesson_commands import Answer
from armlab.ui.asking import CHECK, CHOICE, ENTRY, Draft
from armlab.ui.plugin import layers
from armlab.window.tab import COVERED
from support.fake_browser import FakeBrowser, cookie_of
from support.lab import running_lab
from support.own_lessons import ARM, QUESTIONS, in_lesson, lesson, load, piece, to_step, write
from support.student import arm_nodes, run, settled

VALUES = """
## Guess

```question
kind = "number"
text = "How far is the tool?"
answer = 1
tolerance = 0.5
hide = ["values"]
```
"""


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    front = ARM + 'overlays = ["projections", "frames"]\n'
    folder = write(tmp_path_factory.mktemp("lessons"), questions=lesson(QUESTIONS), values=lesson(VALUES, front))
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


# -- predictions -------------------------------------------------------------------------------------------------


class Seen:
    """What a browser has been told to show in the scene."""

    def __init__(self, browser):
        self.shown = {}
        browser.on_message = self.note

    def note(self, message, _at):
        name = message.get("name", "")
        if message["type"] == "SetSceneNodeVisibilityMessage":
            self.shown[name] = message["visible"]
        elif message["type"] == "RemoveSceneNodeMessage":
            self.shown = {node: on for node, on in self.shown.items() if not f"{node}/".startswith(f"{name}/")}
        elif name and "props" in message:
            self.shown[name] = True

    def things(self):
        """Return the names of visible nodes of the arm and its handle; the room is left out."""
        return {
            name
            for name, on in self.shown.items()
            if on and "/stage" not in name and (name.endswith("/body") or name == "/target" or "/frames" in name)
        }


async def watched(url, cookie):
    """Come into the lesson with all that is shown noted."""
    load(url, cookie, "lesson/questions")
    browser = FakeBrowser(url, cookie, "/lesson/questions")
    seen = Seen(browser)
    await browser.connect()
    await browser.until(lambda: "lesson-foot" in browser.html())
    return browser, seen


def test_a_prediction_hides_arm_and_values_until_the_first_answer(url):
    async def main():
        browser, seen = await watched(url, cookie_of(url))
        await browser.until(lambda: len(seen.things()) > 2)
        await to_step(browser, 5)
        await browser.until(lambda: not seen.things())
        assert any("stage" in name and on for name, on in seen.shown.items())
        assert "Predict: your first answer counts." in browser.html()
        assert 'data-live="px">?<' in piece(browser, "lesson-text")
        assert COVERED in browser.html()
        assert not any(c["props"].get("label", "").startswith("q₁") for c in browser.controls.values())
        await browser.open("ellipsoid")
        assert COVERED in browser.html()
        await browser.press("lesson-answer", "two")  # cannot be read: the prediction is still open
        await browser.until(lambda: "write a number such as 0.5" in piece(browser, "still open"))
        assert 'value="two"' in piece(browser, "lesson-answer")
        await to_step(browser, 4)  # whose field has the same name
        assert "still open" not in browser.html()
        assert 'value="two"' not in browser.html()
        await to_step(browser, 5)
        assert not seen.things()
        assert "Both links in a line" not in browser.html()
        await browser.press("lesson-answer", "1")
        await browser.until(lambda: "Both links in a line" in browser.html())
        await browser.until(lambda: "Your prediction is noted." in browser.html())
        assert "✕ Not as predicted" in browser.html()  # there is no second try
        await browser.until(lambda: len(seen.things()) > 2)
        await browser.open("joints")
        await browser.until(lambda: COVERED not in browser.html())
        assert browser.slider(1)["value"] == 30.0
        assert 'data-live="px">?<' not in piece(browser, "lesson-text")
        assert " disabled>" in piece(browser, "lesson-answer")
        assert 'class="way on"' in piece(browser, "lesson-foot")  # a prediction passes, right or not
        await browser.press("lesson-answer", "2")  # of a field that is closed: nothing
        await browser.press("lesson-back")
        await browser.until(lambda: 'value="1"' not in browser.html())
        await browser.press("lesson-next")
        await browser.until(lambda: "Your prediction is noted." in browser.html())
        assert 'value="1"' in piece(browser, "lesson-answer")
        await browser.close()

    run(main())


def test_while_values_are_hidden_the_arm_stays_and_no_overlay_tells_them(url):
    async def main():
        cookie = cookie_of(url)
        load(url, cookie, "lesson/values")
        browser = FakeBrowser(url, cookie, "/lesson/values")
        seen = Seen(browser)
        await browser.connect()
        await browser.until(lambda: "lesson-foot" in browser.html())
        await browser.until(lambda: len(seen.things()) > 2)

        def told():
            return [name for name, on in seen.shown.items() if on and "projections" in name]

        assert not told()
        await browser.press("lesson-answer", "1")
        await browser.until(lambda: bool(told()))
        await browser.close()

    run(main())


def test_a_teacher_s_file_does_not_tell_what_is_to_be_predicted(url):
    async def main():
        browser, _ = await watched(url, cookie_of(url))
        await to_step(browser, 5)
        await browser.open("author")
        await browser.press("save-lesson")
        await browser.until(lambda: 'role="alert">✕ Answer the question of the lesson first' in browser.html())
        assert browser.downloads == {}
        await browser.press("lesson-answer", "1")
        await browser.until(lambda: "Your prediction is noted." in browser.html())
        await browser.press("save-lesson")
        await browser.until(lambda: "my_lesson.md" in browser.downloads)
        await browser.close()

    run(main())


def test_a_page_that_loads_before_a_prediction_shows_no_arm(url):
    async def main():
        cookie = cookie_of(url)
        browser, seen = await watched(url, cookie)
        await to_step(browser, 5)
        await browser.until(lambda: not seen.things())
        await browser.close()
        again, seen = await watched(url, cookie)
        await again.until(lambda: COVERED in again.html())
        await asyncio.sleep(0.5)
        assert not seen.things()
        assert any("stage" in name for name in seen.shown)
        await to_step(again, 6)
        await again.until(lambda: len(seen.things()) > 2)
        await again.until(lambda: COVERED not in again.html())
        await again.close()

    run(main())


def test_the_lessons_page_can_be_read_before_a_prediction(url):
    async def main():
        browser = await in_lesson(url, "questions")
        await to_step(browser, 5)
        await browser.until(lambda: COVERED in browser.html())
        await browser.open("lessons")
        await browser.until(lambda: 'data-cell="lesson:questions"' in browser.html())
        await browser.close()

    run(main())


def test_the_room_is_a_layer():
    assert "stage" in layers()


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
