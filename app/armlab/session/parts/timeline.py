"""The timeline: which film or run is on, where it stands, and how fast it plays.

A `Clip`, found as ``clip.py`` of a bench, is played; one bar plays them all.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from functools import cache
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.plugins import discover_in_benches
from armlab.registry import known_name
from armlab.session.fields import FieldPart, flag, number, own
from armlab.session.pages import tab_of
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, PartType, State

SLOWEST, FASTEST = 0.1, 4.0


@dataclass(frozen=True)
class Clip:
    """The constant ``CLIP`` of ``clip.py`` of a bench.

    Parameters
    ----------
    key, title : str
    duration : callable
        Seconds at normal speed, of a state.
    stops : callable
        Times, rising, at which stepping stops; of a state.
    at : callable
        ``at(state, time) -> State``: what the clip changes besides the time, such as the joints. Pure.
    panel : str
        Key of the panel without which there is nothing to see of it; empty when it moves the arm itself.
    tab : str
        Key of the tab to which a clip that moves the arm belongs. On others its bar is seen once it plays or has been
        played, since the arm then stands where the clip has it.
    closed : callable
        ``closed(state) -> State``: what is put back when the clip is taken off. Pure.
    """

    key: str
    title: str
    duration: Callable[[State], float]
    stops: Callable[[State], tuple[float, ...]]
    at: Callable[[State, float], State]
    panel: str = ""
    tab: str = ""
    closed: Callable[[State], State] = lambda state: state


@cache
def clips() -> dict[str, Clip]:
    """Return all clips by key."""
    return discover_in_benches("clip", "CLIP", Clip)


@dataclass(frozen=True)
class Timeline(FieldPart):
    """The open clip, its time, and whether it plays.

    Attributes
    ----------
    clip : str
        Key of the clip; empty when none is open.
    time : float
        Seconds from its start, at normal speed.
    playing : bool
    speed : float
    loop : bool
    """

    key: ClassVar[str] = "timeline"
    called: ClassVar[str] = "the film"
    kept_by_undo: ClassVar[bool] = True

    # Not a film of its own, as other parts have one, but the one that is on.
    clip: str = own("film", "", lambda key: key if key in clips() else "")  # type: ignore[misc]
    time: float = number("t", "time of the film", 0.0, 0.0, unit="s", kept="edits")
    playing: bool = False
    speed: float = number("", "speed", 1.0, SLOWEST, FASTEST)
    loop: bool = flag("begin again at the end", False)

    def for_robot(self, robot: Robot) -> Self:
        """Return the part for another arm: a clip that moved the arm before is taken off."""
        moved = self.clip and not clips()[self.clip].panel
        return super(Timeline, replace(self, clip="") if moved else self).for_robot(robot)

    def seen(self, panels: Collection[str]) -> bool:
        """Return whether a page with these panels shows the bar of the clip."""
        if not self.clip:
            return False
        clip = clips()[self.clip]
        if clip.panel:
            return clip.panel in panels
        begun = self.playing or self.time > 0.0
        return begun or not clip.tab or clip.tab in map(tab_of, panels)

    def rewound(self, clip: str) -> Self:
        """Return the part at the start of the clip, paused, if this clip is open."""
        return replace(self, time=0.0, playing=False) if clip == self.clip else self

    def after(self, before: State, now: State) -> Self:
        """Return the part with its time inside the clip, which may have changed; paused when a hand moves the arm."""
        if not self.clip:
            return self
        # The clip's own pictures change the time and the joints in one command.
        by_hand = self is before[Timeline] and now[Joints].q is not before[Joints].q
        if self.playing and by_hand and not clips()[self.clip].panel:
            return replace(self, playing=False)
        end = clips()[self.clip].duration(now)
        return replace(self, time=end) if self.time > end else self


PART = PartType(Timeline, order=90)


def duration(state: State) -> float:
    """Return the duration of the open clip in seconds, 0 when there is none."""
    clip = state[Timeline].clip
    return clips()[clip].duration(state) if clip else 0.0


def with_clip(state: State, key: str, playing: bool = False) -> State:
    """Return the state with a clip open at its start, and the changes by the previous one undone."""
    timeline = state[Timeline]
    if timeline.clip not in ("", key):
        state = clips()[timeline.clip].closed(state)
    return _at(state.replace(replace(timeline, clip=key, playing=playing)), 0.0)


@dataclass(frozen=True)
class OpenClip(Command):
    """Open a clip at its start, paused or playing; an empty key closes it."""

    key: str
    play: bool = False
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the clip at its start."""
        if self.key:
            known_name("clip", self.key, clips())
        if state[Timeline].clip == self.key and not self.play:
            return state
        return with_clip(state, self.key, self.play)


@dataclass(frozen=True)
class Play(Command):
    """Play or pause; at the end, play from the start."""

    on: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state playing or paused."""
        timeline = state[Timeline]
        if not timeline.clip or timeline.playing == self.on:
            return state
        playing = state.replace(replace(timeline, playing=self.on))
        return _at(playing, 0.0) if self.on and timeline.time >= duration(state) else playing


@dataclass(frozen=True)
class Seek(Command):
    """Go to a time: the hand on the bar; only the newest counts.

    Parameters
    ----------
    time : float
        Seconds; what lies outside the clip is its nearest end.
    """

    time: float
    snapshot: ClassVar[bool] = True
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state at the time."""
        if not state[Timeline].clip:
            return state
        if not math.isfinite(self.time):
            raise InputError(f"time: expected seconds, got {self.time}")
        return _at(state, min(max(self.time, 0.0), duration(state)))


@dataclass(frozen=True)
class Advance(Command):
    """Show the next picture of the playback.

    It has no effect when a hand has moved or stopped the timeline in the meantime: the hand is right.

    Parameters
    ----------
    since : float
        The time of the picture it follows.
    time : float
    ends : bool
        Whether playing ends here.
    """

    since: float
    time: float
    ends: bool = False
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state at the time, playing or at the end."""
        timeline = state[Timeline]
        if not timeline.playing or timeline.time != self.since:
            return state
        if not math.isfinite(self.time):
            raise InputError(f"time: expected seconds, got {self.time}")
        goes_on = state.replace(replace(timeline, playing=False)) if self.ends else state
        return _at(goes_on, min(max(self.time, 0.0), duration(state)))


@dataclass(frozen=True)
class Step(Command):
    """Go to the next or the previous stop, and pause."""

    forward: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state at the next or the previous stop."""
        timeline = state[Timeline]
        if not timeline.clip:
            return state
        stops = (0.0, *clips()[timeline.clip].stops(state), duration(state))
        near = 1e-6 * (1.0 + stops[-1])
        later = [t for t in stops if t > timeline.time + near]
        earlier = [t for t in stops if t < timeline.time - near]
        paused = state.replace(replace(timeline, playing=False))
        return _at(paused, (min(later, default=stops[-1])) if self.forward else max(earlier, default=0.0))


def _at(state: State, time: float) -> State:
    timeline = state[Timeline]
    moved = state if timeline.time == time else state.replace(replace(timeline, time=time))
    return clips()[timeline.clip].at(moved, time) if timeline.clip else moved
