"""The algebra of two quaternions in present numbers, and the quaternion of a matrix by three methods."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.quaternion.film import second
from armlab.benches.body.quaternion.from_matrix import METHODS, found_of
from armlab.kin.quaternions import exponential, inverse, logarithm, product
from armlab.session.state import State
from armlab.ui.format import mathml, matrix, number, scientific
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.tables import head_line, line

COMPONENTS = ("w", "x", "y", "z")

EXACT = 1e-9
"""Difference of an entry up to which a quaternion is that of the matrix."""

RULES = (r"q^{-1}=(\eta,-\epsilon)/|q|^2", r"\ln q=(\ln|q|,\;\tfrac{\theta}{2}\,r)")

SIGNS = (
    r"\eta=\tfrac12\sqrt{1+r_{11}+r_{22}+r_{33}}",
    r"\epsilon_y=\tfrac12\,\mathrm{sign}(r_{13}-r_{31})\sqrt{1-r_{11}+r_{22}-r_{33}}",
)


def numbers(values: np.ndarray) -> list[str]:
    """Return the components of a quaternion."""
    return [number(float(value), 4) for value in values]


def inverse_markup(state: State) -> Inside:
    """Return inverses and logarithms of both quaternions, and how well they undo what they should."""
    p, q = second(state), state.derived(forms_of).q
    rows = [
        line(*numbers(each), name=name)
        for name, each in (
            ("p⁻¹", inverse(p)),
            ("q⁻¹", inverse(q)),
            ("ln q", logarithm(q)),
            ("p⁻¹ q", product(inverse(p), q)),
        )
    ]
    undone = float(np.abs(product(q, inverse(q)) - [1.0, 0.0, 0.0, 0.0]).max())
    again = float(np.abs(exponential(logarithm(q)) - q).max())
    said = f"q q⁻¹ = 1 and exp(ln q) = q, with differences of {scientific(undone)} and {scientific(again)} at most."
    return (
        tag("h3", "Inverse and logarithm"),
        tag("div.eq.small", mathml(RULES[0]), tag("br"), mathml(RULES[1])),
        tag("table.kit-points.bo-angles", head_line(None, *COMPONENTS), rows),
        tag("p.dim", f"{said} ln q is half of the rotation vector; p⁻¹ q leads from p to q."),
    )


def from_matrix_markup(state: State) -> Inside:
    """Return the quaternion of R by roots and signs, with a slip, and by the largest component."""
    found = found_of(state)
    rows = []
    for key, title in METHODS.items():
        each = found[key]
        rows.append(tag("tr", tag("th", title, colspan=4)))
        rows.append(line(*numbers(each.q), scientific(each.off)))
    return (
        tag("div.bo-product", "R = ", matrix(state.derived(forms_of).R, 4)),
        tag("div.eq.small", mathml(SIGNS[0]), tag("br"), mathml(SIGNS[1])),
        tag("table.kit-points.bo-angles.qu-methods", head_line(*COMPONENTS, "R(q) − R"), rows),
        _verdict(state),
    )


def _verdict(state: State) -> Markup:
    """Return which methods fail here, and why."""
    found, angle = found_of(state), abs(state.derived(forms_of).angle)
    q = found["largest"].q
    # Where y is zero its root is rounding, which has no sign to be wrong.
    signs, slip = found["signs"].off > EXACT, found["slip"].off > EXACT and abs(q[2]) > EXACT
    if signs:
        why = (
            "Near half a turn R is nearly symmetric: the differences of which the signs are taken are zero or rounding "
            "errors⟦; 3.77–3.79 then give no unit quaternion⟧. The largest component never vanishes, and the others "
            "are sums and differences divided by it."
        )
        return verdict_box("warn", "Roots and signs fail here", tag("p", why))
    if slip:
        why = "The sign of y is taken of r₁₃ − r₃₂ in place of r₁₃ − r₃₁⟦, as 3.78 prints it⟧: another rotation."
        return verdict_box("warn", "A wrong index gives another rotation", tag("p", why))
    return verdict_box("ok", "All three are the quaternion of R", tag("p", _unseen(q, angle)))


def _unseen(q: NDArray[np.float64], angle: float) -> str:
    """Return why a wrong sign of y is not seen."""
    if angle <= EXACT:
        return "Without a rotation all agree."
    same = "y is zero, so its sign does not count." if abs(q[2]) <= EXACT else "both signs are the same."
    return f"The slip is not seen here: {same}"
