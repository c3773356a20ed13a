"""The output of ``print(arm)``: the table in degrees and metres, with limits, base, tool and task."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.kin.dh import Convention, Row

Matrix = NDArray[np.float64]

_HEADS = {
    "standard": ("joint", "a, m", "alpha, deg", "d, m", "theta, deg", "limits"),
    "modified": ("joint", "a(i-1), m", "alpha(i-1), deg", "d, m", "theta, deg", "limits"),
}


def table(
    title: str, convention: Convention, rows: Sequence[Row], limits: Matrix, base: Matrix, tool: Matrix, task: str
) -> str:
    """Return the description of an arm, one line a joint.

    Parameters
    ----------
    title : str
        Name of the arm.
    convention : "standard" or "modified"
    rows : sequence of Row
        The table, n of them.
    limits : ndarray, shape (n, 2)
        rad and m.
    base, tool : ndarray, shape (4, 4)
    task : str
        The task in words.
    """
    lines = [f"{title}: {len(rows)} joints ({''.join(row.kind for row in rows)}), {convention} convention"]
    body = [_HEADS[convention], *(_line(i, row, *limits[i]) for i, row in enumerate(rows))]
    widths = [max(len(line[k]) for line in body) for k in range(len(body[0]))]
    lines += ["  ".join(cell.rjust(width) for cell, width in zip(line, widths, strict=True)) for line in body]
    lines += [f"{name}: {_pose(T)}" for name, T in (("base", base), ("tool", tool)) if _moved(T)]
    lines.append(f"task: {task}")
    return "\n".join(lines)


def _line(i: int, row: Row, low: float, high: float) -> tuple[str, ...]:
    q = f"q{i + 1}"
    alpha = f"{np.degrees(row.alpha):.6g}"
    if row.revolute:
        variable = (f"{row.d:.6g}", _with_offset(q, float(np.degrees(row.theta))))
        limits = f"{np.degrees(low):.6g} to {np.degrees(high):.6g} deg"
    else:
        variable = (_with_offset(q, row.d), f"{np.degrees(row.theta):.6g}")
        limits = f"{low:.6g} to {high:.6g} m"
    return (f"{i + 1} {row.kind}", f"{row.a:.6g}", alpha, *variable, limits)


def _with_offset(q: str, offset: float) -> str:
    return q if offset == 0.0 else f"{q} {'+' if offset > 0 else '-'} {abs(offset):.6g}"


def _moved(T: Matrix) -> bool:
    return not np.array_equal(T, np.eye(4))


def _pose(T: Matrix) -> str:
    rows = "; ".join(" ".join(f"{value:.6g}" for value in row) for row in T[:3])
    return f"[{rows}]"
