"""Position and rotation of the tool as formulas in symbols, if they are short enough, with their present values."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.pose.tool.ui.formulas import (
    LONGEST,
    MOST_TERMS,
    Written,
    offset_lines,
    short_forms,
    used_constants,
    written,
)
from armlab.benches.pose.tool.ui.notation import symbol
from armlab.kin.arm import Arm
from armlab.kin.symbolic import PoseFormulas, constants
from armlab.kin.transforms import inverse
from armlab.session.parts.joints import Joints
from armlab.session.state import Post, State
from armlab.ui.format import mathml, number, subscript
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import copy_button
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui, Html

MOST_COPIED = 20_000
"""Largest number of characters of a text that the page holds for copying."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Write the formulas of the arm once; only the values follow its motion."""
    del post
    arm, units = state[Joints].arm, units_of(state)
    pose = PoseFormulas(arm)
    python, latex = pose.printed("text", MOST_TERMS), pose.printed("latex", MOST_TERMS)
    formulas = {name: written(arm, units, latex[name]) for name in latex}
    gui.html(_head(arm, python, formulas, len(pose.terms)))
    values: dict[str, Html] = {}

    def write(letter: str) -> None:
        fixed = {name: formula.latex for name, formula in formulas.items() if name[0] == letter and formula.constant}
        if fixed:
            gui.html(_constant(fixed))
        for name, terms in pose.terms.items():
            if name[0] == letter and name not in fixed:
                values[name] = gui.html()
                formula = formulas.get(name)
                gui.html(_formula(formula, python[name]) if formula else _too_long(terms))

    gui.heading("Position p")
    write("p")
    with gui.fold("Rotation R: row, column"):
        write("r")
    gui.html(_symbols(arm, units, python, formulas))

    def show(state: State) -> None:
        joints = state[Joints]
        T = inverse(joints.arm.base) @ joints.tool_pose
        for name, element in values.items():
            element.show(_value(name, T, units))

    return show


def _head(arm: Arm, python: dict[str, str], formulas: dict[str, Written], count: int) -> Inside:
    everything = {
        "LaTeX": "\\begin{aligned}\n"
        + " \\\\\n".join(f"{_symbol(name)} &= {formula.latex}" for name, formula in formulas.items())
        + "\n\\end{aligned}",
        "Python": "\n".join(f"{name} = {text}" for name, text in python.items()),
    }
    notes = _on_lengths(arm) if any(name[0] == "p" for name in formulas) else []
    hidden = sum(formula.left_out > 0 for formula in formulas.values())
    if hidden:
        notes.append(
            f"{hidden} of {count} formulas are long (over {LONGEST} characters of LaTeX): only their beginning is "
            "shown. The copies are complete."
        )
    if len(formulas) < count:
        notes.append(f"{count - len(formulas)} of {count} formulas have over {MOST_TERMS} terms and are not written.")
    copies = [_copy(kind, text) for kind, text in everything.items()] if formulas else None
    note = tag("p.dim", " ".join(notes)) if notes else None
    return tag("h3", "Tool in frame 0 ", mathml(symbol("0", "E")), tag("span.copies", copies)), note


def _on_lengths(arm: Arm) -> list[str]:
    """Return what has to be known of the lengths of the tool, which have no symbols."""
    lengths = np.abs(arm.tool[:3, 3])
    notes = []
    if lengths.any():
        notes.append("Numbers in the formulas of p are lengths in m, whatever units are chosen under View.")
    if (lengths == 1.0).any():
        notes.append("A length of 1 m is not written as a factor.")
    return notes


def _too_long(terms: int) -> Markup:
    """Return the text in place of a formula that is too long to read."""
    return tag("div.formula.dim", f"too long to read: about {float(f'{terms:.2g}'):,.0f} terms")


def _constant(numbers: dict[str, str]) -> Markup:
    """Return the entries that do not depend on the joints, in one line."""
    entries = [tag("span", mathml(f"{_symbol(name)}={{{value}}}")) for name, value in numbers.items()]
    return tag("div.where.small", entries)


def _formula(formula: Written, python: str) -> Markup:
    rest = (" ", tag("span.dim", f"… and {formula.left_out} more terms")) if formula.left_out else None
    copies = _copy("LaTeX", formula.latex), _copy("Python", python)
    return tag("div.formula", "= ", formula.markup, rest, tag("span.copies", copies))


def _symbols(arm: Arm, units: Units, python: dict[str, str], formulas: dict[str, Written]) -> Inside:
    """Return the meaning of the letters: short forms of sines and cosines, angles with an offset, constants."""
    lines = short_forms(arm, units, (formula.latex for formula in formulas.values()))
    lines += offset_lines(arm, units)
    known = constants(arm)
    for name in used_constants(python.values()):
        letter, index = name.rstrip("0123456789"), int(name.lstrip("alphd"))
        value = units.constant(known[name], letter == "alpha")
        lines.append(f"{subscript({'alpha': 'α'}.get(letter, letter), index)} = {value}")
    return tag("h3", "Where"), tag("div.where", [tag("span", line) for line in lines])


def _value(name: str, T: NDArray[np.floating], units: Units) -> Markup:
    if name[0] == "p":
        text = units.length(float(T["xyz".index(name[1]), 3]))
    else:
        text = number(float(T[int(name[1]) - 1, int(name[2]) - 1]), 3)
    return tag("div.value", mathml(_symbol(name)), f" = {text}")


def _symbol(name: str) -> str:
    return f"{name[0]}_{{{name[1:]}}}"


def _copy(kind: str, text: str) -> Markup | None:
    return copy_button(kind, text) if len(text) <= MOST_COPIED else None


PANEL = Panel((Joints,), build)
