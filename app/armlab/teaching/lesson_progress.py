"""The progress of a student in a lesson, by the names of its steps, which do not depend on their order."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from types import MappingProxyType

from armlab.content.evidence import LARGEST
from armlab.content.lesson import Lesson
from armlab.session.state import Json

MOST_TYPED = 1000
"""Longest answer that is kept, in characters."""


def _empty() -> Mapping[str, Json]:
    return MappingProxyType({})


@dataclass(frozen=True)
class RightAnswer:
    """An answer that was right.

    Attributes
    ----------
    typed : str
    seconds : float
        Since the step was shown.
    """

    typed: str
    seconds: float = 0.0


@dataclass(frozen=True)
class Progress:
    """The progress of a student in one lesson.

    Attributes
    ----------
    step : str
        Name of the step that is shown; empty for the first.
    met : frozenset of str
        Steps whose check was met once, or that have been shown and have none.
    right : mapping of str to RightAnswer
        By step, the answer typed when its question was first answered rightly. Like evidence, it can be judged again.
    answers : mapping of str to str
        By question, the last answer typed; for a prediction the first one.
    hints : mapping of str to int
        By step, the number of hints shown.
    evidence : mapping of str to Json
        By step, the observation with which its check was met.
    since : float or None
        Time at which the step was first shown, in seconds of the session's clock; not saved.
    films : frozenset of str
        Clips that were played to their end since then; not saved.
    tried : bool
        Whether anything of what the check looks at has been changed since then; not saved.
    """

    step: str = ""
    met: frozenset[str] = frozenset()
    right: Mapping[str, RightAnswer] = field(default_factory=_empty)
    answers: Mapping[str, str] = field(default_factory=_empty)
    hints: Mapping[str, int] = field(default_factory=_empty)
    evidence: Mapping[str, Json] = field(default_factory=_empty)
    since: float | None = None
    films: frozenset[str] = frozenset()
    tried: bool = False

    def anew(self) -> Progress:
        """Return the progress as when the step is shown anew: nothing is done yet, and no time has passed."""
        return replace(self, since=None, films=frozenset(), tried=False)

    def shown(self, lesson: Lesson) -> int:
        """Return the number of the shown step, from 0."""
        names = step_names(lesson)
        return names.index(self.step) if self.step in names else 0

    def seconds(self, now: float) -> float:
        """Return how long the step has been shown, in seconds, at most as long as evidence may tell of.

        ``now`` is a time of the session's clock.
        """
        return 0.0 if self.since is None else min(max(0.0, now - self.since), LARGEST)

    def committed(self, lesson: Lesson, i: int) -> bool:
        """Return whether step i asks for a prediction and has one."""
        question = lesson.steps[i].question
        return question is not None and bool(question.hide) and step_names(lesson)[i] in self.answers

    def answered(self, lesson: Lesson, i: int) -> bool:
        """Return whether the question of step i is answered finally, or there is none."""
        return lesson.steps[i].question is None or self.committed(lesson, i) or step_names(lesson)[i] in self.right

    def passed(self, lesson: Lesson) -> frozenset[int]:
        """Return the steps, from 0, of which everything is done; what was done once stays done.

        This alone decides, on screen and for a hand-in; of a hand-in the progress is judged anew before.
        """
        names = step_names(lesson)
        return frozenset(i for i, name in enumerate(names) if name in self.met and self.answered(lesson, i))


@lru_cache(maxsize=1024)
def step_names(lesson: Lesson) -> tuple[str, ...]:
    """Return a name for each step: its title, with a number when an earlier step has the same title."""
    seen: Counter[str] = Counter()
    names = []
    for step in lesson.steps:
        seen[step.title] += 1
        names.append(f"{step.title}#{seen[step.title]}" if seen[step.title] > 1 else step.title)
    return tuple(names)


def written(progress: Progress) -> Json:
    """Return the progress as JSON."""
    return {
        "step": progress.step,
        "met": sorted(progress.met),
        "right": {name: [answer.typed, answer.seconds] for name, answer in sorted(progress.right.items())},
        "answers": dict(sorted(progress.answers.items())),
        "hints": dict(sorted(progress.hints.items())),
        "evidence": dict(sorted(progress.evidence.items())),
    }


def read(lesson: Lesson, data: Json) -> Progress:
    """Return the progress from JSON; steps that no longer exist are left out."""
    names = step_names(lesson)
    asked = {name for name, step in zip(names, lesson.steps, strict=True) if step.question is not None}
    checked = {name for name, step in zip(names, lesson.steps, strict=True) if step.check is not None}
    hints = {name: len(step.hints) for name, step in zip(names, lesson.steps, strict=True)}
    answers = {n: str(text)[:MOST_TYPED] for n, text in data["answers"].items() if n in asked}
    return Progress(
        step=data["step"] if data["step"] in names else "",
        met=frozenset(data["met"]) & frozenset(names),
        right=MappingProxyType(_right(data["right"], answers, asked)),
        answers=MappingProxyType(answers),
        hints=MappingProxyType(
            {name: min(int(count), hints[name]) for name, count in data.get("hints", {}).items() if name in hints}
        ),
        evidence=MappingProxyType({n: seen for n, seen in data.get("evidence", {}).items() if n in checked}),
    )


def _right(data: Json, answers: Mapping[str, str], asked: set[str]) -> dict[str, RightAnswer]:
    """Return the right answers; where only names were saved, the last answer typed is used."""
    if isinstance(data, list):
        return {name: RightAnswer(answers[name]) for name in data if name in answers}
    right = {name: RightAnswer(str(typed)[:MOST_TYPED], float(at)) for name, (typed, at) in data.items()}
    return {name: answer for name, answer in right.items() if name in asked and math.isfinite(answer.seconds)}
