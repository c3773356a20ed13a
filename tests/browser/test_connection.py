"""A page whose lab has gone says so, and stops saying so when it is back."""

import pytest

from support.chromium import new_page
from support.page import COARSE, LabPage

pytestmark = pytest.mark.browser


@pytest.mark.parametrize("wide", [900, 390])
def test_a_lost_connection_is_said_until_it_is_back(browser, open_lab, tmp_path, wide):
    lab = open_lab(tmp_path)
    context = browser.new_context()
    page = LabPage(new_page(context, painted=False), f"http://127.0.0.1:{lab.port}/?{COARSE}", (wide, 600))
    said = page.page.get_by_role("alert").filter(has_text="connection to the lab is lost")
    page.page.set_viewport_size({"width": 520, "height": 600})  # viser's window becomes a sheet, if it was none
    page.still(2.0)
    assert said.count() == 0
    lab.stop()
    page.until(lambda: said.count() == 1)
    open_lab(tmp_path, port=lab.port)
    page.until(lambda: said.count() == 0)
    context.close()


def test_dialogs_rest_while_the_connection_is_lost(browser, open_lab, tmp_path):
    lab = open_lab(tmp_path)
    context = browser.new_context()
    page = LabPage(new_page(context, painted=False), f"http://127.0.0.1:{lab.port}/?{COARSE}")
    resting = "of => [...document.querySelectorAll(of)].filter(each => each.closest('[inert]')).length"
    buttons, hits = ".al-dialog button", "#al-search [role=option]"
    page.press("arms")
    page.page.keyboard.press("Control+k")
    page.page.locator(hits).first.wait_for()
    assert [page.page.evaluate(resting, of) for of in (buttons, hits)] == [0, 0]
    lab.stop()
    said = page.page.get_by_role("alert", include_hidden=True).filter(has_text="connection to the lab is lost")
    said.wait_for()
    for of in (buttons, hits):
        assert page.page.evaluate(resting, of) == page.page.locator(of).count() > 0
    assert said.evaluate("of => of.matches(':popover-open')"), "it lies above the search"
    page.page.locator("#al-search [data-shut]").click()
    assert not page.page.locator("#al-search").evaluate("search => search.open")
    open_lab(tmp_path, port=lab.port)
    said.wait_for(state="detached")
    search = "#al-search input"
    page.page.locator(search).wait_for(state="attached")  # the panels come anew, some time after the connection
    assert page.page.evaluate(resting, search) == 0
    context.close()


def test_a_lab_that_comes_back_asks_again_before_an_exam_and_not_once_it_has_begun(browser, open_lab, tmp_path):
    lab = open_lab(tmp_path)
    context = browser.new_context()
    address = f"http://127.0.0.1:{lab.port}/assignment/solutions"
    page = LabPage(new_page(context, painted=False), f"{address}?{COARSE}")
    begin, clock = (page.page.locator(of) for of in ("[data-cell=confirm-yes]", ".as-clock"))
    begin.wait_for()
    with page.page.expect_navigation():
        lab.stop()
        lab = open_lab(tmp_path, port=lab.port)
    begin.click()
    clock.wait_for()
    lab.stop()
    lab = open_lab(tmp_path, port=lab.port)
    page.page.goto(address)
    clock.wait_for()
    page.still(1.0)
    assert begin.count() == 0
    context.close()
