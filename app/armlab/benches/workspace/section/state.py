"""The section of the workspace: what colours it, which slice is drawn in the scene, and what was found."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from armlab.benches.workspace.section.found import REACH, Found, Question
from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.workspace.measures import MEASURES
from armlab.kin.workspace.nearest import with_first
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import brought_to
from armlab.session.state import Command, Json, Part, PartType, State

COLOURS: dict[str, str] = {REACH: "reach", **{key: measure.title for key, measure in MEASURES.items()}}

SLICES = ("none", "axis", "x", "y", "z")
"""No slice; the half plane through the axis of joint 1, or the plane across it where it slides; across an axis of
frame 0."""

FARTHEST = 100.0
"""Metres or radians; a slice farther away is a slip of the pen."""


@dataclass(frozen=True, eq=False)
class SectionView(Part):
    """How the section is looked at, and what was found.

    Attributes
    ----------
    colour : str
        Key of `COLOURS`.
    slice : str
        One of `SLICES`.
    offset : float
        Of a slice across an axis from the origin of frame 0, metres.
    turn : float or None
        Where the slice through (or across) the axis of joint 1 stands, rad or m; None where the tool is.
    found : Found or None
        Not saved.
    """

    key: ClassVar[str] = "section"
    kept_by_undo: ClassVar[bool] = True

    colour: str = REACH
    slice: str = "axis"
    offset: float = 0.0
    turn: float | None = None
    found: Found | None = None

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the half plane in which the tool is, in one colour."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep how it is looked at; what was found is of another arm."""
        return replace(self, found=None, offset=0.0, turn=None)

    def to_json(self) -> Json:
        """Write how it is looked at."""
        return {"colour": self.colour, "slice": self.slice, "offset": self.offset, "turn": self.turn}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; raises when it is not usable."""
        turn = data["turn"]
        part = cls(data["colour"], data["slice"], float(data["offset"]), None if turn is None else float(turn))
        _checked(part)
        return part


PART = PartType(SectionView, order=121)


def found_of(state: State) -> Found | None:
    """Return what was found of the present arm."""
    found = state[SectionView].found
    return found if found is not None and found.arm is state[Joints].arm else None


def question_of(state: State) -> Question | None:
    """Return what is still to be found; None for nothing."""
    part, found = state[SectionView], found_of(state)
    if found is not None and found.coloured and found.colour == part.colour:
        return None
    known = found if found is not None and found.finished else None
    return Question(state[Joints].arm, part.colour, known)


def _checked(part: SectionView, turn_unit: str = "rad or m") -> SectionView:
    if part.colour not in COLOURS:
        raise UnknownName("colour", part.colour, COLOURS)
    if part.slice not in SLICES:
        raise UnknownName("slice", part.slice, SLICES)
    for value, unit in ((part.offset, "m"), (part.turn or 0.0, turn_unit)):
        if not (math.isfinite(value) and abs(value) <= FARTHEST):
            raise InputError(f"place of the slice: expected at most {FARTHEST:g} {unit}, got {value:.10g} {unit}")
    return part


@dataclass(frozen=True)
class LookAtSection(Command):
    """Choose the colour or the slice; None leaves as it is."""

    colour: str | None = None
    slice: str | None = None
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice made; `InputError` where there is no such choice."""
        part = state[SectionView]
        chosen = replace(part, colour=self.colour or part.colour, slice=self.slice or part.slice)
        same = (chosen.colour, chosen.slice) == (part.colour, part.slice)
        return state if same else state.replace(_checked(chosen))


@dataclass(frozen=True)
class PlaceSlice(Command):
    """Put the slice somewhere: a hand on its handle, or a typed number; only the newest counts.

    Parameters
    ----------
    at : float or None
        Metres from the origin of frame 0; of the slice through the axis of joint 1 radians about it, or metres along
        it, None for where the tool is.
    """

    at: float | None
    snapshot: ClassVar[bool] = True
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the slice there; `InputError` where that is far away."""
        part = state[SectionView]
        if part.slice == "axis":
            unit = "rad" if state[Joints].arm.revolute[0] else "m"
            return state.replace(_checked(replace(part, turn=self.at), unit))
        return state.replace(_checked(replace(part, offset=self.at or 0.0)))


@dataclass(frozen=True)
class GoInSection(Command):
    """Bring the tool to a place of the section, or as near as it can come; joint 1 moves as little as that allows.

    Parameters
    ----------
    u, v : float
        Metres; see `armlab.kin.workspace.first_joint`.
    """

    u: float
    v: float
    label: ClassVar[str] = "move in the section"

    def apply(self, state: State) -> State:
        """Return the state with the arm there; `InputError` while nothing is known of the workspace."""
        found = _finished(state)
        joint, section = found.section.joint, found.section
        s = float(joint.split(state[Joints].tool_pose[:3, 3])[2])
        point = joint.join([self.u, self.v, s])
        if not section.holds(point):
            # Where joint 1 cannot bring this place to where the tool is: as near to that as it can.
            i, j = np.nonzero(section.filled)
            k = int(np.argmin((section.u[i] - self.u) ** 2 + (section.v[j] - self.v) ** 2))
            q = with_first(joint, section.at(i[[k]], j[[k]]), point)
            point = joint.join([self.u, self.v, joint.split(joint.arm.position(q[0]))[2]])
        return _gone(state, section.nearest(point))


@dataclass(frozen=True)
class GoToPoint(Command):
    """Bring the tool to a point of the world, metres, or as near as it can come."""

    point: tuple[float, float, float]
    label: ClassVar[str] = "move in the workspace"

    def apply(self, state: State) -> State:
        """Return the state with the arm there; `InputError` while nothing is known of the workspace."""
        return _gone(state, _finished(state).section.nearest(self.point))


def _finished(state: State) -> Found:
    found = found_of(state)
    if found is None or not found.finished:
        raise InputError("the section of the workspace is not known yet")
    return found


def _gone(state: State, q: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> State:
    """Return the state with the arm at a configuration; joints that do not move the point stay, held ones as well."""
    joints = state[Joints]
    moving = {0, *_finished(state).section.joint.moving}
    wanted = np.array([q[i] if i in moving else joints.q[i] for i in range(joints.arm.n)])
    return brought_to(state, np.asarray(joints.arm.clip(wanted)))
