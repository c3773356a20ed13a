"""What choosing an example has in common on all benches: it is looked up, its arm comes, what is played is closed."""

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
        What to look at, in one sentence.
    """

    key: str
    title: str
    part: P
    says: str


def part_examples(*examples: PartExample[P]) -> Registry[PartExample[P]]:
    """Return examples by key, in the order of the list; each part, which has an ``example``, knows which it is."""
    return Registry("example", (replace(one, part=replace(one.part, example=one.key)) for one in examples))


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
