"""The open lesson, the student's progress in all lessons, and the changes that an open lesson refuses."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import ClassVar, Self

import numpy as np

from armlab.content.assignment import Assignment
from armlab.content.check import PLAIN, Words
from armlab.content.lesson import Lesson, Step
from armlab.content.lessons import lessons
from armlab.content.observation import BEYOND, Observation, same_table
from armlab.content.question import Verdict
from armlab.content.robots import OWN, Robot
from armlab.errors import InputError
from armlab.session.facts import benches_of, evidence_of, facts_asked, seen_facts
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.panels import Panels
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Json, Part, PartType, State
from armlab.teaching.assignment_work import Work, is_open
from armlab.teaching.closed_pages import closed_pages
from armlab.teaching.lesson_films import films_played
from armlab.teaching.lesson_locks import freed, refuse_locked
from armlab.teaching.lesson_places import is_place, kept_at, where_in
from armlab.teaching.lesson_progress import Progress, read, step_names, written
from armlab.teaching.signature import signed
from armlab.teaching.taught import taught

VARIANTS = 1000
"""Number of variants of lessons that are assigned to students: 0 to 999."""

MOST_ASIDE = 200
"""Largest number of lessons that are not there in which progress is kept."""


@dataclass(frozen=True)
class LessonPart(Part):
    """The open lesson, and the progress in every lesson that was ever opened.

    An undo of a motion takes back no answer; the lesson also stays open when another arm is chosen by hand.

    Attributes
    ----------
    open : str
        Key of the open lesson, with ``/VARIANT`` behind it when it has variants; empty when none is open.
    progress_of : mapping of str to Progress
        Progress by such a key, behind ``ASSIGNMENT:`` where it is work on an assignment.
    number : int
        Variant of lessons that a student gets who asks for none.
    student : str
        The name with which the student signs the work.
    set_up : int
        Number of times that a lesson has put its own arm on the table; not saved.
    loaded : int
        Changes when the file of the open lesson has changed; not saved.
    course : str
        Key of the course that is shown; empty for the first.
    assignment : str
        Key of the open assignment, to which the open lesson then belongs; empty for none.
    works : mapping of str to Work
        The work on each assignment that was ever begun.
    aside : mapping of str to Json
        By place, the progress as it was saved in lessons that were not there when it was read: it waits for them.
    """

    key: ClassVar[str] = "lesson"
    called: ClassVar[str] = "your progress in lessons"
    kept_by_undo: ClassVar[bool] = True
    looks_at_undo: ClassVar[bool] = True

    open: str = ""
    progress_of: Mapping[str, Progress] = field(default_factory=lambda: MappingProxyType({}))
    number: int = 0
    student: str = ""
    set_up: int = 0
    loaded: int = 0
    course: str = ""
    assignment: str = ""
    works: Mapping[str, Work] = field(default_factory=lambda: MappingProxyType({}))
    aside: Mapping[str, Json] = field(default_factory=lambda: MappingProxyType({}))

    @property
    def assigned(self) -> Assignment | None:
        """The open assignment, or None."""
        return lessons().assignment(self.assignment) if self.assignment else None

    @property
    def work(self) -> Work | None:
        """The work on the open assignment, or None."""
        return self.works.get(self.assignment)

    @property
    def rests(self) -> bool:
        """Whether the work on the open assignment has been handed in, and nothing of it can be changed."""
        return self.work is not None and self.work.handed is not None

    @property
    def silent(self) -> bool:
        """Whether nothing is said of answers and checks, as in an exam until it is handed in."""
        found = self.assigned
        return found is not None and found.exam and not self.rests

    @property
    def where(self) -> str:
        """Key of the progress in the open lesson."""
        return where_in(self.assignment, self.open)

    @property
    def lesson(self) -> Lesson | None:
        """The open lesson, or None."""
        return kept_at(self.open) if self.open else None

    @property
    def progress(self) -> Progress:
        """The progress in the open lesson."""
        return self.progress_of.get(self.where, Progress())

    @property
    def index(self) -> int:
        """Number of the shown step, from 0."""
        found = self.lesson
        return 0 if found is None else self.progress.shown(found)

    @property
    def name(self) -> str:
        """Name of the shown step; empty when no lesson is open."""
        found = self.lesson
        return "" if found is None else step_names(found)[self.index]

    @property
    def step(self) -> Step | None:
        """The shown step, or None."""
        found = self.lesson
        return None if found is None else found.steps[self.progress.shown(found)]

    @property
    def bench(self) -> str:
        """The panel that the lesson opens at the shown step or the last one before it that names a panel."""
        found = self.lesson
        if found is None:
            return ""
        return next((step.panel for step in found.steps[self.index :: -1] if step.panel), found.panel)

    @property
    def hidden(self) -> frozenset[str]:
        """Keys of the panels that the open lesson hides, or its assignment, as their files say now."""
        found, assigned = self.lesson, self.assigned
        if found is None:
            return frozenset()
        closed = frozenset() if assigned is None else closed_pages(found, assigned)
        return frozenset(found.hidden) | closed

    @property
    def verdict(self) -> Verdict | None:
        """Verdict on the last answer to the question of the shown step; None before an answer."""
        step, typed = self.step, self.progress.answers.get(self.name)
        return None if step is None or step.question is None or typed is None else step.question.judge(typed)

    @property
    def asked(self) -> frozenset[str]:
        """Keys of the benches, such as ``"motion"``, of which the shown step needs what they tell."""
        found, step = self.lesson, self.step
        if found is None or step is None:
            return frozenset()
        return frozenset(each.key for each in taught() if each.is_asked(found, step, self._settled))

    @property
    def facts(self) -> tuple[str, ...]:
        """Words of the facts of benches that the shown step needs."""
        found, step = self.lesson, self.step
        return () if found is None or step is None else facts_asked(found, step, self._settled)

    @property
    def _settled(self) -> bool:
        """Whether the check of the shown step has been met for good: in an exam what stands last counts."""
        return self.name in self.progress.met and not self.silent

    @property
    def hides(self) -> tuple[str, ...]:
        """Parts of the screen that the question of the shown step hides until it is answered."""
        step = self.step
        if step is None or step.question is None or self.name in self.progress.answers:
            return ()
        return step.question.hide

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the part with no lesson open."""
        return cls()

    def begun(self, token: str) -> Self:
        """Return the part with the variant of lessons that is the student's own."""
        number = int.from_bytes(hashlib.sha256(token.encode()).digest()[:4], "big") % VARIANTS
        return replace(self, number=number)

    def for_robot(self, robot: Robot) -> Self:
        """Return the part unchanged."""
        return self

    @property
    def opened(self) -> str:
        """Key of the open lesson."""
        return self.open

    def refuse_forgetting(self) -> None:
        """Raise `InputError` while an assignment is worked on, of which everything would be lost."""
        if self.assigned is not None and not self.rests:
            raise InputError(f"{is_open(self.assigned)} Leave it before everything is forgotten.")

    def guard(self, before: State, now: State) -> None:
        """Refuse a change that the open lesson has locked."""
        found, after = self.lesson, now[LessonPart]
        if found is not None and after.open == self.open and after.set_up == self.set_up:
            try:
                refuse_locked(found, before, now)
            except InputError as error:
                own = "" if self.assignment else " In your own sandbox you can change everything."
                raise InputError(f"{error}{own}") from None

    def for_undo(self, found: State) -> State:
        """Return a state that undo has found with the joints free that a lesson held; refuse one from before this."""
        was = found[LessonPart]
        same = (was.open, was.assignment) == (self.open, self.assignment)
        if self.open and not same:  # the step stays in the history, for when the lesson is closed
            raise InputError(f"Undo ends where this {'task' if self.assignment else 'lesson'} began.")
        return found if same else freed(found, was.lesson)

    def after(self, before: State, now: State) -> Self:
        """Return the part with events noted: start of a step, clips watched, an answer, a check that is met."""
        found, step, assigned, work = self.lesson, self.step, self.assigned, self.work
        if found is None or step is None or self.rests:
            return self
        if assigned is not None and work is not None and work.over(assigned, now.at):
            return self.with_work(work.at(assigned, now.at))
        progress = self.progress
        watched = replace(
            progress,
            since=now.at if progress.since is None else progress.since,
            films=films_played(progress.films, before, now),
            tried=progress.tried or self._tried(before, now),
        )
        name = self.name
        if name in watched.right and name not in before[LessonPart].progress.right:
            answer = replace(watched.right[name], seconds=watched.seconds(now.at))
            watched = replace(watched, right=MappingProxyType({**watched.right, name: answer}))
        again = self.silent and watched.tried and step.check is not None and not step.check.noted
        if (name not in watched.met or again) and (step.check is None or has_its_arm(now)):
            watched = _judged(watched, name, step, now.replace(self.with_progress(watched)))
        return self if watched == progress else self.with_progress(watched)

    def _tried(self, before: State, now: State) -> bool:
        """Return whether a person has changed anything a check may use while this step was shown."""
        was = before[LessonPart]
        if (was.open, was.set_up, was.progress.step) != (self.open, self.set_up, self.progress.step):
            return False
        of_benches = (part for found in benches_of(self.facts) for part in found.parts)
        looked_at = (Joints, Target, RobotPart, Timeline, *of_benches)
        changed = any(now[kind] is not before[kind] for kind in looked_at)
        return changed or self._switched(before, now) or any(each.changed(before, now) for each in taught())

    def _switched(self, before: State, now: State) -> bool:
        """Return whether a switch that the check looks at is another way; a browser may have changed others itself."""
        was, switches, step = before[Display].switches, now[Display].switches, self.step
        asked = () if step is None or step.check is None else step.check.switches
        return any(was.get(name) != switches.get(name) for name in asked)

    def with_progress(self, progress: Progress) -> Self:
        """Return the part with another progress in the open lesson, which then is the one last worked on."""
        others = {where: each for where, each in self.progress_of.items() if where != self.where}
        return replace(self, progress_of=MappingProxyType({**others, self.where: progress}))

    def taken_up(self) -> Self:
        """Return the part with the saved progress in the open lesson, if that was not there when it was read."""
        found = self.lesson
        if found is None or self.where not in self.aside:
            return self
        others = {where: each for where, each in self.aside.items() if where != self.where}
        part = replace(self, aside=MappingProxyType(others))
        return part.with_progress(read(found, self.aside[self.where])) if self.where not in self.progress_of else part

    def with_work(self, work: Work) -> Self:
        """Return the part with other work on the open assignment."""
        return replace(self, works=MappingProxyType({**self.works, self.assignment: work}))

    def to_json(self) -> Json:
        """Return place, progress and number as JSON."""
        progress = {**self.aside, **{place: written(each) for place, each in self.progress_of.items()}}
        shown: dict[str, Json] = {"course": self.course} if self.course else {}
        if self.works:
            shown |= {"assignment": self.assignment, "works": {key: each.to_json() for key, each in self.works.items()}}
        return {"open": self.open, "progress": progress, "number": self.number, "student": self.student, **shown}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return the part from JSON; steps that no longer exist are left out, lessons that are not there wait."""
        saved = [(where, where.rpartition(":")[2], each) for where, each in data["progress"].items()]
        progress = {where: read(kept_at(place), each) for where, place, each in saved if is_place(place)}
        aside = dict([(where, each) for where, place, each in saved if not is_place(place)][-MOST_ASIDE:])
        number = int(data.get("number", 0))
        if number < 0:
            raise InputError(f"number: expected 0 or more, got {number}")
        opened = data["open"] if is_place(data["open"]) else ""
        works = {key: Work.from_json(each) for key, each in data.get("works", {}).items()}
        assignment = str(data.get("assignment", ""))
        if assignment and (assignment not in works or not lessons().has_assignment(assignment)):
            opened = assignment = ""  # its file has been taken away
        assignment = assignment if opened else ""
        student, course = signed(str(data.get("student", ""))), str(data.get("course", ""))
        return cls(
            opened,
            MappingProxyType(progress),
            number,
            student,
            course=course,
            assignment=assignment,
            works=MappingProxyType(works),
            aside=MappingProxyType(aside),
        )


PART = PartType(LessonPart, order=95)


def has_its_arm(state: State) -> bool:
    """Return whether the lesson's arm is there, or edited where the step, or any if it has no check, asks for that."""
    part, robot = state[LessonPart], state[RobotPart]
    found, step = part.lesson, part.step
    if found is None or step is None:
        return False
    judged = found.steps if step.check is None else (step,)
    if robot.own and any(each.check is not None and each.check.of_table for each in judged):
        return robot.origin == ("" if found.robot == OWN else found.robot)
    if not robot.own:
        return robot.robot.key == found.robot
    arm, own = robot.robot.arm, found.robot_used.arm
    return arm.task == own.task and same_table(arm, own) and bool(np.all(np.abs(arm.limits - own.limits) <= BEYOND))


