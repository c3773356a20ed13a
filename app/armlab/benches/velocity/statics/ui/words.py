"""The page of statics in words: torques as bars, virtual work, forces without torque, and the four subspaces."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.statics.state import (
    Balance,
    DrawDisplacement,
    Statics,
    balance,
    displacement,
    dualities,
    free_forces_at,
    work,
)
from armlab.kin.statics import Duality
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.colours import css, joint_colour
from armlab.ui.form import Form
from armlab.ui.format import dot, mathml, number, pairs, scientific, subscript, trimmed
from armlab.ui.html import Inside, Markup, classes, joined, tag
from armlab.ui.markup import fold, verdict_box
from armlab.ui.tables import head_line
from armlab.ui.units import units_of

Array = NDArray[np.float64]

ALONG = 0.9995
"""Component of a unit vector above which it is called an axis of the world."""

SAME_WORK = 1e-9
"""Difference, relative to the sizes of the terms of the work, up to which both sides are equal up to rounding."""

SAME_SIZE = 1e-9
"""Difference over the largest torque up to which torques are equally large."""

MILLI = 1e3

LAW, TOOL_WORK, JOINT_WORK = r"\tau=J^TF", r"F^T(J\,\delta q)", r"\tau^T\delta q"


def torques_markup(state: State) -> Markup:
    """Return the torques with bars, relative to the largest that the whole wrench can need."""
    found, arm = state.derived(balance), state[Joints].arm
    part = state[Statics]
    full = part.full_torque(arm)
    rows = []
    shares = np.clip(50.0 * part.shares(arm, found.torques), -50.0, 50.0)
    for i, value in enumerate(found.torques.tolist()):
        unit = "N m" if arm.revolute[i] else "N"
        none = abs(value) <= float(found.least[i])
        share = 0.0 if none else float(shares[i])
        shown = tag("b.zero", "0") if none else tag("b", number(value, _decimals(full)))
        left, colour = 50.0 + min(share, 0.0), css(joint_colour(i))
        bar = tag("u", style=f"--left:{left:.1f}%;--width:{abs(share):.1f}%;--c:{colour}")
        rows.append((tag("span", dot(colour), subscript("τ", i + 1)), bar, shown, tag("i", unit)))
    title = tag("h3", "Torques ", tag("small", mathml(LAW), "⟦, notes 5.163⟧"))
    scales = [f"A full bar or arc is {trimmed(full, 6)} N m."] if full and arm.revolute.any() else []
    if part.full_force and not arm.revolute.all():
        scales.append(f"For a prismatic joint a full bar or arrow is {trimmed(part.full_force, 6)} N.")
    return joined(title, tag("div.st-bars", rows), tag("p.dim", " ".join(scales)))


def _decimals(full: float) -> int:
    return 6 if full <= 0.02 else 3 if full <= 20.0 else 2 if full <= 200.0 else 1


def verdict_markup(state: State) -> Markup:
    """Return a card that says which joint has the largest torque, or why all are zero."""
    return verdict_box(*verdict(state.derived(balance), state[Joints].arm.revolute))


def verdict(found: Balance, revolute: NDArray[np.bool_]) -> tuple[str, str, str]:
    """Return ``ok`` or ``warn``, a few words, and a sentence."""
    if not found.wrench.any():
        return "ok", "No wrench", "The robot is not in contact; weights are neglected."
    if found.nothing:
        return (
            "ok",
            "No torque needed",
            "The structure carries this wrench: it does no work on any motion of the joints.",
        )
    idle = [i + 1 for i, value in enumerate(found.torques) if abs(value) <= found.least[i]]
    sizes = np.abs(found.torques) / np.maximum(found.least, 1e-300)
    most = np.flatnonzero(sizes >= (1.0 - SAME_SIZE) * sizes.max()).tolist()
    rest = (
        f" Joint{'s' if len(idle) > 1 else ''} {_listed(idle)} need{'s' if len(idle) == 1 else ''} none."
        if idle
        else ""
    )
    said = f"{', '.join(_torque(i, float(found.torques[i]), bool(revolute[i])) for i in most)}.{rest}"
    head = f"Joint{'s' if len(most) > 1 else ''} {_listed([i + 1 for i in most])} need{'s' if len(most) == 1 else ''}"
    return "ok", f"{head} the most", said


def _torque(i: int, value: float, turns: bool) -> str:
    return f"{subscript('τ', i + 1)} = {number(value, _decimals(abs(value)))} {'N m' if turns else 'N'}"


def _listed(numbers: list[int]) -> str:
    *first, last = [str(each) for each in numbers]
    return f"{', '.join(first)} and {last}" if first else last


def work_markup(form: Form, state: State) -> Markup:
    """Return both sides of the virtual work in numbers."""
    found, units, arm = state.derived(work), units_of(state), state[Joints].arm
    dq = state.derived(displacement)
    moved = ", ".join(
        f"{number(float(value) / units.factor(bool(turns)), units.decimals(bool(turns)) + int(turns))}"
        f"{'°' if turns and units.in_degrees else ' ' + units.unit(bool(turns))}"
        for value, turns in zip(dq, arm.revolute, strict=True)
    )
    tool, joints = float(found.tool), float(found.joints)
    apart = abs(tool - joints)
    # Where large terms cancel, the rounding of the sum is that of the terms.
    terms = np.abs(state.derived(balance).wrench) @ np.abs(arm.jacobian(state[Joints].q)) @ np.abs(dq)
    same = apart <= SAME_WORK * float(terms)
    rows: list[tuple[Inside, str]] = [
        (("tool, ", mathml(TOOL_WORK)), f"{number(MILLI * tool, 3)} mJ"),
        (("joints, ", mathml(JOINT_WORK)), f"{number(MILLI * joints, 3)} mJ"),
        ("difference", f"{'✓ ' if same else '✕ '}{scientific(MILLI * apart)} mJ"),
    ]
    again = form.button("displacement", "Another δq", DrawDisplacement(), "chip", "Draw another virtual displacement")
    head = "Virtual work ", tag("small", "⟦notes 5.160⟧")
    return fold(head, tag("p.dim", f"δq = ({moved})"), pairs(rows), tag("div.bar", again))


def free_markup(state: State) -> Markup:
    """Return the forces and moments that need no torque."""
    found = state.derived(dualities)
    joints = state[Joints]
    force = _directions(free_forces_at(joints.arm, joints.q), "force", "along")
    moment = _directions(found.moment.wrenches, "moment", "about")
    dashes = tag("span.st-free") if found.force.wrenches.shape[1] else None
    count = found.whole.wrenches.shape[1]
    whole = (
        "Every wrench needs torques."
        if count == 0
        else f"Force and moment together: {count} of the 6 dimensions of wrenches need none."
    )
    title = tag("h3", "Without torque ", tag("small", mathml("J^TF=0")))
    return joined(title, tag("p", dashes, force), tag("p", moment), tag("p.dim", whole))


def _directions(free: Array, name: str, word: str) -> str:
    """Return in words along which directions a force, or about which a moment, needs no torque."""
    if free.shape[1] == 0:
        return f"Every {name} by itself needs torques."
    if free.shape[1] == 3:
        return f"Any {name} in any direction."
    if free.shape[1] == 2:
        if name == "moment":
            return f"Any moment perpendicular to {_direction(np.cross(free[:, 0], free[:, 1]))}."
        return f"Any {name} {word} {_direction(free[:, 0])}, {word} {_direction(free[:, 1])}, or between."
    return f"A {name} {word} {_direction(free[:, 0])}."


def _direction(u: Array) -> str:
    """Return a direction in words; its sense does not matter."""
    k = int(np.argmax(np.abs(u)))
    if abs(float(u[k])) > ALONG:
        return f"{'xyz'[k]} of the world"
    sense = 1.0 if u[k] > 0.0 else -1.0
    return f"({', '.join(number(sense * float(value), 2) for value in u)})"


SPACES = (
    ("ℛ(J)", "velocities of the tool that joints give", "velocities"),
    ("𝒩(Jᵀ)", "wrenches that need no torque", "wrenches"),
    ("ℛ(Jᵀ)", "torques that a wrench balances", "torques"),
    ("𝒩(J)", "joint speeds that leave the tool at rest", "motions"),
)
"""Rows of the duality table: letters, words, and the columns of `Duality`."""


def duality_markup(state: State) -> Markup:
    """Return the dimensions of the four subspaces, for whole wrenches, for forces and for moments alone."""
    found, arm = state.derived(dualities), state[Joints].arm
    units = units_of(state)
    parts: tuple[Duality, ...] = (found.whole, found.force, found.moment)
    heads = [(speed, tag("br"), load) for speed, load in (("v, ω", "F, M"), ("v", "F"), ("ω", "M"))]
    rows = [
        tag("tr", tag("td", letters), tag("td", words), [_count(getattr(part, key)) for part in parts])
        for letters, words, key in SPACES
    ]
    said = (
        "ℛ(J) and 𝒩(Jᵀ) are orthogonal and fill all rows of J, ℛ(Jᵀ) and 𝒩(J) all joints: where the tool loses a "
        "velocity it gains a force for nothing. Six rows together: "
        f"{units.length(arm.length_scale)} count as much as 1 rad (half the reach)."
    )
    return fold(
        ("Dual subspaces ", tag("small", "dimensions")),
        tag("table.st-dual", head_line(None, None, *heads), rows),
        tag("p.dim", said),
    )


def _count(basis: Array) -> Markup:
    dimension = basis.shape[1]
    return tag(classes("td", zero=dimension == 0), str(dimension))
