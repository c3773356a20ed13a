"""The way in, by hand: the arm's name and the dialog behind it, a new arm, the first visit, the word before the arm."""

import threading

import numpy as np
import pytest

from armlab.content.lessons import lessons
from armlab.content.robots import catalogue
from armlab.teaching.parts.welcome import STOPS
from armlab.ui.figure.drawn import Gallery
from support.hand import Hand
from support.patience import WAIT

pytestmark = pytest.mark.browser

PAGE, SMALL, PHONE = (1400, 850), (1024, 700), (390, 844)

FOCUS = "() => document.activeElement?.dataset?.cell ?? document.activeElement?.tagName"

COVERED = """at => {
  const inside = (box, x, y) => x > box.left && x < box.right && y > box.top && y < box.bottom;
  const cards = [...document.querySelectorAll('.al-card, .al-tour')].map(e => e.getBoundingClientRect());
  return cards.some(box => inside(box, ...at));
}"""
"""Whether the card or the tour lies over a point."""

SAID = """(() => {
  window.said = [];
  new MutationObserver(() => {
    const text = document.querySelector('.al-coming')?.textContent;
    if (text !== undefined && text !== window.said.at(-1)) window.said.push(text);
  }).observe(document, { childList: true, subtree: true, characterData: true });
})()"""
"""Notes all that the page says in the arm's place."""

WIDER = "() => { const s = document.querySelector('.al-dialog .scroll'); return s.scrollWidth > s.clientWidth; }"
"""Whether what the dialog holds is wider than it."""

ARM_NAME = ".al-top .arm-name b"


def arm_name(lab):
    return lab.page.locator(ARM_NAME).inner_text()


def focus(lab):
    return lab.page.evaluate(FOCUS)


def is_open(lab):
    return lab.page.locator(".al-dialog").count() > 0


def count(lab, selector):
    return lab.page.locator(selector).count()


def box_middle(lab, selector):
    box = lab.page.locator(selector).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


# -- choosing --------------------------------------------------------------------------------------------------------


def the_dialog_by_keyboard(lab):
    it_closes_and_the_focus_returns(lab)
    tab_stays_inside_and_arrows_go_from_arm_to_arm(lab)
    lab.page.keyboard.press("Escape")
    lab.until(lambda: not is_open(lab))
    one_types_and_chooses_with_enter(lab)


def it_closes_and_the_focus_returns(lab):
    for shut in (
        lambda: lab.page.keyboard.press("Escape"),
        lambda: lab.page.mouse.click(5, 300),
        lambda: lab.press("arms-close"),
    ):
        lab.page.locator("button[data-cell=arms]").focus()
        lab.page.keyboard.press("Enter")
        lab.until(lambda: is_open(lab))
        shut()
        lab.until(lambda: not is_open(lab))
        lab.until(lambda: focus(lab) == "arms")
    assert arm_name(lab) == "PUMA 560"


def tab_stays_inside_and_arrows_go_from_arm_to_arm(lab):
    lab.press("arms")
    lab.page.keyboard.press("ArrowDown")
    assert focus(lab) == "arms-new"
    lab.page.keyboard.press("ArrowRight")
    first = focus(lab)
    assert first.startswith("arm-")
    lab.page.keyboard.press("ArrowDown")
    assert focus(lab) not in (first, "arms-new")
    lab.page.keyboard.press("ArrowUp")
    assert focus(lab) == first
    inside = "() => !!document.activeElement.closest('.al-dialog')"
    lab.page.locator("button[data-cell=arms-close]").focus()
    for key in ("Tab", "Shift+Tab", "Shift+Tab", "Shift+Tab", "Tab"):
        lab.page.keyboard.press(key)
        assert lab.page.evaluate(inside)
    # The key R would move the arm.
    before = lab.slider_values(6)
    lab.page.locator("button[data-cell=arm-scara]").focus()
    lab.page.keyboard.press("r")
    lab.rest()
    np.testing.assert_array_equal(lab.slider_values(6), before)


