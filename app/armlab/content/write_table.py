"""The table of an arm as text for spreadsheets, papers and `armlab.content.tables.parse_table`."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from armlab.content.arithmetic import shortest, shortest_degrees
from armlab.content.table_cells import MOST_DECIMALS, quarter_turn, rounding_of
from armlab.content.write_robot import roll_pitch_yaw
from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.registry import known_name

FORMATS = ("csv", "markdown", "latex")
ANGLE_UNITS = ("deg", "rad")

COMMENTS = {"csv": "# {}\n", "markdown": "\n<!-- {} -->\n", "latex": "% {}\n"}
"""A comment below the table, by format."""

Written = Callable[[float], str]
"""A number as text."""


def write_table(arm: Arm, format: str, angle: str = "deg") -> str:
    """Return the rows of an arm as a table with a header, with the limits of its joints.

    A base and a tool have no place in a table: a comment below it tells where they are.

    Parameters
    ----------
    arm : Arm
    format : "csv", "markdown" or "latex"
    angle : "deg" or "rad"

    Returns
    -------
    str
        Lengths in metres, all digits; ends with a line break. Read back, numbers agree to 1e-12.
    """
    known_name("format", format, FORMATS)
    known_name("angle", angle, ANGLE_UNITS)
    turned = shortest_degrees if angle == "deg" else shortest
    in_cells = shortest_degrees if angle == "deg" else _radians
    rows = [[*_cells(row, i + 1, in_cells), *_limits(arm, i, turned)] for i, row in enumerate(arm.rows)]
    comments = [COMMENTS[format].format(line) for line in _beside(arm, angle, turned)]
    return _table(arm, format, angle, rows) + "".join(comments)


def _table(arm: Arm, format: str, angle: str, rows: list[list[str]]) -> str:
    before, bound = arm.convention == "modified", _unit_of_limits(arm, angle)
    if format == "latex":
        return _latex(rows, angle, "i-1" if before else "i", bound)
    index = "(i-1)" if before else "(i)"
    head = ["joint", f"a{index} [m]", f"alpha{index} [{angle}]", "d [m]", f"theta [{angle}]"]
    head += [f"q_min [{bound}]", f"q_max [{bound}]"]
    if format == "csv":
        return "".join(",".join(line) + "\n" for line in [head, *rows])
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def _unit_of_limits(arm: Arm, angle: str) -> str:
    """Return the unit of the limits, or both if some joints turn and some slide."""
    return " or ".join(unit for unit, some in ((angle, arm.revolute.any()), ("m", not arm.revolute.all())) if some)


def _limits(arm: Arm, i: int, turned: Written) -> list[str]:
    written = turned if arm.revolute[i] else shortest
    return [written(float(limit)) for limit in arm.limits[i]]


def _beside(arm: Arm, angle: str, turned: Written) -> Iterable[str]:
    """Yield where base and tool are, each unless it is the identity."""
    for name, T in (("base", arm.base), ("tool", arm.tool)):
        if not np.array_equal(T, np.eye(4)):
            place = ", ".join(shortest(float(value)) for value in T[:3, 3])
            turn = ", ".join(turned(each) for each in roll_pitch_yaw(T[:3, :3]))
            yield f"{name}, not in the table: at ({place}) m, turned by ({turn}) {angle} about the fixed x, y, z"


def _radians(value: float) -> str:
    """Return an angle of the table in radians, with more zeros where it would be read as a rounded quarter turn.

    >>> _radians(0.5), _radians(1.571)
    ('0.5', '1.5710000000000000')
    """
    text = shortest(value)
    if quarter_turn(value, rounding_of(text)) == value:
        return text
    whole, _, decimals = text.partition(".")
    return f"{whole}.{decimals:0<{MOST_DECIMALS + 1}}"


def _cells(row: Row, number: int, turned: Written) -> list[str]:
    d, theta = shortest(row.d), turned(row.theta)
    if row.revolute:
        theta = _with_offset(f"q{number}", theta)
    else:
        d = _with_offset(f"q{number}", d)
    return [f"{number} {row.kind}", shortest(row.a), turned(row.alpha), d, theta]


def _with_offset(variable: str, offset: str) -> str:
    if offset == "0":
        return variable
    return f"{variable} - {offset[1:]}" if offset.startswith("-") else f"{variable} + {offset}"


def _latex(rows: list[list[str]], angle: str, index: str, bound: str) -> str:
    head = ["joint", f"$a_{{{index}}}$ [m]", rf"$\alpha_{{{index}}}$ [{angle}]", "$d_i$ [m]", rf"$\theta_i$ [{angle}]"]
    head += [rf"$q_{{\min}}$ [{bound}]", rf"$q_{{\max}}$ [{bound}]"]
    lines = [r"\begin{tabular}{lrrrrrr}", r"\hline", " & ".join(head) + r" \\", r"\hline"]
    for number, (joint, *cells) in enumerate(rows, start=1):
        symbols = [cell.replace(f"q{number}", f"q_{{{number}}}") for cell in cells]
        lines.append(" & ".join([joint, *(f"${cell}$" for cell in symbols)]) + r" \\")
    return "\n".join([*lines, r"\hline", r"\end{tabular}"]) + "\n"
