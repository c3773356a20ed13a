"""An exam in the dock: what is typed and chosen is kept without a button, and what has no answer is named."""

import re

import pytest

from armlab.content.question import Choices, Grid
from armlab.teaching.hand_in_assignment import judge_assignment
from armlab.teaching.lesson_commands import Answer
from armlab.ui.asking import CHECK, CHOICE, ENTRY, Draft
from support.fake_browser import cookie_of
from support.lab import running_lab
from support.own_lessons import ARM, QUESTIONS, lesson, load, piece, to_step, write
from support.student import run, student

PREDICT = """
## Guess the matrix

```question
kind = "matrix"
text = "The identity?"
answer = [[1, 0], [0, 1]]
tolerance = 0.001
hide = ["values"]
```
"""
EXAM = """title = "Exam"
exam = true
[[tasks]]
lesson = "questions"
[[tasks]]
lesson = "guess"
"""


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    folder = write(tmp_path_factory.mktemp("lessons"), questions=lesson(QUESTIONS), guess=lesson(PREDICT, ARM))
    (folder / "exam.toml").write_text(EXAM, encoding="utf-8")
    with running_lab(lessons=folder) as address:
        yield address


def missing(browser):
    """Return the steps without an answer, by task."""
    found = re.findall(r"<li>Task (\d), steps? <b>([\d, ]+)</b></li>", piece(browser, "confirm-yes"))
    return {int(task): steps for task, steps in found}


async def asked_to_hand_in(browser):
    await browser.press("assignment-hand-in")
    await browser.until(lambda: "confirm-yes" in browser.html())


def test_a_filled_matrix_and_chosen_options_are_handed_in_and_what_has_no_answer_is_named(url):
    async def main():
        cookie = cookie_of(url)
        load(url, cookie, "assignment/exam")
        browser = await student(url, cookie, "/assignment/exam")
        await browser.until(lambda: "assignment-hand-in" in browser.html() and "lesson-foot" in browser.html())
        await browser.press("lesson-name", "Ada")
        await to_step(browser, 2)
        for option in (2, 4):
            await browser.press(f"{CHOICE}{option}")
        await browser.until(lambda: "Your answer is noted" in browser.html())
        await to_step(browser, 3)
        for place, text in (("0-0", "0.5"), ("0-1", "0"), ("1-0", "0")):
            await browser.press(f"{ENTRY}{place}", text)
        await browser.until(lambda: piece(browser, 'class="entries"').count('value="0"') == 2)
        assert "Your answer is noted" not in browser.html()  # one field is empty
        await browser.press(f"{ENTRY}1-1", "0.5")
        await browser.until(lambda: "Your answer is noted" in browser.html())
        await to_step(browser, 4)
        await browser.press("lesson-answer", "l1 +")  # cannot be read
        await to_step(browser, 5)
        await browser.press("task-1")
        await browser.until(lambda: "Guess the matrix" in browser.html())
        for i, row in enumerate((("1", "0"), ("0", "1"))):
            for j, text in enumerate(row):
                await browser.press(f"{ENTRY}{i}-{j}", text)
        await asked_to_hand_in(browser)
        assert missing(browser) == {1: "1, 4, 5", 2: "1"}
        assert "counts only when it is kept with the button" in browser.html()
        await browser.press("confirm-no")
        await browser.until(lambda: "confirm-no" not in browser.html())
        await browser.press(CHECK)
        await browser.until(lambda: "Your prediction is noted" in browser.html())
        await asked_to_hand_in(browser)
        assert missing(browser) == {1: "1, 4, 5"}
        await browser.press("confirm-yes")
        await browser.until(lambda: any(browser.downloads.values()))
        report = judge_assignment(browser.downloads["exam_ada.json"], "exam")
        assert [step.label for step in report.steps if step.passed] == ["1.2", "1.3", "2.1"]
        await browser.close()

    run(main())


def test_a_draft_without_a_button_keeps_up_with_its_parts():
    grid = Draft(Grid(1, 2), "", at_once=True)
    assert grid.enter(0, 0, "1") is None
    assert grid.enter(0, 1, "2") == Answer("1 2")
    assert grid.enter(0, 1, "2") is None
    assert grid.enter(0, 1, "") == Answer("")
    assert grid.enter(0, 0, "3") is None
    assert grid.enter(0, 1, "4") == Answer("3 4")
    options = Draft(Choices(("a", "b"), several=True), "2", at_once=True)
    assert options.choose(1) == Answer("1,2")
    assert [options.choose(1), options.choose(2)] == [Answer("2"), Answer("")]
