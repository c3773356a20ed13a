"""The lab by keyboard alone: the focus is seen, dialogs keep it and give it back, tabs and sliders take arrows."""

import pytest

from support.axe import findings
from support.page import SMALL

pytestmark = pytest.mark.browser

RINGLESS = """() => {
  const found = document.activeElement, style = getComputedStyle(found);
  const seen = found === document.body || (style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 2);
  return [found.outerHTML.slice(0, 200), seen];
}"""
"""What has the focus, and whether that is seen."""

CELL = (
    "() => document.activeElement.dataset.cell ?? document.activeElement.dataset.name ?? document.activeElement.tagName"
)

INSIDE = "place => document.querySelector(place).contains(document.activeElement)"


def focused(lab):
    """Return the cell of what has the focus, the name of a tab, or the kind of element."""
    return lab.page.evaluate(CELL)


def press(lab, *keys):
    """Press keys one after the other, each after the answer to the one before."""
    for key in keys:
        lab.page.keyboard.press(key)
        lab.rest()


def test_a_first_visit_by_keyboard(visit):
    lab = visit(size=(1400, 850))
    the_focus_is_seen_wherever_the_tab_key_leads(lab)
    the_tour_is_gone_through_and_gives_the_focus_back(lab)
    arrows_move_a_slider_and_not_the_camera_and_go_along_tabs_and_pages(lab)
    lab.open_tab("Robot")
    a_dialog_keeps_the_focus_and_gives_it_back(lab, "button[data-cell=arms]", "Enter", ".al-dialog")


def test_search_and_projector_by_keyboard(visit):
    lab = visit(size=(1400, 850))
    lab.open_tab("Robot")
    a_dialog_keeps_the_focus_and_gives_it_back(lab, ".pages:visible .page[data-cell=robot]", "Control+k", "dialog")
    lab.resize(SMALL)
    the_projector_is_switched_on_and_off_by_its_key(lab)
    letters_count_where_a_keyboard_has_them(lab)


@pytest.mark.parametrize("key", ["Space", "Enter"])
def test_a_file_is_chosen_with(visit, key):
    lab = visit()
    lab.open_tab("Lessons")
    opened = []

    def note(chooser):
        opened.append(chooser)

    def opens():
        # The browser opens none while it is still busy with the last one, so the key may have to be pressed again.
        lab.page.locator("input[type=file][data-cell=lesson-load]:visible").first.focus()
        lab.page.keyboard.press(key)
        lab.frames(30)
        return bool(opened)

    lab.page.on("filechooser", note)
    lab.until(opens)
    lab.page.remove_listener("filechooser", note)


def test_keys_of_the_page_rest_behind_a_dialog_also_after_a_press_of_the_mouse_in_it(visit):
    lab = visit(size=(1400, 850))
    before = lab.slider_values(6)
    lab.press("arms")
    lab.press("arms-new")
    lab.press("new-angle rad")
    press(lab, "r", "h", "v")
    nothing_has_happened(lab, before)
    assert lab.page.locator(".al-dialog").is_visible()
    press(lab, "Escape")
    assert lab.page.locator(".al-dialog").count() == 0


def test_keys_of_the_page_rest_behind_a_question_until_it_is_answered(visit):
    lab = visit("lesson/ik_2r", size=(1400, 850))
    before, step = lab.slider_values(2), lab.page.locator(".lesson-text h2").inner_text()
    lab.press("lesson-anew")
    question = lab.page.locator("[role=dialog]:has([data-escape])")
    question.wait_for()
    press(lab, "r", "h", "v", "PageDown", "Tab", "Tab", "Tab")
    assert lab.page.evaluate(INSIDE, "[role=dialog]")
    question.click(position={"x": 20, "y": 20})
    press(lab, "r", "Space")
    nothing_has_happened(lab, before)
    assert lab.page.locator(".lesson-text h2").inner_text() == step
    press(lab, "Escape")
    lab.until(lambda: question.count() == 0)
    press(lab, "r")
    lab.until(lambda: lab.slider_values(2) != pytest.approx(before))


def nothing_has_happened(lab, values):
    assert lab.slider_values(len(values)) == pytest.approx(values)
    assert lab.page.locator('[data-dock-tab][data-name="Help"][aria-selected=true]').count() == 0
    assert not lab.page.evaluate("() => document.documentElement.hasAttribute('data-projector')")


