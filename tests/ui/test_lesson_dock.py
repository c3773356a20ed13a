"""Lessons over the wire: the dock with text, formulas, check and question; links; progress over a reload."""

import asyncio
import urllib.request

import pytest

from armlab.content.lessons import lessons
from armlab.errors import ContentError
from armlab.session.parts.lesson import Progress
from armlab.ui import _lesson_page as page
from armlab.ui.panels import lessons as panel
from support.fake_browser import cookie_of
from support.student import run, student

FIRST = lessons()["first_arm"]


def visit(url, cookie, path):
    """Load a page as a browser does that has the cookie already."""
    urllib.request.urlopen(urllib.request.Request(url + path, headers={"Cookie": cookie})).close()


async def in_lesson(url, cookie=None):
    cookie = cookie or cookie_of(url)
    visit(url, cookie, "lesson/first_arm")
    browser = await student(url, cookie, "/lesson/first_arm")
    await browser.until(lambda: "lesson-text" in browser.html())
    return browser, cookie


def docks(browser):
    """Return the titles of the tabs in docks."""
    return [label for c in browser.controls.values() for label in c["props"].get("_tab_labels", ())]


def test_a_link_opens_the_lesson_with_text_formulas_and_what_is_missing(url):
    async def main():
        browser, _ = await in_lesson(url)
        html = browser.html()
        assert "<h2>Where is the hand?</h2>" in html
        assert "Step 1 of 3" in html
        assert "<math" in html.split("lesson-text")[1].split("</div>")[0]
        assert "◐ Not there yet" in html
        assert "away from (2000.0, 0.0, 0.0) mm" in html
        assert "/lesson/first_arm" in html  # the address bar is told
        assert "Lesson" in docks(browser)
        assert browser.slider(2)["value"] == 55.0
        await browser.close()

    run(main())


def test_the_check_the_question_and_the_way_through(url):
    async def main():
        browser, _ = await in_lesson(url)
        assert "Skip" in browser.html()
        await browser.set_value(browser.slider(1), 0.0)
        await browser.set_value(browser.slider(2), 0.0)
        await browser.until(lambda: "✓ Done" in browser.html())
        await browser.press("lesson-next")
        await browser.until(lambda: "Step 2 of 3" in browser.html())
        assert "About this lesson" in browser.html()
        await browser.press("right angle")
        await browser.until(lambda: "✓ Done" in browser.html())
        await browser.press("lesson-next")
        await browser.until(lambda: "lesson-answer" in browser.html())
        await browser.press("lesson-answer", "0.5")
        await browser.until(lambda: "✕ Not yet" in browser.html())
        assert "Both joints turn the second link" in browser.html()
        await browser.press("lesson-answer", '"><script>1</script>')
        await browser.until(lambda: "cannot read" in browser.html())
        assert "<script" not in browser.html()
        await browser.press("lesson-answer", "86.6 cm")
        await browser.until(lambda: "✓ Lesson done" in browser.html())
        assert browser.html().count('class="strip done"') == 3
        await browser.close()

    run(main())


def test_a_moving_arm_does_not_touch_the_field_of_an_answer(url):
    async def main():
        browser, _ = await in_lesson(url)
        await browser.press("lesson-step-2")
        await browser.until(lambda: "lesson-answer" in browser.html())
        await asyncio.sleep(0.3)
        field = next(key for key, c in browser.controls.items() if "lesson-answer" in c["props"].get("content", ""))
        written = []
        browser.on_message = lambda message, _at: written.append(message["uuid"]) if "uuid" in message else None
        for value in (10.0, 20.0, 30.0):
            await browser.set_value(browser.slider(1), value)
            await asyncio.sleep(0.15)
        assert written
        assert field not in written
        await browser.close()

    run(main())


def test_a_reload_resets_nothing_and_an_own_answer_is_kept(url):
    async def main():
        browser, cookie = await in_lesson(url)
        await browser.press("stretched")
        await browser.until(lambda: "✓ Done" in browser.html())
        await browser.press("lesson-step-2")
        await browser.until(lambda: "lesson-answer" in browser.html())
        await browser.press("lesson-answer", "0.5")
        await browser.until(lambda: "✕ Not yet" in browser.html())
        await browser.close()
        again, _ = await in_lesson(url, cookie)
        assert "Step 3 of 3" in again.html()
        assert 'value="0.5"' in again.html()
        assert "✕ Not yet" in again.html()
        assert again.slider(2)["value"] == 0.0
        await again.close()

    run(main())


