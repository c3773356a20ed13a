"""Which panels are open, over the wire: each page turns by itself, and lessons turn them all."""

import asyncio
import re

import pytest

from armlab.session.pages import pages, tab_of
from support.fake_browser import cookie_of
from support.lab import running_lab
from support.own_lessons import in_lesson, lesson, notes, piece, write
from support.student import run, student

NO_PANEL = 'robot = "planar_2r"\nq_deg = [30, 60]\n'
LOOK = '\n## Look\n\nText.\n\n```check\nkind = "looked_at"\npanel = "{}"\n```\n'


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    look = {key: lesson(LOOK.format(key), NO_PANEL) for key in ("joints", "film")}
    stay = lesson(front=NO_PANEL, title="Stay")
    with running_lab(lessons=write(tmp_path_factory.mktemp("lessons"), stay=stay, **look)) as address:
        yield address


def turned(browser):
    """Return the pages on which the tabs of a browser stand."""
    return set(re.findall(r'data-cell="(\w+)"[^>]*aria-selected="true"', browser.html()))


def test_a_panel_that_is_open_when_the_lesson_that_asks_for_it_begins_counts(url):
    async def main():
        browser = await in_lesson(url, "joints")
        await browser.until(lambda: "✓ Lesson done" in browser.html())
        await browser.close()

    run(main())


def test_a_panel_that_was_left_before_its_lesson_began_does_not_count(url):
    async def main():
        cookie = cookie_of(url)
        browser = await in_lesson(url, "stay", cookie)
        await browser.open("film")
        await browser.press("lesson-close")
        await browser.until(lambda: "lesson-foot" not in browser.html())
        await browser.open("joints")
        await browser.close()
        again = await in_lesson(url, "film", cookie)
        await again.open("joints")
        await asyncio.sleep(0.5)
        assert "✓ Done" not in again.html()
        await again.open("film")
        await again.until(lambda: "✓ Done" in again.html())
        await again.close()

    run(main())


def test_of_two_tabs_side_by_side_both_count(url):
    async def main():
        browser = await in_lesson(url, "stay")
        await browser.open("film")
        await browser.open("film", "joints")
        await browser.open("film", "joints", "share")
        await browser.press("lesson-key", "film")
        await browser.until(lambda: "✓ Done" in browser.html())
        await browser.close()

    run(main())


def test_two_pages_of_a_student_turn_by_themselves_and_a_third_begins_where_the_last_did(url):
    async def main():
        cookie = cookie_of(url)
        one, other = await student(url, cookie), await student(url, cookie)
        await one.open("film")
        await other.open("table")
        await one.until(lambda: "film" in turned(one))
        assert "table" not in turned(one)
        assert "film" not in turned(other)
        third = await student(url, cookie)
        assert notes(third)["tab"] == pages()[tab_of("table")].title
        await third.until(lambda: "table" in turned(third))
        for each in (one, other, third):
            await each.close()

    run(main())


def test_a_reload_stays_where_the_student_was_and_undo_turns_no_page(url):
    async def main():
        cookie = cookie_of(url)
        browser = await student(url, cookie)
        await browser.set_value(browser.slider(1), 12.0)
        await browser.open("table")
        await browser.press("undo")
        await browser.until(lambda: "Nothing to undo" in piece(browser, 'data-cell="undo"'))
        assert "table" in turned(browser)
        await browser.close()
        again = await student(url, cookie)
        await again.until(lambda: "table" in turned(again))
        await again.close()

    run(main())
