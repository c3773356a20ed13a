"""The way in, by hand: the arm's name and the dialog behind it, a new arm, the first visit, the word before the arm."""

import threading

import numpy as np
import pytest

from armlab.content.lessons import lessons
from armlab.content.robots import catalogue
from armlab.session.parts.welcome import STOPS
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

ARM_NAME = ".al-top .arm-name b"


def arm_name(lab):
    return lab.page.locator(ARM_NAME).inner_text()


def focus(lab):
    return lab.page.evaluate(FOCUS)


def is_open(lab):
    return lab.page.locator(".al-dialog").count() > 0


# -- choosing --------------------------------------------------------------------------------------------------------


def test_the_name_opens_the_arms_where_one_types_and_chooses_with_enter(visit):
    lab = visit("robot/ur10")
    assert arm_name(lab) == "UR10"
    lab.press("arms")
    assert focus(lab) == "arms-find"
    lab.page.keyboard.type("scara")
    lab.until(lambda: lab.page.locator(".al-dialog .arm").count() == 1)
    assert focus(lab) == "arms-find"
    lab.page.keyboard.press("Enter")
    lab.until(lambda: not is_open(lab))
    lab.until(lambda: arm_name(lab) == catalogue()["scara"].name)
    lab.until(lambda: focus(lab) == "arms")
    lab.page.keyboard.press("Control+z")
    lab.until(lambda: arm_name(lab) == "UR10")


def test_escape_and_a_press_beside_it_close_it_and_the_focus_returns(visit):
    lab = visit()
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


def test_tab_stays_inside_and_arrows_go_from_arm_to_arm(visit):
    lab = visit()
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


@pytest.mark.parametrize("size", [PAGE, SMALL, PHONE])
def test_the_dialog_fits_into_the_window_and_shows_a_picture_of_each_arm(visit, size):
    lab = visit(size=size)
    lab.press("arms")
    pictured = """() => [...document.querySelectorAll('.al-dialog .arm:not([data-cell=arms-new]) .pic')]
      .every(e => getComputedStyle(e).backgroundImage.includes('data:image/png'))"""
    lab.until(lambda: lab.page.evaluate(pictured))
    box = lab.page.locator(".al-dialog").bounding_box()
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= size[0]
    assert box["y"] >= 0
    assert box["y"] + box["height"] <= size[1]
    assert lab.page.evaluate(
        "() => { const s = document.querySelector('.al-dialog .scroll'); return s.scrollWidth <= s.clientWidth; }"
    )
    lab.press("arms-new")
    assert lab.page.evaluate(
        "() => { const s = document.querySelector('.al-dialog .scroll'); return s.scrollWidth <= s.clientWidth; }"
    )


# -- a new arm -------------------------------------------------------------------------------------------------------


def test_an_arm_of_four_joints_takes_eight_clicks_at_most(visit):
    """A turning base, shoulder and elbow, and a slide, from a fresh start; what is typed is no click."""
    lab = visit()
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


def test_what_was_typed_stays_while_the_form_changes_around_it(visit):
    lab = visit()
    lab.press("arms")
    lab.press("arms-new")
    lab.page.locator('[data-cell="new-0-a"]').fill("x")
    lab.page.locator('[data-cell="new-0-alpha"]').focus()
    lab.page.keyboard.press("Control+a")
    lab.page.keyboard.type("4")
    lab.until(lambda: "joint 1: link length" in lab.page.locator(".al-dialog").inner_text())
    lab.page.keyboard.type("5")
    assert lab.page.locator('[data-cell="new-0-alpha"]').input_value() == "45"
    assert focus(lab) == "new-0-alpha"


def test_a_spreadsheet_pasted_into_any_cell_fills_the_rows(visit):
    lab = visit()
    lab.press("arms")
    lab.press("arms-new")
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


@pytest.mark.parametrize("size", [PAGE, SMALL, PHONE])
def test_the_first_visit_begins_with_a_card_that_leaves_the_handle_free(visit, size):
    lab = visit(size=size)
    assert "Start here" in lab.page.locator(".al-card").inner_text()
    for tip in ((0.0, 0.0, 0.0), (0.12, 0.0, 0.0), (0.0, 0.12, 0.0), (0.0, 0.0, 0.12)):
        assert not lab.page.evaluate(COVERED, lab.on_screen("/target", tip).tolist())
    box = lab.page.locator(".al-card").bounding_box()
    assert box["y"] + box["height"] <= size[1]
    assert box["x"] + box["width"] <= size[0]


def test_the_card_is_not_shown_again_once_it_was_left(visit):
    lab = visit()
    lab.press("welcome-leave")
    assert lab.page.locator(".al-card").count() == 0
    lab.page.reload()
    lab.ready()
    assert lab.page.locator(".al-card").count() == 0
    lab.open_tab("Help")
    lab.press("help-start")
    assert lab.page.locator(".al-card").count() == 1