def one_types_and_chooses_with_enter(lab):
    lab.press("arms")
    assert focus(lab) == "arms-find"
    lab.page.keyboard.type("scara")
    lab.page.keyboard.press("Enter")  # at once: what is seen is still the list of all arms
    lab.until(lambda: not is_open(lab))
    lab.until(lambda: arm_name(lab) == catalogue()["scara"].name)
    lab.until(lambda: focus(lab) == "arms")
    lab.page.keyboard.press("Control+z")
    lab.until(lambda: arm_name(lab) == "PUMA 560")


# -- a new arm -------------------------------------------------------------------------------------------------------


def a_new_arm(lab):
    four_joints_take_eight_clicks_at_most(lab)
    begin_an_arm(lab)
    what_was_typed_stays_while_the_form_changes_around_it(lab)
    lab.press("arms-close")
    begin_an_arm(lab)
    a_spreadsheet_pasted_into_any_cell_fills_the_rows(lab)


def begin_an_arm(lab):
    lab.press("arms")
    lab.press("arms-new")


def four_joints_take_eight_clicks_at_most(lab):
    """A turning base, shoulder and elbow, and a slide, from a fresh start; what is typed is no click."""
    hand = Hand(lab)
    hand.on("arms")
    hand.on("arms-new")
    hand.on("new-add")
    hand.on("new-add")
    hand.on("new-3-kind P")
    cells = {"new-0-alpha": "90", "new-0-d": "400", "new-0-a": "0", "new-1-a": "500", "new-2-a": "300", "new-3-d": "50"}
    for cell, text in cells.items():
        lab.page.locator(f'[data-cell="{cell}"]').focus()  # as Tab does
        lab.page.keyboard.press("Control+a")
        lab.page.keyboard.type(text)
        lab.page.keyboard.press("Tab")
    lab.rest()
    hand.on("new-make")
    lab.until(lambda: arm_name(lab) == "My arm")
    lab.ready()
    assert hand.clicks <= 8
    assert sum("/arm/" in name and name.endswith("/body") for name in lab.nodes()) == 5
    lab.open_tab("table")
    values = lab.page.locator("table.dh.edit input.field").evaluate_all("all => all.map(e => e.value)")
    assert values[:4] == ["0", "90", "400", "+0"]
    assert values[12:] == ["0", "0", "+50", "0"]


def what_was_typed_stays_while_the_form_changes_around_it(lab):
    lab.page.locator('[data-cell="new-0-a"]').fill("x")
    lab.page.locator('[data-cell="new-0-alpha"]').focus()
    lab.page.keyboard.press("Control+a")
    lab.page.keyboard.type("4")
    lab.until(lambda: "joint 1: link length" in lab.page.locator(".al-dialog").inner_text())
    lab.page.keyboard.type("5")
    assert lab.page.locator('[data-cell="new-0-alpha"]').input_value() == "45"
    assert focus(lab) == "new-0-alpha"


def a_spreadsheet_pasted_into_any_cell_fills_the_rows(lab):
    lab.page.locator('[data-cell="new-0-a"]').focus()
    lab.page.evaluate(
        """text => {
          const data = new DataTransfer();
          data.setData('text', text);
          const pasted = { clipboardData: data, bubbles: true, cancelable: true };
          document.activeElement.dispatchEvent(new ClipboardEvent('paste', pasted));
        }""",
        "a [mm]\talpha [deg]\td [mm]\ttheta\n100\t90\t200\tq1\n300\t0\t0\tq2\n200\t0\t0\tq3\n",
    )
    lab.until(lambda: lab.page.locator('[data-cell="new-2-a"]').count() == 1)
    assert lab.page.locator('[data-cell="new-1-a"]').input_value() == "300"


# -- the first visit -------------------------------------------------------------------------------------------------


def test_a_first_visit_in_a_large_window(visit):
    lab = visit(size=PAGE)
    the_card_leaves_the_handle_free(lab, PAGE)
    the_tour_points_at_real_things(lab, PAGE)
    the_dialog_shows_a_picture_of_each_arm(lab, PAGE)
    lab.press("arms-close")
    the_dialog_by_keyboard(lab)


def test_a_first_visit_in_a_small_window(visit):
    lab = visit(size=SMALL)
    the_card_leaves_the_handle_free(lab, SMALL)
    the_tour_points_at_real_things(lab, SMALL)
    the_dialog_shows_a_picture_of_each_arm(lab, SMALL)
    lab.press("arms-close")
    a_new_arm(lab)


