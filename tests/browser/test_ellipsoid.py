"""The ellipsoid in the scene, and the sweep of a joint with its plots."""

import numpy as np
import pytest

from armlab.benches.velocity.ellipsoid.state import VelocityBlock, placed
from armlab.content.robots import catalogue
from armlab.kin.rotations import rotation_from_quaternion

pytestmark = pytest.mark.browser
ELBOW = catalogue()["elbow_3r"].arm
BLOCK = VelocityBlock(ELBOW, "translation")
SHOWN = "name => window.__viserMutable.nodeRefFromName[name].visible"


def pose(lab, name):
    """Return position and axes of a node of the scene as the page has them."""
    found = lab.page.evaluate(
        "name => { const pose = window.__viserMutable.nodePoseData[name]; return [pose.position, pose.wxyz]; }", name
    )
    return np.array(found[0]), rotation_from_quaternion(found[1])


def test_it_is_switched_on_follows_a_move_and_a_joint_is_swept(visit):
    lab = visit("robot/elbow_3r", size=(1100, 900))
    _is_kept_on_other_tabs_by_its_switch(lab)
    lab.open_tab("Ellipsoid")
    _is_at_the_tool_and_follows_a_move(lab)
    _plays_a_sweep_and_saves_its_curves(lab)


def _is_kept_on_other_tabs_by_its_switch(lab):
    lab.page.keyboard.press("m")
    lab.until(lambda: any(name.endswith("/ellipsoid") for name in lab.nodes()))
    assert lab.page.evaluate(SHOWN, lab.node("/ellipsoid"))
    lab.open_tab("Ellipsoid")
    lab.rest()
    assert lab.page.get_by_label("Always shown").is_checked()
    lab.page.get_by_label("Always shown").click()
    lab.rest()
    lab.open_tab("Joints")
    lab.rest()
    assert not lab.page.evaluate(SHOWN, lab.node("/ellipsoid"))


def _is_at_the_tool_and_follows_a_move(lab):
    lab.until(lambda: any(name.endswith("/ellipsoid_tab") for name in lab.nodes()))
    lab.rest()
    node = lab.node("/ellipsoid_tab")
    found = placed(BLOCK, catalogue()["elbow_3r"].home)
    position, axes = pose(lab, node)
    np.testing.assert_allclose(position, found.centre, atol=1e-4)
    np.testing.assert_allclose(axes, found.axes, atol=1e-4)
    lab.page.keyboard.press("0")
    lab.rest()
    at_zero = placed(BLOCK, np.zeros(3))
    np.testing.assert_allclose(pose(lab, node)[0], at_zero.centre, atol=1e-4)
    assert "Singular" in lab.page.locator(".al .verdict").first.inner_text()
    assert [lab.page.evaluate(SHOWN, lab.node(f"/ellipsoid_tab/lost{i}")) for i in range(3)] == [False, False, True]


def _plays_a_sweep_and_saves_its_curves(lab):
    lab.page.get_by_role("button", name="Sweep").click()
    lab.until(lambda: lab.page.locator(".al-time").count() == 1)
    before = lab.page.locator(".al-cursor").first.evaluate("line => parseFloat(line.style.left)")
    lab.until(
        lambda: abs(lab.page.locator(".al-cursor").first.evaluate("line => parseFloat(line.style.left)") - before) > 5
    )
    lab.page.keyboard.press("Space")
    lab.rest()
    with lab.page.expect_download() as saved:
        lab.page.locator('button[data-cell="csv"]').first.click()
    lines = saved.value.path().read_text(encoding="utf-8").splitlines()
    assert lines[0] == '"q₂, °","w, m³"'
    assert len(lines) == 362
