"""The page of the lessons: the list, the index of the notes, broken files, and files that change."""

import asyncio
import re

import pytest

from armlab.content.lessons import add_folder, library
from support.fake_browser import cookie_of
from support.lab import running_lab
from support.own_lessons import in_lesson, lesson, notes, piece, write
from support.student import run, student

TWO = """
## One

First words.

## Two

```question
kind = "number"
text = "How many?"
answer = 2
tolerance = 0.1
```
"""


@pytest.fixture
def taught(tmp_path):
    """A lab that was given a teacher's folder; yields its address and the folder."""
    with running_lab() as address:
        write(tmp_path, mine=lesson(TWO))
        add_folder(tmp_path)
        yield address, tmp_path
    library.cache_clear()


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


def test_a_bench_the_lesson_hides_is_not_offered_from_the_index(tmp_path):
    front = 'robot = "planar_2r"\nhidden = ["ellipsoid"]\n'
    with running_lab(lessons=write(tmp_path, hiding=lesson(front=front))) as url:

        async def main():
            browser = await in_lesson(url, "hiding")
            await browser.open("lessons")
            await browser.press("query", "ellipsoid")
            await browser.until(lambda: 'class="found"' in browser.html() or "Nothing is found." in browser.html())
            assert 'data-cell="bench:ellipsoid"' not in browser.html()
            await browser.close()

        run(main())


# -- files that change -------------------------------------------------------------------------------------------


def test_an_edited_file_is_shown_again_and_progress_is_kept(taught):
    url, folder = taught

    async def main():
        browser = await in_lesson(url, "mine", cookie_of(url))
        await browser.press("lesson-step-1")
        await browser.until(lambda: "lesson-answer" in browser.html())
        await browser.press("lesson-answer", "2")
        await browser.until(lambda: "✓ Right." in browser.html())
        await browser.press("lesson-step-0")
        await browser.until(lambda: "First words." in browser.html())
        write(folder, mine=lesson(TWO.replace("First words.", "Other words.") + "\n## Three\n\nMore.\n"))
        await browser.until(lambda: "Other words." in browser.html(), 4.0)
        assert "<small>1 of 3</small>" in browser.html()
        await browser.until(lambda: browser.html().count('class="strip done"') == 2)
        await browser.close()

    run(main())


def test_a_question_that_becomes_another_kind_is_asked_anew(taught):
    url, folder = taught
    grid = TWO.replace('"number"', '"matrix"').replace("answer = 2", "answer = [[1, 2]]")

    async def main():
        browser = await in_lesson(url, "mine")
        await browser.press("lesson-step-1")
        await browser.until(lambda: "lesson-answer" in browser.html())
        write(folder, mine=lesson(grid))
        await browser.until(lambda: 'class="entries"' in browser.html(), 4.0)
        await browser.press("lesson-entry-0-0", "1")
        await browser.press("lesson-entry-0-1", "2")
        await browser.press("lesson-check")
        await browser.until(lambda: "✓ Right." in browser.html())
        await browser.close()

    run(main())


def test_a_broken_edit_keeps_the_last_good_lesson_and_is_listed(taught):
    url, folder = taught

    async def main():
        browser = await in_lesson(url, "mine")
        write(folder, mine=lesson(TWO).replace('kind = "number"', 'kind = "<b>nunber"'))
        await browser.open("lessons")
        await browser.until(lambda: "mine.md" in piece(browser, "broken lesson file"), 4.0)
        listed = piece(browser, "broken lesson file")
        assert "&lt;b&gt;nunber" in listed
        assert "<b>nunber" not in listed
        assert 'data-cell="lesson:mine"' in listed  # the last good one is still there
        await browser.press("lesson-step-1")
        await browser.until(lambda: "lesson-answer" in browser.html())
        write(folder, mine=lesson(TWO))
        await browser.until(lambda: "mine.md" not in browser.html(), 4.0)
        await browser.close()

    run(main())


def test_a_new_file_is_in_the_list_of_an_open_page(taught):
    url, folder = taught

    async def main():
        browser = await in_lesson(url, "mine")
        await browser.open("lessons")
        await browser.until(lambda: 'data-cell="lesson:mine"' in browser.html())
        write(folder, another=lesson(title="Another one"))
        await asyncio.sleep(2.5)
        await browser.open("joints")
        await browser.open("lessons")
        await browser.until(lambda: "Another one" in piece(browser, 'data-cell="lesson:mine"'))
        await browser.close()

    run(main())


def test_a_lesson_whose_file_is_taken_away_can_be_gone_on_with(taught):
    url, folder = taught

    async def main():
        browser = await in_lesson(url, "mine")
        (folder / "mine.md").unlink()
        await asyncio.sleep(2.0)
        await browser.press("lesson-step-1")
        await browser.until(lambda: "lesson-answer" in browser.html())
        await browser.press("lesson-answer", "2")
        await browser.until(lambda: "✓ Lesson done" in browser.html())
        assert '<option value="mine" selected>' in piece(browser, "lesson-head")
        await browser.close()

    run(main())
