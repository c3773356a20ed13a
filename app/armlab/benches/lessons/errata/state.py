"""The erratum that is looked at, what the list shows of the others, and the points at which both forms are run."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from armlab.content.errata import CHAPTERS, SEVERITIES, Erratum, errata, erratum, find
from armlab.registry import known_name
from armlab.session.fields import FieldPart, choice, flag, setting, text, whole
from armlab.session.state import Command, PartType, State

if TYPE_CHECKING:
    from armlab.kin.errata import Trial

FIRST = "1.58"
"""Erratum with which the page opens: short, and wrong at every point."""

ALL = "all"
"""Choice of every severity or chapter."""

VIEWS = {"look": "Look up", "practise": "Spot the error"}

LARGEST_SEED = 999


@dataclass(frozen=True)
class Found:
    """Residuals of a run, perhaps of its first points only.

    Attributes
    ----------
    key : str
        Id of the erratum.
    seed : int
    quiet : bool
    printed, correct : tuple of float
        Of the points so far; infinite where a form has no value.
    complete : bool
        Whether all points have been run.
    trial : Trial or None
        What was run; None before the first point.
    """

    key: str
    seed: int
    quiet: bool
    printed: tuple[float, ...] = ()
    correct: tuple[float, ...] = ()
    complete: bool = False
    trial: Trial | None = None

    @property
    def worst_printed(self) -> float:
        """The largest residual of the printed form so far."""
        return float(np.max(self.printed, initial=0.0))

    @property
    def worst_correct(self) -> float:
        """The largest residual of the correct form so far."""
        return float(np.max(self.correct, initial=0.0))


@dataclass(frozen=True)
class Errata(FieldPart):
    """The choices on the page of the errata, and what came of the last run.

    Attributes
    ----------
    found : Found or None
        What the job has found; not saved.
    """

    key: ClassVar[str] = "errata"
    kept_by_undo: ClassVar[bool] = True

    chosen: str = text("erratum", FIRST, 20)
    view: str = choice("view", "look", VIEWS)
    query: str = text("search", "", 60)
    severity: str = choice("severity", ALL, {ALL: "all", **SEVERITIES})
    chapter: str = choice("chapter", ALL, (ALL, *CHAPTERS))
    seed: int = whole("seed of the points", 1, 1, LARGEST_SEED)
    quiet: bool = flag("points at which the error is not seen", False)
    example: str = text("example", "", 40)
    found: Found | None = None

    def check(self) -> None:
        """Raise `UnknownName` for an erratum that is not there; that of a fresh page is not looked up at the start."""
        if self.chosen != FIRST:
            known_name("erratum", self.chosen, errata())

    @property
    def erratum(self) -> Erratum:
        """The chosen erratum."""
        return erratum(self.chosen)

    @property
    def listed(self) -> tuple[Erratum, ...]:
        """The errata that the list shows."""
        severity, chapter = ("" if each == ALL else each for each in (self.severity, self.chapter))
        return find(self.query, severity, chapter)

    @property
    def run(self) -> Found | None:
        """The residuals at the present points; None before the first."""
        found = self.found
        wanted = (self.chosen, self.seed, self.quiet)
        return found if found is not None and (found.key, found.seed, found.quiet) == wanted else None


@dataclass(frozen=True)
class Choose(Command):
    """Look at an erratum, by its id such as 5.58."""

    key: str
    label: ClassVar[str] = "erratum"
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the erratum chosen, and seen in the list; `UnknownName` when it is not there."""
        state = setting(state, Errata, {"chosen": self.key, "quiet": False})
        part = state[Errata]
        if part.erratum not in part.listed:
            state = state.replace(replace(part, query="", severity=ALL, chapter=ALL))
        return state


@dataclass(frozen=True)
class RunAgain(Command):
    """Run both forms at other points."""

    label: ClassVar[str] = "other points"
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the next seed."""
        seed = state[Errata].seed % LARGEST_SEED + 1
        return setting(state, Errata, {"seed": seed})


PART = PartType(Errata, order=96)
