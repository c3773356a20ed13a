"""The eigenvalues of R on the unit circle, and the axis as the eigenvector of 1."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.body.axis.inverse import Inverse, inverse_of
from armlab.benches.body.forms.rotation import Forms, forms_of
from armlab.kin.axis_angle import eigenvalue_equation
from armlab.session.state import State
from armlab.ui import svg
from armlab.ui.format import MINUS, components, mathml, number, scientific
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.units import units_of

SIZE, RADIUS = 210.0, 76.0
"""Width and height of the picture, and radius of the circle in it, pixels."""

ARC = 0.34
"""Radius of the arc of the angle, in radii of the circle."""


def eigen_markup(state: State) -> Inside:
    """Return the circle, the equation of the eigenvalues, and the eigenvectors."""
    found, inverse = state.derived(forms_of), inverse_of(state)
    angle, units = inverse.angle, units_of(state)
    cosine, sine = math.cos(angle), math.sin(angle)
    _, middle, _ = eigenvalue_equation(angle)
    sign = "+" if middle >= 0.0 else MINUS
    roots = f"{number(cosine, 4)} ± {number(abs(sine), 4)} i"
    printed = abs(complex(cosine, sine) ** 2 + 2.0 * cosine * complex(cosine, sine) + 1.0)
    return (
        tag("div.ax-circle", circle(angle, f"1 and e to the ±i {units.angle(angle)}")),
        tag("div.eq.small", mathml(r"\det(R-\lambda I)=-(\lambda-1)(\lambda^2-2\cos\theta\,\lambda+1)")),
        tag(
            "p",
            f"λ² {sign} {number(abs(middle), 4)} λ + 1 = 0 has the roots {roots}. "
            f"The trace is 1 + 2 cos θ = {number(1.0 + 2.0 * cosine, 4)}."
            f"⟦ 3.60 prints +2 cos θ λ, which leaves {number(printed, 4)} in place of 0 for λ = eⁱᶿ.⟧",
        ),
        _vectors(found, inverse),
    )


def _vectors(found: Forms, inverse: Inverse) -> Markup:
    if inverse.still:
        return tag(
            "p", "R = I: all three eigenvalues are 1, and every vector is an eigenvector: there is no axis to find."
        )
    kept = float(np.abs(found.R @ found.axis - found.axis).max())
    said = f"R r = r for r = ({components(found.axis)}): the largest difference of a component is {scientific(kept)}. "
    if inverse.half:
        return tag(
            "p", said, "At half a turn both other eigenvalues are −1, and every vector perpendicular to r is one."
        )
    return tag("p", said, "The other two eigenvectors are complex: no other direction of space is kept.")


def circle(angle: float, label: str) -> Markup:
    """Return the unit circle with the eigenvalues 1 and exp(±i angle)."""
    middle = SIZE / 2.0

    def at(turned: float, radius: float = RADIUS) -> tuple[float, float]:
        return middle + radius * math.cos(turned), middle - radius * math.sin(turned)

    (x, y), (x_low, y_low) = at(angle), at(-angle)
    arc_x, arc_y = at(angle, ARC * RADIUS)
    name_x, name_y = at(angle / 2.0, (ARC + 0.17) * RADIUS)
    start = middle + ARC * RADIUS
    arc = f"M{start:.1f} {middle:.1f}A{ARC * RADIUS:.1f} {ARC * RADIUS:.1f} 0 0 0 {arc_x:.1f} {arc_y:.1f}"
    # Above and below the points, where neither the circle nor an axis is.
    high = -9.0 if angle < math.pi - 0.3 else -14.0
    shapes = [
        svg.line("ax-axis", 6.0, middle, SIZE - 6.0, middle),
        svg.line("ax-axis", middle, 6.0, middle, SIZE - 6.0),
        svg.circle("ax-unit", middle, middle, RADIUS),
        svg.line("ax-ray", middle, middle, x, y),
        svg.line("ax-ray", middle, middle, x_low, y_low),
        svg.path("ax-arc", arc),
        svg.text("", name_x, name_y + 4.0, "θ", "middle"),
        svg.text("", SIZE - 6.0, middle - 6.0, "Re", "end"),
        svg.text("", middle + 6.0, 14.0, "Im"),
        svg.circle("ax-one", *at(0.0), 5.0),
        svg.text("", at(0.0)[0] + 9.0, middle + 16.0, "1"),
        svg.circle("ax-value", x, y, 5.0),
        svg.circle("ax-value", x_low, y_low, 5.0),
        svg.text("", x, y + high, "eⁱᶿ", "middle"),
        svg.text("", x_low, y_low - high + 8.0, "e⁻ⁱᶿ", "middle"),
    ]
    return svg.drawing("", SIZE, SIZE, label, shapes)
