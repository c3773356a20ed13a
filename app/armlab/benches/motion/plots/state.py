"""The choice of plots of the motion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal, get_args

from armlab.errors import UnknownName
from armlab.session.fields import FieldPart, own, setting
from armlab.session.state import Command, Json, PartType, State

Quantity = Literal["q", "q_dot", "q_ddot", "jerk", "s", "speed", "curvature", "load"]

QUANTITIES: tuple[Quantity, ...] = get_args(Quantity)
"""Quantities in the order of the page."""

FIRST: tuple[Quantity, ...] = ("q", "q_dot", "q_ddot")
"""Quantities that are shown at first."""


def _in_order(keys: Json) -> tuple[Quantity, ...]:
    wanted = {checked_quantity(key) for key in keys}
    return tuple(key for key in QUANTITIES if key in wanted)


@dataclass(frozen=True)
class MotionPlots(FieldPart):
    """The choice of plots, which stays when the arm changes.

    Attributes
    ----------
    shown : tuple of str
        Of `QUANTITIES`, in their order.
    """

    key: ClassVar[str] = "motion_plots"
    kept_by_undo: ClassVar[bool] = True
    bare: ClassVar[bool] = True

    shown: tuple[Quantity, ...] = own("plots", FIRST, _in_order)


PART = PartType(MotionPlots, order=99)


@dataclass(frozen=True)
class ShowMotionPlot(Command):
    """Show a plot of the motion, or hide it."""

    quantity: str
    on: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        others = {*state[MotionPlots].shown} - {checked_quantity(self.quantity)}
        return setting(state, MotionPlots, {"shown": {*others, self.quantity} if self.on else others})


def checked_quantity(key: object) -> Quantity:
    """Return the key of a plot; `UnknownName` for another word."""
    for quantity in QUANTITIES:
        if quantity == key:
            return quantity
    raise UnknownName("plot", key, QUANTITIES)
