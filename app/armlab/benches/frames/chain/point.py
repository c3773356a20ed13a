"""Commands of the point in the chain, and of the pair of frames and the frame with the handle that are chosen."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.benches.frames.chain.commands import AXES, changed, with_one
from armlab.benches.frames.chain.state import FARTHEST, POINT, Chain, triple
from armlab.benches.frames.chain.tree import moved, pair, poses
from armlab.kin.transforms import inverse
from armlab.registry import known_name
from armlab.session.fields import put
from armlab.session.state import Command, State


@dataclass(frozen=True)
class SetFramePoint(Command):
    """Set the coordinates of the point in a frame, metres; the point then moves with that frame.

    Parameters
    ----------
    xyz : tuple of 3 float
    frame : str
        Name of a frame, or w for the world; left out: the frame in which the point is given.
    """

    xyz: tuple[float, ...]
    frame: str | None = None
    label: ClassVar[str] = "point"

    def apply(self, state: State) -> State:
        """Return the state with the point there."""
        part = state[Chain]
        frame = part.given if self.frame is None else known_name("frame", self.frame, part.names)
        return changed(state, point=triple(self.xyz, "point", FARTHEST, "m"), given=frame)


@dataclass(frozen=True)
class SetPointCoordinate(Command):
    """Set one coordinate of the point in the frame in which it is given, metres; axes from 0 for x."""

    axis: int
    value: float
    label: ClassVar[str] = "point"

    def apply(self, state: State) -> State:
        """Return the state with the point there."""
        return SetFramePoint(with_one(state[Chain].point, self.axis, self.value, AXES)).apply(state)


@dataclass(frozen=True)
class GivePointIn(Command):
    """Give the point in another frame, with which it moves from now on; it stays where it is."""

    frame: str
    label: ClassVar[str] = "frame of the point"

    def apply(self, state: State) -> State:
        """Return the state with the point given there."""
        part = state[Chain]
        if self.frame == part.given:
            return state
        known_name("frame", self.frame, part.names)
        p = moved(pair(part, self.frame, part.given).T, part.point)
        return put(state, part.with_values({"point": p.tolist(), "given": self.frame}))


@dataclass(frozen=True, eq=False)
class DragFramePoint(Command):
    """Drag the handle of the point to a place (3,) in the world; this is one event of a drag."""

    place: NDArray[np.floating]
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "drag of the point"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragFramePoint, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the point there."""
        part = state[Chain]
        p = moved(np.asarray(inverse(poses(part)[part.given])), np.asarray(self.place, dtype=np.float64))
        return SetFramePoint(tuple(p.tolist())).apply(state)


@dataclass(frozen=True)
class LookAtFrames(Command):
    """Choose whose transform is shown: the pose of a frame in a reference; what is left out stays."""

    reference: str | None = None
    frame: str | None = None
    label: ClassVar[str] = "pair of frames"

    def apply(self, state: State) -> State:
        """Return the state with the pair chosen."""
        given = {"reference": self.reference, "frame": self.frame}
        return put(state, state[Chain].with_values({key: name for key, name in given.items() if name is not None}))


@dataclass(frozen=True)
class SelectFrame(Command):
    """Give a frame, or the point p, the handle in the scene; an empty name takes it away."""

    name: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the selection."""
        part = state[Chain]
        if self.name not in ("", POINT):
            part.named(self.name)
        return state if part.selected == self.name else state.replace(replace(part, selected=self.name))
