"""Overlays in a real page: their switches, their keys, and where they are."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.rotations import rotation_from_quaternion
from armlab.kin.sweeps import sweeps
from armlab.ui.commands import shortcuts

pytestmark = pytest.mark.browser
PUMA = catalogue()["puma560"]
KEYS = {"Joint angles": "g", "Lengths and twists": "i", "Projections": "p", "Swept curves": "u", "Joint types": "j"}


CUT = """() => [...document.querySelectorAll('.switch')].filter(b => {
  const box = b.getBoundingClientRect();
  return b.scrollWidth > b.clientWidth || box.right > innerWidth || box.bottom > innerHeight;
}).map(b => b.textContent)"""


def test_overlays_fit_into_the_panel_come_by_key_and_go_by_switch(visit):
    lab = visit(size=(1400, 850))
    lab.open_tab("View")
    for size in ((1400, 850), (1024, 700)):
        lab.resize(size)
        assert lab.page.evaluate(CUT) == []
        assert lab.page.locator(".switch").count() >= 10
    for title, key in KEYS.items():
        box = lab.page.get_by_role("checkbox", name=title)
        assert not box.is_checked()
        before = set(lab.nodes())
        lab.page.keyboard.press(key)
        lab.rest()
        assert box.is_checked()
        made = set(lab.nodes()) - before
        assert len(made) > 5, title
        box.click()
        lab.rest()
        assert not box.is_checked()
        visible = "names => names.filter(name => window.__viserMutable.nodeRefFromName[name]?.visible)"
        still = lab.page.evaluate(visible, sorted(name for name in made if not name.endswith("label")))
        assert len(still) < len(made), title
    assert {entry.key for entry in shortcuts()} >= {key.upper() for key in KEYS.values()}
    lab.open_tab("Joints")
    _sweeps_each_joint_round_its_axis(lab)


def _sweeps_each_joint_round_its_axis(lab):
    lab.page.keyboard.press("u")
    lab.rest()
    pose = "name => { const p = window.__viserMutable.nodePoseData[name]; return [p.position, p.wxyz]; }"
    for move in (None, (2, 0.4)):
        if move:
            lab.drag_slider(*move)
            lab.rest()
        q = np.radians(lab.slider_values(6))
        for i, expected in enumerate(sweeps(PUMA.arm, q).centre[:5]):
            centre, wxyz = lab.page.evaluate(pose, lab.node(f"/swept/{i + 1}"))
            np.testing.assert_allclose(centre, expected, atol=3e-3)
            # The axis of the circle is that of the joint, and the tool is as far from its centre as it is wide.
            axis = rotation_from_quaternion(np.array(wxyz))[:, 2]
            assert axis @ (PUMA.arm.position(q) - np.array(centre)) == pytest.approx(0.0, abs=3e-3)
