""" "Spot the error": point at the wrong part of what is printed, then give the correct form."""

from __future__ import annotations

from functools import partial

from armlab.benches.lessons.errata.commands import Correct, NextTask, PointAt, TryAgain, task_key
from armlab.benches.lessons.errata.state import Choose, Errata
from armlab.benches.lessons.errata.ui.texts import asked_at, headline, task_part, written
from armlab.content.errata import erratum
from armlab.content.errata_task import Place, Task, task_of, with_tasks
from armlab.content.question import Choices
from armlab.session.fields import Set
from armlab.session.state import State
from armlab.teaching.parts.errata_practice import Practice, Tried, is_done
from armlab.ui.asking import Draft, asked, said
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, classes, tag
from armlab.ui.markup import progress_bar, verdict_box

ORDER = 7
"""Variant by whose order the options of a choice are shown: not the right one first."""


class Spotting:
    """The task that is shown, with the parts of an answer that is not handed in yet."""

    def __init__(self, form: Form) -> None:
        self._form = form
        self._draft: tuple[tuple[str, str], Draft] | None = None

    def markup(self, state: State) -> Inside:
        """Return the task with its controls."""
        key, practice = task_key(state), state[Practice]
        task, tried = task_of(key), practice.of(key)
        done = is_done(task, tried)
        return (
            _progress(self._form, key, practice),
            tag("h3", headline(erratum(key)) if done else asked_at(erratum(key))),
            tag("p", "Printed:" if done else "Which part of it is wrong? Press it."),
            _parts(self._form, task, tried),
            _pointed(task, tried),
            self._correction(task, tried) if tried.spotted else None,
            tag("div.er-why", written(erratum(key).why)) if done else None,
            _foot(self._form, key, tried, done),
        )

    def _correction(self, task: Task, tried: Tried) -> Inside:
        known = (task.key, tried.typed)
        if self._draft is None or self._draft[0] != known:
            self._draft = known, Draft(task.question.form, tried.typed, Correct)
        form = task.question.form
        order = form.order(ORDER, task.key) if isinstance(form, Choices) else ()
        verdict = task.question.judge(tried.typed) if tried.typed else None
        note = (
            tag("p.dim", "The correction is a choice of texts: there is no formula to type.") if task.of_texts else None
        )
        return (
            asked(self._form, task.question, tried.typed, self._draft[1], False, order, of=task.key),
            note,
            said(verdict, stays=tried.right),
        )


def _progress(form: Form, key: str, practice: Practice) -> Inside:
    keys, done = with_tasks(), practice.done
    texts = {each: f"{'✓ ' if each in done else ''}{each}" for each in keys}
    return (
        tag("p.er-count.dim", f"{len(done)} of {len(keys)} spotted and put right", role="status"),
        progress_bar(len(done) / len(keys)),
        tag(
            "div.kit-head",
            form.button("task-before", "‹", NextTask(-1), "chip", "The task before", "The task before"),
            form.select("task", "Task", texts, key, Choose),
            form.button("task-after", "›", NextTask(1), "chip", "The next task", "The next task"),
        ),
    )


def _parts(form: Form, task: Task, tried: Tried) -> Markup:
    def part(place: Place, html: str) -> Markup:
        here = place == tried.pointed
        right = here and place not in task.at
        kind = classes("er-part", wrong=place in task.at and bool(tried.spotted), right=right).replace(".", " ")
        cell = f"part {' '.join(map(str, place))}"
        return form.button(cell, task_part(html), PointAt(place), kind, pressed=here)

    rows = [[part(task.place(i, k), html) for k, html in enumerate(each)] for i, each in enumerate(task.parts)]
    if not task.in_rows:
        return tag("div.er-parts", rows, role="group", aria_label="Parts of what is printed")
    columns = max(len(row) for row in rows)
    return tag("div.er-parts.er-rows", rows, role="group", aria_label="Entries", style=f"--columns:{columns}")


def _pointed(task: Task, tried: Tried) -> Markup | None:
    if not tried.pointed:
        return None
    if tried.pointed in task.at:
        return verdict_box("ok", "Here it is wrong.", role="status")
    head = "This part is right as it stands." if not tried.spotted else "This part is right; the other one was wrong."
    return verdict_box("no", head, role="status")


def _foot(form: Form, key: str, tried: Tried, done: bool) -> Markup:
    look = (Choose(key), Set(Errata, "view", "look"))
    anew = form.chip("anew", "Begin anew", TryAgain(), "Delete the answers to this task") if tried != Tried() else None
    on = form.button("task-on", "Next", NextTask(), "main") if done else None
    return tag("div.bar", on, form.chip("look", "Look it up", look, "See what is right, and both forms run"), anew)


def view_chips(form: Form, state: State, views: dict[str, str]) -> Markup:
    """Return the choice between the list and the tasks."""
    return tag(
        "div.er-views", form.chips("view", views, state[Errata].view, "What is shown", partial(Set, Errata, "view"))
    )
