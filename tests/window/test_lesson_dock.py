"""Lessons over the wire: the dock with text, formulas and checks; links; progress; what a lesson holds back."""

import json
import re

import pytest

from armlab.content.as_written import as_part
from armlab.content.lessons import lessons
from support.fake_browser import cookie_of
from support.lab import running_lab
from support.own_lessons import (
    QUESTIONS,
    in_lesson,
    lesson,
    load,
    notes,
    piece,
    to_step,
    write,
)
from support.student import run, student

CHOSEN = re.compile(r'<button[^>]*data-cell="lesson-choice-2"[^>]*aria-pressed="true"')


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    folder = write(tmp_path_factory.mktemp("lessons"), questions=lesson(QUESTIONS))
    with running_lab(lessons=folder) as address:
        yield address


def docks(browser):
    """Return the titles of the tabs in docks."""
    return [label for c in browser.controls.values() for label in c["props"].get("_tab_labels", ())]


# -- the dock ----------------------------------------------------------------------------------------------------


def test_a_link_opens_the_lesson_with_text_formulas_and_what_is_missing(url):
    async def main():
        browser = await in_lesson(url, "first_arm/0")
        text = piece(browser, "lesson-text")
        assert "<h2><small>1 of 4</small> Stretch the arm along x</h2>" in text
        assert "<math" in text
        assert "<summary>About this lesson</summary>" in text
        assert "◐ To do" in browser.html()
        assert "Not there yet" not in browser.html()
        assert "away from (2000.0, 0.0, 0.0) mm" not in browser.html()
        assert notes(browser)["path"] == "/lesson/first_arm/0"
        assert "Lesson" in docks(browser)
        assert browser.slider(2)["value"] == 55.0
        await browser.close()

    run(main())


def test_the_check_the_question_and_the_way_through(url):
    async def main():
        browser = await in_lesson(url, "first_arm/0")
        assert "Skip" in browser.html()
        await browser.set_value(browser.slider(1), 0.0)
        await browser.until(lambda: "still bends away from it" in piece(browser, "◐ Not there yet"))
        await browser.set_value(browser.slider(2), 0.0)
        await browser.until(lambda: "✓ Done" in browser.html())
        await browser.press("lesson-next")
        await browser.until(lambda: "<small>2 of 4</small>" in browser.html())
        assert "About this lesson" in browser.html()
        assert "The two configurations are" not in browser.html()
        await browser.press("right angle")
        await browser.until(lambda: "✓ Done" in browser.html())
        await browser.until(lambda: "The two configurations are" in piece(browser, 'class="reveal"'))
        await browser.press("lesson-next")
        await browser.until(lambda: "lesson-answer" in browser.html())
        await browser.press("lesson-answer", "0.5")
        await browser.until(lambda: "✕ Not yet" in browser.html())
        assert "Both joints turn the second link" in browser.html()
        await browser.press("lesson-answer", '"><script>1</script>')
        await browser.until(lambda: "cannot read" in browser.html())
        assert "<script" not in browser.html()
        await browser.press("lesson-answer", "86.6 cm")
        await browser.until(lambda: "✓ Right." in browser.html())
        assert "which points in the direction" in browser.html()
        await browser.press("lesson-next")
        await browser.until(lambda: "lesson-choice-2" in browser.html())
        await browser.press("lesson-choice-2")
        await browser.until(lambda: "keep its direction" in browser.html())
        assert "◐ Not there yet" in browser.html()  # who has answered has begun
        await browser.set_value(browser.slider(1), 90.0)
        await browser.until(lambda: "✓ Lesson done" in browser.html())
        assert browser.html().count('class="strip done"') == 4
        await browser.close()

    run(main())


def test_hints_come_one_after_the_other_and_stay(url):
    async def main():
        browser = await in_lesson(url, "first_arm")
        assert ">Hint 1 of 2<" in piece(browser, "lesson-foot")
        assert 'class="hint"' not in browser.html()
        await browser.press("lesson-hint")
        await browser.until(lambda: "<b>Hint 1 of 2</b>" in piece(browser, "lesson-text"))
        assert "<b>Hint 2 of 2</b>" not in browser.html()
        await browser.until(lambda: ">Hint 2 of 2<" in piece(browser, "lesson-foot"))
        await browser.press("lesson-hint")
        await browser.until(lambda: "<b>Hint 2 of 2</b>" in piece(browser, "lesson-text"))
        await browser.until(lambda: "lesson-hint" not in piece(browser, "lesson-foot"))
        await to_step(browser, 2)
        assert 'class="hint"' not in browser.html()
        await to_step(browser, 1)
        assert browser.html().count('class="hint"') == 2
        await browser.close()

    run(main())


