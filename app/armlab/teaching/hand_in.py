"""The work of a student as a file, and the verdicts on such a file: the same as on screen, without a browser.

Answers are judged again, and every check looks again at what it saw when it was met: at the arm of the lesson with its
own limits, at the joint values of the file, at a motion that is planned again from its waypoints. Anything that no file
proves, such as the time, is noted and called so.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from armlab.content.assignment import Assignment
from armlab.content.lesson import Lesson, Step
from armlab.content.lessons import lesson
from armlab.content.names import named
from armlab.content.observation import same_table
from armlab.errors import ArmlabError, InputError
from armlab.session.share import STAYS
from armlab.session.state import Json, State
from armlab.teaching.assignment_work import Work
from armlab.teaching.hand_in_prints import prints_of
from armlab.teaching.handed import Handed, of_assignment
from armlab.teaching.lesson_places import kept_at, place_of, where_in
from armlab.teaching.lesson_progress import Progress, RightAnswer, read, step_names, written
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.plain_text import plain, printable
from armlab.teaching.seen_again import seen_again
from armlab.teaching.signature import signed
from armlab.version import VERSION

FORMAT = 1
MOST = 1_000_000
"""Largest file that is read, in characters."""

LONGEST_KEY = 64
"""Longest key of a lesson, in characters."""


def hand_in(state: State) -> str:
    """Return the work on the open lesson, or on the assignment that it belongs to, as the text of a file.

    Raises
    ------
    InputError
        No lesson is open.
    """
    part = state[LessonPart]
    found, assigned, work = part.lesson, part.assigned, part.work
    if found is None:
        raise InputError("lesson: no lesson is open")
    signed_by = {"format": FORMAT, "armlab": VERSION, "student": part.student}
    if assigned is not None and work is not None:
        data = {**signed_by, **of_assignment(assigned, work), "works": [*_works(part, assigned, work)]}
        return json.dumps(data, indent=1, ensure_ascii=False)
    data = {**signed_by, **_of_lesson(part.open, found, part.progress)}
    # Before a prediction the state would tell what is to be predicted; of progress it has that of its lesson only.
    parts = {} if part.hides else {k: each for k, each in state.to_json().items() if k not in STAYS}
    whole = json.dumps({**data, "parts": parts}, indent=1, ensure_ascii=False)
    # With long tables of a motion the work could not be read again; what is judged stands without them.
    return whole if len(whole) <= MOST else json.dumps({**data, "parts": {}}, indent=1, ensure_ascii=False)


def hand_in_name(state: State) -> str:
    """Return a file name for the hand-in: lesson or assignment and the student's name in plain letters."""
    return work_name(state[LessonPart])


def work_name(part: LessonPart) -> str:
    """Return a file name for the work on the open lesson or assignment; see `hand_in_name`."""
    who = re.sub(r"[^a-z0-9]+", "_", part.student.lower()).strip("_")[:40]
    attempt = str(part.work.attempts) if part.work is not None and part.work.attempts > 1 else ""
    place, _, variant = part.open.partition("/")
    what = named(part.assignment) or "_".join(filter(None, (named(place), variant)))
    return "_".join(filter(None, (what, who, attempt))) + ".json"


def _of_lesson(place: str, found: Lesson, progress: Progress) -> dict[str, Json]:
    # The number is that of the student, also where another variant stands for one that is broken for a while.
    number = int(place.partition("/")[2] or 0)
    return {"lesson": named(found.key), "variant": number, "digest": found.digest, "progress": written(progress)}


def _works(part: LessonPart, assigned: Assignment, work: Work) -> Iterator[Json]:
    """Yield the work on each task of an assignment, also on those that were never opened."""
    for task in assigned.tasks:
        place = place_of(task.lesson, task.number(work.number))
        progress = part.progress_of.get(where_in(assigned.key, place), Progress())
        yield _of_lesson(place, kept_at(place), progress)


@dataclass(frozen=True)
class StepReport:
    """The verdict on one step.

    Attributes
    ----------
    title : str
    met : bool or None
        Whether its check was met; None where there is none.
    right : bool or None
        Whether its question is answered rightly; None where there is none.
    passed : bool
        Whether everything is done, as on screen: what was done once stays done, and of a prediction any answer counts.
    noted : bool
        Whether it rests on what no file proves, such as the time or that a film was played: that is noted, not judged.
    says : str
        Sentence on the step, as plain text.
    hints : int
        Number of hints that were shown.
    last_hint : bool
        Whether the last of them was.
    points : float
        What it gives when it is done: one point in a lesson, in an assignment by its marking scheme.
    lost : float
        What its last hint costs of that, where it was shown.
    label : str
        Its number in reports: ``2.1`` for the first step of the second task of an assignment.
    """

    title: str
    met: bool | None
    right: bool | None
    passed: bool
    noted: bool
    says: str
    hints: int
    last_hint: bool = False
    points: float = 1.0
    lost: float = 0.0
    label: str = ""

    @property
    def counts(self) -> bool:
        """Whether the step has a task."""
        return self.met is not None or self.right is not None

    @property
    def earned(self) -> float:
        """Its points as far as they are earned, without what late work loses."""
        return self.points - self.lost if self.passed and self.counts else 0.0


