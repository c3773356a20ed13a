"""The reachable workspace: sampled, coloured, cut open, and clickable."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np

from armlab.benches.workspace.cloud.cuts import AXES, across, cut_of, place_of, range_of
from armlab.benches.workspace.cloud.examples import EXAMPLES, ChooseWorkspaceExample
from armlab.benches.workspace.cloud.files import as_csv, as_ply
from armlab.benches.workspace.cloud.samples import Sampled
from armlab.benches.workspace.cloud.state import (
    COUNTS,
    CUTS,
    DRAWINGS,
    AimAtSample,
    CancelWorkspace,
    ClearWorkspace,
    LookAtWorkspace,
    SampleWorkspace,
    Workspace,
    asks_for_boundary,
)
from armlab.benches.workspace.cloud.ui.words import chosen, counted, facts, scale
from armlab.benches.workspace.cloud.view import drawing, in_the_picture
from armlab.errors import InputError
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.measures import MEASURES
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.session import Refuse
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples
from armlab.ui.eye import Facing
from armlab.ui.file_names import file_name
from armlab.ui.form import Form
from armlab.ui.format import capitalised, readable
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import progress_bar, row
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Control, Gui

SAVES: dict[str, Callable[[Sampled], str | bytes]] = {"ply": as_ply, "csv": as_csv}

LONGEST_SEED = 18
"""Largest number of digits of a seed; the lab takes fewer and says so, and Python reads no number of thousands."""

SAVED = {
    "ply": "The points that are drawn at most, and the measure, for other programs",
    "csv": "The same with joint values, for a spreadsheet",
    "png": "The scene as it is seen now",
}

DRAW_HINT = "Points of samples, small cubes that hold samples, or the surface around them"
CUT_HINT = "Whole, without the half in front of the arm, or a slice across an axis of frame 0"


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choices, the progress, the scale of colours, the figures and the files."""
    present, units = state, units_of(state)

    def save(kind: str) -> None:
        found, name = present[Workspace].found, f"workspace_{file_name(present[RobotPart].robot.name)}.{kind}"
        if kind == "png":
            gui.save_picture(name, lambda why: post(Refuse(why)))
        elif found is not None:
            gui.save(name, SAVES[kind](found))

    def ways(index: int) -> AimAtSample:
        gui.open_panel("solutions")
        return AimAtSample(index)

    def moved(value: float) -> None:
        post(LookAtWorkspace(offset=value * units.factor(False)))

    choices = gui.form(post)
    slider = gui.slider("slice", 0.0, 1.0, 0.1, 0.0, moved, None)
    exact, switches, told = gui.form(post), gui.form(post), gui.form(post)

    def show(state: State) -> None:
        nonlocal present
        present = state
        choices.show(choices_markup(choices, state, units))
        slid = _slid(state)
        slider.visible(slid)
        exact.show(tag("div.over-slider", _place(exact, state, units)) if slid else None)
        if slid:
            _show_slider(slider, state, units)
        switches.show(row("Scene", _switches(switches, state[Workspace])))
        told.show(told_markup(told, state, units, save, ways))

    return show


def choices_markup(form: Form, state: State, units: Units) -> Inside:
    """Return the choices, and the button that samples or cancels."""
    part = state[Workspace]
    titles = {key: capitalised(measure.title) for key, measure in MEASURES.items()}
    counts = {str(count): counted(count) for count in COUNTS}
    seed = form.field("seed", str(part.seed), "Seed of the random numbers", _seed)
    seeded = tag("label.option", tag("span", "seed"), seed, title="The same seed gives the same points")
    measure = form.select("measure", "Colour", titles, part.measure, lambda key: LookAtWorkspace(measure=key))
    count = form.select("count", "Samples", counts, str(part.count), lambda key: LookAtWorkspace(count=int(key)))
    drawings = _offered(state, DRAWINGS, "surface")
    draw = form.chips("draw", drawings, drawing(state), DRAW_HINT, lambda key: LookAtWorkspace(draw=key))
    cut = form.chips("cut", _cuts(state), _cut(state), CUT_HINT, lambda key: LookAtWorkspace(cut=key))
    return (
        examples(form, EXAMPLES, part.example, ChooseWorkspaceExample),
        row("Colour", measure),
        row("Samples", (count, seeded)),
        _action(form, part),
        row("Show as", draw),
        row("Cut", cut),
        _slice(form, state, units) if _cut(state) in AXES and not _slid(state) else None,
    )


def _seed(text: str) -> LookAtWorkspace:
    if not text.strip().isdecimal() or len(text.strip()) > LONGEST_SEED:
        raise InputError(f"seed: expected a whole number, got {text.strip()[:40]!r}")
    return LookAtWorkspace(seed=int(text))


