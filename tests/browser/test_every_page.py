"""Every page of the lab: as axe-core sees it in both looks, its size, its place in its tab, and the console's word."""

import pytest

from armlab.session.pages import tab_of, tabs
from support.axe import findings
from support.walk import PLACES, every_page

pytestmark = pytest.mark.browser

NARROW = (1024, 850)
"""A narrow panel, in which lines break more often."""

MOST = 1040
"""Pixels of the longest page; the window shows 835 at once."""

ROWS = 2
"""Most rows of the names of a tab's pages."""

LEAST = 32
"""Side of what a finger can hit, pixels."""

SIZES = """() => {
  const every = [...document.querySelectorAll('[data-dock-region=right] .al')];
  let pane = every.find(each => each.getClientRects().length);
  while (!/auto|scroll/.test(getComputedStyle(pane).overflowY)) pane = pane.parentElement;
  const names = [...document.querySelectorAll('[data-dock-region=right] .page')].filter(name => name.offsetParent);
  return [pane.scrollHeight, pane.scrollWidth - pane.clientWidth, new Set(names.map(name => name.offsetTop)).size];
}"""
"""Height of the open page, how far it goes beyond its sides, and how many rows the names of its tab's pages take."""


CUT = """() => [...document.querySelectorAll('[data-dock-region=right] input.field')]
  .filter(each => each.getClientRects().length && each.scrollWidth > each.clientWidth + 1)
  .map(each => `${each.dataset.cell}: ${each.value} is cut`)"""
"""Fields of the open page in which not all can be read."""

UNFOLDED = """() => {
  for (const fold of document.querySelectorAll('[data-dock-region=right] details')) fold.open = true;
}"""


PLANTED = """() => {
  const shown = [...document.querySelectorAll('[data-dock-leaf] .al')].find(each => each.offsetHeight > 50);
  shown.insertAdjacentHTML('beforeend', `<div class=planted>
    <p style="color: #39424f">in the dark</p><p style="color: #c3ccd8">in the light</p>
    <button></button><img><input><p role=buton>a role</p>
    <p id=twice>one</p><p id=twice>two</p><p role=group aria-labelledby=twice></p>
  </div>`);
}"""
"""Puts into the open page two texts, each too pale in one look, a button, a picture and a field without a name, a role
that does not exist, and a name that two have."""

FAULTS = [
    "dark: color-contrast",
    "light: aria-roles",
    "light: button-name",
    "light: color-contrast",
    "light: duplicate-id-aria",
    "light: image-alt",
    "light: label",
]


def finds_what_is_planted_and_nothing_else(lab, **around):
    lab.page.evaluate(PLANTED)
    assert sorted(each.split(" at ")[0] for each in findings(lab, **around)) == FAULTS
    lab.page.evaluate("() => document.querySelector('.planted').remove()")


def names_out_of_place(lab, key, first):
    """Return what is wrong with the names of the pages of a tab, which stay where they are, whichever page is open."""
    now = lab.page.evaluate(PLACES)
    names = [page.name for page in tabs().get(tab_of(key), ())]
    bad = [f"the pages are {now}"] * ([name for name, *_ in now] != (names if len(names) > 1 else []))
    bad += [f"{name} is too small" for name, *_, width, height in now if min(width, height) < LEAST]
    return bad + ["the names have moved"] * (now != first.setdefault(tab_of(key), now))


def test_no_page_is_a_barrier_too_long_too_wide_or_out_of_its_place_in_the_tab(visit):
    """What lies around the panel is looked at once; that the judge is there is seen before and after its work."""
    lab = visit(size=NARROW)
    finds_what_is_planted_and_nothing_else(lab)
    found, first = {}, {}
    for key in every_page(lab):
        found[key] = [*findings(lab, whole=False), *lab.errors, *names_out_of_place(lab, key, first)]
        height, beyond, rows = lab.page.evaluate(SIZES)
        found[key] += [f"{height} px long"] * (height > MOST) + [f"{beyond} px too wide"] * (beyond > 1)
        found[key] += [f"{rows} rows of pages"] * (rows > ROWS) + lab.page.evaluate(CUT)
    assert {key: bad for key, bad in found.items() if bad} == {}
    finds_what_is_planted_and_nothing_else(lab, whole=False)


def test_in_radians_and_metres_no_field_is_cut_and_no_page_is_wider_than_its_panel(visit):
    lab = visit(size=(1024, 700))
    lab.open_tab("View")
    for unit in ("rad", "m"):
        lab.press(unit)
    found = {}
    for key in every_page(lab):
        lab.page.evaluate(UNFOLDED)
        _, beyond, _ = lab.page.evaluate(SIZES)
        found[key] = lab.page.evaluate(CUT) + [f"{beyond} px too wide"] * (beyond > 1)
    assert {key: bad for key, bad in found.items() if bad} == {}
