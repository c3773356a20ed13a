"""Words and symbols of rotations that the pages of the tab share."""

from __future__ import annotations

LETTERS = {r"\varphi": "φ", r"\theta": "θ", r"\psi": "ψ"}
"""Greek letters of the names of angles in LaTeX."""

PRIMES = ("", "′", "″")


def turn_names(axes: str, fixed: bool) -> tuple[str, str, str]:
    """Return the axes of the three turns in order, with a prime for each turn that has carried one along.

    >>> turn_names("zyx", False), turn_names("zyx", True)
    (('z', 'y′', 'x″'), ('z', 'y', 'x'))
    """
    one, two, three = (axis if fixed else axis + prime for axis, prime in zip(axes, PRIMES, strict=True))
    return one, two, three