def _offered(state: State, texts: Mapping[str, str], spatial: str) -> dict[str, str]:
    """Return the choices without the one that has no meaning if the tool stays in a plane."""
    planar = first_joint(state[Joints].arm).planar
    return {key: text for key, text in texts.items() if not (planar and key == spatial)}


def _cuts(state: State) -> dict[str, str]:
    """Return the cuts that can be used: a surface has no slices."""
    offered = _offered(state, CUTS, "front")
    return {key: text for key, text in offered.items() if drawing(state) != "surface" or key not in AXES}


def _cut(state: State) -> str:
    """Return the cut that is shown; before there are points that decide nothing is cut."""
    cut = cut_of(state[Workspace])
    return cut if cut in _cuts(state) else "none"


def _switches(form: Form, part: Workspace) -> Inside:
    edge, clicks = LookAtWorkspace(edge=not part.edge), LookAtWorkspace(clicks=not part.clicks)
    near = form.chip("edge", "Near the boundary", edge, "Only points near the boundary of the workspace", part.edge)
    return near, form.chip("clicks", "Click: go there", clicks, "A click on a point moves the arm there", part.clicks)


def _slid(state: State) -> bool:
    """Return whether there is a slice and a cloud, along which a slider moves it."""
    return _cut(state) in AXES and state[Workspace].found is not None


def _slice(form: Form, state: State, units: Units) -> Markup:
    """Return the place of a slice before there is a cloud."""
    at = tag("label.option", _place(form, state, units), tag("i", units.length_unit))
    return row(f"{_cut(state)} =", at)


def _place(form: Form, state: State, units: Units) -> Markup:
    part = state[Workspace]
    name = f"place of the slice, {_cut(state)}"

    def typed(text: str) -> LookAtWorkspace:
        return LookAtWorkspace(offset=units.read(text, False, name))

    return form.field("offset", readable(place_of(part) / units.factor(False), 1), capitalised(name), typed)


def _show_slider(slider: Control, state: State, units: Units) -> None:
    """Show the place of a slice on a slider as long as the cloud."""
    part, cut = state[Workspace], _cut(state)
    low, high = (units.value(end, False) for end in range_of(part))
    step = 10.0 ** -units.decimals(False)
    place = units.value(place_of(part), False)
    slider.span(f"{cut} {units.length_unit}", min(low, place), max(high, place, low + step), step)
    slider.show(place)


def _action(form: Form, part: Workspace) -> Inside:
    if part.asked is not None:
        found = part.found
        done = found.part if found is not None and found.question == part.asked else 0.0
        press = form.chip("cancel", "Cancel", CancelWorkspace(), "Stop and keep what has been found")
        return tag("div.bar", press, tag("span.dim", f"Sampling: {100.0 * done:.0f} %")), progress_bar(done)
    sample = form.button("sample", "Sample", SampleWorkspace(), "main")
    clear = form.chip("clear", "Clear", ClearWorkspace(), "Remove the workspace") if part.found is not None else None
    return tag("div.bar", sample, clear)


def told_markup(
    form: Form, state: State, units: Units, save: Callable[[str], None], ways: Callable[[int], Command]
) -> Inside:
    """Return the results and the buttons for them: ``save`` gets the kind of file, ``ways`` a sample."""
    part = state[Workspace]
    found = part.found
    if found is None:
        about = (
            "Press Sample. The lab draws random configurations within the joint limits and marks where the tool is in "
            "each: the reachable workspace "
        )
        return tag("p.dim", about, "WS", tag("sub", "1"), "⟦ (4.17)⟧.")
    saves = [form.chip(kind, f"Save {kind.upper()}", partial(save, kind), hint) for kind, hint in SAVED.items()]
    coloured = None if drawing(state) == "surface" and part.section is not None else scale(found)
    waits = asks_for_boundary(part, state[Joints].arm)
    wait = tag("p.dim", "The boundary is being found …") if waits else None
    there = chosen(form, state, units, ways)
    return wait, coloured, there, facts(state, found, units), tag("div.bar", saves)


def _faces(state: State) -> Facing | None:
    """Return the plane of a slice."""
    part, cut = state[Workspace], _cut(state)
    if part.found is None or cut not in AXES:
        return None
    right, up = across(state[Joints].arm.base, AXES.index(cut))
    return Facing(np.cross(right, up), up, cut)


def _looks(state: State) -> tuple[object, ...]:
    """Return all that decides what is drawn, but for the place of a slice, which a hand moves."""
    part, found = state[Workspace], state[Workspace].found
    known = (False, False) if found is None else (True, found.finished)
    return *known, drawing(state), _cut(state), part.edge, part.section is None


PANEL = Panel(
    (Workspace, Joints), build, rebuilds=(RobotPart, Notation), around=in_the_picture, faces=_faces, looks=_looks
)
