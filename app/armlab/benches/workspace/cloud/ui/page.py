"""The reachable workspace: sampled, coloured, cut open, and answering at a click."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

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
    GoToSample,
    LookAtWorkspace,
    SampleWorkspace,
    Workspace,
    asks_for_boundary,
)
from armlab.benches.workspace.cloud.ui.words import chosen, counted, facts, scale
from armlab.benches.workspace.cloud.view import AXES, drawing
from armlab.errors import InputError
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.measures import MEASURES
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.session import Refuse
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples_markup
from armlab.ui.fields import Fields
from armlab.ui.file_names import file_name
from armlab.ui.format import capitalised, readable
from armlab.ui.markup import button, chip, chips, options, row, select
from armlab.ui.plugin import NOTHING, Panel, Points, Show
from armlab.ui.tried import tried
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

SAVES: dict[str, Callable[[Sampled], str | bytes]] = {"ply": as_ply, "csv": as_csv}

LONGEST_SEED = 18
"""Digits; the lab takes fewer and says how large a seed may be, and Python reads no number of thousands."""

SAVED = {
    "ply": "The points that are drawn at most, and the measure, for other programs",
    "csv": "The same with joint values, for a spreadsheet",
    "png": "The scene as it is seen now",
}

DRAW_HINT = "Points of samples, small cubes that hold samples, or the surface around them"
CUT_HINT = "Whole, without the half in front of the arm, or a slice across an axis of frame 0"


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make choices, progress, scale of colours, figures and files."""
    present, units = state, units_of(state)

    def typed(fields: Fields, cell: str, text: str) -> None:
        found, name = present[Workspace].found, f"workspace_{file_name(present[RobotPart].robot.name)}.{cell}"
        if cell in SAVES and found is not None:
            gui.save(name, SAVES[cell](found))
            return
        if cell == "png":
            gui.save_picture(name, lambda why: post(Refuse(why)))
            return
        if tried(fields, cell, text, lambda: commands(present, cell, text, units), present, post):
            if cell == "ways":
                gui.open_panel("solutions")
        else:
            show(present)

    drawn = False
    choices = gui.fields(lambda cell, text: typed(choices, cell, text))
    told = gui.fields(lambda cell, text: typed(told, cell, text))

    def show(state: State) -> None:
        nonlocal present, drawn
        present, appeared = state, not drawn and state[Workspace].found is not None
        drawn = state[Workspace].found is not None
        if appeared:
            gui.camera.keep_in_view()
        choices.show(_choices(choices, state, units))
        told.show(_told(told.channel_id, state, units))

    return show


def _choices(fields: Fields, state: State, units: Units) -> str:
    """Return what can be chosen, and the button that samples or cancels."""
    part, channel = state[Workspace], fields.channel_id
    titles = {key: capitalised(measure.title) for key, measure in MEASURES.items()}
    counts = {f"count {count}": counted(count) for count in COUNTS}
    seed = fields.field("seed", str(part.seed), "Seed of the random numbers")
    seeded = f'<label class="option" title="The same seed gives the same points"><span>seed</span>{seed}</label>'
    return (
        examples_markup(channel, EXAMPLES, part.example)
        + row("Colour", select(channel, "measure", "Colour", options(titles, part.measure)))
        + row("Samples", select(channel, "count", "Samples", options(counts, f"count {part.count}")) + seeded)
        + _action(channel, part)
        + row("Show as", _chips(channel, "draw", _offered(state, DRAWINGS, "surface"), drawing(state), DRAW_HINT))
        + row("Cut", _chips(channel, "cut", _cuts(state), _cut(state), CUT_HINT))
        + (_slice(fields, part, units) if _cut(state) in AXES else "")
        + row("Scene", _switches(channel, part))
    )


def _offered(state: State, texts: Mapping[str, str], spatial: str) -> dict[str, str]:
    """Return the choices without the one that means nothing where the tool stays in a plane."""
    planar = first_joint(state[Joints].arm).planar
    return {key: text for key, text in texts.items() if not (planar and key == spatial)}


def _cuts(state: State) -> dict[str, str]:
    """Return the cuts that mean something: a surface has no slices."""
    offered = _offered(state, CUTS, "front")
    return {key: text for key, text in offered.items() if drawing(state) != "surface" or key not in AXES}


def _cut(state: State) -> str:
    """Return the cut that is seen."""
    cut = state[Workspace].cut
    return cut if cut in _cuts(state) else "none"


def _chips(channel: str, cell: str, texts: Mapping[str, str], chosen: str, hint: str) -> str:
    return chips(channel, {f"{cell} {key}": text for key, text in texts.items()}, f"{cell} {chosen}", hint)