@dataclass(frozen=True)
class Report:
    """The verdict on a file.

    Attributes
    ----------
    student : str
        The student's name, as signed.
    lesson, title : str
    variant : int
    changed : bool
        Whether the lesson's file has changed since.
    steps : tuple of StepReport
        All steps, also those with nothing to do.
    prints : frozenset of str
        Marks that two hand-ins share only if one was made from the other; see `prints_of`.
    varies : bool
        Whether students have variants of their own.
    handed : Handed or None
        When and how often work on an assignment was handed in; None of a lesson. ``lesson`` is then the assignment,
        and ``steps`` are those of all its tasks.

    Notes
    -----
    Students choose their names and answers: control characters in them are replaced.
    """

    student: str
    lesson: str
    title: str
    variant: int
    changed: bool
    steps: tuple[StepReport, ...]
    prints: frozenset[str] = frozenset()
    varies: bool = False
    handed: Handed | None = None

    @property
    def points(self) -> float:
        """Points of the steps that are passed, without what late work loses."""
        found = sum(step.earned for step in self.steps)
        return found * (1.0 if self.handed is None else self.handed.part_left)

    @property
    def most(self) -> float:
        """Points of all steps with a task."""
        return sum(step.points for step in self.steps if step.counts)

    @property
    def hints(self) -> int:
        """Number of hints that were shown."""
        return sum(step.hints for step in self.steps)

    @property
    def passed(self) -> int:
        """Number of steps with a task that are passed."""
        return sum(step.passed for step in self.steps if step.counts)

    @property
    def count(self) -> int:
        """Number of steps with a task."""
        return sum(step.counts for step in self.steps)


def judge(text: str, key: str | None = None) -> Report:
    """Return the verdict on the text of a hand-in.

    Parameters
    ----------
    text : str
    key : str, optional
        The lesson it must be of; its own when left out.

    Raises
    ------
    InputError
        It is no hand-in, or one of another lesson.
    UnknownName, ContentError
        Its lesson is not there or cannot be used.
    """
    data, found, progress = opened(text, key)
    _, steps = judged_anew(found, progress)
    student = printable(signed(data["student"]))
    changed, prints = data["digest"] != found.digest, prints_of(data["progress"], data.get("parts"))
    return Report(student, found.key, found.title, found.variant, changed, labelled(steps), prints, found.varies)


def labelled(steps: Iterable[StepReport], task: int = 0) -> tuple[StepReport, ...]:
    """Return the verdicts with their numbers in reports, behind that of their task if there is one."""
    before = f"{task}." if task else ""
    return tuple(replace(step, label=f"{before}{i}") for i, step in enumerate(steps, start=1))


def opened(text: str, key: str | None = None) -> tuple[dict[str, Json], Lesson, Progress]:
    """Return what is in the text of a hand-in: its data, the lesson in its variant, and the progress it claims.

    Raises
    ------
    InputError, UnknownName, ContentError
        As of `judge`.
    """
    data = loaded(text)
    if "assignment" in data and "lesson" not in data:
        title = str(data["assignment"])[:LONGEST_KEY]
        raise InputError(f"this is work on the assignment {title!r}, not on a lesson")
    refuse_other_kinds(data, {"lesson": str, "variant": int, "digest": str, "progress": dict})
    if key is not None and data["lesson"] != key:
        raise InputError(f"this is work on the lesson {data['lesson'][:LONGEST_KEY]!r}, not {key!r}")
    found = lesson(data["lesson"][:LONGEST_KEY], data["variant"])
    return data, found, progress_in(found, data)


def progress_in(found: Lesson, data: Json) -> Progress:
    """Return the progress in a lesson that a file claims.

    Raises
    ------
    InputError
        It is damaged.
    """
    try:
        return read(found, data["progress"])
    except (TypeError, KeyError, AttributeError, ValueError, OverflowError):
        raise InputError("the progress in this file is damaged") from None