def letters_count_where_a_keyboard_has_them(lab):
    """On German keys Z and Y have changed places, and the slash is Shift and 7."""
    lab.open_tab("Joints")
    lab.type_into("value 1", "20")
    lab.rest()
    undo = "() => document.querySelector('.al-steps button[data-cell=undo]').disabled"
    lab.until(lambda: not lab.page.evaluate(undo))
    field = 'input[data-cell="value 1"]'
    lab.page.focus(field)
    lab.page.dispatch_event(field, "keydown", {"key": "y", "code": "KeyZ", "ctrlKey": True, "bubbles": True})
    lab.rest()
    assert not lab.page.evaluate(undo)
    lab.page.dispatch_event(field, "keydown", {"key": "z", "code": "KeyY", "ctrlKey": True, "bubbles": True})
    lab.until(lambda: lab.page.evaluate(undo))


def the_focus_is_seen_wherever_the_tab_key_leads(lab):
    lab.open_tab("Joints")
    lab.page.evaluate("() => document.activeElement.blur()")
    stops = []
    for _ in range(60):
        lab.page.keyboard.press("Tab")
        stops.append(lab.page.evaluate(RINGLESS))
    assert [name for name, seen in stops if not seen] == []
    assert len({name for name, _ in stops}) > 35


def the_tour_is_gone_through_and_gives_the_focus_back(lab):
    lab.page.locator(".al-card button[data-cell=start-tour]").focus()
    press(lab, "Enter")
    assert findings(lab) == []
    for _ in range(3):
        lab.until(lambda: focused(lab) == "tour-on")
        press(lab, "Enter")
    press(lab, "Escape")
    lab.until(lambda: focused(lab) == "arms")
    assert lab.page.locator(".al-tour").count() == 0


def arrows_move_a_slider_and_not_the_camera_and_go_along_tabs_and_pages(lab):
    camera, before = lab.camera(), lab.slider_value(1)
    lab.page.locator(f"{lab.slider_track(1)} [role=slider]").focus()
    press(lab, "ArrowRight", "ArrowUp")
    assert lab.slider_value(1) == pytest.approx(before + 0.2)
    assert lab.camera() == camera

    lab.tab("Frames").focus()
    press(lab, "ArrowDown")
    assert focused(lab) == "Target"
    page = lab.page.locator(".pages .page[data-cell=target]")
    page.focus()
    press(lab, "ArrowRight")
    assert focused(lab) == "solutions"
    assert lab.page.locator(".pages .page[data-cell=solutions]").get_attribute("aria-selected") == "true"
    press(lab, "Home")
    assert focused(lab) == "target"


def a_dialog_keeps_the_focus_and_gives_it_back(lab, opener, keys, dialog):
    lab.page.locator(opener).focus()
    before = focused(lab)
    press(lab, keys)
    assert lab.page.evaluate(INSIDE, dialog)
    assert findings(lab) == []
    for _ in range(50):
        lab.page.keyboard.press("Shift+Tab")
        assert focused(lab) == "BODY" or lab.page.evaluate(
            INSIDE, dialog
        )  # the body is on the way to the browser's own bar
    press(lab, "Escape")
    assert not lab.page.locator(dialog).is_visible()
    assert focused(lab) == before


def the_projector_is_switched_on_and_off_by_its_key(lab):
    on = "() => document.documentElement.hasAttribute('data-projector')"
    press(lab, "v")
    assert lab.page.evaluate(on)
    lab.page.locator(".al-back").focus()
    assert findings(lab) == []
    press(lab, "Enter")
    assert not lab.page.evaluate(on)


@pytest.mark.parametrize("answer", ["an entry", "a refusal"])
def test_tab_goes_on_from_the_field_that_enter_has_left(visit, answer):
    lab = visit(size=(1400, 850))
    typed = {"an entry": "0.3", "a refusal": "foo"}[answer]
    for page, cell, after, before in (
        ("Timing laws", "t-distance", "t-speed", "t-duration"),
        ("Target", "y", "z", "x"),
        ("Gears", "teeth 1", "layout row", "teeth 0"),
    ):
        lab.open_tab(page)
        for key, goal in (("Tab", after), ("Shift+Tab", before)):
            lab.page.locator(f'input[data-cell="{cell}"]:visible').fill(typed)
            press(lab, "Enter")
            assert focused(lab) == "BODY", "the keys of the page count"
            press(lab, key)
            assert focused(lab) == goal


def test_tab_goes_on_from_the_button_that_the_mouse_has_pressed(visit):
    lab = visit(size=(1400, 850))
    lab.open_tab("Gears")
    lab.page.locator('button[data-cell="layout row"]:visible').focus()
    press(lab, "Tab")
    after = focused(lab)
    lab.press("layout row")
    press(lab, "Tab")
    assert focused(lab) == after
