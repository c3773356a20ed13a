"""Settings of units and names: what each is called, and its choices in words."""

from __future__ import annotations

from dataclasses import dataclass, field

from armlab.ui.units import BOOKS


@dataclass(frozen=True)
class Setting:
    """One setting of `armlab.session.parts.notation.Notation`.

    Attributes
    ----------
    title, hint : str
    options : dict
        What may be chosen, to what it is called.
    about : dict
        Other words by which the choice of an option is found.
    """

    title: str
    options: dict[str, str]
    hint: str
    about: dict[str, tuple[str, ...]] = field(default_factory=dict)


NOTATION = {
    "angle": Setting(
        "Angles in",
        {"deg": "°", "rad": "rad"},
        "Only what is shown changes, not what is computed",
        {"deg": ("degrees", "units"), "rad": ("radians", "units")},
    ),
    "length": Setting(
        "Lengths in",
        {"mm": "mm", "m": "m"},
        "Matrices are always in metres",
        {"mm": ("millimetres", "millimeters", "units"), "m": ("metres", "meters", "units")},
    ),
    "variable": Setting(
        "Variables",
        {"q": "q", "theta": "θ, d"},
        "One letter for all joint variables, or as in the table",
        {"q": ("joint variables", "notation"), "theta": ("joint variables", "notation")},
    ),
    "book": Setting(
        "Table as in",
        {key: book.title for key, book in BOOKS.items()},
        "Order and letters of the columns; standard or modified is chosen with the table",
        dict.fromkeys(BOOKS, ("textbook", "notation", "DH table")),
    ),
    "notes": Setting(
        "Course notes",
        {"off": "Off", "on": "On"},
        "Show equation numbers and errata of the course notes where they belong",
        dict.fromkeys(("off", "on"), ("equation numbers", "errata", "references")),
    ),
}
"""The settings, by the names of their fields."""
