"""Contributions of a bench to lessons: observations for checks and live values, and actions for solutions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

from armlab.content.actions import Action
from armlab.content.lesson import Lesson, Step
from armlab.content.robots import Robot
from armlab.plugins import discover_in_benches
from armlab.session.job import Job
from armlab.session.state import Command, Json, Part, State


@dataclass(frozen=True)
class Taught:
    """The constant ``TAUGHT`` of the module ``lesson`` of a page.

    Parameters
    ----------
    key : str
        Name of the field of `Observation` that holds the facts.
    part : type
        Type of the part from which the facts follow; it is kept as evidence under its own key.
    clip : str
        Key of the film or run in which they can be watched.
    job : Job
        The work that finds them.
    asked : callable
        ``asked(lesson, step, met) -> bool``: whether a step looks at them, in a text, or in its check until it is met.
    checked : callable
        ``checked(step) -> bool``: whether the check of a step looks at them.
    changed : callable
        ``changed(before, now) -> bool``: whether they are others now, worked out or not.
    ended : callable
        ``ended(before, now) -> bool``: whether what has come to its end on the timeline is what they tell of.
    seen : callable
        ``seen(state, played)`` returns them; ``played`` tells whether the clip was played to its end, as it is.
    again : callable
        ``again(data, told, robot)`` returns them worked out again from the part written down, to what was told of them;
        `InputError` when the evidence is not usable.
    commands : callable
        ``commands(action, state)`` yields what an action of a solution does to the bench; nothing for one of another.
    """

    key: str
    part: type[Part]
    clip: str
    job: Job
    asked: Callable[[Lesson, Step, bool], bool]
    checked: Callable[[Step], bool]
    changed: Callable[[State, State], bool]
    ended: Callable[[State, State], bool]
    seen: Callable[[State, bool], Any]
    again: Callable[[Json, Any, Robot], Any]
    commands: Callable[[Action, State], Iterator[Command]]


@cache
def taught() -> tuple[Taught, ...]:
    """Return the contributions of all benches."""
    return tuple(discover_in_benches("lesson", "TAUGHT", Taught).values())
