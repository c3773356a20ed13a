"""The Pose bench: what is pressed in a matrix is seen in the scene."""

import numpy as np
import pytest

pytestmark = pytest.mark.browser


def drawn(lab):
    """Return which marks of the bench are in the scene."""
    return {name.rsplit("/", 1)[1] for name in lab.nodes() if "/lit" in name or "/turn" in name}


def is_cut(lab, part):
    """Return whether a part reaches out of the panel."""
    (left, right), (low, high) = (bounds(lab, selector) for selector in (".pages", part))
    return low < left - 1 or high > right + 1


def is_wide(lab, kind):
    """Return whether something of this kind would have to be scrolled."""
    shown = lab.page.locator(f".al {kind}:visible").all()
    return any(one.evaluate("e => e.scrollWidth > e.clientWidth + 1") for one in shown)


def bounds(lab, selector):
    box = lab.page.locator(f"{selector}:visible").first.bounding_box()
    return box["x"], box["x"] + box["width"]


def test_a_pressed_column_lights_up_and_a_second_press_lets_it_go(visit):
    lab = visit(painted=True)
    lab.open_tab("Pose")
    lab.rest()
    assert {"lit_frame", "lit_reference"} <= drawn(lab)
    assert "arrows" not in drawn(lab)
    dark = lab.picture()
    lab.press(",3")
    assert "arrows" in drawn(lab)
    assert "|p| = " in lab.page.locator(".said").inner_text()
    lit = lab.picture()
    purple = np.abs(lit[:, :550] - (204, 121, 167)).sum(axis=2) < 90
    assert np.count_nonzero(purple & (np.abs(lit - dark)[:, :550].sum(axis=2) > 60)) > 150
    lab.press(",3")
    assert "arrows" not in drawn(lab)
    assert lab.page.locator(".mat.select td.lit").count() == 0


def test_the_lit_frame_goes_with_the_arm_and_the_marks_with_their_page(visit):
    lab = visit()
    lab.open_tab("Pose")
    lab.press("0,1")
    assert {"arrows", "strokes"} <= drawn(lab)
    before = lab.on_screen(lab.node("/lit_frame"))
    entry = lab.page.locator('.mat.select button[data-cell="0,1"]').inner_text()
    lab.drag_handle(2, 1.6, (0.0, -50.0))
    assert np.linalg.norm(lab.on_screen(lab.node("/lit_frame")) - before) > 10
    lab.press("4-5")
    assert lab.page.locator('.mat.select button[data-cell="0,1"]').inner_text() != entry
    lab.press("orientation")
    assert lab.page.locator("table.angles tr").count() == 3
    shown = "n => window.__viserMutable.nodeRefFromName[n].visible"
    assert not lab.page.evaluate(shown, lab.node("/lit_frame"))
    assert lab.page.evaluate(shown, lab.node("/turn_frame"))


PARTS = {
    "pose": (".mat.select", ".coordinates", ".choose"),
    "orientation": (".mat.select", ".angles", ".kv", ".choose"),
    "formulas": (".formula", ".where"),
}


def test_nothing_on_the_pages_is_cut(visit):
    lab = visit("robot/panda", (1400, 850))
    lab.open_tab("Pose")
    for page, parts in PARTS.items():
        lab.press(page)
        for size in ((1400, 850), (1024, 700), (820, 1180)):
            lab.resize(size)
            lab.until(lambda parts=parts: not any(is_cut(lab, part) for part in parts))
            assert not any(is_wide(lab, kind) for kind in (".scroll", ".formula", ".eq")), (page, size)
