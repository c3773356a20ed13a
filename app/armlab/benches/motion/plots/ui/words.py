"""Sentences and tables beside the plots of a motion."""

from __future__ import annotations

from armlab.benches.motion.plan.figures import TOOL, Binding, Figures, Overrun
from armlab.benches.motion.plan.question import Planned
from armlab.benches.motion.plan.ui.joint_marks import joint_mark
from armlab.benches.motion.plan.words import exceeded_words
from armlab.benches.motion.plots.drawn import Kind, kind_of, same_time
from armlab.benches.motion.plots.ui.lines import DOTS, TIMES
from armlab.ui.format import capitalised, escaped, number, trimmed
from armlab.ui.units import Units

KINDS: dict[Kind, str] = {"joint": "joint moves", "cartesian": "Cartesian moves", "mixed": "these moves"}
OTHERS: dict[Kind, str] = {"joint": "Cartesian moves", "cartesian": "joint moves", "mixed": "the other kinds"}
"""What a plan is called, by the space of its moves, and what the one beside it."""

MOST_SENTENCES = 8

LONGER = 1.001
"""A way is called longer from so many times on."""

FULL = 1.0 + 1e-6
"""A share above is more than the limit, not rounding."""


def status(plan: Planned | None, figures: Figures | None, found: tuple[Overrun, ...]) -> str:
    """Return what is to be said before anything is plotted."""
    if plan is None:
        return '<p class="dim">The motion is being planned …</p>'
    if figures is None:
        why = escaped(capitalised(plan.trouble)) or "One waypoint is no motion. Add another on the page Plan"
        return f'<div class="verdict no"><b>✕ There is nothing to plot.</b>{why}.</div>'
    parts = []
    if plan.trouble:
        why = escaped(capitalised(plan.trouble))
        parts.append(f'<div class="verdict no"><b>✕ Only the moves before can be run, and are plotted.</b>{why}.</div>')
    if every := exceeded_words(plan):
        shown = [f"<p>✕ {capitalised(text)}.</p>" for text in every[:MOST_SENTENCES]]
        if len(every) > MOST_SENTENCES:
            shown.append(f"<p>✕ And so on, {len(every) - MOST_SENTENCES} more.</p>")
        many = max(len(found), len(every))
        head = "A limit is exceeded." if many == 1 else f"{many} limits are exceeded."
        within = f"Within the limits this way takes {_seconds(plan.fastest)}."
        parts.append(f'<div class="verdict no mp-over"><b>✕ {head}</b>{"".join(shown)}{within}</div>')
    elif not plan.trouble:
        kept = _kept(plan, figures)
        parts.append(f'<div class="verdict ok"><b>✓ All limits are kept.</b>{kept}</div>')
    return "".join(parts)


def _kept(plan: Planned, figures: Figures) -> str:
    if figures.binding is not None:
        return f"{capitalised(holder(figures.binding))} keeps the motion from being faster."
    return f"None is met: as fast as allowed the motion takes {_seconds(plan.fastest)}."


def holder(binding: Binding) -> str:
    """Return the limit that holds a motion back, in words."""
    if binding.joint == TOOL:
        return "the speed limit of the tool"
    return f"the {binding.quantity} limit of joint {binding.joint}"


def comparison(plan: Planned, own: Figures | None, other: Planned | None, theirs: Figures | None, units: Units) -> str:
    """Return both kinds of moves side by side, and who is faster and why.

    Parameters
    ----------
    plan : Planned
    own : Figures or None
    other : Planned or None
        None while it is not ready.
    theirs : Figures or None
    units : Units
    """
    kind = kind_of(plan.question)
    names = capitalised(KINDS[kind]), capitalised(OTHERS[kind])
    if other is None:
        return f'<h3>{names[0]} and {OTHERS[kind]}</h3><p class="dim">…</p>'
    heads = f"<th>{_mark('full')}{_short(names[0])}</th><th>{_mark('dotted')}{_short(names[1])}</th>"
    both, length = (own, theirs), units.length_unit
    rows = [
        _row("duration, s", [None if f is None else _time(p.duration) for p, f in ((plan, own), (other, theirs))]),
        _row(f"way, {length}", [None if f is None else units.text(f.way, False) for f in both]),
        _row(f"tool speed, {length}/s", [None if f is None else units.text(f.tool_speed, False) for f in both]),
        _row("joint speed", [None if f is None else _fastest_joint(plan, f, units) for f in both]),
    ]
    if plan.question.duration is not None:
        rows.insert(1, _row("within limits, s", [_time(plan.fastest), _time(other.fastest)]))
    table = f'<table class="dh mp-table"><tr><th></th>{heads}</tr>{"".join(rows)}</table>'
    return f"<h3>{names[0]} and {OTHERS[kind]}</h3>{table}{_who(plan, own, other, theirs)}"


def _row(name: str, values: list[str | None]) -> str:
    cells = "".join(f"<td>{'–' if value is None else value}</td>" for value in values)
    return f"<tr><td>{name}</td>{cells}</tr>"


