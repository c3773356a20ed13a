"""Which lesson is open, and how far the student has come in each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import ClassVar, Self

import numpy as np

from armlab.content.check import PLAIN, Words
from armlab.content.lessons import Lesson, Step, lessons
from armlab.content.observation import Observation
from armlab.content.questions import Verdict
from armlab.content.robots import Robot, catalogue
from armlab.errors import InputError
from armlab.kin.ik.target import feasible
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Json, Part, PartType, State

MOST_TYPED = 200
"""Characters of an answer that are kept."""


@dataclass(frozen=True)
class Progress:
    """How far a student has come in one lesson; steps count from 0.

    Attributes
    ----------
    step : int
        The step that is shown.
    met : frozenset of int
        Steps whose check was met once, or that have been shown and have none.
    right : frozenset of int
        Steps whose question was answered rightly once.
    answers : mapping of int to str
        What was typed last at each question.
    """

    step: int = 0
    met: frozenset[int] = frozenset()
    right: frozenset[int] = frozenset()
    answers: Mapping[int, str] = field(default_factory=lambda: MappingProxyType({}))

    def passed(self, lesson: Lesson) -> frozenset[int]:
        """Return the steps of which everything is done; what was done once stays done."""
        done = {i for i, step in enumerate(lesson.steps) if step.question is None} | self.right
        return self.met & done


@dataclass(frozen=True)
class LessonPart(Part):
    """The open lesson, and the progress in every lesson that was ever opened.

    An undo of a motion takes back no answer; the lesson also stays open when another arm is chosen by hand.

    Attributes
    ----------
    open : str
        Key of the open lesson; empty when none is open.
    progress_of : mapping of str to Progress
        By key of the lesson.
    """

    key: ClassVar[str] = "lesson"
    kept_by_undo: ClassVar[bool] = True

    open: str = ""
    progress_of: Mapping[str, Progress] = field(default_factory=lambda: MappingProxyType({}))

    @property
    def lesson(self) -> Lesson | None:
        """The open lesson, or None."""
        return lessons()[self.open] if self.open else None

    @property
    def progress(self) -> Progress:
        """The progress in the open lesson."""
        return self.progress_of.get(self.open, Progress())

    @property
    def step(self) -> Step | None:
        """The step that is shown, or None."""
        lesson = self.lesson
        return None if lesson is None else lesson.steps[self.progress.step]

    @property
    def verdict(self) -> Verdict | None:
        """What the last answer to the question of the shown step is worth; None before one is given."""
        step, typed = self.step, self.progress.answers.get(self.progress.step)
        return None if step is None or step.question is None or typed is None else step.question.judge(typed)

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return no lesson."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything."""
        return self

    def after(self, before: State, now: State) -> Self:
        """Note that the check of the shown step is met."""
        step = self.step
        if step is None or (self is before[LessonPart] and now[Joints] is before[Joints]):
            return self
        progress = self.progress
        if progress.step in progress.met:
            return self
        met = step.check is None or (has_its_arm(now) and step.check.is_met(_observation(now)))
        return self.with_progress(replace(progress, met=progress.met | {progress.step})) if met else self

    def with_progress(self, progress: Progress) -> Self:
        """Return the part with another progress in the open lesson."""
        return replace(self, progress_of=MappingProxyType({**self.progress_of, self.open: progress}))

    def to_json(self) -> Json:
        """Write it with the titles of steps, which outlive a change of their order."""
        return {"open": self.open, "progress": {key: _written(key, each) for key, each in self.progress_of.items()}}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; lessons and steps that are no longer there are forgotten."""
        there = lessons().lessons
        progress = {key: _read(there[key], each) for key, each in data["progress"].items() if key in there}
        return cls(data["open"] if data["open"] in there else "", MappingProxyType(progress))


PART = PartType(LessonPart, order=95)


def has_its_arm(state: State) -> bool:
    """Return whether the arm of the open lesson is on the table."""
    lesson, robot = state[LessonPart].lesson, state[RobotPart]
    return lesson is not None and not robot.own and robot.robot.key == lesson.robot


def check_line(state: State, words: Words = PLAIN) -> tuple[bool, str]:
    """Return whether the check of the shown step has been met, and what is missing (plain text).

    The text is empty when the step has no check or the arm is not the lesson's.
    """
    part = state[LessonPart]
    step, met = part.step, part.progress.step in part.progress.met
    if step is None or step.check is None or met or not has_its_arm(state):
        return met, ""
    return met, step.check.says(_observation(state), words)


def _observation(state: State) -> Observation:
    joints = state[Joints]
    return Observation(joints.arm, joints.q, np.asarray(joints.tool_pose, dtype=np.float64))


@dataclass(frozen=True)
class OpenLesson(Command):
    """Open a lesson: its arm in its start pose, its target, its switches. It goes on where the student has left it.

    Parameters
    ----------
    key : str
    anew : bool
        Whether to forget the progress in it, also when it is open already.
    """

    key: str
    anew: bool = False
    label: ClassVar[str] = "arm of the lesson"

    def apply(self, state: State) -> State:
        """Return the state at the start of the lesson, or the same state when it is open already."""
        lesson, part = lessons()[self.key], state[LessonPart]
        if part.open == lesson.key and not self.anew:
            return state
        opened = replace(part, open=lesson.key)
        kept = Progress() if self.anew else opened.progress
        return _set_up(state, lesson).replace(opened.with_progress(kept))


@dataclass(frozen=True)
class TakeLessonArm(Command):
    """Put the arm of the open lesson back on the table, in its start pose; the progress stays."""

    label: ClassVar[str] = "arm of the lesson"

    def apply(self, state: State) -> State:
        """Return the state with the arm of the lesson."""
        return _set_up(state, _lesson(state))


@dataclass(frozen=True)
class CloseLesson(Command):
    """Close the lesson; arm and progress stay as they are."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state without a lesson."""
        part = state[LessonPart]
        return state.replace(replace(part, open="")) if part.open else state


