"""The equations and coefficients of the selected curve, and the rules of normalised coefficients."""

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
from armlab.ui.format import dot, matrix, number, so_many, subscript
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import fold
from armlab.ui.matrices import copy_buttons
from armlab.ui.tables import head_line, line

Floats = NDArray[np.float64]

MOST_ROWS = 12
"""Largest number of rows of a matrix on screen; a larger one can be copied."""

LETTERS = "abcdefghijklmnop"

_INDEX = re.compile(r"_(\([^)]*\)|\w(?:[−+]\d)?)")


def solved_markup(part: Curves) -> Markup:
    """Return the equations and coefficients of the selected curve."""
    made, drawn = part.outcomes[part.selected], part.curves[part.selected]
    head = f"What is solved: curve {part.selected + 1} ", dot(css(COLOURS[drawn.colour]))
    if not isinstance(made, Made):
        return fold(head, tag("p.dim", "There is no curve to look at."), key="solved")
    path, of = made.trajectory.path, part.unit
    said: list[Inside] = [tag("p", f"{made.title}.")]
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
        said.append(tag("p", f"Degree {path.degree}: {count} conditions for {count} coefficients."))
    elif len(made.knots) == 2:
        said.append(tag("p", _indices("Nothing to solve: q = q_i + Δq f(s), where the kind of curve gives f.")))
    if made.trajectory.degree is not None and made.drawn.law.key != "constant":
        degrees = f"{path.degree} · {made.trajectory.law.degree} = {made.trajectory.degree}"
        said.append(tag("p", f"Over time q(s(t)) is a polynomial of degree {degrees}."))
    # What the constant law says of its ends does not hold for a path that begins and ends at rest by itself.
    remarks = path.remarks if made.drawn.law.key == "constant" else made.trajectory.remarks
    said += [tag("p.dim", _indices(in_knots(text))) for text in remarks]
    # That of 6.74 stands beside its polynomial below.
    notes = [text for text in differences(made) if part.degree != 5 or not text.startswith("⟦Notes 6.74")]
    said += [tag("p.cu-note", _indices(text)) for text in notes]
    return fold(head, said, key="solved")


def _indices(text: str) -> Markup:
    """Return a text with ``h_k+1``, ``a_(kj)`` and similar names set as indices."""
    parts = _INDEX.split(text)  # texts, and the indices between them
    return joined(tag("sub", part.strip("()")) if i % 2 else part for i, part in enumerate(parts))


def _matrix(title: str, values: Floats, rule: int | None = None) -> Markup:
    """Return a matrix that can be copied, and is shown if it is not too large."""
    head = tag("h3", title, tag("span.copies", copy_buttons(values)))
    if len(values) > MOST_ROWS + 2:
        return joined(head, tag("p.dim", f"{len(values)} rows are too many to be shown here; they can be copied."))
    return joined(head, tag("div.scroll.cu-matrix", matrix(values, 3, rule)))


def _spline(solved: SplineSolved, of: str) -> Inside:
    n, parts = len(solved.right), []
    if solved.virtual:
        where = " and ".join(f"{number(float(solved.times[k - 1]), 3)} s" for k in solved.virtual)
        parts.append(tag("p", f"Two virtual knots at {where}; their positions are found with the other unknowns."))
    counted = " + ".join(f"{count}" for count, _ in solved.conditions)
    meaning = "; ".join(f"{count}: {words}" for count, words in solved.conditions)
    cubics = len(solved.times) - 1
    law = f"4(N+1) = 4·{cubics}" if solved.virtual else f"4(N−1) = 4·{cubics}"
    equations = f"{so_many(cubics, 'cubic')} with {law} = {solved.unknowns} coefficients; as many equations: {counted} "
    parts.append(tag("p", equations, tag("span.dim", f"({meaning})"), "."))
    if n:
        edge = f" The first and last rows are in 1 and {unit(1, of)}." if solved.first == 1 else ""
        names = [subscript("v", solved.first + k) for k in range(n)]
        unknowns = ", ".join(names) if n < 4 else f"{names[0]} … {names[-1]}"
        augmented = np.column_stack([solved.matrix, solved.right])
        found = "the unknown is the velocity" if n == 1 else "the unknowns are the velocities"
        shown = f"This is [ A | b ], A in s and b in {of}; {found} {unknowns}.{edge} "
        sure = "A is tridiagonal and diagonally dominant, so there is exactly one solution."
        parts += [_matrix("A(h) v = b", augmented, rule=n), tag("p.dim", shown, sure)]
    columns = (solved.times.tolist(), solved.positions.tolist(), solved.velocities.tolist())
    rows = [
        line(*map(figures, row), name=f"{k}{' virtual' if k in solved.virtual else ''}")
        for k, row in enumerate(zip(*columns, strict=True), start=1)
    ]
    heads = head_line("k", "t, s", f"q, {of}", f"v = A⁻¹b, {unit(1, of)}")
    return parts, tag("h3", "At the knots"), tag("table.cu-facts", heads, rows)


