"""Playing a lesson by its own solution, to find its mistakes."""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.content import actions
from armlab.content.check import Check
from armlab.content.checks.all_of import AllOf
from armlab.content.checks.looked_at import LookedAt
from armlab.content.checks.target_at import TargetAt
from armlab.content.joint_limits import outside
from armlab.content.lesson import Lesson
from armlab.content.lessons import lesson as find_lesson
from armlab.content.observation import Observation
from armlab.errors import ContentError, InputError
from armlab.kin.checks import finite_floats, whole_number
from armlab.session.facts import benches_of
from armlab.session.job import Deliver, Job
from armlab.session.panel_commands import OpenPanel
from armlab.session.parts.timeline import OpenClip, Seek, duration
from armlab.session.session import Session
from armlab.session.state import Command, State
from armlab.teaching.deeds import commands_of
from armlab.teaching.facts_at import FactsAt
from armlab.teaching.lesson_commands import Answer, GoToStep, OpenLesson
from armlab.teaching.parts.lesson import LessonPart, check_line, observed
from armlab.teaching.plain_text import plain
from armlab.teaching.taught import taught

KEPT = 32
"""Number of results of jobs that are kept."""

RANDOM_STATES = 100
MOST_BY_CHANCE = 4
"""Largest number of the random states that may meet a check."""


@dataclass(frozen=True)
class Problem:
    """A mistake of a lesson that its file does not show.

    Attributes
    ----------
    step : int
        Step, from 1.
    line : int
        Line of the step in the file.
    says : str
    """

    step: int
    line: int
    says: str


class Player:
    """A student who does exactly what the solutions say.

    Parameters
    ----------
    lesson : Lesson
    planning : bool, optional
        Whether motions are planned, which takes time.

    Attributes
    ----------
    refused : str
        Why the lesson could not be opened; empty when it is.
    """

    def __init__(self, lesson: Lesson, planning: bool = True) -> None:
        self.lesson = lesson
        self.session = Session.fresh("solution", lesson.robot_used)
        self.time, self._planning = 0.0, planning
        self.refused = self.do(OpenLesson(lesson.key, variant=lesson.variant if lesson.varies else None, within=True))

    def go_to(self, i: int) -> str:
        """Go to a step, from 0; return the reason of a refusal, or ""."""
        return self.do(GoToStep(i))

    @property
    def part(self) -> LessonPart:
        """The lesson part of the present state."""
        return self.session.state[LessonPart]

    def do(self, command: Command) -> str:
        """Apply a command and wait for the motion to be planned; return the reason of a refusal, or ""."""
        told = self.session.notice
        self.session.apply(command, self.time)
        self._work_out()
        return "" if self.session.notice is told or self.session.notice is None else self.session.notice.text

    def _work_out(self) -> None:
        """Compute everything lessons may need, such as the planned motion, as the lab would in the background."""
        of_facts = [(found.job, {found.panel}) for found in benches_of(self.part.facts) if found.job is not None]
        for job, panels in (*((each.job, set[str]()) for each in taught()), *of_facts):
            wanted = job.wanted(self.session.state, frozenset(panels))
            if wanted is None or not self._planning:
                continue
            for found in _found(job, wanted.inputs) if _can_come_again(wanted.inputs) else job.run(wanted.inputs):
                if found is not None:
                    self.session.apply(Deliver(job, wanted.inputs, found), self.time)

    def act(self, action: actions.Action) -> str:
        """Do an action of a solution; return the reason of a refusal, or ""."""
        if isinstance(action, actions.Wait):
            self.time += action.seconds
            return ""
        try:
            return next(filter(None, (self.do(command) for command in self._commands(action))), "")
        except ContentError as error:
            return f"{error.key}: {error.problem}"

    def _commands(self, action: actions.Action) -> Iterator[Command]:
        if isinstance(action, actions.PlayFilm):
            yield OpenClip(action.name)
            yield Seek(0.0)
            yield Seek(duration(self.session.state))
        elif isinstance(action, actions.TypeAnswer):
            yield Answer(action.text)
        else:
            yield from commands_of(action, self.session.state)


