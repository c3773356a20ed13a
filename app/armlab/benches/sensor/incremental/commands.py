"""Turning the disk of the incremental encoder: a list of moves, and a hand whose way becomes one."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.benches.sensor.incremental.state import CLIP_KEY, Incremental, present_time
from armlab.errors import InputError
from armlab.kin.sensors.absolute import TURN
from armlab.kin.sensors.quadrature import turned_on
from armlab.session.fields import setting
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, State

SMALLEST = 1e-9
"""Angle of a move, radians, below which a hand has not moved the disk."""


@dataclass(frozen=True)
class SetMoves(Command):
    """Set the angles of the moves, one after the other, in radians."""

    angles: tuple[float, ...]
    label: ClassVar[str] = "moves"

    def apply(self, state: State) -> State:
        """Return the state with these moves."""
        return setting(state, Incremental, {"moves": self.angles})


@dataclass(frozen=True)
class TurnBy(Command):
    """Turn the disk on by an angle in radians: the last move becomes longer, or a new one begins.

    The disk does not tremble in the end any more.
    """

    by: float
    label: ClassVar[str] = "turn of the disk"

    def apply(self, state: State) -> State:
        """Return the state with the disk turned on; its film, if open, is at the end."""
        if not math.isfinite(self.by):
            raise InputError(f"angle of the turn: expected a finite number, got {self.by}")
        if abs(self.by) < SMALLEST:
            return state
        moves = turned_on(state[Incremental].moves, self.by)
        state = setting(state, Incremental, {"moves": moves, "shakes": 0})
        timeline = state[Timeline]
        if timeline.clip != CLIP_KEY:
            return state
        return state.replace(replace(timeline, time=state[Incremental].motion.duration, playing=False))


@dataclass(frozen=True)
class DragTo(Command):
    """Turn the disk to an angle by hand; this is one event of a drag.

    Parameters
    ----------
    angle : float
        Radians.
    drag : int
        Which drag it belongs to: one drag is one step of undo.
    """

    angle: float
    drag: int
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "turn of the disk"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragTo, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the disk there, and the way to it among its moves."""
        return TurnBy(self.angle - float(state[Incremental].motion.angles[-1])).apply(state)


@dataclass(frozen=True)
class StepQuarter(Command):
    """Turn the disk on, or back, by so many quarters of a period, 90 electrical degrees each."""

    quarters: int
    label: ClassVar[str] = "turn of the disk"

    def apply(self, state: State) -> State:
        """Return the state with the disk turned on."""
        return TurnBy(self.quarters * TURN / (4 * state[Incremental].pulses)).apply(state)


@dataclass(frozen=True)
class BeginAgain(Command):
    """Begin where the disk stands: the count is 0, and there are no moves."""

    label: ClassVar[str] = "new beginning of the count"

    def apply(self, state: State) -> State:
        """Return the state with the disk where it is, and no moves."""
        angle = float(state[Incremental].motion.at(present_time(state))) % TURN
        return setting(state, Incremental, {"start": angle, "moves": (), "shakes": 0})
