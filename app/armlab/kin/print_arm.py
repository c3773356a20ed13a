"""The text of ``print(arm)``: the table in degrees and metres, with limits, base, tool and task."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from armlab.kin.arm import Arm

_HEADS = {
    "standard": ("joint", "a, m", "alpha, deg", "d, m", "theta, deg", "limits"),
    "modified": ("joint", "a(i-1), m", "alpha(i-1), deg", "d, m", "theta, deg", "limits"),
}


def table(arm: Arm) -> str:
    """Return the description of an arm, one line a joint."""
    title = arm.name or "Arm"
    lines = [f"{title}: {arm.n} joints ({''.join(row.kind for row in arm.rows)}), {arm.convention} convention"]
    body = [_HEADS[arm.convention], *(_line(arm, i) for i in range(arm.n))]
    widths = [max(len(line[k]) for line in body) for k in range(len(body[0]))]
    lines += ["  ".join(cell.rjust(width) for cell, width in zip(line, widths, strict=True)) for line in body]
    lines += [f"{name}: {_pose(T)}" for name, T in (("base", arm.base), ("tool", arm.tool)) if _moved(T)]
    lines.append(f"task: {arm.task.title}")
    return "\n".join(lines)


def _line(arm: Arm, i: int) -> tuple[str, ...]:
    row, (low, high) = arm.rows[i], arm.limits[i]
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


def _moved(T: NDArray[np.float64]) -> bool:
    return not np.array_equal(T, np.eye(4))


def _pose(T: NDArray[np.float64]) -> str:
    rows = "; ".join(" ".join(f"{value:.6g}" for value in row) for row in T[:3])
    return f"[{rows}]"
