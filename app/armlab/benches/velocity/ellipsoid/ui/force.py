"""Words and numbers of the force ellipsoid on its page."""

from __future__ import annotations

import math

from armlab.benches.velocity.ellipsoid.state import PlacedEllipsoid, VelocityBlock
from armlab.benches.velocity.ellipsoid.ui.scene import force
from armlab.benches.velocity.ellipsoid.ui.words import LETTERS, direction, every, half_axis, vector, volume_unit
from armlab.ui.format import mathml, number, pairs, subscript, trimmed
from armlab.ui.html import Markup, joined, tag

HALF = r"1/\sigma_i"
NAMES = {"translation": "force", "rotation": "moment"}


def force_axes(block: VelocityBlock, found: PlacedEllipsoid) -> Markup:
    """Return the half axes of the force ellipsoid with bars relative to the longest finite one."""
    halves = found.half_forces[: block.m].tolist()
    ends = [half for half in halves if math.isfinite(half)]
    longest = max(ends, default=1.0)
    rows = []
    for i, half in enumerate(halves):
        share = 100.0 if math.isinf(half) else 100.0 * half / longest
        rows.append(half_axis(f"1/{subscript('σ', i + 1)}", vector(found.axes[:, i]), force(block, half), share))
    aside = tag("small", mathml(HALF), ", the same directions")
    title = tag("h3", f"Half axes of {NAMES[block.key]}s ", aside)
    return joined(title, tag("div.half.force", rows, title="⟦Notes, section 5.4.1⟧"))


def force_verdict(block: VelocityBlock, found: PlacedEllipsoid) -> tuple[str, str, str]:
    """Return ``ok``, ``warn`` or ``no``, the verdict in a few words, and a sentence that explains it."""
    name, word = NAMES[block.key], "along" if block.key == "translation" else "about"
    halves = found.half_forces[: block.m]
    if found.lost:
        free = " and ".join(direction(found.axes[:, i]) for i in found.lost)
        return (
            "warn",
            "No torque needed",
            (f"A {name} {word} {free} is carried by the structure: no joint moves under it."),
        )
    weakest, strongest = force(block, float(halves[0])), force(block, float(halves[-1]))
    weak = direction(found.axes[:, 0])
    if block.m == 1:
        return "ok", "One direction", f"{word.capitalize()} {weak}: {weakest}."
    if found.is_round:
        return "ok", "Equally strong", f"{every(block)}: {strongest}."
    strong = direction(found.axes[:, block.m - 1])
    return "ok", "Slow is strong", f"Most {word} {strong}, {strongest}; least {word} {weak}, {weakest}."


def force_numbers(block: VelocityBlock, found: PlacedEllipsoid) -> Markup:
    """Return 1/w with its formula, and the torques that count as 1."""
    w = found.force.w
    shown = "∞" if math.isinf(w) else number(w, 3) if w < 1e4 else "over 10⁴"
    unit = volume_unit(block, found.ellipsoid.joint_directions.shape[1])
    unit = f"per {unit}" if unit and math.isfinite(w) else ""
    J = rf"J_{{{LETTERS[block.key]}}}" if block.speeds is None else r"\bar{J}"
    product = rf"{J}{J}^T" if block.m <= block.arm.n else rf"{J}^T{J}"
    formula = rf"F^T{J}{J}^TF=1,\;\sqrt{{\det({product})^{{-1}}}}=1/w"
    drawn = f"Drawn: 1 {block.force_unit} is {trimmed(block.drawn_force, 6)} m"
    return joined(
        pairs([((mathml("1/w"), f" of {block.key}"), f"{shown} {unit}")]),
        tag("div.eq.small", mathml(formula), title="The forces of torques of length 1⟦; notes 5.164⟧"),
        tag("p.dim", f"{torque_words(block)} {drawn}; half axes that are too long or infinite are drawn as lines."),
    )


def torque_words(block: VelocityBlock) -> str:
    """Return in words the joint torques that count as 1."""
    if block.speeds is not None:
        return "Revolute and prismatic joints: each counts by its power at its speed limit, √(Σ (τᵢ q̇ᵢ,max)²) ≤ 1 W."
    return f"For joint {'torques' if block.arm.revolute.all() else 'forces'} with √(Σ τᵢ²) ≤ 1 " + (
        "N m." if block.arm.revolute.all() else "N."
    )
