"""The page Inverse velocity in words: verdict, joint speeds, subspaces and tests of singularity, as markup."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.solve.found import Found
from armlab.kin.arm import Arm
from armlab.kin.conditioning import TITLES, conditioning
from armlab.kin.ellipsoid import RANK_TOLERANCE
from armlab.kin.joint_scale import DEFAULT_SPEED
from armlab.kin.task import Task
from armlab.kin.velocity.answer import full_rank_inverse
from armlab.ui.colours import BLUE, GREEN, VERDICT, css, joint_colour
from armlab.ui.format import dot, mathml, number, pairs, readable, scientific, trimmed
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.symbols import with_indices
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units

Array = NDArray[np.float64]

MOST_LISTED = 8
"""Largest number of minors, or null vectors, that are written out."""

ROUNDING = 1e-12
"""Minor of the scaled matrix, over the same power of its largest singular value, that counts as zero."""

OVER = 1.0 + 1e-9
"""Ratio to its limit above which a joint speed is marked."""

PENROSE = (r"J J^\# J-J", r"J^\# J J^\#-J^\#", r"(J J^\#)^T-J J^\#", r"(J^\# J)^T-J^\# J")
"""Left sides of the four Penrose conditions, each 0 for a pseudo-inverse."""

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def components(task: Task) -> list[tuple[str, bool]]:
    """Return for each component its name, and whether it is a rotation."""
    moving = [(f"v{letter}", False) for letter in task.position]
    turning = {
        "none": [],
        "phi": ["φ̇"],
        "approach": ["ωx′", "ωy′"],
        "full": ["ωx", "ωy", "ωz"],
    }[task.rotation]
    return moving + [(name, True) for name in turning]


def markup_of(name: str) -> Inside:
    """Return a component's name with its index as a subscript."""
    return (name[0], tag("sub", name[1:])) if name[0] in "vω" else name


def speed_text(value: float, turning: bool, units: Units) -> str:
    """Return a speed of the tool or of a joint with its unit."""
    return f"{units.text(value, turning)} {units.unit(turning)}/s"


def dotted(i: int, arm: Arm, units: Units) -> str:
    """Return the symbol of a joint speed."""
    name = units.variable(i, bool(arm.revolute[i]))
    return f"{name[0]}\u0307{name[1:]}"


# -- the verdict -----------------------------------------------------------------------------------------------------


def verdict(found: Found, units: Units) -> tuple[str, str, str]:
    """Return ``ok``, ``warn`` or ``no``, the number of answers, and the reason."""
    answer, rank, (m, n) = found.answer, found.spaces.rank, found.J.shape
    if answer.verdict == "none":
        return "no", "No joint speeds give v", _why_none(found, units)
    if answer.verdict == "one":
        how = "J is square and regular, so q̇ = J⁻¹ v." if m == n else f"J has rank {rank} = n, and v is in its range."
        return "ok", "One answer", how
    free = answer.free.shape[1]
    ways = "one direction" if free == 1 else f"{free} directions"
    why = f"v is in the range of J, and N(J) has {ways} of joint speeds that do nothing: n − rank = {n} − {rank}."
    return "ok", "Infinitely many answers", f"{why} Shown is the shortest."


def _why_none(found: Found, units: Units) -> str:
    rank, (m, n) = found.spaces.rank, found.J.shape
    moving, turning = found.vectors(found.answer.lost)
    lost = [
        speed_text(float(np.linalg.norm(part)), kind, units)
        for part, kind in ((moving, False), (turning, True))
        if np.linalg.norm(part) > 1e-9
    ]
    if not found.singular and n >= m:
        first = (
            "The arm cannot make all velocities of its task in any configuration, although it has enough joints: "
            f"J has rank {rank} of {m} at most."
        )
    elif not found.singular:
        first = f"The arm has too few joints for its task: J has rank {rank} of {m} everywhere."
    else:
        first = f"J has rank {rank} of {m} here, and v is not in its range."
    return f"{first} {' and '.join(lost)} of it {'is' if len(lost) == 1 else 'are'} lost; the rest is reached."


# -- joint speeds ----------------------------------------------------------------------------------------------------


