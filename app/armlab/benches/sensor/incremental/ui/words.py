"""Rules of counting beside one another, and what is to be said of the count."""

from __future__ import annotations

from armlab.benches.sensor.incremental.counting import Now, electrical_angle
from armlab.benches.sensor.incremental.state import RULES, Incremental
from armlab.kin.sensors.quadrature import DECODERS
from armlab.session.fields import Set
from armlab.ui.form import Form
from armlab.ui.format import capitalised, mathml, pairs, so_many, trimmed
from armlab.ui.html import Inside, Markup, classes, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.tables import head_line
from armlab.ui.units import Units

SHORT = {"x1": "×1", "x2": "×2", "x2_notes": "×2 A↑B↑", "x4": "×4", "rising": "A↑, B", "alone": "A↑"}
"""Rules in few letters."""

WHY = {
    "rising": "On the way back A rises at another edge of its window than on the way there, and the one over which the "
    "disk came is not counted back.",
    "alone": "The rising edges of A alone do not tell the direction.",
}
"""Reasons for wrong counts."""


def signed(count: int) -> str:
    """Return a number of counts with its sign."""
    return f"{count:+d}".replace("-", "−") if count else "0"


def rules_markup(form: Form, part: Incremental, found: Now, units: Units) -> Markup:
    """Return the rules with D, AR, the gaps between counts, the present count, and what is wrong with it."""
    rows = []
    for key, counted in found.counted.items():
        decoder = DECODERS[key]
        chip = form.chip(
            f"decoder {key}",
            SHORT[key],
            Set(Incremental, "decoder", key),
            capitalised(decoder.title),
            key == part.decoder,
        )
        gaps = "/".join(dict.fromkeys(units.entry(gap, True) for gap in decoder.gaps))
        cells = [str(counted.per_period), units.entry(counted.resolution, True, 2), gaps, signed(counted.count)]
        wrong = tag(classes("td", **{"ab-wrong": counted.missed != 0}), signed(counted.missed))
        rows.append(tag(classes("tr", now=key == part.decoder), tag("td", chip), [tag("td", c) for c in cells], wrong))
    head = head_line("counted", "D", f"AR, {units.angle_unit}", f"gaps, {units.angle_unit} el.", "count", "wrong by")
    return tag("table.kit-table.in-rules", head, rows)


def resolution_markup(part: Incremental, found: Now, units: Units) -> Markup:
    """Return the angle of a count by its formula."""
    counted = found.counted[part.decoder]
    turn = units.turn_in_latex
    formula = rf"AR=\frac{{{turn}}}{{\mathrm{{PPR}}\cdot D}}=\frac{{{turn}}}{{{part.pulses}\cdot {counted.per_period}}}"
    value = units.constant(counted.resolution, True, 3)
    said = "Angle of one count⟦; notes 2.45. The text before 2.44 calls it pulses per round⟧"
    return tag("span.ab-width", mathml(formula), f" = {value}", title=said)


def verdict(part: Incremental, found: Now, units: Units) -> Markup:
    """Return whether the chosen count is right, and why not."""
    counted, decoder = found.counted[part.decoder], DECODERS[part.decoder]
    angle = units.constant(counted.angle, True, 2)
    are = "is" if abs(counted.count) == 1 else "are"
    number = str(counted.count).replace("-", "−")
    told = f"{so_many(number, 'count')} of {units.constant(counted.resolution, True, 3)} {are} {angle}."
    if counted.missed:
        by = units.constant(counted.missed * counted.resolution, True, 2)
        return verdict_box("no", f"Wrong by {so_many(signed(counted.missed), 'count')}, {by}", f"{told} {_why(part)}")
    if decoder.unevenness:
        gaps = " and ".join(units.constant(gap, True, 0) for gap in decoder.gaps)
        more = trimmed(1.0 + decoder.unevenness, 2)
        return verdict_box(
            "warn",
            "Right, but uneven",
            f"{told} Counts lie {gaps} electrical apart: a step may be {more} times as large as AR says.",
        )
    return verdict_box("ok", "No count is missing", f"{told} {_lasting(part, found)}")


def _why(part: Incremental) -> str:
    if part.rule == "same":
        return "Both orders of the edges are taken for one direction: what comes back is counted up."
    return WHY.get(part.decoder, "")


def _lasting(part: Incremental, found: Now) -> str:
    if part.index and found.found:
        return "Since Z has come by, that is the angle itself, up to whole turns."
    return "That is the way from the start; where the start is, only Z tells."


def state_markup(part: Incremental, found: Now, units: Units) -> Markup:
    """Return where the disk stands, and in which direction it has turned."""
    directions = {1: "A before B: positive", -1: "B before A: negative", 0: "no edge yet"}
    electrical = units.angle(electrical_angle(part, found.angle))
    rows: list[tuple[Inside, Inside]] = [
        ("Angle of the disk", units.constant(found.angle, True, 2)),
        ("Electrical angle", (electrical, f" of period {int(found.quarter // 4) % part.pulses}")),
        ("At the last edge", directions[found.direction]),
    ]
    return pairs(rows)


def rule_markup(form: Form, part: Incremental) -> Markup:
    """Return the choice of what both orders of the edges are taken for."""
    chips = form.chips(
        "rule",
        RULES,
        part.rule,
        "Directions of A before B and of B before A",
        lambda key: Set(Incremental, "rule", key),
    )
    return joined(
        tag("div.se-line", "Directions of A before B and B before A: ", chips),
        tag(
            "p.dim",
            "The order in which the edges come is the only thing that tells the direction, so that the two orders are "
            "the two directions.⟦ The text before 2.42 prints “clockwise” for both: choose one direction, turn there "
            "and back, and see what is left.⟧",
        ),
    )