def test_another_arm_by_hand_and_back(url):
    async def main():
        browser, _ = await in_lesson(url)
        await browser.open("robot")
        await browser.until(lambda: 'data-cell="planar_3r"' in browser.html())
        await browser.press("planar_3r")
        await browser.until(lambda: "Another arm is on the table" in browser.html())
        assert "about the Planar 2R" in browser.html()
        await browser.press("lesson-arm")
        await browser.until(lambda: "Not there yet" in browser.html())
        await browser.close()

    run(main())


def test_closing_removes_the_dock_and_the_list_opens_it_again(url):
    async def main():
        browser, _ = await in_lesson(url)
        await browser.press("lesson-close")
        await browser.until(lambda: browser.counts["GuiPanelRemoveMessage"] == 1)
        await browser.until(lambda: "/robot/planar_2r" in browser.html())
        assert "lesson-head" not in browser.html()
        await browser.open("lessons")
        await browser.until(lambda: 'data-cell="first_arm"' in browser.html())
        assert "0 of 3" in browser.html()
        await browser.press("first_arm")
        await browser.until(lambda: "lesson-head" in browser.html())
        await browser.close()

    run(main())


def test_beginning_again_asks_first(url):
    async def main():
        browser, _ = await in_lesson(url)
        await browser.press("lesson-step-1")
        await browser.until(lambda: "Step 2 of 3" in browser.html())
        await browser.press("lesson-anew")
        await browser.until(lambda: "answers in this lesson are forgotten" in browser.html())
        assert "Step 2 of 3" in browser.html()
        yes = browser.control("Begin again")
        await browser.send({"type": "GuiUpdateMessage", "uuid": yes["uuid"], "updates": {"value": True}})
        await browser.until(lambda: "Step 1 of 3" in browser.html())
        await browser.close()

    run(main())


@pytest.mark.parametrize(("cell", "text"), [("lesson-key", "nothing"), ("lesson-step-7", ""), ("lesson-back", "")])
def test_what_cannot_be_is_refused_with_a_notice(url, cell, text):
    async def main():
        browser, _ = await in_lesson(url)
        head = next(c for c in browser.controls.values() if "lesson-head" in c["props"].get("content", ""))
        channel = head["props"]["content"].split('data-chan="')[1].split('"')[0]
        value = f'["{cell}", "{text}", 1]'
        await browser.send({"type": "GuiUpdateMessage", "uuid": channel, "updates": {"value": value}})
        await browser.until(lambda: bool(browser.notices))
        assert "Step 1 of 3" in browser.html()
        await browser.close()

    run(main())


def test_a_link_to_a_lesson_that_is_not_there_says_so(url):
    async def main():
        cookie = cookie_of(url)
        visit(url, cookie, "lesson/frist_arm")
        browser = await student(url, cookie, "/lesson/frist_arm")
        await browser.until(lambda: bool(browser.notices))
        assert "did you mean 'first_arm'" in browser.notices[0]
        assert "lesson-head" not in browser.html()
        await browser.close()

    run(main())


def test_strips_tell_what_is_done_and_where_one_is():
    markup = page._strips(FIRST, Progress(1, frozenset((0, 2)), frozenset()), "c")
    assert markup.count('class="strip done"') == 1  # the question of step 3 is not answered
    assert markup.split('aria-current="step"')[0].count('data-cell="lesson-step-') == 2
    assert "Step 1, done: Stretch the arm along x" in markup


def test_the_way_on_is_a_skip_until_the_step_is_done():
    assert "Skip" in page._foot(FIRST, Progress(0), "c")
    assert "Next" in page._foot(FIRST, Progress(0, frozenset((0,))), "c")
    assert "Not done yet: step 1, 3" in page._foot(FIRST, Progress(2, frozenset((1, 2))), "c")


def test_broken_files_are_named_in_the_list(monkeypatch):
    problem = ContentError("a.md", "title", "expected <a text>")
    monkeypatch.setattr(panel, "lessons", lambda: type(lessons())({}, (problem,)))
    assert "✕ 1 broken lesson file<" in panel._problems()
    assert "a.md: title: expected &lt;a text&gt;" in panel._problems()
