"""A curve in numbers: at the present moment, for its kind, and as a whole."""

from __future__ import annotations

import numpy as np

from armlab.benches.motion.space_curve.commands import GoTo
from armlab.benches.motion.space_curve.laid import Laid, Moment
from armlab.benches.motion.space_curve.state import SpaceCurve, curve_of, moment_of
from armlab.benches.motion.space_curve.ui.words import (
    Row,
    corrected,
    length,
    lengths,
    per_metre,
    plain,
    said,
    vectors,
)
from armlab.errors import InputError
from armlab.kin.paths.circle import Arc
from armlab.kin.paths.clothoid import Clothoid
from armlab.kin.paths.helix import Helix
from armlab.kin.paths.overfly import Overfly
from armlab.session.state import State
from armlab.ui.form import Form
from armlab.ui.format import mathml, number, pairs
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import fold
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, plain_number, units_of

KAPPA = r"\kappa=\frac{|p′\times p″|}{|p′|^3}"
TAU = r"\tau=\frac{p′\cdot(p″\times p‴)}{|p′\times p″|^2}"

TANGENT = "t = p′/|p′|.⟦ Notes 6.145 multiply p by the norm instead: corrected.⟧"
NORMAL = "κv² n is the centripetal acceleration⟦; the text after 6.135 calls n itself “the normal acceleration”⟧."
NOT_ACROSS = (
    "p″ṡ² is perpendicular to the path only if s is the arc length⟦ (6.135)⟧. Here the acceleration is {along} "
    "along t and {across} "
    "along n."
)
BOUNDED = "A bounded curvature does not make a curve regular⟦, as the text before 6.12 has it⟧; p′ ≠ 0 does."

ACROSS = 1e-6
"""Relative part of p''s-dot² along the path below which it counts as perpendicular."""


def at_present(form: Form, state: State) -> Markup:
    """Return the numbers at the time of the film."""
    found, now, units = state.derived(curve_of), state.derived(moment_of), units_of(state)
    frame, by_length = now.frame, found.by_length
    rows: list[Row] = [("p", units.length_unit, lengths(now.p, units))]
    if by_length:
        rows += [("p′", "", plain(now.d1)), ("p″", "1/m", plain(now.d2))]
    else:
        rows += [("p′", units.length_unit, lengths(now.d1, units)), ("p″", units.length_unit, lengths(now.d2, units))]
    for name, vector in (("t", frame.tangent), ("n", frame.normal), ("b", frame.binormal)):
        there = bool(vector.any())
        rows.append((name, "", plain(vector) if there else ("–",) * 4))
    remark = said("warn", frame.remark) if frame.remark else None
    return joined(_place(form, now, found, units), vectors(rows), remark, _scalars(now, found, units))


def _place(form: Form, now: Moment, found: Laid, units: Units) -> Markup:
    """Return the heading with the field of s."""
    if found.by_length:
        full = found.arc.length
        gone = units.text(now.sigma, False)
        cell = form.field("sigma", gone, "Arc length", lambda text: GoTo(_share(text, full, units)))
        place = tag("label", "At σ = ", cell, " ", tag("small", f"of {units.length(full)}"))
    else:
        cell = form.field("s", number(now.s, 3), "Parameter s, from 0 to 1", lambda text: GoTo(plain_number(text, "s")))
        place = tag("label", "At s = ", cell)
    return tag("h3.sc-at", place, tag("small.sc-t", f"t = {number(now.t, 2)} s"))


def _share(text: str, full: float, units: Units) -> float:
    """Return the part of the full length at a typed arc length."""
    sigma = units.read(text, False, "σ")
    # The end can be typed as it is shown, also where its last digit is rounded up.
    if sigma > full and units.text(sigma, False) == units.text(full, False):
        return 1.0
    if not 0.0 <= sigma <= full:
        raise InputError(f"σ: expected a length from 0 to {units.length(full)}, got {text.strip()[:40]!r}")
    return sigma / full


