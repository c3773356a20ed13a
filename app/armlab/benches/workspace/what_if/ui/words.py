"""The effect of a change on a workspace, in words and numbers."""

from __future__ import annotations

import math

from armlab.benches.workspace.section.ui.words import across
from armlab.benches.workspace.what_if.arm import LIMITS, TOOL, Change, turns, value_of
from armlab.benches.workspace.what_if.found import Compared, Figures
from armlab.benches.workspace.what_if.state import Suppose, WhatIf, is_present
from armlab.benches.workspace.what_if.ui.scene import COLOURS, THOUGHT
from armlab.kin.arm import Arm
from armlab.kin.workspace.first_joint import first_joint
from armlab.session.state import State
from armlab.ui.colours import css
from armlab.ui.form import Form
from armlab.ui.format import dot, number
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.units import Units

NAMES = {"low": "from", "high": "to"}
LEGEND = {
    "kept": "in both",
    "thought": "as proposed",
    "gained": "gained: reached only as proposed",
    "lost": "lost: reached only as it is",
}


FOLLOWED = "The boundary is being followed."

ON_A_SURFACE = "The tool point moves on a line or a surface; compare how far it comes."
ON_A_SURFACE_BEFORE = "As it is, the tool point moves on a line or a surface; compare how far it comes."

HINTS = {
    "From axis 1": "Smallest and largest distance of the tool point from the axis of joint 1",
    "Along axis 1": "Lowest and highest position of the tool point along the axis of joint 1",
    "Along ": "Smallest and largest coordinate of the tool point in this direction, across axis 1",
    "Reach": "Largest distance of the tool point from the point of axis 1 that is nearest to frame 0",
}
"""Hints for rows by the beginning of their names; the first that fits is used."""

UNSURE = 0.05
"""Difference, as a share of the size, below which it is not mentioned before the boundary is known."""

WORDS = {"m²": "area", "m³": "volume"}
ARTICLES = {"m²": "an area", "m³": "a volume"}


def name_of(arm: Arm, row: int, field: str, units: Units) -> str:
    """Return the symbol of a quantity: a₂, the smallest q₃, the x of the tool."""
    if field in TOOL:
        return f"tool {field}"
    if field in LIMITS:
        return f"{units.variable(row, bool(arm.revolute[row]))} {NAMES[field]}"
    before = arm.convention == "modified" and field in ("a", "alpha")
    return units.symbol(field, row if before else row + 1)


def with_unit(value: float, angle: bool, units: Units) -> str:
    """Return a length or an angle with its unit."""
    return units.angle(value) if angle else units.length(value)


def changes_markup(form: Form, part: WhatIf, units: Units) -> Inside:
    """Return the supposed changes, each with a button that removes it."""
    if not part.changes:
        return None
    rows = [_change(form, part.arm, change, units) for change in part.changes]
    return tag("h3", "Proposed changes"), tag("div.wi-changes", rows)


def _change(form: Form, arm: Arm, change: Change, units: Units) -> Inside:
    angle = turns(arm, change.row, change.field)
    was = value_of(arm, change.row, change.field)
    name = name_of(arm, change.row, change.field, units)
    as_it_is = Suppose(change.row, change.field, was)
    back = form.chip(f"back {change.row} {change.field}", "×", as_it_is, f"{name} as it is")
    ends = tag("span", f"{with_unit(was, angle, units)} → ", tag("b", with_unit(change.value, angle, units)))
    return tag("span", name), ends, back


def verdict_markup(state: State) -> Markup | None:
    """Return a sentence on the effect of the changes on the size."""
    part, found = state[WhatIf], state[WhatIf].found
    if found is None or not part.changes:
        return None
    before, after = (each.size for each in found.figures)
    if not is_present(state) or before is None or after is None:
        return _card("warn", "…", FOLLOWED)
    what, grown = WORDS[after.unit], after.value - before.value
    # A size of 0 is none in either unit, and a surface in space is no volume.
    if after.value == 0.0 and (before.value == 0.0 or before.unit != after.unit):
        return _card("warn", f"No {what}", ON_A_SURFACE)
    if before.unit != after.unit and before.value == 0.0:
        return _card("warn", f"No {WORDS[before.unit]} before", ON_A_SURFACE_BEFORE)
    if before.unit != after.unit:
        said = f"{before.unit} and {after.unit} cannot be compared."
        return _card("warn", f"The {WORDS[before.unit]} becomes {ARTICLES[after.unit]}", said)
    word, sign, kind, mark = ("larger", "+", "ok", "▲") if grown > 0.0 else ("smaller", "−", "no", "▼")
    share = abs(grown) / before.value if before.value > 0.0 else math.inf
    if not all(each.refined for each in found.figures):
        about = f", about {sign}{number(100.0 * share, 0)} %" if math.isfinite(share) else ""
        return _card("warn", "≈ …" if share < UNSURE else f"{mark} {word.capitalize()}{about}", FOLLOWED)
    most = math.hypot(before.error, after.error)
    if abs(grown) <= most:
        said = f"The difference is within the uncertainty, ±{_of(most, most)} {after.unit}."
        return _card("warn", f"≈ The same {what}", said)
    part_of = f", {sign}{number(100.0 * share, 1)} %" if math.isfinite(share) else ""
    said = f"{sign}{_of(abs(grown), most)} {after.unit}, known to ±{_of(most, most)} {after.unit}."
    return _card(kind, f"{mark} The {what} is {word}{part_of}", said)


