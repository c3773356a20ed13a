"""The page of identities: two formulas, the kinds of their variables, and the seed of the points."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

from armlab.content.expressions import Expression
from armlab.content.identity import KINDS, Comparison, compare, read_formula, usual_kind, variables_of
from armlab.errors import InputError
from armlab.registry import known_name
from armlab.session.fields import FieldPart, own, setting, whole
from armlab.session.state import Command, Json, PartType, State

SIDES = ("left", "right")

MOST_SEED = 9999

Kinds = tuple[tuple[str, str], ...]


def _read_side(data: Json) -> str:
    text = data.strip()
    read_formula(text)
    return str(text)


def _read_kinds(data: Json) -> Kinds:
    found = {str(name): known_name("kind", kind, KINDS) for name, kind in data}
    return tuple(sorted((name, kind) for name, kind in found.items() if kind != usual_kind(name)))


@dataclass(frozen=True)
class Identities(FieldPart):
    """An identity that may hold.

    Attributes
    ----------
    left, right : str
        Formulas, as they were typed.
    kinds : tuple of (str, str)
        Variables with another kind than the usual one.
    seed : int
        Of the points.
    """

    key: ClassVar[str] = "identities"

    left: str = own("left side", "sin(x + y)", _read_side)
    right: str = own("right side", "sin(x) cos(y) + cos(x) sin(y)", _read_side)
    kinds: Kinds = own("kinds of variables", (), _read_kinds)
    seed: int = whole("seed of the points", 1, 1, MOST_SEED)

    def check(self) -> None:
        """Refuse formulas that cannot be compared, such as those with a power that is too large."""
        compared(self.left, self.right, self.kinds, self.seed)


PART = PartType(Identities, order=123)


@lru_cache(maxsize=64)
def compared(left: str, right: str, kinds: Kinds, seed: int) -> Comparison:
    """Return how two typed formulas compare."""
    return compare(read_formula(left), read_formula(right), dict(kinds), seed)


def comparison_of(state: State) -> Comparison:
    """Return how the formulas of the page compare."""
    part = state[Identities]
    return compared(part.left, part.right, part.kinds, part.seed)


def formulas_of(state: State) -> tuple[Expression, Expression]:
    """Return both formulas as they were read."""
    part = state[Identities]
    return read_formula(part.left), read_formula(part.right)


def kinds_of(state: State) -> dict[str, str]:
    """Return the kind of each variable of the formulas."""
    chosen = dict(state[Identities].kinds)
    return {name: chosen.get(name, usual_kind(name)) for name in variables_of(*formulas_of(state))}


@dataclass(frozen=True)
class SetSide(Command):
    """Set the left or the right side to a typed formula."""

    side: str
    text: str
    label: ClassVar[str] = "side of an identity"

    def apply(self, state: State) -> State:
        """Return the state with the formula; `InputError` says what is wrong with it, and on which side."""
        known_name("side", self.side, SIDES)
        try:
            return setting(state, Identities, {self.side: self.text})
        except InputError as error:
            raise InputError(f"{self.side} side: {error}") from None


@dataclass(frozen=True)
class SetIdentity(Command):
    """Set both sides; the variables have their usual kinds."""

    left: str
    right: str
    label: ClassVar[str] = "identity"

    def apply(self, state: State) -> State:
        """Return the state with both formulas."""
        return setting(state, Identities, {"left": self.left, "right": self.right, "kinds": ()})


@dataclass(frozen=True)
class SetKind(Command):
    """Set the kind of a variable."""

    name: str
    kind: str
    label: ClassVar[str] = "kind of a variable"

    def apply(self, state: State) -> State:
        """Return the state in which the variable is of this kind."""
        known_name("variable", self.name, kinds_of(state))
        kinds = {**dict(state[Identities].kinds), self.name: self.kind}
        return setting(state, Identities, {"kinds": tuple(kinds.items())})


@dataclass(frozen=True)
class OtherPoints(Command):
    """Compare at other points: those of the next seed."""

    label: ClassVar[str] = "other points"

    def apply(self, state: State) -> State:
        """Return the state with the next seed."""
        return setting(state, Identities, {"seed": state[Identities].seed % MOST_SEED + 1})
