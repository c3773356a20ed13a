"""An exam in the dock: what is typed and chosen is kept without a button, and what has no answer is named."""

import re
from dataclasses import replace
from datetime import datetime

import pytest

from armlab.content.lessons import lessons
from armlab.content.question import Choices, Grid
from armlab.teaching.hand_in_assignment import judge_assignment
from armlab.teaching.lesson_commands import Answer
from armlab.ui.asking import CHECK, CHOICE, ENTRY, Draft
from armlab.ui.begin import ask_to_begin
from armlab.ui.html import tag
from armlab.ui.speech import speech_in
from support.assigned import named
from support.fake_browser import cookie_of
from support.lab import running_lab
from support.own_lessons import ARM, QUESTIONS, lesson, load, piece, to_step, write
from support.student import run, settled, student

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
CLOCK = """title = "Oral"
minutes = 40
closes = 2100-01-01T12:00:00Z
[[tasks]]
lesson = "guess"
"""
LATER = CLOCK.replace("closes", "opens").replace("Oral", "Final")


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    folder = write(tmp_path_factory.mktemp("lessons"), questions=lesson(QUESTIONS), guess=lesson(PREDICT, ARM))
    for key, text in (("exam", EXAM), ("oral", CLOCK), ("later", LATER)):
        (folder / f"{key}.toml").write_text(text, encoding="utf-8")
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


# -- the address of an assignment with a clock -------------------------------------------------------------------


class Asking:
    """Keeps what a question is made of, as the only thing that a panel does."""

    def confirm(self, title, text, yes, _, more, no):
        self.said = str(tag("div", [tag("p", each) for each in (title, text, more, yes, no)]))


def asks(browser):
    return "confirm-yes" in browser.html()


async def followed(url, cookie, path):
    """Come by a link, and return when the page is all there."""
    load(url, cookie, path)
    browser = await student(url, cookie, f"/{path}")
    await settled(browser)
    return browser


def test_a_link_starts_no_clock_before_begin_is_pressed_and_asks_no_more_after_that(url):
    async def main():
        cookie = cookie_of(url)
        first = await followed(url, cookie, "assignment/oral/7")
        said = piece(first, "confirm-yes")
        for part in (
            "“\u2068Oral\u2069” takes 40 min.",
            "It is open until",
            "also while you are away",
            "Nothing has begun yet",
        ):
            assert part in said
        assert "as-clock" not in first.html()
        assert "lesson-foot" not in first.html()
        await first.press("confirm-no")
        await first.until(lambda: not asks(first))
        await first.close()
        # Loaded anew, and in a second tab, it asks again; once it has begun in one the other asks no more.
        first, second = await followed(url, cookie, "assignment/oral/7"), await followed(url, cookie, "assignment/oral")
        assert asks(first)
        assert asks(second)
        await first.press("confirm-yes")
        for browser in (first, second):
            await browser.until(lambda browser=browser: "as-clock" in browser.html() and not asks(browser))
        third = await followed(url, cookie, "assignment/oral")
        assert "as-clock" in third.html()
        assert not asks(third)
        for browser in (first, second, third):
            await browser.close()

    run(main())


def test_the_question_tells_the_dates_in_italian_too(url):
    noon = datetime(2100, 1, 1, 12).timestamp()
    said = {}
    for opens, due, closes in (
        (None, None, None),
        (noon, None, None),
        (None, None, noon),
        (noon, noon + 60, noon + 120),
    ):
        found = replace(lessons().assignment("later"), opens=opens, due=due, closes=closes)
        asking = Asking()
        ask_to_begin(asking, print, found, 7)
        said[opens, closes] = asking.said
    assert "It is" not in said[None, None]
    assert "It has been open since 1 Jan 2100, 12:00." in said[noon, None]
    assert "It is open until 1 Jan 2100, 12:00; then it ends for everybody." in said[None, noon]
    last = said[noon, noon + 120]
    assert "It is open from 1 Jan 2100, 12:00 to 1 Jan 2100, 12:02" in last
    assert "It is due on 1 Jan 2100, 12:01." in last
    assert 'data-path="/assignment/later/7"' in last
    told = "".join(map(speech_in("it").markup, said.values()))
    assert not re.search(r"\b(It|The|Nothing|takes|begun|Not now|until|Jan)\b", told)


def test_a_link_that_is_refused_or_starts_no_clock_does_not_ask(url):
    async def main():
        early = await followed(url, cookie_of(url), "assignment/later")
        assert not asks(early)
        assert f"The assignment {named('Final')} opens on" in early.notices[-1]
        free = await followed(url, cookie_of(url), "assignment/exam")
        assert not asks(free)
        assert "assignment-hand-in" in free.html()
        for browser in (early, free):
            await browser.close()

    run(main())
