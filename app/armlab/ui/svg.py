"""Drawings in a page: lengths and places are in pixels, to a tenth."""

from __future__ import annotations

from armlab.ui.html import Attribute, Inside, Markup, tag


def drawing(kind: str, wide: float, high: float, label: str, *inside: Inside) -> Markup:
    """Return a drawing.

    Parameters
    ----------
    kind : str
        Its class; empty for none.
    wide, high : float
    label : str
        What is seen, read aloud in its place.
    *inside : Markup or several
    """
    name = f"svg.{kind}" if kind else "svg"
    return tag(name, inside, viewBox=f"0 0 {wide:g} {high:g}", role="img", aria_label=label)


def shape(kind: str, /, *inside: Inside, **attributes: Attribute | float) -> Markup:
    """Return an element of a drawing; see `tag`.

    >>> print(shape("circle.here", cx=2.345, cy=10, r=4.5))
    <circle class="here" cx="2.3" cy="10" r="4.5"></circle>
    """
    rounded = {name: f"{value:.1f}" if isinstance(value, float) else value for name, value in attributes.items()}
    return tag(kind, *inside, **rounded)
