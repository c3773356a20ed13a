"""The matrix exponential of 2 x 2 matrices: by its series, by eigenvectors and by SciPy, and the curve in the plane."""

from __future__ import annotations

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
from armlab.benches.control.exponential.ui.plane import EIGEN, plane
from armlab.session.amounts import amount
from armlab.session.state import Post, State
from armlab.ui.colours import BLUE, GREY, css
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import capitalised, dot, escaped, mathml, number, readable, scientific
from armlab.ui.markup import SIGNS
from armlab.ui.matrices import copy_buttons
from armlab.ui.plot import Curve, Plot
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import plain_number
from armlab.ui.widgets import Gui

Array = NDArray[np.float64]

SYSTEM, EXPONENTIAL = r"\dot x=Ax,\quad x(t)=e^{At}x(0)", "e^{At}"
SERIES, PRODUCT, PRINTED = r"\sum_k\frac{(At)^k}{k!}", r"T\,e^{\Lambda t}\,T^{-1}", r"T^{-1}e^{\Lambda t}\,T"

DECIMALS, WIDEST = 4, 1e4
"""Of entries, and from where on they have a power of ten."""

FLOOR, LOWEST = 1e-17, -17.5
"""Errors that are smaller are drawn here, for the logarithm of 0 is not a number; and the lower end of the plot."""

FEWEST = 12
"""Terms that are in the plot at least."""

STEPS = 500
"""Of the slider of t."""

SEEN = 5e-4
"""A difference of the printed formula below this is shown as none."""

KINDS = {"good": "ok", "poor": "warn", "none": "no"}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make matrix, sliders, picture, the three results and the plot of the errors."""
    head = gui.form(post)
    end = state[Exponential].end
    time = gui.slider("t, s", 0.0, end, end / STEPS, 0.0, lambda t: post(MoveTime(t)), None)
    terms = gui.slider("terms", 1.0, MOST_TERMS, 1.0, 4.0, lambda count: post(SumTerms(round(count))), None)
    drawn, results = gui.html(), gui.html()
    plot = _ErrorPlot(gui)

    def show(state: State) -> None:
        part = state[Exponential]
        head.show(head_markup(head, part))
        if time.handle.max != part.end:
            time.handle.max, time.handle.step = part.end, part.end / STEPS
        time.show(part.t)
        terms.show(float(part.terms))
        drawn.show(f"{plane(part)}{_eigen(part.found)}")
        results.show(results_markup(part))
        plot.show_part(part)

    return show


class _ErrorPlot(Plot):
    """The errors of the sums, and their bound, over the number of terms."""

    def __init__(self, gui: Gui) -> None:
        curves = [Curve("log₁₀ of the error", BLUE), Curve("log₁₀ of its bound", GREY, 1.2, dash=(4, 3))]
        title = "<span>log₁₀ of the error (grey: bound)</span>"
        super().__init__(gui, title, "terms of the series", curves, "series_error", legend=False)
        self._part: Exponential | None = None

    def show_part(self, part: Exponential) -> None:
        """Show the curves when they are others, and where the present number of terms is."""
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


def head_markup(form: Form, part: Exponential) -> str:
    """Return the choice of an example, and the fields of matrix, start and end."""
    chooser = examples(form, EXAMPLES, part.example, ChooseExponentialExample)
    values = {"x1": part.x0[0], "x2": part.x0[1], "end": part.end}
    values |= {f"a{i + 1}{j + 1}": part.A[i][j] for i in (0, 1) for j in (0, 1)}

    def cell(key: str) -> str:
        return form.field(
            key, readable(values[key], 4), ENTRIES[key], lambda text: SetEntry(key, plain_number(text, ENTRIES[key]))
        )

    matrix = "".join(f"<tr><td>{cell(f'a{i}1')}</td><td>{cell(f'a{i}2')}</td></tr>" for i in (1, 2))
    start = "".join(f"<tr><td>{cell(key)}</td></tr>" for key in ("x1", "x2"))
    return (
        f"{chooser}"
        f'<div class="eq small" title="Notes 1.50-1.52, 1.58 corrected">&emsp;{mathml(SYSTEM)}'
        f'</div><div class="exp-typed"><span>A =</span><table class="mat">{matrix}</table><i>1/s</i>'
        f'<span>x(0) =</span><table class="mat">{start}</table>'
        f"<label><span>until</span>{cell('end')}<i>s</i></label></div>"
    )


def results_markup(part: Exponential) -> str:
    """Return the three results below each other, with how far they are from SciPy's."""
    found = part.found
    count = f"{part.terms} term{'' if part.terms == 1 else 's'} of {mathml(SERIES)}"
    series = float(found.errors[part.terms - 1])
    rows = [_result(count, found.sums[part.terms - 1], f"off by {scientific(series)}")]
    if found.product is None:
        rows.append(f'<div class="exp-result"><div>{mathml(PRODUCT)}<p class="dim">T has no inverse</p></div></div>')
    else:
        off = float(np.abs(found.product - found.whole).max())
        rows.append(_result(mathml(PRODUCT), found.product, f"off by {scientific(off)}"))
    rows.append(_result("SciPy", found.whole, "the others are compared with this"))
    kind = KINDS[found.basis.basis]
    said = capitalised(found.basis.says)
    printed = ""
    if found.printed is not None:
        off_by = f"here off by {number(found.printed, 3)}" if found.printed >= SEEN else "the same with this T"
        printed = f"<p>Notes 1.58 print {mathml(PRINTED)}: {off_by}.</p>"
    card = f'<div class="verdict {kind}"><b>{SIGNS[kind]} {_condition(found)}</b>{escaped(said)}.{printed}</div>'
    title = (
        f'<h3>{mathml(EXPONENTIAL)} at t = {amount(part.t, "s")}<span class="copies">{copy_buttons(found.whole)}</span>'
    )
    return f"{title}</h3>{''.join(rows)}{card}"


