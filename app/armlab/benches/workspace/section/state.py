"""The section of the workspace: the measure that colours it, the slice drawn in the scene, and the results."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from armlab.benches.workspace.cloud.state import FARTHEST
from armlab.benches.workspace.section.found import REACH, Found, Question
from armlab.errors import InputError
from armlab.kin.workspace.measures import MEASURES
from armlab.kin.workspace.nearest import with_first
from armlab.session.fields import FieldPart, choice, number, put
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import brought_to
from armlab.session.state import Command, PartType, State

COLOURS: dict[str, str] = {REACH: "reach", **{key: measure.title for key, measure in MEASURES.items()}}

SLICES = ("none", "axis", "x", "y", "z")
"""Kinds of slice: none; the half plane through the axis of joint 1, or the plane across it if it slides; planes across
the axes of frame 0."""

PLACE = "place of the slice"

MOST_TURNED = 100.0
"""Largest angle of a slice through the axis of joint 1, radians."""


@dataclass(frozen=True, eq=False)
class SectionView(FieldPart):
    """The settings of the section, and its results.

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

    colour: str = choice("colour", REACH, COLOURS)
    slice: str = choice("slice", "axis", SLICES)
    offset: float = number("", PLACE, 0.0, -FARTHEST, FARTHEST, "m", kept="")
    turn: float | None = number("", PLACE, None, -FARTHEST, FARTHEST, kept="")
    found: Found | None = None


PART = PartType(SectionView, order=121)


def found_of(state: State) -> Found | None:
    """Return the results for the present arm."""
    found = state[SectionView].found
    return found if found is not None and found.arm is state[Joints].arm else None


def question_of(state: State) -> Question | None:
    """Return the request for the missing results, or None."""
    part, found = state[SectionView], found_of(state)
    if found is not None and found.coloured and found.colour == part.colour:
        return None
    known = found if found is not None and found.finished else None
    return Question(state[Joints].arm, part.colour, known)


@dataclass(frozen=True)
class PlaceSlice(Command):
    """Place the slice, by a drag of its handle or a typed number; only the newest event counts.

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
        """Return the state with the slice there; `InputError` if that is too far away."""
        part = state[SectionView]
        turned = part.slice == "axis"
        turns = turned and bool(state[Joints].arm.revolute[0])
        most, unit = (MOST_TURNED, "rad") if turns else (FARTHEST, "m")
        if self.at is not None and not abs(self.at) <= most:
            raise InputError(f"{PLACE}: expected at most {most:g} {unit} either way, got {self.at:.10g} {unit}")
        return put(state, part.with_values({"turn": self.at} if turned else {"offset": self.at or 0.0}))


@dataclass(frozen=True)
class GoInSection(Command):
    """Bring the tool to a place of the section, or as near as possible; joint 1 moves as little as that allows.

    Parameters
    ----------
    u, v : float
        Metres; see `armlab.kin.workspace.first_joint`.
    """

    u: float
    v: float
    label: ClassVar[str] = "move in the section"

    def apply(self, state: State) -> State:
        """Return the state with the arm there; `InputError` while the workspace is not known."""
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
    """Bring the tool to a point of the world, metres, or as near as possible."""

    point: tuple[float, float, float]
    label: ClassVar[str] = "move in the workspace"

    def apply(self, state: State) -> State:
        """Return the state with the arm there; `InputError` while the workspace is not known."""
        return _gone(state, _finished(state).section.nearest(self.point))


def _finished(state: State) -> Found:
    found = found_of(state)
    if found is None or not found.finished:
        raise InputError("the section of the workspace is not known yet")
    return found


def _gone(state: State, q: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> State:
    """Return the state with the arm at a configuration; held joints, and those that do not move the point, stay."""
    joints = state[Joints]
    moving = {0, *_finished(state).section.joint.moving}
    wanted = np.array([q[i] if i in moving else joints.q[i] for i in range(joints.arm.n)])
    return brought_to(state, np.asarray(joints.arm.clip(wanted)))
