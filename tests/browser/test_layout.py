"""No page is much longer than the window when it is first seen, and what is folded is there when it is wanted."""

import pytest

from armlab.session.pages import pages

pytestmark = pytest.mark.browser

WIDE = (1400, 850)

SMALL = (1024, 850)
"""A narrow panel, in which lines break more often."""

MOST = 1040
"""Pixels of the longest page; the window shows 835 at once."""

SIZES = """() => {
  const every = [...document.querySelectorAll('[data-dock-region=right] .al')];
  let pane = every.find(each => each.getClientRects().length);
  while (!/auto|scroll/.test(getComputedStyle(pane).overflowY)) pane = pane.parentElement;
  return [pane.scrollHeight, pane.scrollWidth - pane.clientWidth];
}"""
"""Height of the open page, and how far it goes beyond its sides."""


def test_no_page_is_much_longer_than_the_window_or_wider_than_its_panel(visit):
    lab = visit(size=SMALL)
    long, wide = {}, {}
    for key in pages():
        lab.open_tab(key)
        height, beyond = lab.page.evaluate(SIZES)
        if height > MOST:
            long[key] = height
        if beyond > 1:
            wide[key] = beyond
    assert (long, wide) == ({}, {})


def test_what_was_unfolded_stays_so_when_its_content_changes(visit):
    lab = visit(size=WIDE)
    lab.open_tab("laws")
    values = lab.page.locator(".law-table").first
    assert not values.is_visible()
    lab.unfold("Values, peaks and classes")
    assert values.is_visible()
    lab.type_into("t-duration", "4")
    lab.until(lambda: "4" in values.inner_text())
    assert values.is_visible()


def test_a_fold_holds_plots_and_sliders_as_well(visit):
    lab = visit(size=WIDE)
    lab.open_tab("laws")
    best = lab.page.locator('button[data-cell="optimal"]')
    plots = lab.page.locator(".uplot")
    assert not best.is_visible()
    assert [plots.nth(i).is_visible() for i in range(4)] == [True, True, False, False]
    lab.press("optimal")
    lab.unfold("Acceleration and jerk")
    assert best.is_visible()
    assert min(plots.nth(3).bounding_box()[side] for side in ("width", "height")) > 60


def test_the_search_opens_the_fold_in_which_a_file_is_saved(visit):
    lab = visit(size=WIDE)
    lab.page.keyboard.press("Control+k")
    lab.page.keyboard.type("save toml")
    lab.page.locator("#al-search [role=option]", has_text="TOML").first.click()
    lab.until(lambda: lab.page.locator('button[data-cell="save"]').is_visible())