def test_a_first_visit_on_a_phone(visit):
    lab = visit(size=PHONE)
    the_card_leaves_the_handle_free(lab, PHONE)
    the_dialog_shows_a_picture_of_each_arm(lab, PHONE)


def the_card_leaves_the_handle_free(lab, size):
    assert "Start here" in lab.page.locator(".al-card").inner_text()
    for tip in ((0.0, 0.0, 0.0), (0.12, 0.0, 0.0), (0.0, 0.12, 0.0), (0.0, 0.0, 0.12)):
        assert not lab.page.evaluate(COVERED, lab.on_screen("/target", tip).tolist())
    box = lab.page.locator(".al-card").bounding_box()
    assert box["y"] + box["height"] <= size[1]
    assert box["x"] + box["width"] <= size[0]


def the_tour_points_at_real_things(lab, size):
    lab.press("start-tour")
    for stop in range(STOPS):
        the_stop_points_at_the_real_thing_without_covering_it(lab, size)
        if stop < STOPS - 1:
            lab.press("tour-on")
    lab.press("tour-on")
    assert count(lab, ".al-tour, .al-ring, .al-card") == 0


def the_stop_points_at_the_real_thing_without_covering_it(lab, size):
    at = lab.page.locator(".al-tour").get_attribute("data-at")
    lab.until(lambda: count(lab, ".al-ring") == 1)
    ring, card = (lab.page.locator(each).bounding_box() for each in (".al-ring", ".al-tour"))
    middle = [ring["x"] + ring["width"] / 2, ring["y"] + ring["height"] / 2]
    assert not lab.page.evaluate(COVERED, middle), at
    assert card["x"] >= 0, at
    assert card["x"] + card["width"] <= size[0], at
    assert card["y"] + card["height"] <= size[1], at
    real = {
        "handle": lambda: lab.on_screen("/target"),
        "sliders": lambda: box_middle(lab, ".mantine-Slider-root >> nth=2"),
        "arm": lambda: box_middle(lab, ".al-top .arm-name"),
        "lessons": lambda: box_middle(lab, '[data-dock-tab][data-name="Lessons"]'),
    }[at]()
    assert ring["x"] <= real[0] <= ring["x"] + ring["width"], at
    assert ring["y"] <= real[1] <= ring["y"] + ring["height"], at


def the_dialog_shows_a_picture_of_each_arm(lab, size):
    lab.press("arms")
    pictured = """() => [...document.querySelectorAll('.al-dialog .arm:not([data-cell=arms-new]) .pic')]
      .every(e => getComputedStyle(e).backgroundImage.includes('data:image/png'))"""
    lab.until(lambda: lab.page.evaluate(pictured))
    box = lab.page.locator(".al-dialog").bounding_box()
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= size[0]
    assert box["y"] >= 0
    assert box["y"] + box["height"] <= size[1]
    assert not lab.page.evaluate(WIDER)
    lab.press("arms-new")
    assert not lab.page.evaluate(WIDER)


def test_card_and_tour_are_left_and_found_again_in_help(visit):
    """What later pages show, after whichever stop the tour was left, is told in `tests/ui/test_welcome.py`."""
    lab = visit("robot/scara")
    on_other_pages_the_card_is_its_head_until_it_is_wanted(lab)
    one_projects_and_works_without_the_card(lab)
    finds_in_help(lab, "help-start", ".al-card")
    lab.press("welcome-leave")
    assert count(lab, ".al-card") == 0
    finds_in_help(lab, "help-start", ".al-card")
    lab.press("start-tour")
    the_ring_follows_the_handle(lab)
    for stop in range(STOPS):
        for _ in range(stop):
            lab.press("tour-on")
        if stop % 2:
            lab.page.keyboard.press("Escape")
        else:
            lab.press("welcome-leave")
        lab.until(lambda: count(lab, ".al-tour, .al-ring") == 0)
        if stop == STOPS - 1:
            lab.page.reload()
            lab.ready()
            assert count(lab, ".al-tour, .al-card") == 0
        finds_in_help(lab, "help-tour", ".al-tour[data-at=handle]")
    finds_in_help(lab, "help-start", ".al-card")
    a_lesson_begins_with_one_press_and_another_leads_back_to_the_former_arm(lab)


