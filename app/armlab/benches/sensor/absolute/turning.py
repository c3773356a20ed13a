"""Turning the disk: to an angle, by hand, sector by sector, and along with its film."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.benches.sensor.absolute.state import CLIP_KEY, Absolute
from armlab.errors import InputError
from armlab.kin.sensors.absolute import TURN
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, State

DURATION = 16.0
"""Duration of the film of one turn, in seconds."""


def turned_to(state: State, angle: float) -> State:
    """Return the state with the disk at an angle in radians, 0 to a turn."""
    part = state[Absolute]
    return state if part.angle == angle else state.replace(part.with_values({"angle": angle}))


@dataclass(frozen=True)
class TurnTo(Command):
    """Turn the disk to an angle in radians; whole turns do not count."""

    angle: float
    label: ClassVar[str] = "turn of the disk"

    def apply(self, state: State) -> State:
        """Return the state with the disk there; its film, if open, is paused where the disk is."""
        if not math.isfinite(self.angle):
            raise InputError(f"angle of the disk: expected a finite number, got {self.angle}")
        angle = self.angle % TURN
        timeline = state[Timeline]
        if timeline.clip == CLIP_KEY:
            state = state.replace(replace(timeline, time=DURATION * angle / TURN, playing=False))
        return turned_to(state, angle)


@dataclass(frozen=True)
class DragTo(TurnTo):
    """Turn the disk by hand; this is one event of a drag.

    Parameters
    ----------
    drag : int
        Which drag it belongs to: one drag is one step of undo.
    """

    drag: int = 0
    snapshot: ClassVar[bool] = True

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragTo, self.drag


@dataclass(frozen=True)
class StepSectors(Command):
    """Turn the disk to the middle of a sector so many further on, or back."""

    by: int
    label: ClassVar[str] = "turn of the disk"

    def apply(self, state: State) -> State:
        """Return the state with the disk in the middle of that sector."""
        disk = state[Absolute].disk
        return TurnTo((int(disk.sector(state[Absolute].angle)) + self.by + 0.5) * disk.width).apply(state)
