"""Continuation of saved work: begun at one computer, finished at another."""

from __future__ import annotations

import logging
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import ClassVar

from armlab.content.assignment import said_date
from armlab.content.lessons import lessons
from armlab.errors import InputError
from armlab.session.parts.display import Display
from armlab.session.share import STAYS, personal, state_of_parts
from armlab.session.state import Command, Json, State
from armlab.teaching.assignment_commands import OpenAssignment, refuse_before
from armlab.teaching.assignment_rules import refuse_in_assignment
from armlab.teaching.assignment_work import Work
from armlab.teaching.hand_in import LONGEST_KEY, judged_anew, loaded, opened
from armlab.teaching.hand_in_assignment import claimed_in, refuse_another
from armlab.teaching.handed import Handed, handed_of
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.lesson_places import place_of, where_in
from armlab.teaching.lesson_progress import Progress
from armlab.teaching.parts.former import Former
from armlab.teaching.parts.lesson import LessonPart, has_its_arm
from armlab.teaching.parts.preview import Preview
from armlab.teaching.parts.shelf import HOME, Shelf, at_home
from armlab.teaching.signature import signed

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class OpenWork(Command):
    """Open work that was saved, at its step and with the arm as it stood, as far as it can be used.

    Its answers and checks are judged anew, and only what holds is done; a motion is not planned again here, which takes
    too long, but when it is handed in. Steps already done here stay done.

    Parameters
    ----------
    text : str
        Text of a file written by `hand_in`.
    """

    text: str
    label: ClassVar[str] = "saved work"

    def apply(self, state: State) -> State:
        """Return the state with the work.

        Raises
        ------
        InputError
            It is no saved work, or the student is not at home, or in a preview, which forgets what is opened in it.
        UnknownName, ContentError
            Its lesson is not there or cannot be used.
        """
        if state[Shelf].place != HOME or state[Preview].before is not None:
            raise InputError("saved work: go back to your own work first")
        refuse_in_assignment(state[LessonPart])
        data = loaded(self.text)
        if "assignment" in data and "lesson" not in data:
            return _with_assignment(state, data)
        data, found, claimed = opened(self.text)
        holds, _ = judged_anew(found, claimed, plans=False)
        part, place = state[LessonPart], place_of(found.key, found.variant)
        here = part.progress_of.get(place, Progress())
        known = {**part.progress_of, place: _together(here, holds)}
        ready = replace(
            part, open="", progress_of=MappingProxyType(known), student=part.student or signed(data["student"])
        )
        begun = OpenLesson(found.key, variant=found.variant).apply(state.replace(ready))
        begun = begun.replace(Former.of(at_home(state)))  # of the lesson that is open until now, too
        return _as_it_stood(begun, data.get("parts"))


def _with_assignment(state: State, data: Json) -> State:
    """Return the state with an assignment as it was handed in elsewhere; what is done here stays done.

    Work that is in progress here stays so, and takes in what the file holds.
    """
    found, part = lessons().assignment(str(data["assignment"])[:LONGEST_KEY]), state[LessonPart]
    refuse_another(found, data)
    if found.exam:
        raise InputError("Work on an exam goes on only in the browser in which it was begun.")
    refuse_before(found, state.at)
    handed, here = handed_of(found, data), part.works.get(found.key)
    if here is not None:
        _refuse_mixed(here, handed)
    known = dict(part.progress_of)
    for lesson, claimed in claimed_in(found, data):
        holds, _ = judged_anew(lesson, claimed, plans=False)
        where = where_in(found.key, place_of(lesson.key, lesson.variant))
        known[where] = _together(known.get(where, Progress()), holds)
    # A time that is over does not come back by what a file claims.
    begun = min(handed.begun, state.at, *([] if here is None else [here.begun]))
    # What is answered here now was not in the file when that was handed in.
    when = None if here is not None and here.handed is None else handed.handed
    by_clock = when is not None and handed.by_clock
    work = Work(data["variant"], begun, when, handed.attempt, handed.left, by_clock)
    student, works = part.student or signed(data["student"]), MappingProxyType({**part.works, found.key: work})
    ready = replace(part, progress_of=MappingProxyType(known), student=student, works=works)
    return OpenAssignment(found.key).apply(state.replace(ready))


def _refuse_mixed(here: Work, handed: Handed) -> None:
    """Raise `InputError` where what is done here came later than a file, and would get its date."""
    if here.attempts > handed.attempt:
        raise InputError(f"Attempt {here.attempts} has been handed in here; this file holds attempt {handed.attempt}.")
    if here.handed is None and 0 < handed.of.attempts <= handed.attempt:
        raise InputError("You are working on this here, and no attempt is left after the one in this file.")
    if here.handed is not None and round(here.handed, 1) > handed.handed:  # as it is rounded in files
        raise InputError(f"Work has been handed in here on {said_date(here.handed)}; this file is older.")


def _together(here: Progress, there: Progress) -> Progress:
    """Return the progress from both places, at the step of the file; of two answers the one given here."""
    hints = {name: max(here.hints.get(name, 0), there.hints.get(name, 0)) for name in {*here.hints, *there.hints}}
    return replace(
        there,
        met=here.met | there.met,
        right=MappingProxyType({**there.right, **here.right}),
        answers=MappingProxyType({**there.answers, **here.answers}),
        hints=MappingProxyType(hints),
        evidence=MappingProxyType({**there.evidence, **here.evidence}),
    )


def _as_it_stood(begun: State, parts: Json) -> State:
    """Return the lesson with arm and benches as in the file, or as the step begins when these are not usable."""
    if not isinstance(parts, dict) or not parts or begun[LessonPart].hides:
        return begun
    try:
        stood = state_of_parts({key: part for key, part in parts.items() if key not in STAYS})
    except Exception as error:
        # Nobody can list what a changed file may raise, and the lesson goes on without it.
        log.warning("the arm of saved work is not usable: %r", error)
        return begun
    display = Display(MappingProxyType({**stood[Display].switches, **begun[Display].of_screen()}))
    found = stood.replace(*personal(begun), display)
    return found if has_its_arm(found) else begun
