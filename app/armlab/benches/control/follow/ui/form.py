"""The form of a run of kinematic control: the reference, the start, the law and the plant."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache, partial
from typing import Any

from armlab.benches.control.follow.chosen import CLOCK, KNOWLEDGE, MOTORS, NULL, REFERENCES, WAY, Setup
from armlab.benches.control.follow.commands import (
    AimAt,
    ChooseInverse,
    ChooseLaw,
    ChooseReference,
    SetOffset,
    SetOption,
    SetStart,
    SetValue,
)
from armlab.benches.control.follow.state import Control, starts_elsewhere
from armlab.kin.arm import Arm
from armlab.kin.control.control_law import control_laws
from armlab.kin.control.rate_inverse import rate_inverses
from armlab.kin.control.scaled_task import ScaledTask
from armlab.kin.field import Field
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State
from armlab.ui.form import Form
from armlab.ui.format import lowered, mathml, trimmed
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.option_form import option_form
from armlab.ui.option_text import PLAIN, Scale
from armlab.ui.units import Units, units_of

ELSEWHERE = "The home configuration is singular, or nearly so: the reference starts from another one."

PERCENT = (Scale("%", 0.01),)


def scales_of(key: str, units: Units) -> Sequence[Scale]:
    """Return the unit on screen of a value of a run whose unit is ``q``."""
    if key in ("speed", "radius", "slide_limit"):
        return (Scale(units.length_unit, units.factor(False)),)
    if key == "limit":
        return (Scale(units.angle_unit, units.factor(True)),)
    return PERCENT if key == "wrong" else PLAIN


def reference_markup(form: Form, state: State) -> Markup:
    """Return the controls of the reference, of its start and of the initial offset."""
    run, units = state[Control].run, units_of(state)
    chooser = form.select("ref", "Reference", REFERENCES, run.reference, ChooseReference, "What the tool is to follow")
    level = "z" not in state[Joints].arm.task.position
    way = _values(form, run, [each for each in WAY if not (level and each.key == "elevation")], units)
    found: list[Inside] = [tag("div.kit-head", chooser), _group(way)]
    if run.reference == "target":
        found.append(_target(form, state, units))
    if run.reference != "planned":
        hint = "Start the reference from the present configuration"
        here = form.button("here", "Present configuration", SetStart(), "chip", hint)
        found.append(_joints(form, state, "start", run.start, SetStart, "Start", here))
        found.append(tag("p.dim", ELSEWHERE) if starts_elsewhere(state) else None)
    sum_of = tag("span.dim", "q(0) = start + offset")
    return joined(found, _joints(form, state, "offset", run.offset, SetOffset, "Initial offset", sum_of))


def _group(fields: Markup) -> Markup | None:
    return tag("div.options", fields) if fields else None


def law_markup(form: Form, state: State) -> Markup:
    """Return law and inverse with their formulas and options, and the self-motion of a redundant arm."""
    run, arm, units = state[Control].run, state[Joints].arm, units_of(state)
    sigma = sigma_unit(arm)
    laws = {key: law.title for key, law in control_laws().items()}
    found: list[Inside] = [
        tag("div.kit-head", form.select("law", "Control law", laws, run.law, ChooseLaw)),
        tag("p.ct-formula", mathml(run.kind.formula)),
        _options(form, "law", _gains(run.kind.fields, arm), dict(run.law_options), sigma),
    ]
    if run.kind.inverts:
        inverses = {key: method.title for key, method in rate_inverses().items()}
        chooser = form.select("inverse", "Inverse of J", inverses, run.inverse, ChooseInverse)
        found += [
            tag("div.kit-head", chooser),
            tag("p.ct-formula", mathml(run.method.formula)),
            _options(form, "inverse", run.method.fields, dict(run.inverse_options), sigma),
        ]
        if arm.n > arm.task.m:
            found.append(tag("div.options", _values(form, run, NULL, units)))
    return joined(found)


def law_words(run: Setup) -> str:
    """Return the names of the control law and, where it has one, of the inverse."""
    inverse = f", {lowered(run.method.title)}" if run.kind.inverts else ""
    return f"{lowered(run.kind.title)}{inverse}"


def plant_markup(form: Form, state: State) -> Markup:
    """Return the fields for the deviations of the arm from an ideal one."""
    run, units, arm = state[Control].run, units_of(state), state[Joints].arm
    motors = tuple(
        each for each in MOTORS if each.key == "saturation" or bool((arm.revolute == (each.key == "limit")).any())
    )
    encoder = KNOWLEDGE if run.counts else tuple(each for each in KNOWLEDGE if each.key not in ("shaft", "ratio"))
    return joined(tag("div.options", _values(form, run, group, units)) for group in (motors, CLOCK, encoder))


def plant_words(run: Setup, made: float | None = None) -> str:
    """Return in a few words the deviations of the arm from an ideal one; ``made`` is the step of the result."""
    found = []
    if run.saturation != "none":
        found.append("speeds limited")
    if run.sampling:
        step, held = run.held(made)
        exact = math.isclose(held, run.sampling, rel_tol=1e-6)
        steps = "" if exact else f", whole steps of {trimmed(1000.0 * step, 3)} ms"
        found.append(f"T_s = {trimmed(1000.0 * held, 3)} ms{steps}")
    if run.counts:
        found.append(f"encoder on the {run.shaft}")
    if run.wrong:
        found.append(f"{'all links' if not run.link else f'link {run.link}'} {trimmed(100.0 * run.wrong, 3)} % wrong")
    return ", ".join(found) or "ideal"


def _values(form: Form, run: Setup, group: Sequence[Field], units: Units) -> Markup:
    """Return the fields of a group that can be used, each in its own unit."""
    seen = run.seen(tuple(group))
    return joined(option_form(form, "w-", (each,), run.given, SetValue, scales_of(each.key, units)) for each in seen)


def _options(form: Form, of: str, kinds: Sequence[Field], given: dict[str, Any], sigma: str) -> Markup | None:
    """Return the options of a law or an inverse, with the units of singular values for this arm."""
    texts = {"sigma": sigma or "1", "sigma²": f"{sigma}²" if sigma else "1", "1/sigma²": f"{sigma}⁻²" if sigma else "1"}
    shown = [replace(each, unit=texts.get(each.unit, each.unit)) for each in kinds]
    return _group(option_form(form, f"{of}-", shown, given, partial(SetOption, of)))


def _gains(kinds: Sequence[Field], arm: Arm) -> list[Field]:
    """Return the options of a law without gains for errors that the arm's task does not have."""
    without = {"Kp"} if not arm.task.position else {"Ko"} if arm.task.rotation == "none" else set()
    return [each for each in kinds if each.key not in without]


