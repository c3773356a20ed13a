"""The microscope in words and numbers: the distance from a singularity, its kind, and the answer of each method."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.microscope.look import Look, Near
from armlab.benches.velocity.microscope.state import Microscope
from armlab.kin.conditioning import SINGULAR, TITLES, conditioning
from armlab.kin.control.side_by_side import Compared
from armlab.kin.control.singular_poses import FAR
from armlab.kin.task import Task
from armlab.session.fields import Set
from armlab.ui.colours import css, joint_colour
from armlab.ui.form import Form
from armlab.ui.format import dot, number, readable, scientific, subscript
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.symbols import with_indices
from armlab.ui.units import Units

Array = NDArray[np.float64]

NAMES = {
    "transpose": "αJᵀ",
    "inverse": "J⁻¹",
    "pinv": "J#",
    "dls_constant": "DLS λ",
    "dls_variable": "DLS λ(σ)",
}
"""Short names of the methods."""

SQUARED = {"m": "m²", "": ""}

HUGE = 1e5
"""Least number that is written with a power of ten."""

ROUND = 1e-9
"""Distance, radians or metres, below which it counts as zero."""


def components(task: Task) -> list[tuple[str, bool]]:
    """Return the name of each component of a task's velocity, and whether it is a rotation."""
    found = [(f"v_{letter}", False) for letter in task.position]
    turns = {"none": [], "phi": ["ω_z"], "approach": ["ω about x_E", "ω about y_E"], "full": ["ω_x", "ω_y", "ω_z"]}
    return found + [(name, True) for name in turns[task.rotation]]


def joint_speed(look: Look, j: int, scaled: float, units: Units) -> str:
    """Return the speed of a joint (0-based) with its unit, from a scaled one."""
    revolute = bool(look.part.arm.revolute[j])
    return f"{_figure(scaled * float(look.task.joint_units[j]), revolute, units)} {_rate(revolute, units)}"


def condition_card(look: Look, near: Near | None, units: Units) -> Markup:
    """Return how near the configuration is to being singular, and the nearest singularity."""
    if not look.usual:
        said = "No joint moves what is asked, in any configuration: J = 0."
        return verdict_box("warn", "Rank 0 everywhere", said)
    inverse, short = look.inverse_condition, look.usual < len(look.sigma)
    verdict = conditioning(inverse)
    kind = {"singular": "no", "poor": "warn", "good": "ok"}[verdict]
    name = f"σ_{look.usual}" if short else "σ_min"
    whole = "for the whole task" if not short else "for what the joints can do"
    ratio = "" if look.singular else (with_indices(f"{name}/σ_max"), f" = {_small(inverse)} {whole}: ")
    unit = f" {look.task.sigma_unit}" if look.task.sigma_unit else ""
    smallest = with_indices(name), f" = {'0' if look.singular else _small(look.smallest)}{unit}, "
    largest = with_indices("σ_max"), f" = {number(float(look.sigma[0]), 3)}{unit}. "
    never = f"The rank of J is at most {look.usual} of {len(look.J)} in any configuration. " if short else ""
    return verdict_box(kind, TITLES[verdict], ratio, smallest, largest, never, _which(look, near, units))


def _which(look: Look, near: Near | None, units: Units) -> str:
    if near is None:
        return f"No singularity was found that one joint alone reaches within {_looked(look, units)}."
    says = " ".join(each.says for each in near.why)
    if abs(near.pose.away) <= ROUND:
        return says
    j, revolute = near.pose.place, bool(look.part.arm.revolute[near.pose.place])
    away = units.angle(abs(near.pose.away)) if revolute else units.length(abs(near.pose.away))
    at = units.angle(float(near.pose.q[j])) if revolute else units.length(float(near.pose.q[j]))
    return f"{away} away, at {units.variable(j, revolute)} = {at}: {says}"


def _looked(look: Look, units: Units) -> str:
    """Return in words how far the search for singularities went for each kind of joint."""
    arm, most = look.part.arm, FAR * look.task.joint_units
    said = [units.angle(float(most[arm.revolute][0]))] if arm.revolute.any() else []
    said += [units.length(float(most[~arm.revolute][0]))] if not arm.revolute.all() else []
    return " or ".join(said)


def sigma_bars(look: Look) -> Markup:
    """Return the singular values with bars, and the directions of the smallest one."""
    largest = float(look.sigma[0]) or 1.0
    unit = f" {look.task.sigma_unit}" if look.task.sigma_unit else ""
    rows = []
    for i, value in enumerate(look.sigma.tolist()):
        name = subscript("σ", i + 1)
        said = f"u = ({', '.join(number(float(part), 2) for part in look.U[:, i])})"
        size = f"{_small(value) if value > SINGULAR * largest else '0'}{unit}"
        bar = tag("u", style=f"--part:{100.0 * value / largest:.1f}%")
        rows.append((tag("span", name), tag("i", said), tag("b", size), bar))
    parts = [joined(dot(css(joint_colour(j))), number(value, 2)) for j, value in enumerate(look.V[:, -1].tolist())]
    name = subscript("v", len(look.sigma))
    last = tag("p.ms-v", f"{name} = (", joined(parts, between=", "), ")", title="Drawn at the joints")
    return joined(tag("div.half", rows), last)


