"""Products of two or three elementary rotations in symbols, multiplied out entry by entry.

Nothing is looked up: the elementary matrices are expressions of the angles alpha, beta, gamma, and the product is made
with ordinary operators, as any formula of an arm is.
"""

from __future__ import annotations

import re
from functools import cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from armlab.errors import UnknownName
from armlab.kin.euler import SEQUENCES
from armlab.kin.graph.expression import Graph, Number, cos, sin
from armlab.kin.graph.printing import Printer
from armlab.kin.graph.vector import dot
from armlab.kin.rotations import rotation_from_sequence

ANGLES = ("alpha", "beta", "gamma")
"""Names of the angles, in the order of the axes."""

PAIRS = ("xy", "xz", "yx", "yz", "zx", "zy")
"""The six products about two different axes."""

PRODUCTS = (*PAIRS, *sorted(SEQUENCES))
"""The six products about two axes and the twelve about three (notes, appendix)."""

Style = Literal["text", "latex", "short"]

_OF = re.compile(r"\\(s)in\(\\(\w+)\)|\\(c)os\(\\(\w+)\)")

_BETWEEN = re.compile(r"(?<=\w) (?=[cs]_)")
"""Space between two factors."""

Matrix = list[list[Number]]


@cache
def product_entries(axes: str, style: Style = "short") -> tuple[tuple[str, ...], ...]:
    r"""Return the entries of R_a(alpha) R_b(beta) R_c(gamma), row by row.

    Parameters
    ----------
    axes : str
        One of `PRODUCTS`.
    style : "text", "latex" or "short"
        ``sin(alpha)*cos(beta)`` evaluates in Python; in LaTeX it is ``\sin(\alpha) \cos(\beta)`` or, as the notes
        write it, ``s_\alpha\,c_\beta``.

    Raises
    ------
    UnknownName
        No such product.

    Examples
    --------
    >>> product_entries("zx", "text")[0]
    ('cos(alpha)', '-sin(alpha)*cos(beta)', 'sin(alpha)*sin(beta)')
    >>> print(product_entries("zxz")[1][0])
    s_\alpha\,c_\gamma + c_\alpha\,c_\beta\,s_\gamma
    """
    graph, entries = _product(axes)
    show = Printer(graph, "text" if style == "text" else "latex")
    return tuple(
        tuple(_shortened(show(entry)) if style == "short" else show(entry) for entry in row) for row in entries
    )


def product_values(axes: str, angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the numbers of a product, (..., 3, 3), at as many angles as there are axes, (..., k), radians."""
    return np.asarray(rotation_from_sequence(_known(axes), angles[..., : len(axes)]))


def _product(axes: str) -> tuple[Graph, Matrix]:
    graph, letters = Graph(), _known(axes)
    angles = [graph.parameter(name) for name in ANGLES[: len(letters)]]
    # Made first, and multiplied from the right, so that the factors of each term stand in the order of the angles.
    functions = [(cos(angle), sin(angle)) for angle in angles]
    turns = [_elementary(axis, c, s) for axis, (c, s) in zip(letters, functions, strict=True)]
    found = turns[-1]
    for turn in reversed(turns[:-1]):
        found = [[dot(row, column) for column in zip(*found, strict=True)] for row in turn]
    return graph, found


def _elementary(axis: str, c: Number, s: Number) -> Matrix:
    i = "xyz".index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    found: Matrix = [[0.0] * 3 for _ in range(3)]
    found[i][i] = 1.0
    found[j][j] = found[k][k] = c
    found[k][j], found[j][k] = s, -s
    return found


def _shortened(latex: str) -> str:
    short = _OF.sub(lambda found: rf"{found[1] or found[3]}_\{found[2] or found[4]}", latex)
    return _BETWEEN.sub(r"\\,", short)


def _known(axes: str) -> str:
    if axes not in PRODUCTS:
        raise UnknownName("product", axes, PRODUCTS)
    return axes
