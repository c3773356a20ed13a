"""Commands of frames: they are added, removed, named, given in another parent, moved and turned."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.benches.frames.chain.state import (
    FARTHEST,
    MOST_FRAMES,
    WORLD,
    Chain,
    Frame,
    Triple,
    checked_name,
    triple,
)
from armlab.benches.frames.chain.tree import line_of, moved, pose_in, poses
from armlab.errors import InputError
from armlab.kin.nearest import nearest_rotation
from armlab.kin.rotations import euler_zyx
from armlab.registry import known_name
from armlab.session.fields import put
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Command, State

Floats = NDArray[np.float64]

AXES, ANGLES = ("x", "y", "z"), ("roll", "pitch", "yaw")

LETTERS = "ABCDEFGHIJ"
"""Names for new frames, of which the first free one is taken."""

STEP: Triple = (0.3, 0.0, 0.1)
"""Position of a new frame in its parent, metres."""

SAME = 1e-12
"""Difference of an entry from the typed one, below which an orientation is the one that was typed."""


def angles_of(R: Floats) -> Triple:
    """Return roll, pitch and yaw of an orientation (3, 3), radians."""
    yaw, pitch, roll = np.asarray(euler_zyx(R)[0], dtype=float).tolist()
    return roll + 0.0, pitch + 0.0, yaw + 0.0


def changed(state: State, **values: Any) -> State:
    """Return the state with fields of the chain set, and no example in place."""
    return put(state, state[Chain].with_values(values).without_example())


def _place(part: Chain, name: str, T: Floats) -> tuple[Frame, ...]:
    """Return the frames with one at a pose (4, 4) in its parent, with the orientation as it was if that is the same."""
    frame = part.named(name)
    position = triple(T[:3, 3].tolist(), f"{name}: position", FARTHEST, "m")
    if np.abs(T[:3, :3] - frame.R).max() < SAME:
        return part.with_frame(name, position=position)
    return part.with_frame(name, position=position, angles=angles_of(T[:3, :3]), matrix=None)


def with_one(values: Sequence[float], index: int, value: float, names: Sequence[str]) -> Triple:
    """Return three values with one replaced, counted from 0; `InputError` for any other index."""
    if not 0 <= index < len(values):
        raise InputError(f"index: expected 0 to 2 for {', '.join(names)}, got {index}")
    x, y, z = (value if k == index else each for k, each in enumerate(values))
    return x, y, z


@dataclass(frozen=True)
class AddFrame(Command):
    """Add a frame that is given in a parent, with the next free letter as its name.

    Parameters
    ----------
    parent : str
        Name of a frame, or w for the world.
    """

    parent: str = WORLD
    label: ClassVar[str] = "new frame"

    def apply(self, state: State) -> State:
        """Return the state with the frame, which is selected; `InputError` if there are too many."""
        part = state[Chain]
        known_name("parent", self.parent, part.names)
        if len(part.frames) >= MOST_FRAMES:
            raise InputError(f"frames: expected at most {MOST_FRAMES} besides the world; remove one first")
        name = next(letter for letter in LETTERS if letter not in part.names)
        return changed(state, frames=(*part.frames, Frame(name, self.parent, STEP)), selected=name)


@dataclass(frozen=True)
class RemoveFrame(Command):
    """Remove a frame that is nobody's parent."""

    name: str
    label: ClassVar[str] = "removed frame"

    def apply(self, state: State) -> State:
        """Return the state without the frame; `InputError` if another one is given in it.

        The point, if it was given in it, is then given in its parent, where it is.
        """
        part = state[Chain]
        frame = part.named(self.name)
        if children := part.children(self.name):
            raise InputError(
                f"{self.name}: {' and '.join(children)} {'is' if len(children) == 1 else 'are'} given in it; choose "
                "another parent there first, or remove what hangs on it"
            )
        values: dict[str, Any] = {"frames": tuple(each for each in part.frames if each.name != self.name)}
        if part.given == self.name:
            values |= {"given": frame.parent, "point": moved(frame.T, part.point).tolist()}
        values |= {what: frame.parent for what in ("reference", "frame") if getattr(part, what) == self.name}
        if part.selected == self.name:
            values["selected"] = "" if frame.parent == WORLD else frame.parent
        return changed(state, **values)


@dataclass(frozen=True)
class NameFrame(Command):
    """Give a frame another name: a letter, and up to three letters or digits more."""

    name: str
    new: str
    label: ClassVar[str] = "name of a frame"

    def apply(self, state: State) -> State:
        """Return the state with the name, wherever it stands."""
        part, new = state[Chain], checked_name(self.new.strip())
        part.named(self.name)
        if new != self.name and new in part.names:
            raise InputError(f"name: there is a frame {new} already")

        def named(name: str) -> str:
            return new if name == self.name else name

        frames = tuple(replace(each, name=named(each.name), parent=named(each.parent)) for each in part.frames)
        others = {what: named(getattr(part, what)) for what in ("given", "reference", "frame", "selected")}
        return changed(state, frames=frames, **others)


@dataclass(frozen=True)
class SetParent(Command):
    """Give a frame in another parent; it stays where it is in the world."""

    name: str
    parent: str
    label: ClassVar[str] = "parent of a frame"

    def apply(self, state: State) -> State:
        """Return the state with the parent; `InputError` if that hangs on the frame itself."""
        part = state[Chain]
        if part.named(self.name).parent == self.parent:
            return state
        if self.name in line_of(part, self.parent):
            said = "the frame itself" if self.parent == self.name else f"{self.parent}, which hangs on it"
            raise InputError(f"{self.name}: expected a parent that does not hang on the frame, got {said}")
        T = pose_in(part, self.parent, poses(part)[self.name])
        given = replace(part.named(self.name), parent=self.parent)
        frames = tuple(given if each.name == self.name else each for each in part.frames)
        ordered = part.with_values({"frames": _parents_first(frames)})
        return changed(state, frames=_place(ordered, self.name, T))


