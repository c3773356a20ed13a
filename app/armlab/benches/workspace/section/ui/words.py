"""The section of a workspace in words and numbers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.workspace.cloud.ui import measured
from armlab.benches.workspace.section.found import REACH, Found
from armlab.benches.workspace.section.marks import Measured, target_measured, tool_measured
from armlab.benches.workspace.section.state import GoToPoint, found_of
from armlab.kin.workspace.crossings import fineness
from armlab.kin.workspace.first_joint import FirstJoint
from armlab.kin.workspace.section_size import dimension, has_no_size
from armlab.session.state import State
from armlab.ui.form import Form
from armlab.ui.format import MINUS, number, pairs
from armlab.ui.html import Inside, tag
from armlab.ui.units import Units

EDGE = 2.0
"""Multiple of the boundary's error within which a point counts as on the boundary."""

SAME = 1e-9
"""Difference of cosines, or of lengths in reaches, below which directions and points are the same."""

NO_SIZE = ("none: the tool stays in one point", "none: the tool stays on a line", "none: the tool stays on a surface")
"""Sentences on the area or volume of a tool that covers none, by the dimension of what it covers."""

CENTRE = "The point of axis 1 that is nearest to the origin of frame 0"


def scale(found: Found) -> Inside:
    """Return the colours and their meaning, or nothing if one colour shows the reached region."""
    if found.colour == REACH or found.values is None:
        return None
    note = "" if found.coloured else " Being averaged …"
    colours = measured.scale(found.arm, found.colour, found.low, found.high)
    return colours, tag("p.dim", f"Mean over random configurations in and beside each cell.{note}")


def facts(found: Found, units: Units) -> Inside:
    """Return size and reach."""
    if found.size is None or found.reach is None:
        return None
    joint, reach = found.section.joint, found.reach
    flat = found.section.grid.flat
    rows: list[tuple[Inside, Inside]] = [("Area" if flat else "Volume", _size(found))]
    if joint.revolute:
        rows.append(("From the axis of joint 1", f"{units.text(reach.inner, False)} to {units.length(reach.outer)}"))
        if not flat:
            upright = joint.axes[:, 2] @ joint.arm.base[:3, 2] > 1.0 - SAME
            along = "Height over frame 0" if upright else "Along axis 1"
            rows.append((along, f"{units.text(reach.low, False)} to {units.length(reach.high)}"))
            rows.append((("Farthest from ", _centre(joint)), units.length(reach.farthest)))
    else:
        first, second = across(joint)
        rows.append((f"Along {first}", f"{units.text(reach.inner, False)} to {units.length(reach.outer)}"))
        if not flat:
            rows.append((f"Along {second}", f"{units.text(reach.low, False)} to {units.length(reach.high)}"))
    if not joint.full:
        rows.append(
            ("Joint 1", f"{units.text(joint.low, joint.revolute)} to {_joint(joint.high, joint.revolute, units)}")
        )
    return tag("div.sc-facts", pairs(rows)), tag("p.dim", _how(found, units))


def across(joint: FirstJoint) -> tuple[str, str]:
    """Return the directions of u and v across a joint 1 that slides, in frame 0: as x₀, or by their components."""
    u, v = (joint.arm.base[:3, :3].T @ joint.axes[:, :2]).T
    return _direction(u), _direction(v)


def _direction(along: NDArray[np.float64]) -> str:
    k = int(np.argmax(np.abs(along)))
    if abs(along[k]) < 1.0 - SAME:
        return f"({', '.join(number(float(part), 2) for part in along)})"
    return f"{'' if along[k] > 0.0 else MINUS}{'xyz'[k]}₀"


def _centre(joint: FirstJoint) -> Inside:
    """Return the origin from which the reach is measured; axis 1 may miss the origin of frame 0."""
    apart = float(np.linalg.norm(joint.origin - joint.arm.base[:3, 3]))
    meets = apart <= SAME * (joint.arm.reach or 1.0)
    return "frame 0" if meets else tag("span", "ρ = z = 0", title=CENTRE)


def _joint(value: float, revolute: bool, units: Units) -> str:
    return units.angle(value) if revolute else units.length(value)


def _size(found: Found) -> str:
    assert found.size is not None
    if found.size.value == 0.0 and has_no_size(found.section):
        return NO_SIZE[dimension(found.section.joint)]
    return measured.with_error(found.size)


def _how(found: Found, units: Units) -> str:
    cell = units.length(found.section.step)
    return (
        f"Cells of {cell}, filled from random samples and by inverse kinematics from cell to cell; the boundary was "
        "found by inverse kinematics. A part that no search has found would be missing."
    )


def distances(form: Form, state: State, units: Units) -> Inside:
    """Return the distances of tool and target from the boundary, and buttons to go there."""
    tool, target = state.derived(tool_measured), state.derived(target_measured)
    if tool is None:
        return None
    rows: list[tuple[Inside, Inside]] = [("Tool", _way(state, tool, units))]
    if target is not None:
        rows.append(("Target", _way(state, target, units)))
    x, y, z = (target or tool).to.foot.tolist()
    place = ", ".join(units.text(value, False) for value in (x, y, z))
    rows.append(("Boundary at", f"({place}) {units.length_unit}"))
    go = form.chip("boundary", "Go to it", GoToPoint((x, y, z)), "Bring the tool to the nearest boundary point")
    return tag("h3", "To the boundary"), tag("div.sc-facts", pairs(rows)), tag("div.bar", go)


def _way(state: State, measured: Measured, units: Units) -> Inside:
    found = found_of(state)
    assert found is not None
    if abs(measured.to.distance) <= EDGE * fineness(found.section.grid) * found.section.step:
        return "on the boundary"
    inside = measured.to.distance >= 0.0
    mark = tag("span.ok", "✓") if inside else tag("span.no", "✕")
    return mark, f" {units.length(abs(measured.to.distance))} {'inside' if inside else 'outside'}"
