"""The singularity microscope: one velocity of the tool, answered by five methods, beside or at a singularity."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from armlab.benches.velocity.microscope.commands import AimAlong, BringNear, SetComponent, SetDamping, SetSpeed
from armlab.benches.velocity.microscope.examples import EXAMPLES, ChooseMicroscopeExample
from armlab.benches.velocity.microscope.look import Look
from armlab.benches.velocity.microscope.looked import known_places, looked, near
from armlab.benches.velocity.microscope.state import DAMPING, Microscope
from armlab.benches.velocity.microscope.ui.bars import bars
from armlab.benches.velocity.microscope.ui.words import (
    components,
    condition_card,
    damping_unit,
    scales_words,
    sigma_bars,
    table,
)
from armlab.kin.field import Field
from armlab.session.fields import Set, fields_of
from armlab.session.parts.joints import Joints
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import readable, subscript
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import fold
from armlab.ui.option_text import option_value
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.symbols import with_indices
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

AIMS = {
    "lost": ("lost direction", "The direction in which the tool is slowest; drawn dashed"),
    "across": ("perpendicular", "The direction in which the tool is fastest"),
}

ALONE = "A velocity of this component alone"

SCALED = "1/s, scaled"
"""Unit of a size in which lengths are divided by the length scale of the arm."""

AROUND = 0.8
"""Length of an arrow at the tool with its label, which must be inside the picture, in length scales."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the example, places, velocity, verdict, bars, table and damping."""
    units = units_of(state)
    head, verdict, wish, drawn = gui.form(post), gui.html(), gui.form(post), gui.html()
    methods, damping, values = gui.form(post), gui.form(post), gui.html()

    def show(state: State) -> None:
        look = state.derived(looked)
        head.show(head_markup(head, state, units))
        verdict.show(condition_card(look, state.derived(near), units))
        wish.show(wish_markup(wish, look, units))
        drawn.show(tag("h3", "Joint speeds, each method"), bars(look, units))
        methods.show(table(look, methods, units))
        damping.show(damping_markup(damping, look))
        said = scales_words(look)
        note = tag("p.dim", said) if said else None
        values.show((fold("Singular values and directions", sigma_bars(look), note), drawn_markup(look)))

    return show


def head_markup(form: Form, state: State, units: Units) -> Markup:
    """Return the examples, and the singularities to which the arm can be brought."""
    arm, part = state[Joints].arm, state[Microscope]
    chooser = examples(form, EXAMPLES, part.example, ChooseMicroscopeExample)
    chips = []
    for i, place in enumerate(known_places(state)):
        j, revolute = place.pose.place, bool(arm.revolute[place.pose.place])
        value = float(place.pose.q[j])
        at = units.angle(value) if revolute else units.length(value)
        text = f"{place.name}: {units.variable(j, revolute)} = {at}"
        chips.append(form.chip(f"place {i}", text, BringNear(i), place.says))
    found = chips or tag("span.dim", "No joint meets one when it moves by itself from the home pose.")
    away = form.field(
        "distance",
        readable(part.distance / units.factor(True), 2),
        "Distance from the singularity",
        lambda text: Set(Microscope, "distance", units.read(text, True, "distance")),
    )
    hint = "Of a joint that slides, as many length scales as these are radians"
    distance = _option("at a distance of", away, units.angle_unit, hint)
    return joined(chooser, tag("h3", "Bring the arm near a singularity"), tag("div.bar", found), distance)


def _option(name: Inside, field: Markup, unit: str, hint: str | None = None) -> Markup:
    return tag("label.option", tag("span", name), field, tag("i", unit), title=hint)


def wish_markup(form: Form, look: Look, units: Units) -> Markup:
    """Return the choice of the direction, the components and the speed."""
    part = look.part
    aims = [
        form.chip(f"aim {aim}", text, Set(Microscope, "aim", aim), hint, aim == part.aim)
        for aim, (text, hint) in AIMS.items()
    ]
    names = components(part.arm.task)
    natural = look.natural(look.wish).tolist()
    axes, typed = [], []
    for i, ((name, turns), value) in enumerate(zip(names, natural, strict=True)):
        axes.append(form.button(f"along {i}", with_indices(_symbol(name)), AimAlong(i), "chip", ALONE))
        field = form.field(f"v {i}", units.entry(value, turns), name, partial(_component, i, name, turns, units))
        typed.append(_option(with_indices(name), field, f"{units.unit(turns)}/s"))
    size = form.field("speed", readable(part.size, 4), "Size of the velocity", partial(_sized, speed_unit(look)))
    title = f"Size of the velocity. {scales_words(look)}".strip()
    amount = _option("size", size, speed_unit(look), title)
    heading, choice = tag("h3", "Wanted velocity of the tool"), tag("div.bar", aims, axes, amount)
    return tag("div.ms-wish", heading, choice, tag("div.kit-twist", typed))


def _sized(unit: str, text: str) -> SetSpeed:
    kind = replace(fields_of(Microscope)["speed"], title="size", unit=unit.split(",")[0])
    return SetSpeed(option_value(kind, text, needed=True))


def _component(i: int, name: str, turns: bool, units: Units, text: str) -> SetComponent:
    return SetComponent(i, units.read(text, turns, name, "/s"))


def _symbol(name: str) -> str:
    return name.replace("_E", "").replace("ω about ", "ω_")


def speed_unit(look: Look) -> str:
    """Return the unit of a size: m/s, rad/s, or a scaled one if the task has both."""
    task = look.part.arm.task
    if task.position and task.rotation != "none":
        return SCALED
    if not task.position:
        return "rad/s"
    return "m/s" if look.task.length == 1.0 else SCALED


def drawn_markup(look: Look) -> Markup:
    """Return what the marks of the scene mean."""
    last = subscript("v", len(look.sigma))
    return fold(
        "What the scene shows",
        tag(
            "p.dim",
            "The wanted velocity is blue, and what the selected method reaches of it is green. The slowest direction "
            f"is dashed. The arcs at the joints are {last}, the unit vector of joint speeds that moves the tool least.",
        ),
    )


def damping_markup(form: Form, look: Look) -> Markup:
    """Return the options of the damped methods."""
    values = dict(look.part.damping)

    def option(key: str, kind: Field) -> Markup:
        unit = damping_unit(look, kind.unit)
        needed = replace(kind, unit=unit or "1")
        typed = form.field(
            f"d {key}",
            readable(values[key], 4),
            kind.title,
            lambda text: SetDamping(key, option_value(needed, text, needed=True)),
        )
        return _option(with_indices(kind.symbol), typed, unit, kind.title)

    typed = [option(key, kind) for key, (_, kind) in DAMPING.items()]
    used = next(answer.step.damping for answer in look.answers if answer.key == "dls_variable")
    squared = damping_unit(look, "sigma²")
    here = f"λ(σ) is {readable(used, 4)}{f' {squared}' if squared else ''} here"
    return tag("div.options.ms-damping", typed, tag("span.dim", here))


def _around(state: State) -> Points:
    """Return the ends of the arrow at the tool."""
    look = state.derived(looked)
    twist = look.twist(look.wish / np.linalg.norm(look.wish))
    size = AROUND * look.part.arm.length_scale
    at = np.asarray(state[Joints].tool_pose[:3, 3], dtype=np.float64)
    return np.array([at, at + size * twist[:3], at + size * twist[3:]])


PANEL = Panel((Microscope, Joints), build, see_through=True, around=_around)