def _parents_first(frames: Iterable[Frame]) -> tuple[Frame, ...]:
    """Return the frames in their order as far as each stands behind its parent."""
    left, found = list(frames), list[Frame]()
    while left:
        known = {WORLD, *(each.name for each in found)}
        found.append(next(each for each in left if each.parent in known))
        left.remove(found[-1])
    return tuple(found)


@dataclass(frozen=True)
class SetFramePosition(Command):
    """Set one coordinate of a frame in its parent, metres; axes from 0 for x."""

    name: str
    axis: int
    value: float
    label: ClassVar[str] = "position of a frame"

    def apply(self, state: State) -> State:
        """Return the state with the frame there."""
        part = state[Chain]
        position = with_one(part.named(self.name).position, self.axis, self.value, AXES)
        return PlaceFrame(self.name, position).apply(state)


@dataclass(frozen=True)
class PlaceFrame(Command):
    """Set the position of a frame in its parent, metres, and roll, pitch and yaw, radians; what is left out stays."""

    name: str
    position: tuple[float, ...] | None = None
    angles: tuple[float, ...] | None = None
    label: ClassVar[str] = "pose of a frame"

    def apply(self, state: State) -> State:
        """Return the state with the frame there."""
        part = state[Chain]
        values: dict[str, Any] = {}
        if self.position is not None:
            values["position"] = triple(self.position, f"{self.name}: position", FARTHEST, "m")
        if self.angles is not None:
            angles = triple(self.angles, f"{self.name}: angles", MOST_TURNED, "rad")
            values |= {"angles": angles, "matrix": None}
        return changed(state, frames=part.with_frame(self.name, **values))


@dataclass(frozen=True)
class SetFrameAngle(Command):
    """Set roll (0), pitch (1) or yaw (2) of a frame in its parent, radians."""

    name: str
    index: int
    value: float
    label: ClassVar[str] = "orientation of a frame"
    places: ClassVar[Mapping[str, tuple[str, ...]]] = {"index": ("roll", "pitch", "yaw")}

    def apply(self, state: State) -> State:
        """Return the state with the frame turned so."""
        angles = with_one(state[Chain].named(self.name).angles, self.index, self.value, ANGLES)
        if abs(self.value) > MOST_TURNED:
            raise InputError(
                f"{ANGLES[self.index]}: expected at most {math.degrees(MOST_TURNED):g}° either way, got "
                f"{math.degrees(self.value):.6g}°"
            )
        return PlaceFrame(self.name, angles=angles).apply(state)


@dataclass(frozen=True)
class SetFrameMatrix(Command):
    """Set the nine numbers of the orientation of a frame in its parent, row by row; the nearest rotation is taken."""

    name: str
    values: tuple[float, ...]
    label: ClassVar[str] = "orientation of a frame"

    def apply(self, state: State) -> State:
        """Return the state with the frame turned so; `InputError` for a matrix without one nearest rotation."""
        if len(self.values) != 9:
            raise InputError(f"matrix: expected 9 numbers, row by row, got {len(self.values)}")
        typed = np.reshape(np.array(self.values, dtype=float), (3, 3))
        nearest = nearest_rotation(typed, "matrix")
        if not nearest.only:
            raise InputError(
                "matrix: expected one with a single nearest rotation, whose columns are not zero and not parallel; of "
                f"this one several rotations are at the same distance {nearest.distance:.3g}"
            )
        matrix = tuple(tuple(row) for row in typed.tolist())
        angles = angles_of(nearest.rotation)
        return changed(state, frames=state[Chain].with_frame(self.name, angles=angles, matrix=matrix))


@dataclass(frozen=True)
class SetFrameEntry(Command):
    """Set one entry of the orientation of a frame in its parent, from 0; the nearest rotation is taken."""

    name: str
    row: int
    column: int
    value: float
    label: ClassVar[str] = "orientation of a frame"

    def apply(self, state: State) -> State:
        """Return the state with the rotation that is nearest to the matrix with this entry."""
        for index, what in ((self.row, "row"), (self.column, "column")):
            if not 0 <= index < 3:
                raise InputError(f"{what}: expected 0 to 2, got {index}")
        values = shown_matrix(state[Chain].named(self.name)).copy()
        values[self.row, self.column] = self.value
        return SetFrameMatrix(self.name, tuple(values.ravel().tolist())).apply(state)


def shown_matrix(frame: Frame) -> Floats:
    """Return the matrix of the orientation as it was typed, or else the rotation, (3, 3)."""
    return frame.R if frame.matrix is None else np.array(frame.matrix)


@dataclass(frozen=True, eq=False)
class DragFrame(Command):
    """Drag the handle of a frame; this is one event of a drag.

    Parameters
    ----------
    name : str
    pose : ndarray, shape (4, 4)
        In the world.
    drag : object
        Which drag it belongs to; one drag is one step of undo.
    """

    name: str
    pose: NDArray[np.floating]
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "drag of a frame"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragFrame, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the frame there."""
        part = state[Chain]
        T = pose_in(part, part.named(self.name).parent, np.asarray(self.pose, dtype=np.float64))
        return changed(state, frames=_place(part, self.name, T))