def test_the_card_is_gone_once_somebody_works_and_when_he_comes_back(visit):
    lab = visit()
    assert lab.page.locator(".al-card").count() == 1
    lab.drag_slider(1, 0.7)
    lab.until(lambda: lab.page.locator(".al-card").count() == 0)
    lab.page.reload()
    lab.ready()
    assert lab.page.locator(".al-card").count() == 0


def test_neither_a_lesson_in_the_address_nor_the_projector_shows_the_card(visit):
    lab = visit("lesson/first_arm")
    assert lab.page.locator(".al-card").count() == 0
    other = visit()
    other.page.evaluate("() => document.activeElement.blur()")
    other.page.keyboard.press("v")
    assert not other.page.locator(".al-card").is_visible()


def test_a_lesson_begins_with_one_press_on_the_card(visit):
    lab = visit()
    lab.press("start-first_arm")
    lab.until(lambda: "/lesson/first_arm" in lab.address())
    assert lab.page.locator(".al-card").count() == 0


@pytest.mark.parametrize("size", [PAGE, SMALL])
def test_each_stop_of_the_tour_points_at_the_real_thing_without_covering_it(visit, size):
    lab = visit(size=size)
    lab.press("start-tour")
    for stop in range(STOPS):
        at = lab.page.locator(".al-tour").get_attribute("data-at")
        lab.until(lambda: lab.page.locator(".al-ring").count() == 1)
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
        if stop < STOPS - 1:
            lab.press("tour-on")
    lab.press("tour-on")
    assert lab.page.locator(".al-tour, .al-ring, .al-card").count() == 0


def box_middle(lab, selector):
    box = lab.page.locator(selector).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


@pytest.mark.parametrize("stop", range(STOPS))
def test_the_tour_can_be_left_at_every_stop_and_found_again_in_help(visit, stop):
    lab = visit()
    lab.press("start-tour")
    for _ in range(stop):
        lab.press("tour-on")
    if stop % 2:
        lab.page.keyboard.press("Escape")
    else:
        lab.press("welcome-leave")
    lab.until(lambda: lab.page.locator(".al-tour, .al-ring").count() == 0)
    lab.page.reload()
    lab.ready()
    assert lab.page.locator(".al-tour, .al-card").count() == 0
    lab.open_tab("Help")
    lab.press("help-tour")
    assert lab.page.locator(".al-tour").get_attribute("data-at") == "handle"


def test_the_ring_follows_the_handle(visit):
    lab = visit()
    lab.press("start-tour")
    lab.drag_slider(1, 0.8)
    lab.until(lambda: np.hypot(*(np.array(box_middle(lab, ".al-ring")) - lab.on_screen("/target"))) < 3.0)


# -- until the arm is there ------------------------------------------------------------------------------------------


def test_a_word_stands_in_the_arms_place_until_it_is_there(visit, browser, url, monkeypatch):
    held, make = threading.Event(), Gallery.make

    def slowly(gallery, arm):
        if arm is catalogue()["gen3"].arm:
            held.wait(WAIT)
        return make(gallery, arm)

    monkeypatch.setattr(Gallery, "make", slowly)
    context = browser.new_context()
    try:
        page = context.new_page()
        page.goto(f"{url}robot/gen3")
        word = page.locator(".al-coming[role=status]")
        page.wait_for_function("() => document.querySelector('.al-coming')?.textContent.includes('on its way')")
        page.wait_for_function(
            "() => document.querySelector('.al-coming').textContent === 'Kinova Gen3 is on its way …'"
        )
        assert "Drag the handle" not in page.locator("body").inner_text()
        held.set()
        page.wait_for_function("() => document.querySelector('.al-coming').textContent === ''")
        assert not word.is_visible()
        assert page.evaluate("() => Object.keys(window.__viserMutable.nodeRefFromName).some(n => n.endsWith('/body'))")
    finally:
        held.set()
        context.close()


def test_no_arm_is_announced_where_a_question_hides_it(visit):
    lab = visit("lesson/angular_velocity", own=True)
    steps = lessons()["angular_velocity"].steps
    hides = next(i for i, step in enumerate(steps) if step.question is not None and "arm" in step.question.hide)
    lab.press(f"lesson-step-{hides}")
    lab.page.add_init_script(SAID)
    lab.page.reload()
    lab.page.wait_for_function("() => document.querySelector('.ask .dim')")
    lab.page.wait_for_function("() => document.querySelector('.al-coming').textContent === ''")
    assert lab.page.evaluate("() => window.said") == ["The lab is starting …", ""]


def test_after_a_lesson_one_press_leads_back_to_the_former_arm(visit):
    lab = visit("robot/scara")
    lab.drag_slider(1, 0.7)
    value = lab.slider_value(1)
    lab.open_tab("Help")
    lab.press("help-start")
    lab.press("start-first_arm")
    lab.ready()
    lab.press("lesson-close")
    lab.until(lambda: lab.page.locator("button[data-cell=former]").count() == 1)
    lab.press("former")
    lab.ready()
    assert arm_name(lab) == catalogue()["scara"].name
    lab.open_tab("Joints")
    assert lab.slider_value(1) == pytest.approx(value, abs=0.11)
    assert lab.page.locator("button[data-cell=former]").count() == 0
