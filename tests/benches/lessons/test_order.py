"""The course in order on the page for teachers: a lesson that is loaded for oneself may stand in it."""

import json
import re
from dataclasses import dataclass

import pytest

from armlab.benches.lessons.own_commands import LoadFile
from armlab.content.as_written import AsWritten, as_part
from armlab.content.desk import Desk, open_desk
from armlab.content.lessons import changed, lessons
from armlab.content.upload import read_upload
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command
from armlab.teaching.parts.own_lessons import OwnLessons
from armlab.teaching.parts.teacher import LetIn
from armlab.ui.speech import speech_in
from support.filled import Filled
from support.small_lessons import TWO_STEPS, library_fixture

own = pytest.fixture(library_fixture, name="own")

MINE = TWO_STEPS.replace('title = "T"', 'title = "My own"\nafter = ["v"]')
COURSE = 'title = "C"\n[[chapters]]\ntitle = "One"\nlessons = ["mine", "v"]\n'


def page_with(*files):
    page = Filled("author")
    page.do(*(LoadFile(read_upload(f"{name}\n{text}")) for name, text in files))
    return page


def order(page):
    return page.state[OwnLessons].course.lessons


def test_a_lesson_loaded_for_oneself_stands_in_the_own_course(own):
    page = page_with(("mine.md", MINE), ("course.toml", COURSE))
    assert "the lesson 'mine' stands before 'v', which it needs" in page.text
    page.fill("down mine")
    assert order(page) == ("v", "mine")
    assert "mistake" not in page.text
    assert "So far only you see mine.md." in page.text
    page.fill("out mine")
    assert "So far only you" not in page.text
    page.fill("order-in", "mine")
    assert order(page) == ("v", "mine")
    assert "My own" in page.text
    page.fill("forget mine.md")
    assert "unknown lesson 'mine'" in page.text


def test_the_titles_of_an_own_course_are_not_translated(own):
    text = COURSE.replace('"One"', '"Motion"').replace('"mine", ', "")
    page = page_with(("mine.md", MINE.replace("My own", "Homework")), ("course.toml", text))
    page.fill("order-in", "mine")
    page.do(Restored())
    said = speech_in("it").markup(page.markup)
    assert '<h4 class="al-order-title" translate="no">Motion</h4>' in said
    assert as_part(AsWritten("Homework")) in re.findall(r'title="Sposta “([^"]*)” in su"', said)


def test_the_titles_of_the_course_of_the_lab_are_translated_while_it_is_put_in_order():
    page = page_with()
    page.fill("order-begin")
    page.do(Restored())
    assert ">Un primo braccio</h4>" in speech_in("it").markup(page.markup)


@dataclass(frozen=True)
class Restored(Command):
    """Save what is loaded, and take it up again."""

    def apply(self, state):
        data = json.loads(json.dumps(state[OwnLessons].to_json()))
        return state.replace(OwnLessons.from_json(data, state[RobotPart].robot))


def test_of_two_lessons_with_one_name_that_of_the_lab_stands_in_the_course(own):
    page = page_with(("v.md", MINE.replace('"v"', '"t"')), ("course.toml", COURSE.replace('"mine", ', '"t", ')))
    assert "So far only you" not in page.text
    assert "My own" not in page.text.partition("Order of the course")[2]


def test_an_assignment_is_there_for_everybody_once_its_lessons_are_and_has_an_address(own, tmp_path):
    close = open_desk(Desk(tmp_path / "mine", "the key of this teacher"))
    try:
        page = page_with(("mine.md", MINE), ("hw.toml", 'title = "H"\n[[tasks]]\nlesson = "mine"\n'))
        page.do(LetIn())
        page.fill("give hw.toml")
        assert "hw.toml: only you see mine.md so far; put it there for everybody first" in page.text
        page.fill("give mine.md")
        assert "http://127.0.0.1:8080/lesson/mine" in page.text
        changed()
        page.fill("give hw.toml")
        assert "hw.toml is there for everybody." in page.text
        assert "http://127.0.0.1:8080/assignment/hw" in page.text
    finally:
        close()


def test_the_course_is_there_for_everybody_once_its_lessons_are(own, tmp_path):
    close = open_desk(Desk(tmp_path / "mine", "the key of this teacher"))
    try:
        page = page_with(("mine.md", MINE), ("course.toml", COURSE.replace('"mine", "v"', '"v", "mine"')))
        page.do(LetIn())
        page.fill("order-give")
        assert "course.toml: only you see mine.md so far; put it there for everybody first" in page.text
        page.fill("give mine.md")
        page.fill("order-give")
        assert "course.toml: only you see" in page.text  # the folder is looked at once a second
        changed()
        page.do()
        page.fill("order-give")
        assert "course.toml is there for everybody." in page.text
    finally:
        close()
    changed()
    assert (lessons().course().title, lessons().problems) == ("C", ())
