"""What is solved for the selected curve, and the rules of normalised coefficients."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.curves.examples import differences
from armlab.benches.motion.curves.made import Made, in_knots
from armlab.benches.motion.curves.solved import (
    LtsSolved,
    OnePolynomial,
    Pieces,
    SplineSolved,
    lts_solved,
    normalised,
    one_polynomial,
    pieces,
    spline_solved,
)
from armlab.benches.motion.curves.state import DEGREES, Curves
from armlab.benches.motion.curves.ui.words import COLOURS, figures, polynomial, power, unit
from armlab.kin.paths.polynomial import Rules
from armlab.session.fields import Set
from armlab.ui.colours import css
from armlab.ui.form import Form
from armlab.ui.format import dot, escaped, matrix, number, subscript
from armlab.ui.matrices import copy_buttons

Floats = NDArray[np.float64]

MOST_ROWS = 12
"""Of a matrix on screen; a larger one can be copied."""

LETTERS = "abcdefghijklmnop"


def solved_markup(part: Curves) -> str:
    """Return the equations and coefficients of the selected curve."""
    made, drawn = part.outcomes[part.selected], part.curves[part.selected]
    head = f"<h2>{dot(css(COLOURS[drawn.colour]))}What is solved: curve {part.selected + 1}</h2>"
    if not isinstance(made, Made):
        return f'{head}<p class="dim">There is no curve to look at.</p>'
    path, of = made.trajectory.path, part.unit
    said = [f"<p>{escaped(made.title)}.</p>"]
    spline, lts, one, several = spline_solved(path), lts_solved(path), one_polynomial(made), pieces(made)
    if spline is not None:
        said.append(_spline(spline, of))
    if lts is not None:
        said.append(_lts(lts, of))
    if one is not None:
        said.append(_one(one, of))
    elif several is not None:
        said.append(_pieces(several, of))
    elif path.degree is not None:
        count = path.degree + 1
        said.append(f"<p>Degree {path.degree}: {count} conditions for {count} coefficients.</p>")
    elif len(made.knots) == 2:
        said.append("<p>Nothing to solve: q = q<sub>i</sub> + Δq f(s), with the course f of this kind.</p>")
    if made.trajectory.degree is not None and made.drawn.law.key != "constant":
        degrees = f"{path.degree} · {made.trajectory.law.degree} = {made.trajectory.degree}"
        said.append(f"<p>Over time q(s(t)) is a polynomial of degree {degrees}.</p>")
    # What the constant law says of its ends does not hold for a path that begins and ends at rest by itself.
    remarks = path.remarks if made.drawn.law.key == "constant" else made.trajectory.remarks
    said += [f'<p class="dim">{_indices(in_knots(text))}</p>' for text in remarks]
    # That of 6.74 stands beside its polynomial below.
    notes = [text for text in differences(made) if part.degree != 5 or not text.startswith("Notes 6.74")]
    said += [f'<p class="cu-note">{_indices(text)}</p>' for text in notes]
    return head + "".join(said)


def _indices(text: str) -> str:
    """Return a text with ``h_k+1`` and the like set as indices."""
    return re.sub(r"_(?:\(([^)]*)\)|(\w(?:[−+]\d)?))", r"<sub>\1\2</sub>", escaped(text))


def _matrix(title: str, values: Floats, rule: int | None = None) -> str:
    """Return a matrix that can be copied, and seen where it is not too large."""
    head = f'<h3>{title}<span class="copies">{copy_buttons(values)}</span></h3>'
    if len(values) > MOST_ROWS + 2:
        return f'{head}<p class="dim">{len(values)} rows: too many to be read here; copy them.</p>'
    return f'{head}<div class="scroll cu-matrix">{matrix(values, 3, rule)}</div>'


def _spline(solved: SplineSolved, of: str) -> str:
    n, parts = len(solved.right), []
    if solved.virtual:
        where = " and ".join(f"{number(float(solved.times[k - 1]), 3)} s" for k in solved.virtual)
        parts.append(f"<p>Two virtual knots at {where}; where they lie is found with the rest.</p>")
    counted = " + ".join(f"{count}" for count, _ in solved.conditions)
    meaning = "; ".join(f"{count}: {words}" for count, words in solved.conditions)
    cubics = len(solved.times) - 1
    law = f"4(N+1) = 4·{cubics}" if solved.virtual else f"4(N−1) = 4·{cubics}"
    parts.append(
        f"<p>{cubics} cubics with {law} = {solved.unknowns} coefficients; as many equations: {counted} "
        f'<span class="dim">({meaning})</span>.</p>'
    )
    if n:
        edge = f" First and last row: 1 and {unit(1, of)}." if solved.first == 1 else ""
        names = [subscript("v", solved.first + k) for k in range(n)]
        unknowns = ", ".join(names) if n < 4 else f"{names[0]} … {names[-1]}"
        augmented = np.column_stack([solved.matrix, solved.right])
        parts.append(_matrix("A(h) v = b", augmented, rule=n))
        parts.append(
            f'<p class="dim">Shown is [ A | b ], A in s and b in {of}, of the unknown velocities {unknowns}.{edge} '
            "Tridiagonal and diagonally dominant: there is one solution.</p>"
        )
    rows = "".join(
        f"<tr><th>{k}{' virtual' if k in solved.virtual else ''}</th><td>{figures(t)}</td><td>{figures(q)}</td>"
        f"<td>{figures(v)}</td></tr>"
        for k, (t, q, v) in enumerate(
            zip(solved.times.tolist(), solved.positions.tolist(), solved.velocities.tolist(), strict=True), start=1
        )
    )
    heads = f"<th>k</th><th>t, s</th><th>q, {of}</th><th>v = A⁻¹b, {unit(1, of)}</th>"
    parts.append(f'<h3>At the knots</h3><table class="cu-facts"><tr>{heads}</tr>{rows}</table>')
    return "".join(parts)


def _lts(solved: LtsSolved, of: str) -> str:
    rows = "".join(
        f"<tr><th>{k}</th><td>{_indices(name)}</td><td>{figures(float(value))}</td></tr>"
        for k, (name, value) in enumerate(zip(solved.names, solved.right, strict=True), start=1)
    )
    augmented = np.column_stack([solved.matrix, solved.right])
    return (
        "<p>6 + 4 + 4 = 14 equations for 5 + 4 + 5 = 14 coefficients.</p>"
        f'<table class="cu-facts cu-said"><tr><th></th><th>equation</th><th>= </th></tr>{rows}</table>'
        + _matrix("[ A | b ]", augmented, rule=14)
        + f'<p class="dim">A in powers of s, b in {of}; one row an equation, 14 coefficients and b.</p>'
    )


def _pieces(found: Pieces, of: str) -> str:
    count = found.coefficients.shape[1]
    letter, digits = "t" if found.timed else "s", 4 if count < 5 else 3
    heads = "".join(f"<th>a<sub>k{j}</sub></th>" for j in range(count))
    units = "".join(f"<th>{unit(j, of) if found.timed else of}</th>" for j in range(count))
    rows = "".join(
        f"<tr><th>{_span(found, k)}</th>"
        + "".join(f"<td>{figures(float(value), digits)}</td>" for value in row)
        + "</tr>"
        for k, row in enumerate(found.coefficients)
    )
    formula = f"q = Σ a<sub>kj</sub> ({letter} − {letter}<sub>k</sub>)<sup>j</sup>"
    return (
        f"<h3>Coefficients <small>{formula}</small></h3>"
        f'<div class="scroll"><table class="cu-facts cu-pieces"><tr><th>{letter}</th>{heads}</tr>'
        f"<tr><th></th>{units}</tr>{rows}</table></div>"
    )


def _span(found: Pieces, k: int) -> str:
    start, end = (figures(float(edge), 3) for edge in found.edges[k : k + 2])
    return f"{start}–{end}{' s' if found.timed else ''}"


def _one(found: OnePolynomial, of: str) -> str:
    degree, letter = len(found.normalised) - 1, "s" if found.in_time is None else "τ"
    rows = []
    for k in range(degree + 1):
        exponent = degree - k
        time = "" if found.in_time is None else f"<td>{figures(float(found.in_time[k]))} {unit(exponent, of)}</td>"
        rows.append(
            f"<tr><th>{LETTERS[k]}</th><td>{power(letter, exponent)}</td><td>{figures(float(found.normalised[k]))}</td>"
            f"<td>{figures(float(found.in_tau[k]))}</td>{time}</tr>"
        )
    time = "" if found.in_time is None else "<th>with t</th>"
    over = "s" if found.in_time is None else "τ = t/T"
    return (
        f"<p>Doubly normalised: (q − q<sub>i</sub>)/Δq over {over}, with Δq = {figures(found.change)} {of}.</p>"
        f'<table class="cu-facts"><tr><th></th><th></th><th>normalised</th><th>with {letter}, {of}</th>{time}</tr>'
        f"{''.join(rows)}</table>" + _rules_of(found, degree)
    )


def _rules_of(found: OnePolynomial, degree: int) -> str:
    """Return the rules where they are meant: for rest at both ends."""
    if not found.rules.low_zero:
        return '<p class="dim">With derivatives given at the ends the rules below need not hold.</p>'
    return _rules(found.rules, found.normalised, degree)


def _rules(rules: Rules, coefficients: Floats | tuple[float, ...], degree: int) -> str:
    """Return the four rules, each ticked or crossed."""
    total = figures(float(np.sum(np.asarray(coefficients, dtype=float))))
    said = (
        (rules.integers, "whole numbers"),
        (rules.alternating, "signs alternate"),
        (rules.sum_one, f"sum {total}" if rules.sum_one else f"sum {total}, not 1"),
        (rules.low_zero, f"zero up to degree {(degree - 1) // 2}"),
    )
    marks = (f'<span class="{"ok" if kept else "no"}">{"✓" if kept else "✕"} {words}</span>' for kept, words in said)
    return f'<p class="cu-rules">{"".join(marks)}</p>'


def rules_markup(form: Form, part: Curves) -> str:
    """Return the normalised polynomial from rest to rest of a degree, with the rules of its coefficients."""
    found, printed = normalised(part.degree), (6.0, -5.0, 10.0, 0.0, 0.0, 0.0)
    names = {str(degree): str(degree) for degree in DEGREES}
    hint = "Degree of the polynomial"
    chosen = form.chips("degree", names, str(part.degree), hint, lambda degree: Set(Curves, "degree", int(degree)))
    k = part.degree // 2
    said = (
        f"<h3>Rest to rest, normalised <small>degree</small> {chosen}</h3>"
        f"<p>(q − q<sub>i</sub>)/Δq = {polynomial(tuple(map(float, found.coefficients)), 'τ')}</p>"
        + _rules(found.rules, tuple(map(float, found.coefficients)), part.degree)
        + f'<p class="dim">Derivatives 1 to {k} vanish at both ends; largest velocity '
        f"{figures(found.peak_speed)} Δq/T.</p>"
    )
    if part.degree == 5:
        said += (
            f'<p class="cu-note">Notes 6.74 prints {polynomial(printed, "τ")}: sum {figures(sum(printed))}, '
            "not 1; corrected.</p>"
        )
    return said