@lru_cache(maxsize=KEPT)
def _found(job: Job, inputs: Hashable) -> tuple[Any, ...]:
    """Return all that a job finds: steps and variants ask for the same work again and again."""
    return tuple(job.run(inputs))


def _can_come_again(inputs: object) -> bool:
    """Return whether it can be said that inputs come again."""
    try:
        hash(inputs)
    except TypeError:
        return False
    return True


def problems(key: str, variant: int = 0) -> list[Problem]:
    """Return the mistakes of a lesson: played by its solution, with its wrong answers, and with random states.

    Parameters
    ----------
    key : str
    variant : int

    Raises
    ------
    UnknownName, ContentError
        There is no such lesson, or its file cannot be used.
    """
    lesson = find_lesson(key, variant)
    player = Player(lesson)
    met_by_next = _met_by_next(lesson)
    if player.refused:
        return [Problem(1, lesson.steps[0].line, f"the lesson cannot be opened: {player.refused}")]
    found = []
    for i, step in enumerate(lesson.steps):
        if refused := player.go_to(i):
            found.append(Problem(i + 1, step.line, f"it cannot be shown: {refused}"))
            continue
        begun = player.session.state
        says = (
            *_before(player, i in met_by_next),
            *_played(player, i),
            *_wrong_answers(lesson, i),
            *_wrong_states(lesson, i, begun),
        )
        found += [Problem(i + 1, step.line, text) for text in (*says, *_by_chance(lesson, i, begun))]
    return found


def check_at(key: str, q: ArrayLike, step: int = 1, variant: int = 0) -> tuple[bool, str]:
    """Return whether joint values meet the check of a step, and what the lesson says, as plain text.

    All else is as when the lesson begins.

    Parameters
    ----------
    key : str
    q : array_like, shape (n,)
        Radians and metres.
    step : int
        Step, from 1.
    variant : int

    Raises
    ------
    UnknownName, ContentError
        There is no such lesson, or its file cannot be used.
    InputError
        There is no such step, or nothing to check in it; q is of another shape or outside the joint limits.
    """
    lesson = find_lesson(key, variant)
    if whole_number(step, "step", 1) > len(lesson.steps):
        raise InputError(f"step: expected 1 to {len(lesson.steps)}, got {step}")
    check, arm = lesson.steps[step - 1].check, lesson.robot_used.arm
    if check is None:
        checked = ", ".join(str(i + 1) for i, each in enumerate(lesson.steps) if each.check is not None)
        raise InputError(f"step: nothing is checked in step {step} of {key!r}; steps with a check: {checked or 'none'}")
    values = finite_floats(q, "q", (arm.n,), f"{arm.n} joint values in radians and metres")
    if not arm.within_limits(values):
        raise InputError(f"q: outside the joint limits of {lesson.robot_used.name}: {outside(arm, values)}")
    seen = _seen_at(_at_start(lesson), values)
    if check.facts:
        seen = replace(seen, facts=FactsAt(Player(lesson, planning=False).session.state, check.facts)(values))
    met, says = check.judge(seen)
    return met, plain(says)


@lru_cache(maxsize=8)
def _at_start(lesson: Lesson) -> Observation:
    """Return the observation at the beginning of a lesson, without any planned motion."""
    return observed(Player(lesson, planning=False).session.state)


def _before(player: Player, met_by_next: bool) -> Iterator[str]:
    """Yield a mistake when a step is done before anything is done in it."""
    if _is_met(player):
        yield "its check is met already when the step begins"
    elif met_by_next:
        yield "its check is met already when nothing was done in the steps before: give it a block 'start'"


def _is_met(player: Player) -> bool:
    step = player.part.step
    return step is not None and step.check is not None and check_line(player.session.state)[0]


