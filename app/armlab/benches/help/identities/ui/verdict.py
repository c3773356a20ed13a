"""The verdict on two formulas, in words and numbers."""

from __future__ import annotations

from armlab.benches.help.identities.state import Identities, comparison_of, kinds_of
from armlab.content.identity import DRAWN, POINTS, TOLERANCE, Comparison
from armlab.session.state import State
from armlab.ui.format import MINUS, pairs, readable, scientific, so_many
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import verdict_box

REAL = 1e-12
"""Largest part of a number, in its own size, that is not written."""


def verdict_markup(state: State) -> Markup:
    """Return whether both sides agree, or where they differ most and by how much."""
    found, seed = comparison_of(state), state[Identities].seed
    count = len(found.left)
    if count == 0:
        said = f"At none of {DRAWN} points have both sides a value, as with a division by zero."
        return verdict_box("no", "Nothing to compare", tag("p", said))
    if found.agrees:
        said = f"The largest difference is {scientific(float(found.difference.max()))}; points of seed {seed}."
        note = "Agreement at points is no proof, but a wrong formula would hardly pass."
        head = f"They agree at {POINTS} points to {_power(TOLERANCE)}"
        return verdict_box("ok", head, tag("p", said, " ", note), _left_out(found))
    if found.close.all():
        return verdict_box("todo", _agreed(count), _left_out(found))
    k = found.worst
    close = int(found.close.sum())
    head = f"They differ by up to {readable(float(found.difference[k]), 4)}"
    rows: list[tuple[Inside, Inside]] = [
        (f"{name}, {kinds_of(state)[name]}", value_text(complex(value)))
        for name, value in zip(found.names, found.points[k], strict=True)
    ]
    rows += [("left side", value_text(complex(found.left[k]))), ("right side", value_text(complex(found.right[k])))]
    return joined(
        verdict_box("no", head, tag("p", _share(found, close, count)), _left_out(found)),
        tag("h3", "Where they differ most"),
        pairs(rows),
    )


def _agreed(count: int) -> str:
    return f"They agree at the {'only point that there is' if count == 1 else f'{count} points that there are'}"


def _share(found: Comparison, close: int, count: int) -> str:
    if found.opposite:
        return "One is the other with the opposite sign."
    if close:
        return f"They agree at {close} of {count} points: it may hold in a part of the plane, or of the line."
    return f"They agree at none of {count} points."


def _left_out(found: Comparison) -> Markup | None:
    missing = found.drawn - len(found.left)
    if not missing:
        return None
    return tag("p", f"At {so_many(missing, 'more point')} a part of them has no value, or one too large to compare.")


def value_text(value: complex) -> str:
    """Return a number, with its imaginary part if it has one.

    >>> value_text(1.5 + 0j), value_text(-1 - 2j), value_text(2j)
    ('1.5', '−1 − 2 i', '2 i')
    """
    size = max(1.0, abs(value))
    if abs(value.imag) <= REAL * size:
        return readable(value.real, 6)
    sign = MINUS if value.imag < 0.0 else "+"
    imaginary = f"{readable(abs(value.imag), 6)} i"
    if abs(value.real) <= REAL * size:
        return f"{MINUS if value.imag < 0.0 else ''}{imaginary}"
    return f"{readable(value.real, 6)} {sign} {imaginary}"


def _power(value: float) -> str:
    return scientific(value, 0).removeprefix("1·")
