"""The table of an arm as text for spreadsheets, papers and `armlab.content.tables.parse_table`."""

from __future__ import annotations

from armlab.content.arithmetic import shortest, shortest_degrees
from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.registry import known_name

FORMATS = ("csv", "markdown", "latex")
ANGLE_UNITS = ("deg", "rad")


def write_table(arm: Arm, format: str, angle: str = "deg") -> str:
    """Return the rows of an arm as a table with a header; base, tool and limits are not in it.

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
    before = arm.convention == "modified"
    rows = [_cells(row, i + 1, angle) for i, row in enumerate(arm.rows)]
    if format == "latex":
        return _latex(rows, angle, "i-1" if before else "i")
    index = "(i-1)" if before else "(i)"
    head = ["joint", f"a{index} [m]", f"alpha{index} [{angle}]", "d [m]", f"theta [{angle}]"]
    if format == "csv":
        return "".join(",".join(line) + "\n" for line in [head, *rows])
    lines = [head, ["---"] + ["---:"] * 4, *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def _cells(row: Row, number: int, angle: str) -> list[str]:
    def turned(value: float) -> str:
        return shortest_degrees(value) if angle == "deg" else shortest(value)

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


def _latex(rows: list[list[str]], angle: str, index: str) -> str:
    head = ["joint", f"$a_{{{index}}}$ [m]", rf"$\alpha_{{{index}}}$ [{angle}]", "$d_i$ [m]", rf"$\theta_i$ [{angle}]"]
    lines = [r"\begin{tabular}{lrrrr}", r"\hline", " & ".join(head) + r" \\", r"\hline"]
    for number, (joint, *cells) in enumerate(rows, start=1):
        symbols = [cell.replace(f"q{number}", f"q_{{{number}}}") for cell in cells]
        lines.append(" & ".join([joint, *(f"${cell}$" for cell in symbols)]) + r" \\")
    return "\n".join([*lines, r"\hline", r"\end{tabular}"]) + "\n"
