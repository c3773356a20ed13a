"""Hands in a real browser: keys through the solutions, buttons that are held, a gamepad, typed values."""

import numpy as np
import pytest

from armlab.content.robots import catalogue

pytestmark = pytest.mark.browser

UR10 = catalogue()["ur10_notes"]

FOCUSED = "() => document.activeElement?.dataset?.cell ?? ''"
NOW = "() => document.querySelector('.sol-row[aria-selected=true] .sol')?.dataset.cell ?? ''"

PAD = """() => {
  const buttons = Array.from({ length: 17 }, () => ({ pressed: false }));
  window.__pad = { connected: true, axes: [0, 0, 0, 0], buttons };
  navigator.getGamepads = () => [window.__pad];
  dispatchEvent(new Event('gamepadconnected'));
}"""


def test_the_list_of_solutions(visit):
    lab = visit("robot/ur10_notes")
    lab.press("eight")
    lab.open_tab("Target")
    lab.press("solutions")
    lab.until(lambda: lab.page.locator(".sol-row").count() == 8)
    lab.rest()
    arrow_keys_go_through_the_solutions_and_the_focus_stays_in_the_list(lab)
    quick_presses_end_at_the_last_one_and_a_click_keeps_the_focus_in_the_list(lab)


def arrow_keys_go_through_the_solutions_and_the_focus_stays_in_the_list(lab):
    cells = lab.page.eval_on_selector_all(".sol", "all => all.map(each => each.dataset.cell)")
    assert lab.page.locator('.sol[tabindex="0"]').count() == 1
    camera = lab.camera()
    lab.page.locator(".sol").first.focus()
    for k in (1, 2, 3):
        lab.page.keyboard.press("ArrowDown")
        lab.until(lambda k=k: lab.page.evaluate(NOW) == cells[k])
        assert lab.page.evaluate(FOCUSED) == cells[k]
    lab.page.keyboard.press("ArrowUp")
    lab.until(lambda: lab.page.evaluate(NOW) == cells[2])
    assert lab.page.evaluate(FOCUSED) == cells[2]
    lab.page.keyboard.press("End")
    lab.until(lambda: lab.page.evaluate(NOW) == cells[7])
    lab.page.keyboard.press("ArrowDown")
    lab.rest()
    assert lab.page.evaluate(FOCUSED) == cells[7]
    np.testing.assert_allclose(lab.camera()[:3], camera[:3], atol=1e-6)
    np.testing.assert_allclose(lab.target(), UR10.arm.position(UR10.poses["eight"]), atol=3e-3)


def quick_presses_end_at_the_last_one_and_a_click_keeps_the_focus_in_the_list(lab):
    cells = lab.page.eval_on_selector_all(".sol", "all => all.map(each => each.dataset.cell)")
    lab.page.locator(".sol").first.click()
    for _ in range(5):
        lab.page.keyboard.press("ArrowDown")
    lab.until(lambda: lab.page.evaluate(NOW) == cells[5])
    assert lab.page.evaluate(FOCUSED) == cells[5]


def jog(lab, mode):
    lab.press(f"jog-{mode}")
    lab.until(lambda: lab.page.locator("[data-jogs]").is_visible())


def test_joints_are_typed_and_jogged_and_space_plays(visit):
    lab = visit(size=(1024, 700))
    a_typed_joint_value_is_cut_at_its_limit_and_says_so_beside_the_slider(lab)
    lab.press("home")
    jog(lab, "joints")
    a_click_is_one_step_and_a_held_button_goes_on_until_it_is_let_go(lab)
    a_jog_ends_when_the_pointer_leaves_the_button_and_at_the_limit(lab)
    lab.press("home")
    space_plays_what_the_open_page_shows(lab)


def a_typed_joint_value_is_cut_at_its_limit_and_says_so_beside_the_slider(lab):
    lab.type_into("value 2", "300")
    said = lab.page.get_by_text("300.0° exceeds the limit of joint 2: set to 225.0°")
    lab.until(lambda: said.is_visible())
    assert lab.slider_value(2) == 225.0
    # The field is on the line of its slider, and nothing else can be typed into there.
    field = lab.page.locator('input[data-cell="value 2"]').bounding_box()
    track = lab.page.locator(lab.slider_track(2)).first.bounding_box()
    middle = track["y"] + track["height"] / 2
    assert field["y"] < middle < field["y"] + field["height"]
    assert field["x"] >= track["x"] + track["width"]
    assert lab.page.locator(".mantine-NumberInput-input:visible").count() == 0


def a_click_is_one_step_and_a_held_button_goes_on_until_it_is_let_go(lab):
    home = lab.slider_value(1)
    lab.press("jog 0 plus")
    lab.until(lambda: lab.slider_value(1) == pytest.approx(home + 1.0))
    lab.still(0.7)
    assert lab.slider_value(1) == pytest.approx(home + 1.0)
    lab.page.locator('button[data-cell="jog 0 plus"]').hover()
    lab.page.mouse.down()
    lab.until(lambda: lab.slider_value(1) > home + 6.0)
    lab.page.mouse.up()
    lab.rest()
    value = lab.slider_value(1)
    lab.still(0.5)
    assert lab.slider_value(1) == value
    assert value - home == pytest.approx(round(value - home), abs=1e-6)
    lab.press("undo")
    lab.until(lambda: lab.slider_value(1) == pytest.approx(home + 1.0))
    lab.press("undo")
    lab.until(lambda: lab.slider_value(1) == pytest.approx(home))


