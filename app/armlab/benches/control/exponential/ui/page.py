"""The matrix exponential of 2 x 2 matrices: by its series, by eigenvectors and by SciPy, and the curve in the plane."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from armlab.benches.control.exponential.examples import EXAMPLES, ChooseExponentialExample
from armlab.benches.control.exponential.state import (
    ENTRIES,
    MOST_TERMS,
    Exponential,
    Found,
    MoveTime,
    SetEntry,
    SumTerms,
    bounds,
)
from armlab.benches.control.exponential.ui.large import LargePlane
from armlab.benches.control.exponential.ui.plane import EIGEN, plane
from armlab.session.amounts import amount
from armlab.session.parts.notation import Notation
from armlab.session.state import Post, State
from armlab.ui.colours import BLUE, GREY, css
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import capitalised, dot, mathml, number, readable, scientific, so_many
from armlab.ui.html import Inside, Markup, classes, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.matrices import copy_buttons
from armlab.ui.plot import Curve, Plot
from armlab.ui.plugin import Panel, Show
from armlab.ui.tables import line
from armlab.ui.units import plain_number
from armlab.ui.widgets import Gui

Array = NDArray[np.float64]

SYSTEM, EXPONENTIAL = r"\dot x=Ax,\quad x(t)=e^{At}x(0)", "e^{At}"
SERIES, PRODUCT, PRINTED = r"\sum_k\frac{(At)^k}{k!}", r"T\,e^{\Lambda t}\,T^{-1}", r"T^{-1}e^{\Lambda t}\,T"

DECIMALS, WIDEST = 4, 1e4
"""Decimals of an entry, and the size from which it is written with a power of ten."""

FLOOR, LOWEST = 1e-17, -17.5
"""Smallest error that is drawn as it is, because 0 has no logarithm, and the logarithm at which the plot ends."""

FEWEST = 12
"""Least number of terms in the plot."""

STEPS = 500
"""Number of steps of the slider of t."""

SEEN = 5e-4
"""Difference of the printed formula below which none is shown."""

KINDS = {"good": "ok", "poor": "warn", "none": "no"}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the matrix, the sliders, the picture, the three results and the plot of the errors."""
    head = gui.form(post)
    end = state[Exponential].end
    time = gui.slider("t, s", 0.0, end, end / STEPS, 0.0, lambda t: post(MoveTime(t)), None)
    terms = gui.slider("terms", 1.0, MOST_TERMS, 1.0, 4.0, lambda count: post(SumTerms(round(count))), None)
    drawn, results = gui.form(post), gui.html()
    large = LargePlane(gui)
    with gui.fold("Error over the number of terms"):
        plot = _ErrorPlot(gui)

    def show(state: State) -> None:
        part = state[Exponential]
        head.show(head_markup(head, part))
        if time.handle.max != part.end:
            time.handle.max, time.handle.step = part.end, part.end / STEPS
        time.show(part.t)
        terms.show(float(part.terms))
        large.show_part(part)
        heading = tag("h3", "The curve in the plane", tag("span.copies", large.button(drawn)))
        drawn.show(heading, plane(part), _eigen(part.found))
        results.show(results_markup(part))
        plot.show_part(part)

    return show


class _ErrorPlot(Plot):
    """The errors of the sums, and their bound, over the number of terms."""

    def __init__(self, gui: Gui) -> None:
        curves = [Curve("log₁₀ of the error", BLUE), Curve("log₁₀ of its bound", GREY, 1.2, dash=(4, 3))]
        title = tag("span", "log₁₀ of the error (grey: bound)")
        super().__init__(gui, title, "terms of the series", curves, "series_error", legend=False)
        self._part: Exponential | None = None

    def show_part(self, part: Exponential) -> None:
        """Show the curves if they have changed, and mark the present number of terms."""
        if part != self._part:
            self._part = part
            self._draw(part)
        self.cursor(float(part.terms))

    def _draw(self, part: Exponential) -> None:
        bound, errors = bounds(part), part.found.errors
        enough = int(np.argmax(bound < FLOOR)) if (bound < FLOOR).any() else MOST_TERMS
        count = min(max(enough, part.terms, FEWEST) + 1, MOST_TERMS)
        error = np.log10(np.maximum(errors, FLOOR))[:count]
        above = np.full(count, np.nan)
        known = np.isfinite(bound[:count])
        above[known] = np.log10(np.maximum(bound[:count][known], FLOOR))
        # The page cannot choose ranges where curves have ends.
        most = float(np.nanmax(np.concatenate([error, above])))
        scales = {"x": {"time": False, "range": (1.0, float(count))}, "y": {"range": (LOWEST, most + 1.0)}}
        if self._handle.scales != scales:
            self._handle.scales = scales
        self.show(np.arange(1.0, count + 1.0), [error, above])


