"""The formulas of an arm in symbols: joint variables q1, ..., lengths a1, d1, ..., twists alpha1, ..."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.dh import Row, common_normals
from armlab.kin.graph.expression import Expression, Graph, Number
from armlab.kin.graph.printing import Printer, Style, term_counts

QUARTER = 1e-9
"""Difference from a multiple of a quarter turn, in radians, within which an angle counts as one."""


def pose_formulas(arm: Arm, style: Style = "text") -> dict[str, str]:
    """Return the printed formulas of the tool's pose in frame 0, however long they are; see `PoseFormulas`.

    Parameters
    ----------
    arm : Arm
        Base is left out; the tool's constants appear as numbers.
    style : "text" or "latex"
        In LaTeX ``c_{23}`` is the cosine of the sum of the table's angles theta_2 + theta_3: the joint variables, but
        for the joints in `angle_offsets`, whose angle is written theta.

    Returns
    -------
    dict
        ``"px", "py", "pz"`` and ``"r11"`` to ``"r33"``. In the text style each evaluates in Python with ``sin``,
        ``cos``, the joint variables and the `constants` of the arm.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 0.8, 0.0, 0.0, 0.0)])
    >>> pose_formulas(arm)["px"]
    'a1*cos(q1) + a2*cos(q1 + q2)'
    """
    return PoseFormulas(arm).printed(style)


class PoseFormulas:
    """The formulas of the tool's pose in frame 0 before they are printed.

    Parameters
    ----------
    arm : Arm

    Attributes
    ----------
    terms : dict of int
        How many terms each entry has when it is printed. Each general twist triples them: all entries of an arm with
        twelve have together a hundred million characters.

    Examples
    --------
    >>> PoseFormulas(Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 0.8, 0.0, 0.0, 0.0)])).terms["px"]
    2
    """

    def __init__(self, arm: Arm) -> None:
        self._graph, self._offsets = Graph(), angle_offsets(arm)
        self._entries = self._pose(arm)
        counts = term_counts(self._graph)
        self.terms = {
            name: counts[value.node] if isinstance(value, Expression) else 1 for name, value in self._entries.items()
        }

    def printed(self, style: Style = "text", most_terms: float = math.inf) -> dict[str, str]:
        """Return the printed entries, except those with too many terms."""
        show = Printer(self._graph, style)
        return {
            name: with_offsets(show(value), self._offsets, style)
            for name, value in self._entries.items()
            if self.terms[name] <= most_terms
        }

    def _pose(self, arm: Arm) -> dict[str, Number]:
        graph = self._graph
        chain = replace(arm.description, rows=rows_in_symbols(arm)).chain(
            graph, lambda name, _value: graph.parameter(name)
        )
        _, walker = chain.axes()
        if not np.array_equal(arm.tool, np.eye(4)):
            walker.place(arm.tool.tolist())
        x, y, z, p = walker.frame()
        entries: dict[str, Number] = {f"p{axis}": p[k] for k, axis in enumerate("xyz")}
        return entries | {f"r{i + 1}{j + 1}": axis[i] for i in range(3) for j, axis in enumerate((x, y, z))}


def angle_offsets(arm: Arm) -> dict[int, float]:
    """Return the constant parts of the angles theta, in rad, that are no quarter turns, by joint (1-based).

    Quarter turns only exchange sines and cosines and are worked into the formulas. The angle of a prismatic joint is
    constant and included as well.
    """
    return {
        i + 1: row.theta
        for i, row in enumerate(arm.rows)
        if row.revolute and abs(math.remainder(row.theta, math.pi / 2)) > QUARTER
    }


def rows_in_symbols(arm: Arm) -> tuple[Row, ...]:
    """Return the rows of which formulas are made: without the `angle_offsets`, and with exact quarter turns.

    Tables are typed with a few decimals of pi/2, and what is left of a cosine would be printed.
    """
    offsets = angle_offsets(arm)
    return tuple(
        replace(row, alpha=_quarter(row.alpha), theta=0.0 if i + 1 in offsets else _quarter(row.theta))
        for i, row in enumerate(arm.rows)
    )


def _quarter(angle: float) -> float:
    """Return the multiple of a quarter turn that an angle counts as, or the angle."""
    exact = round(angle / (math.pi / 2)) * (math.pi / 2)
    return exact if abs(angle - exact) <= QUARTER else angle


def with_offsets(formula: str, offsets: dict[int, float], style: Style) -> str:
    """Return a formula in which the joints of `angle_offsets` have their angles theta, or their offsets added."""
    for joint, offset in offsets.items():
        if style == "text":
            shifted = f"(q{joint} {'-' if offset < 0.0 else '+'} {abs(offset)!r})"
            formula = re.sub(rf"\bq{joint}\b", shifted, formula)
        else:
            name = str(joint) if joint < 10 else f"{{{joint}}}"
            formula = formula.replace(f"q_{name}", rf"\theta_{name}")
    return formula


def constants(arm: Arm) -> dict[str, float]:
    """Return the values of the symbols in `pose_formulas`: lengths ``a1, d1`` in m, twists ``alpha1`` in rad."""
    values: dict[str, float] = {}
    for i, (a, alpha) in enumerate(common_normals(arm.rows, arm.convention)):
        values |= {f"a{i}": a, f"alpha{i}": alpha}
    return values | {f"d{i + 1}": row.d for i, row in enumerate(arm.rows)}
