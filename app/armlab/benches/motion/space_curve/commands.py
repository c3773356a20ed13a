"""Commands for the curve and the turn on the page of geometry."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal

import numpy as np

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.space_curve.laid import FORMULA, Point, kinds, made_curve
from armlab.benches.motion.space_curve.state import (
    CLIP_KEY,
    MOST_POINTS,
    POINTS,
    Shown,
    SpaceCurve,
    curve_of,
)
from armlab.benches.motion.space_curve.turn import rotation_of, written
from armlab.errors import InputError, UnknownName
from armlab.kin.euler import SEQUENCES
from armlab.kin.motion import free_law_types
from armlab.kin.motion.trajectory import times_at
from armlab.registry import known_name
from armlab.session.counted import refuse_beyond
from armlab.session.fields import setting
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import target_pose
from armlab.session.parts.timeline import Timeline, clips
from armlab.session.state import Command, State

End = Literal["A", "B"]

NEXT = 0.2
"""Distance beyond the last waypoint at which one is added, metres."""


@dataclass(frozen=True)
class LookAt(Command):
    """Choose the curve or the turn."""

    shown: Shown
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with that choice."""
        return setting(state, SpaceCurve, {"shown": self.shown})


@dataclass(frozen=True)
class ChooseCurve(Command):
    """Choose another kind of curve through as many waypoints as it can have, with its options at their defaults."""

    key: str
    label: ClassVar[str] = "kind of curve"

    def apply(self, state: State) -> State:
        """Return the state with the curve, through other waypoints if it cannot pass through these."""
        part = state[SpaceCurve]
        if self.key == part.curve.key:
            return state
        chosen = Chosen.of(kinds(), self.key)
        kind = kinds()[self.key]
        if self.key == FORMULA:
            return _curve(state, curve=chosen)
        for known in (part.points, POINTS):
            points = _fitting(known, kind.least, kind.most)
            try:
                made_curve(replace(part, curve=chosen, points=points).question)
            except InputError:
                continue
            return _curve(state, curve=chosen, points=points)
        return _curve(state, curve=chosen, points=_fitting(part.points, kind.least, kind.most))


@dataclass(frozen=True)
class SetPoint(Command):
    """Set one coordinate of a waypoint, metres; waypoint and axis are counted from 0."""

    point: int
    axis: int
    value: float
    label: ClassVar[str] = "waypoint"

    def apply(self, state: State) -> State:
        """Return the state with the waypoint there."""
        points = [list(point) for point in state[SpaceCurve].points]
        if not (0 <= self.point < len(points) and 0 <= self.axis < 3):
            raise InputError(f"waypoint: expected 1 to {len(points)}, got {self.point + 1}")
        points[self.point][self.axis] = self.value
        return _curve(state, points=points)


@dataclass(frozen=True)
class AddPoint(Command):
    """Add a waypoint after the last one, a little aside."""

    label: ClassVar[str] = "added waypoint"

    def apply(self, state: State) -> State:
        """Return the state with one more waypoint."""
        points = state[SpaceCurve].points
        return _curve(state, points=_fitting(points, len(points) + 1, None))


@dataclass(frozen=True)
class RemovePoint(Command):
    """Remove a waypoint, counted from 0."""

    point: int
    label: ClassVar[str] = "removed waypoint"

    def apply(self, state: State) -> State:
        """Return the state without the waypoint."""
        points = state[SpaceCurve].points
        if not 0 <= self.point < len(points):
            raise InputError(f"waypoint: expected 1 to {len(points)}, got {self.point + 1}")
        return _curve(state, points=points[: self.point] + points[self.point + 1 :])


@dataclass(frozen=True)
class TypeFormula(Command):
    """Set the formula of x(s), y(s) or z(s): axis 0, 1 or 2."""

    axis: int
    text: str
    label: ClassVar[str] = "formula of the curve"

    def apply(self, state: State) -> State:
        """Return the state with the formula."""
        texts = list(state[SpaceCurve].formula)
        _refuse_index("axis", self.axis)
        texts[self.axis] = self.text.strip()
        return _curve(state, formula=texts)


@dataclass(frozen=True)
class SetOption(Command):
    """Set an option of the curve ("curve") or of the law ("law"); None restores its default."""

    of: str
    name: str
    value: Any
    label: ClassVar[str] = "option"

    def apply(self, state: State) -> State:
        """Return the state with the option."""
        part = state[SpaceCurve]
        if self.of == "curve":
            kind = kinds()[part.curve.key]
            return _curve(state, curve=part.curve.with_option(kind, self.name, self.value))
        return _curve(state, law=part.law.with_option(free_law_types()[part.law.key], self.name, self.value))


