"""What is drawn besides the arm."""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.errors import UnknownName
from armlab.session.state import Command, Json, Part, PartType, State


@dataclass(frozen=True)
class Display(Part):
    """Switches of the picture; they stay when the arm changes.

    Attributes
    ----------
    frames, names, skeleton, trace : bool
        All Denavit-Hartenberg frames; the names q1 ... at the joints; textbook symbols instead of bodies; the path of
        the tool point.
    shadows : bool
        Half the work of drawing, on a computer without a graphics processor.
    dark : bool
        The dark theme.
    """

    key: ClassVar[str] = "display"

    frames: bool = False
    names: bool = True
    skeleton: bool = False
    trace: bool = False
    shadows: bool = True
    dark: bool = False

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the picture a student sees first."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything."""
        return self

    def to_json(self) -> Json:
        """Write the switches."""
        return asdict(self)

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read the switches there are."""
        return cls(**{name: bool(data[name]) for name in asdict(cls()) if name in data})


PART = PartType(Display, order=30)


@dataclass(frozen=True)
class Show(Command):
    """Set one switch of the picture."""

    name: str
    on: bool
    label: ClassVar[str] = "picture"

    def apply(self, state: State) -> State:
        """Return the state with the switch set."""
        display = state[Display]
        if self.name not in asdict(display):
            raise UnknownName("display", self.name, asdict(display))
        changed = replace(display, **{self.name: self.on})
        return state if changed == display else state.replace(changed)
