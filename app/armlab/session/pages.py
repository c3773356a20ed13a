"""The pages of all benches, known before anybody opens them, and the tabs in which they lie."""

from __future__ import annotations

from functools import cache

from armlab.errors import PluginError
from armlab.page import Page
from armlab.plugins import discover_pages

FIRST = "joints"
"""Key of the page that a student sees first."""


@cache
def pages() -> dict[str, Page]:
    """Return what is known of all pages in order, without their panels."""
    found = discover_pages("PAGE", Page)
    for page in found.values():
        if page.tab and (page.tab not in found or found[page.tab].tab):
            raise PluginError(f"page {page.key}: there is no tab {page.tab!r}")
    return found


@cache
def tabs() -> dict[str, tuple[Page, ...]]:
    """Return the tabs in order: the key of each, which is that of its first page, and its pages."""
    found = pages()
    return {
        key: (first, *(page for page in found.values() if page.tab == key))
        for key, first in found.items()
        if not first.tab
    }


def tab_of(page: str) -> str:
    """Return the key of the tab in which a page lies."""
    return pages()[page].tab or page


def place_of(page: str) -> str:
    """Return where a page is found: the title of its tab and, if there are several in it, the name of the page."""
    tab = tabs()[tab_of(page)]
    return f"{tab[0].title} › {pages()[page].name}" if len(tab) > 1 else tab[0].title
