"""The view of a train: its wheels, its ratio, and what goes in and comes out."""

from __future__ import annotations

from fractions import Fraction
from functools import partial

from armlab.benches.drive.gears.film import slowed
from armlab.benches.drive.gears.stage import stage_of
from armlab.benches.drive.gears.state import AddWheel, ArrangeWheels, Gears, RemoveWheel, SetTeeth
from armlab.benches.drive.gears.ui.scene import drawn_places
from armlab.benches.drive.gears.ui.typed import typed_length, whole_field
from armlab.benches.drive.power.ui.typed import typed
from armlab.benches.drive.quantities import prefixed, rpm
from armlab.kin.drive.tooth import FEWEST, MOST, undercut
from armlab.kin.drive.train import FEWEST as FEWEST_WHEELS
from armlab.kin.drive.train import LAYOUTS
from armlab.kin.drive.train import MOST as MOST_WHEELS
from armlab.kin.field import Field
from armlab.session.amounts import amount
from armlab.session.state import State
from armlab.ui.colours import css, joint_colour
from armlab.ui.form import Form
from armlab.ui.format import dot, mathml, subscript
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import row, verdict_box
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units


def train_markup(form: Form, state: State, units: Units) -> Inside:
    """Return the fields and results of the train."""
    part = state[Gears]
    return (
        _wheels(form, part, units),
        _arrangement(form, part, units),
        _ratio(part),
        _sides(form, part),
        _notes(state, part),
    )


def _wheels(form: Form, part: Gears, units: Units) -> Markup:
    turns, modules = part.train.turns.tolist(), part.train.modules(part.distances).tolist()
    rows = []
    for k, teeth in enumerate(part.teeth):
        kind = Field("teeth", subscript("z", k + 1), f"teeth of wheel {k + 1}", "whole", low=FEWEST, high=MOST)
        across = units.entry(teeth * modules[k], False)
        name = tag("span", dot(css(joint_colour(k))), f"wheel {k + 1}")
        cell = whole_field(form, f"teeth {k}", kind, teeth, partial(SetTeeth, k))
        rows.append(line(cell, across, _turns(part, k), rpm(part.speed * turns[k]), name=name))
    head = head_line(None, "teeth z", f"⌀, {units.length_unit}", "turns", "speed")
    return tag("table.kit-points.gr-wheels", head, rows)


def _turns(part: Gears, k: int) -> str:
    """Return the turns of a wheel for one turn of the first as a fraction."""
    turns = Fraction(1)
    meshes = set(part.train.meshes)
    for j in range(1, k + 1):
        if (j - 1, j) in meshes:
            turns *= Fraction(-part.teeth[j - 1], part.teeth[j])
    return str(turns).replace("-", "−")


def _arrangement(form: Form, part: Gears, units: Units) -> Markup:
    count = len(part.teeth)
    stages = part.layout == "compound"
    layouts = form.chips("layout", LAYOUTS, part.layout, "Arrangement of the wheels", ArrangeWheels)
    add = form.chip("add", "+", AddWheel(), "Add a wheel at the end", off=count >= MOST_WHEELS)
    remove = form.chip("remove", "−", RemoveWheel(), "Remove the last wheel", off=count <= FEWEST_WHEELS)
    modules = part.train.modules(part.distances)
    second = typed_length(form, part, "second", units) if stages else None
    said = " and ".join(
        units.constant(float(each), False, 2) for each in ([modules[0], modules[2]] if stages else modules[:1])
    )
    distance = tag(
        "div.options",
        typed_length(form, part, "distance", units),
        second,
        tag("span.dim.gr-module", mathml(r"m=2a/(z_i+z_j)"), f" = {said}"),
    )
    return tag("div", row("Wheels", (layouts, add, remove)), distance)


def _ratio(part: Gears) -> Markup:
    train = part.train
    sense = "the load turns as the motor does" if train.ratio > 0.0 else "the load turns against the motor"
    if part.layout == "compound":
        made = r"n=\frac{z_2}{z_1}\cdot\frac{z_4}{z_3}"
    else:
        made = rf"|n|=\frac{{z_{len(part.teeth)}}}{{z_1}}"
    idle = train.idlers
    idlers = ""
    if idle:
        names = " and ".join(str(k + 1) for k in idle)
        idlers = (
            f" Wheel{'s' if len(idle) > 1 else ''} {names} only turn{'' if len(idle) > 1 else 's'} the sense round."
        )
    said = tag("p.gr-small", mathml(made), f": {sense}.{idlers}")
    return verdict_box("ok", f"n = {amount(train.ratio)}", said, sign="")


def _sides(form: Form, part: Gears) -> Markup:
    """Return what goes in and what comes out, after the fields of the motor."""
    found = part.transfer
    meshes = len(part.train.meshes)
    fields = tag("div.options.gr-motor", [typed(form, part, name) for name in ("speed", "torque", "efficiency")])
    rows = [
        line(
            amount(found.motor_speed, "rad/s"),
            amount(found.load_speed, "rad/s"),
            mathml(r"\dot\theta_m=n\,\dot\theta_u"),
            name="speed",
        ),
        line(
            prefixed(found.motor_torque, "N m"),
            prefixed(found.load_torque, "N m"),
            mathml(r"\tau_u=\eta\,n\,\tau_m" if found.motor_power >= 0.0 else r"\tau_u=n\,\tau_m/\eta"),
            name="torque",
        ),
        line(
            prefixed(found.motor_power, "W"),
            prefixed(found.load_power, "W"),
            (mathml("P_d"), f" = {prefixed(found.lost, 'W')}"),
            name="power",
        ),
    ]
    whole = (
        f"{meshes} mesh{'es' if meshes > 1 else ''}: η = {amount(100.0 * part.whole_efficiency)} %."
        "⟦ (2.35) and (2.33) are those of a gear without losses.⟧"
    )
    if found.motor_power < 0.0:
        whole += " The load drives the motor, which brakes: what is lost comes out of the load's power."
    return tag(
        "div",
        tag("h3", "Motor and load"),
        fields,
        tag("table.kit-points.gr-sides", head_line(None, "motor", "load", None), rows),
        tag("p.dim", whole),
    )


def _film(part: Gears) -> str:
    """Return how fast the film is beside the motor."""
    slow = slowed(part)
    if slow == 0.0:
        return "the motor stands still"
    way, times = ("slowed down", slow) if slow >= 1.0 else ("sped up", 1.0 / slow)
    return f"{way} {amount(float(f'{times:.2g}'))} times"


def _notes(state: State, part: Gears) -> Markup:
    """Return the scale of the picture, and which wheels are undercut."""
    _, _, scale = drawn_places(part, stage_of(state).radius)
    few = [str(k + 1) for k, teeth in enumerate(part.teeth) if undercut(teeth)]
    said = f"Drawn {amount(float(f'{scale:.2g}'))} times as large, and {_film(part)}."
    if few:
        said += f" Wheel{'s' if len(few) > 1 else ''} {', '.join(few)}: undercut, with fewer than 17.1 teeth."
    return tag("p.dim", said)
