"""What choosing an example has in common on all benches: it is looked up, its arm comes, what is played is closed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TypeVar

from armlab.content.robots import catalogue
from armlab.errors import UnknownName
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline, clips
from armlab.session.state import State

T = TypeVar("T")


def example_of(examples: Mapping[str, T], key: object) -> T:
    """Return an example by key; `UnknownName` with those there are."""
    if not isinstance(key, str) or key not in examples:
        raise UnknownName("example", key, examples)
    return examples[key]


def on_arm(state: State, key: str) -> State:
    """Return the state with the arm of this key; the same state where it is there as its file has it."""
    robot = catalogue()[key]
    return state if state[RobotPart].robot is robot else state.with_robot(robot)


def with_clip_closed(state: State) -> State:
    """Return the state without a film or run in the bar."""
    timeline = state[Timeline]
    if not timeline.clip:
        return state
    return clips()[timeline.clip].closed(state).replace(replace(timeline, clip="", time=0.0, playing=False))
