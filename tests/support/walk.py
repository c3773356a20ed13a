"""Opening every page of the lab, one after the other, on one page of the browser."""

from __future__ import annotations

from collections.abc import Iterator

from armlab.session.pages import pages, tab_of
from support.page import LabPage

PLACES = """() => {
  const strip = [...document.querySelectorAll('.al .pages')].find(each => each.getClientRects().length);
  return [...strip?.children ?? []].map(page => {
    const { left, top, width, height } = page.getBoundingClientRect();
    return [page.dataset.name, left, top, width, height];
  });
}"""
"""Name and place of each page of the open tab, if it has several."""


def every_page(lab: LabPage) -> Iterator[str]:
    """Open the pages in the order of their tabs; yields the key of each while it is open."""
    known = pages()
    for key in sorted(known, key=lambda key: list(known).index(tab_of(key))):
        if key == tab_of(key):
            lab.tab(known[key].title).click()
            lab.rest()
        page = lab.page.locator(f'.pages button[data-cell="{key}"]:visible')
        if page.count() and page.get_attribute("aria-selected") != "true":
            page.click()
            lab.rest()
        assert page.count() or not known[key].tab
        yield key
