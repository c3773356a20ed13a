"""Files of lessons that change, break, come and go while a student has them open."""

import asyncio
import re

import pytest

from armlab.content.lessons import changed
from support.lab import running_lab
from support.own_lessons import in_lesson, lesson, piece, write
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
    with running_lab(lessons=write(tmp_path, mine=lesson(TWO))) as address:
        yield address, tmp_path


def test_a_change_that_another_lab_of_the_process_saw_first_is_shown_too(taught):
    url, folder = taught

    async def main():
        browser = await in_lesson(url, "mine")
        write(folder, mine=lesson(TWO.replace("First words.", "Other words.")))
        assert changed() == {"mine"}
        await browser.until(lambda: "Other words." in browser.html())
        await browser.close()

    run(main())


def test_an_edited_file_is_shown_again_and_progress_is_kept(taught):
    url, folder = taught

    async def main():
        browser = await in_lesson(url, "mine")
        await browser.press("lesson-step-1")
        await browser.until(lambda: "lesson-answer" in browser.html())
        await browser.press("lesson-answer", "2")
        await browser.until(lambda: "✓ Right." in browser.html())
        await browser.press("lesson-step-0")
        await browser.until(lambda: "First words." in browser.html())
        write(folder, mine=lesson(TWO.replace("First words.", "Other words.") + "\n## Three\n\nMore.\n"))
        await browser.until(lambda: "Other words." in browser.html())
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
        await browser.until(lambda: 'class="entries"' in browser.html())
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
        await browser.until(lambda: "mine.md" in piece(browser, "mistake in lesson files"))
        listed = piece(browser, "mistake in lesson files")
        assert "&lt;b&gt;nunber" in listed
        assert "<b>nunber" not in listed
        assert 'data-cell="lesson:mine"' in listed  # the last good one is still there
        await browser.press("lesson-step-1")
        await browser.until(lambda: "lesson-answer" in browser.html())
        write(folder, mine=lesson(TWO))
        await browser.until(lambda: "mine.md" not in browser.html())
        await browser.close()

    run(main())


def test_a_new_file_is_in_the_list_of_an_open_page(taught):
    url, folder = taught

    async def main():
        browser = await in_lesson(url, "mine")
        await browser.open("lessons")
        await browser.until(lambda: 'data-cell="lesson:mine"' in browser.html())
        write(folder, another=lesson(title="Another one"))
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
        assert re.search('<option [^>]*value="mine"[^>]* selected', piece(browser, "lesson-head"))
        await browser.close()

    run(main())


def test_a_lesson_that_is_saved_begins_with_the_benches_as_they_stand(tmp_path):
    async def main(url):
        browser = await student(url)
        await browser.open("loop")
        await browser.press("l-gain", "25")
        await browser.until(lambda: "25 rad/s" in browser.html())
        await browser.open("author")
        await browser.press("save-lesson")
        await browser.until(lambda: any(browser.downloads.values()))
        (text,) = browser.downloads.values()
        assert b'command = "control.loop.set"' in text
        await browser.until(lambda: "What my_lesson.md says" in browser.html())
        assert "control.loop.set" in browser.html()
        assert b"25.0" in text
        await browser.close()

    with running_lab(tmp_path) as url:
        run(main(url))
