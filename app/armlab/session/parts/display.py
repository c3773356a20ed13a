"""Switches of what is drawn besides the arm."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.session.state import Command, Json, Part, PartType, State

SYSTEM_DARK = "system_dark"
"""Switch that the browser sets: whether the person's system asks for dark pages. It holds until "dark" is set."""

OF_THE_SCREEN = ("dark", SYSTEM_DARK, "shadows")
"""Switches that suit a room and a computer, not the content: everybody keeps their own."""

NAME = re.compile(r"[a-z0-9_]{1,40}\Z")
MOST = 100


@dataclass(frozen=True)
class Display(Part):
    """Switches of the picture that a person has set; they stay when the arm changes.

    Attributes
    ----------
    switches : mapping of str to bool
        Switches by name. The names and their defaults are defined where the switches take effect.
    """

    key: ClassVar[str] = "display"
    called: ClassVar[str] = "what is drawn"
    kept_by_undo: ClassVar[bool] = True

    switches: Mapping[str, bool] = field(default_factory=lambda: MappingProxyType({}))

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the switches a student sees first."""
        return cls()

    def of_screen(self) -> dict[str, bool]:
        """Return the switches that are personal."""
        return {name: on for name, on in self.switches.items() if name in OF_THE_SCREEN}

    def for_robot(self, robot: Robot) -> Self:
        """Return the part unchanged."""
        return self

    def to_json(self) -> Json:
        """Return the switches as JSON."""
        return dict(self.switches)

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return the switches from JSON."""
        return cls(MappingProxyType({name: bool(on) for name, on in data.items() if NAME.match(name)}))


PART = PartType(Display, order=30)


@dataclass(frozen=True)
class Show(Command):
    """Set one switch of the picture."""

    name: str
    on: bool
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the switch set."""
        switches = state[Display].switches
        if not NAME.match(self.name) or (self.name not in switches and len(switches) >= MOST):
            raise InputError(f"display: not the name of a switch: {self.name[:40]!r}")
        if switches.get(self.name) == self.on:
            return state
        return state.replace(Display(MappingProxyType({**switches, self.name: self.on})))
