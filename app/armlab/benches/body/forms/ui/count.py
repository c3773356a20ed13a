"""How many numbers each form of a rotation has, how many conditions they fulfil, and where it is singular."""

from __future__ import annotations

import numpy as np

from armlab.benches.body.forms.rotation import forms_of
from armlab.session.state import State
from armlab.ui.format import mathml, scientific
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold
from armlab.ui.tables import head_line, line

FORMS: tuple[tuple[str, int, int, str], ...] = (
    ("matrix R", 9, 6, "nowhere"),
    ("axis, angle", 4, 1, "θ = 0: any r"),
    ("quaternion", 4, 1, "nowhere; q and −q"),
    ("three angles", 3, 0, "gimbal lock"),
)
"""Forms, with how many numbers and conditions they have, and where they do not determine each other."""

CONDITIONS = "Six conditions: three columns of length 1, and three right angles between them."


def count_markup(state: State) -> Markup:
    """Return the table, folded, with how well the present matrix and quaternion fulfil their conditions."""
    found = state.derived(forms_of)
    off = float(np.abs(found.R.T @ found.R - np.eye(3)).max())
    rows = [
        line(str(numbers), str(rules), str(numbers - rules), where, name=name) for name, numbers, rules, where in FORMS
    ]
    heads = head_line(None, "numbers", "conditions", "free", "singular")
    said: Inside = (
        f"{CONDITIONS} At present RᵀR differs from I by {scientific(off)} at most. ",
        "The rotations, ",
        mathml("SO(3)"),
        ", are a manifold of three dimensions⟦ (section 3.3)⟧: near each rotation three numbers are enough, but no "
        "three numbers describe all of them without a singular place.",
    )
    return fold("How many numbers", tag("table.kit-table.bo-count", heads, rows), tag("p.dim", said))