def _card(kind: str, head: str, said: str) -> Markup:
    """Return a card whose head brings its own sign."""
    return verdict_box(kind, head, said, sign="")


def figures_markup(found: Compared, units: Units) -> Inside:
    """Return size and reach, of the real arm and with the changes."""
    sides, flat = found.figures, [first_joint(arm).planar for arm in (found.before, found.after)]
    units_of_size = ["m²" if each else "m³" for each in flat]
    same = units_of_size[0] == units_of_size[1]
    title = f"{WORDS[units_of_size[0]].capitalize()}, {units_of_size[0]}" if same else "Size"
    ends = ["" if same else f" {unit}" for unit in units_of_size]
    rows = [(title, *(_size_of(each) + end for each, end in zip(sides, ends, strict=True)))]
    rows += _reach_rows(found, all(flat), units)
    width = 1 if found.same else 2
    heads = [tag("th", head) for head in ("", "as it is", "proposed")[: width + 1]]
    body = [_row(name, cells[:width]) for name, *cells in rows]
    refined = all(each.refined for each in sides)
    kind = "from the boundary of the section" if refined else "of samples so far"
    title = tag("h3", "Workspace ", tag("small", f"lengths in {units.length_unit}, {kind}"))
    return title, tag("table.wi-figures", tag("tr", heads), body)


def _reach_rows(found: Compared, flat: bool, units: Units) -> list[tuple[str, ...]]:
    """Return the reach of both: from and along a joint 1 that turns, or in the directions across one that slides."""
    joints, sides = [first_joint(arm) for arm in (found.before, found.after)], found.figures
    turning = joints[0].revolute
    first, second = (
        ("From axis 1", "Along axis 1")
        if turning
        else (f"Along {' / '.join(dict.fromkeys(names))}" for names in zip(*map(across, joints), strict=True))
    )
    rows = [(first, *(_ends(each.reach.inner, each.reach.outer, units) for each in sides))]
    if not flat:
        rows.append((second, *(_ends(each.reach.low, each.reach.high, units) for each in sides)))
    if turning:
        rows.append(("Reach", *(units.text(each.reach.farthest, False) for each in sides)))
    return rows


def _row(name: str, cells: list[str]) -> Markup:
    hint = next((text for start, text in HINTS.items() if name.startswith(start)), None)
    return tag("tr", tag("th", name, title=hint), [tag("td", cell) for cell in cells])


def legend_markup(found: Compared) -> Markup:
    """Return the meaning of the colours of the points."""
    if found.same:
        names: tuple[str, ...] = ("kept",)
    else:
        names = ("kept", "gained", "lost") if found.told_apart else ("kept", "thought")
    texts = {**LEGEND, "kept": "as it is" if not found.told_apart or found.same else LEGEND["kept"]}
    dots = [tag("span", dot(css(COLOURS[name])), texts[name]) for name in names]
    line = tag("span", tag("u", style=f"background:{css(THOUGHT)}"), "the arm as proposed")
    return tag("div.wi-legend", dots, None if found.same else line)


def _ends(low: float, high: float, units: Units) -> str:
    return f"{units.text(low, False)} … {units.text(high, False)}"


def _size_of(figures: Figures) -> str:
    size = figures.size
    if size is None:
        return "…"
    if not figures.refined:
        return f"≈ {_of(size.value, 0.05 * size.value)}"
    return f"{_of(size.value, size.error)} ± {_of(size.error, size.error)}"


def _of(value: float, error: float) -> str:
    """Return a number to the accuracy of its error, which is shown with one digit, or two that begin with 1."""
    if error <= 0.0:
        return number(value, 3)
    power = math.floor(math.log10(error))
    return number(value, max(0, (1 if error < 2.0 * 10.0**power else 0) - power))
