"""The terms of the course: what each means, its symbol, and the page where it is seen."""

from __future__ import annotations

from functools import partial

from armlab.benches.help.glossary.terms import TERMS, Term
from armlab.session.pages import pages, tabs
from armlab.session.state import Post, State
from armlab.ui.form import Form
from armlab.ui.format import mathml
from armlab.ui.html import Markup, tag
from armlab.ui.markup import fold
from armlab.ui.plugin import Panel, Show
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the list."""
    form = gui.form(post)

    def show(state: State) -> None:
        del state
        if not form.shows():
            form.show([_tab(gui, form, tab, terms) for tab, terms in _by_tab().items()])

    return show


def _by_tab() -> dict[str, list[Term]]:
    """Return the terms by the title of the tab where they are seen, in the order of the tabs."""
    found: dict[str, list[Term]] = {first.title: [] for first, *_ in tabs().values()}
    for term in TERMS:
        page = pages()[term.page]
        found[pages()[page.tab or page.key].title].append(term)
    return {title: terms for title, terms in found.items() if terms}


def _tab(gui: Gui, form: Form, title: str, terms: list[Term]) -> Markup:
    """Return the terms of a tab, folded; their names are read without unfolding."""
    names = tag("small.dim", ", ".join(term.name for term in terms))
    return fold((title, " ", names), tag("dl.gl-terms", [_term(gui, form, term) for term in terms]), key=title)


def _term(gui: Gui, form: Form, term: Term) -> Markup:
    page = pages()[term.page]
    place = title if (title := page.name) == (tab := pages()[page.tab or page.key].title) else f"{tab} › {title}"
    others = tag("small", f" also: {', '.join(term.others)}") if term.others else None
    symbol = (" ", mathml(term.symbol)) if term.symbol else None
    seen = form.button(f"see {term.name}", place, partial(gui.open_panel, term.page), "copy", f"Open {place}")
    return tag("div", tag("dt", term.name, symbol, others), tag("dd", term.says, " ", seen))


PANEL = Panel((), build)
