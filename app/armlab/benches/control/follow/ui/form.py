"""The form of a run of kinematic control: what to follow, from where, by which law, on which plant."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from typing import Any

from armlab.benches.control.follow.chosen import CLOCK, FIELDS, KNOWLEDGE, MOTORS, NULL, REFERENCES, WAY, Setup
from armlab.benches.control.follow.state import Control
from armlab.errors import UnknownName
from armlab.kin.arm import Arm
from armlab.kin.control.control_law import control_laws
from armlab.kin.control.rate_inverse import rate_inverses
from armlab.kin.control.scaled_task import ScaledTask
from armlab.kin.field import Field
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.fields import Fields
from armlab.ui.format import mathml, trimmed
from armlab.ui.markup import button, options, select
from armlab.ui.option_form import PLAIN, Scale, option_markup, option_value
from armlab.ui.units import Units, units_of

PERCENT = (Scale("%", 0.01),)


def scales_of(key: str, units: Units) -> Sequence[Scale]:
    """Return what stands on screen for the unit ``q`` of a value of a run."""
    if key in ("speed", "radius", "slide_limit"):
        return (Scale(units.length_unit, units.factor(False)),)
    if key == "limit":
        return (Scale(units.angle_unit, units.factor(True)),)
    return PERCENT if key == "wrong" else PLAIN


def value_of(state: State, key: str, text: str) -> Any:
    """Return what a person typed for a value of the selected run."""
    now = getattr(state[Control].run, key)
    return option_value(FIELDS[key], text, now, scales_of(key, units_of(state)))


def option_of(state: State, of: str, key: str, text: str) -> Any:
    """Return what a person typed for an option of the law or the inverse of the selected run."""
    run = state[Control].run
    owner = run.kind if of == "law" else run.method
    field = next((each for each in owner.fields if each.key == key), None)
    if field is None:
        raise UnknownName(f"option of the {of}", key, [each.key for each in owner.fields])
    return option_value(field, text)


def reference_markup(fields: Fields, state: State) -> str:
    """Return what is followed, and from where."""
    run, units, channel = state[Control].run, units_of(state), fields.channel_id
    chooser = select(channel, "ref", "Reference", options(REFERENCES, run.reference), "What the tool is to follow")
    level = "z" not in state[Joints].arm.task.position
    way = _values(fields, run, [each for each in WAY if not (level and each.key == "elevation")], units)
    return (
        f'<h3>Reference</h3><div class="kit-head">{chooser}</div>'
        + (f'<div class="options">{way}</div>' if way else "")
        + (_target(channel, state, units) if run.reference == "target" else "")
        + (_joints(fields, state, "start", run.start, "Start", _here(channel)) if run.reference != "planned" else "")
        + _joints(fields, state, "offset", run.offset, "Initial error", "")
    )


def law_markup(fields: Fields, state: State) -> str:
    """Return law and inverse with their formulas and options, and the self-motion of a redundant arm."""
    run, arm, channel = state[Control].run, state[Joints].arm, fields.channel_id
    units = units_of(state)
    sigma = sigma_unit(arm)
    found = (
        "<h3>Control law</h3>"
        + f'<div class="kit-head">{select(channel, "law", "Control law", _laws(run.law))}</div>'
        + f'<p class="ct-formula">{mathml(run.kind.formula)}</p>'
        + _options(fields, "law", _gains(run.kind.fields, arm), dict(run.law_options), sigma)
    )
    if run.kind.inverts:
        found += (
            f'<div class="kit-head">{select(channel, "inverse", "Inverse of J", _inverses(run.inverse))}</div>'
            + f'<p class="ct-formula">{mathml(run.method.formula)}</p>'
            + _options(fields, "inverse", run.method.fields, dict(run.inverse_options), sigma)
        )
        if arm.n > arm.task.m:
            found += f'<div class="options">{_values(fields, run, NULL, units)}</div>'
    return found


def plant_markup(fields: Fields, state: State) -> str:
    """Return what is not ideal about the arm."""
    run, units, arm = state[Control].run, units_of(state), state[Joints].arm
    motors = tuple(
        each for each in MOTORS if each.key == "saturation" or bool((arm.revolute == (each.key == "limit")).any())
    )
    encoder = KNOWLEDGE if run.counts else tuple(each for each in KNOWLEDGE if each.key not in ("shaft", "ratio"))
    return "".join(
        f'<div class="options">{_values(fields, run, group, units)}</div>' for group in (motors, CLOCK, encoder)
    )


def plant_words(run: Setup) -> str:
    """Return in a few words what is not ideal."""
    found = []
    if run.saturation != "none":
        found.append("speeds limited")
    if run.sampling:
        exact = math.isclose(run.held, run.sampling, rel_tol=1e-6)
        steps = "" if exact else f", whole steps of {trimmed(1000.0 * run.step, 3)} ms"
        found.append(f"T_s = {trimmed(1000.0 * run.held, 3)} ms{steps}")
    if run.counts:
        found.append(f"encoder on the {run.shaft}")
    if run.wrong:
        found.append(f"{'all links' if not run.link else f'link {run.link}'} {trimmed(100.0 * run.wrong, 3)} % wrong")
    return ", ".join(found) or "ideal"


def _values(fields: Fields, run: Setup, group: Sequence[Field], units: Units) -> str:
    """Return the fields of a group that can be used, each in its own unit."""
    seen = run.seen(tuple(group))
    return "".join(option_markup(fields, "w-", (each,), run.given, scales_of(each.key, units)) for each in seen)


def _options(fields: Fields, of: str, kinds: Sequence[Field], given: dict[str, Any], sigma: str) -> str:
    """Return the options of a law or an inverse, with the units of singular values as they are for this arm."""
    texts = {"sigma": sigma or "1", "sigma²": f"{sigma}²" if sigma else "1", "1/sigma²": f"{sigma}⁻²" if sigma else "1"}
    shown = [replace(each, unit=texts.get(each.unit, each.unit)) for each in kinds]
    markup = option_markup(fields, f"{of}-", shown, given)
    return f'<div class="options">{markup}</div>' if markup else ""


def _gains(kinds: Sequence[Field], arm: Arm) -> list[Field]:
    """Return the options of a law without gains of errors that the arm's task does not have."""
    without = {"Kp"} if not arm.task.position else {"Ko"} if arm.task.rotation == "none" else set()
    return [each for each in kinds if each.key not in without]