def observed(state: State) -> Observation:
    """Return the observation for the check of the shown step."""
    part = state[LessonPart]
    joints, progress, asked = state[Joints], part.progress, part.asked
    return Observation(
        arm=joints.arm,
        q=joints.q,
        tool_pose=np.asarray(joints.tool_pose, dtype=np.float64),
        target=state[Target].pose,
        seconds=progress.seconds(state.at),
        switches=frozenset(name for name, on in state[Display].switches.items() if on),
        panel=_panel_seen(state),
        films=progress.films,
        facts=seen_facts(state, part.facts),
        benches={each.key: each.seen(state, each.clip in progress.films) for each in taught() if each.key in asked},
    )


def _panel_seen(state: State) -> str:
    """Return the panel that the check of the shown step asks for when it is open; otherwise the one last opened."""
    part = state[LessonPart]
    opened, step = state[Panels].open(part.hidden), part.step
    asked = () if step is None or step.check is None else step.check.panels
    return next((panel for panel in (*asked, *opened) if panel in opened), "")


def check_line(state: State, words: Words = PLAIN) -> tuple[bool, str]:
    """Return whether the check of the shown step has been met, and what is missing (HTML).

    The text is empty when the step has no check or the arm is not the lesson's.
    """
    part = state[LessonPart]
    step, met = part.step, part.name in part.progress.met
    if step is None or step.check is None or met or not has_its_arm(state):
        return met, ""
    return met, step.check.judge(observed(state), words)[1]


def _judged(progress: Progress, name: str, step: Step, now: State) -> Progress:
    if step.check is None:
        return replace(progress, met=progress.met | {name})
    seen = observed(now)
    if not step.check.check.is_met(seen):
        if name not in progress.met:
            return progress
        left = {key: each for key, each in progress.evidence.items() if key != name}
        return replace(progress, met=progress.met - {name}, evidence=MappingProxyType(left))
    # Results of the work on a bench are judged again from that work.
    work = {each.part.key: now[each.part].to_json() for each in taught() if each.key in seen.benches}
    facts = {"facts": evidence_of(now, step.check.facts)} if step.check.facts else {}
    evidence = MappingProxyType({**progress.evidence, name: {**seen.to_json(), **work, **facts}})
    return replace(progress, met=progress.met | {name}, evidence=evidence)
