"""Switches for parts of the picture, with key and hint."""

from __future__ import annotations

from dataclasses import dataclass

from armlab.session.parts.display import SYSTEM_DARK, Display
from armlab.session.state import State


@dataclass(frozen=True)
class Switch:
    """One switch.

    Parameters
    ----------
    name : str
        Under which the state keeps it.
    title, hint : str
    key : str
        The letter that toggles it; empty for none.
    default : bool
        Its position while it has not been set.
    about : tuple of str
        Other words by which it is found.
    follows : str
        Name of another switch that it goes with until then; empty for none.
    """

    name: str
    title: str
    hint: str
    key: str = ""
    default: bool = False
    about: tuple[str, ...] = ()
    follows: str = ""

    def on(self, state: State) -> bool:
        """Return whether the switch is on."""
        switches = state[Display].switches
        return switches.get(self.name, switches.get(self.follows, self.default))


SKELETON = Switch(
    "skeleton",
    "Skeleton",
    "Textbook symbols instead of bodies: cylinders are revolute joints, boxes prismatic ones.",
    "K",
    about=("stick figure", "schematic"),
)
SHADOWS = Switch(
    "shadows",
    "Shadows",
    "Without shadows the picture is drawn twice as fast on a weak graphics processor.",
    default=True,
    about=("slow picture", "graphics"),
)
DARK = Switch(
    "dark",
    "Dark theme",
    "Light on dark, for a dark room.",
    "L",
    about=("dark mode", "light mode", "light theme", "night"),
    follows=SYSTEM_DARK,
)

GENERAL = (SHADOWS, DARK)
"""Switches that do not belong to one layer."""
