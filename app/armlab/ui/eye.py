"""Where an eye stands, what it sees, and how it goes from one place to another; metres and radians in the world."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

FIELD_OF_VIEW = math.radians(32.0)
"""Angle of view from bottom to top, radians; viser's 75 degrees distort arms."""

TALL = math.tan(FIELD_OF_VIEW / 2.0)
"""Half the height of a picture at a depth of 1."""

ROOM = 1.1
"""Height of a picture relative to what has to fit into it."""

SQUARE = math.radians(0.1)
"""Largest angle between the line of sight and the normal of a plane that is looked at square, radians."""

SHORT_OF_UP = math.radians(0.04)
"""Angle, radians, by which an eye above a plane stays off the vertical. It keeps z for its upper side, so that a hand
turns it as always, and has to know which way to stand."""

SAME = 1e-6
"""Difference of two places of an eye, relative to its distance, below which they are one: what a page sends back
differs by rounding only, and a hand moves it by a thousand times as much."""

Z = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False)
class Facing:
    """A plane that is to be looked at square.

    Attributes
    ----------
    normal : ndarray, shape (3,)
        Towards the eye, unless that would be below the plane.
    up : ndarray, shape (3,)
        In the plane: what is to be up in the picture, or down if it points downwards in the world.
    of : str
        Which of the planes of its page this is: who chooses another one wants to see it, wherever the eye is.
    """

    normal: Floats
    up: Floats
    of: str = ""

    def direction(self) -> tuple[Floats, Floats]:
        """Return the unit vector to an eye that looks at the plane square, and the upper side of that eye."""
        normal, up = _unit(self.normal), _unit(self.up)
        normal = -normal if normal[2] < -SAME else normal
        up = -up if up[2] < -SAME else up
        upright = Z - normal[2] * normal
        if np.linalg.norm(upright) <= math.sin(SHORT_OF_UP):
            return _unit(normal - math.tan(SHORT_OF_UP) * up), Z
        # The plane of a tilted base may have its vertical anywhere.
        return normal, Z if np.allclose(_unit(upright), up, atol=SAME) else up


@dataclass(frozen=True, eq=False)
class Eye:
    """A place to look from.

    Attributes
    ----------
    position, look_at : ndarray, shape (3,)
    up : ndarray, shape (3,)
        The upper side, about which a hand turns it; not along the line of sight.
    """

    position: Floats
    look_at: Floats
    up: Floats

    @property
    def distance(self) -> float:
        """Distance of what is looked at."""
        return float(np.linalg.norm(self.position - self.look_at))

    @property
    def back(self) -> Floats:
        """Unit vector from what is looked at to the eye; z if both are one."""
        return _unit(self.position - self.look_at)

    def near(self, other: Eye) -> bool:
        """Return whether another eye is at the same place and looks at the same."""
        most = SAME * max(self.distance, other.distance)
        pairs = ((self.position, other.position), (self.look_at, other.look_at))
        return all(np.abs(one - two).max() <= most for one, two in pairs) and bool(
            np.abs(self.up - other.up).max() <= SAME
        )

    def sees(self, points: Floats, tall: float, aspect: float) -> bool:
        """Return whether all points (k, 3) are in the picture.

        Parameters
        ----------
        points : ndarray, shape (k, 3)
        tall : float
            Tangent of half the angle of view, from bottom to top.
        aspect : float
            Width of the picture over its height.
        """
        right, top = _sides(self.back, self.up)
        away = points - self.position
        depth = -(away @ self.back)
        inside = (np.abs(away @ top) < tall * depth) & (np.abs(away @ right) < tall * aspect * depth)
        return bool(np.all(inside & (depth > 0.0)))

    def squares(self, facing: Facing) -> bool:
        """Return whether a plane is looked at square, with its vertical up."""
        back, up = facing.direction()
        turned = (self.back, back), (_sides(self.back, self.up)[1], _sides(back, up)[1])
        return all(_angle(*pair) < SQUARE for pair in turned) and bool(np.allclose(self.up, up, atol=SAME))


def nearest_view(points: Floats, back: Floats, up: Floats, tall: float, aspect: float) -> Eye:
    """Return the nearest eye in a direction that has all points in its picture, with some room around them.

    Each edge of the picture is a plane through the eye. Two that face each other leave a wedge in which the points lie;
    the wider one of height and width puts the eye to its distance, and both its middle.

    Parameters
    ----------
    points : ndarray, shape (k, 3)
        Not all at one place.
    back, up : ndarray, shape (3,)
        Unit vector to the eye, and its upper side.
    tall, aspect : float
        As for `Eye.sees`.
    """
    right, top = _sides(back, up)
    depth = points @ back
    ends, place = [], []
    for side, slope in ((right, tall * aspect / ROOM), (top, tall / ROOM)):
        across = points @ side
        one, other = float((across + slope * depth).max()), float((slope * depth - across).max())
        ends.append(0.5 * (one + other) / slope)
        place.append(0.5 * (one - other))
    position = place[0] * right + place[1] * top + max(ends) * back
    return Eye(position, position - (max(ends) - 0.5 * float(depth.min() + depth.max())) * back, up)


def between(start: Eye, end: Eye, s: float) -> Eye:
    """Return an eye on its way, 0 at the start and 1 at the end, around what is looked at."""
    if s >= 1.0:
        return end
    top, first = _unit(end.up), _across(end.up)
    basis = np.array([first, np.cross(top, first), top])
    (a0, e0), (a1, e1) = (_around(basis @ eye.back) for eye in (start, end))
    azimuth, elevation = a0 + s * math.remainder(a1 - a0, math.tau), e0 + s * (e1 - e0)
    c = math.cos(elevation)
    back = np.array([c * math.cos(azimuth), c * math.sin(azimuth), math.sin(elevation)]) @ basis
    look_at = start.look_at + s * (end.look_at - start.look_at)
    distance = start.distance ** (1.0 - s) * end.distance**s
    return Eye(look_at + distance * back, look_at, _unit(start.up + s * (end.up - start.up)))


def _around(direction: Floats) -> tuple[float, float]:
    x, y, z = direction.tolist()
    return math.atan2(y, x), math.asin(min(1.0, max(-1.0, z)))


def _across(axis: Floats) -> Floats:
    """Return some unit vector across an axis."""
    return _unit(np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))]))


def _sides(back: Floats, up: Floats) -> tuple[Floats, Floats]:
    """Return the directions right and up in the picture of an eye."""
    right = np.cross(up, back)
    right = _unit(right) if np.linalg.norm(right) > 1e-9 else _across(back)
    return right, np.cross(back, right)


def _angle(one: Floats, other: Floats) -> float:
    return math.atan2(float(np.linalg.norm(np.cross(one, other))), float(one @ other))


def _unit(vector: Floats) -> Floats:
    """Return a vector with the length 1; z for one without a direction."""
    length = float(np.linalg.norm(vector))
    return np.asarray(vector, dtype=np.float64) / length if length > 0.0 else Z
