"""Sentences and tables beside the plots of a motion."""

from __future__ import annotations

from math import isnan

from armlab.benches.motion.plan.figures import TOOL, Binding, Figures, Overrun
from armlab.benches.motion.plan.question import Planned
from armlab.benches.motion.plan.ui.joint_marks import joint_mark
from armlab.benches.motion.plan.words import exceeded_words, rounded_up
from armlab.benches.motion.plots.drawn import Kind, kind_of, same_time
from armlab.benches.motion.plots.ui.lines import DOTS, TIMES
from armlab.ui.format import capitalised, number, trimmed
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import SIGNS, fold, verdict_box
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units

KINDS: dict[Kind, str] = {"joint": "joint moves", "cartesian": "Cartesian moves", "mixed": "these moves"}
OTHERS: dict[Kind, str] = {"joint": "Cartesian moves", "cartesian": "joint moves", "mixed": "the other kinds"}
"""Names of a plan, and of the plan for comparison, by the space of its moves."""

MOST_SENTENCES = 8

LONGER = 1.001
"""Ratio from which on a path is called longer."""

FULL = 1.0 + 1e-6
"""Share above which a limit is exceeded, and not by rounding."""


def status(planned: Planned | None, figures: Figures | None, found: tuple[Overrun, ...]) -> Markup:
    """Return the sentences before the plots."""
    if planned is None:
        return tag("p.dim", "The motion is being planned …")
    why = capitalised(planned.trouble)
    if figures is None:
        missing = why or "A motion needs two waypoints. Add another on the page Plan"
        return verdict_box("no", "There is nothing to plot.", f"{missing}.")
    parts = []
    if why:
        parts.append(verdict_box("no", "The motion cannot be run to its end. What can be run is plotted.", f"{why}."))
    if every := exceeded_words(planned):
        shown = [tag("p", f"✕ {capitalised(text)}.") for text in every[:MOST_SENTENCES]]
        if len(every) > MOST_SENTENCES:
            shown.append(tag("p", f"… and {len(every) - MOST_SENTENCES} more."))
        many = max(len(found), len(every))
        head = "A limit is exceeded." if many == 1 else f"{many} limits are exceeded."
        within = None
        if not isnan(planned.least):
            least = f"{_seconds(rounded_up(planned.least))}{planned.with_ramps}"
            within = f"Within the limits this path takes {least}."
        parts.append(verdict_box("no.mp-over", head, shown, within, sign=SIGNS["no"]))
    elif not why:
        parts.append(verdict_box("ok", "All limits are kept.", _kept(planned, figures)))
    return joined(parts)


def _kept(planned: Planned, figures: Figures) -> str:
    if figures.binding is not None:
        return f"{capitalised(holder(figures.binding))} keeps the motion from being faster."
    return f"None is reached: as fast as allowed, the motion would take {_seconds(planned.fastest)}."


def holder(binding: Binding) -> str:
    """Return in words the limit that slows a motion."""
    if binding.joint == TOOL:
        return "the speed limit of the tool"
    return f"the {binding.quantity} limit of joint {binding.joint}"


def comparison(
    planned: Planned, own: Figures | None, other: Planned | None, theirs: Figures | None, units: Units
) -> Markup:
    """Return both kinds of moves side by side, and which one is faster and why.

    Parameters
    ----------
    planned : Planned
    own : Figures or None
    other : Planned or None
        None while it is not ready.
    theirs : Figures or None
    units : Units
    """
    kind = kind_of(planned.question)
    names = capitalised(KINDS[kind]), capitalised(OTHERS[kind])
    title = tag("h3", f"{names[0]} and {OTHERS[kind]}")
    if other is None:
        return joined(title, tag("p.dim", "…"))
    heads = head_line("", (_mark("full"), _short(names[0])), (_mark("dotted"), _short(names[1])))
    both, length = (own, theirs), units.length_unit
    rows = [
        _row("duration, s", [None if f is None else _time(p.duration) for p, f in ((planned, own), (other, theirs))]),
        _row(f"tool path, {length}", [None if f is None else units.text(f.way, False) for f in both]),
        _row(f"tool speed, {length}/s", [None if f is None else units.text(f.tool_speed, False) for f in both]),
        _row("joint speed", [None if f is None else _fastest_joint(planned, f, units) for f in both]),
    ]
    if planned.question.duration is not None:
        rows.insert(1, _row("as fast as allowed, s", [_allowed(planned), _allowed(other)]))
    return joined(title, tag("table.dh.mp-table", heads, rows), _who(planned, own, other, theirs))


def _row(name: str, values: list[str | None]) -> Markup:
    return line(name, *("–" if value is None else value for value in values))


def _short(name: str) -> str:
    """Return the name of a kind of moves for the head of a column."""
    return name.removesuffix(" moves")


