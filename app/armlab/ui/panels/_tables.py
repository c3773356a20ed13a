"""Tables that several panels show."""

from __future__ import annotations

import math

from armlab.kin.arm import Arm
from armlab.ui.colours import css, joint_colour
from armlab.ui.format import dot, number, subscript


def dh_table(arm: Arm) -> str:
    """Return the Denavit-Hartenberg table in the order of the convention, the variable in its own cell."""
    modified = arm.convention == "modified"
    i = "<sub>i−1</sub>" if modified else "<sub>i</sub>"
    heads = [f"a{i}, m", f"α{i}, °", "d<sub>i</sub>, m", "θ<sub>i</sub>, °"]
    rows = ["".join(f"<th>{head}</th>" for head in ["joint", *heads])]
    for k, row in enumerate(arm.rows):
        q = f"<i>{subscript('q', k + 1)}</i>"
        alpha, theta = math.degrees(row.alpha), math.degrees(row.theta)
        cells = [_constant(row.a, 4), _constant(alpha, 1)]
        cells += (
            [_constant(row.d, 4), _variable(q, theta, 1)]
            if row.revolute
            else [_variable(q, row.d, 4), _constant(theta, 1)]
        )
        name = f"{dot(css(joint_colour(k)))}{subscript(row.kind, k + 1)}"
        rows.append("".join(f"<td>{cell}</td>" if not cell.startswith("<td") else cell for cell in [name, *cells]))
    return '<table class="dh">' + "".join(f"<tr>{row}</tr>" for row in rows) + "</table>"


def _trimmed(value: float, decimals: int) -> str:
    text = number(value, decimals)
    return text.rstrip("0").rstrip(".") if "." in text else text


def _constant(value: float, decimals: int) -> str:
    return '<td class="zero">0</td>' if value == 0.0 else _trimmed(value, decimals)


def _variable(q: str, offset: float, decimals: int) -> str:
    if offset == 0.0:
        return q
    return f"{q} {'+' if offset > 0 else '−'} {_trimmed(abs(offset), decimals)}"