def _with_powers(text: str) -> Markup:
    """Return a text in which what stands after a caret is an exponent."""
    parts = re.split(r"\^(\S+)", text)  # texts, and the exponents between them
    return joined(tag("sup", part) if i % 2 else part for i, part in enumerate(parts))


def head_markup(form: Form, part: Exponential) -> Markup:
    """Return the choice of an example, and the fields of matrix, start and end."""
    chooser = examples(form, EXAMPLES, part.example, ChooseExponentialExample, written=_with_powers)
    values = {"x1": part.x0[0], "x2": part.x0[1], "end": part.end}
    values |= {f"a{i + 1}{j + 1}": part.A[i][j] for i in (0, 1) for j in (0, 1)}

    def cell(key: str) -> Markup:
        return form.field(
            key, readable(values[key], 4), ENTRIES[key], lambda text: SetEntry(key, plain_number(text, ENTRIES[key]))
        )

    typed = tag(
        "div.exp-typed",
        tag("span", "A ="),
        tag("table.mat", [line(cell(f"a{i}1"), cell(f"a{i}2")) for i in (1, 2)]),
        tag("i", "1/s"),
        tag("span", "x(0) ="),
        tag("table.mat", [line(cell(key)) for key in ("x1", "x2")]),
        tag("label", tag("span", "until"), cell("end"), tag("i", "s")),
    )
    system = tag("div.eq.small", "\N{EM SPACE}", mathml(SYSTEM), title="⟦Notes 1.50-1.52, 1.58 corrected⟧")
    return joined(chooser, system, typed)


def results_markup(part: Exponential) -> Markup:
    """Return the three results below each other, each with its difference from SciPy's."""
    found = part.found
    count = f"{so_many(part.terms, 'term')} of ", mathml(SERIES)
    series = float(found.errors[part.terms - 1])
    rows = [_result(count, found.sums[part.terms - 1], f"largest error {scientific(series)}")]
    if found.product is None:
        rows.append(_result(mathml(PRODUCT), None, "T has no inverse"))
    else:
        off = float(np.abs(found.product - found.whole).max())
        rows.append(_result(mathml(PRODUCT), found.product, f"largest error {scientific(off)}"))
    rows.append(_result("SciPy", found.whole, "reference"))
    kind = KINDS[found.basis.basis]
    said = capitalised(found.basis.says)
    printed = None
    if found.printed is not None:
        off_by = (
            (f"here with a largest error of {number(found.printed, 3)}")
            if found.printed >= SEEN
            else "the same with this T"
        )
        printed = tag("p", "⟦Notes 1.58 print ", mathml(PRINTED), f": {off_by}.⟧")
    copies = tag("span.copies", copy_buttons(found.whole))
    title = tag("h3", mathml(EXPONENTIAL), f" at t = {amount(part.t, 's')}", copies)
    return joined(title, rows, verdict_box(kind, _condition(found), f"{said}.", printed))


def _condition(found: Found) -> str:
    condition = found.basis.condition
    text = number(condition, 1) if condition < WIDEST else scientific(condition)
    return f"cond(T) = {text if found.basis.basis != 'none' else '∞'}"


def _result(name: Inside, values: Array | None, said: str) -> Markup:
    matrix = None if values is None else _matrix(values)
    return tag("div.exp-result", tag("div", name, tag("p.dim", said)), matrix)


def _matrix(values: Array) -> Markup:
    def cell(value: float) -> Markup:
        zero = abs(value) < 0.5 * 10.0**-DECIMALS
        text = "0" if zero else number(value, DECIMALS) if abs(value) < WIDEST else scientific(value, 3)
        return tag(classes("td", zero=zero), text)

    return tag("table.mat", [tag("tr", [cell(float(value)) for value in row]) for row in values])


def _eigen(found: Found) -> Markup:
    """Return eigenvalues, and real eigenvectors with the colours of their lines."""
    basis = found.basis
    if not basis.real:
        real, imaginary = float(basis.values[0].real), abs(float(basis.values[0].imag))
        return tag("p.dim", f"λ₁,₂ = {amount(real)} ± {amount(imaginary)} j, 1/s; complex eigenvectors.")
    if basis.basis == "none" and basis.values[0] == basis.values[1]:
        vector = ", ".join(number(float(value), 3) for value in basis.T.real[:, 0])
        value = amount(float(basis.values[0].real), "1/s")
        double = f"λ₁ = λ₂ = {value}, a double eigenvalue with one eigenvector: v = ({vector})"
        return tag("p.exp-eigen", dot(css(EIGEN[0])), double)
    said = []
    for i in (0, 1):
        value = amount(float(basis.values[i].real), "1/s")
        vector = ", ".join(number(float(part), 3) for part in basis.T.real[:, i])
        said.append(joined(dot(css(EIGEN[i])), f"λ{'₁₂'[i]} = {value}, v = ({vector})"))
    return tag("p.exp-eigen", joined(said, between=tag("br")))


PANEL = Panel((Exponential,), build, rebuilds=(Notation,), apart=True)
