"""A table beside the arm, an object on it, and the height of the tool above the object."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from armlab.benches.frames.table.place import rounded_length, table_for
from armlab.content.robots import Robot
from armlab.kin.checks import finite_floats
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import transform
from armlab.session.fields import FieldPart, choice, flag, number, own, text, vector
from armlab.session.parts.robot import RobotPart
from armlab.session.sizes import MOST_TURNED, check_size
from armlab.session.state import Json, PartType, State

Floats = NDArray[np.float64]
Two = tuple[float, float]
Three = tuple[float, float, float]

FARTHEST, HIGHEST = 10_000.0, 1_000.0
"""Largest coordinate of the table and of the object, and largest height of the tool above it, metres: what is as large
as the largest arm that can be typed needs about half of them."""

SHARES = (0.5, 0.35, 0.3)
"""Place of the object on the table, x and y, and height of the tool above it, at first, in length scales of the arm."""

NONE = "none"

SELECTED = ("table", "object", NONE)


def _corner(data: Json) -> Three | None:
    if data is None:
        return None
    x, y, z = finite_floats(data, "table", (3,), "three finite numbers, metres").tolist()
    for name, value in (("x", x), ("y", y), ("z", z)):
        check_size(f"table, {name}", value, longest=FARTHEST)
    return x, y, z


@dataclass(frozen=True)
class TableTask(FieldPart):
    """The table and what is to be done above it.

    Attributes
    ----------
    corner : (float, float, float) or None
        Origin of the frame of the table in the world, metres; None where it is at first, within reach of the arm.
    turn : float
        Angle of the table about the vertical, radians.
    place : (float, float)
        Place of the object, along x and y of the table, metres.
    height : float
        From the object up to the tool, metres; the h of 3.118.
    spin : float
        Angle of the tool about its own z axis, radians; 0 in the notes.
    selected : "table", "object" or "none"
        Which of them has the handle.
    follows : bool
        Whether the arm follows as things are moved.
    example : str
        Key of the example in place; empty if there is none.
    """

    key: ClassVar[str] = "table_task"
    looks: ClassVar[tuple[str, ...]] = ("selected",)
    leave_example: ClassVar[tuple[str, ...]] = ("example", "follows")

    corner: Three | None = own("place of the table", None, _corner, kept="edits")
    turn: float = number("", "angle of the table", 0.0, -MOST_TURNED, MOST_TURNED, "rad", kept="edits")
    place: Two = vector("p", "place of the object", (0.4, 0.2), -FARTHEST, FARTHEST, "m", kept="edits")
    height: float = number("h", "height above the object", 0.3, 0.0, HIGHEST, "m", kept="edits")
    spin: float = number("", "angle of the tool about its z axis", 0.0, -MOST_TURNED, MOST_TURNED, "rad")
    selected: str = choice("what has the handle", "object", SELECTED)
    follows: bool = flag("whether the arm follows", False)
    example: str = text("example", "above", kept="edits")

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return a table of the size of the arm."""
        x, y, h = (rounded_length(share * robot.arm.length_scale) for share in SHARES)
        return cls(place=(x, y), height=h)


PART = PartType(TableTask, order=132)


@dataclass(frozen=True, eq=False)
class Task:
    """The equations 3.116 to 3.121 with numbers.

    Attributes
    ----------
    T_wt : ndarray, shape (4, 4)
        The table in the world.
    R_te : ndarray, shape (3, 3)
        Orientation of the tool on the table: z down.
    p_t, p_e : ndarray, shape (3,)
        The object in the frames of table and tool, metres.
    p_te : ndarray, shape (3,)
        The tool in the frame of the table, metres: ``p_t - R_te p_e``.
    """

    T_wt: Floats
    R_te: Floats
    p_t: Floats
    p_e: Floats
    p_te: Floats

    @property
    def T_te(self) -> Floats:
        """The tool in the frame of the table, (4, 4)."""
        return np.asarray(transform(self.R_te, self.p_te), dtype=np.float64)

    @property
    def T_we(self) -> Floats:
        """The tool in the world, (4, 4)."""
        return np.asarray(self.T_wt @ self.T_te)

    @property
    def object(self) -> Floats:
        """The object in the world, (3,)."""
        return np.asarray(self.T_wt[:3, :3] @ self.p_t + self.T_wt[:3, 3])


def task(corner: Three, turn: float, place: Two, height: float, spin: float) -> Task:
    """Return the task of a tool above an object on a table; the arguments are those of `TableTask`.

    References
    ----------
    Notes 3.116-3.121.
    """
    T_wt = np.asarray(transform(rotation_about("z", turn), corner), dtype=np.float64)
    R_te = np.asarray(DOWN @ rotation_about("z", spin), dtype=np.float64)
    p_t, p_e = np.array([*place, 0.0]), np.array([0.0, 0.0, height])
    return Task(T_wt, R_te, p_t, p_e, p_t - R_te @ p_e)


DOWN = np.diag([1.0, -1.0, -1.0])
"""Rotation by half a turn about x, which is its own inverse (notes 3.116 and 3.119)."""


def corner_of(state: State) -> Three:
    """Return the origin of the frame of the table in the world, metres."""
    part = state[TableTask]
    return table_for(state[RobotPart].robot, SHARES) if part.corner is None else part.corner


def task_of(state: State) -> Task:
    """Return the task."""
    part = state[TableTask]
    return task(corner_of(state), part.turn, part.place, part.height, part.spin)
