"""The page Errata as it is shown: the list, the card of one, and the tasks to spot the error."""

import asyncio
import re
import threading

import pytest

from armlab.benches.lessons.errata.job import run_at_once
from armlab.benches.lessons.errata.state import Choose, Errata, RunAgain
from armlab.benches.lessons.errata.ui.card import card, where
from armlab.benches.lessons.errata.ui.dots import dots
from armlab.benches.lessons.errata.ui.listed import entries, filters
from armlab.benches.lessons.errata.ui.practice import Spotting
from armlab.benches.lessons.errata.ui.texts import residual
from armlab.content.errata import SEVERITIES, errata
from armlab.content.errata_task import task_of, with_tasks
from armlab.content.robots import catalogue
from armlab.session.fields import Set
from armlab.session.state import State, apply
from armlab.teaching.lesson_commands import GoToStep, OpenLesson
from armlab.teaching.parts.errata_practice import Practice
from support.bare_gui import BarePage, content
from support.forms import BareForm, asked
from support.student import run


@pytest.fixture
def state():
    return State.initial(catalogue()["puma560"])


@pytest.fixture
def page():
    return BarePage("errata", catalogue()["puma560"])


def text_of(page):
    return " ".join(content(fields) for fields in page._gui.has if fields.html.visible)


def press(page, cell, text=""):
    fields = next(fields for fields in page._gui.has if f'data-cell="{cell}"' in content(fields))
    page.send(fields, cell, text)


def chosen(state, key):
    return run_at_once(apply(state, Choose(key)))


# -- to look up --------------------------------------------------------------------------------------------------


def test_the_list_holds_all_with_their_letters_and_one_way_in_for_the_keyboard(state):
    form = BareForm()
    form.show(entries(form, state))
    shown = str(form.fields.content)
    assert "118 of 118 errata" in shown
    assert shown.count('class="er-entry"') == len(errata()) == 118
    assert shown.count('tabindex="0"') == 1
    assert all(shown.count(f"<i>{letter}</i>") > 0 for letter in SEVERITIES)


def test_an_entry_is_chosen_and_filters_are_set(state):
    assert asked(lambda form: entries(form, state), "erratum 4.94") == (Choose("4.94"),)
    assert asked(lambda form: filters(form, state), "severity", "H") == (Set(Errata, "severity", "H"),)
    assert asked(lambda form: filters(form, state), "query", "5.58") == (Set(Errata, "query", "5.58"),)


def test_the_list_says_when_nothing_is_found(state):
    form = BareForm()
    form.show(entries(form, apply(state, Set(Errata, "query", "no such words"))))
    assert "Nothing is found." in str(form.fields.content)


def test_the_card_shows_both_forms_each_with_its_residual(state):
    form, seen = BareForm(), chosen(state, "5.58")
    form.show(card(form, seen))
    shown, found = str(form.fields.content), seen[Errata].run
    wrong, right = shown.split("er-form er-right")
    assert "✕ Printed" in wrong
    assert residual(found.worst_printed, found.trial.unit) in wrong
    assert "✓ Correct" in right
    assert residual(found.worst_correct, found.trial.unit) in right
    assert "wrong at 20 of 20" in shown
    assert asked(lambda form: card(form, seen), "again") == (RunAgain(),)


def test_where_the_error_is_not_seen_the_card_says_so(state):
    seen = run_at_once(apply(chosen(state, "6.95"), Set(Errata, "quiet", True)))
    form = BareForm()
    form.show(card(form, seen))
    assert "not seen" in str(form.fields.content)
    assert "wrong at" not in str(form.fields.content)


def test_the_card_of_one_that_is_not_run_says_why(state):
    each = next(each for each in errata().values() if each.unrun)
    form = BareForm()
    form.show(card(form, chosen(state, each.id)))
    assert f"Not run. {each.unrun}" in str(form.fields.content).replace("&#39;", "'")
    assert 'data-cell="again"' not in str(form.fields.content)


