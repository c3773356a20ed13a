"""Every page of the lab: as axe-core sees it in both looks, its length and width, and what the console says."""

import pytest

from support.axe import findings
from support.walk import every_page

pytestmark = pytest.mark.browser

NARROW = (1024, 850)
"""A narrow panel, in which lines break more often."""

MOST = 1040
"""Pixels of the longest page; the window shows 835 at once."""

ROWS = 2
"""Most rows of the names of a tab's pages."""

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
  shown.insertAdjacentHTML('beforeend', '<p class=planted style="color: #39424f">in the dark</p>'
    + '<button class=planted></button>');
}"""
"""Puts a text that is too pale in the dark look only, and a button without a name, into the open page."""


def test_no_page_is_a_barrier_or_much_longer_than_the_window_or_wider_than_its_panel(visit):
    """What lies around the panel is looked at once; the dark look, of the same rules of style, on every other page."""
    lab = visit(size=NARROW)
    # The judge is there: of all around it finds what was planted, and nothing else.
    lab.page.evaluate(PLANTED)
    assert [each.split(" at ")[0] for each in findings(lab)] == ["light: button-name", "dark: color-contrast"]
    lab.page.evaluate("() => document.querySelectorAll('.planted').forEach(each => each.remove())")
    found = {}
    for k, key in enumerate(every_page(lab)):
        found[key] = [*findings(lab, ("light", "dark")[: 1 + k % 2], whole=False), *lab.errors]
        height, beyond, rows = lab.page.evaluate(SIZES)
        found[key] += [f"{height} px long"] * (height > MOST) + [f"{beyond} px too wide"] * (beyond > 1)
        found[key] += [f"{rows} rows of pages"] * (rows > ROWS) + lab.page.evaluate(CUT)
    assert {key: bad for key, bad in found.items() if bad} == {}


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
