"""The page of harmonic drives: numbers of teeth, and which part is fixed."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from armlab.errors import InputError
from armlab.kin.drive.strain_wave import FEWEST, FIXED, MOST, StrainWave, strain_wave
from armlab.session.fields import FieldPart, Set, choice, flag, setting, text, whole
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import Command, PartType, State

CLIP_KEY = "harmonic"

TURN = 6.0
"""Time in which the input turns once in the film, seconds."""

TURNS = 3
"""Number of turns of the input in the film."""


@dataclass(frozen=True)
class Harmonic(FieldPart):
    """Choices of the page, which do not depend on the arm.

    Attributes
    ----------
    flexspline : int
        N_FS, its number of teeth.
    difference : int
        N_CS - N_FS.
    fixed : "circular", "flexible" or "generator"
    names : bool
        Whether the names of the parts are written in the scene.
    example : str
        Key of the example in place; empty when something has been changed.
    """

    key: ClassVar[str] = "harmonic"
    clip: ClassVar[str] = CLIP_KEY
    looks: ClassVar[tuple[str, ...]] = ("names",)

    flexspline: int = whole("teeth of the flexspline", 60, FEWEST, MOST)
    difference: int = whole("teeth that the circular spline has more", 2, -MOST, MOST)
    fixed: str = choice("part that is fixed", "circular", FIXED)
    names: bool = flag("names of the parts", True)
    example: str = text("example", "sixty")

    def check(self) -> None:
        """Refuse numbers of teeth that make no harmonic drive."""
        strain_wave(self.flexspline, self.difference, self.fixed)

    @cached_property
    def drive(self) -> StrainWave:
        """The drive."""
        return StrainWave(self.flexspline, self.difference, self.fixed)


PART = PartType(Harmonic, order=134)


@dataclass(frozen=True)
class ShowTurns(Command):
    """Show the film after this many whole turns of the input, 0 to 3, paused."""

    turns: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the film open there."""
        if not 0 <= self.turns <= TURNS:
            raise InputError(f"turns: expected 0 to {TURNS}, got {self.turns}")
        if state[Timeline].clip != CLIP_KEY or state[Timeline].playing:
            state = OpenClip(CLIP_KEY).apply(OpenClip("").apply(state))
        return Seek(TURN * self.turns).apply(state)


@dataclass(frozen=True)
class SetCircular(Command):
    """Set the number of teeth of the circular spline; that of the flexspline stays."""

    teeth: int
    label: ClassVar[str] = "teeth of the circular spline"

    def apply(self, state: State) -> State:
        """Return the state with the difference of the teeth that this means."""
        return Set(Harmonic, "difference", self.teeth - state[Harmonic].flexspline).apply(state)


@dataclass(frozen=True)
class SetSplines(Command):
    """Set the numbers of teeth of flexspline and circular spline together."""

    flexspline: int
    circular: int
    label: ClassVar[str] = "numbers of teeth"

    def apply(self, state: State) -> State:
        """Return the state with both."""
        values = {"flexspline": self.flexspline, "difference": self.circular - self.flexspline}
        return setting(state, Harmonic, values)
