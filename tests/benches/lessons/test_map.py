"""The map of the course: what it says of each lesson, what can be pressed, and that it follows files and progress."""

import asyncio
import re

import pytest

from armlab.benches.lessons.index.ui.map import SIGNS, Map
from armlab.benches.lessons.index.ui.page import _told
from armlab.content.course import Chapter, Course
from armlab.content.languages import ENGLISH
from armlab.content.lessons import lessons
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.way import Standing, Way
from armlab.ui import picks
from support.forms import BareForm
from support.lab import running_lab
from support.own_lessons import PWN, in_lesson, lesson, piece, write
from support.student import run, student

CHAPTERS = (Chapter("First", "About it.", ("first_arm", "joint_types")), Chapter("Then", "", ("forward_2r", "ik_2r")))
NEEDS = {"first_arm": (), "joint_types": (), "forward_2r": ("first_arm",), "ik_2r": ("forward_2r", "joint_types")}


def made(here="", others=(), language=ENGLISH, **standings):
    """Return the map's form, and the markup of its head and its chapters."""
    way = Way(Course("x", "X", "", CHAPTERS), here, standings, NEEDS)
    form = BareForm()
    drawn = Map(form, way, lessons().lessons, language)
    form.show(drawn.now(), drawn.markup(CHAPTERS, others))
    return form, form.fields.content


def row(markup, key):
    """Return the row of a lesson."""
    return re.search(rf'<button[^>]*data-cell="lesson:{key}".*?</button>', markup, re.DOTALL)[0]


def signs(markup):
    return {key: re.search(r"<u[^>]*>(.)</u>", row(markup, key))[1] for key in NEEDS}


def test_a_lesson_that_is_not_translated_is_marked_in_another_language_only():
    others = (Chapter("More", "", ("harmonic_drive",)),)
    markup = made(others=others, language="it")[1]
    assert "<small>in English</small>" in row(markup, "harmonic_drive")
    assert 'title="Planar 2R, 5 steps · in English"' in row(markup, "harmonic_drive"), "for screen readers"
    assert "in English" not in row(markup, "first_arm")
    assert "in English" not in made(others=others)[1]


def test_a_newcomer_sees_what_comes_next_and_what_needs_others_first():
    form, markup = made()
    assert signs(markup) == {
        "first_arm": SIGNS["next"],
        "joint_types": SIGNS["open"],
        "forward_2r": SIGNS["early"],
        "ik_2r": SIGNS["early"],
    }
    assert "first: The planar arm, Joints that turn or slide" in row(markup, "ik_2r")
    assert "first: Your first arm" in row(markup, "forward_2r")
    assert "first:" not in row(markup, "joint_types")
    assert "12 min" in row(markup, "first_arm")
    assert markup.count('<details class="kit-fold lm" open data-fold="First">') == 1
    assert 'data-fold="Then"' in markup
    assert "2 lessons, 27 min" in markup
    form.press("lesson-begin")
    assert form.commands == (OpenLesson("first_arm"),)


@pytest.mark.parametrize(
    ("chapter", "done", "told"),
    [
        (("first_arm",), (), "1 lesson, 12 min"),
        (("first_arm",), ("first_arm",), "1 of 1 lesson done"),
        (("first_arm", "joint_types"), ("first_arm",), "1 of 2 lessons done, 15 min left"),
    ],
)
def test_the_head_counts_lessons(chapter, done, told):
    way = Way(Course("x", "X", "", (Chapter("All", "", chapter),)), "", dict.fromkeys(done, Standing(3, 3)), NEEDS)
    assert _told(way, lessons()) == told


def test_what_is_marked_early_can_be_opened_all_the_same():
    form, _ = made()
    form.press("lesson:ik_2r")
    assert form.commands == (OpenLesson("ik_2r"),)


def test_progress_is_shown_by_signs_words_and_counts():
    _, markup = made(first_arm=Standing(3, 3), joint_types=Standing(2, 5))
    assert signs(markup) == {
        "first_arm": SIGNS["done"],
        "joint_types": SIGNS["next"],
        "forward_2r": SIGNS["open"],
        "ik_2r": SIGNS["early"],
    }
    assert "1 of 2, 27 min" in markup
    assert "2 of 5" in row(markup, "joint_types")
    assert 'aria-label="Your first arm, done, 12 min"' in row(markup, "first_arm")
    assert "Go on: Joints that turn or slide" in markup
    _, markup = made(first_arm=Standing(3, 3), joint_types=Standing(5, 5), ik_2r=Standing(1, 6))
    assert signs(markup)["ik_2r"] == SIGNS["begun"]
    assert markup.count('class="lm-begun"') == 1


