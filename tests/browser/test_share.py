"""A link is made in one browser and opened in another."""

import base64
import json
import zlib

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.content.write_robot import robot_toml
from armlab.session.share_words import FREQUENT

pytestmark = pytest.mark.browser


def shared_link(lab):
    """Make a link on the page Share; returns its path."""
    lab.open_tab("View")
    lab.press("share")
    lab.press("make-link")
    field = lab.page.locator('input[aria-label="Link"]')
    address = field.input_value()
    assert lab.page.locator('button[data-copy*="/state/"]').get_attribute("data-copy") == address
    assert address.startswith(lab.address().split("/robot")[0] + "/state/")
    box = lab.page.locator(".qr svg").bounding_box()
    assert box["width"] > 250
    assert box["x"] + box["width"] <= lab.page.viewport_size["width"]
    return "state/" + address.split("/state/")[1]


def test_a_link_shows_the_same_arm_beside_ones_own_work(visit):
    teacher = visit("robot/ur10")
    teacher.drag_slider(2, 0.4)
    teacher.drag_slider(3, 0.7)
    pose, tool = teacher.slider_values(6), teacher.target()
    path = shared_link(teacher)

    guest = visit("robot/planar_2r")
    guest.drag_slider(1, 0.8)
    own = guest.slider_values(2)
    guest.page.goto(guest.address().split("/robot")[0] + "/" + path + "?fixedDpr=0.5")
    guest.ready()
    guest.until(lambda: guest.page.get_by_text("A shared arm").first.is_visible())
    guest.open_tab("Joints")
    guest.rest()
    np.testing.assert_allclose(guest.slider_values(6), pose, atol=1e-6)
    np.testing.assert_allclose(guest.target(), tool, atol=1e-6)
    guest.drag_slider(1, 0.2)
    np.testing.assert_allclose(teacher.target(), tool, atol=1e-9)
    guest.open_tab("View")
    guest.press("share")
    guest.press("back-mine")
    guest.open_tab("Joints")
    guest.until(lambda: "/robot/planar_2r" in guest.address())
    guest.rest()
    np.testing.assert_allclose(guest.slider_values(2), own)


def test_script_in_a_link_does_not_run(visit):
    script = "<img src=x onerror='window.harmed = 1'><script>window.harmed = 1</script>"
    toml = robot_toml(catalogue()["planar_2r"]).replace("Planar 2R", script, 1)
    assert script in toml
    packer = zlib.compressobj(9, zdict=FREQUENT)
    plain = json.dumps({"robot": {"toml": toml, "origin": ""}}).encode()
    text = "1" + base64.urlsafe_b64encode(packer.compress(plain) + packer.flush()).decode().rstrip("=")
    lab = visit(f"state/{text}")
    assert lab.page.evaluate("() => window.harmed") is None
    assert "/robot/puma560" in lab.address()
    assert len(lab.slider_values(6)) == 6
