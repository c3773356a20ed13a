"""Which plots of the motion are shown."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal, Self, get_args

from armlab.content.robots import Robot
from armlab.errors import UnknownName
from armlab.session.state import Command, Json, Part, PartType, State

Quantity = Literal["q", "q_dot", "q_ddot", "jerk", "s", "speed", "curvature", "load"]

QUANTITIES: tuple[Quantity, ...] = get_args(Quantity)
"""In the order of the page."""

FIRST: tuple[Quantity, ...] = ("q", "q_dot", "q_ddot")
"""Shown when nobody has chosen."""


@dataclass(frozen=True)
class MotionPlots(Part):
    """The choice of plots; it stays when the arm changes.

    Attributes
    ----------
    shown : tuple of str
        Of `QUANTITIES`, in their order.
    """

    key: ClassVar[str] = "motion_plots"
    kept_by_undo: ClassVar[bool] = True

    shown: tuple[Quantity, ...] = FIRST

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return position, velocity and acceleration."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything."""
        return self

    def to_json(self) -> Json:
        """Write the choice."""
        return list(self.shown)

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read the choice; `UnknownName` for a plot there is not."""
        wanted = {checked_quantity(key) for key in data}
        return cls(tuple(key for key in QUANTITIES if key in wanted))


PART = PartType(MotionPlots, order=99)


@dataclass(frozen=True)
class ShowMotionPlot(Command):
    """Show a plot of the motion, or hide it."""

    quantity: str
    on: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        shown, key = state[MotionPlots].shown, checked_quantity(self.quantity)
        if (key in shown) == self.on:
            return state
        return state.replace(MotionPlots(tuple(k for k in QUANTITIES if (self.on if k == key else k in shown))))


def checked_quantity(key: object) -> Quantity:
    """Return the key of a plot; `UnknownName` for another word."""
    for quantity in QUANTITIES:
        if quantity == key:
            return quantity
    raise UnknownName("plot", key, QUANTITIES)
