"""The orientations of the tool at each point: regions of planar arms, coverage of directions, solutions."""

from __future__ import annotations

import numpy as np

from armlab.benches.workspace.dexterous.picture import body_shown, largest_share, slice_shown
from armlab.benches.workspace.dexterous.places import outermost
from armlab.benches.workspace.dexterous.state import (
    COUNTS,
    DRAWINGS,
    SHARES,
    Dexterous,
    LookThroughTool,
    ResumeDexterous,
    StopDexterous,
    method_of,
    question_of,
    rings_alone,
    slice_of,
    study_of,
)
from armlab.benches.workspace.dexterous.study import methods, why_sampled_alone
from armlab.benches.workspace.dexterous.ui.words import (
    definition,
    planar_words,
    proven,
    regions_table,
    scale,
    tool_line,
    tool_words,
)
from armlab.kin.workspace.first_joint import first_joint
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Post, State
from armlab.ui.eye import Facing
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import progress_bar, row
from armlab.ui.plugin import NOTHING, Panel, Points, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

TITLES = {
    "rings": "Closed form",
    "wrist": "Wrist",
    "sampled": "Sampled",
    "count": "Solutions",
}

HINTS = "How orientations are found: by a formula, by the wrist, from samples; or how many solutions there are"


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choices, the regions and the figures."""
    units = units_of(state)
    gui.html(definition())
    choices, table = gui.form(post), gui.form(post)
    told = gui.html()

    def show(state: State) -> None:
        choices.show(choices_markup(choices, state, units))
        rings = method_of(state) == "rings"
        table.show((tool_words(state, units), regions_table(table, state, units)) if rings else None)
        told.show(_told(state, units))

    return show


def choices_markup(form: Form, state: State, units: Units) -> Inside:
    """Return the choices of the method and of the picture, and the progress."""
    arm, part = state[Joints].arm, state[Dexterous]
    known, method = methods(arm), method_of(state)
    names: dict[str, str] = {key: TITLES[key] for key in known}
    by = form.chips("method", names, method, HINTS, lambda key: Set(Dexterous, "method", key))
    lines: list[Inside] = [row("By", by)]
    if known == ("sampled",):
        lines.append(tag("p.dim", why_sampled_alone(arm)))
    if state.derived(rings_alone):
        return lines
    if method == "wrist":
        drawn = form.chips("draw", DRAWINGS, part.draw, "", lambda key: Set(Dexterous, "draw", key))
        lines.append(row("Show", drawn))
    if method == "wrist" and part.draw == "body":
        shares = {str(share): "all" if share >= 1.0 else f"{100.0 * share:.0f} %" for share in SHARES}
        hint = "Of the approach directions"
        chosen = form.chips("share", shares, str(part.share), hint, lambda key: Set(Dexterous, "share", float(key)))
        lines += [row("At least", chosen), _nowhere(state)]
    else:
        lines.append(_slice(form, state, units))
    if method in ("rings", "sampled"):
        counts = {str(count): _counted(count) for count in COUNTS}
        chosen = form.chips("count", counts, str(part.count), "", lambda key: Set(Dexterous, "count", int(key)))
        lines.append(row("Samples", chosen))
    return lines, _progress(form, state)


def _nowhere(state: State) -> Markup | None:
    """Return why no body is seen, if no point has the chosen share."""
    found, share = state.derived(study_of), state[Dexterous].share
    if found is None or found.wrist is None:
        return None
    largest = largest_share(found.wrist)
    if largest is not None and largest >= share:
        return None
    wanted = "all directions" if share >= 1.0 else f"{100.0 * share:.0f} % of the directions"
    other = "" if largest is None else f"; try {100.0 * largest:.0f} %"
    return tag("p", f"No point has {wanted}{other}.")


def _counted(count: int) -> str:
    return f"{count / 1e6:g} M"


def _slice(form: Form, state: State, units: Units) -> Markup | None:
    """Return the place of the slice, and the button that brings it to the tool."""
    joint, method = first_joint(state[Joints].arm), method_of(state)
    through = form.chip("through", "As the tool is", LookThroughTool(), _THROUGH[method == "count"])
    if joint.planar:
        return row("Turned", through) if method == "count" else None
    turns = joint.revolute
    s = slice_of(state)
    shown = units.turned(s) if turns else units.text(s, turns)
    label = "Half plane through axis 1" if turns else "Place of the plane"
    most = MOST_TURNED if turns else state[Joints].arm.reach

    def typed(text: str) -> Set:
        return Set(Dexterous, "s", units.read(text, turns, "slice", within=(-most, most)))

    cell = form.field("slice", shown, label, typed)
    return row("Slice at", (tag("label.option", cell, tag("i", units.unit(turns))), through))


_THROUGH = (
    "Put the slice through the tool point",
    "Put the slice through the tool point, with the tool's present orientation",
)


def _progress(form: Form, state: State) -> Inside:
    question, found = state.derived(question_of), state.derived(study_of)
    if question is None or (found is not None and found.finished):
        return None
    if question == state[Dexterous].stopped:
        press = form.button("resume", "Compute", ResumeDexterous(), "main")
        return tag("div.bar", press, tag("span.dim", "Stopped."))
    done = found.done if found is not None else 0.0
    press = form.chip("stop", "Cancel", StopDexterous(), "Stop and keep what has been found")
    return tag("div.bar", press, tag("span.dim", f"Computing: {100.0 * done:.0f} %")), progress_bar(done)


def _told(state: State, units: Units) -> Inside:
    """Return the results, and how certain they are."""
    found, method = state.derived(study_of), method_of(state)
    rings = planar_words(state, units) if method == "rings" else None
    if found is None:
        return rings
    return rings, scale(state, found), tool_line(state, found), proven(state, found, units)


def _around(state: State) -> Points:
    """Return the corners of the rings, or of the slice."""
    rings = state.derived(outermost)
    if rings is not None:
        return rings
    shown = state.derived(slice_shown)
    if shown is None:
        return NOTHING
    wide, high = (count * shown.step for count in shown.values.shape)
    return np.array([shown.corner + wide * i * shown.right + high * j * shown.up for i in (0, 1) for j in (0, 1)])


def _faces(state: State) -> Facing | None:
    """Return the plane of the slice, or of the rings of a planar arm."""
    shown, part = state.derived(slice_shown), state[Dexterous]
    if state.derived(outermost) is not None:
        axes = first_joint(state[Joints].arm).axes
        return Facing(axes[:, 2], axes[:, 1], "rings")
    if shown is None or state.derived(body_shown) is not None:
        return None
    return Facing(np.cross(shown.right, shown.up), shown.up, f"{part.s}")


def _looks(state: State) -> tuple[object, ...]:
    """Return whether there is a result, and the choices of what is shown of it."""
    part = state[Dexterous]
    return state.derived(study_of) is not None, method_of(state), part.draw, part.s


PANEL = Panel(
    (Dexterous, Joints, Target), build, rebuilds=(RobotPart, Notation), around=_around, faces=_faces, looks=_looks
)