def _switches(channel: str, part: Workspace) -> str:
    return chip(
        channel, "edge", "Near the boundary", "Only points near the boundary of the workspace", part.edge
    ) + chip(channel, "clicks", "Click: go there", "A click on a point moves the arm there", part.clicks)


def _slice(fields: Fields, part: Workspace, units: Units) -> str:
    at = fields.field("offset", readable(part.offset / units.factor(False), 1), f"Place of the slice, {part.cut}")
    less = chip(fields.channel_id, "slice -1", "−", "Move the slice back")
    more = chip(fields.channel_id, "slice 1", "+", "Move the slice on")
    return row(f"{part.cut} =", f'<label class="option">{at}<i>{units.length_unit}</i></label>{less}{more}')


def _action(channel: str, part: Workspace) -> str:
    if part.asked is not None:
        found = part.found
        done = found.part if found is not None and found.question == part.asked else 0.0
        press = button(channel, "cancel", "Cancel", "chip", "Stop; what there is stays")
        bar = f'<div class="progress" style="--part:{100.0 * done:.0f}%"></div>'
        return f'<div class="bar">{press}<span class="dim">Sampling: {100.0 * done:.0f} %</span></div>{bar}'
    clear = chip(channel, "clear", "Clear", "Take the workspace away") if part.found is not None else ""
    return f'<div class="bar">{button(channel, "sample", "Sample", "main")}{clear}</div>'


def _told(channel: str, state: State, units: Units) -> str:
    part = state[Workspace]
    found = part.found
    if found is None:
        return (
            '<p class="dim">Random configurations inside the joint limits, each with the place of its tool: '
            "the reachable workspace WS<sub>1</sub> (4.17).</p>"
        )
    saves = "".join(chip(channel, cell, f"Save {cell.upper()}", hint) for cell, hint in SAVED.items())
    coloured = "" if drawing(state) == "surface" and part.section is not None else scale(found)
    waits = asks_for_boundary(part, state[Joints].arm)
    wait = '<p class="dim">The boundary is being found …</p>' if waits else ""
    return f'{wait}{coloured}{chosen(state, units, channel)}{facts(state, found, units)}<div class="bar">{saves}</div>'


def commands(state: State, cell: str, text: str, units: Units) -> tuple[Command, ...]:
    """Return what a person asked for.

    Raises
    ------
    InputError
        What was typed is no number; the text says which.
    """
    part = state[Workspace]
    plain: dict[str, Command] = {
        "sample": SampleWorkspace(),
        "cancel": CancelWorkspace(),
        "clear": ClearWorkspace(),
        "edge": LookAtWorkspace(edge=not part.edge),
        "clicks": LookAtWorkspace(clicks=not part.clicks),
    }
    if cell in plain:
        return (plain[cell],)
    if cell in ("again", "ways") and part.chosen is not None:
        return (GoToSample(part.chosen) if cell == "again" else AimAtSample(part.chosen),)
    if cell == "seed":
        if not text.strip().isdecimal() or len(text.strip()) > LONGEST_SEED:
            raise InputError(f"seed: expected a whole number, got {text.strip()[:40]!r}")
        return (LookAtWorkspace(seed=int(text)),)
    if cell == "offset":
        return (LookAtWorkspace(offset=units.read(text, False, f"place of the slice, {part.cut}")),)
    return _chosen(state, cell, text)


def _chosen(state: State, cell: str, text: str) -> tuple[Command, ...]:
    part, (what, _, value) = state[Workspace], cell.partition(" ")
    if cell == "example":
        return (ChooseWorkspaceExample(text),) if text else ()
    if cell == "measure":
        return (LookAtWorkspace(measure=text),)
    if cell == "count":
        return (LookAtWorkspace(count=int(text.partition(" ")[2])),) if text.partition(" ")[2].isdecimal() else ()
    if what == "draw":
        return (LookAtWorkspace(draw=value),)
    if what == "cut":
        return (LookAtWorkspace(cut=value),)
    if what == "slice" and value in ("1", "-1"):
        return (LookAtWorkspace(offset=part.offset + float(value) * 0.05 * state[Joints].arm.reach),)
    return ()


def _around(state: State) -> Points:
    """Return the corners of what is drawn."""
    found = state[Workspace].found
    if found is None:
        return NOTHING
    points = found.shown.points.astype(np.float64)
    return np.array([points.min(axis=0), points.max(axis=0)])


PANEL = Panel((Workspace, Joints), build, rebuilds=(RobotPart, Notation), around=_around)
