"""Predictions, of which the first answer counts: what they hide until then, and what is said after it."""

import asyncio

import pytest

from armlab.content.question import NOT_YET, Verdict
from armlab.ui.asking import said
from armlab.ui.plugin import layers
from armlab.ui.right_answer import right_answer
from armlab.window.tab import COVERED
from support.fake_browser import FakeBrowser, cookie_of
from support.lab import running_lab
from support.own_lessons import ARM, QUESTIONS, in_lesson, lesson, load, piece, to_step, write
from support.student import run
from support.verdicts import CHOICE, EXPRESSION, MATRIX, NUMBER, asked_for

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
        assert "<p>2 m</p>" in piece(browser, "The right answer:")
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


# -- what is said after it ---------------------------------------------------------------------------------------


def test_who_cannot_correct_a_prediction_is_not_asked_to_and_sees_the_right_answer_when_the_step_is_done():
    wrong = Verdict(False, NOT_YET)
    open_, done = said(wrong, settled=True, done=False, right="2 m"), said(wrong, settled=True, right="2 m")
    assert "yet" not in open_ + done
    assert "The right answer is shown here when the step is done." in open_
    assert "2 m" not in open_
    assert "2 m" in done
    assert "yet" not in said(wrong, settled=True)  # in an exam, where it is not told
    assert "Count again." in said(Verdict(False, "Count again."), settled=True, right="2 m")


def test_an_earlier_answer_counts_and_the_step_remains_done_only_if_it_is():
    wrong = Verdict(False, NOT_YET)
    assert "was right and counts: the step remains done." in said(wrong, stays="2 m")
    assert "was right and counts.<" in said(wrong, stays="2 m", done=False)


@pytest.mark.parametrize(
    ("question", "says"),
    [
        (NUMBER.format(answer=-0.8660254, unit="deg", tolerance=0.01), "<p>−0.866 °</p>"),
        (CHOICE.format(answer=2), "<div>b</div>"),
        (CHOICE.format(answer=[1, 4]), "<ul><li><div>a</div></li><li><div>d</div></li></ul>"),
        (MATRIX.format(answer=[[0.5, -1], [0, 1.73205]], unit="m"), "<p>0.5  −1 m</p><p>0  1.732 m</p>"),
        (EXPRESSION.format(answer="l1*cos(q1)"), "<p><code>l1*cos(q1)</code></p>"),
    ],
)
def test_the_right_answer_is_written_as_on_the_page(question, says):
    assert says in right_answer(asked_for(question))
