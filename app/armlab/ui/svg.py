"""Shapes of drawn pictures, in coordinates of the picture with one decimal, which is a tenth of a pixel."""

from __future__ import annotations

from armlab.ui.html import Attribute, Inside, Markup, tag


def drawing(kind: str, width: float, height: float, label: str, *inside: Inside, **more: Attribute) -> Markup:
    """Return a picture of the given size, in its own units; the label is read aloud."""
    box = f"0 0 {_short(width)} {_short(height)}"
    return tag(f"svg.{kind}" if kind else "svg", *inside, viewBox=box, role="img", aria_label=label, **more)


def shape(kind: str, /, *inside: Inside, **attributes: Attribute | float) -> Markup:
    """Return any element of a picture, whose numbers have one decimal; see `tag`.

    >>> print(shape("rect.here", x=2.345, y=10, fill="red"))
    <rect class="here" x="2.3" y="10" fill="red"></rect>
    """
    rounded = {name: _at(value) if isinstance(value, float) else value for name, value in attributes.items()}
    return tag(kind, *inside, **rounded)


def line(kind: str, x1: float, y1: float, x2: float, y2: float) -> Markup:
    """Return a line."""
    return tag(f"line.{kind}", x1=_at(x1), y1=_at(y1), x2=_at(x2), y2=_at(y2))


def circle(kind: str, x: float, y: float, radius: float) -> Markup:
    """Return a circle."""
    return tag(f"circle.{kind}" if kind else "circle", cx=_at(x), cy=_at(y), r=f"{radius:g}")


def text(kind: str, x: float, y: float, inside: Inside, anchor: str | None = None) -> Markup:
    """Return a text that begins at a point, or has its ``middle`` or ``end`` there."""
    return tag(f"text.{kind}" if kind else "text", inside, x=_at(x), y=_at(y), text_anchor=anchor)


def path(kind: str, d: str) -> Markup:
    """Return a path."""
    return tag(f"path.{kind}", d=d)


def _at(value: float) -> str:
    return f"{value:.1f}"


def _short(value: float) -> str:
    """Return the number without a zero decimal."""
    return f"{value:.1f}".removesuffix(".0")