@dataclass(frozen=True)
class GoToStep(Command):
    """Show a step of the open lesson, done or not.

    Parameters
    ----------
    step : int
        From 0.
    """

    step: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the step shown."""
        lesson, part = _lesson(state), state[LessonPart]
        if not 0 <= self.step < len(lesson.steps):
            raise InputError(f"step: expected 1 to {len(lesson.steps)}, got {self.step + 1}")
        if self.step == part.progress.step:
            return state
        return state.replace(part.with_progress(replace(part.progress, step=self.step)))


@dataclass(frozen=True)
class Answer(Command):
    """Answer the question of the shown step.

    Parameters
    ----------
    text : str
        As typed; an empty one takes the answer away.
    """

    text: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the answer noted."""
        part, typed = state[LessonPart], self.text.strip()[:MOST_TYPED]
        step = part.step
        if step is None or step.question is None:
            raise InputError("answer: there is no question here")
        progress = part.progress
        answers = {i: text for i, text in progress.answers.items() if i != progress.step}
        right = progress.right
        if typed:
            answers[progress.step] = typed
            right = right | {progress.step} if step.question.judge(typed).right else right
        return state.replace(part.with_progress(replace(progress, right=right, answers=MappingProxyType(answers))))


def _lesson(state: State) -> Lesson:
    lesson = state[LessonPart].lesson
    if lesson is None:
        raise InputError("lesson: none is open")
    return lesson


def _set_up(state: State, lesson: Lesson) -> State:
    """Return the state with arm, pose, target and switches as a lesson begins; nothing plays."""
    robot = catalogue()[lesson.robot]
    if robot is not state[RobotPart].robot:
        state = state.with_robot(robot)
    joints = Joints.initial(robot).moved_to(lesson.start)
    on = {**state[Display].switches, **dict.fromkeys(lesson.overlays, True)}
    return state.replace(
        joints,
        _target(lesson, joints, state[Target]),
        Display(MappingProxyType(on)),
        replace(state[Timeline], clip="", time=0.0, playing=False),
    )


def _target(lesson: Lesson, joints: Joints, target: Target) -> Target:
    if lesson.target is None:
        return replace(target, pose=None, catching_up=False)
    pose = np.array(feasible(joints.arm, lesson.target, joints.tool_pose), dtype=np.float64)
    if joints.arm.task.rotation == "none":
        # The orientation is free: show the target as the tool stands.
        pose[:3, :3] = joints.tool_pose[:3, :3]
    pose.setflags(write=False)
    return replace(target, pose=pose, catching_up=False)


def _names(lesson: Lesson) -> list[str]:
    """Return a name for each step: its title, with a number where an earlier step has the same."""
    seen: Counter[str] = Counter()
    names = []
    for step in lesson.steps:
        seen[step.title] += 1
        names.append(f"{step.title}#{seen[step.title]}" if seen[step.title] > 1 else step.title)
    return names


def _written(key: str, progress: Progress) -> Json:
    names = _names(lessons()[key])
    return {
        "step": names[progress.step],
        "met": [names[i] for i in sorted(progress.met)],
        "right": [names[i] for i in sorted(progress.right)],
        "answers": {names[i]: text for i, text in sorted(progress.answers.items())},
    }


def _read(lesson: Lesson, data: Json) -> Progress:
    place = {name: i for i, name in enumerate(_names(lesson))}
    questions = {i for i, step in enumerate(lesson.steps) if step.question is not None}
    return Progress(
        place.get(data["step"], 0),
        frozenset(place[name] for name in data["met"] if name in place),
        frozenset(place[name] for name in data["right"] if name in place) & questions,
        MappingProxyType(
            {
                place[name]: str(text)[:MOST_TYPED]
                for name, text in data["answers"].items()
                if place.get(name) in questions
            }
        ),
    )
