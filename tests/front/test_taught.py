"""Lessons of a teacher's folder: variants by their numbers, and files that change while they are open."""

import re
import urllib.request

import pytest

from armlab.content.lessons import library
from armlab.content.robots import catalogue
from armlab.session.state import State, apply
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.parts.shelf import BackToLesson, Shelf, ToSandbox
from armlab.window.wished import wished
from support.fake_browser import cookie_of
from support.lab import running_lab
from support.student import run, student

LESSON = """+++
title = "Of a teacher"
chapter = "1"
teaches = ["S4.0-2R"]
robot = "planar_2r"
[variants]
l = {{ from = 1, to = 500, step = 1 }}
+++
## One
{text} It is {{{{=l}}}} long.
## Two
Second step.
"""


@pytest.fixture
def taught(tmp_path):
    """A lab with a teacher's folder of one lesson; yields its address and the file."""
    file = tmp_path / "of_a_teacher.md"
    file.write_text(LESSON.format(text="First words."))
    with running_lab(lessons=tmp_path) as url:
        yield url, file


def test_a_lesson_with_variants_is_reloaded_and_changed_by_its_number(taught):
    del taught
    third = apply(State.initial(catalogue()["puma560"]), OpenLesson("of_a_teacher", variant=3))
    assert wished(third, "lesson/of_a_teacher") is None
    assert wished(third, "lesson/of_a_teacher/3") is None
    assert wished(third, "lesson/of_a_teacher/4") == OpenLesson("of_a_teacher", variant=4)
    aside = apply(third, ToSandbox())
    assert aside[Shelf].waiting == "of_a_teacher/3"
    assert wished(aside, "lesson/of_a_teacher/3") == BackToLesson()
    assert wished(aside, "lesson/of_a_teacher/4") == OpenLesson("of_a_teacher", variant=4)


def test_a_link_names_a_variant_and_a_changed_file_is_shown_again(taught):
    url, file = taught

    async def main():
        cookie = cookie_of(url)
        path = "lesson/of_a_teacher/7"
        urllib.request.urlopen(urllib.request.Request(url + path, headers={"Cookie": cookie})).close()
        browser = await student(url, cookie, f"/{path}")
        await browser.until(lambda: "First words." in browser.html())
        value = f"{library().lesson('of_a_teacher', 7).values['l']:g}"
        assert f"It is {value} long" in plain(browser)
        file.write_text(LESSON.format(text="Better words."))
        await browser.until(lambda: "Better words." in browser.html())
        assert f"It is {value} long" in plain(browser)
        assert "First words." not in browser.html()
        await browser.close()

    with running_lab():  # another one in this process must not take the news away
        run(main())


def plain(browser):
    """Return the text of the page, without the markup of its numbers."""
    return re.sub(r"<[^>]+>", "", browser.html())
