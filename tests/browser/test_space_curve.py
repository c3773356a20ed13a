"""The page of geometry in a real page: an example plays, its frame travels, and nonsense stays as it was typed."""

import numpy as np
import pytest

pytestmark = pytest.mark.browser


def place(lab, node):
    """Return where the page has a node of the layer."""
    name = lab.node(f"/space_curve/{node}")
    return np.array(lab.page.evaluate("name => window.__viserMutable.nodePoseData[name].position", name))


def test_the_frame_travels_along_a_helix_and_nonsense_stays(visit):
    lab = visit()
    lab.open_tab("Motion")
    lab.page.locator("button.page[data-cell=space_curve]").click()
    lab.page.locator('select[data-cell="example"]').select_option("helix")
    lab.page.locator(".kit-look", has_text="n always points to the axis").wait_for()
    lab.type_into("s", "0.25")
    lab.until(lambda: "At s" in lab.page.locator(".sc-at").inner_text())
    lab.rest()
    # Of two turns a quarter is half a turn: on the other side of the axis, with a quarter of the rise.
    np.testing.assert_allclose(place(lab, "frenet"), (-0.2 - 2 * 0.18, -0.08, 0.15 + 0.25 * 0.5), rtol=0, atol=1e-4)
    before = place(lab, "frenet")
    lab.page.locator('.al-time button[data-cell="play"]').click()
    lab.until(lambda: np.linalg.norm(place(lab, "frenet") - before) > 0.1)
    lab.type_into("T", "soon")
    field = lab.page.locator('input[data-cell="T"]')
    assert field.input_value() == "soon"
    assert field.get_attribute("aria-invalid") == "true"
    assert "T: expected a number, got 'soon'" in lab.page.locator("p.no[role=alert]").first.inner_text()
    lab.page.locator('button[data-cell="shown turn"]').click()
    lab.page.locator(".sc-two").wait_for()
    assert lab.errors == []
