"""The laboratory of curves in a real page: an example, a knot, a limit, and a mistake."""

import pytest

pytestmark = pytest.mark.browser


def test_curves_are_chosen_typed_and_measured(visit):
    lab = visit()
    lab.open_tab("Motion")
    lab.press("curves")
    lab.page.locator('select[data-cell="example"]').select_option("one_to_four")
    lab.page.locator(".kit-look", has_text="the cubic jumps to 4.5").wait_for()
    lab.rest()
    assert lab.page.locator(".cu-curve").count() == 2
    assert lab.page.locator(".uplot").count() == 4
    said = lab.page.locator("p.no", has_text="Curve 2").inner_text()
    assert said == "✕ Curve 2: velocity above 2.5 rad/s from 0.76 to 1.24 s; up to 2.812 rad/s."
    lab.type_into("v_max", "3")
    lab.page.locator("p.ok", has_text="Curve 2 keeps the limits").wait_for()
    lab.type_into("t 1", "0")
    assert "knot 2: its time 0 s must be later than the 0 s of knot 1" in lab.page.locator("[role=alert]").inner_text()
    assert lab.page.locator('input[data-cell="t 1"]').input_value() == "0"
    lab.type_into("t 1", "4")
    lab.unfold("Classes, peaks and overshoot")
    lab.page.locator(".cu-facts td", has_text="1.406").first.wait_for()
    assert lab.page.locator("[role=alert]").count() == 0
    assert lab.errors == []