@dataclass(frozen=True)
class ChooseLaw(Command):
    """Choose another timing law, with its options at their defaults."""

    key: str
    label: ClassVar[str] = "timing law"

    def apply(self, state: State) -> State:
        """Return the state with the law."""
        if self.key == state[SpaceCurve].law.key:
            return state
        return _curve(state, law=Chosen.of(free_law_types(), self.key))


@dataclass(frozen=True)
class OwnTimes(Command):
    """Run through the curve as it was made: at constant rate, in the time of its waypoints."""

    label: ClassVar[str] = "times of the waypoints"

    def apply(self, state: State) -> State:
        """Return the state with the constant law of that duration."""
        duration = state.derived(curve_of).given.duration
        if duration is None:
            raise InputError("T: this curve has no times of its own")
        return _curve(state, law=Chosen.of(free_law_types(), "constant"), duration=duration)


@dataclass(frozen=True)
class GoTo(Command):
    """Put the film at the time when it passes a place s from 0 to 1."""

    s: float
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the film there, paused."""
        if not 0.0 <= self.s <= 1.0:
            raise InputError("s: it must be on the curve, from its beginning to its end")
        law = state.derived(curve_of).law
        times = times_at(law, np.array([self.s]))
        timeline = state[Timeline]
        if timeline.clip not in ("", CLIP_KEY):
            state = clips()[timeline.clip].closed(state)
        time = float(times[0]) if len(times) else 0.0
        return state.replace(replace(timeline, clip=CLIP_KEY, time=time, playing=False))


@dataclass(frozen=True)
class WriteIn(Command):
    """Write both orientations, which stay the same, in other angles."""

    axes: str | None = None
    fixed: bool | None = None
    label: ClassVar[str] = "sequence of angles"

    def apply(self, state: State) -> State:
        """Return the state with the sequence."""
        part = state[SpaceCurve]
        axes = part.axes if self.axes is None else self.axes
        known_name("axes", axes, SEQUENCES)
        fixed = part.fixed if self.fixed is None else self.fixed
        ends = (rotation_of(part.axes, part.fixed, angles) for angles in (part.start, part.end))
        start, end = written(axes, fixed, *ends)
        return _curve(state, axes=axes, fixed=fixed, start=start, end=end)


@dataclass(frozen=True)
class SetAngle(Command):
    """Set one angle of R_A or R_B, radians; k is counted from 0."""

    end: End
    k: int
    value: float
    label: ClassVar[str] = "orientation"

    def apply(self, state: State) -> State:
        """Return the state with the angle."""
        angles = list(_angles(state, self.end))
        _refuse_index(f"angle of {self.end}", self.k)
        angles[self.k] = self.value
        return _curve(state, **{"start" if self.end == "A" else "end": angles})


@dataclass(frozen=True)
class TakeOrientation(Command):
    """Set R_A or R_B to the orientation of the tool ("tool") or of the target's handle ("handle")."""

    end: End
    source: str
    label: ClassVar[str] = "orientation"

    def apply(self, state: State) -> State:
        """Return the state with the orientation, written in the present sequence."""
        if self.source not in ("tool", "handle"):
            raise UnknownName("source", self.source, ("tool", "handle"))
        pose = state[Joints].tool_pose if self.source == "tool" else target_pose(state)
        part = state[SpaceCurve]
        R = np.asarray(pose, dtype=np.float64)[:3, :3]
        other = rotation_of(part.axes, part.fixed, _angles(state, "B" if self.end == "A" else "A"))
        start, end = written(part.axes, part.fixed, *((R, other) if self.end == "A" else (other, R)))
        return _curve(state, start=start, end=end)


def _curve(state: State, **fields: Any) -> State:
    return setting(state, SpaceCurve, fields)


def _refuse_index(name: str, k: int) -> None:
    """Raise `InputError` if an index, from 0, is not one of three."""
    refuse_beyond(k, 3, name)


def _angles(state: State, end: End) -> Point:
    if end not in ("A", "B"):
        raise UnknownName("orientation", end, ("A", "B"))
    return state[SpaceCurve].start if end == "A" else state[SpaceCurve].end


def _fitting(points: tuple[Point, ...], least: int, most: int | None) -> tuple[Point, ...]:
    """Return as many of the points as wanted, with further ones after them if they are too few."""
    kept = list(points[: MOST_POINTS if most is None else most])
    for spare in POINTS:
        if len(kept) < least and spare not in kept:
            kept.append(spare)
    while len(kept) < least:
        x, y, z = kept[-1] if kept else (0.0, 0.0, 0.0)
        side = NEXT if len(kept) % 2 else -NEXT
        kept.append((round(x - NEXT, 6), round(y + NEXT, 6), round(z + side, 6)))
    return tuple(kept)