def loaded(text: str) -> dict[str, Json]:
    """Return what is in the text of a hand-in, of a lesson or of an assignment.

    Raises
    ------
    InputError
        It is no hand-in, or one of another format.
    """
    if len(text) > MOST:
        raise InputError(f"expected at most {MOST} characters, got {len(text)}")
    try:
        data: dict[str, Json] = json.loads(text)
    except (ValueError, RecursionError):
        raise InputError("this is not work saved by the lab: it is not JSON") from None
    refuse_other_kinds(data, {"format": int, "student": str})
    if data["format"] != FORMAT:
        raise InputError(f"this file has format {data['format']}; this lab reads format {FORMAT}")
    return data


def refuse_other_kinds(data: Json, kinds: Mapping[str, type]) -> None:
    """Raise `InputError` where an entry is missing or of another kind."""
    for name, kind in kinds.items():
        if not isinstance(data, dict) or type(data.get(name)) is not kind:
            raise InputError(f"this is not work saved by the lab: {name} is missing or not usable")


def judged_anew(found: Lesson, progress: Progress, plans: bool = True) -> tuple[Progress, tuple[StepReport, ...]]:
    """Return a progress that anyone may have changed with only what holds in it, and the verdicts on its steps.

    Parameters
    ----------
    found : Lesson
    progress : Progress
    plans : bool
        Whether motions are planned again, which may take seconds.
    """
    names = step_names(found)
    checks, questions, noted = [], [], []
    answers, met, right = dict(progress.answers), set(), {}
    for name, step in zip(names, found.steps, strict=True):
        checks.append(_check_again(found, step, progress.evidence.get(name), plans))
        noted.append(step.check is not None and bool(step.check.noted))
        is_only_text = step.check is None and step.question is None
        if checks[-1][0] is not False and (name in progress.met or not is_only_text):
            met.add(name)
        verdict, says, holds = _answer_again(step, answers.get(name), progress.right.get(name))
        questions.append((verdict, says))
        if holds is not None:
            right[name] = holds
        elif _is_no_prediction(step, answers.get(name)):
            del answers[name]
    kept = replace(
        progress,
        met=frozenset(met),
        right=MappingProxyType(right),
        answers=MappingProxyType(answers),
        evidence=MappingProxyType({name: seen for name, seen in progress.evidence.items() if name in met}),
    )
    passed = kept.passed(found)
    steps = tuple(
        StepReport(
            title=found.steps[i].title,
            met=checks[i][0],
            right=questions[i][0],
            passed=i in passed,
            noted=noted[i],
            says=printable(" ".join(filter(None, (checks[i][1], questions[i][1])))),
            hints=max(0, progress.hints.get(name, 0)),
            last_hint=0 < len(found.steps[i].hints) <= progress.hints.get(name, 0),
        )
        for i, name in enumerate(names)
    )
    return kept, steps


def _check_again(found: Lesson, step: Step, evidence: Json, plans: bool) -> tuple[bool | None, str]:
    """Return whether the check is met according to the evidence, and the sentence on it."""
    if step.check is None:
        return None, ""
    if evidence is None:
        return False, "Not done."
    try:
        seen = seen_again(evidence, found.robot_used, plans, step.check.facts)
    except ArmlabError as error:
        return False, f"The evidence is not usable: {str(error).rstrip('.')}."
    if not step.check.of_table and not same_table(seen.arm, found.robot_used.arm):
        return False, "This was done with another arm."
    met, says = step.check.judge(seen)
    if not met:
        return False, plain(says)
    noted = " and ".join(step.check.noted)
    return True, f"Recorded only, not judged: {noted}." if noted else ""


def _answer_again(
    step: Step, typed: str | None, kept: RightAnswer | None
) -> tuple[bool | None, str, RightAnswer | None]:
    """Return whether the question is answered rightly, the sentence on it, and the right answer."""
    if step.question is None:
        return None, "", None
    if step.question.hide:
        kept = None  # of a prediction the first answer counts
    texts = list(dict.fromkeys(text for text in (kept.typed if kept else None, typed) if text is not None))
    if not texts:
        return False, "Not answered.", None
    verdicts = [step.question.judge(text) for text in texts]
    says = " Then ".join(f"{text!r}: {plain(verdict.says)}" for text, verdict in zip(texts, verdicts, strict=True))
    if kept is not None and verdicts[0].right:
        return True, says, kept
    return verdicts[-1].right, says, RightAnswer(texts[-1]) if verdicts[-1].right else None


def _is_no_prediction(step: Step, typed: str | None) -> bool:
    """Return whether the prediction is invalid, as one that the screen would not accept."""
    if typed is None or step.question is None or not step.question.hide:
        return False
    return not step.question.judge(typed).counts
