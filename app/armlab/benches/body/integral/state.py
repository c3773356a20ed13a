"""The page of the integral of omega: two time laws, each of pieces with a constant angular velocity."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from armlab.errors import InputError
from armlab.kin.checks import as_floats
from armlab.session.counted import refuse_beyond
from armlab.session.fields import FieldPart, Set, choice, own
from armlab.session.state import Command, Json, PartType, State

CLIP_KEY = "integral"

MOST_PIECES = 6
"""Largest number of pieces of a law."""

MOST_AXIS = 1e6
FASTEST = 20.0
"""Largest rate, rad/s."""

SHORTEST, LONGEST = 0.01, 20.0
"""Durations of a piece, seconds."""

ABOUT = {"base": "base axes", "body": "body axes"}

AXIS, RATE, SECONDS = 3, 3, 4
"""Number of components of the axis, and places of rate and duration behind it."""

QUARTER = 0.5 * math.pi


class Piece(NamedTuple):
    """A time in which omega is constant.

    Attributes
    ----------
    x, y, z : float
        Its axis, which need not be of unit length.
    rate : float
        About it, rad/s.
    seconds : float
    """

    x: float
    y: float
    z: float
    rate: float
    seconds: float


Law = tuple[Piece, ...]

NAMES = ("x", "y", "z", "rate", "duration")


def _read(data: Json) -> tuple[Law, Law]:
    one, other = (tuple(_piece(piece, f"law {k + 1}") for piece in law) for k, law in enumerate(data))
    for k, law in enumerate((one, other)):
        if not 1 <= len(law) <= MOST_PIECES:
            raise InputError(f"law {k + 1}: expected 1 to {MOST_PIECES} pieces, got {len(law)}")
    return one, other


def _piece(data: Sequence[float], where: str) -> Piece:
    values = as_floats(data, where, "5 numbers for a piece")
    if values.shape != (5,):
        raise InputError(f"{where}: expected 5 numbers for a piece, got {values.size}")
    piece = Piece(*values.tolist())
    if not all(map(math.isfinite, piece)) or max(map(abs, piece[:AXIS])) > MOST_AXIS:
        raise InputError(f"{where}: expected an axis of finite numbers up to {MOST_AXIS:g}")
    if math.hypot(*piece[:AXIS]) == 0.0:
        raise InputError(f"{where}: expected an axis that is not zero: zero has no direction")
    if abs(piece.rate) > FASTEST:
        raise InputError(
            f"{where}, rate: expected up to {math.degrees(FASTEST):.6g}°/s either way, "
            f"got {math.degrees(piece.rate):.6g}°/s"
        )
    if not SHORTEST <= piece.seconds <= LONGEST:
        raise InputError(f"{where}, duration: expected {SHORTEST:g} s to {LONGEST:g} s, got {piece.seconds:.6g} s")
    return piece


def _write(laws: tuple[Law, Law]) -> Json:
    return [[list(piece) for piece in law] for law in laws]


FIRST: tuple[Law, Law] = (
    (Piece(0.0, 0.0, 1.0, QUARTER, 1.0), Piece(1.0, 0.0, 0.0, QUARTER, 1.0)),
    (Piece(1.0, 0.0, 0.0, QUARTER, 1.0), Piece(0.0, 0.0, 1.0, QUARTER, 1.0)),
)
"""Laws at first: those of notes 5.19."""


@dataclass(frozen=True)
class Integral(FieldPart):
    """Two time laws of the angular velocity.

    Attributes
    ----------
    laws : (Law, Law)
    about : "base" or "body"
        In whose axes omega is given.
    """

    key: ClassVar[str] = "integral"
    clip: ClassVar[str] = CLIP_KEY

    laws: tuple[Law, Law] = own("time laws of ω", FIRST, _read, _write)
    about: str = choice("axes of ω", "base", ABOUT)


PART = PartType(Integral, order=36)


@dataclass(frozen=True)
class SetPiece(Command):
    """Set one number of a piece: 0 to 2 of its axis, 3 its rate (rad/s), 4 its duration (s); law and piece 0-based."""

    law: int
    piece: int
    what: int
    value: float
    label: ClassVar[str] = "piece of a time law of ω"
    places: ClassVar[Mapping[str, tuple[str, ...]]] = {"what": ("x", "y", "z", "rate", "duration")}
    units: ClassVar[Mapping[str, str]] = {"value_deg": "deg/s"}

    def apply(self, state: State) -> State:
        """Return the state with this number."""
        pieces = list(_law(state, self.law))
        if not 0 <= self.piece < len(pieces):
            raise InputError(f"piece: expected 1 to {len(pieces)}, got {self.piece + 1}")
        refuse_beyond(self.what, len(NAMES), "what")
        values = list(pieces[self.piece])
        values[self.what] = self.value
        pieces[self.piece] = Piece(*values)
        return _with(state, self.law, tuple(pieces))


@dataclass(frozen=True)
class AddPiece(Command):
    """Add a quarter turn about x in one second at the end of a law, 0-based."""

    law: int
    label: ClassVar[str] = "new piece of a time law of ω"

    def apply(self, state: State) -> State:
        """Return the state with one more piece."""
        return _with(state, self.law, (*_law(state, self.law), Piece(1.0, 0.0, 0.0, QUARTER, 1.0)))


@dataclass(frozen=True)
class RemovePiece(Command):
    """Remove a piece of a law, both 0-based."""

    law: int
    piece: int
    label: ClassVar[str] = "removal of a piece of a time law of ω"

    def apply(self, state: State) -> State:
        """Return the state without the piece."""
        pieces = _law(state, self.law)
        if not 0 <= self.piece < len(pieces):
            raise InputError(f"piece: expected 1 to {len(pieces)}, got {self.piece + 1}")
        return _with(state, self.law, pieces[: self.piece] + pieces[self.piece + 1 :])


@dataclass(frozen=True)
class ReverseLaw(Command):
    """Let one law have the pieces of the other one in reverse order; 0-based."""

    law: int
    label: ClassVar[str] = "reverse order of a time law of ω"

    def apply(self, state: State) -> State:
        """Return the state with the pieces of the other law, the last one first."""
        _law(state, self.law)
        return _with(state, self.law, _law(state, 1 - self.law)[::-1])


def _law(state: State, law: int) -> Law:
    refuse_beyond(law, 2, "law")
    return state[Integral].laws[law]


def _with(state: State, law: int, pieces: Law) -> State:
    laws = [pieces if k == law else each for k, each in enumerate(state[Integral].laws)]
    return Set(Integral, "laws", laws).apply(state)
