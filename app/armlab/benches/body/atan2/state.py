"""The page of atan2: a point of the plane."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.session.counted import refuse_beyond
from armlab.session.fields import FieldPart, Set, vector
from armlab.session.state import Command, PartType, State

MOST = 2.0
"""Largest coordinate of the point, which is that of the picture."""

ROUND = 0.05
"""Distance of the places to which a drag brings the point, so that it meets the axes and the origin."""


@dataclass(frozen=True)
class Plane(FieldPart):
    """A point in the plane.

    Attributes
    ----------
    point : (float, float)
        x and y.
    """

    key: ClassVar[str] = "plane"

    point: tuple[float, float] = vector("p", "point of the plane", (-1.2, 0.7), -MOST, MOST)


PART = PartType(Plane, order=37)


@dataclass(frozen=True)
class SetCoordinate(Command):
    """Set x (0) or y (1) of the point."""

    index: int
    value: float
    label: ClassVar[str] = "point of the plane"

    def apply(self, state: State) -> State:
        """Return the state with this coordinate."""
        refuse_beyond(self.index, 2, "point")
        values = [self.value if k == self.index else each for k, each in enumerate(state[Plane].point)]
        return Set(Plane, "point", values).apply(state)


@dataclass(frozen=True)
class DragPoint(Command):
    """Put the point at a place, by a click or a drag: the nearest of those `ROUND` apart, inside the picture.

    Parameters
    ----------
    x, y : float
    drag : int
        Which drag it belongs to, which is one step of undo; 0 for a click.
    """

    x: float
    y: float
    drag: int = 0
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "point of the plane"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return (DragPoint, self.drag) if self.drag else None

    def apply(self, state: State) -> State:
        """Return the state with the point there."""
        put = [min(max(round(value / ROUND) * ROUND, -MOST), MOST) + 0.0 for value in (self.x, self.y)]
        return Set(Plane, "point", [round(value, 9) for value in put]).apply(state)