def test_where_one_is_comes_before_what_is_next_and_the_next_waits_for_its_end():
    form, markup = made("first_arm", first_arm=Standing(1, 3))
    assert signs(markup)["first_arm"] == SIGNS["here"]
    assert 'aria-current="true"' in row(markup, "first_arm")
    assert "1 of 3 steps done" in markup
    assert markup.index("Open now") < markup.index("<small>Next</small>")
    assert "lesson-begin" not in markup
    form, markup = made("first_arm", first_arm=Standing(3, 3))
    assert signs(markup)["first_arm"] == SIGNS["done"]
    assert 'aria-current="true"' in row(markup, "first_arm")
    form.press("lesson-begin")
    assert form.commands == (OpenLesson("joint_types"),)


def test_the_end_of_the_course_has_nothing_next():
    _, markup = made(**{key: Standing(1, 1) for key in NEEDS})
    assert set(signs(markup).values()) == {SIGNS["done"]}
    assert "lm-now" not in markup


def test_lessons_of_no_course_stand_at_the_end_under_their_chapters():
    _, markup = made(others=(Chapter("7 Control", "", ("velocity_loop",)),))
    assert markup.index("More lessons") < markup.index("7 Control") < markup.index('data-cell="lesson:velocity_loop"')
    assert markup.index('data-cell="lesson:ik_2r"') < markup.index("More lessons")
    assert '<details class="kit-fold lm" open data-fold="7 Control">' in markup


# --- In the page

COURSE = """title = "{title}"
[[chapters]]
title = "Mine {title}"
about = "{title}"
lessons = ["own", "first_arm"]
"""


@pytest.fixture
def taught(tmp_path):
    """A lab with a teacher's folder that has a course; yields its address and the folder."""
    (tmp_path / "course.toml").write_text(COURSE.format(title="My course"), encoding="utf-8")
    front = f'minutes = 7\ncan = ["Do it {PWN}."]\nafter = []\nrobot = "planar_2r"\n'
    folder = write(tmp_path, own=lesson(front=front, title="Own one"), loose=lesson(title="Loose one"))
    with running_lab(lessons=folder) as address:
        yield address, folder


def test_an_own_course_is_shown_the_labs_can_be_chosen_and_changes_are_seen(taught):
    url, folder = taught

    async def main():
        browser = await student(url)
        await browser.open("lessons")
        await browser.until(lambda: "Mine My course" in browser.html())
        shown = piece(browser, "Mine My course")
        assert shown.index("lesson:own") < shown.index("lesson:first_arm") < shown.index("lesson:loose")
        assert "lesson:joint_types" not in shown
        assert 'data-cell="start-own"' in browser.html(), "the card of the first visit follows the course"
        assert '<a class="chip" href="/course/' in browser.html()
        await browser.press("course", "lab")
        await browser.until(lambda: "lesson:joint_types" in browser.html())
        assert "lesson:own" not in browser.html()
        assert "lesson:loose" in browser.html()
        await browser.press("course", next(iter(lessons().courses)).key)
        (folder / "course.toml").write_text(COURSE.format(title="Better"), encoding="utf-8")
        await browser.until(lambda: "Mine Better" in browser.html())
        (folder / "course.toml").write_text(COURSE.format(title="Worse").replace("own", "onw"), encoding="utf-8")
        await browser.until(lambda: "unknown lesson" in browser.html())
        assert "Mine Better" in browser.html()
        await browser.close()

    run(main())


def test_the_end_of_a_lesson_says_what_one_can_do_now_and_leads_to_the_next(taught):
    url, _ = taught

    async def main():
        browser = await in_lesson(url, "own")
        await browser.until(lambda: "lesson-onward" in browser.html())
        end = piece(browser, "lesson-onward")
        assert "You can now" in end
        assert "Do it &lt;script&gt;" in end
        assert "<script" not in end
        assert "Next lesson: <b>Your first arm</b>, 12 min" in end
        await browser.press("lesson-onward")
        await browser.until(lambda: "<small>1 of 4" in browser.html())
        await browser.open("lessons")
        await browser.until(lambda: "1 of 2 lessons done" in browser.html())
        await browser.press("lesson-step-3")
        await browser.until(lambda: "4 to do" in browser.html())
        assert "lesson-onward" not in browser.html(), "there is none after it"
        assert "You can now" not in browser.html()
        await browser.close()

    run(main())


def test_the_page_says_that_lessons_are_being_read_and_shows_them_when_they_are(taught, monkeypatch):
    url, folder = taught

    async def main():
        browser = await student(url)
        with monkeypatch.context() as unread:
            unread.setattr(picks, "lessons_read", lambda: None)
            opening = asyncio.create_task(browser.open("lessons"))
            await browser.until(lambda: picks.READING in browser.html())
            assert "Mine My course" not in browser.html()
        write(folder, late=lesson(title="Late one"))
        await opening
        await browser.until(lambda: "Late one" in browser.html())
        assert picks.READING not in browser.html()
        await browser.close()

    run(main())
