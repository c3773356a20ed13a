"""The plots of a motion, and the curves in each of them, in the units on screen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.figures import TOOL, Limited, Overrun
from armlab.benches.motion.plan.question import Planned, Samples
from armlab.benches.motion.plan.ui.joint_marks import joint_dash
from armlab.benches.motion.plots.drawn import shares
from armlab.benches.motion.plots.state import Quantity
from armlab.benches.motion.plots.ui.curves import Line
from armlab.kin.arm import Arm
from armlab.ui.colours import GREY, joint_colour
from armlab.ui.units import Units

Array = NDArray[np.float64]

ORDERS: dict[Quantity, int] = {"q": 0, "q_dot": 1, "q_ddot": 2, "jerk": 3}
NAMES = ("Position", "Velocity", "Acceleration", "Jerk")
DOTS = ("", "\u0307", "\u0308", "\u20db")
"""Dots over a letter, by the order of the derivative."""
TIMES = ("", "/s", "/s²", "/s³")
LIMITED: tuple[Limited, ...] = ("position", "velocity", "acceleration", "jerk")

CUT = 8.0
"""Multiple of its median up to which a curvature is drawn: where the tool nearly rests it has no bound."""

STRAIGHT = 0.2
"""Curvature, times the length scale of the arm, below which a path is drawn as a straight line."""


@dataclass(frozen=True)
class Slot:
    """One plot of the page.

    Attributes
    ----------
    quantity : str
    of : str
        ``"turn"`` or ``"slide"``: of which joints; of the load ``"velocity"`` or ``"acceleration"``; else empty.
    title : str
        With its unit.
    file : str
        Name of the exported file.
    """

    quantity: Quantity
    of: str
    title: str
    file: str


def slots(arm: Arm, units: Units) -> list[Slot]:
    """Return all plots that an arm may have; revolute and prismatic joints never share one."""
    found = []
    mixed = bool(arm.revolute.any()) and not bool(arm.revolute.all())
    for quantity, order in ORDERS.items():
        for turns in (True, False):
            if (arm.revolute == turns).any():
                which = f" of {'revolute' if turns else 'prismatic'} joints" if mixed else ""
                title = f"{NAMES[order]} q{DOTS[order]}{which}, {units.unit(turns)}{TIMES[order]}"
                kind = "turn" if turns else "slide"
                found.append(Slot(quantity, kind, title, f"{quantity}_{kind}" if mixed else quantity))
    found += [
        Slot("s", "", "Path parameter s of the present move", "s"),
        Slot("speed", "", f"Speed of the tool, {units.length_unit}/s", "tool_speed"),
        Slot("curvature", "", "Curvature of the path of the tool, 1/m", "curvature"),
    ]
    for of, dots in (("velocity", DOTS[1]), ("acceleration", DOTS[2])):
        found.append(Slot("load", of, f"Load: |q{dots}ᵢ| in % of its limit", f"share_of_{of}"))
    return found


def from_zero(slot: Slot) -> bool:
    """Return whether the ordinate of a plot begins at 0."""
    return slot.quantity not in ORDERS


def lines_of(
    slot: Slot, planned: Planned, samples: Samples, other: Planned | None, found: Sequence[Overrun], units: Units
) -> list[Line]:
    """Return the curves of a plot.

    Parameters
    ----------
    slot : Slot
    planned : Planned
    samples : Samples
        Its own.
    other : Planned or None
        What it is compared with.
    found : sequence of Overrun
        The limits the motion exceeds.
    units : Units
    """
    beside = None if other is None else other.samples
    if slot.quantity in ORDERS:
        return _of_joints(slot, planned, samples, beside, found, units)
    if slot.quantity == "load":
        return _loads(slot, planned, other, found, units)
    if slot.quantity == "s":
        return [Line("s", GREY, samples.s, None if beside is None else beside.s)]
    if slot.quantity == "curvature":
        return [Line("curvature, 1/m", GREY, samples.curvature, None if beside is None else beside.curvature)]
    factor, limit = units.factor(False), planned.question.limits.tool_speed
    return [
        Line(
            f"tool speed, {units.length_unit}/s",
            GREY,
            samples.tool_speed / factor,
            None if beside is None else beside.tool_speed / factor,
            () if limit is None else (limit / factor,),
            _spans(found, TOOL, "tool speed"),
        )
    ]


def most_of(slot: Slot, arm: Arm, lines: Sequence[Line]) -> float | None:
    """Return the end of the ordinate if curves exceed it, else None."""
    if slot.quantity != "curvature":
        return None
    every = np.concatenate([each for line in lines for each in (line.values, line.other) if each is not None])
    every = every[np.isfinite(every)]
    if not len(every):
        return None
    return max(CUT * float(np.median(every)), STRAIGHT / arm.length_scale)


def derived_name(i: int, turns: bool, order: int, units: Units) -> str:
    """Return the symbol of a derivative of joint variable i (0-based), such as q̇₁."""
    name = units.variable(i, turns)
    return f"{name[0]}{DOTS[order]}{name[1:]}"


def _of_joints(
    slot: Slot, planned: Planned, samples: Samples, beside: Samples | None, found: Sequence[Overrun], units: Units
) -> list[Line]:
    arm, order, turns = planned.question.arm, ORDERS[slot.quantity], slot.of == "turn"
    factor, unit = units.factor(turns), f"{units.unit(turns)}{TIMES[order]}"
    own, theirs = _derivative(samples, order), None if beside is None else _derivative(beside, order)
    return [
        Line(
            f"{derived_name(i, turns, order, units)}, {unit}",
            joint_colour(i),
            own[:, i] / factor,
            None if theirs is None else theirs[:, i] / factor,
            tuple(level / factor for level in _limits(planned, order, i)),
            _spans(found, i + 1, LIMITED[order]),
            order > 0,
            joint_dash(i),
        )
        for i in range(arm.n)
        if bool(arm.revolute[i]) == turns
    ]


def _derivative(samples: Samples, order: int) -> Array:
    return (samples.q, samples.qdot, samples.qddot, samples.qdddot)[order]


def _limits(planned: Planned, order: int, i: int) -> tuple[float, ...]:
    arm, limits = planned.question.arm, planned.question.limits
    if order == 0:
        return float(arm.limits[i, 0]), float(arm.limits[i, 1])
    most = (limits.velocity[i], limits.acceleration[i], float(limits.jerk()[i]))[order - 1]
    return (-most, most) if np.isfinite(most) else ()


def _loads(slot: Slot, planned: Planned, other: Planned | None, found: Sequence[Overrun], units: Units) -> list[Line]:
    which, order = (0, 1) if slot.of == "velocity" else (1, 2)
    own, theirs = shares(planned), None if other is None else shares(other)
    arm, of = planned.question.arm, LIMITED[order]
    if own is None:
        return []
    return [
        Line(
            f"|{derived_name(i, bool(arm.revolute[i]), order, units)}|, % of its limit",
            joint_colour(i),
            100.0 * own[which][:, i],
            None if theirs is None else 100.0 * theirs[which][:, i],
            (100.0,),
            _spans(found, i + 1, of),
            dash=joint_dash(i),
        )
        for i in range(arm.n)
    ]


def _spans(found: Sequence[Overrun], joint: int, quantity: Limited) -> tuple[tuple[float, float], ...]:
    return next((each.spans for each in found if (each.joint, each.quantity) == (joint, quantity)), ())