def test_a_lesson_that_names_it_is_opened_at_the_step(state):
    form, opened = BareForm(), []
    form.show(where(form, errata()["5.58"], opened.append))
    cell = next(cell for cell in re.findall(r'data-cell="(lesson [^"]*)"', str(form.fields.content)))
    form.press(cell)
    first, second = form.commands
    assert isinstance(first, OpenLesson)
    assert first.key == cell.removeprefix("lesson ")
    assert isinstance(second, GoToStep)
    page = next(cell for cell in re.findall(r'data-cell="(page [^"]*)"', str(form.fields.content)))
    form.press(page)
    assert opened == [page.removeprefix("page ")]


@pytest.mark.parametrize(
    ("value", "unit", "said"),
    [
        (0.0, "rad", "0"),
        (0.25, "rad", "0.25 rad"),
        (3e-16, "m", "3.0·10⁻¹⁶ m"),
        (2.0, "", "2"),
        (float("inf"), "m", "no value"),
    ],
)
def test_a_residual_is_said_with_its_unit(value, unit, said):
    assert residual(value, unit) == said


# -- spot the error ----------------------------------------------------------------------------------------------


def test_what_is_sent_too_late_for_a_task_is_told_without_a_word_of_lessons(page):
    press(page, "view practise")
    press(page, "task", "5.58")
    task = task_of("5.58")
    press(page, f"part {' '.join(map(str, min(task.at)))}")
    fields = next(fields for fields in page._gui.has if 'data-cell="task-after"' in content(fields))
    before = re.search(r'data-of="([^"]*)"', content(fields))[1]
    page.send(fields, "task-after")
    page.send(fields, "lesson-answer", "x", before)
    assert "not taken" in page.session.notice.text
    assert "lesson" not in page.session.notice.text


def test_a_task_is_spotted_then_put_right(page):
    press(page, "view practise")
    press(page, "task", "5.58")
    task = task_of("5.58")
    right = next(place for place in task.places if place not in task.at)
    assert "lesson-answer" not in text_of(page)
    press(page, f"part {' '.join(map(str, right))}")
    assert "This part is right as it stands." in text_of(page)
    press(page, f"part {' '.join(map(str, min(task.at)))}")
    assert "Here it is wrong." in text_of(page)
    assert "5.58" not in page.session.state[Practice].done
    press(page, "lesson-answer", task.question.right_answer)
    assert "✓" in text_of(page)
    assert "5.58" in page.session.state[Practice].done


def test_all_tasks_can_be_gone_through(state):
    for key in with_tasks():
        seen = apply(apply(state, Choose(key)), Set(Errata, "view", "practise"))
        form = BareForm()
        form.show(Spotting(form).markup(seen))
        shown = str(form.fields.content)
        assert shown.count('data-cell="part ') == sum(len(row) for row in task_of(key).parts), key
        assert "Here it is wrong" not in shown
        assert "row" not in shown.partition("</h3>")[0].partition("<h3>")[2], key


def test_what_has_no_value_is_marked_as_such_in_the_picture(state):
    found = chosen(state, "5.113")[Errata].run
    shown = str(dots(found, found.trial))
    assert "no value" in shown
    assert shown.count('class="er-none"') == len(found.printed)
    other = chosen(state, "5.58")[Errata].run
    assert "no value" not in str(dots(other, other.trial))


@pytest.mark.parametrize(("cell", "says"), [("errata-html", "<p>residuo</p>"), ("errata-markdown", "residual")])
def test_the_list_is_saved_in_the_language_of_who_asks_and_made_once_for_all(monkeypatch, cell, says):
    threads, written = [], {"html": "<p>residual</p>", "markdown": "residual"}

    def sheet(key):
        threads.append(threading.current_thread())
        return written[key]

    monkeypatch.setattr("armlab.benches.lessons.errata.ui.page.sheet", sheet)

    async def main():
        page, saved = BarePage("errata", catalogue()["puma560"]), []
        page._gui.language = "it"
        page._gui.save = lambda name, content: saved.append(content)
        for _ in range(4):
            press(page, cell)
        while len(saved) < 4:
            await asyncio.sleep(0.01)
        return saved

    assert run(main()) == [says] * 4
    assert len(set(threads)) == 1