def on_other_pages_the_card_is_its_head_until_it_is_wanted(lab):
    lesson = lab.page.locator(".al-card .start").first
    assert lesson.is_visible()
    lab.open_tab("Rotation")
    assert not lesson.is_visible()
    lab.page.locator('[data-cell="welcome-leave"]').focus()
    assert lesson.is_visible()
    lab.open_tab("Joints")
    assert lesson.is_visible()


def one_projects_and_works_without_the_card(lab):
    assert count(lab, ".al-card") == 1
    lab.page.evaluate("() => document.activeElement.blur()")
    lab.page.keyboard.press("v")
    assert not lab.page.locator(".al-card").is_visible()
    lab.page.keyboard.press("v")
    assert lab.page.locator(".al-card").is_visible()
    lab.drag_slider(1, 0.7)
    lab.until(lambda: count(lab, ".al-card") == 0)


def finds_in_help(lab, cell, shown):
    lab.open_tab("Help")
    lab.press(cell)
    assert count(lab, shown) == 1


def the_ring_follows_the_handle(lab):
    lab.open_tab("Joints")
    lab.type_into("value 1", "40")
    lab.until(lambda: np.hypot(*(np.array(box_middle(lab, ".al-ring")) - lab.on_screen("/target"))) < 3.0)


def a_lesson_begins_with_one_press_and_another_leads_back_to_the_former_arm(lab):
    lab.press("start-first_arm")
    lab.until(lambda: "/lesson/first_arm" in lab.address())
    assert count(lab, ".al-card") == 0
    lab.ready()
    lab.press("lesson-close")
    lab.until(lambda: count(lab, "button[data-cell=former]") == 1)
    lab.press("former")
    lab.ready()
    assert arm_name(lab) == catalogue()["scara"].name
    lab.open_tab("Joints")
    assert lab.slider_value(1) == pytest.approx(40.0, abs=0.11)
    assert count(lab, "button[data-cell=former]") == 0


# -- until the arm is there ------------------------------------------------------------------------------------------


def test_a_word_stands_in_the_arms_place_until_it_is_there_unless_a_question_hides_it(visit, url, monkeypatch):
    lab = visit("lesson/angular_velocity")
    assert count(lab, ".al-card") == 0
    no_arm_is_announced_where_a_question_hides_it(lab)
    lab.page.context.clear_cookies()
    the_word_says_which_arm_is_on_its_way(lab.page, url, monkeypatch)


def no_arm_is_announced_where_a_question_hides_it(lab):
    steps = lessons()["angular_velocity"].steps
    hides = next(i for i, step in enumerate(steps) if step.question is not None and "arm" in step.question.hide)
    lab.press(f"lesson-step-{hides}")
    devtools = lab.page.context.new_cdp_session(lab.page)
    devtools.send("Page.enable")
    devtools.send("Page.addScriptToEvaluateOnNewDocument", {"source": SAID})
    lab.page.reload()
    devtools.detach()  # and the script is gone
    lab.page.wait_for_function("() => document.querySelector('.ask .dim')")
    lab.page.wait_for_function("() => document.querySelector('.al-coming').textContent === ''")
    assert lab.page.evaluate("() => window.said") == ["The lab is starting …", ""]


def the_word_says_which_arm_is_on_its_way(page, url, monkeypatch):
    held, make = threading.Event(), Gallery.make

    def slowly(gallery, arm):
        if arm is catalogue()["gen3"].arm:
            held.wait(WAIT)
        return make(gallery, arm)

    monkeypatch.setattr(Gallery, "make", slowly)
    try:
        page.goto(f"{url}robot/gen3")
        page.wait_for_function("() => document.querySelector('.al-coming')?.textContent.includes('on its way')")
        page.wait_for_function(
            "() => document.querySelector('.al-coming').textContent === 'Kinova Gen3 is on its way …'"
        )
        assert "Drag the handle" not in page.locator("body").inner_text()
        held.set()
        page.wait_for_function("() => document.querySelector('.al-coming').textContent === ''")
        assert not page.locator(".al-coming[role=status]").is_visible()
        assert page.evaluate("() => Object.keys(window.__viserMutable.nodeRefFromName).some(n => n.endsWith('/body'))")
    finally:
        held.set()