def test_live_values_follow_the_arm(url):
    async def main():
        browser = await in_lesson(url, "questions")
        assert 'data-live="q1">30.0°<' in piece(browser, "lesson-text")
        await browser.set_value(browser.slider(1), -45.0)
        await browser.until(lambda: 'data-live="q1">−45.0°<' in piece(browser, "lesson-text"))
        await browser.close()

    run(main())


def test_a_reload_resets_nothing_and_an_own_answer_is_kept(url):
    async def main():
        cookie = cookie_of(url)
        browser = await in_lesson(url, "first_arm", cookie)
        await browser.press("lesson-hint")
        await browser.press("stretched")
        await browser.until(lambda: "✓ Done" in browser.html())
        await to_step(browser, 3)
        await browser.press("lesson-answer", "0.5")
        await browser.until(lambda: "✕ Not yet" in browser.html())
        await browser.close()
        again = await in_lesson(url, "first_arm", cookie)
        assert "<small>3 of 4</small>" in again.html()
        assert 'value="0.5"' in again.html()
        assert "✕ Not yet" in again.html()
        assert again.slider(2)["value"] == 0.0
        await to_step(again, 1)
        assert "<b>Hint 1 of 2</b>" in again.html()
        await again.close()

    run(main())


def test_what_is_half_filled_in_is_kept_for_a_page_that_opens_later_and_stays_out_of_others(url):
    entry = lambda browser: piece(browser, 'data-cell="lesson-entry-0-0"')  # noqa: E731

    async def main():
        browser = await in_lesson(url, "questions")
        other = await student(url, browser.cookie)
        await to_step(browser, 2)
        await browser.press("lesson-choice-2")
        await browser.until(lambda: CHOSEN.search(browser.html()))
        await to_step(browser, 3)
        await browser.press("lesson-entry-0-0", "0.25")
        await browser.until(lambda: 'value="0.25"' in entry(browser))
        await other.until(lambda: "lesson-entry-0-0" in other.html())
        assert 'value="0.25"' not in entry(other)
        await browser.close()
        again = await student(url, browser.cookie)
        assert 'value="0.25"' in entry(again)
        await to_step(again, 2)
        assert CHOSEN.search(again.html())
        for each in (other, again):
            await each.close()

    run(main())


def test_another_arm_by_hand_and_back(url):
    async def main():
        browser = await in_lesson(url, "first_arm")
        await browser.open("robot")
        await browser.until(lambda: 'data-cell="planar_3r"' in browser.html())
        await browser.press("planar_3r")
        await browser.until(lambda: "Another arm has been chosen" in browser.html())
        assert "about the Planar 2R" in browser.html()
        await browser.press("lesson-arm")
        await browser.until(lambda: "Not there yet" in browser.html())
        await browser.close()

    run(main())


def test_closing_removes_the_dock_and_the_list_opens_it_again(url):
    async def main():
        browser = await in_lesson(url, "first_arm")
        await browser.press("lesson-close")
        await browser.until(lambda: browser.counts["GuiPanelRemoveMessage"] == 1)
        await browser.until(lambda: notes(browser)["path"] == "/robot/planar_2r")
        assert "lesson-head" not in browser.html()
        await browser.open("lessons")
        await browser.until(lambda: 'data-cell="lesson:first_arm"' in browser.html())
        await browser.press("lesson:first_arm")
        await browser.until(lambda: "lesson-head" in browser.html())
        await browser.close()

    run(main())


def test_another_lesson_is_chosen_in_the_dock(url):
    async def main():
        browser = await in_lesson(url, "first_arm")
        await browser.press("lesson-key", "questions")
        await browser.until(lambda: "<small>1 of 6</small>" in browser.html())
        assert notes(browser)["path"] == "/lesson/questions"
        assert ' value="questions" selected>' in piece(browser, "lesson-head")
        assert browser.counts["GuiPanelRemoveMessage"] == 0
        await browser.close()

    run(main())