def _condition(found: Found) -> str:
    condition = found.basis.condition
    text = number(condition, 1) if condition < WIDEST else scientific(condition)
    return f"cond(T) = {text if found.basis.basis != 'none' else '∞'}"


def _result(name: str, values: Array, said: str) -> str:
    return f'<div class="exp-result"><div>{name}<p class="dim">{said}</p></div>{_matrix(values)}</div>'


def _matrix(values: Array) -> str:
    def cell(value: float) -> str:
        zero = abs(value) < 0.5 * 10.0**-DECIMALS
        text = "0" if zero else number(value, DECIMALS) if abs(value) < WIDEST else scientific(value, 3)
        return f"<td{' class=zero' if zero else ''}>{text}</td>"

    rows = "".join(f"<tr>{''.join(cell(float(value)) for value in row)}</tr>" for row in values)
    return f'<table class="mat">{rows}</table>'


def _eigen(found: Found) -> str:
    """Return eigenvalues, and real eigenvectors with the colours of their lines."""
    basis = found.basis
    if not basis.real:
        real, imaginary = float(basis.values[0].real), abs(float(basis.values[0].imag))
        return f'<p class="dim">λ₁,₂ = {amount(real)} ± {amount(imaginary)} j, 1/s; complex eigenvectors.</p>'
    if basis.basis == "none" and basis.values[0] == basis.values[1]:
        vector = ", ".join(number(float(value), 3) for value in basis.T.real[:, 0])
        value = amount(float(basis.values[0].real), "1/s")
        return (
            f'<p class="exp-eigen">{dot(css(EIGEN[0]))}λ₁ = λ₂ = {value}, a double eigenvalue with one eigenvector: '
            f"v = ({vector})</p>"
        )
    said = [
        f"{dot(css(EIGEN[i]))}λ{'₁₂'[i]} = {amount(float(basis.values[i].real), '1/s')}, "
        f"v = ({', '.join(number(float(value), 3) for value in basis.T.real[:, i])})"
        for i in (0, 1)
    ]
    return f'<p class="exp-eigen">{"<br>".join(said)}</p>'


PANEL = Panel((Exponential,), build, rebuilds=())
