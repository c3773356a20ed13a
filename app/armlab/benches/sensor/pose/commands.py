"""Sending the arm there as often again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.sensor.pose.state import Repeats
from armlab.session.fields import declarations, setting
from armlab.session.state import Command, State


@dataclass(frozen=True)
class MoveAgain(Command):
    """Send the same arm to its pose as often again, with the next seed."""

    label: ClassVar[str] = "new attempts"

    def apply(self, state: State) -> State:
        """Return the state with other attempts."""
        most = int(declarations(Repeats)["seed"].spec.high)  # type: ignore[union-attr]
        return setting(state, Repeats, {"seed": (state[Repeats].seed + 1) % (most + 1)})
