"""An answer, a choice or a hint belongs to the step whose page asked for it, whatever another tab shows meanwhile."""

import html
import json
import re
import time
from types import SimpleNamespace

import pytest

from armlab.content.robots import catalogue
from armlab.errors import Outdated
from armlab.session.session import Session
from armlab.session.state import State, apply
from armlab.teaching.lesson_commands import Answer, CloseLesson, GoToStep, OpenLesson, UnlockHint
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.shown_step import MOVED_ON, shown_step
from armlab.ui.speech import speech_in
from armlab.window.lesson.page import LessonPage
from support.bare_gui import BareGui, content
from support.lab import running_lab
from support.own_lessons import QUESTIONS, in_lesson, lesson, piece, to_step, write
from support.student import run, settled, student

PLANAR = catalogue()["planar_2r"]
NUMBER, CHOICE = 2, 3
"""Steps of the first lesson, from 0, that ask for a number and for one of several options."""


def progress(state):
    return state[LessonPart].progress


@pytest.mark.parametrize("command", [Answer, lambda text, of: UnlockHint(of)])
def test_what_is_asked_of_another_step_is_refused(command):
    state = apply(apply(State.initial(PLANAR), OpenLesson("first_arm")), GoToStep(NUMBER))
    here = command("0.5", shown_step(state[LessonPart]))
    assert apply(state, here) is not state
    for elsewhere in (GoToStep(CHOICE), CloseLesson(), OpenLesson("joint_types")):
        with pytest.raises(Outdated, match="This page has moved on"):
            apply(apply(state, elsewhere), here)


class Dock:
    """The dock of one tab, which shows the session when it is told to."""

    def __init__(self, session):
        self.session, self.gui = session, BareGui()
        self.page = LessonPage(self.gui, lambda command: session.apply(command, 0.0))
        self.page.show(session.state)

    def press(self, cell, text=""):
        fields = next(each for each in self.gui.has if f'data-cell="{cell}"' in content(each))
        fields.channel.value = fields.channel._impl.value = json.dumps([cell, text, 1])
        for heard in fields.channel.heard:
            with pytest.raises(StopIteration):
                heard(SimpleNamespace(client=self)).send(None)


def test_what_is_sent_before_a_tab_shows_the_next_step_counts_nowhere():
    session = Session.fresh("one", PLANAR)
    for command in (OpenLesson("first_arm"), GoToStep(CHOICE)):
        session.apply(command, 0.0)
    dock = Dock(session)
    session.apply(GoToStep(NUMBER), 0.0)  # in another tab
    for cell in ("lesson-choice-2", "lesson-hint"):
        dock.press(cell)
        assert session.notice.text == MOVED_ON
        assert (dict(progress(session.state).answers), dict(progress(session.state).hints)) == ({}, {})
        session.notice = None
    dock.page.show(session.state)
    dock.press("lesson-answer", "0.5")
    assert list(progress(session.state).answers.values()) == ["0.5"]
    assert session.notice is None


def test_what_was_sent_too_late_does_not_pass_for_an_answer():
    session = Session.fresh("one", PLANAR)
    for command in (OpenLesson("first_arm"), GoToStep(NUMBER)):
        session.apply(command, 0.0)
    dock = Dock(session)
    session.apply(GoToStep(CHOICE), 0.0)
    dock.press("lesson-answer", "0.5")
    dock.page.show(session.state)
    assert [draft.whole for _, _, draft in dock.page._drafts.values()] == ["", ""]


def test_the_sentence_is_said_in_italian_too():
    assert speech_in("it").text(MOVED_ON).startswith("Questa pagina è andata avanti")


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    folder = write(tmp_path_factory.mktemp("lessons"), questions=lesson(QUESTIONS))
    with running_lab(lessons=folder) as address:
        yield address


def asked(browser):
    """Return what a page notes of its question."""
    return html.unescape(re.search(r'class="ask" data-of="([^"]*)"', piece(browser, 'class="ask"'))[1])


async def sent(browser, cell, of):
    """Press what a page still shows as part of a question."""
    value = json.dumps([cell, "", time.perf_counter_ns(), of])
    await browser.send({"type": "GuiUpdateMessage", "uuid": browser.channel(cell), "updates": {"value": value}})


def test_what_is_on_its_way_when_a_tab_is_shown_the_next_step_counts_nowhere(url):
    async def main():
        one = await in_lesson(url, "questions")
        other = await student(url, one.cookie)
        before = asked(one)
        await to_step(other, 2)
        await one.until(lambda: "<small>2 of " in one.html() and asked(one) != before)
        await sent(one, "lesson-choice-2", before)
        await one.until(lambda: MOVED_ON in one.notices)
        await settled(one)
        assert 'aria-pressed="true"' not in piece(one, 'class="ask"')
        await sent(one, "lesson-choice-2", asked(one))
        await one.until(lambda: 'aria-pressed="true"' in piece(one, 'class="ask"'))
        for each in (one, other):
            await each.close()

    run(main())
