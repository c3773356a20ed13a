"""The section of the workspace: a side view as in a data sheet, size and reach, and how far the boundary is."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.workspace.section.found import Found
from armlab.benches.workspace.section.marks import target_measured, tool_measured
from armlab.benches.workspace.section.slice import hull, in_own_plane, slice_at
from armlab.benches.workspace.section.state import (
    COLOURS,
    GoInSection,
    GoToPoint,
    LookAtSection,
    PlaceSlice,
    SectionView,
    found_of,
)
from armlab.benches.workspace.section.ui.picture import frame_of, image_rule, view
from armlab.benches.workspace.section.ui.words import distances, facts, scale
from armlab.errors import InputError
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.state import Command, Post, State
from armlab.ui.fields import Fields
from armlab.ui.format import capitalised
from armlab.ui.markup import chip, chips, options, row, select
from armlab.ui.plugin import NOTHING, Panel, Points, Show
from armlab.ui.tried import tried
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

IMAGE = "sc-image"
SLICE_HINT = "What is drawn in the scene; drag its handle"


class SectionPage:
    """The page."""

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        self._gui, self._state, self._post, self._units = gui, state, post, units_of(state)
        self._choices = gui.fields(lambda cell, text: self._typed(self._choices, cell, text))
        self._view = gui.fields(lambda cell, text: self._typed(self._view, cell, text))
        self._told = gui.html()
        self._image = gui.html()
        self._pictured: Found | None = None

    def _typed(self, fields: Fields, cell: str, text: str) -> None:
        if not tried(
            fields, cell, text, lambda: commands(self._state, cell, text, self._units), self._state, self._post
        ):
            self.show(self._state)

    def show(self, state: State) -> None:
        """Show a state; the picture of what is reached is sent only when it is another one."""
        self._state = state
        found = found_of(state)
        self._choices.show(_choices(self._choices, state, self._units))
        if found is None or not found.section.filled.any():
            self._view.show('<p class="dim">The section of the workspace is being found …</p>')
            self._told.show("")
            return
        if found is not self._pictured:
            if self._pictured is None:
                self._gui.camera.keep_in_view()
            self._pictured = found
            self._image.show(image_rule(found, IMAGE))
        channel = self._view.channel_id
        picture = view(state, found, self._units, channel)
        self._view.show(picture + _progress(found) + scale(found) + distances(state, self._units, channel))
        self._told.show(facts(found, self._units))


def _progress(found: Found) -> str:
    if found.finished:
        return ""
    percent = 100.0 * found.done
    return (
        f'<div class="progress" style="--part:{percent:.0f}%"></div>'
        f'<p class="dim">Filling the section: {percent:.0f} %</p>'
    )


def _choices(fields: Fields, state: State, units: Units) -> str:
    part, channel, found = state[SectionView], fields.channel_id, found_of(state)
    titles = {key: capitalised(title) for key, title in COLOURS.items()}
    colour = row("Colour", select(channel, "colour", "Colour", options(titles, part.colour)))
    if found is not None and found.section.grid.flat:
        names = {"none": "Off", "axis": "In the plane"}
        chosen = part.slice if part.slice == "none" else "axis"
    else:
        turns = found is None or found.section.joint.revolute
        names = {"none": "Off", "axis": "Through axis 1" if turns else "Across axis 1", "x": "x", "y": "y", "z": "z"}
        chosen = part.slice
    kinds = {f"slice {key}": text for key, text in names.items()}
    slices = row("Slice", chips(channel, kinds, f"slice {chosen}", SLICE_HINT))
    return colour + slices + _place(fields, state, found, units)


def _place(fields: Fields, state: State, found: Found | None, units: Units) -> str:
    """Return where the slice stands."""
    part = state[SectionView]
    if part.slice == "none" or found is None or found.section.grid.flat:
        return ""
    if part.slice != "axis":
        at = fields.field("at", units.text(part.offset, False), f"Place of the slice, {part.slice}")
        return row(f"{part.slice} =", f'<label class="option sc-at">{at}<i>{units.length_unit}</i></label>')
    revolute = found.section.joint.revolute
    at = fields.field("at", units.text(slice_at(state, found), revolute), "Place of the slice")
    follow = chip(fields.channel_id, "follow", "With the tool", "The slice goes where the tool is", part.turn is None)
    return row("at", f'<label class="option sc-at">{at}<i>{units.unit(revolute)}</i></label>{follow}')


def commands(state: State, cell: str, text: str, units: Units) -> tuple[Command, ...]:
    """Return what a person asked for.

    Raises
    ------
    InputError
        What was typed is no number; the text says which.
    """
    part, found = state[SectionView], found_of(state)
    if cell == "colour":
        return (LookAtSection(colour=text),)
    if cell.startswith("slice "):
        return (LookAtSection(slice=cell.partition(" ")[2]),)
    if cell == "follow":
        return (PlaceSlice(None),)
    if cell == "at":
        revolute = part.slice == "axis" and (found is None or found.section.joint.revolute)
        return (PlaceSlice(units.read(text, revolute, "place of the slice")),)
    if cell == "go" and found is not None:
        return _picked(found, text)
    if cell == "boundary":
        measured = state.derived(target_measured) or state.derived(tool_measured)
        if measured is None:
            raise InputError("the boundary is not known yet")
        x, y, z = measured.to.foot.tolist()
        return (GoToPoint((x, y, z)),)
    return ()


def _picked(found: Found, text: str) -> tuple[Command, ...]:
    """Return the command for a click; the page says where, as parts of the picture from its upper left corner."""
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError:
        return ()
    if not math.isfinite(x + y):
        return ()
    whole, frame = in_own_plane(found), frame_of(found)
    first, second = frame.metres(min(max(x, 0.0), 1.0), min(max(y, 0.0), 1.0))
    if whole is None:
        return (GoInSection(first, second),)
    plane = whole.plane
    point = plane.corner + (first - frame.low[0]) * plane.right + (second - frame.low[1]) * plane.up
    px, py, pz = point.tolist()
    return (GoToPoint((px, py, pz)),)


def _around(state: State) -> Points:
    """Return the corners of what is reached."""
    found = found_of(state)
    if found is None or not found.section.filled.any():
        return NOTHING
    points = hull(found.section)
    return np.array([points.min(axis=0), points.max(axis=0)])


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make choices, picture and figures."""
    return SectionPage(gui, state, post).show


PANEL = Panel((SectionView, Joints, Target), build, rebuilds=(RobotPart, Notation), around=_around)
