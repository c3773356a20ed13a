"""The list of the errata with its filters."""

from __future__ import annotations

from functools import partial
from itertools import groupby

from armlab.benches.lessons.errata.state import ALL, Choose, Errata
from armlab.content.errata import CHAPTERS, SEVERITIES, Erratum, errata
from armlab.content.rows import chapters
from armlab.session.fields import Set
from armlab.session.state import State
from armlab.teaching.parts.errata_practice import Practice
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag


def filters(form: Form, state: State) -> Inside:
    """Return the fields that narrow the list."""
    part = state[Errata]
    severities = {ALL: "all kinds", **{letter: f"{letter} · {words}" for letter, words in SEVERITIES.items()}}
    titles = chapters()
    wanted = {ALL: "all chapters", **{key: f"{key} {titles[key]}" for key in CHAPTERS}}
    query = form.field(
        "query",
        part.query,
        "Search errata by equation number or word",
        partial(Set, Errata, "query"),
        inputmode="search",
        placeholder="find: 4.93, sign …",
        maxlength="60",
        spellcheck="false",
    )
    return (
        tag(
            "div.kit-head.er-filters",
            query,
            form.select("severity", "Severity", severities, part.severity, partial(Set, Errata, "severity")),
            form.select("chapter", "Chapter", wanted, part.chapter, partial(Set, Errata, "chapter")),
        ),
    )


def entries(form: Form, state: State) -> Inside:
    """Return the list, by chapter, and how many it holds."""
    part, done = state[Errata], state[Practice].done
    found = part.listed
    here = part.erratum if part.erratum in found else None
    entry = here or next(iter(found), None)
    groups = [
        (
            tag("h4", f"{chapters()[chapter]}"),
            [_entry(form, each, each is here, each is entry, each.id in done) for each in of_chapter],
        )
        for chapter, of_chapter in groupby(found, lambda each: each.chapter)
    ]
    nothing = tag("p.dim", "Nothing is found. Try another number or word, or all chapters.")
    count = f"{len(found)} of {len(errata())} errata"
    return (
        tag("p.er-count.dim", count, role="status"),
        tag("div.er-list", groups or nothing, role="group", aria_label="Errata", data_follows="errata", data_roves="1"),
    )


def _entry(form: Form, each: Erratum, here: bool, entry: bool, done: bool) -> Markup:
    """Return one line; the keyboard comes to the list at one of them, and arrow keys go on from there."""
    inside = (tag("b", each.id), tag("i", each.severity), tag("span", each.title), "✓" if done else None)
    return form.button(
        f"erratum {each.id}",
        inside,
        Choose(each.id),
        "er-entry",
        aria_current="true" if here else "",
        data_rove="1",
        tabindex="0" if entry else "-1",
    )
