"""Choosing how voltage and load change over time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from armlab.benches.drive.motor.profile import ENDING
from armlab.benches.drive.motor.state import Motor
from armlab.registry import known_name
from armlab.session.fields import setting
from armlab.session.state import Command, State

PROFILES = {"v": "voltage over time", "load": "load over time"}
"""Titles of the profiles by the beginning of their fields."""

LASTS = 0.1
"""Duration of a ramp or pulse whose end is moved behind its start, seconds."""


@dataclass(frozen=True)
class ChooseProfile(Command):
    """Choose the kind of a profile, "v" or "load"; an end that is not after the start is moved behind it."""

    name: str
    kind: str

    @property
    def label(self) -> str:  # type: ignore[override]
        """The title of the profile."""
        return PROFILES.get(self.name, "profile")

    def apply(self, state: State) -> State:
        """Return the state with a profile of this kind; `UnknownName` for another name or kind."""
        known_name("profile", self.name, PROFILES)
        part, values = state[Motor], dict[str, Any]({f"{self.name}_kind": self.kind})
        start, stop = (getattr(part, f"{self.name}_{each}") for each in ("start", "stop"))
        # The end has no field while a step is shown, so nobody can have typed it for this start.
        if self.kind in ENDING and stop <= start:
            values[f"{self.name}_stop"] = start + LASTS
        return setting(state, Motor, values)
