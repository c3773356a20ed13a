"""Facts of two compared formulas that lessons can check."""

from __future__ import annotations

import re
from typing import NamedTuple

from armlab.benches.help.identities.state import Identities, comparison_of, formulas_of
from armlab.content.expressions import Expression
from armlab.content.identity import ALLOWED
from armlab.content.symbols import plain_symbols
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _alike(state: State) -> bool:
    """Return whether both sides are typed with the same letters."""
    left, right = (re.sub(r"\s", "", plain_symbols(side)) for side in (state[Identities].left, state[Identities].right))
    return left == right


def _largest(state: State) -> float | None:
    found = comparison_of(state)
    return float(found.difference.max()) if len(found.left) else None


def _names(state: State) -> str:
    left, right = formulas_of(state)
    return " ".join(sorted(left.names | right.names))


def _proved(state: State) -> bool:
    return comparison_of(state).agrees and not _alike(state)


class _Functions:
    """Collects the functions of a formula."""

    def number(self, value: float) -> tuple[str, ...]:
        return ()

    def name(self, name: str) -> tuple[str, ...]:
        return ()

    def operation(self, operation: str, arguments: list[tuple[str, ...]]) -> tuple[str, ...]:
        own = (operation,) if operation in ALLOWED else ()
        return own + tuple(name for found in arguments for name in found)


class _Sum(NamedTuple):
    """Whether a part of a formula has a sum, and whether there is one inside a function or a power."""

    has: bool = False
    inside: bool = False


class _Sums:
    """Finds the sums of a formula."""

    def number(self, value: float) -> _Sum:
        return _Sum()

    def name(self, name: str) -> _Sum:
        return _Sum()

    def operation(self, operation: str, arguments: list[_Sum]) -> _Sum:
        has = any(each.has for each in arguments)
        closed = operation == "^" or operation in ALLOWED
        return _Sum(has or operation in ("+", "-"), any(each.inside for each in arguments) or (closed and has))


def _functions(formula: Expression) -> str:
    found: tuple[str, ...] = formula.folded(_Functions())
    return " ".join(sorted(found))


FACTS = Facts(
    __name__,
    (Identities,),
    {
        "agrees": Fact("whether both sides agree at all points", lambda s: comparison_of(s).agrees, kind="truth"),
        "holds": Fact("whether both sides agree, and are typed differently", _proved, kind="truth"),
        "left": Fact("the left side, as it was typed", lambda s: s[Identities].left, kind="text"),
        "right": Fact("the right side, as it was typed", lambda s: s[Identities].right, kind="text"),
        "expanded": Fact(
            "whether no sum stands inside a function or a power of the right side",
            lambda s: not formulas_of(s)[1].folded(_Sums()).inside,
            kind="truth",
        ),
        "left_functions": Fact(
            "all functions of the left side, in alphabetical order",
            lambda s: _functions(formulas_of(s)[0]),
            kind="text",
        ),
        "right_functions": Fact(
            "all functions of the right side, in alphabetical order",
            lambda s: _functions(formulas_of(s)[1]),
            kind="text",
        ),
        "names": Fact("the letters of both sides, in alphabetical order", _names, kind="text"),
        "largest": Fact("the largest difference of both sides", _largest),
        "close": Fact(
            "the number of points at which they agree", lambda s: int(comparison_of(s).close.sum()), "", "count"
        ),
        "points": Fact("the number of points that were compared", lambda s: len(comparison_of(s).left), "", "count"),
    },
)