def _short(name: str) -> str:
    """Return the name of a kind of moves for the head of a column."""
    return name.removesuffix(" moves")


def _fastest_joint(plan: Planned, figures: Figures, units: Units) -> str:
    """Return the share of its limit at which the joint runs that comes nearest to it, and which joint that is."""
    i = figures.fastest_joint - 1
    name = units.variable(i, bool(plan.question.arm.revolute[i]))
    return f"{_percent(figures.velocity_share[i])} ({name})"


def _who(plan: Planned, own: Figures | None, other: Planned, theirs: Figures | None) -> str:
    """Return the sentence that says who is faster and why."""
    kind = kind_of(plan.question)
    for each, name in ((plan, KINDS[kind]), (other, OTHERS[kind])):
        if each.trouble:
            why = escaped(each.trouble)
            return f'<p class="no">✕ {capitalised(name)} cannot be run through all waypoints: {why}.</p>'
    if own is None or theirs is None:
        return ""
    if same_time(plan, other):
        why = _affine(plan, own)
        return f"<p>Both take {_seconds(plan.fastest)}{why}</p>"
    first = plan.fastest < other.fastest
    every = ((plan, KINDS[kind], own), (other, OTHERS[kind], theirs))
    (quick, name, f), (slow, slow_name, g) = every if first else every[::-1]
    given = "Within the limits " if plan.question.duration is not None else ""
    text = f"{given}{name} are faster: {_seconds(quick.fastest)} instead of {_seconds(slow.fastest)}"
    if f.way > g.way * LONGER:
        text += ", although the tool goes farther"
    text = f"<p>{capitalised(text)}."
    # In a given time the limits that are met are not those that would hold it back.
    if not given and f.binding is not None and g.binding is not None:
        text += f" {capitalised(slow_name)} are held back by {holder(g.binding)}, {name} by {holder(f.binding)}."
    return f"{text}</p>"


def _affine(plan: Planned, figures: Figures) -> str:
    arm = plan.question.arm
    known = figures.binding is not None and plan.question.duration is None
    held = f" {capitalised(holder(figures.binding))} holds both back." if known and figures.binding else ""
    if arm.revolute.any():
        return f".{held}"
    return (
        ": all joints slide, so that a straight line in joint space is a straight line of the tool (section 6.3.2)."
        f"{held}"
    )


def peaks_table(plan: Planned, figures: Figures, units: Units) -> str:
    """Return the largest speed and acceleration of each joint, with their shares of the limits."""
    rows = []
    for i, turns in enumerate(map(bool, plan.question.arm.revolute)):
        cells = (
            (figures.velocity[i], figures.velocity_share[i], figures.velocity_at[i], 1),
            (figures.acceleration[i], figures.acceleration_share[i], figures.acceleration_at[i], 2),
        )
        shown = "".join(_peak(units, turns, *cell) for cell in cells)
        rows.append(f"<tr><td>{joint_mark(i)}{units.variable(i, turns)}</td>{shown}</tr>")
    heads = "".join(f"<th>max |q{DOTS[order]}|</th><th>of limit</th>" for order in (1, 2))
    return f'<h3>Peaks</h3><table class="dh mp-table"><tr><th></th>{heads}</tr>{"".join(rows)}</table>'


def _peak(units: Units, turns: bool, value: float, share: float, at: float, order: int) -> str:
    unit = units.unit(turns)
    size = value / units.factor(turns)
    text = f"{number(size, 3 if size < 10.0 and unit in ('rad', 'm') else 1 if size < 1000.0 else 0)} {unit}"
    over = ' class="no"' if share > FULL else ""
    sign = "✕ " if share > FULL else ""
    return f'<td title="at {number(at, 2)} s">{text}{TIMES[order]}</td><td{over}>{sign}{_percent(share)}</td>'


def legend(plan: Planned, units: Units, compared: bool) -> str:
    """Return which colour is which joint, and what the dashes mean."""
    joints = [
        f"<span>{joint_mark(i)}{units.variable(i, bool(turns))}</span>"
        for i, turns in enumerate(plan.question.arm.revolute)
    ]
    lines = [("dashed", "limit")]
    if compared:
        lines.append(("dotted", OTHERS[kind_of(plan.question)]))
    if sum(leg.motion is not None for leg in plan.legs) > 1:
        lines.append(("upright", "next move"))
    marks = [f"<span>{_mark(kind)}{text}</span>" for kind, text in lines]
    return f'<div class="legend">{"".join([*joints, *marks])}</div>'


def _mark(kind: str) -> str:
    """Return a piece of a line as it is drawn in the plots."""
    return f'<i class="mp-line {kind}"></i>'


def _percent(share: float) -> str:
    return f"{trimmed(100.0 * share, 1)} %"


def _seconds(time: float) -> str:
    return f"{number(time, 2)} s"


def _time(time: float) -> str | None:
    return None if time != time else number(time, 2)
