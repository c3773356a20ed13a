"""The student has looked at something: a switch is on, a panel is open, a film was played to its end."""

from __future__ import annotations

from dataclasses import dataclass

from armlab.content.check import PLAIN, CheckType, Words
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot


@dataclass(frozen=True)
class LookedAt:
    """Everything that is named; an empty name does not count."""

    switch: str = ""
    panel: str = ""
    film: str = ""

    @property
    def noted(self) -> tuple[str, ...]:
        """Conditions that no file proves."""
        told = (
            (self.panel, "that a panel was open"),
            (self.switch, "that a switch was on"),
            (self.film, "that a film was played"),
        )
        return tuple(words for name, words in told if name)

    @property
    def panels(self) -> tuple[str, ...]:
        """Key of the panel that it asks to open."""
        return (self.panel,) if self.panel else ()

    @property
    def switches(self) -> tuple[str, ...]:
        """Name of the switch that it asks to be on."""
        return (self.switch,) if self.switch else ()

    def is_met(self, observation: Observation) -> bool:
        """Return whether all conditions are met."""
        return not self._missing(observation)

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on the first thing still to be done."""
        missing = self._missing(observation, words)
        return missing[0] if missing else "You have looked at it."

    def _missing(self, observation: Observation, words: Words = PLAIN) -> list[str]:
        missing = []
        if self.panel and observation.panel != self.panel:
            missing.append(f"Open the panel “{words.title(self.panel)}”.")
        if self.switch and self.switch not in observation.switches:
            missing.append(f"Switch on “{words.title(self.switch)}”.")
        if self.film and self.film not in observation.films:
            missing.append(f"Play the film “{words.title(self.film)}” to its end.")
        return missing


def read(table: Table, robot: Robot) -> LookedAt:
    """Read ``switch``, ``panel`` and ``film``, by their names in the lab; at least one of them."""
    names = {key: table.text(key) for key in ("switch", "panel", "film") if table.has(key)}
    if not names:
        raise table.fail("panel", "missing; expected one of switch, panel, film")
    return LookedAt(**names)


CHECK = CheckType("looked_at", 120, read)
