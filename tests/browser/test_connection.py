"""A page whose lab has gone says so, and stops saying so when it is back."""

import pytest

from support.chromium import new_page
from support.lab import open_lab
from support.page import COARSE, LabPage

pytestmark = pytest.mark.browser


@pytest.mark.parametrize("wide", [900, 390])
def test_a_lost_connection_is_said_until_it_is_back(browser, tmp_path, wide):
    lab = open_lab(tmp_path)
    context = browser.new_context()
    page = LabPage(new_page(context, painted=False), f"http://127.0.0.1:{lab.port}/?{COARSE}", (wide, 600))
    said = page.page.get_by_role("alert").filter(has_text="connection to the lab is lost")
    page.page.set_viewport_size({"width": 520, "height": 600})  # viser's window becomes a sheet, if it was none
    page.still(2.0)
    assert said.count() == 0
    lab.stop()
    page.until(lambda: said.count() == 1)
    again = open_lab(tmp_path, port=lab.port)
    page.until(lambda: said.count() == 0)
    context.close()
    again.stop()
