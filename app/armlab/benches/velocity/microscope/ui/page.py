"""The singularity microscope: one velocity of the tool, answered by five methods, beside or at a singularity."""

from __future__ import annotations

import numpy as np

from armlab.benches.velocity.microscope.examples import EXAMPLES, ChooseMicroscopeExample
from armlab.benches.velocity.microscope.look import Look
from armlab.benches.velocity.microscope.state import (
    DAMPING,
    AimAlong,
    AimVelocity,
    BringNear,
    Microscope,
    SetComponent,
    SetDamping,
    SetDistance,
    SetSpeed,
    WatchMethod,
    known_places,
    looked,
    near,
)
from armlab.benches.velocity.microscope.ui.bars import bars
from armlab.benches.velocity.microscope.ui.words import (
    components,
    condition_card,
    damping_unit,
    scales_words,
    sigma_bars,
    table,
)
from armlab.content.arithmetic import evaluate
from armlab.errors import InputError
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples_markup
from armlab.ui.fields import Fields
from armlab.ui.format import escaped, readable
from armlab.ui.markup import chip
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.tried import tried
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

AIMS = {
    "aim lost": ("lost direction", "The direction in which the tool is slowest; drawn dashed"),
    "aim across": ("across it", "The direction in which the tool is fastest"),
}


SCALED = "1/s, scaled"
"""Unit of a size in which lengths are divided by the arm's."""

LONGEST_INDEX = 3
"""Digits of a place in a list; more are none of a page of ours."""

AROUND = 0.6
"""Length of an arrow at the tool that belongs in the picture, in length scales."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make example, places, velocity, verdict, bars, table and damping."""
    present, units = state, units_of(state)

    def typed(fields: Fields, cell: str, text: str) -> None:
        if not tried(fields, cell, text, lambda: commands(present, cell, text, units), present, post):
            show(present)

    head = gui.fields(lambda cell, text: typed(head, cell, text))
    verdict = gui.html()
    wish = gui.fields(lambda cell, text: typed(wish, cell, text))
    drawn = gui.html()
    methods = gui.fields(lambda cell, text: typed(methods, cell, text))
    damping = gui.fields(lambda cell, text: typed(damping, cell, text))
    values = gui.html()

    def show(state: State) -> None:
        nonlocal present
        present = state
        look = state.derived(looked)
        head.show(_head(head, state, units))
        verdict.show(condition_card(look, state.derived(near), units))
        wish.show(_wish(wish, look, units))
        drawn.show(f"<h3>Joint speeds, each method</h3>{bars(look, units)}")
        methods.show(table(look, methods.channel_id, units))
        damping.show(_damping(damping, look))
        said = scales_words(look)
        note = f'<p class="dim">{escaped(said)}</p>' if said else ""
        values.show(f"<h3>Singular values and directions</h3>{sigma_bars(look)}{note}")

    return show


def _head(fields: Fields, state: State, units: Units) -> str:
    """Return examples, and where the arm can be brought."""
    arm, part = state[Joints].arm, state[Microscope]
    examples = examples_markup(fields.channel_id, EXAMPLES, part.example)
    chips = []
    for i, place in enumerate(known_places(state)):
        j, revolute = place.pose.place, bool(arm.revolute[place.pose.place])
        value = float(place.pose.q[j])
        at = units.angle(value) if revolute else units.length(value)
        text = f"{place.name}: {units.variable(j, revolute)} = {at}"
        chips.append(chip(fields.channel_id, f"place {i}", text, place.says))
    found = "".join(chips) or '<span class="dim">No joint meets one from the home pose.</span>'
    away = fields.field("distance", readable(part.distance / units.factor(True), 2), "Distance from the singularity")
    hint = "Of a joint that slides, as many length scales as these are radians"
    label = f'<label class="option" title="{hint}"><span>at a distance of</span>{away}<i>{units.angle_unit}</i></label>'
    return f'{examples}<h3>Bring the arm near a singularity</h3><div class="bar">{found}</div>{label}'