def test_beginning_again_asks_first(url):
    async def main():
        browser = await in_lesson(url, "first_arm")
        await to_step(browser, 2)
        await browser.press("lesson-anew")
        await browser.until(lambda: "answers in this lesson will be deleted" in browser.html())
        assert "<small>2 of 4</small>" in browser.html()
        await browser.press("confirm-no")
        await browser.until(lambda: "answers in this lesson will be deleted" not in browser.html())
        assert "<small>2 of 4</small>" in browser.html()
        await browser.press("lesson-anew")
        await browser.press("confirm-yes")
        await browser.until(lambda: "<small>1 of 4</small>" in browser.html())
        await browser.close()

    run(main())


@pytest.mark.parametrize(("cell", "text"), [("lesson-key", "nothing"), ("lesson-step-7", ""), ("lesson-back", "")])
def test_what_the_dock_does_not_offer_does_nothing(url, cell, text):
    async def main():
        browser = await in_lesson(url, "first_arm")
        channel = piece(browser, "lesson-head").split('data-chan="')[1].split('"')[0]
        value = json.dumps([cell, text, 1])
        await browser.send({"type": "GuiUpdateMessage", "uuid": channel, "updates": {"value": value}})
        await browser.press("lesson-step-1")
        await browser.until(lambda: "<small>2 of 4</small>" in browser.html())
        assert not browser.notices
        await browser.close()

    run(main())


def test_a_link_to_a_lesson_that_is_not_there_says_so(url):
    async def main():
        cookie = cookie_of(url)
        load(url, cookie, "lesson/frist_arm")
        browser = await student(url, cookie, "/lesson/frist_arm")
        await browser.until(lambda: bool(browser.notices))
        assert browser.notices == ["There is no lesson 'frist_arm'. Did you mean /lesson/first_arm?"]
        assert "lesson-head" not in browser.html()
        await browser.close()

    run(main())


# -- two tabs ----------------------------------------------------------------------------------------------------


def test_a_tab_is_told_that_another_one_has_switched_its_lesson(url):
    async def main():
        cookie = cookie_of(url)
        one = await in_lesson(url, "first_arm", cookie)
        other = await student(url, cookie)
        await other.until(lambda: "lesson-text" in other.html())
        channel = piece(other, "lesson-head").split('data-chan="')[1].split('"')[0]
        value = json.dumps(["lesson-key", "questions", 1])
        await other.send({"type": "GuiUpdateMessage", "uuid": channel, "updates": {"value": value}})
        await one.until(lambda: bool(one.notices))
        title = as_part(lessons()["questions"].title)
        assert (
            one.notices[-1]
            == f"Another tab of this browser has opened the lesson “{title}”. All of them show the same work."
        )
        await other.until(lambda: "How many joints?" in other.html())
        assert other.notices == []
        await one.close()
        await other.close()

    run(main())


def test_the_first_window_of_a_lab_is_told_apart_as_any_other_and_a_link_tells_at_once(tmp_path):
    async def main(url):
        cookie = cookie_of(url)
        first = await student(url, cookie)
        second = await student(url, cookie)
        load(url, cookie, "lesson/joint_types")
        third = await student(url, cookie, "/lesson/joint_types")
        for browser in (first, second):
            await browser.until(lambda browser=browser: bool(browser.notices))
            assert lessons()["joint_types"].title in browser.notices[-1]
        assert third.notices == []
        await third.close()
        await first.until(lambda: "lesson-head" in first.html())
        channel, told = piece(first, "lesson-head").split('data-chan="')[1].split('"')[0], len(second.notices)
        value = json.dumps(["lesson-key", "first_arm", 1])
        await first.send({"type": "GuiUpdateMessage", "uuid": channel, "updates": {"value": value}})
        await second.until(lambda: len(second.notices) > told)
        assert lessons()["first_arm"].title in second.notices[-1]
        await first.close()
        await second.close()

    with running_lab(tmp_path) as url:
        run(main(url))
