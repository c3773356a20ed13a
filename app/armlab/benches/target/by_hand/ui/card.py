"""The steps of a derivation as markup: a head for each, and what it says when it is unfolded."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.target.by_hand.state import ByHand, ChooseBranch, FollowArm, GoByHand, Sheet, is_there
from armlab.benches.target.by_hand.ui.formula import equation, text_of, with_unit
from armlab.benches.target.solutions.state import fresh
from armlab.kin.ik.by_hand import Quantity, Step
from armlab.kin.ik.solutions import beyond_limits, wrapped_rows
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.session.way_to_solution import gap
from armlab.ui.form import Form
from armlab.ui.format import mathml
from armlab.ui.html import Inside, Markup, classes, tag
from armlab.ui.markup import verdict_box
from armlab.ui.units import Units

Vector = NDArray[np.float64]

SAME = 1e-6
"""Distance in all joints, radians or length scales, below which a solution of the list is the one found by hand."""


def step_card(form: Form, state: State, found: Sheet, k: int, units: Units) -> Markup:
    """Return a step, numbered from 1, unfolded where it is the one that is drawn or all are."""
    part, step = state[ByHand], found.derivation.steps[k - 1]
    chosen = k == shown_step(state, found)
    unfolded = chosen or part.unfolded
    head = form.button(
        f"step{k}",
        (tag("i", str(k)), tag("b", mathml(step.symbol)), tag("span", step.by), tag("em", _result(state, step, units))),
        Set(ByHand, "shown", k),
        "bh-head",
        "Unfold this step and draw it",
        aria_expanded=str(unfolded).lower(),
    )
    inside: list[Inside] = [head]
    if unfolded:
        inside.append(tag("p", f"{step.title}."))
    if len(step.branches) > 1:
        inside.append(_branches(form, state, found, step, units))
    if unfolded:
        inside += [_given(step, units), [equation(line, step, units) for line in step.lines]]
    if step.note:
        inside.append(_note(step, units))
    return tag(classes("div.bh-step", now=chosen, fails=step.case == "none"), inside)


def shown_step(state: State, found: Sheet) -> int:
    """Return the number of the step that is drawn; the last one where there are fewer."""
    return min(state[ByHand].shown, len(found.derivation.steps))


def _result(state: State, step: Step, units: Units) -> str:
    if step.case == "none":
        return "✕ no value"
    if step.index < 0:
        return ""
    value = step.branches[step.chosen].value
    assert value is not None
    return joint_value(state, step, value, units)


def joint_value(state: State, step: Step, value: float, units: Units) -> str:
    """Return a value of the joint that a step finds, with its unit."""
    revolute = state[Joints].arm.rows[step.index].revolute
    return units.angle(value) if revolute else units.length(value)


def _branches(form: Form, state: State, found: Sheet, step: Step, units: Units) -> Markup:
    chips = []
    for i, branch in enumerate(step.branches):
        assert branch.value is not None
        leads = found.leads_on(step, i)
        sign = "+" if i == 0 else "−"
        value = joint_value(state, step, branch.value, units)
        # Signs stand before a text: behind it they would be a part of what is translated.
        text = f"{'' if leads else '✕ '}{sign} {branch.title} {value}"
        hint = "Take this branch" if leads else "Take this branch: a later step then has no value"
        chips.append(form.chip(f"{step.key} {i}", text, ChooseBranch(step.key, i), hint, i == step.chosen))
    return tag("div.bar", chips)


def _given(step: Step, units: Units) -> Markup | None:
    """Return the quantities that no equation of the step gives, each value beside its name."""
    made = {line.left for line in step.lines}
    shown = [
        tag("span", mathml(one.symbol), tag("b", _text(one, units)))
        for name, one in step.values.items()
        if name not in made and not any(mark in one.symbol for mark in (r"\pm", r"\mp", "^2"))
    ]
    return tag("div.bh-given", shown) if shown else None


def _text(one: Quantity, units: Units) -> str:
    if isinstance(one.value, tuple):
        unit = f" {units.length_unit}" if one.unit == "m" else ""
        return f"({', '.join(text_of(value, one, units) for value in one.value)}){unit}"
    return with_unit(one, units)


def _note(step: Step, units: Units) -> Markup:
    said = step.note.replace("{gap}", units.length(step.gap))
    kind = {"none": "no", "merged": "warn", "any": "todo"}.get(step.case, "todo")
    return tag(f"p.bh-note.{kind}", said)


def end_card(form: Form, state: State, found: Sheet, units: Units) -> Markup:
    """Return what the derivation ends in: the joint values, their error, and their place in the list of solutions."""
    one, joints = found.derivation, state[Joints]
    if one.q is None:
        failed = one.failed
        number = len(one.steps)
        said = "" if failed is None else failed.note.replace("{gap}", units.length(failed.gap))
        return verdict_box("no", f"Step {number} has no value", tag("p", said))
    values = [
        tag("span", mathml(f"q_{i + 1}"), tag("b", units.angle(value) if row.revolute else units.length(value)))
        for i, (value, row) in enumerate(zip(one.q.tolist(), joints.arm.rows, strict=True))
    ]
    error = units.length(one.position_error)
    if joints.arm.task.rotation != "none":
        error = f"{error} and {units.angle(one.rotation_error)}"
    there, beyond = is_there(state, found), out_of_limits(state, one.q)
    text = "The arm is here" if there else "Out of limits" if beyond else "Move the arm here"
    go = form.chip("go", text, GoByHand(), off=there or bool(beyond))
    follow = form.chip(
        "follow", "Branches of the arm", FollowArm(), "Choose the branches nearest to the present configuration again"
    )
    return tag(
        "div.bh-end",
        tag("h3", "The joint values"),
        tag("div.bh-given", values),
        tag("p", f"Forward kinematics puts the tool {error} from the target. {_listed(state, found)}{beyond}"),
        tag("div.bar", go, follow if state[ByHand].choices else None),
    )


def out_of_limits(state: State, q: Vector) -> str:
    """Return a sentence on the joints that no whole turn brings inside their limits, empty when there are none."""
    arm = state[Joints].arm
    out = np.flatnonzero(beyond_limits(arm, wrapped_rows(arm, q[None]))[0])
    if not len(out):
        return ""
    *others, last = (str(i + 1) for i in out)
    return (
        f" Out of the limits of joints {', '.join(others)} and {last}."
        if others
        else f" Out of the limits of joint {last}."
    )


def _listed(state: State, found: Sheet) -> str:
    """Return the sentence on the same joint values in the list of all solutions."""
    q, arm = found.derivation.q, state[Joints].arm
    assert q is not None
    list_ = state.derived(fresh)
    if list_ is None:
        return f"This is {found.name}." if found.name else ""
    called = f"This is {found.name}, " if found.name else "This is "
    if list_.solutions.completeness == "infinite":
        return f"{called}one of the infinitely many solutions."
    for place, row in enumerate(list_.rows, start=1):
        if float(abs(gap(arm, row.q, q)).max()) < SAME:
            return f"{called}number {place} of {len(list_.rows)} on the page Solutions."
    return f"{called}which is not in the list of the page Solutions."
