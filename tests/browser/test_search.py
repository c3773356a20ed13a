"""The search in a real browser: its keys, the focus, what a pick does, and how it stands on screens of all sizes."""

import numpy as np
import pytest

from armlab.session.pages import pages
from armlab.window.search.offers import title_of

pytestmark = pytest.mark.browser

SIZES = [(1400, 850), (1024, 700), (390, 844)]

DIALOG = "#al-search"

INSIDE = """() => {
  const dialog = document.getElementById('al-search').getBoundingClientRect();
  const bad = [];
  if (dialog.left < 0 || dialog.right > innerWidth || dialog.top < 0 || dialog.bottom > innerHeight) bad.push('dialog');
  for (const e of document.querySelectorAll('#al-search *')) {
    const r = e.getBoundingClientRect();
    if (e.closest('svg') || !r.width) continue;
    if (r.left < dialog.left - 1 || r.right > dialog.right + 1) bad.push(e.className);
  }
  return bad;
}"""

SEEN = "tab => document.querySelector(`[data-tab=${tab}]`)?.parentElement.getClientRects().length > 0"


def is_open(lab):
    return lab.page.evaluate("() => document.getElementById('al-search').open")


def open_search(lab, text=""):
    lab.page.keyboard.press("Control+k")
    lab.page.keyboard.type(text)
    lab.rest()
    assert is_open(lab)


def options(lab):
    return lab.page.eval_on_selector_all(f"{DIALOG} [role=option]", "all => all.map(one => one.dataset.cell ?? '')")


def active(lab):
    """Return the cell of the option that the field points to, the only one that is selected."""
    found = lab.page.evaluate(
        """() => {
          const named = document.querySelector('#al-search input').getAttribute('aria-activedescendant');
          const chosen = [...document.querySelectorAll('#al-search [aria-selected=true]')];
          return chosen.length === 1 && chosen[0].id === named ? chosen[0].dataset.cell ?? '' : null;
        }"""
    )
    assert found is not None
    return found


def sees(lab, tab):
    """Return whether a tab is seen, which its mark tells."""
    return lab.page.evaluate(SEEN, tab)


def focused(lab):
    return lab.page.evaluate("() => document.activeElement.dataset.cell ?? document.activeElement.tagName")


def close_search(lab):
    lab.page.keyboard.press("Escape")
    lab.rest()
    assert not is_open(lab)


def test_its_keys_and_those_of_the_page_around_it(visit):
    lab = visit()
    the_palette_of_viser_stays_away_and_the_keys_of_commands_go_on_working(lab)
    a_slash_opens_it_where_nothing_is_typed_and_is_a_sign_in_a_field(lab)
    close_search(lab)
    escape_gives_the_focus_back(lab)
    close_search(lab)
    lab.page.mouse.click(300, 300)
    escape_leaves_the_projector_as_it_is(lab)


def the_palette_of_viser_stays_away_and_the_keys_of_commands_go_on_working(lab):
    for keys in ("Control+k", "Control+Shift+P"):
        lab.page.keyboard.press(keys)
        lab.rest()
        assert is_open(lab)
        assert lab.page.locator(".mantine-Spotlight-search").count() == 0
        lab.page.keyboard.press(keys)
        assert not is_open(lab)
    lab.page.keyboard.press("0")
    lab.rest()
    np.testing.assert_allclose(lab.slider_values(6), 0.0, atol=0.01)
    open_search(lab)
    lab.page.keyboard.press("Control+z")  # undoes nothing but what is typed
    lab.rest()
    np.testing.assert_allclose(lab.slider_values(6), 0.0, atol=0.01)
    close_search(lab)
    lab.page.keyboard.press("h")
    lab.rest()
    assert sees(lab, "help")


def a_slash_opens_it_where_nothing_is_typed_and_is_a_sign_in_a_field(lab):
    lab.open_tab("Target")
    field = lab.page.locator('input[data-cell="x"]')
    field.click()
    lab.page.keyboard.type("1/2")
    assert "1/2" in field.input_value()
    assert not is_open(lab)
    field.press("Escape")
    lab.page.mouse.click(300, 300)
    lab.page.keyboard.press("/")
    lab.rest()
    assert is_open(lab)
    assert focused(lab) == "search"
    assert lab.page.locator(f"{DIALOG} input").input_value() == ""


def escape_gives_the_focus_back(lab):
    lab.open_tab("Target")
    lab.page.locator('input[data-cell="y"]').focus()
    open_search(lab, "ellipsoid")
    assert focused(lab) == "search"
    lab.page.keyboard.press("Escape")
    lab.rest()
    assert not is_open(lab)
    assert focused(lab) == "y"
    assert lab.page.locator(f"{DIALOG} [role=option]").count() == 0
    open_search(lab)
    assert lab.page.locator(f"{DIALOG} input").input_value() == ""


def escape_leaves_the_projector_as_it_is(lab):
    lab.page.keyboard.press("v")
    open_search(lab)
    lab.page.keyboard.press("Escape")
    lab.rest()
    assert not is_open(lab)
    assert lab.page.evaluate("() => document.documentElement.hasAttribute('data-projector')")
    lab.page.keyboard.press("Escape")
    assert not lab.page.evaluate("() => document.documentElement.hasAttribute('data-projector')")


def test_over_a_dialog_its_keys_are_its_own(visit):
    lab = visit()
    dialog = lab.page.locator(".al-dialog")
    lab.press("arms")
    open_search(lab, "ur5")
    close_search(lab)
    assert dialog.is_visible()
    lab.page.keyboard.press("Escape")
    lab.rest()
    assert dialog.count() == 0


