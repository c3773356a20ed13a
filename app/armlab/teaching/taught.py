"""Contributions of a bench to lessons: what it tells of itself, and the commands of the actions it adds."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

from armlab.content.actions import Action
from armlab.content.lesson import Lesson, Step
from armlab.content.observation import KEYS, Told
from armlab.content.robots import Robot
from armlab.content.vocabulary import vocabularies
from armlab.errors import PluginError
from armlab.plugins import discover_in_benches
from armlab.session.job import Job
from armlab.session.state import Command, Json, Part, State

FACTS = "facts"
"""Key in evidence of the data from which facts are computed."""


@dataclass(frozen=True)
class Taught:
    """The constant ``TAUGHT`` of the module ``lesson`` of a page.

    Parameters
    ----------
    key : str
        Its key in `Observation.benches`, and of its `armlab.content.vocabulary.Vocabulary`; evidence has it beside the
        key of the part, so that the two differ.
    part : type
        Type of the part from which the facts follow; it is kept as evidence under its own key.
    clip : str
        Key of the film or run in which they can be watched.
    job : Job
        The work that finds them.
    changed : callable
        ``changed(before, now) -> bool``: whether they are others now, worked out or not.
    ended : callable
        ``ended(before, now) -> bool``: whether what has come to its end on the timeline is what they tell of.
    seen : callable
        ``seen(state, played)`` returns them; ``played`` tells whether the clip was played to its end, as it is.
    read : callable
        ``read(data, where)`` returns them as evidence has them; `InputError` when it is not usable.
    again : callable
        ``again(data, told, robot)`` returns them worked out again from the part written down, to what was told of them;
        `InputError` when the evidence is not usable.
    commands : callable
        ``commands(action, state)`` yields what an action of a solution does to the bench; nothing for one of another.
    mistakes : callable
        ``mistakes(action)`` yields what is wrong with an action, beyond what reading it has found.
    """

    key: str
    part: type[Part]
    clip: str
    job: Job
    changed: Callable[[State, State], bool]
    ended: Callable[[State, State], bool]
    seen: Callable[[State, bool], Told]
    read: Callable[[object, str], Told]
    again: Callable[[Json, Any, Robot], Told]
    commands: Callable[[Action, State], Iterator[Command]]
    mistakes: Callable[[Action], Iterator[str]]

    def __post_init__(self) -> None:
        """Refuse a key under which evidence has something else."""
        taken = (*KEYS, FACTS, self.part.key)
        if self.key in taken:
            raise PluginError(f"TAUGHT: expected a key that evidence has not yet, got {self.key!r}")

    def is_checked(self, step: Step) -> bool:
        """Return whether the check of a step looks at the bench."""
        return step.check is not None and self.key in step.check.observes

    def is_asked(self, lesson: Lesson, step: Step, met: bool) -> bool:
        """Return whether a step looks at the bench, in a text, or in its check until that is met."""
        shown = vocabularies()[self.key].live.keys() if self.key in vocabularies() else ()
        return (self.is_checked(step) and not met) or any(name in shown for name in (*step.live, *lesson.live))


@cache
def taught() -> tuple[Taught, ...]:
    """Return the contributions of all benches."""
    return tuple(discover_in_benches("lesson", "TAUGHT", Taught).values())
