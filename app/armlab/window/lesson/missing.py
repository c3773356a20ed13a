"""The steps of an assignment that have no answer, which are named before it is handed in."""

from __future__ import annotations

from collections.abc import Mapping

from armlab.content.lesson import Lesson
from armlab.teaching.lesson_places import where_in
from armlab.teaching.lesson_progress import step_names
from armlab.ui.html import Inside, Markup, tag
from armlab.window.lesson.assigned import Sheet


def without_answer(sheet: Sheet, where: str, sent: Mapping[str, str]) -> Inside:
    """Return the steps that ask something and have no answer that can be read; nothing where there are none.

    Parameters
    ----------
    sheet : Sheet
    where : str
        The place of the progress in the open task.
    sent : mapping of str to str
        By step, answers to it that have been sent.
    """
    found = []
    for i in range(len(sheet.of.tasks)):
        lesson, answers = sheet.lesson(i), sheet.progress(i).answers
        if where_in(sheet.of.key, sheet.place(i)) == where:
            answers = {**answers, **sent}
        if missing := _missing(lesson, answers):
            found.append(_task(i, missing))
    if not found:
        return None
    kept = "What is typed or chosen there counts only when it is kept with the button at the question."
    return tag("p", "Without an answer:"), tag("ul", found), tag("p.dim", kept)


def _missing(lesson: Lesson, answers: Mapping[str, str]) -> list[int]:
    """Return the steps, from 1, whose question has no answer."""
    missing = []
    for i, (name, step) in enumerate(zip(step_names(lesson), lesson.steps, strict=True), start=1):
        typed = answers.get(name, "")
        if step.question is not None and (not typed or step.question.judge(typed).name == "unreadable"):
            missing.append(i)
    return missing


def _task(i: int, steps: list[int]) -> Markup:
    word = "step" if len(steps) == 1 else "steps"
    return tag("li", f"Task {i + 1}, {word} ", tag("b", ", ".join(map(str, steps))))