def speeds_markup(found: Found, units: Units) -> Markup:
    """Return the shortest joint speeds as bars, and their size."""
    arm, qdot = found.arm, found.answer.qdot
    scale = np.where(np.isfinite(arm.speed_limits), arm.speed_limits, np.abs(qdot).max() or 1.0)
    over = np.abs(qdot) > OVER * arm.speed_limits
    bars = []
    for i in range(arm.n):
        name = tag("span", dot(css(joint_colour(i))), dotted(i, arm, units))
        kind, hint = ("b.no", "Faster than the joint can") if over[i] else ("b", None)
        speed = tag(kind, speed_text(float(qdot[i]), bool(arm.revolute[i]), units), title=hint)
        bars.append((name, _bar(float(qdot[i] / scale[i]), i), speed))
    limits = "Bars: fractions of the speed limits." if np.isfinite(arm.speed_limits).all() else ""
    aside = tag("small", "the shortest that comes nearest⟦ (5.123, 5.128)⟧")
    return joined(
        tag("h3", "q̇ = J", tag("sup", "#"), "v ", aside),
        tag("div.so-bars", bars),
        tag("p.dim", f"{_size(found, units)} {limits}"),
    )


def _size(found: Found, units: Units) -> str:
    arm, qdot = found.arm, found.answer.qdot
    if arm.revolute.all():
        return f"‖q̇‖ = {speed_text(float(np.linalg.norm(qdot)), True, units)}."
    if not arm.revolute.any():
        return f"‖q̇‖ = {speed_text(float(np.linalg.norm(qdot)), False, units)}."
    size = trimmed(float(np.linalg.norm(qdot / found.spaces.speeds)), 3)
    return f"‖q̇‖ = {size}, each speed as a fraction of its limit{_without_limit(arm)}."


def _without_limit(arm: Arm) -> str:
    """Return what stands for the speed limits that are not known, if some are not."""
    if np.isfinite(arm.speed_limits).all():
        return ""
    return f", or of {DEFAULT_SPEED:g} rad/s or {DEFAULT_SPEED:g} m/s where none is known"


def _bar(part: float, i: int) -> Markup:
    """Return a bar from the middle for a part from -1 to 1."""
    share = 50.0 * min(max(part, -1.0), 1.0)
    left = 50.0 + min(share, 0.0)
    return tag("u", style=f"--left:{left:.1f}%;--width:{abs(share):.1f}%;--c:{css(joint_colour(i))}")


def null_markup(found: Found, units: Units) -> Markup | None:
    """Return the null space as bars, or nothing if it is zero."""
    null = found.answer.free
    k = null.shape[1]
    if k == 0:
        return None
    arm = found.arm
    columns = []
    for column in null.T[:MOST_LISTED]:
        largest = column[int(np.argmax(np.abs(column) > np.abs(column).max() - 1e-9))]
        parts = column / largest
        bars = [
            (tag("span", dotted(i, arm, units)), _bar(float(parts[i]), i), tag("b", number(float(parts[i]), 3)))
            for i in range(arm.n)
        ]
        columns.append(tag("div.so-bars.so-null", bars))
    what = "one direction" if k == 1 else f"{k} directions"
    mixed = " In rad/s and m/s." if _mixed_joints(found) else ""
    return joined(
        tag("h3", "Null space N(J) ", tag("small", f"{what}; J q̇ = 0")),
        columns,
        tag("p.dim", f"Times any factor, added to q̇: the tool moves the same⟦ (5.132–5.138)⟧.{mixed}"),
    )


def reached_markup(found: Found, units: Units) -> Markup:
    """Return v, its reached part and its lost part, component by component."""
    names = components(found.arm.task)
    answer = found.answer
    rows = []
    for k, (name, turning) in enumerate(names):
        cells = [units.text(float(values[k]), turning) for values in (found.v, answer.reached, answer.lost)]
        rows.append(line(*cells, f"{units.unit(turning)}/s", name=markup_of(name)))
    return tag("table.so-table", head_line(None, "v", "reached", "lost", None), rows)


# -- singular or not -------------------------------------------------------------------------------------------------


