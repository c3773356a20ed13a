"""The formulas of an arm in symbols: joint variables q1 ..., lengths a1, d1 ..., twists alpha1 ..."""

from __future__ import annotations

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.dh import common_normals
from armlab.kin.graph.expression import Graph, Number
from armlab.kin.graph.printing import Printer, Style


def pose_formulas(arm: Arm, style: Style = "text") -> dict[str, str]:
    """Return the printed formulas of the tool's pose in frame 0.

    Parameters
    ----------
    arm : Arm
        Base is left out; the tool's constants appear as numbers.
    style : "text" or "latex"

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
    graph = Graph()
    chain = arm.description.chain(graph, lambda name, _value: graph.parameter(name))
    _, walker = chain.axes()
    if not np.array_equal(arm.tool, np.eye(4)):
        walker.place(arm.tool.tolist())
    x, y, z, p = walker.frame()
    show = Printer(graph, style)
    entries: dict[str, Number] = {f"p{axis}": p[k] for k, axis in enumerate("xyz")}
    entries |= {f"r{i + 1}{j + 1}": axis[i] for i in range(3) for j, axis in enumerate((x, y, z))}
    return {name: show(value) for name, value in entries.items()}


def constants(arm: Arm) -> dict[str, float]:
    """Return the values of the symbols of `pose_formulas`: lengths ``a1, d1`` in m, twists ``alpha1`` in rad."""
    values: dict[str, float] = {}
    for i, (a, alpha) in enumerate(common_normals(arm.rows, arm.convention)):
        values |= {f"a{i}": a, f"alpha{i}": alpha}
    return values | {f"d{i + 1}": row.d for i, row in enumerate(arm.rows)}
