"""The page of the lessons: the list, and the index of the notes."""

import re

import pytest

from support.own_lessons import notes, piece
from support.student import run, student


async def at_lessons(url):
    browser = await student(url)
    await browser.open("lessons")
    await browser.until(lambda: 'data-cell="lesson:first_arm"' in browser.html())
    return browser


# -- the list and the index --------------------------------------------------------------------------------------


def test_lessons_stand_by_chapter_with_their_arm_and_how_far_one_is(url):
    async def main():
        browser = await at_lessons(url)
        found = piece(browser, 'data-cell="lesson:first_arm"')
        assert "<h3>1 Introduction</h3>" in found
        assert "Planar 2R, 3 steps" in found
        await browser.press("lesson:first_arm")
        await browser.until(lambda: "lesson-foot" in browser.html())
        await browser.press("stretched")
        await browser.until(lambda: "✓ Done" in browser.html())
        await browser.open("lessons")
        await browser.until(lambda: "<i>1 of 3</i>" in piece(browser, 'data-cell="lesson:first_arm"'))
        await browser.close()

    run(main())


def test_an_equation_finds_its_topic_and_functions_to_copy(url):
    async def main():
        browser = await at_lessons(url)
        field = piece(browser, 'class="find"')
        assert 'data-live="1"' in field
        await browser.press("query", "3.66")
        await browser.until(lambda: 'class="found"' in browser.html())
        found = piece(browser, 'class="found"')
        assert "<i>topic</i>" in found
        assert "Axis and angle from a rotation matrix" in found
        line = re.search(r'data-copy="(from armlab\.kin[\w.]* import \w+)"', found)
        assert line is not None
        exec(line[1], {})
        assert piece(browser, 'class="find"') == field  # the field is not touched while one types
        await browser.press("query", "  ")
        await browser.until(lambda: 'data-cell="lesson:first_arm"' in browser.html())
        await browser.close()

    run(main())


def test_a_bench_and_a_lesson_are_opened_from_what_is_found(url):
    async def main():
        browser = await at_lessons(url)
        await browser.press("query", "ellipsoid")
        await browser.until(lambda: 'data-cell="bench:ellipsoid"' in browser.html())
        before = notes(browser)["asked"]
        await browser.press("bench:ellipsoid")
        await browser.until(lambda: notes(browser)["asked"] != before)
        await browser.open("lessons")
        await browser.press("query", "Where is the hand")
        await browser.until(lambda: 'data-cell="lesson:first_arm"' in piece(browser, 'class="pick"'))
        await browser.press("lesson:first_arm")
        await browser.until(lambda: "<small>1 of 3</small>" in browser.html())
        await browser.close()

    run(main())


@pytest.mark.parametrize("query", ["zzzzzz", "<script>1</script>", "\ud800", "(" * 5000, "9" * 5000])
def test_what_is_not_there_is_said(url, query):
    async def main():
        browser = await at_lessons(url)
        await browser.press("query", query)
        await browser.until(lambda: "Nothing is found." in browser.html() or 'class="found"' in browser.html())
        assert "<script" not in browser.html()
        await browser.press("query", "")
        await browser.until(lambda: 'data-cell="lesson:first_arm"' in browser.html())
        await browser.close()

    run(main())
