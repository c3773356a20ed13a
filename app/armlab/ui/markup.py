"""The lab's own buttons, choices and fields as markup; the page's script sends what the student does with them.

``channel`` is the `channel_id` of the `Fields` that gets ``cell`` and the value.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from armlab.content.as_written import as_part
from armlab.content.words import UNIT
from armlab.ui.html import Inside, Markup, classes, joined, tag
from armlab.ui.paper import address

SIGNS = {"ok": "✓", "warn": "◐", "todo": "◐", "no": "✕"}
"""Signs of the kinds of verdict, because no meaning is carried by a colour alone."""

_BEFORE_UNIT = re.compile(rf", (?={UNIT}\s*\Z)")


def button(
    channel: str,
    cell: str,
    inside: Inside,
    kind: str = "",
    hint: str = "",
    label: str = "",
    pressed: bool | None = None,
    off: bool = False,
    **more: str,
) -> Markup:
    """Return a button.

    Parameters
    ----------
    channel, cell : str
    inside : str, Markup or several
    kind : str
        Its classes.
    hint, label : str
        Shown under the pointer, and read aloud instead of what is inside; empty for none.
    pressed : bool, optional
        Of a button that stays down.
    off : bool
        Whether it cannot be pressed.
    **more : str
        Further attributes, with ``_`` for ``-``.
    """
    named = _said(title=hint, aria_label=label, **more)
    state = None if pressed is None else str(pressed).lower()
    return tag(
        "button",
        inside,
        class_=kind or None,
        data_chan=channel,
        data_cell=cell,
        **named,
        aria_pressed=state,
        disabled=off,
    )


def chip(channel: str, cell: str, text: str, hint: str = "", pressed: bool | None = None, off: bool = False) -> Markup:
    """Return a small button with a text."""
    return button(channel, cell, text, "chip", hint, pressed=pressed, off=off)


def chips(channel: str, options: Mapping[str, str], chosen: str, hint: str) -> Markup:
    """Return a chip for each option, key to text, with the chosen one pressed."""
    return joined([chip(channel, key, text, hint, key == chosen) for key, text in options.items()])


def copy_button(name: str, text: str, kind: str = "copy") -> Markup:
    """Return a button that copies a text in the form that ``name`` tells."""
    return tag("button", name, class_=kind, data_copy=text, title=f"Copy as {name}")


def on_paper(text: str, kind: str, key: str = "", hint: str = "") -> Markup:
    """Return a link to a page to print, which opens beside the lab.

    Parameters
    ----------
    text, hint : str
    kind : str
        First word of its address, such as ``course``.
    key : str
        The course; empty for the first.
    """
    return tag("a.chip", text, href=address(kind, key), target="_blank", rel="noopener", title=hint)


def select(channel: str, cell: str, label: str, inside: Inside, hint: str = "") -> Markup:
    """Return a choice among `options`."""
    return tag("select", inside, data_chan=channel, data_cell=cell, **_said(title=hint, aria_label=label))


def options(texts: Mapping[str, str], chosen: str) -> Markup:
    """Return the options of a choice, value to text."""
    return joined([tag("option", text, value=value, selected=value == chosen) for value, text in texts.items()])


def groups(texts: Mapping[str, Mapping[str, str]], chosen: str) -> Markup:
    """Return the options of a choice in groups, title to value to text; an empty title makes no group."""
    made = {title: options(of, chosen) for title, of in texts.items()}
    return joined([tag("optgroup", of, label=as_part(title)) if title else of for title, of in made.items()])


def field(channel: str, cell: str, value: str, label: str, off: bool = False, **more: str) -> Markup:
    """Return a field to type in; its text is sent when Enter is pressed or the field is left."""
    named = _said(aria_label=label, **more)
    bound = {"value": value, "data_chan": channel, "data_cell": cell}
    return tag("input.field", autocomplete="off", **named, **bound, disabled=off)


def area(channel: str, cell: str, value: str, label: str, lines: int, **more: str) -> Markup:
    """Return a field of several lines; its text is sent when the field is left."""
    named = _said(aria_label=label, **more)
    return tag("textarea.field", value, rows=lines, spellcheck="false", **named, data_chan=channel, data_cell=cell)


def unparted(label: Inside) -> Inside:
    """Return the label of a field with its unit on the line of the last word, however narrow the column is.

    >>> unparted("Moves, °")
    'Moves,\\xa0°'
    """
    if label is None or isinstance(label, Markup):
        return label
    if isinstance(label, str):
        return _BEFORE_UNIT.sub(",\u00a0", label)
    parts = [*label]
    return [*parts[:-1], *(unparted(last) for last in parts[-1:])]


def row(label: Inside, inside: Inside, wide: bool = False, cells: bool = False, hint: str = "") -> Markup:
    """Return a line of controls after a label.

    ``wide`` leaves room for a long label; ``cells`` keeps fields of equal width on one line.
    """
    around = tag("div.cells" if cells else "div", inside)
    return tag(classes("div.row", wide=wide), tag("span", unparted(label)), around, title=hint or None)


def progress_bar(done: float) -> Markup:
    """Return a progress bar, which is not read aloud, because the words beside it say the same."""
    return tag("div.progress", style=f"--part:{100.0 * done:.0f}%")


def verdict_box(kind: str, head: Inside, *inside: Inside, sign: str | None = None, role: str | None = None) -> Markup:
    """Return a coloured card with a heading after the sign of its kind, a key of `SIGNS`, or another sign."""
    sign = SIGNS[kind] if sign is None else sign
    return tag(f"div.verdict.{kind}", tag("b", f"{sign} ".lstrip(), head), inside, role=role)


def fold(title: Inside, *inside: Inside, opened: bool = False, kind: str = "", key: str = "") -> Markup:
    """Return a part of a panel that a person folds and unfolds.

    The page's script remembers what was done with it when the markup is replaced, and opens it when the search leads to
    something inside.

    Parameters
    ----------
    title : str, Markup or several
    *inside : str, Markup or several
    opened : bool
        Whether it is open at first.
    kind : str
        A further class.
    key : str
        What it is remembered by, for a title that changes; the text of the title if empty.
    """
    head = tag("summary", title)
    return tag(f"details.kit-fold{'.' if kind else ''}{kind}", head, inside, open=opened, data_fold=key or None)


def _said(**values: str) -> dict[str, str]:
    """Return the attributes that have a value."""
    return {name: value for name, value in values.items() if value}
