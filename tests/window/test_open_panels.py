"""Which panels are open, over the wire: each page turns by itself, and lessons turn them all."""

import asyncio
import re

import pytest

from armlab.session.pages import pages, tab_of
from support.fake_browser import cookie_of
from support.lab import running_lab
from support.own_lessons import ARM, in_lesson, lesson, load, notes, piece, write
from support.student import run, settled, student

NO_PANEL = 'robot = "planar_2r"\nq_deg = [30, 60]\n'
LOOK = '\n## Look\n\nText.\n\n```check\nkind = "looked_at"\npanel = "{}"\n```\n'


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    look = {key: lesson(LOOK.format(key), NO_PANEL) for key in ("joints", "film")}
    stay = lesson(front=NO_PANEL, title="Stay")
    at_bench = lesson("\n## One\n\nSee [5.58](/erratum/5.58).\n", ARM, title="Bench")
    folder = write(tmp_path_factory.mktemp("lessons"), stay=stay, at_bench=at_bench, **look)
    with running_lab(lessons=folder) as address:
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


@pytest.mark.parametrize(
    ("link", "panel"), [("page/laws", "laws"), ("example/laws/triangle", "laws"), ("erratum/5.58", "errata")]
)
def test_a_link_opens_its_page_in_a_window_of_its_own_also_beside_a_lesson_with_a_bench(url, link, panel):
    async def main():
        one = await in_lesson(url, "at_bench")
        await one.open("film")
        load(url, one.cookie, link)
        other = await student(url, one.cookie)
        await settled(other)
        assert notes(other)["tab"] == pages()[tab_of(panel)].title
        await other.until(lambda: panel in turned(other))
        assert notes(one)["tab"] == pages()[tab_of("film")].title
        for each in (one, other):
            await each.close()

    run(main())


def test_what_is_pressed_in_a_window_turns_no_other(url):
    async def main():
        one = await in_lesson(url, "at_bench")
        other = await student(url, one.cookie)
        await other.open("film")
        await one.press("erratum 5.58")
        await one.until(lambda: "errata" in turned(one))
        await settled(other)
        assert notes(other)["tab"] == pages()[tab_of("film")].title
        for each in (one, other):
            await each.close()

    run(main())
