"""Whether what a lesson names is there: rows of the inventory, panels, switches, films, links into the lab."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from armlab.commands._links import leading_nowhere
from armlab.content import rows
from armlab.content.actions import Action, PlayFilm, SetSwitch, TakeExample
from armlab.content.bench_words import BenchWord, is_word
from armlab.content.check import Check
from armlab.content.checks.all_of import AllOf
from armlab.content.checks.fact import FactIs
from armlab.content.checks.looked_at import LookedAt
from armlab.content.lesson import Lesson, Step
from armlab.content.lesson_lines import LessonError
from armlab.errors import InputError, UnknownName, suggestion
from armlab.session.bench import refuse_other_arm, robot_of, with_example
from armlab.session.facts import fact_of, unfit
from armlab.session.pages import pages
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import clips
from armlab.session.state import State
from armlab.session.words import command_of
from armlab.teaching.taught import taught


def of_front(lesson: Lesson) -> Iterator[tuple[str, str]]:
    """Yield what is wrong with the names at the top of a lesson: the key, and the words for it."""
    panels, switches = pages(), _switches()
    yield from (("teaches", rows.unknown(row)) for row in lesson.teaches if not rows.known(row))
    yield from (("panel", text) for text in _unknown("panel", [lesson.panel], panels))
    yield from (("hidden", text) for text in _unknown("panel", lesson.hidden, panels))
    yield from (("introduction", text) for text in leading_nowhere(lesson.intro_html))
    yield from (("overlays", text) for text in _unknown("switch", lesson.overlays, switches))
    wrong = list(_of_example(lesson, lesson.example))
    yield from (("example", text) for text in wrong or _moved_by_example(lesson))
    if lesson.panel and lesson.panel in lesson.hidden:
        yield "hidden", f"the panel {lesson.panel!r} is to be opened, and it is hidden"


def of_step(lesson: Lesson, step: Step) -> Iterator[str]:
    """Yield what is wrong with the names in a step."""
    panels, switches = pages(), _switches()
    yield from (f"start: {text}" for text in _of_example(lesson, step.example))
    yield from (f"start: {text}" for text in _unknown("panel", [step.panel], panels))
    if step.panel and step.panel in lesson.hidden:
        yield f"start: the panel {step.panel!r} is to be opened, and the lesson hides it"
    for action in step.solution:
        yield from (f"solution: {text}" for text in _of_action(lesson, action))
    yield from leading_nowhere(step.texts)
    yield from _of_facts(lesson, step)
    checks = [] if step.check is None else [step.check.check, *(wrong.check for wrong in step.check.wrong)]
    for looked in (found for check in checks for found in _looked_at(check)):
        yield from (f"check: {text}" for text in _unknown("panel", [looked.panel], panels))
        yield from (f"check: {text}" for text in _unknown("switch", [looked.switch], switches))
        yield from (f"check: {text}" for text in _unknown("film", [looked.film], clips()))
        if looked.panel and looked.panel in lesson.hidden:
            yield f"check: the panel {looked.panel!r} is to be opened, and the lesson hides it"


def of_words(lesson: Lesson) -> Iterator[LessonError]:
    """Yield the mistakes in commands of benches at the starts and in the solutions of a lesson, with their lines."""
    steps = [action for step in lesson.steps for action in (*step.begin, *step.solution)]
    for action in (*lesson.begin, *steps):
        if isinstance(action, BenchWord):
            try:
                command_of(action)
            except LessonError as error:
                yield error


def _of_facts(lesson: Lesson, step: Step) -> Iterator[str]:
    """Yield what is wrong with the facts of benches that a step checks or shows."""
    for name in filter(is_word, (*step.live, *lesson.live)):
        try:
            fact_of(name)
        except UnknownName as error:
            yield f"live value: {error}"
    checks = [] if step.check is None else [step.check.check, *(wrong.check for wrong in step.check.wrong)]
    for asked in (found for check in checks for found in _facts(check)):
        try:
            _, fact = fact_of(asked.fact)
        except UnknownName as error:
            yield f"check: {error}"
        else:
            yield from (f"check: {asked.fact}: {text}" for text in unfit(asked, fact))


def _facts(check: Check) -> Iterator[FactIs]:
    if isinstance(check, FactIs):
        yield check
    elif isinstance(check, AllOf):
        for each in check.checks:
            yield from _facts(each)


def _of_action(lesson: Lesson, action: Action) -> Iterator[str]:
    if isinstance(action, SetSwitch):
        yield from _unknown("switch", [action.name], _switches())
    elif isinstance(action, PlayFilm):
        yield from _unknown("film", [action.name], clips())
    elif isinstance(action, TakeExample):
        yield from _of_example(lesson, action.name)
    else:
        for each in taught():
            yield from each.mistakes(action)


def _of_example(lesson: Lesson, name: str) -> Iterator[str]:
    """Yield why an example cannot be put in place."""
    if not name:
        return
    try:
        refuse_other_arm(name, lesson.robot)
    except InputError as error:
        yield str(error)


def _moved_by_example(lesson: Lesson) -> Iterator[str]:
    """Yield why pose or joint values at the top of a lesson are of no use: the example puts the arm elsewhere."""
    begun = State.initial(lesson.robot_used)
    if not lesson.example or not robot_of(lesson.example) or np.array_equal(lesson.start, begun[Joints].q):
        return
    stands = with_example(begun, lesson.example, lesson.robot)[Joints].q
    if not np.allclose(stands, lesson.start, rtol=0.0, atol=1e-9):
        yield f"the example {lesson.example!r} puts the arm elsewhere than the lesson; leave out pose or joint values"


def _looked_at(check: Check) -> Iterator[LookedAt]:
    if isinstance(check, LookedAt):
        yield check
    elif isinstance(check, AllOf):
        for each in check.checks:
            yield from _looked_at(each)


def _unknown(kind: str, names: Iterable[str], known: Iterable[str]) -> Iterator[str]:
    there = list(known)
    return (f"unknown {kind} {name!r}{suggestion(name, there)}" for name in names if name and name not in there)


def _switches() -> Iterable[str]:
    from armlab.ui.plugin import switches

    return [switch.name for switch in switches()]