def _lts(solved: LtsSolved, of: str) -> Inside:
    rows = [
        line(_indices(name), figures(float(value)), name=f"{k}")
        for k, (name, value) in enumerate(zip(solved.names, solved.right, strict=True), start=1)
    ]
    augmented = np.column_stack([solved.matrix, solved.right])
    return (
        tag("p", "6 + 4 + 4 = 14 equations for 5 + 4 + 5 = 14 coefficients."),
        tag("table.cu-facts.cu-said", head_line("", "equation", "= "), rows),
        _matrix("[ A | b ]", augmented, rule=14),
        tag("p.dim", f"A in powers of s, b in {of}; each row is an equation with 14 coefficients and b."),
    )


def _pieces(found: Pieces, of: str) -> Inside:
    count = found.coefficients.shape[1]
    letter, digits = "t" if found.timed else "s", 4 if count < 5 else 3
    heads = head_line(letter, *(_indices(f"a_(k{j})") for j in range(count)))
    units = head_line("", *(unit(j, of) if found.timed else of for j in range(count)))
    rows = [
        line(*(figures(float(value), digits) for value in row), name=_span(found, k))
        for k, row in enumerate(found.coefficients)
    ]
    formula = _indices(f"q = Σ a_(kj) ({letter} − {letter}_k)")
    return (
        tag("h3", "Coefficients ", tag("small", formula, tag("sup", "j"))),
        tag("div.scroll", tag("table.cu-facts.cu-pieces", heads, units, rows)),
    )


def _span(found: Pieces, k: int) -> str:
    start, end = (figures(float(edge), 3) for edge in found.edges[k : k + 2])
    return f"{start}–{end}{' s' if found.timed else ''}"


def _one(found: OnePolynomial, of: str) -> Inside:
    degree, letter = len(found.normalised) - 1, "s" if found.in_time is None else "τ"
    rows = []
    for k in range(degree + 1):
        exponent = degree - k
        cells = [power(letter, exponent), figures(float(found.normalised[k])), figures(float(found.in_tau[k]))]
        if found.in_time is not None:
            cells.append(f"{figures(float(found.in_time[k]))} {unit(exponent, of)}")
        rows.append(line(*cells, name=LETTERS[k]))
    heads = ["", "", "normalised", f"with {letter}, {of}"]
    heads += [] if found.in_time is None else ["with t"]
    over = "s" if found.in_time is None else "τ = t/T"
    change = f"Doubly normalised: (q − q_i)/Δq over {over}, with Δq = {figures(found.change)} {of}."
    return tag("p", _indices(change)), tag("table.cu-facts", head_line(*heads), rows), _rules_of(found, degree)


def _rules_of(found: OnePolynomial, degree: int) -> Markup:
    """Return the rules if they apply: for rest at both ends."""
    if not found.rules.low_zero:
        return tag("p.dim", "With derivatives given at the ends, the rules below need not hold.")
    return _rules(found.rules, found.normalised, degree)


def _rules(rules: Rules, coefficients: Floats | tuple[float, ...], degree: int) -> Markup:
    """Return the four rules, each ticked or crossed."""
    total = figures(float(np.sum(np.asarray(coefficients, dtype=float))))
    said = (
        (rules.integers, "whole numbers"),
        (rules.alternating, "signs alternate"),
        (rules.sum_one, f"sum {total}" if rules.sum_one else f"sum {total}, not 1"),
        (rules.low_zero, f"zero up to degree {(degree - 1) // 2}"),
    )
    marks = [tag("span.ok", f"✓ {words}") if kept else tag("span.no", f"✕ {words}") for kept, words in said]
    return tag("p.cu-rules", marks)


def rules_markup(form: Form, part: Curves) -> Markup:
    """Return the normalised polynomial from rest to rest of a degree, with the rules of its coefficients."""
    found, printed = normalised(part.degree), (6.0, -5.0, 10.0, 0.0, 0.0, 0.0)
    names = {str(degree): str(degree) for degree in DEGREES}
    hint = "Degree of the polynomial"
    chosen = form.chips("degree", names, str(part.degree), hint, lambda degree: Set(Curves, "degree", int(degree)))
    coefficients = tuple(map(float, found.coefficients))
    rest = (
        f"Derivatives 1 to {part.degree // 2} vanish at both ends; largest velocity {figures(found.peak_speed)} Δq/T."
    )
    wrong = f"⟦Notes 6.74 prints {polynomial(printed, 'τ')}: sum {figures(sum(printed))}, not 1; corrected.⟧"
    return fold(
        "Rest to rest, normalised",
        tag("div.bar", tag("span.dim", "Degree"), chosen),
        tag("p", _indices("(q − q_i)/Δq = "), polynomial(coefficients, "τ")),
        _rules(found.rules, coefficients, part.degree),
        tag("p.dim", rest),
        tag("p.cu-note", wrong) if part.degree == 5 else None,
    )
