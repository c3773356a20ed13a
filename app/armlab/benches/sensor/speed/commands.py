"""The speed that belongs to a number of counts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.sensor.speed.state import FASTEST, SLOWEST, EncoderSpeed
from armlab.errors import InputError
from armlab.session.fields import setting
from armlab.session.state import Command, State


@dataclass(frozen=True)
class SetCounts(Command):
    """Turn the shaft at the speed at which so many counts come in a window."""

    counts: int
    label: ClassVar[str] = "counts in a window"

    def apply(self, state: State) -> State:
        """Return the state with that speed; `InputError` when there is no such speed."""
        part = state[EncoderSpeed]
        speed = part.speed_of(self.counts)
        if not SLOWEST <= speed <= FASTEST:
            least, most = (limit * part.window / part.meter.resolution for limit in (SLOWEST, FASTEST))
            raise InputError(
                f"counts: expected {max(least, 1.0):.6g} to {most:.6g} in a window of {part.window:g} s, "
                f"got {self.counts}"
            )
        return setting(state, EncoderSpeed, {"speed": speed})
