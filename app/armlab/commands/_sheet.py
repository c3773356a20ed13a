"""The solution sheet of a lesson as Markdown: for each variant its values, right answers and solutions."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.commands._sheet_answers import right_answer
from armlab.commands._sheet_bench import bench_words, facts_asked
from armlab.content import actions
from armlab.content.bench_words import BenchWord
from armlab.content.lesson import Lesson, Step
from armlab.content.lesson_head import time_said
from armlab.content.lesson_values import written
from armlab.content.robots import catalogue
from armlab.content.vocabulary import vocabularies
from armlab.content.write_robot import roll_pitch_yaw
from armlab.kin.arm import Arm
from armlab.teaching.plain_text import plain, printable

_MEANS_SOMETHING = re.compile(r"([\\`*{}\[\]<>#|~&$]|(?<!\w)_|_(?!\w))")
"""Signs of Markdown; a line between two letters is none."""

SI_UNITS = "Where what is to be done on a page names no unit, quantities are in SI units and angles in radians."
"""A command of a page may take values of several units, and takes them as a lesson's file writes them."""


def sheet(first: Lesson, variants: Sequence[tuple[int, Lesson]], students: Mapping[int, str], level: int = 1) -> str:
    """Return the sheet.

    Parameters
    ----------
    first : Lesson
        Variant 0.
    variants : sequence of (int, Lesson)
        In the order of the sheet.
    students : mapping of int to str
        Names by variant; empty for none.
    level : int
        Level of its heading.
    """
    told = ", ".join(filter(None, (f"Lesson `{first.key}`", escaped(first.chapter), time_said(first.minutes))))
    lines = [f"{'#' * level} {escaped(first.title)}: solutions", "", f"{told}.", ""]
    if first.varies and first.listed:
        lines += [f"The numbers of variants are those of the lab; `/lesson/{first.key}/7` opens variant 7.", ""]
    lines += [*_asked(first), ""]
    if level == 1 and (on_hints := _on_hints(first)):
        lines += [on_hints, ""]
    if any(isinstance(action, BenchWord) for step in first.steps for action in step.solution):
        lines += [SI_UNITS, ""]
    columns = _columns(first, students)
    lines += [_row(columns), _row(["---"] * len(columns))]
    lines += [_row([column(number, lesson) for column in columns.values()]) for number, lesson in variants]
    return "".join(f"{line}\n" for line in lines)


def escaped(text: str) -> str:
    """Return a text on one line of Markdown, in which nothing of it means anything.

    >>> escaped("a|b")
    'a\\\\|b'
    """
    return _MEANS_SOMETHING.sub(r"\\\1", printable(" ".join(text.split())))


def solution(lesson: Lesson, step: Step) -> str:
    """Return what is to be done in a step; empty when its file does not say."""
    arm, done = lesson.robot_used.arm, []
    for action in step.solution:
        arm = catalogue()[action.key].arm if isinstance(action, actions.TakeRobot) else arm
        done.append(_done(action, arm))
    return ", then ".join(done)


def _asked(lesson: Lesson) -> Iterator[str]:
    """Yield the questions, and what is asked of the benches, with the values of variant 0."""
    in_first = ", in variant 0" if lesson.varies else ""
    for i, step in enumerate(lesson.steps):
        for asked in () if step.check is None else facts_asked(step.check.check):
            yield f"- Step {i + 1}, {escaped(step.title)}{in_first}, is to have {escaped(asked)}"
        if step.question is not None:
            yield f"- Step {i + 1}, {escaped(step.title)}{in_first}: {escaped(plain(step.question.html))}"


def _on_hints(lesson: Lesson) -> str:
    """Return a sentence on the hints of a lesson and on what the last one costs; empty where there are none."""
    counts = [f"step {i} has {len(step.hints)}" for i, step in enumerate(lesson.steps, start=1) if step.hints]
    if not counts:
        return ""
    costs = "In a lesson no hint costs points; in an assignment the last one of a step costs its `last_hint_percent`."
    return f"Hints: {', '.join(counts)}. {costs} The table of `armlab check` marks where it was shown."


Column = Callable[[int, Lesson], str]


def _columns(first: Lesson, students: Mapping[int, str]) -> dict[str, Column]:
    """Return the columns by their headings."""
    columns: dict[str, Column] = {"variant": lambda number, _: str(number)}
    if students:
        columns["student"] = lambda number, _: escaped(students.get(number, ""))
    for name in first.values:
        columns[f"`{name}`"] = lambda _, lesson, name=name: escaped(written(lesson.values[name]))  # type: ignore[misc]
    for i, step in enumerate(first.steps):
        if step.question is not None:
            columns[f"{i + 1} answer"] = lambda _, lesson, i=i: _answer(lesson.steps[i])  # type: ignore[misc]
        if step.check is not None:
            columns[f"{i + 1} do"] = lambda _, lesson, i=i: escaped(solution(lesson, lesson.steps[i]))  # type: ignore[misc]
    return columns


def _answer(step: Step) -> str:
    return "" if step.question is None else escaped(right_answer(step.question))


def _row(cells: Sequence[str] | Mapping[str, Column]) -> str:
    return f"| {' | '.join(cells)} |"


def _done(action: actions.Action, arm: Arm) -> str:
    """Return in words what is done with the arm that is there by then."""
    if isinstance(action, actions.Move):
        return f"q = ({_joint_values(action.q, arm)})"
    if isinstance(action, actions.MoveTarget):
        return f"target at {_pose(action.T, arm)}"
    if isinstance(action, actions.SetCell):
        value = _angle(action.value) if action.field in ("alpha", "theta") else f"{written(action.value)} m"
        return f"row {action.row + 1}, {action.field} = {value}"
    if isinstance(action, actions.TakeRobot):
        return f"choose {action.key}"
    if isinstance(action, actions.SetSwitch):
        return f"switch {action.name} {'on' if action.on else 'off'}"
    if isinstance(action, actions.Wait):
        return f"wait {written(action.seconds)} s"
    if isinstance(action, actions.TypeAnswer):
        return f"answer {action.text}"
    if isinstance(action, actions.PlayFilm):
        named = {"film", *(key for each in vocabularies().values() for key in each.plays)}
        return f"play {'the ' if action.name in named else ''}{action.name}"
    if isinstance(action, BenchWord):
        return bench_words(action)
    if isinstance(action, actions.TakeExample):
        return f"example {action.name}"
    return action.says()


def _joint_values(q: NDArray[np.float64], arm: Arm) -> str:
    return ", ".join(
        _angle(float(value)) if turns else f"{written(float(value))} m"
        for value, turns in zip(q, arm.revolute, strict=True)
    )


def _pose(T: NDArray[np.float64], arm: Arm) -> str:
    """Return a position, and an orientation where the arm's task has one or somebody has turned it."""
    place = f"({', '.join(written(float(value)) for value in T[:3, 3])}) m"
    if arm.task.rotation == "none" and np.array_equal(T[:3, :3], np.eye(3)):
        return place
    return f"{place} with roll, pitch and yaw ({', '.join(map(_angle, roll_pitch_yaw(T[:3, :3])))})"


def _angle(value: float) -> str:
    return f"{written(math.degrees(value))}°"