def _wish(fields: Fields, look: Look, units: Units) -> str:
    """Return the choice of the direction, the components and the speed."""
    part, channel = look.part, fields.channel_id
    chosen = f"aim {part.aim}"
    aims = "".join(chip(channel, key, text, hint, key == chosen) for key, (text, hint) in AIMS.items())
    names = components(part.arm.task)
    natural = look.natural(look.wish).tolist()
    axes, typed = [], []
    for i, ((name, turns), value) in enumerate(zip(names, natural, strict=True)):
        axes.append(chip(channel, f"along {i}", _symbol(name), "A velocity of this component alone"))
        field = fields.field(f"v {i}", units.entry(value, turns), name)
        typed.append(f'<label class="option"><span>{_lowered(name)}</span>{field}<i>{units.unit(turns)}/s</i></label>')
    size = fields.field("speed", readable(part.speed, 4), "Size of the velocity")
    title = f"Size of the velocity. {scales_words(look)}".strip()
    return (
        f'<h3>Wanted velocity of the tool</h3><div class="bar">{aims}{"".join(axes)}</div><div class="options ms-wish">'
        f'<label class="option" title="{escaped(title)}"><span>size</span>{size}<i>{_speed_unit(look)}</i></label>'
        f"{''.join(typed)}</div>"
    )


def _symbol(name: str) -> str:
    return name.replace("_", "") if "about" not in name else name.replace("_E", "").replace("ω about ", "ω")


def _lowered(name: str) -> str:
    base, _, index = name.rpartition("_")
    return f"{base}<sub>{index}</sub>" if base else escaped(name)


def _speed_unit(look: Look) -> str:
    """Return the unit of a size: m/s, rad/s, or a scaled one where both meet."""
    task = look.part.arm.task
    if task.position and task.rotation != "none":
        return SCALED
    if not task.position:
        return "rad/s"
    return "m/s" if look.task.length == 1.0 else SCALED


def _damping(fields: Fields, look: Look) -> str:
    """Return the options of the damped methods."""
    values = dict(look.part.damping)
    typed = "".join(
        f'<label class="option" title="{escaped(field.title)}"><span>{_lowered(field.symbol)}</span>'
        f"{fields.field(f'd {key}', readable(values[key], 4), field.title)}"
        f"<i>{damping_unit(look, field.unit)}</i></label>"
        for key, (_, field) in DAMPING.items()
    )
    used = next(answer.step.damping for answer in look.answers if answer.key == "dls_variable")
    squared = damping_unit(look, "sigma²")
    here = f"λ(σ) is {readable(used, 4)}{f' {squared}' if squared else ''} here"
    return f'<div class="options ms-damping">{typed}<span class="dim">{here}</span></div>'


def commands(state: State, cell: str, text: str, units: Units) -> tuple[Command, ...]:
    """Return what a person asked for.

    Raises
    ------
    InputError
        Not a number; the text names the field.
    """
    if cell == "example":
        return (ChooseMicroscopeExample(text),) if text else ()
    if cell == "speed":
        return (SetSpeed(_number("size", text)),)
    if cell == "distance":
        return (SetDistance(units.read(text, True, "distance")),)
    what, _, rest = cell.partition(" ")
    if what == "aim":
        return (AimVelocity(rest),)
    if what == "watch":
        return (WatchMethod(rest),)
    if what == "d":
        symbol = DAMPING[rest][1].symbol if rest in DAMPING else rest
        return (SetDamping(rest, _number(symbol, text)),)
    if not (rest.isdecimal() and len(rest) <= LONGEST_INDEX):
        return ()
    if what == "place":
        return (BringNear(int(rest)),)
    if what == "along":
        return (AimAlong(int(rest)),)
    names = components(state[Joints].arm.task)
    if what == "v" and int(rest) < len(names):
        name, turns = names[int(rest)]
        return (SetComponent(int(rest), units.read(text, turns, name)),)
    return ()


def _number(where: str, text: str) -> float:
    try:
        return evaluate(text.strip().replace("−", "-").replace(",", "."))
    except InputError:
        raise InputError(f"{where}: expected a number, got {text.strip()[:40]!r}") from None


def _around(state: State) -> Points:
    """Return the ends of what is drawn at the tool."""
    look = state.derived(looked)
    twist = look.twist(look.wish / np.linalg.norm(look.wish))
    size = AROUND * look.part.arm.length_scale
    at = np.asarray(state[Joints].tool_pose[:3, 3], dtype=np.float64)
    return np.array([at, at + size * twist[:3], at + size * twist[3:]])


PANEL = Panel((Microscope, Joints), build, see_through=True, around=_around)
