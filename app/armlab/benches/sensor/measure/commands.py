"""Throwing again, and correcting the aim by what the throws have told."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.sensor.measure.state import MOST_SEED, Throws
from armlab.session.fields import setting
from armlab.session.state import Command, State


def _next(part: Throws) -> int:
    return (part.seed + 1) % (MOST_SEED + 1)


@dataclass(frozen=True)
class ThrowAgain(Command):
    """Throw as often again, with the next seed."""

    label: ClassVar[str] = "new throws"

    def apply(self, state: State) -> State:
        """Return the state with other throws."""
        return setting(state, Throws, {"seed": _next(state[Throws])})


@dataclass(frozen=True)
class CorrectAim(Command):
    """Correct the aim by the estimated bias, and throw again: a calibration."""

    label: ClassVar[str] = "correction of the aim"

    def apply(self, state: State) -> State:
        """Return the state with the aim moved against the centre of the throws, and with other throws."""
        part = state[Throws]
        right, up = part.found.mean.tolist()
        values = {"aim_right": part.aim_right - right, "aim_up": part.aim_up - up, "seed": _next(part)}
        return setting(state, Throws, values)


@dataclass(frozen=True)
class AimAsBefore(Command):
    """Take back every correction of the aim."""

    label: ClassVar[str] = "correction of the aim"

    def apply(self, state: State) -> State:
        """Return the state with the aim at the middle."""
        return setting(state, Throws, {"aim_right": 0.0, "aim_up": 0.0})
