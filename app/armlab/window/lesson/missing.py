"""The steps that an assignment still lacks, which are named before it is handed in."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from armlab.content.lesson import Lesson, Step
from armlab.teaching.lesson_places import where_in
from armlab.teaching.lesson_progress import Progress, step_names
from armlab.ui.html import Inside, Markup, tag
from armlab.window.lesson.assigned import Sheet


def still_missing(sheet: Sheet, where: str, sent: Mapping[str, str]) -> Inside:
    """Return the steps without an answer that can be read and, unless in an exam, the others that are not done.

    Parameters
    ----------
    sheet : Sheet
    where : str
        The place of the progress in the open task.
    sent : mapping of str to str
        By step, answers to it that have been sent.
    """

    def answers(i: int) -> Mapping[str, str]:
        given = sheet.progress(i).answers
        return {**given, **sent} if where_in(sheet.of.key, sheet.place(i)) == where else given

    unanswered = _by_task(sheet, lambda i: _without_answer(sheet.lesson(i), answers(i)))
    kept = "What is typed or chosen there counts only when it is kept with the button at the question."
    asked = (tag("p", "Without an answer:"), tag("ul", unanswered), tag("p.dim", kept)) if unanswered else None
    if sheet.of.exam:
        return asked, _of_checks(sheet)
    undone = _by_task(sheet, lambda i: _not_done(sheet.lesson(i), sheet.progress(i), answers(i)))
    return asked, (tag("p", "Not done yet:"), tag("ul", undone)) if undone else None


def _of_checks(sheet: Sheet) -> Markup | None:
    """Return that an exam tells nothing of what is to be done with the arm; None where there is nothing to be done."""
    if all(step.check is None for i in range(len(sheet.of.tasks)) for step in sheet.lesson(i).steps):
        return None
    return tag("p.dim", "In an exam only missing answers are named, not what is still to be done with the arm.")


def _by_task(sheet: Sheet, missing: Callable[[int], list[int]]) -> list[Markup]:
    """Return a line for each task of which steps are missing."""
    return [_task(i, steps) for i in range(len(sheet.of.tasks)) if (steps := missing(i))]


def _without_answer(lesson: Lesson, answers: Mapping[str, str]) -> list[int]:
    """Return the steps, from 1, whose question has no answer."""
    named = enumerate(zip(step_names(lesson), lesson.steps, strict=True), start=1)
    return [i for i, (name, step) in named if not _is_answered(step, answers.get(name, ""))]


def _is_answered(step: Step, typed: str) -> bool:
    """Return whether a step asks for nothing, or has what counts as an answer."""
    return step.question is None or (bool(typed) and step.question.judge(typed).counts)


def _not_done(lesson: Lesson, progress: Progress, answers: Mapping[str, str]) -> list[int]:
    """Return the steps, from 1, with something to do that is not done, other than those without an answer."""
    passed, missing = progress.passed(lesson), []
    for i, (name, step) in enumerate(zip(step_names(lesson), lesson.steps, strict=True)):
        typed = answers.get(name, "")
        done = i in passed or (step.check is None and (step.question is None or step.question.judge(typed).right))
        if not done and _is_answered(step, typed):
            missing.append(i + 1)
    return missing


def _task(i: int, steps: list[int]) -> Markup:
    word = "step" if len(steps) == 1 else "steps"
    return tag("li", f"Task {i + 1}, {word} ", tag("b", ", ".join(map(str, steps))))
