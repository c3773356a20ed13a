"""The bench of timing laws in words: phases, exceeded limits, time scaling, bounds, corrections."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from armlab.benches.motion.laws.bounds import Bounded
from armlab.benches.motion.laws.commands import optimal
from armlab.benches.motion.laws.state import Laws
from armlab.benches.motion.laws.timing import Entry, Excess, Phases, Timing, largest, phases
from armlab.errors import InputError
from armlab.kin.motion import Law, LawBounds
from armlab.kin.motion.breaks import class_text
from armlab.kin.timing.table import PLUS_MINUS_ONE
from armlab.session.amounts import amount

SYMBOLS = ("s", "ṡ", "s̈", "jerk")
"""Symbols of the derivatives 0 to 3."""

UNITS = ("", "1/s", "1/s²", "1/s³")
"""Units of the derivatives 0 to 3; s itself has none."""

LETTERS = ("", "V", "A", "J")
"""Letters of the limits of the derivatives 1 to 3."""

CORRECTIONS: Mapping[str, str] = MappingProxyType(
    {
        "quintic": "⟦Notes 6.74 has 5τ⁴ for 15τ⁴: corrected.⟧",
        "cosine": "⟦Notes 6.60 has q′(T) = 0 in normalised time: corrected to q′(1) = 0.⟧",
    }
)
"""Differences of the notes from the law used, by its key."""

PROFILE = (
    "⟦Notes 1.41 has 3/8, 5/8, 7/8 for 3, 5, 7: corrected. The answer after 1.42 says ∫ṡ dt for ∫s̈ dt in its "
    "first line.⟧"
)
TRIANGLE = "⟦Notes 6.112 names the triangle without its formulas, and 6.113 does not hold for it: corrected.⟧"
SCALING = "⟦Notes 6.160 has q̇ for q̈ on the right: corrected, accelerations fall to 1/k².⟧"
ENDS = "⟦Notes 6.24 looks for the largest |dq/ds| only where d²q/ds² = 0: corrected, the ends of the path count too.⟧"
NEGATIVE = "⟦Notes 6.33 does not say that its bound may be 0 or less: added, V must be lowered first.⟧"


def corrections(entry: Entry, timing: Timing, found: Phases | None) -> tuple[str, ...]:
    """Return the differences of the notes from a law, in short lines."""
    said = []
    if entry.chosen.key in CORRECTIONS:
        said.append(CORRECTIONS[entry.chosen.key])
    if entry.as_typed and entry.chosen.options.get("rows") == _PROFILE_ROWS:
        said.append(PROFILE)
    if entry.chosen.key == "trapezoidal" and timing.fastest and found is not None and found.triangle:
        said.append(TRIANGLE)
    return tuple(said)


_PROFILE_ROWS = tuple(tuple(map(float, row)) for row in PLUS_MINUS_ONE)


def phases_text(part: Laws, i: int) -> str:
    """Return in words the phases of a law of constant accelerations; empty for other laws.

    References
    ----------
    Notes 6.104-6.113, with the formulas of the triangle that are missing there.
    """
    found, entry = phases(part.laws[i]), part.entries[i]
    if found is None:
        return ""
    if entry.chosen.key == "trapezoidal" and part.timing.fastest and not entry.chosen.given:
        return _fastest_text(found, part.timing)
    kind = "Triangle" if found.triangle else "Trapezoid"
    steps = [f"speeds up for {amount(found.up, 's')}"] if found.up else []
    steps += [f"moves at {amount(found.peak, '1/s')} for {amount(found.coast, 's')}"] if found.coast else []
    steps += [f"slows down for {amount(found.down, 's')}"] if found.down else []
    return f"{kind} of speed: {', '.join(steps)}."


def _fastest_text(found: Phases, timing: Timing) -> str:
    L, A = timing.distance, timing.limit(2)
    total = found.up + found.coast + found.down
    if math.isinf(timing.limit(1)):
        reason = "there is no limit V"
    else:
        least = timing.limit(1) ** 2 / A
        sign = ">" if found.coast else "=" if math.isclose(L, least) else "<"
        reason = f"L = {amount(L)} {sign} V²/A = {amount(least)}"
        if not found.triangle:
            return (
                f"Trapezoid: {reason}, so T_s = V/A = {amount(found.up, 's')}, "
                f"T = (L A + V²)/(A V) = {amount(total, 's')}, constant speed for {amount(found.coast, 's')}."
            )
    return (
        f"Triangle: {reason}, so no constant speed: peak √(L A) = {amount(found.peak, '1/s')}, "
        f"T_s = √(L/A) = {amount(found.up, 's')}, T = 2 T_s = {amount(total, 's')}."
    )


def excess_text(excess: Excess) -> str:
    """Return in words how a limit is exceeded.

    Examples
    --------
    >>> excess_text(Excess(1, 3.75, 2.0, ((0.25, 0.75),)))
    'max|ṡ| = 3.75 1/s is above V = 2 1/s, from 0.25 to 0.75 s.'
    """
    order = excess.order
    unit, limit = UNITS[order], f"{LETTERS[order]} = {amount(excess.limit, UNITS[order])}"
    if math.isinf(excess.peak):
        return f"{SYMBOLS[order - 1]} jumps, so {SYMBOLS[order]} is infinite there: {limit} is not kept."
    times = ", ".join(f"{amount(low)} to {amount(high)}" for low, high in excess.spans[:3])
    more = " and later" if len(excess.spans) > 3 else ""
    name = f"max|{SYMBOLS[order]}|" if order < 3 else "the largest jerk"
    return f"{name} = {amount(excess.peak, unit)} is above {limit}, from {times} s{more}."


def class_words(continuity: float) -> str:
    """Return a class in a form that fits into a narrow column.

    >>> class_words(1.0), class_words(3.0), class_words(-1.0)
    ('C1', '≥ C3', 'jumps')
    """
    text = class_text(continuity)
    return {"C3 or smoother": "≥ C3", "not continuous": "jumps"}.get(text, text)


def optimal_text(part: Laws) -> str:
    """Return in words the optimal factor of the chosen law, or why there is none."""
    try:
        found = optimal(part)
    except InputError as refusal:
        return f"{refusal}."
    order = ("velocity", "acceleration", "jerk").index(found.quantity) + 1
    change = "slower" if found.k > 1.0 + 1e-9 else "faster" if found.k < 1.0 - 1e-9 else "neither slower nor faster"
    power = ("", "peak/V", "√(peak/A)", "∛(peak/J)")[order]
    return f"Optimal k = {amount(found.k)} ({change}): the largest is {power}, so {LETTERS[order]} is just reached."


def stretch_rows(part: Laws) -> tuple[tuple[str, str, float, float, str], ...]:
    """Return the effect of time scaling on the chosen law: name, unit, before, after, and the factor."""
    law = part.laws[part.scaled]
    after = law if part.stretched is None else part.stretched
    return (
        ("T", "s", law.duration, after.duration, "k"),
        ("max|ṡ|", UNITS[1], law.peak_speed, after.peak_speed, "1/k"),
        ("max|s̈|", UNITS[2], largest(law, 2), largest(after, 2), "1/k²"),
        ("max jerk", UNITS[3], largest(law, 3), largest(after, 3), "1/k³"),
    )


def bounds_text(bounded: Bounded, bounds: LawBounds) -> tuple[str, str]:
    """Return ``ok`` or ``no``, and the bounds in words."""
    who = f"joint {bounds.V_joint} decides" if bounds.V_joint else "chosen below the largest possible value"
    if not bounded.a_max:
        return "ok", f"V = {amount(bounds.V, '1/s')}, {who}. Type a_max to get a bound of s̈."
    by = f"; A: joint {bounds.A_joint} decides" if bounds.A_joint else ""
    head = f"V: {who}{by}. "
    return ("ok" if bounds.possible else "no"), head + bounds.explanation


class JointRow(NamedTuple):
    """The bounds of one joint.

    Attributes
    ----------
    joint : int
        1-based.
    M_v, M_v_at, M_a : float
        Largest |dq/ds| and where it is, and largest |d²q/ds²|.
    V, A : float
        The largest |s'| and |s''| it allows by itself, the latter at the V of all.
    first_speed, first_acceleration : bool
        Whether no other joint allows less.
    """

    joint: int
    M_v: float
    M_v_at: float
    M_a: float
    V: float
    A: float
    first_speed: bool
    first_acceleration: bool


def joint_rows(bounded: Bounded) -> tuple[JointRow, ...]:
    """Return the bounds of each joint (notes 6.25 and 6.33); a joint at rest has none."""
    found = bounded.found
    rows = []
    for j in range(bounded.joints):
        M_v, M_a = float(found.M_v[j]), float(found.M_a[j])
        V = float(found.limits.velocity[j]) / M_v if M_v else math.inf
        A = (float(found.limits.acceleration[j]) - found.V**2 * M_a) / M_v if M_v else math.inf
        decides = (found.V_joint == j + 1, bool(bounded.a_max) and found.A_joint == j + 1)
        rows.append(JointRow(j + 1, M_v, float(found.M_v_at[j]), M_a, V, A, *decides))
    return tuple(rows)


def factor(law: Law, peak: float, order: int) -> float | None:
    """Return T^order peak / L, the peak of the law from 0 to 1 in 1 s, or None for one that returns to its start."""
    low, high = law.span
    if abs(law.distance) <= 1e-9 * (high - low):
        return None
    return peak * law.duration**order / abs(law.distance)


def gain(law: Law) -> float:
    """Return the integral of the acceleration, s'(T) - s'(0) (notes 1.37-1.39), with rounding set to 0."""
    value = float(law.at(law.duration, 1) - law.at(0.0, 1))
    return 0.0 if abs(value) <= 1e-12 * max(law.peak_speed, 1e-300) else value