def _met_by_next(lesson: Lesson) -> set[int]:
    """Return the steps, from 0, whose check is met for a student who has only pressed *Next*."""
    player = Player(lesson, planning=False)
    return {i for i in range(len(lesson.steps)) if player.go_to(i) == "" and _is_met(player)}


def _played(player: Player, i: int) -> Iterator[str]:
    step, lesson = player.lesson.steps[i], player.lesson
    if step.check is not None:
        for panel in step.check.panels:  # anybody can open them at any time, so solutions do not say it
            player.do(OpenPanel(panel))
    if step.check is not None and not step.solution and not check_line(player.session.state)[0]:
        yield "it has a check and no block 'solution'"
        return
    for number, action in enumerate(step.solution, start=1):
        refused = player.act(action)
        if refused:
            yield f"action {number} of its solution is refused: {refused}"
            return
    if step.question is not None and not any(isinstance(each, actions.TypeAnswer) for each in step.solution):
        player.do(Answer(step.question.right_answer))
    if step.question is not None and player.part.name not in player.part.progress.right:
        verdict = player.part.verdict
        yield f"its own answer is not right: {plain(verdict.says) if verdict else 'not taken'}"
    if i not in player.part.progress.passed(lesson) and step.check is not None:
        met, says = check_line(player.session.state)
        if not met:
            yield f"its solution does not meet its check: {plain(says) or 'the arm is no longer that of the lesson'}"


def _wrong_answers(lesson: Lesson, i: int) -> Iterator[str]:
    question = lesson.steps[i].question
    for number, wrong in enumerate(question.wrong if question else (), start=1):
        assert question is not None
        verdict = question.judge(wrong.typed)
        if verdict.right or verdict.says != wrong.says:
            yield f"question.wrong[{number}] ({wrong.typed}) gets another verdict: {plain(verdict.says)}"


def _wrong_states(lesson: Lesson, i: int, begun: State) -> Iterator[str]:
    check = lesson.steps[i].check
    for number, wrong in enumerate(check.wrong if check else (), start=1):
        assert check is not None
        if wrong.q is None:
            if _of_configuration(wrong.check):
                yield f"check.wrong[{number}] needs q_deg, q_m or q_deg_m: a configuration that gets its verdict"
            continue
        seen = _seen_at(_at_start(lesson), wrong.q)
        met, says = check.judge(replace(seen, facts=FactsAt(begun, check.facts)(wrong.q)))
        if met or says != wrong.says:
            yield f"check.wrong[{number}] gets another verdict at its own configuration: {plain(says)}"


def _of_configuration(check: Check) -> bool:
    """Return whether joint values alone can meet a check."""
    if isinstance(check, AllOf):
        return all(_of_configuration(each) for each in check.checks)
    of_more = any(getattr(check, name, False) for name in ("of_table", "observes", "facts"))
    return not of_more and not isinstance(check, TargetAt | LookedAt)


def _by_chance(lesson: Lesson, i: int, begun: State) -> Iterator[str]:
    check = lesson.steps[i].check
    if check is None:
        return
    facts_at = FactsAt(begun, check.facts)
    count = sum(check.check.is_met(replace(seen, facts=facts_at(seen.q))) for seen in random_states(lesson))
    if count > MOST_BY_CHANCE:
        harder = "make it harder, with smaller tolerances or narrower bounds"
        yield f"{count} of {RANDOM_STATES} random states meet its check: {harder}"


def random_states(lesson: Lesson, count: int = RANDOM_STATES) -> Iterator[Observation]:
    """Yield seeded random states of the lesson's arm, inside its limits, with everything else as at its start."""
    start = _at_start(lesson)
    limits, rng = start.arm.limits, np.random.default_rng(0)
    for q in rng.uniform(limits[:, 0], limits[:, 1], (count, start.arm.n)):
        yield _seen_at(start, q)


def _seen_at(start: Observation, q: NDArray[np.float64]) -> Observation:
    return Observation.of(start.arm, q, target=start.target, switches=start.switches, panel=start.panel)
