"""A point in Cartesian, cylindrical and spherical coordinates, each of which can be typed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.coordinates import cylindrical, from_cylindrical, from_spherical, spherical
from armlab.registry import known_name
from armlab.session.fields import FieldPart, choice, number, put, text, vector
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Command, PartType, State

Floats = NDArray[np.float64]
Triple = tuple[float, float, float]

FARTHEST = 100.0
"""Largest coordinate, metres."""

ON_AXIS = 1e-9
"""Distance from the z axis, and from the origin, metres, below which an angle is not defined."""

ROUNDING = 1e-13
"""Coordinate, in distances from the origin, up to which it is the rounding of an angle of some turns."""

SHOWN = {"cylindrical": "Cylindrical", "spherical": "Spherical"}

CYLINDRICAL, SPHERICAL = ("r", "theta", "h"), ("r", "theta", "phi")
"""Names of the coordinates."""


@dataclass(frozen=True)
class Coordinates(FieldPart):
    """A point in the world, which does not depend on the arm.

    Attributes
    ----------
    p : (float, float, float)
        Cartesian, metres.
    theta : float
        The azimuth, radians, as it was when it was last defined or typed: it holds where the point is on the z axis.
    phi : float
        The angle from the z axis, radians, in the same way: it holds where the point is at the origin.
    shown : "cylindrical" or "spherical"
        What is drawn.
    example : str
        Key of the example in place; empty if there is none.
    """

    key: ClassVar[str] = "coordinates"
    looks: ClassVar[tuple[str, ...]] = ("shown",)

    p: Triple = vector("p", "point", (-1.0, -2.0, 0.5), -FARTHEST, FARTHEST, "m")
    theta: float = number("θ", "azimuth", math.atan2(-2.0, -1.0), -MOST_TURNED, MOST_TURNED, "rad")
    phi: float = number("φ", "angle from the z axis", math.atan2(math.sqrt(5.0), 0.5), 0.0, math.pi, "rad")
    shown: str = choice("coordinates that are drawn", "cylindrical", SHOWN)
    example: str = text("example", "behind")


PART = PartType(Coordinates, order=133)


@dataclass(frozen=True)
class Where:
    """The point in all coordinates.

    Attributes
    ----------
    p : ndarray, shape (3,)
    r, theta, h : float
        Cylindrical: distance from the z axis, azimuth, height; metres and radians.
    R, phi : float
        Spherical, besides theta: distance from the origin, metres, and angle from the z axis, radians.
    on_axis, at_origin : bool
        Whether theta, and phi as well, are not defined; those that were last defined stand for them.
    """

    p: Floats
    r: float
    theta: float
    h: float
    R: float
    phi: float
    on_axis: bool
    at_origin: bool

    @property
    def by_atan(self) -> float | None:
        """The azimuth as atan(y / x) would have it, radians; None where x is 0."""
        x, y, _ = self.p.tolist()
        return math.atan(y / x) if x != 0.0 else None


def where_of(state: State) -> Where:
    """Return the point in all coordinates."""
    part = state[Coordinates]
    r, theta, h = (float(each) for each in cylindrical(part.p))
    R, _, phi = (float(each) for each in spherical(part.p))
    on_axis, at_origin = r < ON_AXIS, R < ON_AXIS
    return Where(
        np.array(part.p),
        r,
        math.remainder(part.theta, 2.0 * math.pi) if on_axis else theta,
        h,
        R,
        part.phi if at_origin else phi,
        on_axis,
        at_origin,
    )


def placed(part: Coordinates, p: object, theta: float | None = None, phi: float | None = None) -> Coordinates:
    """Return the part with the point elsewhere (3,); angles that are defined there are its own, others stay.

    ``theta`` and ``phi`` are typed ones, radians, which hold where they are not defined.
    """
    moved = part.with_values({"p": np.asarray(p, dtype=float).tolist()})
    r, own_theta, _ = (float(each) for each in cylindrical(moved.p))
    R, _, own_phi = (float(each) for each in spherical(moved.p))
    kept_theta = part.theta if theta is None else theta
    kept_phi = part.phi if phi is None else phi
    angles = {"theta": kept_theta if r < ON_AXIS else own_theta, "phi": kept_phi if R < ON_AXIS else own_phi}
    return moved.with_values(angles).without_example()


@dataclass(frozen=True)
class SetCartesian(Command):
    """Set x (0), y (1) or z (2) of the point, metres."""

    axis: int
    value: float
    label: ClassVar[str] = "point"

    def apply(self, state: State) -> State:
        """Return the state with the point there."""
        part = state[Coordinates]
        if not 0 <= self.axis < 3:
            raise InputError(f"axis: expected 0 to 2 for x, y and z, got {self.axis}")
        p = [self.value if k == self.axis else each for k, each in enumerate(part.p)]
        return put(state, placed(part, p))


@dataclass(frozen=True)
class PlacePoint(Command):
    """Set x, y and z of the point, metres."""

    xyz: tuple[float, ...]
    label: ClassVar[str] = "point"

    def apply(self, state: State) -> State:
        """Return the state with the point there."""
        return put(state, placed(state[Coordinates], self.xyz))


@dataclass(frozen=True)
class SetCylindrical(Command):
    """Set one of the cylindrical coordinates by its name: r or h in metres, theta in radians; the others stay."""

    name: str
    value: float
    label: ClassVar[str] = "point"

    def apply(self, state: State) -> State:
        """Return the state with the point there; `InputError` for a negative distance."""
        known_name("coordinate", self.name, CYLINDRICAL)
        found = state.derived(where_of)
        values = {"r": found.r, "theta": found.theta, "h": found.h} | {self.name: _checked(self.name, self.value)}
        p = from_cylindrical(values["r"], values["theta"], values["h"])
        return put(state, placed(state[Coordinates], _unrounded(p), theta=values["theta"]))


@dataclass(frozen=True)
class SetSpherical(Command):
    """Set one of the spherical coordinates by its name: r in metres, theta or phi in radians; the others stay."""

    name: str
    value: float
    label: ClassVar[str] = "point"

    def apply(self, state: State) -> State:
        """Return the state with the point there; `InputError` for a negative distance, or a phi beyond 0 to pi."""
        known_name("coordinate", self.name, SPHERICAL)
        found = state.derived(where_of)
        values = {"r": found.R, "theta": found.theta, "phi": found.phi} | {self.name: _checked(self.name, self.value)}
        p = from_spherical(values["r"], values["theta"], values["phi"])
        return put(state, placed(state[Coordinates], _unrounded(p), values["theta"], values["phi"]))


def _unrounded(p: Floats) -> Floats:
    """Return a point (3,) with 0 where an angle has left rounding: at 90° its x is 0, as atan2 and atan must see it."""
    return np.where(np.abs(p) <= ROUNDING * float(np.linalg.norm(p)), 0.0, p)


def _checked(name: str, value: float) -> float:
    """Return a typed coordinate; `InputError` for one that names no point, or names it in another way."""
    if name == "r" and value < 0.0:
        raise InputError(
            "r: expected a distance, 0 or more: a point on the other side has an angle θ that differs by half a turn"
        )
    if name == "phi" and not 0.0 <= value <= math.pi:
        raise InputError(
            f"φ: expected 0° to 180°, down from the z axis, got {math.degrees(value):.6g}°; beyond a pole it is θ that "
            "differs by half a turn"
        )
    return value


@dataclass(frozen=True, eq=False)
class DragPoint(Command):
    """Drag the handle of the point to a place (3,) in the world; this is one event of a drag."""

    place: NDArray[np.floating]
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "drag of the point"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragPoint, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the point there."""
        return put(state, placed(state[Coordinates], np.clip(self.place, -FARTHEST, FARTHEST)))
