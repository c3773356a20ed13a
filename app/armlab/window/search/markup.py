"""Markup of the search: the dialog, and one line for each find."""

from __future__ import annotations

from collections.abc import Iterable

from armlab.content.index import LONGEST, Entry
from armlab.content.rows import rows
from armlab.session.state import State
from armlab.ui.form import Form, Pressed, Typed
from armlab.ui.format import so_many
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.search_button import glass
from armlab.ui.units import units_of
from armlab.window.search.offers import Offer

FIELD, CLOSED, HIT = "search", "search-closed", "hit "
"""Cells: of the field, of what the page sends when the dialog is closed, and the beginning of those of finds."""

KINDS = {
    "bench": "page",
    "arm": "arm",
    "lesson": "lesson",
    "row": "topic",
    "chapter": "chapter",
    "function": "code",
    "command": "command",
    "setting": "setting",
    "export": "file",
}
"""Names of the kinds of entries."""

EXAMPLES = {
    "inverse kinematics": "a topic of the course",
    "UR5": "an arm",
    "waypoints": "something to do",
    "CSV": "a file to save",
    "top view": "a command",
    "dark": "a setting",
    "4.1": "a section or an equation of the notes",
}
"""Queries to try, and what each of them is."""

PLACEHOLDER = "Pages, arms, lessons, topics, commands, files"


def dialog(field: Markup, query: str, said: Inside, *listed: Inside) -> Markup:
    """Return the dialog, which the page's script opens.

    Parameters
    ----------
    field : Markup
    query : str
        What the list is about.
    said : str or Markup
        A line below it.
    *listed : Markup
        Options, or groups of them.
    """
    close = tag("button.shut", "✕", type="button", data_shut=True, title="Close (Esc)", aria_label="Close", tabindex=-1)
    head = tag("div.ask-line", glass(), field, close)
    found = tag("div.hits", listed, id="al-hits", role="listbox", aria_label="Finds", data_query=query)
    keys = tag("span.keys-line", tag("kbd", "↑"), tag("kbd", "↓"), " choose ", tag("kbd", "Enter"), " open")
    foot = tag("p.foot-line", tag("span", said, role="status"), keys)
    return tag("dialog.al-search", head, found, foot, id="al-search", aria_label="Search", aria_modal="true")


def search_field(form: Form, query: str, action: Typed) -> Markup:
    """Return the field of the dialog, which sends what is typed as it is typed."""
    return form.field(
        FIELD,
        query,
        "Search",
        action,
        inputmode="search",
        data_live="1",
        placeholder=PLACEHOLDER,
        maxlength=str(LONGEST),
        role="combobox",
        aria_expanded="true",
        aria_controls="al-hits",
        aria_autocomplete="list",
        spellcheck="false",
        autocapitalize="none",
        enterkeyhint="go",
    )


def group(title: Inside, options: Iterable[Markup], label: str) -> Markup:
    """Return options with a heading."""
    return tag("div", tag("h3", title, aria_hidden="true"), options, role="group", aria_label=label)


def examples() -> Markup:
    """Return queries to try."""
    options = (
        _option(f"try-{i}", _inside(text, kind, ""), data_ask=text) for i, (text, kind) in enumerate(EXAMPLES.items())
    )
    return group("For example", options, "For example")


def hit(form: Form, number: int, entry: Entry, action: Pressed, offer: Offer | None, state: State) -> Markup:
    """Return the line of an entry.

    A topic is asked for in turn, a function of the core is copied as its line of import, anything else has an action.
    """
    if asked := asked_of(entry):
        kind = f"{KINDS[entry.kind]} ›"
        title = units_of(state).said(entry.title)
        return _option(f"hit-{number}", _inside(title, kind, _leads(entry)), data_ask=asked)
    if entry.kind == "function":
        name = entry.key.removeprefix("armlab.kin.")
        module, _, last = entry.key.rpartition(".")
        inside = _inside(name, "code", entry.detail)
        return _option(
            f"hit-{number}", inside, data_copy=f"from {module} import {last}", title="Copy its line of import"
        )
    aside = KINDS[entry.kind]
    if offer is not None and offer.is_on is not None:
        aside = f"{aside} · {'on' if offer.is_on(state) else 'off'}"
    inside = _inside(entry.title, aside, entry.detail, entry.within, offer.key if offer is not None else "")
    cell = f"{HIT}{entry.kind}:{entry.key}"
    brings = "1" if offer is not None and offer.at else ""
    named = {"id": f"al-hit-{number}", "role": "option", "tabindex": "-1", "data_brings": brings}
    return form.button(cell, inside, action, "hit", "", "", None, False, **named)


def asked_of(entry: Entry) -> str:
    """Return the query that a topic or a chapter stands for; empty for anything else."""
    return {"row": entry.key, "chapter": f"chapter {entry.key}"}.get(entry.kind, "")


def topic_head(key: str, state: State) -> Inside:
    """Return the heading of what belongs to a topic of the notes."""
    row = rows()[key]
    return units_of(state).said(row.title), tag("small", f" Section {row.section}")


def _option(name: str, inside: Inside, **more: str) -> Markup:
    return tag("button.hit", inside, id=f"al-{name}", type="button", role="option", tabindex=-1, **more)


def _inside(title: str, kind: str, detail: str, within: str = "", key: str = "") -> Inside:
    path = tag("span.within", within, " › ") if within else None
    return (
        tag("b", path, title),
        tag("i", tag("kbd", key) if key else None, kind),
        tag("span.about", detail) if detail else None,
    )


def _leads(entry: Entry) -> str:
    """Return the details of a topic, with how many lessons and pages belong to it, or that the lab has none."""
    if entry.kind == "chapter":
        return entry.detail
    if entry.absent:
        return f"{entry.detail} · {entry.absent}"
    counts = ((len(entry.lessons), "lesson"), (len(entry.benches), "page"))
    told = ", ".join(so_many(count, word) for count, word in counts if count)
    return f"{entry.detail} · {told}" if told else entry.detail
