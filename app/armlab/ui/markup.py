"""Our own buttons, choices and fields as markup: the page's script sends what a person does with them.

Texts and attributes are escaped here; what is called ``inside`` is markup of the caller. ``channel`` is the
`channel_id` of the `Fields` that gets ``cell`` and the value.
"""

from __future__ import annotations

from collections.abc import Mapping

from armlab.ui.format import escaped


def button(
    channel: str,
    cell: str,
    inside: str,
    kind: str = "",
    hint: str = "",
    label: str = "",
    pressed: bool | None = None,
    off: bool = False,
    **more: str,
) -> str:
    """Return a button.

    Parameters
    ----------
    channel, cell : str
    inside : str
        Markup.
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
    before = f' class="{kind}"' if kind else ""
    after = _attributes(title=hint, aria_label=label, **more)
    if pressed is not None:
        after += f' aria-pressed="{str(pressed).lower()}"'
    return (
        f'<button{before} data-chan="{channel}" data-cell="{escaped(cell)}"{after}{" disabled" if off else ""}>'
        f"{inside}</button>"
    )


def chip(channel: str, cell: str, text: str, hint: str = "", pressed: bool | None = None, off: bool = False) -> str:
    """Return a small button with a text."""
    return button(channel, cell, escaped(text), "chip", hint, pressed=pressed, off=off)


def chips(channel: str, options: Mapping[str, str], chosen: str, hint: str) -> str:
    """Return a chip for each option, key to text, of which one is pressed."""
    return "".join(chip(channel, key, text, hint, key == chosen) for key, text in options.items())


def copy_button(name: str, text: str, kind: str = "copy") -> str:
    """Return a button that copies a text; the name says in which form."""
    said = escaped(name)
    return f'<button class="{kind}" data-copy="{escaped(text)}" title="Copy as {said}">{said}</button>'


def select(channel: str, cell: str, label: str, inside: str, hint: str = "") -> str:
    """Return a choice among `options`."""
    named = _attributes(title=hint, aria_label=label)
    return f'<select data-chan="{channel}" data-cell="{escaped(cell)}"{named}>{inside}</select>'


def options(texts: Mapping[str, str], chosen: str) -> str:
    """Return the options of a choice, value to text."""
    return "".join(
        f'<option value="{escaped(value)}"{" selected" if value == chosen else ""}>{escaped(text)}</option>'
        for value, text in texts.items()
    )


def groups(texts: Mapping[str, Mapping[str, str]], chosen: str) -> str:
    """Return the options of a choice in groups, title to value to text; those without a title come by themselves."""
    made = {title: options(of, chosen) for title, of in texts.items()}
    return "".join(f'<optgroup label="{escaped(title)}">{of}</optgroup>' if title else of for title, of in made.items())


def field(channel: str, cell: str, value: str, label: str, off: bool = False, **more: str) -> str:
    """Return a field to type in; its text is sent when Enter is pressed or the field is left."""
    named = _attributes(aria_label=label, **more)
    return (
        f'<input class="field" autocomplete="off"{named} value="{escaped(value)}" data-chan="{channel}"'
        f' data-cell="{escaped(cell)}"{" disabled" if off else ""}>'
    )


def area(channel: str, cell: str, value: str, label: str, lines: int, **more: str) -> str:
    """Return a field of several lines; its text is sent when the field is left."""
    named = _attributes(aria_label=label, **more)
    return (
        f'<textarea class="field" rows="{lines}" spellcheck="false"{named} data-chan="{channel}"'
        f' data-cell="{escaped(cell)}">{escaped(value)}</textarea>'
    )


def row(label: str, inside: str, wide: bool = False, cells: bool = False, hint: str = "") -> str:
    """Return a line of controls after a label, which is markup, too.

    ``wide`` leaves room for a long label; ``cells`` keeps fields of equal width on one line.
    """
    kind, around = "row wide" if wide else "row", ' class="cells"' if cells else ""
    return f'<div class="{kind}"{_attributes(title=hint)}><span>{label}</span><div{around}>{inside}</div></div>'


def _attributes(**values: str) -> str:
    return "".join(f' {name.replace("_", "-")}="{escaped(value)}"' for name, value in values.items() if value)
