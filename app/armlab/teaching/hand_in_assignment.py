"""The verdict on work on an assignment: each of its lessons is judged as by itself, and gives points."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from types import MappingProxyType

from armlab.content.assignment import LAST_VARIANT, Assignment, Task
from armlab.content.lesson import Lesson
from armlab.content.lessons import lesson, lessons
from armlab.content.reader import shown
from armlab.errors import InputError
from armlab.session.state import Json
from armlab.teaching.hand_in import (
    LONGEST_KEY,
    Report,
    StepReport,
    judged_anew,
    labelled,
    loaded,
    progress_in,
    refuse_other_kinds,
)
from armlab.teaching.hand_in_prints import prints_of
from armlab.teaching.handed import handed_of
from armlab.teaching.lesson_progress import Progress
from armlab.teaching.plain_text import printable
from armlab.teaching.signature import signed


def judge_assignment(text: str, key: str) -> Report:
    """Return the verdict on the text of a hand-in of an assignment.

    Parameters
    ----------
    text : str
    key : str
        The assignment it must be of.

    Raises
    ------
    InputError
        It is no hand-in, or one of a lesson, of another assignment or another version of it.
    UnknownName, ContentError
        The assignment or one of its lessons is not there or cannot be used.
    """
    assigned, data = lessons().assignment(key), loaded(text)
    refuse_another(assigned, data)
    steps: list[StepReport] = []
    prints: set[str] = set()
    changed = data["digest"] != assigned.digest
    claims = zip(claimed_in(assigned, data), assigned.tasks, data["works"], strict=True)
    for i, ((found, claimed), task, work) in enumerate(claims, start=1):
        steps += _judged(assigned, task, i, found, claimed)
        prints |= prints_of(work["progress"], None)
        changed = changed or work["digest"] != lessons()[task.lesson].digest
    varies = assigned.by_student and any(lessons()[task.lesson].varies for task in assigned.tasks)
    return Report(
        student=printable(signed(data["student"])),
        lesson=assigned.key,
        title=assigned.title,
        variant=data["variant"],
        changed=changed,
        steps=tuple(steps),
        prints=frozenset(prints),
        varies=varies,
        handed=handed_of(assigned, data),
    )


def refuse_another(assigned: Assignment, data: Json) -> None:
    """Raise `InputError` for work on a lesson, another assignment, or another version of this one."""
    if "assignment" not in data and "lesson" in data:
        said = str(data["lesson"])[:LONGEST_KEY]
        raise InputError(f"this is work on the lesson {said!r}, not on the assignment {assigned.key!r}")
    kinds = {"assignment": str, "version": int, "digest": str, "variant": int, "works": list}
    refuse_other_kinds(data, kinds)
    if data["assignment"] != assigned.key:
        said = data["assignment"][:LONGEST_KEY]
        raise InputError(f"this is work on the assignment {said!r}, not {assigned.key!r}")
    if data["version"] != assigned.version:
        said = f"of the assignment {assigned.key!r}, not version {assigned.version}"
        raise InputError(f"this is work on version {data['version']} {said}")
    if not 0 <= data["variant"] <= LAST_VARIANT:
        raise InputError(f"variant: expected 0 to {LAST_VARIANT}, got {shown(data['variant'])}")
    named = [work.get("lesson") if isinstance(work, dict) else None for work in data["works"]]
    if named != list(assigned.lessons):
        listed = ", ".join(assigned.lessons)
        raise InputError(f"expected work on the lessons {listed}; the file holds others")


def claimed_in(assigned: Assignment, data: Json) -> Iterator[tuple[Lesson, Progress]]:
    """Yield the lessons of an assignment, in the variants of a file, with the progress that it claims.

    Raises
    ------
    InputError
        The variants are not those of the student, or something is damaged.
    """
    for i, (task, work) in enumerate(zip(assigned.tasks, data["works"], strict=True), start=1):
        refuse_other_kinds(work, {"lesson": str, "variant": int, "digest": str, "progress": dict})
        given = task.number(data["variant"]) if lessons()[task.lesson].varies else 0
        if work["variant"] != given:
            raise InputError(f"task {i} is in variant {work['variant']}; expected {given}")
        found = lesson(task.lesson, given)
        yield found, progress_in(found, work)


def _judged(assigned: Assignment, task: Task, i: int, found: Lesson, claimed: Progress) -> Iterator[StepReport]:
    """Yield the verdicts on the steps of a task, with their points."""
    if assigned.exam:
        # What stands last counts: an answer that was right before it is of no matter.
        claimed = replace(claimed, right=MappingProxyType({}))
    _, steps = judged_anew(found, claimed)
    points = task.points_of(lessons()[task.lesson])
    for step, of, worth in zip(labelled(steps, i), found.steps, points, strict=True):
        # Of a prediction any answer counts in a lesson; in an exam it has to be right.
        passed = step.passed and not (assigned.exam and step.right is False)
        yield replace(step, points=worth, lost=assigned.lost(worth, of, step.hints), passed=passed)
