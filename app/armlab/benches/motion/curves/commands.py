"""Commands for curves through typed knots."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.curves.fastest import Asked
from armlab.benches.motion.curves.knots import Knot, checked, inserted, without
from armlab.benches.motion.curves.made import Drawn, fitted, free_options, in_knots, kinds, made, why_not
from armlab.benches.motion.curves.state import MOST_CURVES, Curves
from armlab.errors import InputError, UnknownName
from armlab.kin.motion.law_types import free_law_types
from armlab.registry import known_name
from armlab.session.fields import setting
from armlab.session.state import Command, State

Limit = Literal["v_max", "a_max"]
LIMITS: tuple[Limit, ...] = ("v_max", "a_max")


def _with_knots(state: State, knots: tuple[Knot, ...]) -> State:
    """Return the state with other knots; a curve that cannot go through them stays in the list with the reason.

    Times of virtual knots that do not fit them are left out, and the curve says that.
    """
    part = state[Curves]
    if knots == part.knots:
        return state
    curves = tuple(fitted(knots, each) for each in part.curves)
    return setting(state, Curves, {"knots": knots, "curves": curves})


def _curve(part: Curves, i: int) -> Drawn:
    if not 0 <= i < len(part.curves):
        raise InputError(f"curve: expected 1 to {len(part.curves)}, got {i + 1}")
    return part.curves[i]


def _with_curve(state: State, i: int, drawn: Drawn) -> State:
    """Return the state with a curve changed; `InputError` if no curve can be drawn."""
    part = state[Curves]
    if drawn == part.curves[i]:
        return state
    made(part.knots, drawn)
    drawn = replace(drawn, dropped=False)
    return setting(state, Curves, {"curves": (*part.curves[:i], drawn, *part.curves[i + 1 :])})


@dataclass(frozen=True)
class SetKnots(Command):
    """Set other knots: rows of t in seconds and q in its unit."""

    rows: tuple[tuple[float, ...], ...]
    label: ClassVar[str] = "knots"

    def apply(self, state: State) -> State:
        """Return the state with the knots."""
        return _with_knots(state, checked(self.rows, state[Curves].unit))


@dataclass(frozen=True)
class SetKnot(Command):
    """Set one cell of the table of knots: ``"t"`` or ``"q"`` of knot k (0-based)."""

    k: int
    cell: str
    value: float
    label: ClassVar[str] = "knot"

    def apply(self, state: State) -> State:
        """Return the state with the cell changed."""
        knots = [list(knot) for knot in state[Curves].knots]
        if not 0 <= self.k < len(knots):
            raise InputError(f"knot: expected 1 to {len(knots)}, got {self.k + 1}")
        if self.cell not in ("t", "q"):
            raise UnknownName("cell", self.cell, ("t", "q"))
        knots[self.k]["tq".index(self.cell)] = self.value
        return _with_knots(state, checked(knots, state[Curves].unit))


@dataclass(frozen=True)
class AddKnot(Command):
    """Add a knot after knot k (0-based)."""

    after: int
    label: ClassVar[str] = "added knot"

    def apply(self, state: State) -> State:
        """Return the state with one more knot."""
        return _with_knots(state, inserted(state[Curves].knots, self.after))


@dataclass(frozen=True)
class RemoveKnot(Command):
    """Remove a knot (0-based); two stay."""

    k: int
    label: ClassVar[str] = "removed knot"

    def apply(self, state: State) -> State:
        """Return the state without the knot."""
        return _with_knots(state, without(state[Curves].knots, self.k))


@dataclass(frozen=True)
class AddCurve(Command):
    """Add a curve of a kind that can go through the knots and is not drawn yet."""

    label: ClassVar[str] = "added curve"

    def apply(self, state: State) -> State:
        """Return the state with one more curve."""
        part = state[Curves]
        if len(part.curves) >= MOST_CURVES:
            raise InputError(f"curves: at most {MOST_CURVES}")
        colour = min({*range(MOST_CURVES)} - {each.colour for each in part.curves})
        there = {each.path.key for each in part.curves}
        fitting = [kind for kind in kinds().values() if not why_not(kind, part.knots)]
        # Those that know of time first, and the last in the list before the plain ones.
        fitting.sort(key=lambda kind: (len(free_options(kind)) == len(kind.fields), -kind.order))
        key = next((kind.key for kind in fitting if kind.key not in there), fitting[0].key)
        drawn = Drawn(colour, Chosen(key))
        made(part.knots, drawn)
        more = (*part.curves, drawn)
        return setting(state, Curves, {"curves": more, "selected": len(more) - 1})


@dataclass(frozen=True)
class RemoveCurve(Command):
    """Remove a curve (0-based); one stays."""

    i: int
    label: ClassVar[str] = "removed curve"

    def apply(self, state: State) -> State:
        """Return the state without the curve."""
        part = state[Curves]
        _curve(part, self.i)
        if len(part.curves) == 1:
            raise InputError("curves: at least one")
        left = (*part.curves[: self.i], *part.curves[self.i + 1 :])
        selected = part.selected - (part.selected > self.i)
        return setting(state, Curves, {"curves": left, "selected": min(selected, len(left) - 1)})


@dataclass(frozen=True)
class ChoosePath(Command):
    """Draw a curve (0-based) as another kind of path, with its options at their defaults; the law stays."""

    i: int
    path: str
    label: ClassVar[str] = "kind of curve"

    def apply(self, state: State) -> State:
        """Return the state with the kind."""
        drawn = _curve(state[Curves], self.i)
        if self.path == drawn.path.key:
            return state
        return _with_curve(state, self.i, replace(drawn, path=Chosen.of(kinds(), self.path)))


@dataclass(frozen=True)
class ChooseLaw(Command):
    """Run through a curve (0-based) by another timing law, with its options at their defaults."""

    i: int
    law: str
    label: ClassVar[str] = "law of a curve"

    def apply(self, state: State) -> State:
        """Return the state with the law."""
        drawn = _curve(state[Curves], self.i)
        if self.law == drawn.law.key:
            return state
        return _with_curve(state, self.i, replace(drawn, law=Chosen.of(free_law_types(), self.law)))


@dataclass(frozen=True)
class SetOption(Command):
    """Set an option of a curve (0-based), of its ``"path"`` or its ``"law"``; None restores its default."""

    i: int
    of: str
    name: str
    value: Any
    label: ClassVar[str] = "option of a curve"

    def apply(self, state: State) -> State:
        """Return the state with the option."""
        drawn = _curve(state[Curves], self.i)
        try:
            if self.of == "path":
                changed = replace(drawn, path=drawn.path.with_option(kinds()[drawn.path.key], self.name, self.value))
            else:
                changed = replace(
                    drawn, law=drawn.law.with_option(free_law_types()[drawn.law.key], self.name, self.value)
                )
        except InputError as refusal:
            raise InputError(in_knots(str(refusal))) from None
        return _with_curve(state, self.i, changed)


@dataclass(frozen=True)
class SetLimit(Command):
    """Set ``"v_max"`` or ``"a_max"``, or remove it (None)."""

    which: Limit
    value: float | None
    label: ClassVar[str] = "limit"

    def apply(self, state: State) -> State:
        """Return the state with the limit."""
        known_name("limit", self.which, LIMITS)
        limits = list(state[Curves].limits)
        limits[LIMITS.index(self.which)] = self.value
        return setting(state, Curves, {"limits": limits})


@dataclass(frozen=True)
class FindFastest(Command):
    """Look for the intervals between the knots with which a spline takes the least time under both limits."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state in which the search runs."""
        part = state[Curves]
        if part.v_max is None or part.a_max is None:
            raise InputError("limits: the fastest intervals need both v_max and a_max; type them above the plots")
        asked = Asked(part.knots, part.v_max, part.a_max, part.ends)
        asked.check()
        known = part.fastest is not None and part.fastest.asked == asked
        return state if known else state.replace(replace(part, asked=asked, fastest=None))


@dataclass(frozen=True)
class TakeFastest(Command):
    """Give the knots the times of the fastest intervals."""

    label: ClassVar[str] = "fastest intervals"

    def apply(self, state: State) -> State:
        """Return the state with the times; the result of the search stays."""
        part = state[Curves]
        if part.fastest is None:
            raise InputError("fastest intervals: none have been found yet")
        if part.knots == part.fastest.knots:
            return state
        curves = tuple(fitted(part.fastest.knots, each) for each in part.curves)
        return state.replace(replace(part, knots=part.fastest.knots, curves=curves, example=""))
