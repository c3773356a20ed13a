"""The three spaces as a diagram with the arm's own numbers, its map f_r, and how n and m compare."""

from __future__ import annotations

from functools import lru_cache, partial

from armlab.benches.pose.spaces.maps import KINDS, Component, Maps, components_of, maps_of
from armlab.benches.pose.spaces.state import TASKS, Spaces
from armlab.benches.pose.tool.ui.formulas import written
from armlab.kin.arm import Arm
from armlab.kin.symbolic import PoseFormulas
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.form import Form
from armlab.ui.format import mathml, number
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.symbols import with_indices
from armlab.ui.units import Units, units_of

SHORT = 8
"""Largest number of terms of a component of f_r that is written out."""

SIGNS = {"square": "ok", "redundant": "ok", "more": "warn", "fixed": "warn"}
"""Kind of the card for each way in which n and m compare."""


def maps_markup(form: Form, state: State) -> Inside:
    """Return the choice of r, the diagram and the card."""
    found, units = maps_of(state), units_of(state)
    texts = {key: words.replace("_", "") for key, words in TASKS.items()}
    chosen = form.select(
        "task",
        "What r describes",
        texts,
        state[Spaces].task,
        partial(Set, Spaces, "task"),
    )
    return (
        tag("div.kit-head", tag("span.dim", "r describes"), chosen),
        _diagram(state, found, units),
        _formulas(state[Joints].arm, found, units),
        _card(found),
        tag(
            "p.dim",
            "⟦The notes call m the number of variables of the configuration space: it is that of the task "
            "space, and the configuration has n.⟧",
        ),
    )


def _diagram(state: State, found: Maps, units: Units) -> Markup:
    joints = state[Joints]
    q = [
        (units.variable(i, bool(turns)), units.angle(value) if turns else units.length(value))
        for i, (value, turns) in enumerate(zip(joints.q.tolist(), joints.arm.revolute, strict=True))
    ]
    r = [(each.symbol, _value(each, units)) for each in components_of(state)]
    return tag(
        "div.sp-diagram",
        _space(
            "Actuation space",
            f"motors: {found.n}",
            tag("p.dim", "A motor drives each joint, most through gears."),
        ),
        _arrow(tag("b", "gears"), "here the lab commands q itself"),
        _space("Joint space", f"n = {found.n}", _values(q)),
        _arrow(tag("b", "r = f", tag("sub", "r"), "(q)"), "direct kinematics; the way back is inverse"),
        _space("Task space", f"m = {found.m}", (_values(r), _unit_length(found))),
    )


def _unit_length(found: Maps) -> Markup | None:
    """Return why a direction is told by more components than it counts."""
    if found.task.rotation != "approach":
        return None
    return tag("p.dim", "a has length 1: its three components count as two numbers.")


def _space(name: str, size: str, inside: Inside) -> Markup:
    return tag("div.sp-space", tag("b", name), tag("i", size), inside)


def _arrow(name: Markup, says: str) -> Markup:
    return tag("div.sp-arrow", tag("span", "↓"), name, tag("span.dim", says))


def _values(values: list[tuple[str, str]]) -> Markup:
    return tag("div.sp-values", [tag("span", with_indices(name), " ", tag("b", value)) for name, value in values])


def _value(component: Component, units: Units) -> str:
    if component.kind == "length":
        return units.length(component.value)
    return units.orientation(component.value) if component.kind == "angle" else number(component.value, 3)


def _formulas(arm: Arm, found: Maps, units: Units) -> Markup:
    """Return f_r in symbols, as far as it is short."""
    lines = [
        tag("div", mathml(f"p_{letter}="), written(arm, units, latex).markup)
        for letter in found.task.position
        if (latex := _short(arm).get(f"p{letter}"))
    ]
    missing = len(found.task.position) - len(lines)
    rest = "position" if not lines else "rest"
    more = tag("p.dim", f"The {rest} of f_r is long: the page FK formulas has it.") if missing else None
    head = tag("h3", with_indices("f_r"), " of this arm")
    return tag("div.sp-formulas", head, lines, more)


@lru_cache(maxsize=16)
def _short(arm: Arm) -> dict[str, str]:
    """Return the coordinates of the tool that have few terms, in LaTeX."""
    return {name: text for name, text in PoseFormulas(arm).printed("latex", SHORT).items() if name[0] == "p"}


def _card(found: Maps) -> Markup:
    return verdict_box(SIGNS[found.kind], KINDS[found.kind], tag("p", _said(found)), _here(found))


def _said(found: Maps) -> str:
    n, m = found.n, found.m
    if found.kind == "square":
        return f"n = {n}, m = {m}: most r have a few solutions q, or none. The page Solutions lists them."
    if found.kind == "redundant":
        what = "a curve" if found.spare == 1 else f"a set of dimension {found.spare}"
        return f"n = {n}, m = {m}: to one r within reach belongs {what} of q, and the arm may choose."
    if found.kind == "more":
        return f"n = {n}, m = {m}: r = f_r(q) fills at most {n} of {m} dimensions, so most r belong to no q."
    return f"Moving the joints changes r in {found.generic} of {m} dimensions only, so most r belong to no q."


def _here(found: Maps) -> Markup | None:
    if found.rank == found.generic:
        return None
    return tag("p", f"At the present q it changes in {found.rank} of them only: the arm is singular here.")
