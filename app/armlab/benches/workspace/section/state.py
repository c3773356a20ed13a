"""The section of the workspace: what colours it, which slice is drawn in the scene, and what was found."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

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
"""No slice; the half plane through the axis of joint 1, or the plane across it where it slides; across an axis of
frame 0."""

PLACE = "place of the slice"

FARTHEST = 100.0
"""Metres or radians; a slice farther away is a slip of the pen."""


@dataclass(frozen=True, eq=False)
class SectionView(FieldPart):
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

    colour: str = choice("colour", REACH, COLOURS)
    slice: str = choice("slice", "axis", SLICES)
    offset: float = number("", PLACE, 0.0, -FARTHEST, FARTHEST, "m", kept="")
    turn: float | None = number("", PLACE, None, -FARTHEST, FARTHEST, kept="")
    found: Found | None = None


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
        turned = part.slice == "axis"
        unit = "rad" if turned and state[Joints].arm.revolute[0] else "m"
        if self.at is not None and not abs(self.at) <= FARTHEST:
            raise InputError(f"{PLACE}: expected at most {FARTHEST:g} {unit}, got {self.at:.10g} {unit}")
        return put(state, part.with_values({"turn": self.at} if turned else {"offset": self.at or 0.0}))


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