def a_jog_ends_when_the_pointer_leaves_the_button_and_at_the_limit(lab):
    lab.page.locator('button[data-cell="jog 0 minus"]').hover()
    lab.page.mouse.down()
    home = lab.slider_value(1)
    lab.until(lambda: lab.slider_value(1) < home - 3.0)
    lab.page.mouse.move(300, 300)
    lab.rest()
    value = lab.slider_value(1)
    lab.still(0.5)
    assert lab.slider_value(1) == value
    lab.page.mouse.up()
    lab.type_into("value 1", "157")
    lab.press("jog-turn 5")
    lab.page.locator('button[data-cell="jog 0 plus"]').hover()
    lab.page.mouse.down()
    lab.until(lambda: lab.page.get_by_text("Joint 1 is at its limit of 160.0°.").is_visible())
    lab.page.mouse.up()
    assert lab.slider_value(1) == 160.0


def space_plays_what_the_open_page_shows(lab):
    lab.open_tab("Motion")
    lab.press("time-given")
    lab.type_into("duration", "60")
    lab.until(lambda: lab.page.get_by_text("Runs in 60.00 s within all limits").is_visible())
    lab.open_tab("Motion")  # which then has the focus
    assert "Space plays" in lab.page.locator('button[data-cell="play-motion"]').get_attribute("title")
    lab.page.keyboard.press("Space")
    lab.until(lambda: lab.page.locator('button[data-cell="pause-motion"]').count() == 1)
    lab.page.keyboard.press("Space")
    lab.until(lambda: lab.page.locator('button[data-cell="play-motion"]').count() == 1)
    # With this motion still on the timeline, another page plays what is its own.
    lab.open_tab("newton_1d")
    lab.page.keyboard.press("Space")
    lab.until(lambda: lab.page.locator('button[data-cell="pause-tangents"]').count() == 1)
    lab.page.keyboard.press("Space")
    lab.until(lambda: lab.page.locator('button[data-cell="play-tangents"]').count() == 1)


def test_the_tool_is_jogged_by_keys_and_gamepad(visit):
    lab = visit()
    jog(lab, "base")
    keys_jog_while_the_buttons_are_seen(lab)
    jog(lab, "base")
    a_gamepad_moves_the_tool_chooses_what_is_jogged_and_rests_in_its_dead_zone(lab)
    jog(lab, "base")
    a_page_that_is_not_seen_hears_no_gamepad(lab)


def keys_jog_while_the_buttons_are_seen(lab):
    before = lab.target()
    lab.page.keyboard.press("3")
    lab.until(lambda: abs(lab.target()[2] - before[2] - 0.01) < 1e-4)
    lab.page.keyboard.press("Shift+3")
    lab.until(lambda: abs(lab.target()[2] - before[2]) < 1e-4)
    lab.page.keyboard.down("3")
    lab.until(lambda: lab.target()[2] > before[2] + 0.04)
    lab.page.keyboard.up("3")
    lab.rest()
    height = lab.target()[2]
    lab.still(0.5)
    assert lab.target()[2] == height
    lab.press("jog-base")
    lab.page.keyboard.press("3")
    lab.rest()
    assert lab.target()[2] == height


def a_gamepad_moves_the_tool_chooses_what_is_jogged_and_rests_in_its_dead_zone(lab):
    lab.page.evaluate(PAD)
    before = lab.target()
    lab.page.evaluate("() => { window.__pad.axes = [0.1, -0.1, 0.05, 0.1]; }")
    lab.still(0.5)
    np.testing.assert_allclose(lab.target(), before, atol=1e-9)
    lab.page.evaluate("() => { window.__pad.axes = [0, 0, 0, -0.6]; }")
    lab.until(lambda: lab.target()[2] > before[2] + 0.02)
    lab.page.evaluate("() => { window.__pad.axes = [0, 0, 0, 0]; }")
    lab.rest()
    after = lab.target()
    np.testing.assert_allclose(after[:2], before[:2], atol=1e-4)
    lab.press("undo")
    lab.until(lambda: abs(lab.target()[2] - before[2]) < 1e-6)
    # Button A goes from base to tool and from there to the joints; the shoulder buttons choose one.
    for mode in ("tool", "joints"):
        lab.page.evaluate("() => { window.__pad.buttons[0].pressed = true; }")
        lab.until(lambda mode=mode: lab.page.locator(f'[data-jog-mode={mode}][aria-pressed="true"]').count() == 1)
        lab.page.evaluate("() => { window.__pad.buttons[0].pressed = false; }")
        lab.still(0.3)
    home = lab.slider_value(2)
    lab.page.evaluate("() => { window.__pad.buttons[5].pressed = true; }")
    lab.until(lambda: lab.page.locator(".jog > :nth-child(2)[data-pad]").count() == 1)
    lab.page.evaluate("() => { window.__pad.buttons[5].pressed = false; window.__pad.axes = [1, 0, 0, 0]; }")
    lab.until(lambda: lab.slider_value(2) > home + 3.0)
    lab.page.evaluate("() => { window.__pad.axes = [0, 0, 0, 0]; window.__pad.connected = false; }")
    lab.rest()


def a_page_that_is_not_seen_hears_no_gamepad(lab):
    lab.page.evaluate(PAD)
    lab.page.evaluate("() => Object.defineProperty(document, 'hidden', { get: () => true })")
    before = lab.target()
    lab.page.evaluate("() => { window.__pad.axes = [1, 0, 0, -1]; }")
    lab.still(0.6)
    np.testing.assert_allclose(lab.target(), before, atol=1e-9)