def table(look: Look, form: Form, units: Units) -> Markup:
    """Return the answers of the methods as a table; the row that is drawn in the scene is marked."""
    arm = look.part.arm
    kinds = [turns for turns in (True, False) if bool(np.any(arm.revolute == turns))]
    heads = tag(
        "tr",
        tag("th"),
        [tag("th", "max |q̇|", tag("br"), _rate(turns, units)) for turns in kinds],
        tag("th", "along v", title="Component of the reached velocity along the wanted one"),
        tag("th", "error", title="|v reached − v| / |v|"),
        tag("th", "angle", title="Angle between the reached and the wanted velocity"),
    )
    return tag("table.ms-table", heads, [_row(look, answer, kinds, form, units) for answer in look.answers])


def _row(look: Look, answer: Compared, kinds: list[bool], form: Form, units: Units) -> Markup:
    pressed = look.part.method == answer.key
    title = f"{answer.title}, α = 1/σ_max²" if answer.key == "transpose" else answer.title
    hint = f"{title}: draw the velocity it gives the tool"
    name = form.chip(f"watch {answer.key}", NAMES[answer.key], Set(Microscope, "method", answer.key), hint, pressed)
    if answer.step.qdot is None:
        return tag("tr", tag("th", name), tag("td.said", answer.step.says, colspan=len(kinds) + 3))
    speeds = np.abs(answer.step.qdot * look.task.joint_units)
    return tag(
        "tr",
        tag("th", name),
        [_fastest(look, speeds, turns, units) for turns in kinds],
        tag("td", f"{_percent(answer.along)} %", title=_reached(look, answer, units)),
        tag("td", f"{_percent(answer.error)} %"),
        tag("td", "–" if answer.off is None else units.angle(answer.off)),
    )


def _fastest(look: Look, speeds: Array, turns: bool, units: Units) -> Markup:
    """Return the cell of the fastest joint that turns, or slides; it is marked if a joint exceeds its speed limit."""
    arm = look.part.arm
    those = arm.revolute == turns
    text = _figure(float(speeds[those].max(initial=0.0)), turns, units)
    above = [units.variable(j, turns) for j in np.flatnonzero(those & (speeds > arm.speed_limits)).tolist()]
    if not above:
        return tag("td", text)
    return tag("td.no", f"{text}\N{HAIR SPACE}!", title=f"Above the speed limit: {', '.join(above)}")


def _reached(look: Look, answer: Compared, units: Units) -> str:
    """Return how fast the tool translates and rotates."""
    assert answer.reached is not None
    task, natural = look.part.arm.task, look.natural(answer.reached)
    p = len(task.position)
    parts = [("moves at", natural[:p], False), ("turns at", natural[p:], True)]
    said = [
        f"{verb} {_figure(float(np.linalg.norm(part)), turns, units)} {_rate(turns, units)}"
        for verb, part, turns in parts
        if len(part)
    ]
    return f"The tool {' and '.join(said)}"


def scales_words(look: Look) -> str:
    """Return in words the scaling of the singular values and of the damping."""
    if not look.task.sigma_unit and look.part.arm.task.rotation != "none" and look.part.arm.task.position:
        return (
            f"Metres and radians are mixed: lengths are divided by {readable(look.task.length, 3)} m, half the reach."
        )
    if look.task.length != 1.0:
        return (
            f"Revolute and prismatic joints: lengths are divided by {readable(look.task.length, 3)} m, half the reach."
        )
    return ""


def damping_unit(look: Look, unit: str) -> str:
    """Return the unit of an option that has the unit of singular values, or of their squares."""
    own = look.task.sigma_unit
    return {"sigma": own, "sigma²": SQUARED[own]}.get(unit, "")


def _figure(value: float, revolute: bool, units: Units) -> str:
    shown = value / units.factor(revolute)
    return number(shown, units.decimals(revolute)) if abs(shown) < HUGE else scientific(shown)


def _rate(revolute: bool, units: Units) -> str:
    return f"{units.unit(revolute)}/s"


def _percent(part: float) -> str:
    return number(100.0 * part, 1) if abs(part) < HUGE else scientific(100.0 * part)


def _small(value: float) -> str:
    """Return a number whose zeros are significant: with four digits, or with a power of ten."""
    return number(value, 4) if value >= 1e-3 or value == 0.0 else scientific(value)
