"""The section of the workspace: a side view as in a data sheet, size and reach, and the distance to the boundary."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.workspace.section.found import Found
from armlab.benches.workspace.section.slice import hull, in_own_plane, plane_drawn, slice_at, slice_range
from armlab.benches.workspace.section.state import (
    COLOURS,
    GoInSection,
    GoToPoint,
    PlaceSlice,
    SectionView,
    found_of,
)
from armlab.benches.workspace.section.ui.picture import frame_of, image_rule, view
from armlab.benches.workspace.section.ui.words import distances, facts, scale
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.state import Command, Post, State
from armlab.ui.eye import Facing
from armlab.ui.form import Form
from armlab.ui.format import capitalised
from armlab.ui.html import Inside, tag
from armlab.ui.markup import progress_bar, row
from armlab.ui.plugin import NOTHING, Panel, Points, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

IMAGE = "sc-image"
SLICE_HINT = "What is drawn in the scene; drag its handle"


class SectionPage:
    """The page."""

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        self._units = units_of(state)
        self._post, self._turns = post, False
        self._choices = gui.form(post)
        self._slider = gui.slider("slice", 0.0, 1.0, 0.1, 0.0, self._slid, None)
        self._exact = gui.form(post)
        self._view = gui.form(post)
        self._told = gui.html()
        self._image = gui.html()
        self._pictured: Found | None = None

    def show(self, state: State) -> None:
        """Show a state; the picture of the reached region is sent only when it has changed."""
        found = found_of(state)
        self._choices.show(choices_markup(self._choices, state, self._units))
        self._show_slider(state)
        if found is None or not found.section.filled.any():
            self._view.show(tag("p.dim", "The section of the workspace is being found …"))
            self._told.show()
            return
        if found is not self._pictured:
            self._pictured = found
            self._image.show(image_rule(found, IMAGE))
        self._view.show(view_markup(self._view, state, found, self._units))
        self._told.show(facts(found, self._units))

    def _slid(self, value: float) -> None:
        self._post(PlaceSlice(value * self._units.factor(self._turns)))

    def _show_slider(self, state: State) -> None:
        """Show the place of the slice; the handle in the scene is hard to grasp where it is looked at end on."""
        found, kind = found_of(state), state[SectionView].slice
        shown = plane_drawn(state) is not None and found is not None and not found.section.grid.flat
        self._slider.visible(shown)
        self._exact.show(place_markup(self._exact, state, found, self._units) if found is not None and shown else None)
        if found is None or not shown:
            return
        self._turns = kind == "axis" and found.section.joint.revolute
        at = slice_at(state, found) if kind == "axis" else state[SectionView].offset
        place, low, high = (self._units.value(each, self._turns) for each in (at, *slice_range(found, kind)))
        step = 10.0 ** -self._units.decimals(self._turns)
        label = f"{'at' if kind == 'axis' else kind} {self._units.unit(self._turns)}"
        self._slider.span(label, min(low, place), max(high, place, low + step), step)
        self._slider.show(place)


def view_markup(form: Form, state: State, found: Found, units: Units) -> Inside:
    """Return the picture, its progress, its colours, and the distances to the boundary."""
    picture = view(state, found, units, form.place("go", partial(_picked, found)))
    return picture, _progress(found), scale(found), distances(form, state, units)


def _progress(found: Found) -> Inside:
    if found.finished:
        return None
    return progress_bar(found.done), tag("p.dim", f"Filling the section: {100.0 * found.done:.0f} %")


def choices_markup(form: Form, state: State, units: Units) -> Inside:
    """Return the choices of colour and slice."""
    part, found = state[SectionView], found_of(state)
    titles = {key: capitalised(title) for key, title in COLOURS.items()}
    colour = row("Colour", form.select("colour", "Colour", titles, part.colour, partial(Set, SectionView, "colour")))
    if found is not None and found.section.grid.flat:
        names = {"none": "Off", "axis": "In the plane"}
        chosen = part.slice if part.slice == "none" else "axis"
    else:
        turns = found is None or found.section.joint.revolute
        names = {"none": "Off", "axis": "Through axis 1" if turns else "Across axis 1", "x": "x", "y": "y", "z": "z"}
        chosen = part.slice
    slices = row("Slice", form.chips("slice", names, chosen, SLICE_HINT, partial(Set, SectionView, "slice")))
    return colour, slices


def place_markup(form: Form, state: State, found: Found, units: Units) -> Inside:
    """Return the field for the place of the slice, over the box of its slider."""
    part = state[SectionView]

    def typed(revolute: bool, text: str) -> PlaceSlice:
        return PlaceSlice(units.read(text, revolute, "place of the slice"))

    if part.slice != "axis":
        label = f"Place of the slice, {part.slice} in {units.length_unit}"
        return tag("div.over-slider", form.field("at", units.text(part.offset, False), label, partial(typed, False)))
    revolute = found.section.joint.revolute
    shown = units.text(slice_at(state, found), revolute)
    label = f"Place of the slice in {units.unit(revolute)}"
    at = form.field("at", shown, label, partial(typed, revolute))
    hint = "The slice follows the tool"
    follow = form.chip("follow", "With the tool", PlaceSlice(None), hint, part.turn is None)
    return tag("div.over-slider", at), row("", follow)


def _picked(found: Found, x: float, y: float, _drag: int) -> Command:
    """Return the command for a click, in parts of the picture from its upper left corner."""
    whole, frame = in_own_plane(found), frame_of(found)
    first, second = frame.metres(min(max(x, 0.0), 1.0), min(max(y, 0.0), 1.0))
    if whole is None:
        return GoInSection(first, second)
    plane = whole.plane
    point = plane.corner + (first - frame.low[0]) * plane.right + (second - frame.low[1]) * plane.up
    px, py, pz = point.tolist()
    return GoToPoint((px, py, pz))


def _around(state: State) -> Points:
    """Return the corners of a slice that only turns or keeps its place, or points wherever another one may be moved."""
    found, plane = found_of(state), plane_drawn(state)
    if found is None or not found.section.filled.any():
        return NOTHING
    turns = found.section.grid.flat or (state[SectionView].slice == "axis" and found.section.joint.revolute)
    return plane.corners if plane is not None and turns else hull(found.section)


def _faces(state: State) -> Facing | None:
    """Return the plane of the slice."""
    plane = plane_drawn(state)
    return None if plane is None else Facing(np.cross(plane.right, plane.up), plane.up, state[SectionView].slice)


def _looks(state: State) -> tuple[object, ...]:
    """Return how far the section is known, and the kind of slice: a hand may move the slice itself."""
    found = found_of(state)
    known = (False, False) if found is None else (bool(found.section.filled.any()), found.finished)
    return *known, state[SectionView].slice


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choices, the picture and the figures."""
    return SectionPage(gui, state, post).show


PANEL = Panel(
    (SectionView, Joints, Target),
    build,
    rebuilds=(RobotPart, Notation),
    around=_around,
    faces=_faces,
    looks=_looks,
)