def _joints(
    form: Form,
    state: State,
    cell: str,
    values: Sequence[float],
    command: Callable[[tuple[float, ...]], Command],
    title: str,
    more: Markup | None = None,
) -> Markup:
    """Return a field for each joint; the command gets the values of all."""
    units, arm = units_of(state), state[Joints].arm

    def field(i: int, revolute: bool, label: str) -> Markup:
        def typed(text: str) -> Command:
            value = units.read(text, revolute, f"{cell} of joint {i + 1}")
            return command((*values[:i], value, *values[i + 1 :]))

        return form.field(f"{cell} {i}", trimmed(values[i] / units.factor(revolute), 2), label, typed)

    cells = []
    for i in range(len(values)):
        revolute = bool(arm.revolute[i])
        name, unit = units.variable(i, revolute), units.unit(revolute)
        typed = field(i, revolute, f"{title} of {name} in {unit}")
        cells.append(tag("label", tag("span", name), typed, tag("i", unit)))
    copies = tag("span.copies", more) if more else None
    return tag("div.ct-joints", tag("b", title), copies, tag("div.kit-numbers", cells))


def _target(form: Form, state: State, units: Units) -> Markup:
    place = ", ".join(units.text(float(value), False) for value in state[Control].target[:3, 3])
    hint = "Use the target of the lab; dragging it updates this one as well"
    take = form.button("aim", "Use the lab's target", AimAt(), "chip", hint)
    return tag("div.bar", tag("span", f"Target ({place}) {units.length_unit}"), take)


@cache
def sigma_unit(arm: Arm) -> str:
    """Return the unit of the singular values of an arm's scaled task Jacobian, ``"m"`` or none."""
    return ScaledTask(arm).sigma_unit
