"""Two formulas compared at seeded points: whether they agree, or where they differ most and by how much.

Everything is worked out with complex numbers, at all points at once. Nothing is ever executed: formulas are read by the
parser of `armlab.content.expressions`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.content.complex_values import CONSTANTS, Values
from armlab.content.expressions import FUNCTIONS, LONGEST, MORE_FUNCTIONS, Expression, parse
from armlab.content.symbols import plain_symbols
from armlab.errors import InputError
from armlab.registry import known_name

Complexes = NDArray[np.complex128]

POINTS = 50
"""Number of points at which two formulas are compared."""

DRAWN = 20 * POINTS
"""Number of points that are drawn to find so many at which both have a value."""

TOLERANCE = 1e-9
"""Largest difference of two values that agree, in their own size where that is above 1."""

LARGEST = 1e6
"""Largest number on the way to a value: beyond, near a pole, too many digits are lost to compare."""

SEED = 1

KINDS: dict[str, str] = {
    "real": "real",
    "positive": "positive",
    "angle": "angle",
    "whole": "whole",
    "complex": "complex",
}
"""Kinds of variables: real from -6 to 6, positive up to 6, angles in (-pi, pi], whole numbers from -4 to 4, complex."""

GREEK = dict(
    zip(
        "αβγδεζηθϑκλμνξρστφϕχψω",
        (
            *("alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "theta", "kappa", "lambda"),
            *("mu", "nu", "xi", "rho", "sigma", "tau", "phi", "phi", "chi", "psi", "omega"),
        ),
        strict=True,
    )
)
"""Greek letters and the names that stand for them."""

LETTERS = tuple("abcdfghjklmnopqrstuvwxyz")
"""Letters that are variables: all but e and i, which are numbers."""

MOST_NAMES = 6
"""Largest number of variables of two formulas."""

ALLOWED = (*FUNCTIONS, *MORE_FUNCTIONS)

_WORD = re.compile(r"[^\W\d]\w*")


@lru_cache(maxsize=256)
def read_formula(text: str) -> Expression:
    """Read a formula in any variables: letters, Greek letters or their names, perhaps with a number behind.

    ``e`` and ``i`` are numbers. Functions need brackets.

    Raises
    ------
    InputError
        As of `armlab.content.expressions.parse`.

    Examples
    --------
    >>> sorted(read_formula("e^(i θ1) + x").names)
    ['e', 'i', 'theta1', 'x']
    """
    if not isinstance(text, str):
        raise InputError("expected a formula")
    if len(text) > LONGEST:
        raise InputError(f"expected a formula of at most {LONGEST} characters, got {len(text)}")
    source = plain_symbols(text)
    for letter, name in GREEK.items():
        source = source.replace(letter, name)
    names = {*LETTERS, *CONSTANTS, *GREEK.values()}
    for found in _WORD.finditer(source):
        word = found[0]
        _refuse_without_bracket(word, source[found.end() :].lstrip()[:1])
        base = word.rstrip("0123456789").rstrip("_")
        if base in names and base not in CONSTANTS:
            names.add(word.replace("_", ""))
    return parse(source, names, ALLOWED)


def _refuse_without_bracket(word: str, following: str) -> None:
    """Refuse a function without its bracket, which could be taken for a product of letters."""
    lowered = word.lower()
    if lowered in ALLOWED:
        if following not in ("(", "^"):
            raise InputError(f"expected a bracket after {lowered}, as in {lowered}(x)")
        return
    for function in sorted(ALLOWED, key=len, reverse=True):
        if len(function) > 2 and lowered.startswith(function):
            raise InputError(f"expected a bracket after {function}, as in {function}({word[len(function) :][:20]})")


def variables_of(*formulas: Expression) -> tuple[str, ...]:
    """Return the variables of formulas in alphabetical order; `InputError` when there are too many."""
    names = sorted(set().union(*(formula.names for formula in formulas)) - set(CONSTANTS))
    if len(names) > MOST_NAMES:
        raise InputError(f"expected at most {MOST_NAMES} variables, got {len(names)}: {', '.join(names)}")
    return tuple(names)


def usual_kind(name: str) -> str:
    """Return the kind that a variable has if nothing is said: n, k, m are whole, z and w complex, others real."""
    letter = name.rstrip("0123456789")
    return "whole" if letter in ("n", "k", "m") else "complex" if letter in ("z", "w") else "real"


@dataclass(frozen=True, eq=False)
class Comparison:
    """Values of two formulas at the points at which both have one.

    Attributes
    ----------
    names : tuple of str
        Variables.
    points : ndarray, shape (N, len(names))
    left, right : ndarray, shape (N,)
    drawn : int
        Points that were drawn to find these.
    """

    names: tuple[str, ...]
    points: Complexes
    left: Complexes
    right: Complexes
    drawn: int

    @property
    def difference(self) -> NDArray[np.float64]:
        """How far the values are apart, shape (N,)."""
        return np.asarray(np.abs(self.left - self.right))

    @property
    def close(self) -> NDArray[np.bool_]:
        """Where they agree within `TOLERANCE`, shape (N,)."""
        size = np.maximum(1.0, np.maximum(np.abs(self.left), np.abs(self.right)))
        return np.asarray(self.difference <= TOLERANCE * size)

    @property
    def agrees(self) -> bool:
        """Whether they agree at every point, and there are as many as should be."""
        return len(self.left) == POINTS and bool(self.close.all())

    @property
    def worst(self) -> int:
        """The point at which they differ most."""
        return int(np.argmax(self.difference))

    @property
    def opposite(self) -> bool:
        """Whether one is the other with the opposite sign, at every point."""
        size = np.maximum(1.0, np.abs(self.left))
        away = np.abs(self.left + self.right) <= TOLERANCE * size
        return len(away) > 0 and not self.agrees and bool(away.all())


def compare(left: Expression, right: Expression, kinds: Mapping[str, str], seed: int = SEED) -> Comparison:
    """Compare two formulas at `POINTS` points, which are the same for the same seed.

    Parameters
    ----------
    left, right : Expression
        Read by `read_formula`.
    kinds : mapping of str to str
        Kinds of variables, of `KINDS`; others are the usual ones.
    seed : int

    Raises
    ------
    InputError
        Too many variables, an unknown kind, a power that is too large.

    Examples
    --------
    >>> compare(read_formula("sin(2x)"), read_formula("2 sin(x) cos(x)"), {}).agrees
    True
    """
    names = variables_of(left, right)
    points = draws(names, kinds, seed)
    given = {name: points[:, k] for k, name in enumerate(names)}
    (one, well), (other, too) = (values_of(formula, given) for formula in (left, right))
    kept = np.flatnonzero(well & too)[:POINTS]
    drawn = int(kept[-1]) + 1 if len(kept) == POINTS else DRAWN
    return Comparison(names, points[kept], one[kept], other[kept], drawn)


def values_of(formula: Expression, given: Mapping[str, Complexes]) -> tuple[Complexes, NDArray[np.bool_]]:
    """Return the values of a formula at points, and at which of them it has one that can be compared, (N,) each."""
    count = len(next(iter(given.values()), np.zeros(DRAWN)))
    fold = Values(given, count)
    with np.errstate(all="ignore"):
        values = formula.folded(fold)
    return values, fold.largest <= LARGEST


def draws(names: tuple[str, ...], kinds: Mapping[str, str], seed: int) -> Complexes:
    """Return the points that are drawn, (DRAWN, len(names))."""
    rng = np.random.default_rng(seed)
    columns = [_drawn(rng, known_name("kind", kinds.get(name, usual_kind(name)), KINDS)) for name in names]
    return np.stack(columns, axis=1) if columns else np.zeros((DRAWN, 0), dtype=complex)


def _drawn(rng: np.random.Generator, kind: str) -> Complexes:
    one, other = rng.uniform(-1.0, 1.0, (2, DRAWN))
    if kind == "complex":
        return np.asarray(2.0 * (one + 1j * other))
    if kind == "whole":
        return np.asarray(np.round(4.4 * one) + 0j)
    return np.asarray({"real": 6.0 * one, "positive": 3.0 * (one + 1.0) + 1e-3, "angle": np.pi * one}[kind] + 0j)
