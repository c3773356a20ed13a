"""Words and symbols of rotations that the pages of the tab share."""

from __future__ import annotations

import re
from contextlib import suppress

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.ui.format import number
from armlab.ui.units import plain_number

LETTERS = {r"\varphi": "φ", r"\theta": "θ", r"\psi": "ψ"}
"""Greek letters of the names of angles in LaTeX."""

EN_SPACE = "\N{EN SPACE}"

PRIMES = ("", "′", "″")


def turn_names(axes: str, fixed: bool) -> tuple[str, str, str]:
    """Return the axes of the three turns in order, with a prime for each turn that has carried one along.

    >>> turn_names("zyx", False), turn_names("zyx", True)
    (('z', 'y′', 'x″'), ('z', 'y', 'x'))
    """
    one, two, three = (axis if fixed else axis + prime for axis, prime in zip(axes, PRIMES, strict=True))
    return one, two, three


def components(values: NDArray[np.floating], decimals: int = 4) -> str:
    """Return the components of a vector in a row."""
    return EN_SPACE.join(number(float(value), decimals) for value in values)


def typed_numbers(text: str, where: str, count: int, of: str) -> list[float]:
    """Return one typed number, or ``count`` of them if all were pasted, with or without brackets.

    Parameters
    ----------
    text, where : str
    count : int
    of : str
        What they are the numbers of, for the `InputError` when it is none of both.
    """
    parts = re.sub(r"[\[\]{};]|,\s", " ", text).split()
    if len(parts) == count:
        with suppress(InputError):
            return [plain_number(part) for part in parts]
    return [plain_number(text, where, f"a number, or all {count} of {of}")]