def _scalars(now: Moment, found: Laid, units: Units) -> Markup:
    frame = now.frame
    kappa, moves = float(frame.curvature), bool(frame.moves)
    bends = bool(frame.bends)
    return pairs(
        [
            ("curvature κ", per_metre(kappa) if moves else "–"),
            ("radius 1/κ", f"{length(1.0 / kappa, units)} {units.length_unit}" if bends else "–"),
            ("torsion τ", per_metre(float(frame.torsion)) if bends else "–"),
            ("arc length σ, of L", f"{units.text(now.sigma, False)} of {units.length(found.arc.length)}"),
        ]
    )


def moving(state: State) -> Markup | None:
    """Return velocity and acceleration with their parts, while they are drawn."""
    if not state[SpaceCurve].arrows:
        return None
    now, units = state.derived(moment_of), units_of(state)
    unit = units.length_unit
    rows: list[Row] = [
        ("ṗ", f"{unit}/s", lengths(now.velocity, units)),
        ("p′s̈", f"{unit}/s²", lengths(now.tangential, units)),
        ("p″ṡ²", f"{unit}/s²", lengths(now.centripetal, units)),
        ("p̈", f"{unit}/s²", lengths(now.tangential + now.centripetal, units)),
    ]
    along = float(now.centripetal @ now.frame.tangent)
    size = float(np.linalg.norm(now.centripetal))
    text = NORMAL
    if abs(along) > ACROSS * size and size > 0.0:
        whole = now.tangential + now.centripetal
        parts = (float(whole @ axis) for axis in (now.frame.tangent, now.frame.normal))
        values = dict(zip(("along", "across"), (f"{units.text(part, False)} {unit}/s²" for part in parts), strict=True))
        text = NOT_ACROSS.format(**values)
    return joined(tag("h3", "Velocity and acceleration"), vectors(rows), corrected(text))


def whole(state: State) -> Markup:
    """Return the numbers of the curve as a whole, and the formulas."""
    found, units = state.derived(curve_of), units_of(state)
    if len(found.stands):
        places = ", ".join(number(float(s), 3) for s in found.stands[:4])
        regular = joined(said("no", f"Not regular: p′ = 0 at s = {places}"), corrected(BOUNDED))
    else:
        regular = said("ok", "Regular: p′ ≠ 0 everywhere")
    hint = "⟦Notes 6.140–6.141; for any number of coordinates 6.11⟧"
    formulas = tag("div.eq.small", "\u2003", mathml(KAPPA), "\u2003\u2003", mathml(TAU), title=hint)
    return joined(_facts(found, units), regular, fold("Formulas", formulas, corrected(TANGENT)))


def _facts(found: Laid, units: Units) -> Markup | None:
    """Return the numbers that belong to a kind of curve, if it has any."""
    path = found.given
    unit = units.length_unit
    if isinstance(path, Arc):
        centre = ", ".join(units.text(float(value), False) for value in path.centre)
        rows = [("centre", f"({centre}) {unit}"), ("radius", units.length(path.radius))]
        return pairs([*rows, ("angle", units.angle(path.angle))])
    if isinstance(path, Helix):
        rise = float(np.linalg.norm(path.advance)) / path.angle
        return pairs([("radius r", units.length(path.radius)), ("advance h per radian", units.length(rise))])
    if isinstance(path, Clothoid):
        return pairs([("κ = 2θσ/L², at its end", per_metre(2.0 * abs(path.turn) / path.length))])
    return _blends(path, units) if isinstance(path, Overfly) else None


def _blends(path: Overfly, units: Units) -> Markup:
    """Return the blends of the corners: notes 6.120 and 6.130-6.133."""
    rows = []
    for k, (time, d1, d2, a) in enumerate(zip(path.blend_times, path.d1, path.d2, path.accelerations, strict=True)):
        cells = (units.text(float(size), False) for size in (d1, d2, np.linalg.norm(a)))
        rows.append(line(number(float(time), 3), *cells, name=f"{k + 2}"))
    unit = units.length_unit
    heads = head_line("corner", "ΔT, s", f"d₁, {unit}", f"d₂, {unit}", f"|p̈|, {unit}/s²")
    formulas = "ΔT = 2d₁/v₁ = 2d₂/v₂⟦ (6.130–6.133)⟧, p̈ = (v₂k₂ − v₁k₁)/ΔT⟦ (6.120)⟧."
    return joined(tag("table.sc-table", heads, rows), tag("p.dim", formulas))
