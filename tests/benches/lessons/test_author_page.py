"""The page for teachers: what is loaded is shown as text, what is none is told at the button, and the key counts."""

import re

import pytest

from armlab.benches.lessons.author.ui.asked import MOST
from armlab.content.guesses import TRIES
from armlab.content.lesson_file import parse_lesson
from support.fake_browser import cookie_of
from support.lab import running_lab
from support.own_lessons import HOSTILE, HOSTILE_ARM, PWN, lesson
from support.student import run, student

KEY = "the key of this teacher"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("mine")


@pytest.fixture(scope="module")
def url(folder):
    with running_lab(lessons=folder, key=KEY) as address:
        yield address


async def at_the_page(url, cookie=None):
    browser = await student(url, cookie or cookie_of(url))
    await browser.open("author")
    await browser.until(lambda: "load-file" in browser.html())
    return browser


def refusal(browser):
    said = re.search('role="alert">([^<]*)', browser.html())
    return said[1] if said else ""


def test_a_loaded_lesson_is_text_nobody_elses_and_there_again(url, folder):
    async def main():
        cookie = cookie_of(url)
        browser = await at_the_page(url, cookie)
        await browser.press("load-file", f"bad.md\n{PWN}")
        await browser.until(lambda: "bad.md, line 1: expected a first line +++" in refusal(browser))
        await browser.press("load-file", f"evil.md\n{lesson(HOSTILE, HOSTILE_ARM, f'Title {PWN}')}")
        await browser.until(lambda: "Title &lt;script&gt;" in browser.html())
        await browser.press("preview evil.md")
        await browser.until(lambda: "Introduction &lt;script&gt;" in browser.html())
        assert "As a student sees it" in browser.html()
        assert "<script" not in browser.html()
        assert "<img" not in browser.html()
        await browser.press("preview-end")
        await browser.until(lambda: "lesson-head" not in browser.html())
        await browser.close()
        again, other = await at_the_page(url, cookie), await at_the_page(url)
        await again.until(lambda: "evil.md" in again.html())
        assert "evil.md" not in other.html()
        assert 'data-cell="give ' not in again.html()
        assert list(folder.iterdir()) == []
        await again.close()
        await other.close()

    run(main())


def test_questions_are_written_on_the_page_and_saved_with_the_lesson(url):
    async def main():
        browser = await student(url, cookie_of(url))
        await browser.open("newton_1d")
        await browser.open("author")
        await browser.until(lambda: "load-file" in browser.html())
        await browser.press("ask-add")
        await browser.until(lambda: "expected a text that says what is asked" in refusal(browser))
        await browser.press("ask-text", "How far is $p_x$?")
        await browser.press("ask-answer", "many")
        await browser.until(lambda: "answer: expected a number, got" in refusal(browser))
        for cell, text in (("ask-answer", "1/4"), ("ask-tolerance", "-0.01"), ("ask-unit", "m"), ("ask-add", "")):
            await browser.press(cell, text)
        await browser.until(lambda: "largest difference: expected a positive number, got -0.01" in refusal(browser))
        await browser.press("ask-tolerance", "0.01")
        await browser.press("ask-add")
        await browser.until(lambda: "0.25 ± 0.01 m" in browser.html())
        await browser.press("save-lesson")
        await browser.until(lambda: bool(browser.downloads.get("my_lesson.md")))
        saved = parse_lesson("my_lesson", browser.downloads["my_lesson.md"].decode())
        assert saved.panel == "newton_1d"
        step = saved.steps[1]
        assert step.question.judge("25 cm").right
        assert not step.question.judge("0.3").right
        for cell in (*("ask-text", "ask-answer", "ask-tolerance", "ask-add") * MOST,):
            await browser.press(cell, "1")
        await browser.until(lambda: f"expected at most {MOST} questions" in refusal(browser))
        await browser.press("ask-remove 0")
        await browser.until(lambda: "0.25 ± 0.01 m" not in browser.html())
        await browser.close()

    run(main())


def test_a_question_is_not_added_with_another_answer_than_its_field_shows(url):
    async def main():
        browser = await at_the_page(url)
        for cell, text in (("ask-text", "How far?"), ("ask-answer", "0.25"), ("ask-tolerance", "0.01")):
            await browser.press(cell, text)
        await browser.press("ask-answer", "half a metre")
        await browser.press("ask-add")
        await browser.until(lambda: "answer: expected a number, got" in refusal(browser))
        assert "half a metre" in browser.html()
        assert 'data-cell="ask-remove 0"' not in browser.html()
        await browser.press("ask-answer", "0.5")
        await browser.press("ask-add")
        await browser.until(lambda: "0.5 ± 0.01" in browser.html())
        await browser.close()

    run(main())


def test_the_teacher_does_not_wait_for_those_who_guess(url):
    async def main():
        guesser, teacher = await at_the_page(url), await at_the_page(url)
        for k in range(TRIES + 2):
            await guesser.press("teacher-key", f"wrong key {k}")
        await guesser.until(lambda: "Too many wrong keys were tried" in refusal(guesser))
        await teacher.press("teacher-key", KEY)
        await teacher.until(lambda: 'data-cell="teacher-key"' not in teacher.html())
        await guesser.close()
        await teacher.close()

    run(main())


def test_only_with_the_key_something_is_put_there_for_everybody(url, folder):
    async def main():
        browser = await at_the_page(url)
        await browser.press("load-file", f"mine.md\n{lesson()}")
        await browser.until(lambda: 'data-cell="forget mine.md"' in browser.html())
        await browser.press("teacher-key", "a wrong key")
        await browser.until(lambda: "This is not the key of the teacher." in browser.html())
        assert 'data-cell="give mine.md"' not in browser.html()
        await browser.press("teacher-key", KEY)
        await browser.until(lambda: 'data-cell="give mine.md"' in browser.html())
        assert KEY not in browser.html()
        await browser.press("give mine.md")
        await browser.until(lambda: "mine.md is there for everybody." in browser.html())
        assert f'data-copy="{url}lesson/mine"' in browser.html()
        assert [path.name for path in folder.iterdir()] == ["mine.md"]
        await browser.press("load-file", 'hw.toml\ntitle = "H"\npages = ["jionts"]\n[[tasks]]\nlesson = "first_arm"\n')
        await browser.press("give hw.toml")
        await browser.until(lambda: "unknown page &#39;jionts&#39;; did you mean &#39;joints&#39;" in browser.html())
        assert [path.name for path in folder.iterdir()] == ["mine.md"]
        await browser.close()

    run(main())
