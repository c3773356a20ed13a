"""Common parts of choosing an example: it is looked up, its arm is put in place, and a clip is closed."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Generic, TypeVar

from armlab.content.robots import catalogue
from armlab.registry import Registry
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline, clips
from armlab.session.state import State

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

P = TypeVar("P", bound="DataclassInstance")


@dataclass(frozen=True)
class PartExample(Generic[P]):
    """An example that is one part of the state.

    Attributes
    ----------
    key, title : str
    part : Part
    says : str
        Sentence on what to look at.
    """

    key: str
    title: str
    part: P
    says: str


def part_examples(*examples: PartExample[P]) -> Registry[PartExample[P]]:
    """Return examples by key, in the order given; the field ``example`` of each part is set to its key."""
    return Registry("example", (replace(one, part=replace(one.part, example=one.key)) for one in examples))


def on_arm(state: State, key: str) -> State:
    """Return the state with the arm of this key, which notes what it replaces; the same state when it is there."""
    robot, before = catalogue()[key], state[RobotPart].robot
    if robot is before:
        return state
    state = state.with_robot(robot)
    return state.replace(replace(state[RobotPart], replaced=before.name))


def with_clip_closed(state: State) -> State:
    """Return the state with no film or run open."""
    timeline = state[Timeline]
    if not timeline.clip:
        return state
    return clips()[timeline.clip].closed(state).replace(replace(timeline, clip="", time=0.0, playing=False))