def singular_card(found: Found) -> Markup:
    """Return whether J is singular here, and why."""
    sigma, usual = found.spaces.sigma, found.usual
    if not usual:
        return verdict_box("warn", "Rank 0 everywhere", "No joint moves what is asked, in any configuration: J = 0.")
    if found.singular:
        head = f"Singular: rank {found.spaces.rank}, usually {usual}"
        return verdict_box("no", head, [tag("p", each.says) for each in found.reasons])
    ratio = float(sigma[usual - 1] / sigma[0])
    verdict = conditioning(ratio, singular=False)
    written = scientific(ratio) if ratio < 1e-3 else number(ratio, 4 if verdict == "poor" else 3)
    said = f"Rank {usual}, not singular. ", with_indices("σ_min/σ_max"), f" = {written} for what is asked."
    return verdict_box("warn" if verdict == "poor" else "ok", TITLES[verdict], *said)


def measures_markup(found: Found) -> Markup:
    """Return the determinants, the minors and the smallest singular value."""
    tests, (m, n) = found.tests, found.J.shape
    rows: list[tuple[Markup, str]] = []
    formula = found.formula
    if tests.determinant is not None:
        rows.append((mathml(r"\det J"), _value(tests.determinant, found, 1)))
    if m != n:
        rows.append(_product(found))
    rows.append((mathml(r"\sigma_{min}"), _sigma(found)))
    return joined(_formula(found), pairs(rows), _minors(found, formula is not None), _scaling(found))


def _formula(found: Found) -> Markup | None:
    formula = found.formula
    if formula is None or not formula.square:
        return None
    # A factor a formula, so that a long product goes on in the next line.
    first, *rest = formula.minors[0].latex.split(r"\,\left(")
    parts = [rf"\det J={first}", *(rf"\left({factor}" for factor in rest)]
    written = joined(map(mathml, parts), between=" ")
    return tag("div.eq.small.so-det", written, title="The same in any axes⟦; notes 5.84-5.91⟧")


def _product(found: Found) -> tuple[Markup, str]:
    """Return the name and the value of det(J J^T) or det(J^T J).

    It adds squares of minors. Where these have several units, it is that of the scaled matrix.
    """
    tests, (m, n) = found.tests, found.J.shape
    mixed = _mixed_joints(found) if m < n else 0 < found.p < m
    if mixed:
        name = r"\det(\bar{J}\,\bar{J}^T)" if m < n else r"\det(\bar{J}^T\bar{J})"
        return mathml(name), _product_of(found) + _unit_of_sigma(found, 2 * min(m, n))
    value = tests.wide if m < n else tests.tall
    return mathml(r"\det(J\,J^T)" if m < n else r"\det(J^T J)"), _value(value or 0.0, found, 2)


def _product_of(found: Found) -> str:
    return "0" if _is_short(found) else small(float(np.prod(found.spaces.sigma) ** 2))


def _mixed_joints(found: Found) -> bool:
    return bool(found.arm.revolute.any() and not found.arm.revolute.all())


def _value(value: float, found: Found, times: int) -> str:
    """Return a determinant, to a power, with the unit of the first choice of columns or rows.

    It is zero where the rank says so: its size depends on that of the arm.
    """
    chosen = tuple(range(1, min(found.J.shape) + 1))
    return f"{'0' if _is_short(found) else small(value)}{_power(times * _metres(found, chosen))}"


def _is_short(found: Found) -> bool:
    """Return whether the rank is less than the number of rows and that of columns."""
    return bool(found.spaces.rank < min(found.J.shape))


def _power(power: int) -> str:
    """Return a power of the metre, as text."""
    return "" if power == 0 else " m" if power == 1 else f" m{str(power).translate(SUPERSCRIPTS)}"


def _unit_of_sigma(found: Found, times: int = 1) -> str:
    """Return the unit of a product of several singular values of the matrix whose rank is taken."""
    only_moves = found.p == len(found.J)
    if _mixed_joints(found):
        power = "" if times == 1 else str(times).translate(SUPERSCRIPTS)
        return (f" (m/s){power}" if power else " m/s") if only_moves else f" s{str(-times).translate(SUPERSCRIPTS)}"
    if found.arm.revolute.all():
        return _power(times) if only_moves else ""
    return "" if only_moves else _power(-times)


def small(value: float) -> str:
    """Return a number with four decimals, or with a power of ten if it is too small or too large for them."""
    return number(value, 4) if 1e-3 <= abs(value) < 1e4 else scientific(value, 2)


def _sigma(found: Found) -> str:
    sigma = found.spaces.sigma_min
    return f"{'0' if _is_short(found) else small(sigma)}{_unit_of_sigma(found)}"