def test_what_is_found_is_done_opened_and_said(visit):
    lab = visit()
    what_is_typed_and_confirmed_at_once_is_what_is_done(lab)
    a_file_brings_one_to_its_control(lab)
    arrow_keys_go_through_the_list_and_leave_the_camera_alone(lab)
    a_topic_is_asked_for_in_turn(lab)
    close_search(lab)
    the_dialog_says_what_it_is_to_who_cannot_see_it(lab)
    close_search(lab)
    the_magnifier_opens_it_and_a_click_beside_it_closes_it(lab)


def what_is_typed_and_confirmed_at_once_is_what_is_done(lab):
    """Enter waits for the list of the text in the field, however slow the way to the lab."""
    lab.page.keyboard.press("Control+k")
    lab.page.keyboard.type("zero pose")
    lab.page.keyboard.press("Enter")
    lab.until(lambda: not is_open(lab))
    lab.rest()
    np.testing.assert_allclose(lab.slider_values(6), 0.0, atol=0.01)


def a_file_brings_one_to_its_control(lab):
    open_search(lab, "csv")
    lab.page.keyboard.press("Enter")
    lab.until(lambda: focused(lab) == "csv")
    assert sees(lab, "motion")
    control = lab.page.locator("[data-brought]")
    assert control.inner_text() == "CSV"
    assert control.evaluate("e => { const r = e.getBoundingClientRect(); return r.top > 0 && r.bottom < innerHeight; }")
    # The same from another page with a control of that name.
    lab.open_tab(pages()["laws"].title)
    open_search(lab, "samples of the motion csv")
    lab.page.keyboard.press("Enter")
    lab.until(lambda: lab.page.locator('[data-cell="python"]').count() > 0 and focused(lab) == "csv")
    with lab.page.expect_download() as download:
        lab.page.keyboard.press("Enter")
    assert download.value.suggested_filename == "puma_560_motion.csv"


def arrow_keys_go_through_the_list_and_leave_the_camera_alone(lab):
    camera = lab.camera()
    open_search(lab, "ellipsoid")
    listed = options(lab)
    assert len(listed) > 3
    assert active(lab) == listed[0] == "hit bench:ellipsoid"
    lab.page.keyboard.press("ArrowDown")
    assert active(lab) == listed[1]
    lab.page.keyboard.press("ArrowUp")
    lab.page.keyboard.press("ArrowUp")
    assert active(lab) == listed[-1]
    lab.page.keyboard.press("ArrowDown")
    lab.page.keyboard.type(" force")
    lab.rest()
    assert active(lab) == options(lab)[0]
    np.testing.assert_allclose(lab.camera(), camera, atol=1e-9)
    lab.page.keyboard.press("Enter")
    lab.rest()
    assert sees(lab, "velocity")


def a_topic_is_asked_for_in_turn(lab):
    open_search(lab, "4.1")
    lab.page.keyboard.press("Enter")
    lab.rest()
    assert is_open(lab)
    assert lab.page.locator(f"{DIALOG} input").input_value() == "S4.1-common-normal"
    assert "hit lesson:dh_frames" in options(lab)
    assert "hit bench:normal" in options(lab)


def the_dialog_says_what_it_is_to_who_cannot_see_it(lab):
    open_search(lab, "velocity")
    dialog = lab.page.get_by_role("dialog", name="Search")
    assert dialog.count() == 1
    field = dialog.get_by_role("combobox", name="Search")
    assert field.get_attribute("aria-controls") == dialog.get_by_role("listbox").get_attribute("id")
    assert dialog.get_by_role("option", selected=True).count() == 1
    assert "of" in dialog.get_by_role("status").inner_text()
    assert dialog.get_by_role("option").first.inner_text().startswith(title_of(pages()["velocity"]))


def the_magnifier_opens_it_and_a_click_beside_it_closes_it(lab):
    lab.page.locator(".al-top .seek").click()
    lab.rest()
    assert is_open(lab)
    lab.page.locator(f"{DIALOG} [data-ask=UR5]").click()
    lab.rest()
    assert focused(lab) == "search"
    assert options(lab)[0] == "hit arm:ur5e"
    lab.page.locator(f'{DIALOG} [data-cell="hit arm:ur5e"]').click()
    lab.rest()
    assert not is_open(lab)
    assert lab.address().partition("?")[0].endswith("/robot/ur5e")
    open_search(lab)
    assert options(lab)[0] == "hit arm:ur5e"  # the recent find
    lab.page.mouse.click(5, 5)
    lab.rest()
    assert not is_open(lab)


def test_it_fits_screens_of_all_sizes_light_and_dark(visit):
    lab = visit(size=SIZES[0])
    for _look in ("light", "dark"):
        for size in SIZES:
            lab.page.set_viewport_size(dict(zip(("width", "height"), size, strict=True)))
            lab.rest()
            for text in ("", "velocity", "qqzzx"):
                open_search(lab, text)
                lab.finds_none(INSIDE)
                close_search(lab)
        lab.page.keyboard.press("l")


def test_a_tab_that_takes_no_press_yet_is_pressed_again(visit):
    """As a page that has just been opened may do it."""
    lab = visit()
    lab.page.evaluate(
        """() => {
          let rest = 3;
          document.addEventListener('keydown', event => {
            if (event.isTrusted || !event.target.closest('[data-dock-tab]') || !rest) return;
            rest--;
            event.stopImmediatePropagation();
          }, true);
        }"""
    )
    open_search(lab, "glossary")
    lab.page.keyboard.press("Enter")
    lab.page.wait_for_function(f"() => ({SEEN})('help')")
