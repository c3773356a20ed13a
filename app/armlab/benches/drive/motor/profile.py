"""Voltage and load over time: constant piece by piece, as a step, a ramp of small steps, a pulse, or as typed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from armlab.content.arithmetic import evaluate
from armlab.errors import InputError
from armlab.kin.drive.motor_run import Piece

KINDS = {"step": "step", "ramp": "ramp", "pulse": "pulse", "own": "own"}

ENDING = ("ramp", "pulse")
"""Kinds that have an end."""

RAMP = 25
"""Number of steps of a ramp; each has the value that the ramp has in its middle."""

MOST_ROWS = 40
"""Largest number of lines of a profile that is typed."""

Row = tuple[float, float]
Rows = tuple[Row, ...]


@dataclass(frozen=True)
class Profile:
    """A quantity over time.

    Attributes
    ----------
    kind : str
        Key of `KINDS`.
    value : float
        Height of step, ramp or pulse.
    start, stop : float
        When it begins and, of a ramp or a pulse, ends; seconds.
    rows : tuple of (float, float)
        Of a typed one: from this time on, this value.
    """

    kind: str
    value: float
    start: float
    stop: float
    rows: Rows

    def check(self, name: str) -> None:
        """Raise `InputError` when a ramp or pulse would end before it begins."""
        if self.kind in ENDING and not self.stop > self.start:
            raise InputError(f"{name}: expected an end after the start {self.start:g} s, got {self.stop:g} s")

    def jumps(self) -> Rows:
        """Return the times at which the value changes, the first at 0, with the value from there on."""
        if self.kind == "own":
            found = list(self.rows)
        elif self.kind == "step":
            found = [(self.start, self.value)]
        elif self.kind == "pulse":
            found = [(self.start, self.value), (self.stop, 0.0)]
        else:
            wide = (self.stop - self.start) / RAMP
            found = [(self.start + k * wide, self.value * (k + 0.5) / RAMP) for k in range(RAMP)]
            found.append((self.stop, self.value))
        return tuple(found) if found and found[0][0] == 0.0 else ((0.0, 0.0), *found)


def read_rows(data: object) -> Rows:
    """Return the lines of a profile, each a time and a value, from pairs of numbers or from a text.

    Raises
    ------
    InputError
        No lines or too many, one that is not two finite numbers, or times that do not rise from 0.
    """
    if isinstance(data, str):
        data = [_pair(k, line) for k, line in enumerate(filter(str.strip, data.replace(";", "\n").splitlines()))]
    if not isinstance(data, Sequence) or not 1 <= len(data) <= MOST_ROWS:
        raise InputError(f"profile: expected 1 to {MOST_ROWS} lines of a time and a value")
    rows: list[Row] = []
    for k, row in enumerate(data):
        if not isinstance(row, Sequence) or len(row) != 2 or not all(map(_is_number, row)):
            raise InputError(f"line {k + 1}: expected a time in s and a value, got {str(row)[:40]}")
        rows.append((float(row[0]), float(row[1])))
    for k, (before, after) in enumerate(pairwise([time for time, _ in rows])):
        if not after > before:
            raise InputError(f"line {k + 2}: expected a time after {before:g} s, got {after:g} s")
    if rows[0][0] < 0.0:
        raise InputError(f"line 1: expected a time from 0 s on, got {rows[0][0]:g} s")
    return tuple(rows)


def _pair(k: int, line: str) -> Row:
    """Return the two numbers of a line of a text, counted from 0."""
    try:
        time, value = (evaluate(word.replace(",", ".")) for word in line.replace("−", "-").split())
    except (InputError, ValueError):
        said = f"expected a time in s and a value, got {line.strip()[:40]!r}"
        raise InputError(f"line {k + 1}: {said}") from None
    return time, value


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def pieces_of(voltage: Profile, load: Profile, end: float) -> tuple[Piece, ...]:
    """Return the pieces up to an end, in seconds, in which voltage and load are constant."""
    changes = [dict(profile.jumps()) for profile in (voltage, load)]
    times = sorted({time for each in changes for time in each if time < end})
    now = [0.0, 0.0]
    found = []
    for start, stop in pairwise([*times, end]):
        now = [each.get(start, value) for each, value in zip(changes, now, strict=True)]
        found.append(Piece(stop - start, now[0], now[1]))
    return tuple(found)
