"""The start of lessons and steps: the arm and its pose, an example of a bench, and actions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from armlab.content.actions import Action
from armlab.content.bench_words import BenchWord
from armlab.content.lesson import Lesson
from armlab.errors import ContentError, UnknownName
from armlab.kin.ik.target import feasible
from armlab.session.bench import with_example
from armlab.session.examples import with_clip_closed
from armlab.session.facts import benches_of, fact_of
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import Timeline
from armlab.session.share import STAYS
from armlab.session.state import Part, State, part_types
from armlab.session.words import command_of, lies_in
from armlab.teaching.deeds import with_done
from armlab.teaching.lesson_locks import freed, held
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.taught import taught

THE_LESSON = -1
"""Index of the lesson itself among its steps, which are counted from 0."""


def set_up(state: State, lesson: Lesson, i: int) -> State:
    """Return the state at the start of step i: arm, pose, target, switches and benches; nothing plays."""
    robot = lesson.robot_used
    if robot is not state[RobotPart].robot:
        state = state.with_robot(robot)
    joints = held(Joints.initial(robot).moved_to(lesson.start), lesson, True)
    # Switches that the previous lesson turned on would be in the way; this lesson says which are on.
    off = {name: False for name, on in state[Display].switches.items() if not on}
    on = {**off, **state[Display].of_screen(), **dict.fromkeys(lesson.overlays, True)}
    ready = state.replace(
        joints,
        _target(lesson, joints, state[Target]),
        Display(MappingProxyType(on)),
        replace(state[Timeline], clip="", time=0.0, playing=False),
    )
    return _begun(_fresh(ready, lesson), lesson, THE_LESSON, i)


def gone_to(state: State, lesson: Lesson, before: int, i: int) -> State:
    """Return the state with the start of step i, coming from another; the same state when the step has none.

    Who goes forward finds put in place what the steps on the way begin with; who goes back finds the benches as they
    were for the earlier step.
    """
    was, stage = _stage(lesson, before), _stage(lesson, i)
    if was == stage:
        return state
    if stage == THE_LESSON and not _begins(lesson, THE_LESSON):
        return state
    state = with_clip_closed(state)
    if stage > was:
        return _begun(state, lesson, was + 1, i)
    return _begun(_fresh(state, lesson), lesson, THE_LESSON, i)


def refuse_unknown(lesson: Lesson) -> None:
    """Raise `ContentError` where the starts of a lesson name an unknown command or fact of a bench."""
    for action in (*lesson.begin, *(action for step in lesson.steps for action in step.begin)):
        if isinstance(action, BenchWord):
            command_of(action)
    for number, step in enumerate(lesson.steps, start=1):
        for word in () if step.check is None else step.check.facts:
            try:
                fact_of(word)
            except UnknownName as error:
                raise ContentError(f"{lesson.file}, line {step.line}", f"step {number}.check", str(error)) from None


def without_lesson(state: State) -> State:
    """Return the state with no lesson open, and the joints free that it held; all else is as it was."""
    part = state[LessonPart]
    return freed(state, part.lesson).replace(replace(part, open="", assignment=""))


def _begins(lesson: Lesson, k: int) -> bool:
    """Return whether a step, or the lesson, puts anything in place."""
    example, done = _start(lesson, k)
    return bool(example or done)


def _start(lesson: Lesson, k: int) -> tuple[str, tuple[Action, ...]]:
    begun = lesson if k == THE_LESSON else lesson.steps[k]
    return begun.example, begun.begin


def _stage(lesson: Lesson, i: int) -> int:
    """Return the last step, at or before step i, that puts anything in place."""
    return next((k for k in range(i, THE_LESSON, -1) if _begins(lesson, k)), THE_LESSON)


def _begun(state: State, lesson: Lesson, first: int, i: int) -> State:
    """Return the state after the starts of steps first to i, beginning with the last example among them."""
    with_one = (k for k in range(i, first - 1, -1) if _start(lesson, k)[0])
    for k in range(next(with_one, first), i + 1):
        example, done = _start(lesson, k)
        if example:
            state = with_example(state, example, lesson.robot)
        state = with_done(state, done)
    return state


def _fresh(state: State, lesson: Lesson) -> State:
    """Return the state with the benches that a lesson uses as they open, without the student's earlier work."""
    robot = state[RobotPart].robot
    used = (kind for kind in dict.fromkeys(_parts_of(lesson)) if kind.key not in STAYS)
    return state.replace(*(kind.initial(robot) for kind in used))


def _parts_of(lesson: Lesson) -> Iterator[type[Part]]:
    yield from (each.part for each in taught() if any(map(each.is_checked, lesson.steps)))
    facts = [word for step in lesson.steps if step.check is not None for word in step.check.facts]
    # The joints, which facts may follow from, too, stand where the lesson has put them.
    yield from (part for found in benches_of(facts) for part in found.parts if part is not Joints)
    begun = (*lesson.begin, *(action for step in lesson.steps for action in step.begin))
    pages = {action.word.rpartition(".")[0] for action in begun if isinstance(action, BenchWord)}
    yield from (kind for kind in part_types() if any(lies_in(kind, page) for page in pages))


def _target(lesson: Lesson, joints: Joints, target: Target) -> Target:
    if lesson.target is None:
        return replace(target, pose=None, catching_up=False)
    pose = np.array(feasible(joints.arm, lesson.target, joints.tool_pose), dtype=np.float64)
    if joints.arm.task.rotation == "none":
        # The orientation is free: show the target as the tool stands.
        pose[:3, :3] = joints.tool_pose[:3, :3]
    pose.setflags(write=False)
    return replace(target, pose=pose, catching_up=False)
