"""The page of timing laws in a real browser: an example, its film, a refused table, and nothing that is cut off."""

import pytest

pytestmark = pytest.mark.browser


def at_laws(visit, **options):
    lab = visit(**options)
    lab.open_tab("Motion")
    lab.page.locator('button.page[data-cell="laws"]').click()
    lab.page.locator(".law-race").wait_for()
    return lab


def test_an_example_is_played_and_a_wrong_table_is_marked(visit):
    lab = at_laws(visit)
    lab.page.locator('select[data-cell="example"]').select_option("bang_coast_bang")
    lab.page.locator(".law p", has_text="T = (L A + V²)/(A V) = 3 s").wait_for()
    lab.type_into("time", "1.5")
    lab.until(lambda: lab.page.locator(".law-race .now").first.get_attribute("cx") == "160.0")
    lab.unfold("Values, peaks and classes")
    values = lab.page.locator(".law-table").first.locator("tr").nth(1).locator("td").all_text_contents()
    assert values == ["s", "1", "1"]
    lab.page.locator('.al-time button[data-cell="forward"]').click()
    lab.until(lambda: "t = 2 s" in lab.page.locator(".law-table").first.inner_text())
    rows = lab.page.locator('textarea[data-cell="l1-rows"]')
    rows.fill("0 1 1\n3 4 -1")
    rows.blur()
    lab.page.locator("p.no[role=alert]", has_text="row 2: it must begin at 1 s").wait_for()
    rows = lab.page.locator('textarea[data-cell="l1-rows"]')
    assert rows.input_value() == "0 1 1\n3 4 -1"
    assert rows.get_attribute("aria-invalid") == "true"
    wide = lab.page.evaluate(
        """() => [...document.querySelectorAll('.law, .law-table, .options, .law-race')]
          .filter(each => each.scrollWidth > each.clientWidth + 1 || each.getBoundingClientRect().width > 345).length"""
    )
    assert wide == 0


def test_axes_have_a_point_in_a_browser_that_writes_a_comma(visit):
    lab = at_laws(visit, locale="de-DE")
    said = lab.page.evaluate("[(1234.5).toLocaleString(), new Intl.NumberFormat(navigator.language).format(1234.5)]")
    assert said == ["1.234,5", "1234.5"]
