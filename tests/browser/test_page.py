"""The page itself: layout, keys, what it asks of the network, what links can do to it."""

import time

import numpy as np
import pytest

from armlab.window.view import View
from support.page import COARSE, SMALL

pytestmark = pytest.mark.browser

SIZES = [(1400, 850), (1024, 700), (820, 1180)]

OUTSIDE = """() => {
  const bad = [];
  const visible = e => { const s = getComputedStyle(e); return s.visibility !== 'hidden' && s.display !== 'none'; };
  const all = '[role=tabpanel] *, [data-dock-leaf] *, .al-over, .al-over *, [role=tab]';
  for (const e of document.querySelectorAll(all)) {
    if (!visible(e) || !e.getClientRects().length || e.closest('svg, math, style')) continue;
    const r = e.getBoundingClientRect();
    if (r.width < 2 || r.height < 2) continue;
    const name = e.tagName + '.' + e.className + ' ' + (e.textContent || '').trim().slice(0, 40);
    if (r.left < -1 || r.right > innerWidth + 1) bad.push('outside: ' + name);
    if (e.closest('.al-over') && (r.top < 0 || r.bottom > innerHeight)) bad.push('outside: ' + name);
    const own = [...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim());
    if (own && getComputedStyle(e).overflowX !== 'visible' && e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 3)
      bad.push('clipped: ' + name);
    const typed = e.tagName === 'INPUT' && e.type !== 'checkbox';
    if (typed && e.scrollWidth > e.clientWidth + 1) bad.push('clipped: ' + name + e.value);
  }
  return bad;
}"""

OVERLAPS = """() => {
  const bad = [];
  for (const box of document.querySelectorAll('.al .row > div, .al .kv')) {
    const items = [...box.children].map(e => e.getBoundingClientRect()).filter(r => r.width > 1);
    items.forEach((a, i) => items.slice(i + 1).forEach(b => {
      if (Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1
        && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1) bad.push(box.textContent.slice(0, 60));
    }));
  }
  return bad;
}"""


def test_nothing_is_clipped_and_nothing_lies_outside(visit):
    """Every panel in every size, light and dark, with the arm that has most joints and longest numbers."""
    lab = visit("robot/panda", SIZES[0])
    lab.drag_handle(2, 1.27, (0.0, 200.0), steps=8)
    for _look in ("one", "the other"):
        lab.page.keyboard.press("l")
        for size in SIZES:
            lab.resize(size)
            for tab in ("Robot", "Joints", "Target", "View", "Help"):
                lab.open_tab(tab)
                assert lab.page.locator("canvas").first.bounding_box()["width"] >= 0.55 * size[0]
                lab.finds_none(OUTSIDE)
                lab.finds_none(OVERLAPS)


def test_an_address_with_a_foreign_server_and_a_fragment_asks_only_the_lab(visit, url):
    lab = visit("robot/scara?websocket=ws://127.0.0.1:9/evil#somewhere")
    assert "/robot/scara" in lab.address()
    assert "#" not in lab.address()
    assert "websocket" not in lab.address()
    assert all("127.0.0.1:9/" not in request for request in lab.requests if request.startswith("ws"))
    assert "Drag the handle" in lab.hint()
    the_page_asks_no_other_host_for_anything(lab, url)
    scripts_cannot_see_the_cookie_and_markup_cannot_run(lab)


def the_page_asks_no_other_host_for_anything(lab, url):
    lab.press("random")
    own = url.split("/")[2]
    foreign = [r for r in lab.requests if not r.startswith(("data:", "blob:")) and r.split("/")[2] != own]
    assert foreign == []
    assert any(r.startswith("ws://") for r in lab.requests)


def scripts_cannot_see_the_cookie_and_markup_cannot_run(lab):
    assert lab.page.evaluate("() => document.cookie") == ""
    ran = lab.page.evaluate(
        """async () => {
          window.ran = [];
          const host = document.createElement('div');
          host.innerHTML = `<img src="x" onerror="window.ran.push('img')"><svg onload="window.ran.push('svg')"></svg>`
            + `<iframe srcdoc="<script>parent.ran.push('frame')<\\/script>"></iframe>`;
          document.body.appendChild(host);
          await new Promise(done => setTimeout(done, 800));
          host.remove();
          return window.ran;
        }"""
    )
    assert ran == []
    lab.errors.clear()  # the refusals are what was wanted


def test_tabs_are_told_of_and_keys_go_where_the_focus_is(visit, monkeypatch):
    told, take = [], View._tabs_seen
    monkeypatch.setattr(View, "_tabs_seen", lambda view, text: (told.append(text), take(view, text)))
    lab = visit()
    a_new_page_tells_of_the_tab_the_lab_opens_and_of_no_tab_before(lab, told)
    lab.open_tab("Joints")
    keys_go_where_the_focus_is(lab)
    letters_are_commands_on_the_page_and_text_in_a_field(lab)
    the_cursor_goes_on_to_the_next_field(lab)


def a_new_page_tells_of_the_tab_the_lab_opens_and_of_no_tab_before(lab, told):
    """The page begins with the first tab, the lessons, all of which would be read for it."""
    lab.until(lambda: bool(told))
    lab.open_tab("Pose")
    lab.until(lambda: told[-1] == '["pose"]')
    assert told[0] == '["joints"]'
    assert '["lessons"]' not in told


