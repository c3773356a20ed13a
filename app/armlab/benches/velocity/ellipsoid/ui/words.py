"""Words on the velocity ellipsoid: the verdict, w with its unit and formula, and the scaling."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.ellipsoid.state import PlacedEllipsoid, VelocityBlock
from armlab.benches.velocity.ellipsoid.ui.scene import speed
from armlab.kin.arm import Arm
from armlab.kin.conditioning import TITLES, conditioning
from armlab.kin.joint_scale import DEFAULT_SPEED
from armlab.ui.format import mathml, number, trimmed
from armlab.ui.html import Markup, joined, tag
from armlab.ui.units import Units

Array = NDArray[np.float64]

ALONG = 0.9995
"""Component of a unit vector above which it is called an axis of the world."""

LETTERS = {"translation": "v", "rotation": r"\omega"}
POWERS = {1: "", 2: "²", 3: "³"}


def verdict_of(block: VelocityBlock, found: PlacedEllipsoid) -> tuple[str, str, str]:
    """Return ``ok``, ``warn`` or ``no``, the verdict in a few words, and a sentence that explains it."""
    along = "along" if block.key == "translation" else "about"
    shape = found.ellipsoid
    measured = shape.joint_directions.shape[1]
    least = found.axes[:, measured - 1]
    if found.lost and found.lost[0] >= measured:
        lost = " and ".join(direction(found.axes[:, i]) for i in found.lost)
        return (
            "warn",
            "Fewer joints than directions",
            (f"In every configuration some directions are lost; here {along} {lost}."),
        )
    if found.lost:
        lost = " and ".join(direction(found.axes[:, i]) for i in found.lost)
        nothing = "No joint speed moves the tool" if block.key == "translation" else "No joint speed turns the tool"
        return "no", TITLES["singular"], f"{nothing} {along} {lost}."
    slowest, verdict = speed(block, shape.sigma_min), conditioning(shape.inverse_condition, bool(found.lost))
    ratio = f"For {block.key} alone, the shortest half axis is {number(shape.inverse_condition, 3)} of the longest"
    if verdict == "poor":
        return "warn", TITLES[verdict], f"{ratio}. {along.capitalize()} {direction(least)} only {slowest}."
    if block.m == 1:
        return "ok", "One direction", f"{along.capitalize()} {direction(least)}: {slowest}."
    return "ok", TITLES[verdict], f"{ratio}. {every(block)}: at least {slowest}."


def every(block: VelocityBlock) -> str:
    """Return in words the directions that the task controls, to which the shortest half axis belongs."""
    task = block.arm.task
    if block.m == 3:
        return "In every direction" if block.key == "translation" else "About every axis"
    if block.key == "rotation":
        return "About every axis perpendicular to the tool's z"
    return f"In every direction the task controls ({', '.join(task.position)})"


def direction(u: Array) -> str:
    """Return a direction in words; its sense does not matter."""
    k = int(np.argmax(np.abs(u)))
    return f"{'xyz'[k]} of the world" if abs(float(u[k])) > ALONG else vector(u)


def vector(u: Array) -> str:
    """Return a direction without a sense: its largest component is positive."""
    sense = 1.0 if u[int(np.argmax(np.abs(u)))] > 0.0 else -1.0
    return f"({', '.join(number(sense * float(value), 2) for value in u)})"


def half_axis(name: str, direction: str, size: str, share: float) -> Markup:
    """Return a half axis with a bar; ``share`` is its percentage of the longest."""
    bar = tag("u", style=f"--part:{share:.1f}%")
    return joined(tag("span", name), tag("i", direction), tag("b", size), bar)


def name_of_w(block: VelocityBlock) -> Markup:
    """Return the name of w with the rows of J from which it is computed."""
    scaled = "" if block.speeds is None else ", scaled by limits"
    return joined(mathml("w"), f" of {block.key}{scaled}")


def volume(block: VelocityBlock) -> str:
    """Return the formula by which w of this block is computed, in LaTeX."""
    J = rf"J_{{{LETTERS[block.key]}}}"
    n, joints = block.arm.n, ""
    if block.speeds is not None:
        J, joints = r"\bar{J}", rf",\;\bar{{J}}={J}\,\mathrm{{diag}}(\dot{{q}}_{{max}})"
    product = rf"{J}\,{J}^T" if block.m <= n else rf"{J}^T{J}"
    axes = r"\,".join(rf"\sigma_{i + 1}" for i in range(min(block.m, n)))
    return rf"w=\sqrt{{\det({product})}}={axes}{joints}"


def volume_unit(block: VelocityBlock, k: int) -> str:
    """Return the unit of the product of k half axes; without scaled joints each is in m/s for each rad/s or m/s."""
    if block.speeds is None:
        return f"m{POWERS[k]}" if block.key == "translation" and block.arm.revolute.all() else ""
    length = "m" if block.key == "translation" else "rad"
    return f"{length}{POWERS[k]}/s{POWERS[k]}"


def scaling_words(block: VelocityBlock, units: Units) -> str:
    """Return in words the joint speeds that count as 1."""
    arm = block.arm
    if block.speeds is None:
        return f"For joint speeds with √(Σ q̇ᵢ²) ≤ 1 {'rad/s' if arm.revolute.all() else 'm/s'}."
    speeds = [
        f"{units.variable(i, bool(arm.revolute[i]))} {_limit(arm, i, float(speed), units)}"
        for i, speed in enumerate(block.speeds)
    ]
    said = f"Revolute and prismatic joints: each speed is a fraction of its limit, √(Σ …²) ≤ 1: {', '.join(speeds)}."
    known = bool(np.isfinite(arm.speed_limits).all())
    return said if known else f"{said} * No limit is known, {DEFAULT_SPEED:g} is taken."


def _limit(arm: Arm, i: int, value: float, units: Units) -> str:
    mark = "" if np.isfinite(arm.speed_limits[i]) else " *"
    if not arm.revolute[i]:
        return f"{trimmed(value, 3)} m/s{mark}"
    return f"{trimmed(value / units.factor(True), 2)} {units.angle_unit}/s{mark}"