def _minors(found: Found, symbolic: bool) -> Markup | None:
    """Return the minors of a matrix that is not square (5.92-5.98)."""
    tests, (m, n) = found.tests, found.J.shape
    if m == n or not tests.minors:
        return None
    what = "columns" if m < n else "rows"
    largest = sorted(tests.minors, key=lambda minor: -abs(minor.value))[:MOST_LISTED]
    shown = largest if tests.count > MOST_LISTED else list(tests.minors)
    formulas = {}
    if symbolic and m < n and found.formula is not None:
        formulas = {minor.joints: mathml(minor.latex) for minor in found.formula.minors}
    lines, flat = [], found.scaled if m < n else found.scaled.T
    for minor in shown:
        square = flat[:, [k - 1 for k in minor.chosen]]
        size = "0" if _is_rounding(square, found) else small(minor.value)
        name, value = ", ".join(map(str, minor.chosen)), f"{size}{_power(_metres(found, minor.chosen))}"
        lines.append(line(formulas.get(minor.chosen), value, name=name))
    more = f", the {MOST_LISTED} largest" if tests.count > MOST_LISTED else ""
    aside = f"{tests.count} choices of {what}{more}; singular where all are 0⟦ (5.92–5.98)⟧"
    return joined(tag("h3", "Minors ", tag("small", aside)), tag("table.so-table.so-minors", lines))


def _is_rounding(square: Array, found: Found) -> bool:
    """Return whether a minor of the scaled matrix is zero but for rounding."""
    return abs(float(np.linalg.det(square))) <= ROUNDING * float(found.spaces.sigma[0]) ** len(square)


def _metres(found: Found, chosen: tuple[int, ...]) -> int:
    """Return the power of the metre in the determinant of some columns, or of some rows of a tall matrix."""
    m, n = found.J.shape
    columns = [k - 1 for k in chosen] if m < n else list(range(n))
    rows = sum(k <= found.p for k in chosen) if m > n else found.p
    return rows - int(np.sum(~found.arm.revolute[columns]))


def _scaling(found: Found) -> Markup:
    """Return in words the scaling and the tolerance of the rank and the singular values."""
    spaces, arm = found.spaces, found.arm
    said = [f"σ counts as 0 below {scientific(RANK_TOLERANCE, 0)} σ₁."]
    if (spaces.lengths != 1.0).any():
        said.append(f"For σ and rank metres are divided by L = {readable(arm.length_scale, 3)} m, half the reach.")
    if not arm.revolute.all() and arm.revolute.any():
        said.append(f"Joint speeds are fractions of their limits{_without_limit(arm)}.")
    if found.J.shape[0] == found.J.shape[1]:
        said.append(
            "The size of det J says little, since it depends on the unit of length; the ratio of the σ does not."
        )
    return tag("p.dim", " ".join(said))


# -- U, Sigma, V and Penrose -----------------------------------------------------------------------------------------


def penrose_markup(found: Found) -> Markup:
    """Return the residuals of the four conditions, and of the formula for full rank if it holds."""
    J, plain = (r"\bar{J}", "J̄") if found.is_scaled else ("J", "J")
    names = [name.replace("J", J) for name in PENROSE]
    differences = list(found.penrose)
    direct = full_rank_inverse(found.scaled)
    if direct is None:
        said = f"The rank is not full: the formulas for full rank fail; {plain}# = V Σ# Uᵀ with 1/σᵢ for σᵢ > 0 only."
    else:
        formula, inverse = direct
        names.append(rf"{J}^\#-{formula.replace('J', J)}")
        differences.append(float(np.abs(found.scaled_inverse - inverse).max()))
        said = "The rank is full: the last line is the formula for it."
    if found.is_scaled:
        said += " J̄ is J with metres and joint speeds scaled as said above."
    residuals = [scientific(value, 1) if value > 1e-16 else "0" for value in differences]
    rows = list(zip(map(mathml, names), residuals, strict=True))
    return joined(pairs(rows), tag("p.dim", f"Largest entries⟦ (definition 10)⟧. {said}"))


def legend() -> Markup:
    """Return the legend of the arrows' colours."""
    marks = ((BLUE, "wanted v"), (GREEN, "reached"), (VERDICT["no"], "lost"))
    return tag("div.legend", [tag("span", dot(css(colour)), name) for colour, name in marks])
