"""Denavit-Hartenberg rows in the standard (distal) and the modified (proximal) convention.

=========  ==============================================================  =====================================
standard   A_i = Rz(theta_i) Tz(d_i) Tx(a_i) Rx(alpha_i)                   Paul, Spong, Siciliano; notes 4.10-4.14
modified   A_i = Rx(alpha_{i-1}) Tx(a_{i-1}) Rz(theta_i) Tz(d_i)           Craig
=========  ==============================================================  =====================================

In the standard convention z_{i-1} is the axis of joint i (the notes' text of section 4.1 says i-1 in one place; its
recap is right); in the modified convention z_i is. Row i of a modified table holds alpha_{i-1} and a_{i-1}.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError, UnknownName
from armlab.kin.checks import as_floats, finite_floats, together, wrong
from armlab.registry import known_name

Convention = Literal["standard", "modified"]
Kind = Literal["R", "P"]
CONVENTIONS: tuple[Convention, ...] = ("standard", "modified")
FIELDS = ("kind", "a", "alpha", "d", "theta")
LARGEST_ANGLE = 2.0 * math.pi
"""Largest alpha or theta in a table, rad: a larger number was probably meant in degrees."""


@dataclass(frozen=True, slots=True)
class Row:
    """One row of a table.

    Parameters
    ----------
    kind : "R" or "P"
        Revolute or prismatic.
    a, d : float
        Lengths in metres.
    alpha, theta : float
        Angles in radians.

    The variable's own entry is its offset: theta of a revolute joint is ``q + theta``, d of a prismatic ``q + d``.
    """

    kind: Kind
    a: float = 0.0
    alpha: float = 0.0
    d: float = 0.0
    theta: float = 0.0

    @property
    def revolute(self) -> bool:
        """Whether the joint turns."""
        return self.kind == "R"


RowLike = Row | Sequence[object] | Mapping[str, object]


def row_of(entry: RowLike, where: str = "row") -> Row:
    """Return a `Row` from a row, a sequence ``(kind, a, alpha, d, theta)`` or named fields.

    Raises
    ------
    InputError
        Wrong number of fields, an unknown field or joint type, a value that is not a finite number, an angle of more
        than a full turn: it was meant in degrees. One that is meant is reduced by ``math.remainder(angle, math.tau)``.

    Examples
    --------
    >>> row_of(("R", 1.0, 0.0, 0.0, 0.0)).a
    1.0
    >>> row_of({"kind": "P", "theta": 0.5}).kind
    'P'
    """
    if isinstance(entry, Row):
        values: dict[str, object] = {name: getattr(entry, name) for name in FIELDS}
    elif isinstance(entry, Mapping):
        for name in entry:
            known_name(where, name, FIELDS)
        values = dict(entry)
    else:
        if not isinstance(entry, Sequence):
            raise wrong(where, f"a row with the entries {FIELDS}", entry)
        if len(entry) != len(FIELDS):
            raise InputError(f"{where}: expected {len(FIELDS)} entries {FIELDS}, got {len(entry)}: {entry!r}")
        values = dict(zip(FIELDS, entry, strict=True))
    kind = values.pop("kind", None)
    if isinstance(kind, np.ndarray) or kind not in ("R", "P"):
        raise InputError(f"{where}: the joint type must be 'R' (revolute) or 'P' (prismatic), got {kind!r}")
    numbers = {name: _finite(f"{where}, {name}", value) for name, value in values.items()}
    for name in ("alpha", "theta"):
        if abs(numbers.get(name, 0.0)) > LARGEST_ANGLE:
            value = numbers[name]
            raise InputError(
                f"{where}, {name}: expected radians, up to a full turn (2 pi), got {value:g}; did you mean {value:g} "
                f"degrees? Then write math.radians({value:g}), else math.remainder({value:g}, math.tau)"
            )
    return Row(kind, **numbers)


def _finite(where: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float, np.floating, np.integer)):
        raise wrong(where, "a number", value)
    return float(finite_floats(value, where, (), "a finite number"))


def link_transform(
    a: ArrayLike, alpha: ArrayLike, d: ArrayLike, theta: ArrayLike, convention: Convention = "standard"
) -> NDArray[np.floating]:
    """Return the transform A_i of one row, frame i in frame i-1.

    Parameters
    ----------
    a, d : array_like
        Metres; for the modified convention ``a`` is a_{i-1}.
    alpha, theta : array_like
        Radians; for the modified convention ``alpha`` is alpha_{i-1}. All four broadcast.
    convention : "standard" or "modified"

    Returns
    -------
    ndarray, shape (..., 4, 4)

    Raises
    ------
    InputError
        Not numbers, or shapes that do not fit.
    UnknownName
        There is no such convention.

    References
    ----------
    Notes 4.13-4.14 (standard); Craig, *Introduction to Robotics*, 3.6 (modified).
    """
    entries = zip(FIELDS[1:], (a, alpha, d, theta), strict=True)
    given = {name: as_floats(value, name, "numbers") for name, value in entries}
    together(**{name: values.shape for name, values in given.items()})
    a_, alpha_, d_, theta_ = np.broadcast_arrays(*given.values())
    ct, st, ca, sa = np.cos(theta_), np.sin(theta_), np.cos(alpha_), np.sin(alpha_)
    zero, one = np.zeros_like(ct), np.ones_like(ct)
    if convention == "standard":
        rows = [
            [ct, -st * ca, st * sa, a_ * ct],
            [st, ct * ca, -ct * sa, a_ * st],
            [zero, sa, ca, d_],
        ]
    elif convention == "modified":
        rows = [
            [ct, -st, zero, a_],
            [st * ca, ct * ca, -sa, -d_ * sa],
            [st * sa, ct * sa, ca, d_ * ca],
        ]
    else:
        raise UnknownName("convention", convention, CONVENTIONS)
    rows.append([zero, zero, zero, one])
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def common_normals(rows: Sequence[Row], convention: Convention) -> list[tuple[float, float]]:
    """Return (a, alpha) of the n + 1 links: before joint 1, between neighbouring joints, after joint n.

    Both conventions are the same string of moves Tx Rx | Rz Tz | Tx Rx | ... | Rz Tz | Tx Rx and differ only in where
    they cut it. The standard table has nothing before joint 1, the modified one nothing after joint n.
    """
    entries = [(row.a, row.alpha) for row in rows]
    return [(0.0, 0.0), *entries] if convention == "standard" else [*entries, (0.0, 0.0)]
