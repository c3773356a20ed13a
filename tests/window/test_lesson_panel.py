"""The page of the lessons: the map, and the way to the search."""

import re

from armlab.content.lessons import lessons
from support.own_lessons import piece
from support.student import run, student


async def at_lessons(url):
    browser = await student(url)
    await browser.open("lessons")
    await browser.until(lambda: 'data-cell="lesson:first_arm"' in browser.html())
    return browser


def test_lessons_stand_by_chapter_with_their_arm_and_how_far_one_is(url):
    async def main():
        browser = await at_lessons(url)
        found = piece(browser, 'data-cell="lesson:first_arm"')
        chapters = re.findall(r"<details[^>]*>", found)
        titles = [re.search('data-fold="([^"]*)"', chapter)[1] for chapter in chapters]
        assert titles == [chapter.title for chapter in lessons().course().chapters]
        assert [" open" in chapter for chapter in chapters] == [True] + [False] * (len(chapters) - 1)
        assert "Planar 2R, 4 steps" in found
        await browser.press("lesson:first_arm")
        await browser.until(lambda: "lesson-foot" in browser.html())
        await browser.press("stretched")
        await browser.until(lambda: "✓ Done" in browser.html())
        await browser.open("lessons")
        await browser.until(lambda: "<i>1 of 4</i>" in piece(browser, 'data-cell="lesson:first_arm"'))
        await browser.close()

    run(main())


def test_the_search_is_a_button_above_the_chapters(url):
    async def main():
        browser = await at_lessons(url)
        assert "data-search" in piece(browser, "Find: 3.66")
        await browser.close()

    run(main())