def _here(channel: str) -> str:
    return button(channel, "here", "Present pose", "chip", "Let the reference begin where the arm stands")


def _joints(fields: Fields, state: State, cell: str, values: Sequence[float], title: str, more: str) -> str:
    """Return a field for each joint."""
    units, arm = units_of(state), state[Joints].arm
    cells = []
    for i, value in enumerate(values):
        revolute = bool(arm.revolute[i])
        name, unit = units.variable(i, revolute), units.unit(revolute)
        typed = fields.field(f"{cell} {i}", trimmed(value / units.factor(revolute), 2), f"{title} of {name} in {unit}")
        cells.append(f"<label><span>{name}</span>{typed}<i>{unit}</i></label>")
    copies = f'<span class="copies">{more}</span>' if more else ""
    return f'<div class="ct-joints"><b>{title}</b>{copies}<div class="kit-numbers">{"".join(cells)}</div></div>'


def _target(channel: str, state: State, units: Units) -> str:
    place = ", ".join(units.text(float(value), False) for value in state[Control].target[:3, 3])
    take = button(
        channel, "aim", "From the handle", "chip", "Take the target of the lab; dragged, it is taken by itself"
    )
    return f'<div class="bar"><span>Target ({place}) {units.length_unit}</span>{take}</div>'


@cache
def _laws(chosen: str) -> str:
    return options({key: law.title for key, law in control_laws().items()}, chosen)


@cache
def _inverses(chosen: str) -> str:
    return options({key: method.title for key, method in rate_inverses().items()}, chosen)


@cache
def sigma_unit(arm: Arm) -> str:
    """Return the unit of the singular values of an arm's scaled task Jacobian, ``"m"`` or none."""
    return ScaledTask(arm).sigma_unit
