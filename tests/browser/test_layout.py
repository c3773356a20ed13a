"""What is folded is there when it is wanted; how long pages are is looked at in `test_every_page`."""

import pytest

pytestmark = pytest.mark.browser

WIDE = (1400, 850)

TELEPHONES = (667, 375), (375, 667)
"""A telephone held sideways and upright."""

OUT_OF_SCENE = """() => {
  const scene = document.querySelector('canvas[data-engine]').getBoundingClientRect();
  const row = [...document.querySelectorAll('.al-top > *')].map(each => each.getBoundingClientRect());
  return row.length === 2 ? row.filter(each => each.left < scene.left || each.right > scene.right) : ['no row'];
}"""
"""What of the row over the scene, name of the arm and search, is not within it."""


def test_what_is_folded_is_opened_by_hand_and_by_the_search_and_stays_open_when_it_changes(visit):
    lab = visit(size=WIDE)
    lab.open_tab("laws")
    best = lab.page.locator('button[data-cell="optimal"]')
    plots = lab.page.locator(".uplot")
    assert not best.is_visible()
    assert [plots.nth(i).is_visible() for i in range(4)] == [True, True, False, False]
    values = lab.page.locator(".law-table").first
    assert not values.is_visible()
    lab.unfold("Values, peaks and classes")
    assert values.is_visible()
    lab.type_into("t-duration", "4")
    lab.until(lambda: "4" in values.inner_text())
    assert values.is_visible()
    # A fold holds plots and sliders as well.
    lab.press("optimal")
    lab.unfold("Acceleration and jerk")
    assert best.is_visible()
    assert min(plots.nth(3).bounding_box()[side] for side in ("width", "height")) > 60
    # The search opens the fold in which a file is saved.
    lab.page.keyboard.press("Control+k")
    lab.page.keyboard.type("save toml")
    lab.page.locator("#al-search [role=option]", has_text="TOML").first.click()
    lab.until(lambda: lab.page.locator('button[data-cell="save"]').is_visible())


def test_the_row_over_the_scene_covers_nothing_beside_it_on_a_telephone(visit):
    lab = visit("lesson/ik_2r", size=TELEPHONES[0])
    for size in TELEPHONES:
        lab.page.set_viewport_size(dict(zip(("width", "height"), size, strict=True)))
        lab.finds_none(OUT_OF_SCENE)
