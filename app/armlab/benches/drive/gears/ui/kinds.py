"""The view of kinds of transmissions: a table with typical numbers, and more of the kind that is chosen."""

from __future__ import annotations

from functools import partial

from armlab.benches.drive.gears.kinds import KINDS
from armlab.benches.drive.gears.state import Gears
from armlab.session.fields import Set
from armlab.ui.form import Form
from armlab.ui.html import Inside, classes, tag
from armlab.ui.tables import head_line


def kinds_markup(form: Form, part: Gears) -> Inside:
    """Return the table, whose names are buttons, and what is said of the chosen kind."""
    chosen = KINDS[part.kind] if part.kind in KINDS else next(iter(KINDS.values()))
    rows = []
    for key, kind in KINDS.items():
        name = form.button(f"kind {key}", kind.title, partial(_choose, key), "gr-kind", pressed=key == chosen.key)
        cells = [tag("td", text) for text in (kind.ratio, kind.efficiency, kind.play, kind.drives_back)]
        rows.append(tag(classes("tr", now=key == chosen.key), tag("th", name), cells))
    return (
        tag("table.kit-points.gr-kinds", head_line(None, "ratio", "η, %", "backlash", "back-drivable"), rows),
        tag("p.dim", "Typical for machines of the size of a robot arm, of one stage; ′ is a minute of arc, 1/60°."),
        tag("h3", chosen.title),
        tag("p", chosen.use),
        tag("p", tag("b", "Trouble: "), chosen.trouble),
    )


def _choose(key: str) -> Set:
    return Set(Gears, "kind", key)
