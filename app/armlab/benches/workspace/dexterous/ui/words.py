"""Orientations in words: regions of planar arms, scales of colours, proven and sampled results."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.workspace.cloud.ui import measured
from armlab.benches.workspace.dexterous.picture import AtTool, at_tool
from armlab.benches.workspace.dexterous.places import (
    GoToRegion,
    StandStretched,
    region_near,
    target_distance,
    tool_standing,
)
from armlab.benches.workspace.dexterous.study import Study, misses_orientations, never_turns, turns_in_place
from armlab.kin.workspace.planar import lengths_of, orientations, planar_workspace, pose_solutions, turns_fully
from armlab.kin.workspace.planar_regions import Region, regions
from armlab.kin.workspace.section_size import Size
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.colours import BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILLION, VIRIDIS_CSS, YELLOW, Rgb, css
from armlab.ui.form import Form
from armlab.ui.format import number, pairs, so_many
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.units import Units

COLOURS: dict[str, Rgb] = {
    "dexterous": GREEN,
    "origin": GREEN,
    "edge": VERMILLION,
    "partial": ORANGE,
    "crossing": VERMILLION,
    "two": SKY,
    "boundary": VERMILLION,
}
"""Colours of the regions; circles are lines."""

WAYS = {1: "→", -1: "←"}

NOTES_DIFFER = {
    3: "⟦“Not all orientations”: the notes say so of WS₁ \\ {∂WS₁ + ∂WS₂} (after 4.40), which still holds the inside "
    "of WS₂; it is so in WS₁ \\ (∂WS₁ ∪ WS₂).⟧",
    2: "⟦“Two orientations”: the notes say so of all of WS₁ \\ ∂WS₁; with l₁ = l₂ the origin, which is inside, is the "
    "exception.⟧",
}


def regions_table(form: Form, state: State, units: Units) -> Markup | None:
    """Return the regions from the inside out, each with a button to go there, and details for that of the tool."""
    arm = state[Joints].arm
    lengths, standing = lengths_of(arm), state.derived(tool_standing)
    if lengths is None or standing is None:
        return None
    rows = []
    for index, region in enumerate(regions(lengths)):
        here = region is standing.region
        rows.append(_row(form, index, region, here, units))
        if here:
            rows.append(_here(form, index, region, state, units))
    heads = [tag("span", head) for head in ("", f"r, {units.length_unit}", "Region", "Orientations")]
    return tag("div.dx-regions", tag("div.dx-head", heads), rows)


def _row(form: Form, index: int, region: Region, here: bool, units: Units) -> Markup:
    circle = region.low == region.high
    span = units.text(region.low, False)
    if not circle:
        span = f"{span} – {units.text(region.high, False)}"
    swatch = tag("i.ring" if circle else "i.area", style=f"--c:{css(COLOURS[region.kind])}")
    inside = swatch, [tag("span", text) for text in (span, region.name, _measure(region, units))]
    hint = "Bring the tool there"
    return form.button(f"region {index}", inside, GoToRegion(index), "dx-region", hint, pressed=here)


def _measure(region: Region, units: Units) -> str:
    """Return in short how many orientations a region has."""
    if region.kind in ("dexterous", "edge", "origin"):
        return "all"
    if region.kind in ("boundary", "two"):
        return "1" if region.kind == "boundary" else "2"
    low, high = _rounded(region.least, units), _rounded(region.most, units)
    unit = "°" if units.in_degrees else " rad"
    return f"{high}{unit}" if region.low == region.high else f"{low} – {high}{unit}"


def _rounded(angle: float, units: Units) -> str:
    """Return an angle in few figures, without its unit."""
    return number(math.degrees(angle), 0) if units.in_degrees else number(angle, 2)


def _here(form: Form, index: int, region: Region, state: State, units: Units) -> Markup:
    """Return the details of the region of the tool, and buttons for its singular configurations."""
    ways = None
    if region.ways:
        each = [
            form.chip(f"way {index} {k}", " ".join(WAYS[sign] for sign in way), StandStretched(index, k), "Move there")
            for k, way in enumerate(region.ways)
        ]
        ways = tag("p", "Singular: ", each, tag("br"), tag("small.dim", "→ a link outward, ← a link back"))
    return tag("div.dx-here", tag("p", region.says), ways)


def tool_words(state: State, units: Units) -> Markup | None:
    """Return the numbers for the places of the tool and of the target."""
    arm, standing = state[Joints].arm, state.derived(tool_standing)
    lengths = lengths_of(arm)
    if lengths is None or standing is None:
        return None
    place = standing.place
    rows = [("Tool", f"r = {units.length(place.r)}")]
    if len(lengths) == 3:
        measure = _possible(lengths, place.r)
        rows.append(("Orientations possible here", f"{units.angle(measure)} of {units.angle(math.tau)}"))
        count = float(pose_solutions(lengths, place.r, place.psi))
        rows.append(("Solutions, position and angle", "∞" if math.isinf(count) else f"{count:.0f}"))
    distance = target_distance(state)
    if distance is not None:
        region = region_near(lengths, distance)
        said = "outside WS₁" if region is None else region.name
        rows.append(("Target", f"r = {units.length(distance)}, {said}"))
    return pairs(rows)


def _possible(lengths: tuple[float, ...], r: float) -> float:
    """Return the measure of the orientations at the tool, rad; a tool beyond the outer edge by rounding is on it."""
    space = planar_workspace(lengths)
    return float(np.nan_to_num(orientations(lengths, min(max(r, space.inner), space.outer))))


def planar_words(state: State, units: Units) -> Inside:
    """Return the workspaces of a planar arm in closed form, and the difference from the notes."""
    lengths = lengths_of(state[Joints].arm)
    if lengths is None:
        return None
    space = planar_workspace(lengths)
    pieces = [
        f"{units.text(low, False)} – {units.length(high)}"
        if low < high
        else units.length(low)
        if low > 0.0
        else "the origin"
        for low, high in space.dexterous
    ]
    rows = [
        ("WS₁", f"{units.text(space.inner, False)} – {units.length(space.outer)}"),
        ("Area of WS₁", f"{number(space.area, 3)} m²"),
        ("WS₂", " and ".join(pieces) if pieces else "empty"),
    ]
    differs = None
    if len(lengths) == 3 or space.dexterous:
        text = tag("p.dim", NOTES_DIFFER[len(lengths)])
        differs = tag("details", tag("summary", "⟦Where the notes differ⟧"), text)
    return pairs(rows), None if turns_fully(state[Joints].arm) else WITHOUT_LIMITS, differs


WITHOUT_LIMITS = tag(
    "p.dim",
    "Not every joint can make a full turn: the circles hold ",
    tag("b", "without joint limits"),
    ". With them it is what the coloured cells show, which are sampled.",
)

NEVER_TURNS = "The tool never turns"

AT_A_POINT = {
    0: "The position fixes the orientation: at a point only a few single ones are possible",
    1: "At a point the possible orientations are a single family, of one angle",
    2: "At a point the possible orientations are a family of two angles",
}
"""Sentences by the number of ways in which the tool turns in place, if these are too few for all orientations."""


def proven(state: State, found: Study, units: Units) -> Inside:
    """Return which results are certain and which were sampled."""
    if found.wrist is not None:
        return _wrist_words(found, units)
    assert found.map is not None
    if found.question.method == "count":
        sure = (
            "Each number is all there are (closed form)"
            if found.map.proven
            else "At least so many (not all cells could be solved completely)"
        )
        turned = "" if found.question.arm.task.rotation == "none" else ", the tool turned the same everywhere"
        text = f"{sure}, in the middle of each cell, inside the joint limits{turned}."
        return tag("p.dim", text)
    return _sampled_words(found)


def _sampled_words(found: Study) -> Inside:
    """Return the result of the samples, after what is known of the arm without them."""
    assert found.map is not None
    arm, circle = found.question.arm, found.map.sheet.bins.circle
    what = "64 equal angles of the tool" if circle else "64 approach directions, the roll about them not counted"
    met = f"{round(found.question.count * found.done):,}".replace(",", "\u202f")
    values = found.map.values[np.isfinite(found.map.values)]
    everywhere = float((values >= 1.0).mean()) if len(values) else 0.0
    rows = [("Samples", met)]
    if never_turns(arm):
        return pairs(rows), tag("p", f"{NEVER_TURNS}: one orientation, the same wherever it gets.")
    rows.append(("Most in a cell", _at_least(float(values.max())) if len(values) else "–"))
    known = None
    if misses_orientations(arm):
        known = tag("p", f"{AT_A_POINT[turns_in_place(arm)]}; never all, except perhaps at singular points.")
    else:
        rows.append(
            ("Cells with all of them", f"at least {_percent(everywhere)}" if everywhere > 0.0 else "none found")
        )
    note = "A direction that was found is possible somewhere in the cell; others may have been missed."
    return pairs(rows), known, tag("p.dim", f"Sampled inside the joint limits: {what}. {note}")


def _wrist_words(found: Study, units: Units) -> Inside:
    wrist = found.wrist
    assert wrist is not None
    body = "a closed form" if wrist.points.exact else "a table of samples"
    size = measured.with_error(Size(wrist.volume, wrist.volume_error, "m³"))
    of = "WS₂, all directions" if wrist.proper else "WS₂ without wrist limits"
    most = float(wrist.fraction.max())
    rows = [
        (of, size if wrist.volume > 0.0 else "none"),
        ("Largest share", f"{'about' if wrist.proper else 'at most'} {_percent(most)}"),
        ("Wrist centre to tool", units.length(wrist.tool)),
        ("Voxels", f"{wrist.fraction.shape[0]}³ of {units.length(wrist.step)}"),
    ]
    if not wrist.proper:
        counted = "The limits of the wrist's own joints are left out: each share is an upper bound, up to the voxels."
    elif wrist.turns.free:
        counted = "All joint limits are counted; the wrist turns freely."
    else:
        counted = "All joint limits are counted, those of the wrist too."
    share = "The share of the directions from the wrist centre to the tool point, the roll about them not counted."
    return pairs(rows), tag("p.dim", f"{share} The positions of the wrist centre come from {body}. {counted}")


def tool_line(state: State, found: Study) -> Markup | None:
    """Return the result at the tool point."""
    here = state.derived(at_tool)
    if here is None:
        return None
    return tag("p.dx-tool", tag("b", "At the tool:"), f" {_at_tool(here, found)}")


def _at_tool(here: AtTool, found: Study) -> str:
    if here.beside:
        return "it is beside this slice"
    if found.question.method == "count":
        count = "infinitely many" if math.isinf(here.value) else f"{here.value:.0f}" if here.value else "no"
        turned = "" if found.question.arm.task.rotation == "none" else ", with the tool turned as on the slice"
        return f"{so_many(count, 'solution')} inside the limits{turned}"
    if math.isnan(here.value):
        return "nothing was found in its cell"
    if found.wrist is not None:
        most = "" if found.wrist.proper else "at most "
        return f"{most}{_percent(here.value)} of the directions, of {here.of} tried"
    if never_turns(found.question.arm):
        return "one orientation, as everywhere"
    if turns_in_place(found.question.arm) == 0:
        return f"{round(here.value * here.of)} of {here.of} directions found in its cell"
    return (
        f"at least {_percent(here.value)} of the orientations, {round(here.value * here.of)} of {here.of}, in its cell"
    )


def scale(state: State, found: Study) -> Markup | None:
    """Return the colours and their meaning."""
    if found.question.method == "count" and found.map is not None:
        numbers = sorted({float(value) for value in found.map.values[~np.isnan(found.map.values)].ravel()})
        marks = [tag("span", _swatch(value), "∞" if math.isinf(value) else f"{value:.0f}") for value in numbers]
        return tag("div.kit-scale", tag("b", "Solutions inside the limits"), tag("div.dx-counts", marks))
    if found.map is not None and never_turns(found.question.arm):
        return None
    circle = found.map is not None and found.map.sheet.bins.circle
    head = "Orientations in the plane" if circle else "Approach directions"
    ends = tag("div", [tag("i", text) for text in ("0 %", "50 %", "100 %")])
    return tag("div.kit-scale", tag("b", head), tag("u", style=f"background:{VIRIDIS_CSS}"), ends)


def _swatch(count: float) -> Markup:
    return tag("i", style=f"background:{css(count_colour(count))}")


COUNT_COLOURS: dict[float, Rgb] = {
    1.0: (68, 1, 84),
    2.0: SKY,
    3.0: PURPLE,
    4.0: GREEN,
    5.0: BLUE,
    6.0: ORANGE,
    7.0: GREY,
    8.0: YELLOW,
    16.0: (250, 250, 250),
}
"""Colours of the usual numbers of solutions, each with its own hue to tell the numbers apart."""


def count_colour(count: float) -> Rgb:
    """Return the colour of a number of solutions."""
    if math.isinf(count):
        return VERMILLION
    steps, colours = list(COUNT_COLOURS), np.array(list(COUNT_COLOURS.values()))
    r, g, b = (round(float(np.interp(count, steps, colours[:, k]))) for k in range(3))
    return r, g, b


def definition() -> Markup:
    """Return the definition of the dexterous workspace."""
    two, one = ("WS", tag("sub", "2")), ("WS", tag("sub", "1"))
    return tag(
        "p.dim", two, ": the points of ", one, " that the tool reaches in ", tag("b", "every"), " orientation⟦ (4.21)⟧."
    )


def _at_least(share: float) -> str:
    return "all" if share >= 1.0 else f"at least {_percent(share)}"


def _percent(share: float) -> str:
    return f"{number(100.0 * share, 1)} %"
