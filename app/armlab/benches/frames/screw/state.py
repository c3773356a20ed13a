"""Two poses, and the screw motion from the first to the second."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.benches.frames.chain.commands import angles_of
from armlab.benches.frames.chain.state import FARTHEST, HANDLES, Triple, triple
from armlab.errors import InputError
from armlab.kin.rotations import rotation_from_axis_angle, rotation_from_sequence
from armlab.kin.transforms import transform
from armlab.registry import known_name
from armlab.session.fields import FieldPart, choice, flag, put, text, vector
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Command, PartType, State

Floats = NDArray[np.float64]

CLIP_KEY = "screw"

POSES = {"first": "pose 1", "second": "pose 2"}

NONE = "none"
"""Key of the choice of no handle."""

KINDS = {"none": "the identity", "translation": "a translation", "rotation": "a rotation", "screw": "a screw"}
"""Kinds of motion, in words."""

MOST = 1e6
"""Largest component of a direction that can be typed."""


def _rad(*degrees: float) -> Triple:
    x, y, z = (math.radians(angle) for angle in degrees)
    return x, y, z


@dataclass(frozen=True)
class Screw(FieldPart):
    """Two poses in the world, which do not depend on the arm.

    Attributes
    ----------
    position1, position2 : (float, float, float)
        Metres.
    angles1, angles2 : (float, float, float)
        Roll, pitch and yaw, radians: ``R = Rz(yaw) Ry(pitch) Rx(roll)``.
    axis : (float, float, float)
        Direction of the axis as it was typed, which need not be of unit length.
    selected : "first", "second" or "none"
        Pose with the handle.
    handle : "move" or "turn"
    straight : bool
        Whether the straight way is drawn as well.
    example : str
        Key of the example in place; empty if there is none.
    """

    key: ClassVar[str] = "screw"
    clip: ClassVar[str] = CLIP_KEY
    looks: ClassVar[tuple[str, ...]] = ("selected", "handle", "straight")

    position1: Triple = vector("p₁", "position of pose 1", (0.5, 0.0, 0.1), -FARTHEST, FARTHEST, "m")
    angles1: Triple = vector("", "orientation of pose 1", (0.0, 0.0, 0.0), -MOST_TURNED, MOST_TURNED, "rad")
    position2: Triple = vector("p₂", "position of pose 2", (-0.1, 0.55, 0.5), -FARTHEST, FARTHEST, "m")
    angles2: Triple = vector("", "orientation of pose 2", _rad(20.0, -10.0, 120.0), -MOST_TURNED, MOST_TURNED, "rad")
    axis: Triple = vector("", "direction of the axis", (0.0, 0.0, 1.0), -MOST, MOST)
    selected: str = choice("pose with the handle", "second", (*POSES, NONE))
    handle: str = choice("what dragging does", "move", HANDLES)
    straight: bool = flag("straight way", True)
    example: str = text("example", "general")

    def check(self) -> None:
        """Refuse an axis that is zero."""
        if math.hypot(*self.axis) == 0.0:
            raise InputError("axis: expected a direction that is not zero: zero has no direction")

    def pose(self, which: str) -> Floats:
        """Return the pose "first" or "second" in the world, (4, 4)."""
        known_name("pose", which, POSES)
        position, angles = (self.position1, self.angles1) if which == "first" else (self.position2, self.angles2)
        R = rotation_from_sequence("zyx", angles[::-1])
        return np.asarray(transform(R, position), dtype=np.float64)


PART = PartType(Screw, order=134)


def changed(state: State, **values: Any) -> State:
    """Return the state with fields of the part set, and no example in place."""
    return put(state, state[Screw].with_values(values).without_example())


def _with(values: Sequence[float], index: int, value: float, what: str) -> Triple:
    if not 0 <= index < len(values):
        raise InputError(f"{what}: expected index 0 to 2, got {index}")
    x, y, z = (value if k == index else each for k, each in enumerate(values))
    return x, y, z


def _of(which: str, name: str) -> str:
    """Return the name of a field of pose 1 or 2."""
    return f"{name}{1 if known_name('pose', which, POSES) == 'first' else 2}"


def with_pose(state: State, which: str, T: Floats) -> State:
    """Return the state with pose 1 or 2 at a transform (4, 4); `InputError` if it is too far away."""
    position = triple(T[:3, 3].tolist(), POSES[which], FARTHEST, "m")
    return changed(state, **{_of(which, "position"): position, _of(which, "angles"): angles_of(T[:3, :3])})


@dataclass(frozen=True)
class SetPosePosition(Command):
    """Set x (0), y (1) or z (2) of the pose "first" or "second", metres."""

    which: str
    axis: int
    value: float
    label: ClassVar[str] = "position of a pose"

    def apply(self, state: State) -> State:
        """Return the state with the pose there."""
        name = _of(self.which, "position")
        return changed(state, **{name: _with(getattr(state[Screw], name), self.axis, self.value, "axis")})


@dataclass(frozen=True)
class SetPoseAngle(Command):
    """Set roll (0), pitch (1) or yaw (2) of the pose "first" or "second", radians."""

    which: str
    index: int
    value: float
    label: ClassVar[str] = "orientation of a pose"
    places: ClassVar[Mapping[str, tuple[str, ...]]] = {"index": ("roll", "pitch", "yaw")}

    def apply(self, state: State) -> State:
        """Return the state with the pose turned so."""
        name = _of(self.which, "angles")
        return changed(state, **{name: _with(getattr(state[Screw], name), self.index, self.value, "angle")})


@dataclass(frozen=True)
class PlacePose(Command):
    """Set the position of the pose "first" or "second", metres, and roll, pitch and yaw, radians."""

    which: str
    position: tuple[float, ...]
    angles: tuple[float, ...]
    label: ClassVar[str] = "pose"

    def apply(self, state: State) -> State:
        """Return the state with the pose there."""
        values = {_of(self.which, "position"): list(self.position), _of(self.which, "angles"): list(self.angles)}
        return changed(state, **values)


@dataclass(frozen=True, eq=False)
class DragPose(Command):
    """Drag the handle of the pose "first" or "second" to a pose (4, 4) in the world; this is one event of a drag."""

    which: str
    pose: NDArray[np.floating]
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "drag of a pose"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragPose, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the pose there."""
        return with_pose(state, self.which, np.asarray(self.pose, dtype=np.float64))


@dataclass(frozen=True)
class MakeScrew(Command):
    """Put pose 2 where a screw brings pose 1.

    Parameters
    ----------
    direction : tuple of 3 float
        Of the axis, of any length but zero.
    point : tuple of 3 float
        Any point of the axis, metres.
    angle : float
        About it, radians.
    distance : float
        Along it, metres.
    """

    direction: tuple[float, ...]
    point: tuple[float, ...]
    angle: float
    distance: float
    label: ClassVar[str] = "screw"

    def apply(self, state: State) -> State:
        """Return the state with pose 2 there; `InputError` for a direction that is zero."""
        part = state[Screw].with_values({"axis": list(self.direction)})
        if not abs(self.angle) <= MOST_TURNED:
            raise InputError(f"angle: expected at most {math.degrees(MOST_TURNED):g}° either way")
        c = np.array(triple(self.point, "point", FARTHEST, "m"))
        r = np.array(part.axis) / math.hypot(*part.axis)
        R = np.asarray(rotation_from_axis_angle(r, self.angle))
        along = triple((self.distance * r).tolist(), "distance", 2.0 * FARTHEST, "m")
        motion = transform(R, c - R @ c + np.array(along))
        return changed(with_pose(state, "second", motion @ part.pose("first")), axis=list(self.direction))
