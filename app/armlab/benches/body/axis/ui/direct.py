"""R from axis and angle: the three steps, and dyad and skew matrix of Rodrigues' formula, in present numbers."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.body.axis.film import Steps, film_time, steps_of
from armlab.benches.body.forms.timing import DURATION, step_at
from armlab.benches.body.forms.ui.steps import factor
from armlab.kin.axis_angle import rodrigues_terms
from armlab.session.state import State
from armlab.ui.format import mathml, number, scientific
from armlab.ui.html import Inside, Markup, classes, tag
from armlab.ui.units import Units, units_of

PRODUCTS = (r"C^T", r"R_z(\theta)\,C^T", r"C\,R_z(\theta)\,C^T")

NOTES = (
    "⟦3.35 writes CᵀC for C Cᵀ: n nᵀ + s sᵀ + r rᵀ = I comes of C Cᵀ, and mixed products are missing because I has "
    "zeros beside its diagonal, though n sᵀ is not zero. In 3.41 xᵀS x is the number 0, and 3.44 is a cross product.⟧"
)


def steps_markup(state: State) -> Inside:
    """Return the steps, their matrices, and the sum that comes of them."""
    steps, time, units = steps_of(state), film_time(state), units_of(state)
    return _list(time, steps, units), _matrices(steps, time), _sum(steps), tag("p.dim", NOTES)


def _list(time: float, steps: Steps, units: Units) -> Markup:
    texts = (
        "Cᵀ carries r to z, n to x and s to y",
        f"R_z(θ) turns about z by {units.angle(steps.angle)}",
        "C carries z back to r",
    )
    now = step_at(time)
    rows = [
        tag(classes("tr", now=k == now), tag("td", str(k + 1)), tag("td", _with_index(text)))
        for k, text in enumerate(texts)
    ]
    return tag("table.kit-table.ax-steps", rows)


def _with_index(text: str) -> Inside:
    head, mark, rest = text.partition("R_z")
    return (head, "R", tag("sub", "z"), rest) if mark else text


def _matrices(steps: Steps, time: float) -> Markup:
    dyad, rest, skewed = rodrigues_terms(steps.r)
    now = step_at(time)
    there, turned, _ = steps.parts(DURATION)
    made = (there, turned @ there, steps.C @ turned @ there)[now]
    C = factor(mathml(r"C=(n\;s\;r)"), steps.C, now != 1)
    so_far = factor((mathml(PRODUCTS[now]), " = R" if now == 2 else f" after step {now + 1}"), made)
    return tag(
        "div.ax-grid",
        C,
        factor(mathml(r"R_z(\theta)"), turned, now == 1),
        so_far,
        factor(mathml(r"S(r)=s\,n^T-n\,s^T"), skewed),
        factor(mathml(r"r\,r^T"), dyad),
        factor(mathml(r"I-r\,r^T=n\,n^T+s\,s^T"), rest),
    )


def _sum(steps: Steps) -> Inside:
    """Return Rodrigues' formula with the numbers of cosine and sine, and how far it is from the three steps."""
    dyad, rest, skewed = rodrigues_terms(steps.r)
    cosine, sine = math.cos(steps.angle), math.sin(steps.angle)
    R = dyad + cosine * rest + sine * skewed
    away = float(np.abs(R - steps.at(DURATION)).max())
    return (
        tag("div.eq.small", mathml(r"R=r\,r^T+(I-r\,r^T)\cos\theta+S(r)\sin\theta")),
        tag(
            "p",
            f"cos θ = {number(cosine, 4)}, sin θ = {number(sine, 4)}. From the product of the three steps it differs "
            f"by {scientific(away)} at most. Any other n perpendicular to r gives another C and the same R.",
        ),
    )