def keys_go_where_the_focus_is(lab):
    # On a slider the arrows move the joint and leave the camera alone.
    lab.page.locator(f"{lab.slider_track(1)} [role=slider]").first.focus()
    before, camera = lab.slider_value(1), lab.camera()
    for _ in range(5):
        lab.page.keyboard.press("ArrowRight")
        time.sleep(0.08)
    lab.rest()
    assert lab.slider_value(1) == pytest.approx(before + 0.5, abs=0.01)
    np.testing.assert_allclose(lab.camera(), camera, atol=1e-6)
    # On the scene they turn the camera and leave the joint alone.
    lab.page.evaluate("() => document.activeElement.blur()")
    value = lab.slider_value(1)
    lab.page.keyboard.down("ArrowRight")
    time.sleep(0.4)
    lab.page.keyboard.up("ArrowRight")
    lab.rest()
    assert lab.slider_value(1) == value
    assert np.abs(np.array(lab.camera()) - camera).max() > 1e-3
    # Space presses the button that has the focus, and nothing when there is none.
    lab.page.keyboard.press("Space")
    lab.rest()
    assert lab.slider_value(1) == value
    lab.page.locator('button[data-cell="zero"]').focus()
    lab.page.keyboard.press("Space")
    lab.rest()
    assert lab.slider_value(1) == 0.0


def letters_are_commands_on_the_page_and_text_in_a_field(lab):
    lab.open_tab("Target")
    field = lab.page.locator('input[data-cell="x"]')
    field.click()
    lab.page.keyboard.type("h")
    assert "h" in field.input_value()
    assert lab.tab("Help").get_attribute("aria-selected") == "false"
    field.fill("600")
    field.press("Enter")
    lab.rest()
    lab.page.keyboard.press("h")
    lab.rest()
    assert lab.tab("Help").get_attribute("aria-selected") == "true"


def the_cursor_goes_on_to_the_next_field(lab):
    """The lab rewrites the fields after each entry; the focus must survive that."""
    lab.open_tab("Target")
    lab.page.locator('input[data-cell="x"]').click()
    lab.page.keyboard.press("Control+a")
    lab.page.keyboard.type("550")
    lab.page.keyboard.press("Tab")
    lab.rest()
    assert lab.page.evaluate("() => document.activeElement.dataset.cell") == "y"
    lab.page.keyboard.press("Control+a")
    lab.page.keyboard.type("-250")
    lab.page.keyboard.press("Enter")
    lab.rest()
    np.testing.assert_allclose(lab.target()[:2], [0.55, -0.25], atol=1e-6)


def test_a_planar_arm_on_a_tablet(visit):
    lab = visit("robot/planar_2r", (820, 1180), has_touch=True)
    planar_arms_show_x_to_the_right_and_y_up(lab)
    a_finger_moves_sliders_and_handle(lab)


def planar_arms_show_x_to_the_right_and_y_up(lab):
    root = lab.node("/arm")
    origin, x, y = (lab.on_screen(root, p) for p in ((0, 0, 0), (1, 0, 0), (0, 1, 0)))
    right, up = x - origin, y - origin
    assert right[0] > 100
    assert abs(right[1]) < 0.05 * right[0]
    assert up[1] < -100
    assert abs(up[0]) < 0.1 * -up[1]
    # The handle has an arrow for x and one for y, and dragging along x moves x alone.
    start = lab.target()
    lab.drag_handle(0, 2.0, (-120.0, 0.0))
    moved = lab.target() - start
    assert moved[0] < -0.1
    np.testing.assert_allclose(moved[1:], 0.0, atol=1e-9)


def a_finger_moves_sliders_and_handle(lab):
    """A tablet: taps on chips, one finger on the handle."""
    lab.page.locator('button[data-cell="stretched"]').tap()
    lab.rest()
    assert lab.slider_value(1) == 0.0
    lab.page.locator('button[data-cell="home"]').tap()
    lab.rest()
    start = lab.target()
    at = lab.on_screen("/target", (0.75 * 0.14 * 2.0, 0.0, 0.0))
    session = lab.page.context.new_cdp_session(lab.page)

    def touch(kind, point):
        points = [{"x": float(point[0]), "y": float(point[1])}] if kind != "touchEnd" else []
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        time.sleep(0.03)

    touch("touchStart", at)
    for k in range(1, 16):
        touch("touchMove", at - np.array([6.0 * k, 0.0]))
    touch("touchEnd", at)
    lab.rest()
    assert lab.target()[0] < start[0] - 0.05


def test_the_page_comes_back_by_itself_after_a_restart(desk, open_lab, tmp_path):
    lab = open_lab(tmp_path)
    page = desk.sit_down(f"http://127.0.0.1:{lab.port}/?{COARSE}", SMALL, painted=False)
    page.drag_slider(1, 0.8)
    value = page.slider_value(1)
    port = lab.port
    lab.stop()
    time.sleep(0.5)
    open_lab(tmp_path, port=port)
    page.until(lambda: page.page.locator(".al-over").count() > 0)
    page.ready()
    page.rest()
    assert page.slider_value(1) == pytest.approx(value, abs=0.11)
    desk.get_up(page, painted=False)
