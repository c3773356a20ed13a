"""Actuators and motors compared by numbers, with their sources."""

from __future__ import annotations

from functools import partial

from armlab.benches.drive.power.compared import BY_KIND, COMPARISONS, COMPUTED, SOURCES, TYPICAL, Number
from armlab.benches.drive.power.state import COMPARED, Power
from armlab.session.fields import Set
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, classes, tag
from armlab.ui.tables import head_line

MARKS = {TYPICAL: "t", COMPUTED: "c", BY_KIND: ""}
"""Marks of numbers without a source of their own."""

SHORT = 12
"""Largest number of characters of a number that stays on one line with its unit."""


def comparison_markup(form: Form, part: Power) -> Inside:
    """Return the choice of a comparison, its table, what follows, and the sources."""
    shown = COMPARISONS[part.compared]
    chips = form.chips("compared", COMPARED, part.compared, "What is compared", partial(Set, Power, "compared"))
    rows = [tag("tr", tag("th", what), [tag("td", _number(each)) for each in values]) for what, values in shown.rows]
    used = sorted({each.source for _, values in shown.rows for each in values if each.source in SOURCES})
    sources = [tag("li", tag("sup", str(key)), " ", SOURCES[key], ".") for key in used]
    return (
        tag("div.cases.pw-chosen", chips),
        tag("table.pw-compared", head_line("", *shown.kinds), rows),
        tag("p", shown.says),
        tag(
            "ul.pw-sources",
            tag("li", tag("sup", "t"), " typical of the trade: right in its order of magnitude."),
            tag("li", tag("sup", "c"), " computed by the lab, from a closed form or from the other numbers."),
            sources,
        ),
    )


def _number(number: Number) -> Markup:
    mark = MARKS.get(number.source, str(number.source))
    return tag(
        classes("span", **{"pw-short": len(number.text) <= SHORT}), number.text, tag("sup", mark) if mark else None
    )
