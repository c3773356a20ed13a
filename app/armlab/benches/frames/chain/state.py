"""A chain of frames, each given in its parent, and a point that is given in one of them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError, UnknownName
from armlab.kin.checks import finite_floats
from armlab.kin.rotations import rotation_from_sequence
from armlab.kin.transforms import transform
from armlab.session.fields import FieldPart, Table, choice, flag, own, text, vector, whole
from armlab.session.sizes import MOST_TURNED, check_size
from armlab.session.state import Json, PartType

Floats = NDArray[np.float64]
Triple = tuple[float, float, float]

WORLD = "w"
"""Name of the frame in which all others stand."""

POINT = "p"
"""Name by which the point is selected; no frame is called so."""

MOST_FRAMES = 6
"""Largest number of frames besides the world."""

FARTHEST = 100.0
"""Largest coordinate, metres."""

LARGEST_ENTRY = 1e6
"""Largest entry of a matrix that can be typed."""

MOST_POINTS = 10**6
"""Largest number of points whose change of coordinates is counted."""

NAME = re.compile(r"[A-Za-z][A-Za-z0-9]{0,3}")
"""Names of frames: a letter, and up to three letters and digits more."""

HANDLES = {"move": "Move", "turn": "Turn"}

COORDINATES = {"m": ("x", "y", "z"), "rad": ("roll", "pitch", "yaw")}
"""Names of the three numbers of a position and of an orientation, by their unit."""

WRITTEN = {"rpy": "roll pitch yaw", "matrix": "matrix"}


@dataclass(frozen=True)
class Frame:
    """A frame in its parent.

    Attributes
    ----------
    name, parent : str
    position : (float, float, float)
        Of its origin, along the axes of the parent, metres.
    angles : (float, float, float)
        Roll, pitch and yaw, radians: ``R = Rz(yaw) Ry(pitch) Rx(roll)``.
    matrix : tuple of tuple of float, or None
        The matrix that was typed for R, which need not be a rotation; None if the angles were typed, or a hand has
        turned the frame.
    """

    name: str
    parent: str
    position: Triple = (0.0, 0.0, 0.0)
    angles: Triple = (0.0, 0.0, 0.0)
    matrix: Table | None = None

    @property
    def R(self) -> Floats:
        """The orientation in the parent, (3, 3)."""
        return np.asarray(rotation_from_sequence("zyx", self.angles[::-1]), dtype=np.float64)

    @property
    def T(self) -> Floats:
        """The pose in the parent, (4, 4)."""
        return np.asarray(transform(self.R, self.position), dtype=np.float64)

    def to_json(self) -> Json:
        """Return the frame as JSON; a matrix only where one was typed."""
        data = {"name": self.name, "parent": self.parent, "position": [*self.position], "angles": [*self.angles]}
        return data if self.matrix is None else data | {"matrix": [[*row] for row in self.matrix]}


def triple(values: Json, where: str, most: float, unit: str) -> Triple:
    """Return three checked numbers, each at most ``most`` either way: m of a position, rad of roll, pitch and yaw."""
    x, y, z = finite_floats(values, where, (3,), f"three finite numbers, {unit}").tolist()
    turned = most if unit == "rad" else None
    for name, value in zip(COORDINATES[unit], (x, y, z), strict=True):
        check_size(f"{where}, {name}", value, turned, most)
    return x + 0.0, y + 0.0, z + 0.0


def _frame(data: Json) -> Frame:
    if isinstance(data, Frame):
        data = data.to_json()
    if not isinstance(data, dict):
        raise InputError(f"frames: expected a name, a parent and a pose, got {type(data).__name__}")
    name = checked_name(data.get("name"))
    typed = data.get("matrix")
    matrix = None if typed is None else finite_floats(typed, f"{name}: matrix", (3, 3), "3 rows of 3 finite numbers")
    if matrix is not None and float(np.abs(matrix).max()) > LARGEST_ENTRY:
        raise InputError(f"{name}: matrix: expected entries up to {LARGEST_ENTRY:g}")
    return Frame(
        name,
        str(data.get("parent")),
        triple(data.get("position", (0, 0, 0)), f"{name}: position", FARTHEST, "m"),
        triple(data.get("angles", (0, 0, 0)), f"{name}: angles", MOST_TURNED, "rad"),
        None if matrix is None else tuple(tuple(row) for row in matrix.tolist()),
    )


def _frames(data: Json) -> tuple[Frame, ...]:
    if len(data) > MOST_FRAMES:
        raise InputError(f"frames: expected at most {MOST_FRAMES} besides the world, got {len(data)}")
    return tuple(map(_frame, data))


def _written(frames: Iterable[Frame]) -> Json:
    return [frame.to_json() for frame in frames]


def checked_name(name: object) -> str:
    """Return the name of a frame; `InputError` when it is none."""
    if not isinstance(name, str) or not NAME.fullmatch(name):
        got = str(name)[:40]
        raise InputError(f"name: expected a letter and up to three letters or digits, such as A or EA, got {got!r}")
    if name in (WORLD, POINT):
        raise InputError(f"name: {WORLD} is the world and {POINT} the point; expected another name, got {name!r}")
    return name


FIRST = (
    Frame("A", WORLD, (0.3, 0.1, 0.2), (0.0, 0.0, math.radians(30.0))),
    Frame("B", "A", (0.35, 0.0, 0.15), (math.radians(90.0), 0.0, 0.0)),
    Frame("C", "B", (0.2, 0.25, 0.0), (0.0, math.radians(-40.0), math.radians(20.0))),
)
"""Frames at first."""


@dataclass(frozen=True)
class Chain(FieldPart):
    """A chain of frames, which may have branches. It does not depend on the arm.

    Attributes
    ----------
    frames : tuple of Frame
        At most `MOST_FRAMES`; a parent stands before its children.
    point : (float, float, float)
        Coordinates of the point in the frame ``given``, metres.
    given : str
        Frame with which the point moves.
    reference, frame : str
        Names of the pair whose transform is shown: the pose of ``frame`` in ``reference``.
    selected : str
        Name of the frame with the handle, `POINT` for the point, empty for none.
    handle : "move" or "turn"
    written : "rpy" or "matrix"
        How the orientation of a frame is typed.
    count : int
        Number of points for which operations are counted.
    steps : bool
        Whether the components of the point are drawn as steps along the axes of both frames.
    globe : bool
        Whether a globe is drawn about the frame in which the point is given, with the point on it.
    example : str
        Key of the example in place; empty if there is none.
    """

    key: ClassVar[str] = "frame_chain"
    looks: ClassVar[tuple[str, ...]] = ("selected", "handle", "written", "steps", "globe")
    leave_example: ClassVar[tuple[str, ...]] = ("example", "reference", "frame", "count", "given")

    frames: tuple[Frame, ...] = own("frames", FIRST, _frames, _written)
    point: Triple = vector("p", "point", (0.2, 0.3, 0.0), -FARTHEST, FARTHEST, "m")
    given: str = text("frame of the point", "C", 4)
    reference: str = text("reference of the transform", WORLD, 4)
    frame: str = text("frame of the transform", "C", 4)
    selected: str = text("selected frame", "B", 4)
    handle: str = choice("what dragging does", "move", HANDLES)
    written: str = choice("how orientations are typed", "rpy", WRITTEN)
    count: int = whole("number of points", 1, 1, MOST_POINTS)
    steps: bool = flag("components of the point", False)
    globe: bool = flag("globe", False)
    example: str = text("example", "chain")

    def check(self) -> None:
        """Refuse names that come twice or are not there, and parents that do not come before their children."""
        known = [WORLD]
        for frame in self.frames:
            if frame.name in known:
                raise InputError(f"name: there is a frame {frame.name} already")
            if frame.parent not in known:
                raise InputError(f"{frame.name}: its parent {frame.parent!r} is not among the frames before it")
            known.append(frame.name)
        for what in ("given", "reference", "frame"):
            if getattr(self, what) not in known:
                raise UnknownName("frame", getattr(self, what), known)
        if self.selected not in ("", POINT, *known[1:]):
            raise UnknownName("selected frame", self.selected, (POINT, *known[1:]))

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all frames, beginning with the world."""
        return WORLD, *(frame.name for frame in self.frames)

    def named(self, name: str) -> Frame:
        """Return a frame by its name; `UnknownName` when there is none, or for the world, which stays where it is."""
        for frame in self.frames:
            if frame.name == name:
                return frame
        raise UnknownName("frame", name, self.names[1:])

    def children(self, name: str) -> tuple[str, ...]:
        """Return the names of the frames that are given in a frame."""
        return tuple(frame.name for frame in self.frames if frame.parent == name)

    def with_frame(self, name: str, **values: object) -> tuple[Frame, ...]:
        """Return the frames with fields of one of them set."""
        self.named(name)
        return tuple(replace(each, **values) if each.name == name else each for each in self.frames)  # type: ignore[arg-type]


PART = PartType(Chain, order=130)