def _fastest_joint(planned: Planned, figures: Figures, units: Units) -> str:
    """Return the largest share of a joint's limit of velocity, and the joint."""
    i = figures.fastest_joint - 1
    name = units.variable(i, bool(planned.question.arm.revolute[i]))
    return f"{_percent(figures.velocity_share[i])} ({name})"


def _who(planned: Planned, own: Figures | None, other: Planned, theirs: Figures | None) -> Markup | None:
    """Return the sentence on which one is faster and why."""
    kind = kind_of(planned.question)
    for each, name in ((planned, KINDS[kind]), (other, OTHERS[kind])):
        if each.trouble:
            return tag("p.no", f"✕ {capitalised(name)} cannot be run through all waypoints: {each.trouble}.")
    if own is None or theirs is None or isnan(planned.least) or isnan(other.least):
        return None  # where no time keeps the limits, none is the shortest
    given = "As fast as allowed, " if planned.question.duration is not None else ""
    if same_time(planned, other):
        both = f"{given}both take {_seconds(planned.fastest)}{_affine(planned, other, own)}"
        return tag("p", capitalised(both))
    first = planned.fastest < other.fastest
    every = ((planned, KINDS[kind], own), (other, OTHERS[kind], theirs))
    (quick, name, f), (slow, slow_name, g) = every if first else every[::-1]
    text = f"{given}{name} are faster: {_seconds(quick.fastest)} instead of {_seconds(slow.fastest)}"
    if f.way > g.way * LONGER:
        text += ", although the tool goes farther"
    text = f"{capitalised(text)}."
    # In a given time the limits that are met are not those that would hold it back.
    if not given and f.binding is not None and g.binding is not None:
        text += f" {capitalised(slow_name)} are held back by {holder(g.binding)}, {name} by {holder(f.binding)}."
    return tag("p", text)


def _affine(planned: Planned, other: Planned, figures: Figures) -> str:
    # Joints that go each by itself leave the straight line of joint space.
    apart = any(move.independent for each in (planned, other) for move in each.question.moves)
    known = figures.binding is not None and planned.question.duration is None
    held = f" {capitalised(holder(figures.binding))} holds both back." if known and figures.binding else ""
    if apart or planned.question.arm.revolute.any():
        return f".{held}"
    return (
        ": all joints are prismatic, so that a straight line in joint space is a straight line of the tool, "
        "too⟦ (section 6.3.2)⟧."
        f"{held}"
    )


def peaks_table(planned: Planned, figures: Figures, units: Units) -> Markup:
    """Return the largest speed and acceleration of each joint, with their shares of the limits."""
    rows = []
    for i, turns in enumerate(map(bool, planned.question.arm.revolute)):
        cells = (
            (figures.velocity[i], figures.velocity_share[i], figures.velocity_at[i], 1),
            (figures.acceleration[i], figures.acceleration_share[i], figures.acceleration_at[i], 2),
        )
        name = tag("td", joint_mark(i), units.variable(i, turns))
        rows.append(tag("tr", name, [_peak(units, turns, *cell) for cell in cells]))
    heads = head_line("", *(head for order in (1, 2) for head in (f"max |q{DOTS[order]}|", "of limit")))
    return fold("Peaks", tag("table.dh.mp-table", heads, rows))


def _peak(units: Units, turns: bool, value: float, share: float, at: float, order: int) -> Inside:
    unit = units.unit(turns)
    size = value / units.factor(turns)
    text = f"{number(size, 3 if size < 10.0 and unit in ('rad', 'm') else 1 if size < 1000.0 else 0)} {unit}"
    of = tag("td.no", f"✕ {_percent(share)}") if share > FULL else tag("td", _percent(share))
    return tag("td", f"{text}{TIMES[order]}", title=f"at {number(at, 2)} s"), of


def legend(planned: Planned, units: Units, compared: bool) -> Markup:
    """Return the colours of the joints, and the meaning of the dashes."""
    joints = [
        tag("span", joint_mark(i), units.variable(i, bool(turns)))
        for i, turns in enumerate(planned.question.arm.revolute)
    ]
    lines = [("dashed", "limit")]
    if compared:
        lines.append(("dotted", OTHERS[kind_of(planned.question)]))
    if sum(leg.motion is not None for leg in planned.legs) > 1:
        lines.append(("upright", "next move"))
    return tag("div.legend", joints, [tag("span", _mark(kind), text) for kind, text in lines])


def _mark(kind: str) -> Markup:
    """Return a piece of a line as drawn in the plots."""
    return tag(f"i.mp-line.{kind}")


def _percent(share: float) -> str:
    return f"{trimmed(100.0 * share, 1)} %"


def _seconds(time: float) -> str:
    return f"{number(time, 2)} s"


def _allowed(planned: Planned) -> str | None:
    """Return how long it takes as fast as allowed; typed ramps are for the given time, and do not count here."""
    return None if isnan(planned.least) else _time(planned.fastest)


def _time(time: float) -> str | None:
    return None if time != time else number(time, 2)
