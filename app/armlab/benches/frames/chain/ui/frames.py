"""The list of frames, and the fields of the selected one: name, parent, position and orientation."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.frames.chain.commands import (
    AddFrame,
    NameFrame,
    RemoveFrame,
    SetFrameAngle,
    SetFrameEntry,
    SetFrameMatrix,
    SetFramePosition,
    SetParent,
    shown_matrix,
)
from armlab.benches.frames.chain.point import SelectFrame
from armlab.benches.frames.chain.state import FARTHEST, HANDLES, POINT, WORLD, WRITTEN, Chain, Frame
from armlab.benches.frames.chain.ui.posed import angle_row, length_row, matrix_fields, projected
from armlab.benches.frames.chain.ui.symbols import called
from armlab.session.fields import Set
from armlab.session.state import State
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import row
from armlab.ui.units import units_of


def frames_markup(form: Form, state: State) -> Inside:
    """Return the frames as buttons, and what can be set of the selected one."""
    part = state[Chain]
    return (
        tag("h3", "Frames ", tag("small", "select one; drag its handle in the scene")),
        _list(form, part),
        _selected(form, state) if part.selected not in ("", POINT) else None,
    )


def _list(form: Form, part: Chain) -> Markup:
    chips = [
        form.chip(
            f"frame {each.name}",
            each.name,
            SelectFrame("" if each.name == part.selected else each.name),
            f"Frame {each.name}, given in {called(each.parent)}",
            each.name == part.selected,
        )
        for each in part.frames
    ]
    parent = part.selected if part.selected not in ("", POINT) else WORLD
    add = form.chip("add", "+ frame", AddFrame(parent), f"A new frame, given in {called(parent)}")
    point = form.chip(
        "frame p",
        "point p",
        SelectFrame("" if part.selected == POINT else POINT),
        "Its handle in the scene",
        part.selected == POINT,
    )
    return tag("div.bar", chips, add, point)


def _selected(form: Form, state: State) -> Markup:
    part, units = state[Chain], units_of(state)
    frame = part.named(part.selected)
    moved = partial(SetFramePosition, frame.name)
    return joined(
        _head(form, part, frame),
        length_row(form, "position", f"in {called(frame.parent)}", frame.position, units, moved, FARTHEST),
        _orientation(form, state, frame),
    )


def _head(form: Form, part: Chain, frame: Frame) -> Markup:
    name = frame.name
    parents = {each: "world" if each == WORLD else each for each in part.names if each != name}
    # Enter goes on from the name to the first coordinate.
    named = form.field("name", name, "Name of the frame", partial(NameFrame, name), "position 0")
    parent = form.select("parent", "Parent of the frame", parents, frame.parent, partial(SetParent, name))
    handle = form.chips("handle", HANDLES, part.handle, "What dragging does", partial(Set, Chain, "handle"))
    remove = form.chip("remove", "Remove", RemoveFrame(name), f"Remove {name}")
    return tag("div.kit-head.fr-head", named, tag("span.dim", "in"), parent, handle, remove)


def _orientation(form: Form, state: State, frame: Frame) -> Markup:
    part, units, name = state[Chain], units_of(state), frame.name
    chips = form.chips("written", WRITTEN, part.written, "How it is typed", partial(Set, Chain, "written"))
    chooser = row("orientation", chips, wide=True)
    if part.written == "rpy":
        return joined(
            chooser, angle_row(form, "angle", "roll pitch yaw", frame.angles, units, partial(SetFrameAngle, name))
        )
    typed = None if frame.matrix is None else np.array(frame.matrix)
    return joined(
        chooser,
        matrix_fields(form, "R", shown_matrix(frame), partial(SetFrameEntry, name), partial(SetFrameMatrix, name)),
        projected(form, "rounded", typed, partial(SetFrameMatrix, name)),
    )
